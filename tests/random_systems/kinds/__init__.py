"""The kinds of random systems, by name: a generator of random numbers -> a system."""

from . import (
    chains,
    classical,
    combined,
    constraints,
    corners,
    extended,
    forms,
    further,
    known,
    resting,
    symmetries,
    terms,
)  # fmt: skip

KINDS = {
    name: kind
    for file in (
        constraints,
        symmetries,
        forms,
        terms,
        resting,
        further,
        corners,
        known,
        combined,
        chains,
        extended,
        classical,
    )
    for name, kind in file.KINDS.items()
}
