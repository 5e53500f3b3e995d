"""Where a problem breaks: its parameters and its state taken to their extremes, case by case.

`scene` gives everything a number, `roles` reads from the formulas what each parameter and
coordinate is, `cases` makes the extremes of it.  `formulas` are those that `solve` prints,
`digits` counts what they lose in doubles, `condition` that of the mass matrix, `trial` puts
one case to the test, `workers` keeps its time limit, `study` goes through all of them and
`writing` shows it.
"""
