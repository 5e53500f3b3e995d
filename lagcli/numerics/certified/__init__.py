"""Runs against each other: the bound on the global error, precision escalation, the certificate."""
