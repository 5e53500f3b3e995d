"""The motion in numbers, with a bound on its error that was measured and not assumed.

The storeys, from the ground: `equations` (the system as a graph and as functions of numbers),
`compiled` (Taylor series in machine code), `integrators` (one method a file), `hybrid` (events,
contacts, friction; the run of a motion piece by piece), `certified` (runs against each other
and their certificate), `rigorous` (proofs) and `tables` (the result in a file).

No module here imports SymPy, NumPy or SciPy.
"""
