"""What accuracy costs: every method against a reference whose own error is known.

`reference` finds the motion better than any method that is tried, `trial` makes one run in
a process of its own, `study` makes all of them, `front` says which of them pay, `writing`
and `plot` show it.
"""
