"""Families of equilibria as they are read: `x^2 + y^2 = a^2`, and what is free beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.decimals import written
from lagcli.expression import Expression
from lagcli.mechanics.rest.rest_conditions import RestPoint


def shown(point: RestPoint) -> Mapping[Symbol, Expr]:
    """The values that are printed: those that no relation gives."""
    return point.values if point.family is None else point.family.given


def untied(point: RestPoint, q: Sequence[Symbol]) -> tuple[Symbol, ...]:
    """The coordinates that may have any value."""
    tied = point.family.tied if point.family is not None else ()
    return tuple(s for s in q if s not in shown(point) and s not in tied)


def relation_sides(
    point: RestPoint, q: Sequence[Symbol], order: Sequence[str]
) -> tuple[Expression, Expression] | None:
    """The relation of a family, its terms with coordinates on the left."""
    if point.family is None:
        return None
    terms = sympy.Add.make_args(sympy.expand(point.family.relation))
    right = sympy.Add(*(-term for term in terms if free_of(term, q)))
    left = point.family.relation + right
    return written(sympy.expand(left), order), written(right, order)
