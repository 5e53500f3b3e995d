"""Readable shapes of the unique form: which formula a textbook would print."""
