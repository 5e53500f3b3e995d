"""Answers to the questions of a file: `where`, and values rewritten by what is conserved."""
