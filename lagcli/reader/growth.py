"""How fast a formula grows, through definitions too: exponentials inside each other, its degree.

exp(exp(exp(3))) has two hundred million digits before its point; one level more, and no
arithmetic holds the exponent.  A polynomial of degree 10^400 has no arithmetic either.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.diagnostics import Diagnostic
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    folded,
    postorder,
)
from lagcli.reader.constants import magnitude
from lagcli.reader.limits import DEGREE, EXPONENTIAL_LEVELS
from lagcli.reader.scope import Growth, Scope

_GROWING = frozenset({"exp", "sinh", "cosh"})


def growth(expression: Expression, scope: Scope) -> tuple[Growth, Diagnostic | None]:
    """The growth of an expression with its definitions, and what is too much."""
    wrong: list[Diagnostic] = []

    def grown(node: Expression, parts: list[Growth]) -> Growth:
        found = Growth(_levels(node, parts, scope), _degree(node, parts, scope))
        wrong.extend(_excess(node, found))
        return found

    return folded(expression, grown), next(iter(wrong), None)


def _excess(node: Expression, found: Growth) -> Iterator[Diagnostic]:
    if found.exponentials > EXPONENTIAL_LEVELS:
        message = f"more than {EXPONENTIAL_LEVELS} exponentials inside each other"
        yield Diagnostic(message, node.span, f"the limit is {EXPONENTIAL_LEVELS} levels")
    if found.degree > DEGREE:
        message = f"an expression of a degree beyond {DEGREE:,}"
        yield Diagnostic(message, node.span, f"the limit is {DEGREE:,}")


def _levels(node: Expression, parts: Sequence[Growth], scope: Scope) -> int:
    level = max((part.exponentials for part in parts), default=0)
    if isinstance(node, Name) and node.name in scope.definitions:
        return scope.definitions[node.name].growth.exponentials
    if isinstance(node, Call) and node.function in _GROWING:
        return level + 1
    if isinstance(node, Power) and not isinstance(node.exponent, Number):
        return max(parts[0].exponentials, parts[1].exponentials + _moves(node.exponent))
    return level


def _degree(node: Expression, parts: Sequence[Growth], scope: Scope) -> float:
    match node:
        case Name(name=name):
            known = scope.definitions.get(name)
            return 1 if known is None else max(1, known.growth.degree)
        case Product() | Quotient():
            return sum(part.degree for part in parts)
        case Power(exponent=exponent):
            return parts[0].degree * _factor(exponent) if parts[0].degree else 0
        case Sum() | Negative():
            return max(part.degree for part in parts)
        case Number():
            return 0
        case _:
            return max([1, *(part.degree for part in parts)])


def _factor(exponent: Expression) -> float:
    """By which the degree is multiplied: 1 for an exponent with names."""
    size = magnitude(exponent)
    return size if (size > 1 and not _moves(exponent)) or size > DEGREE else 1


def _moves(exponent: Expression) -> bool:
    return any(isinstance(node, Name | Call) for node in postorder(exponent))
