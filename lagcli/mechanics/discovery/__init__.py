"""Symmetries and first integrals that nobody listed: a linear search, then a proof of each."""
