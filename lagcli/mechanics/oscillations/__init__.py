"""Small oscillations about states of rest: frequencies, modes and verdicts."""
