"""A metric of constant curvature: its Killing vectors, and the dilation of a flat one.

With the functions X_a of `ambient` these are known in any coordinates, up to constant factors:

    flat:    grad X_a,  X_a grad X_b - X_b grad X_a,  G^ab X_a grad X_b,
    curved:  X_a grad X_b - X_b grad X_a,

where G_ab = grad X_a . grad X_b.

References
----------
Eisenhart, *Riemannian Geometry*, section 71.
"""

from __future__ import annotations

from functools import cached_property
from itertools import combinations

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.ambient import ambient_functions
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric

Vector = tuple[Expr, ...]


class ConstantCurvature:
    """The functions X_a of a metric, none where its curvature is not constant, and what is made."""

    def __init__(self, metric: Metric, allowed: Allowance) -> None:
        self.metric, self.allowed = metric, allowed

    @cached_property
    def functions(self) -> list[Expr]:
        """X_a; none where the curvature is not constant, or they were not found."""
        return ambient_functions(self.metric, self.allowed)

    @property
    def flat(self) -> bool:
        """Whether the X_a are Cartesian coordinates."""
        return bool(self.metric.curvature == 0)

    @property
    def translated(self) -> list[Expr]:
        """X_a of a flat space."""
        return self.functions if self.flat else []

    @cached_property
    def translations(self) -> list[Vector]:
        """grad X_a of a flat space."""
        return self._gradients if self.flat else []

    @cached_property
    def _gradients(self) -> list[Vector]:
        return [self.metric.gradient(X) for X in self.functions]

    @cached_property
    def rotations(self) -> list[Vector]:
        """X_a grad X_b - X_b grad X_a."""
        pairs = combinations(zip(self.functions, self._gradients, strict=True), 2)
        return [
            tuple(simplify(X * y - Y * x) for x, y in zip(DX, DY, strict=True))
            for (X, DX), (Y, DY) in pairs
        ]

    @cached_property
    def gram(self) -> sympy.Matrix:
        """G_ab = grad X_a . grad X_b, constant in a flat space."""
        lowered = [[dot(row, D) for row in self.metric.g] for D in self._gradients]
        return sympy.Matrix([[simplify(dot(D, low)) for low in lowered] for D in self._gradients])

    @property
    def inertia(self) -> list[Expr]:
        """m_a of T = sum m_a X_a'^2/2; none where the X_a are not at right angles."""
        return [1 / k for k in self.gram.diagonal()] if self.gram.is_diagonal() else []

    @cached_property
    def dilation(self) -> Vector:
        """G^ab X_a grad X_b, half the gradient of the square of the distance."""
        inverse = self.gram.inv(method="ADJ")
        n = range(len(self.functions))
        square = sympy.Add(
            *(inverse[a, b] * self.functions[a] * self.functions[b] for a in n for b in n)
        )
        return tuple(x / 2 for x in self.metric.gradient(square))

    @property
    def fields(self) -> list[Vector]:
        """All Killing vectors."""
        return [*self.translations, *self.rotations]
