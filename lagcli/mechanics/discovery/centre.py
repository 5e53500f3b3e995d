"""The point that rotations leave at rest: coordinates are counted from it.

For a force towards (a, b), the Runge-Lenz vector is of second degree in x - a and y - b with
one coefficient each.  In x and y its terms are spread, and mixed with L^2 and the energy.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 3.9.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.mechanics.noether import Transformation
from lagcli.mechanics.system import System

Centre = dict[Symbol, Expr]


def centre_of(
    transformations: Iterable[Transformation],
    system: System,
    lengths: Sequence[Symbol],
) -> Centre:
    """Where the rotations dx = c (y - b), dy = -c (x - a) vanish, for each coordinate not at 0.

    Empty where the rotations have no point in common.
    """
    found: Centre = {}
    for transformation in transformations:
        for x, at in _fixed(transformation, system.q):
            if not at.free_symbols <= set(system.parameters):  # it moves
                return {}
            if x not in lengths or sympy.expand(found.setdefault(x, at) - at) != 0:
                return {}
    return {x: at for x, at in found.items() if at != 0}


def _fixed(transformation: Transformation, q: Sequence[Symbol]) -> Iterator[tuple[Symbol, Expr]]:
    """The coordinates of the points that a rotation of one plane leaves at rest."""
    moved = {x: sympy.expand(c) for x, c in zip(q, transformation.changes, strict=True) if c != 0}
    if transformation.time != 0 or len(moved) != 2:
        return
    one, other = moved
    slopes = [moved[one].diff(other), moved[other].diff(one)]
    if 0 in slopes or any(s.free_symbols & set(q) for s in slopes):
        return
    points = [(y, sympy.cancel(y - moved[x] / s))
              for x, y, s in zip((one, other), (other, one), slopes, strict=True)]  # fmt: skip
    if sympy.expand(sum(slopes)) == 0:
        yield from points
