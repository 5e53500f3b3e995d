"""Cartesian coordinates of one particle, those of the file or made of r and its angles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero, simplify
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.slots import SlotEquations


@dataclass(frozen=True, slots=True)
class Cartesian:
    """Functions X of the coordinates, with their names, in which T is m (dX/dt)^2/2."""

    names: tuple[str, ...]
    X: tuple[Expr, ...]
    mass: Expr

    @property
    def radius(self) -> Expr:
        """The distance from the origin."""
        length: Expr = simplify(sympy.sqrt(sympy.Add(*(x**2 for x in self.X))))
        return length.replace(sympy.Abs, lambda r: r)

    def moved(self, q: Sequence[Expr], changes: Sequence[Expr]) -> list[Expr]:
        """The components of a displacement, or of a velocity, that the coordinates have."""
        return [simplify(dot([x.diff(c) for c in q], changes)) for x in self.X]


def cartesian(kinds: Kinds, equations: SlotEquations) -> Cartesian | None:
    """Lengths about their centre; r and phi, with z; r, theta and phi; None for anything else."""
    q, mass = equations.q, equations.mass
    others = [x for x in q if x not in (*kinds.radii, *kinds.angles)]
    found = [(x.name, x - kinds.centre.get(x, 0)) for x in others]
    if len(kinds.radii) == 1 and len(kinds.angles) == 1:
        [r], [phi] = kinds.radii, kinds.angles
        found = [("x", r * sympy.cos(phi)), ("y", r * sympy.sin(phi)), *found]
    elif len(kinds.radii) == len(kinds.latitudes) == 1 and len(kinds.angles) == 2:
        [r], [(theta, pole)] = kinds.radii, kinds.latitudes.items()
        [phi] = [y for y in kinds.angles if y != theta]
        axis = (sympy.sin if pole.func is sympy.cos else sympy.cos)(theta)
        flat = r * pole
        found += [("x", flat * sympy.cos(phi)), ("y", flat * sympy.sin(phi)), ("z", r * axis)]
    if not found or len(found) != len(q):
        return None
    columns = [[X.diff(x) for _, X in found] for x in q]
    m = simplify(mass[0][0] / dot(columns[0], columns[0]))
    if not m.free_symbols.isdisjoint({equations.t, *q, *equations.v}):
        return None
    if not all(
        is_zero(entry - m * dot(a, b)) is True
        for a, row in zip(columns, mass, strict=True)
        for b, entry in zip(columns, row, strict=True)
    ):
        return None
    names, X = zip(*found, strict=True)
    return Cartesian(names, X, m)
