"""The kinds of random systems, by name: a generator of random numbers -> a system."""

from . import combined, constraints, corners, forms, further, known, resting, symmetries, terms

KINDS = {
    name: kind
    for file in (constraints, symmetries, forms, terms, resting, further, corners, known, combined)
    for name, kind in file.KINDS.items()
}
