"""The sections of the answers: one module each, with everything that lagcli knows of it.

A module declares its section as `SECTION` (`lagcli.statements.declaration`); it is found by its
name, as its functions `derive`, `blocks`, `json`, `large` and `phase_space` are.  What is heavy is
imported inside the functions.
"""
