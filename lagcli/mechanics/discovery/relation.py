"""Constant coefficients with which given vectors of functions add up to zero."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import ModularPoints, NoPoint, kernel_modulo

_BAD_POINTS = 50


class Relation:
    """Vectors of functions of some variables over the field of the constants.

    Parameters
    ----------
    vectors
        Each of the same length.
    variables
        All other symbols are constants.
    """

    def __init__(
        self, vectors: Sequence[Sequence[Expr]], variables: Sequence[Symbol], allowed: Allowance
    ) -> None:
        self.vectors = [list(v) for v in vectors]
        self.allowed = allowed
        field = Field([e for v in self.vectors for e in v])
        elements = [[field(e) for e in v] for v in self.vectors]
        self.points = ModularPoints(field, variables)
        self._compiled = [[self.points.compiled(e) for e in v] for v in elements]

    def rows(self, count: int) -> list[list[int]]:
        """At least so many rows of values, modulo a prime; columns are the vectors."""
        rows: list[list[int]] = []
        bad = 0
        while len(rows) < count:
            self.allowed.check()
            point = self.points.point()
            try:
                columns = [[e(point) for e in v] for v in self._compiled]
            except NoPoint:
                bad += 1
                if bad > _BAD_POINTS:
                    raise
                continue
            rows += [list(row) for row in zip(*columns, strict=True)]
        return rows

    def of_last(self) -> list[Expr] | None:
        """c with sum c_k vector_k + (last vector) = 0, or None; checked by the caller."""
        width = len(self.vectors)
        _, kernel = kernel_modulo(self.rows(width + 8), width)
        vector = next((v for v in kernel if width - 1 in v), None)
        if vector is None:
            return None
        indices = sorted(vector)
        exact = ExactSolver(self.points)
        values = exact.recognized([vector[i] for i in indices])
        if values is None:
            values = exact.solved([self.vectors[i] for i in indices])
            if values is None or values[-1] == 0:
                return None
            values = [x / values[-1] for x in values]
        known = dict(zip(indices, values, strict=True))
        return [known.get(i, sympy.S.Zero) for i in range(width - 1)]
