"""The motion in numbers, with a bound on its error that was measured and not assumed.

A problem goes through these in this order: `equations` (nodes of M, forcing, A and what is
eliminated from them), `motion` (those as functions), `start` (the state at t = 0),
a method (`dop853` in doubles, `taylor` in any precision), `run` (steps, rows, events),
`accuracy` (runs against each other), `certificate` and `writing`.

No module here imports SymPy, NumPy or SciPy.
"""
