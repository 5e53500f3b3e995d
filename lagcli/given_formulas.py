"""The order of the letters in a product: m g l, as the file first multiplies them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from lagcli.expression import Expression, Name, Negative, Power, Product, Quotient, Sum, walk
from lagcli.problem_data import Problem

_PARTS = (
    "definitions", "points", "kinetic", "potential", "lagrangian", "hamiltonian", "forces",
    "dissipation", "symmetries", "observables", "initial", "find",
)  # fmt: skip


def given(problem: Problem) -> Iterator[Expression]:
    """The formulas of the file that say what the system is."""
    for name in _PARTS:
        yield from expressions(getattr(problem, name))
    for constraint in problem.constraints:
        left, right = constraint.equation.left, constraint.equation.right
        yield from (left, right)


def expressions(value: object) -> Iterator[Expression]:
    """The outermost formulas in a value: a map, a tuple, a record."""
    if isinstance(value, Expression):
        yield value
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from expressions(part)
    elif isinstance(value, tuple):
        for part in value:
            yield from expressions(part)
    elif hasattr(value, "__match_args__") or hasattr(type(value), "__dataclass_fields__"):
        for name in getattr(type(value), "__dataclass_fields__", ()):
            yield from expressions(getattr(value, name))


def order_of_names(problem: Problem) -> tuple[str, ...]:
    """Parameters, t, coordinates, momenta, velocities, accelerations, multipliers."""
    q = [coordinate.name for coordinate in problem.coordinates]
    fast = (spelled.format(name) for spelled in ("p_{}", "{}'", "{}''") for name in q)
    multipliers = (constraint.multiplier for constraint in problem.constraints)
    return (*order_of_parameters(problem), "t", *q, *fast, *multipliers)


def order_of_parameters(problem: Problem) -> list[str]:
    """The parameters, each before those that it precedes in the first product of both.

    Where products do not decide, or contradict each other, as they are declared.
    """
    names = [parameter.name for parameter in problem.parameters]
    before: set[tuple[str, str]] = set()
    products = (p for node in given(problem) for p in walk(node) if isinstance(p, Product))
    for row in (row for product in products for row in _multiplied(product)):
        letters = dict.fromkeys(name for name in row if name in names)
        before.update(pair for pair in combinations(letters, 2) if pair[::-1] not in before)
    ordered: dict[str, None] = {}
    begun: set[str] = set()

    def place(name: str) -> None:
        if name not in begun:
            begun.add(name)
            for other in names:
                if (other, name) in before:
                    place(other)
            ordered[name] = None

    for name in names:
        place(name)
    return list(ordered)


def _letters(node: Expression) -> Iterator[str]:
    """The names among the factors of a product, from left to right."""
    match node:
        case Name(name=name):
            yield name
        case Negative(operand=inner) | Quotient(numerator=inner) | Power(base=inner):
            yield from _letters(inner)
        case Product(factors=factors):
            for factor in factors:
                yield from _letters(factor)


def _multiplied(node: Product) -> Iterator[list[str]]:
    """The names that it multiplies, also into the square of a sum: k, r and k, l of k (r − l)²."""
    yield [*_letters(node)]
    for factor in node.factors:
        base = factor.base if isinstance(factor, Power) else None
        for term in base.terms if isinstance(base, Sum) else ():
            parts = (term if part is factor else part for part in node.factors)
            yield [name for part in parts for name in _letters(part)]
