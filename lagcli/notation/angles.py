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
    walk,
)
from lagcli.notation.factors import parts_of, whole_power
from lagcli.rewriting import put_in

_TWO = Number(Fraction(2))


def with_versines(terms: Sequence[Expression]) -> list[Expression]:
    """a (1 − cos x) for a − a cos x, a (1 + sin² x) for a + a sin² x, among other terms."""
    found = list(terms)
    for term in terms:
        minus, above, below = parts_of(term)
        waves = [f for f in above if _is_cosine(f) or _is_square(f)]
        if len(waves) != 1 or len(above) == 1:
            continue
        (wave,) = waves
        rest = quotient_of([f for f in above if f is not wave], below)
        negative = minus == _is_square(wave)
        other = Negative(rest) if negative else rest
        if other in found and len(found) > 2:
            bracket = Sum((ONE, wave if _is_square(wave) else Negative(wave)))
            joined = quotient_of([*(f for f in above if f is not wave), bracket], below)
            found[found.index(other)] = Negative(joined) if negative else joined
            found.remove(term)
    return found


def _is_cosine(node: Expression) -> bool:
    return isinstance(node, Call) and node.function == "cos"


def _is_square(node: Expression) -> bool:
    """Whether it is sin² x or cos² x."""
    match node:
        case Power(base=Call(function="sin" | "cos"), exponent=exponent):
            return exponent == _TWO
        case _:
            return False


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


def without_tangents(factors: list[Expression]) -> list[Expression]:
    """(x sin u + z cos u) cos u for (x tan u + z) cos² u."""
    for place, factor in enumerate(factors):
        cosine, power = whole_power(factor)
        if not isinstance(cosine, Call) or cosine.function != "cos":
            continue
        tangent, sine = (Call(name, cosine.arguments) for name in ("tan", "sin"))
        for k, bracket in enumerate(factors):
            if not isinstance(bracket, Sum) or power < 1:
                continue
            parts = [parts_of(term) for term in bracket.terms]
            if not any(tangent in above for _, above, _ in parts):
                continue
            terms = []
            for minus, above, below in parts:
                over = [sine if f == tangent else f for f in above]
                over = over if tangent in above else [*(f for f in above if f != ONE), cosine]
                whole = quotient_of(over, below)
                terms.append(Negative(whole) if minus else whole)
            left = {1: [], 2: [cosine]}.get(power, [Power(cosine, Number(Fraction(power - 1)))])
            rest = [[*left] if j == place else [f] for j, f in enumerate(factors)]
            rest[k] = [Sum((*terms,))]
            return [f for each in rest for f in each]
    return factors


def with_single_angles(node: Expression) -> Expression:
    """1 + 2 cos² x for 2 + cos 2 x, where the other functions of x have x alone."""
    found: dict[Expression, Expression] = {}
    angles = {part.arguments for part in walk(node) if isinstance(part, Call)}
    for part in walk(node):
        match part:
            case Sum(terms=(Number(value=whole), term)):
                minus, above, below = parts_of(term)
                numbers = [f.value for f in above if isinstance(f, Number)]
                size = numbers[0] if numbers else Fraction(1)
                double = above[-1]
                if below or len(above) > len(numbers) + 1 or size >= whole:
                    continue
                if isinstance(double, Call) and double.function == "cos":
                    half = _half(double.arguments[0])
                    if half is None or (half,) not in angles:
                        continue
                    square = Power(Call("sin" if minus else "cos", (half,)), _TWO)
                    terms = (Number(whole - size), Product((Number(2 * size), square)))
                    found[part] = Sum(terms)
    if not found:
        return node
    changed = put_in(node, found)
    doubles = {p.arguments for p in walk(changed) if isinstance(p, Call) and p.function in _OTHER}
    return node if any(_half(x) is not None for (x,) in doubles) else changed


def _half(angle: Expression) -> Expression | None:
    """x of 2 x, x − y of 2 x − 2 y."""
    match angle:
        case Product(factors=(Number(value=value), *rest)) if value == 2:
            return quotient_of(rest, [])
        case Sum(terms=terms):
            halves = [_half(t.operand if isinstance(t, Negative) else t) for t in terms]
            pairs = zip(terms, halves, strict=True)
            whole = [Negative(h) if isinstance(t, Negative) else h for t, h in pairs if h]
            return Sum((*whole,)) if None not in halves else None
        case _:
            return None


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
