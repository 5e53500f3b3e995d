"""The kinds of random systems, by name: a generator of random numbers -> a system."""

from . import constraints, corners, forms, further, resting, symmetries

KINDS = {
    name: kind
    for file in (constraints, symmetries, forms, resting, further, corners)
    for name, kind in file.KINDS.items()
}
