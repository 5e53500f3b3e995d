"""Sums of sines and cosines as a book has them: 1 - cos x, sin(a - b)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Negative,
    Number,
    Power,
    Product,
    Sum,
    quotient_of,
)
from lagcli.notation.factors import parts_of

_TWO = Number(Fraction(2))


def with_versines(terms: Sequence[Expression]) -> list[Expression]:
    """a (1 - cos x) for a - a cos x among other terms."""
    found = list(terms)
    for term in terms:
        minus, above, below = parts_of(term)
        cosines = [f for f in above if isinstance(f, Call) and f.function == "cos"]
        if len(cosines) != 1 or len(above) == 1:
            continue
        rest = quotient_of([f for f in above if f is not cosines[0]], below)
        other = rest if minus else Negative(rest)
        if other in found and len(found) > 2:
            versine = Sum((ONE, Negative(cosines[0])))
            joined = quotient_of([*(f for f in above if f is not cosines[0]), versine], below)
            found[found.index(other)] = joined if minus else Negative(joined)
            found.remove(term)
    return found


_OTHER = {"sin": "cos", "cos": "sin"}


def with_added_square(node: Sum) -> Sum:
    """1 + 2 cos² x for 3 − 2 sin² x."""
    match node.terms:
        case (Number(value=whole), Negative(operand=part)):
            minus, above, below = parts_of(part)
            numbers = [f.value for f in above if isinstance(f, Number)]
            squares = [f for f in above if isinstance(f, Power) and f.exponent == _TWO]
            size = numbers[0] if numbers else Fraction(1)
            if minus or below or len(numbers) + len(squares) != len(above) or size >= whole:
                return node
            match squares:
                case [Power(base=Call(function="sin" | "cos" as name, arguments=x))]:
                    square = Power(Call(_OTHER[name], x), _TWO)
                    term = Product((*(Number(n) for n in numbers), square)) if numbers else square
                    return Sum((Number(whole - size), term))
    return node


def difference_of_angles(one: Expression, other: Expression) -> Expression | None:
    """cos a cos b + sin a sin b = cos(a - b), sin a cos b - cos a sin b = sin(a - b)."""
    match (one, other):
        case (
            Product(factors=(Call(function="sin", arguments=(a,)), Call(arguments=(b,)) as second)),
            Product(factors=(Call(function="cos", arguments=(c,)), Call(arguments=(d,)) as fourth)),
        ) if (a, b) == (c, d) and second.function == "sin" and fourth.function == "cos":
            return Call("cos", (Sum((a, Negative(b))),))
        case (
            Product(factors=(Call(function="sin", arguments=(a,)), Call(arguments=(b,)) as second)),
            Negative(
                operand=Product(
                    factors=(Call(function="sin", arguments=(c,)), Call(arguments=(d,)) as fourth)
                )
            ),
        ) if (a, b) == (d, c) and second.function == fourth.function == "cos":
            return Call("sin", (Sum((a, Negative(b))),))
        case _:
            return None
