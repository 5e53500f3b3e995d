"""The shapes in which the formulas of one system are read."""

from __future__ import annotations

from sympy import Expr

from lagcli.algebra import shape, terms
from lagcli.algebra.terms import is_flat
from lagcli.expression import Expression, operation_count
from lagcli.mechanics.dynamics import Dynamics


class Readable:
    """Trees of SymPy expressions, ordered as the system orders its names."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = system = dynamics.system
        fast = (*system.qdot, *system.qddot, *system.multipliers)
        self._leading = frozenset(symbol.name for symbol in fast)

    def as_written(self, expression: Expr) -> Expression:
        """The shortest shape, without using the constraints."""
        return shape(expression, self.system.order)

    def by_terms(self, expression: Expr, *, as_given: bool = False) -> Expression:
        """Term by term in velocities, accelerations, multipliers, as L and h are read."""
        return terms(expression, self.system.order, self._leading, as_given=as_given)

    def momentum(self, expression: Expr) -> Expression:
        """Term by term, or with the factor that all terms share before a bracket."""
        by_terms, short = self.by_terms(expression), self.as_written(expression)
        return (
            short
            if is_flat(short) and operation_count(short) < operation_count(by_terms)
            else by_terms
        )

    def on_surface(self, expression: Expr) -> Expression:
        """The shortest shape, with the constraints used."""
        return self.dynamics.shapes.shape(expression)
