"""Where a system can rest, and its linear motion beside a state of rest."""
