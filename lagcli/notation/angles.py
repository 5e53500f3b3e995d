"""Sums of sines and cosines as a book has them: 1 - cos x, sin(a - b)."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from fractions import Fraction
from math import prod
from typing import TypeAlias

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Sum,
    quotient_of,
    walk,
)
from lagcli.notation.factors import parts_of, power_product, whole_power
from lagcli.notation.likeness import Key, multiplied_out, signed_key
from lagcli.notation.ordering import Ordering
from lagcli.record import record
from lagcli.rewriting import put_in

#: The letters of an angle with the numbers before them.
_Linear: TypeAlias = frozenset[tuple[str, Fraction]]

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


def without_halved_sines(
    above: list[Expression], below: list[Expression], given: Container[Key]
) -> tuple[list[Expression], list[Expression]]:
    """sin x cos x/m for sin 2 x/(2 m), but for an angle that the file has."""
    number = below[0].value if below and isinstance(below[0], Number) else Fraction(1)
    for place, factor in enumerate(above if number % 2 == 0 else ()):
        if isinstance(factor, Call) and factor.function == "sin":
            half = _half(factor.arguments[0])
            if not isinstance(half, Name) or signed_key(factor.arguments[0])[1] in given:
                continue
            waves = [Call(name, (half,)) for name in ("sin", "cos")]
            left = [Number(number / 2)] if number > 2 else []
            return [*above[:place], *waves, *above[place + 1 :]], [*left, *below[1:]]
    return above, below


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
    calls = [part for part in walk(node) if isinstance(part, Call) and len(part.arguments) == 1]
    angles = {signed_key(call.arguments[0])[1] for call in calls}
    for part in walk(node):
        match part:
            case Sum(terms=(Number(value=whole), term)):
                turned = False
            case Sum(terms=(term, Negative(operand=Number(value=whole)))):
                turned = True  # cos 2 x − 3
            case _:
                continue
        minus, above, below = parts_of(term)
        numbers = [f.value for f in above if isinstance(f, Number)]
        size = numbers[0] if numbers else Fraction(1)
        double = above[-1]
        if below or len(above) > len(numbers) + 1 or size >= whole:
            continue
        if isinstance(double, Call) and double.function == "cos":
            half = _half(double.arguments[0])
            if half is None or signed_key(half)[1] not in angles:
                continue
            square = Power(Call("cos" if minus == turned else "sin", (half,)), _TWO)
            sum_ = Sum((Number(whole - size), Product((Number(2 * size), square))))
            found[part] = Negative(sum_) if turned else sum_
    if not found:
        return node
    changed = put_in(node, found)
    doubles = {p.arguments for p in walk(changed) if isinstance(p, Call) and p.function in _OTHER}
    return node if any(_half(x) is not None for (x,) in doubles) else changed


def without_unlike_multiples(node: Expression, ordering: Ordering) -> Expression:
    """4 sin x − 3 sin y cos (x − y) for 5 sin x + 3 sin (x − 2 y) over 2, where x − y occurs.

    sin A − sin B = 2 cos ((A + B)/2) sin ((A − B)/2), cos A − cos B = −2 sin (…) sin (…).
    """
    angles = {p.arguments[0] for p in walk(node) if isinstance(p, Call) and p.function in _OTHER}
    angles |= {half for x in angles if (half := _half(x)) is not None}
    known = {frozenset(v.items()): x for x in angles if (v := _linear(x)) is not None}
    found: dict[Expression, Expression] = {}
    for part in walk(node) if len(known) > 1 else ():
        if isinstance(part, Sum):
            terms = _without_unlike(part.terms, known, ordering)
            if terms is not None:
                found[part] = Sum((*terms,)) if len(terms) > 1 else terms[0]
    return put_in(node, found) if found else node


def _without_unlike(
    terms: Sequence[Expression], known: Mapping[_Linear, Expression], ordering: Ordering
) -> list[Expression] | None:
    """The terms with the pairs in them rewritten; None where there are none."""
    waves = [_wave(term) for term in terms]
    for i, one in enumerate(waves):
        for j, other in enumerate(waves):
            if one is None or other is None or i == j or one.rest != other.rest:
                continue
            a, b = (_linear(w.call.arguments[0]) for w in (one, other))
            if one.call.function != other.call.function or a is None or b is None:
                continue
            if len({abs(c) for c in b.values()}) < 2 or len({abs(c) for c in a.values()}) > 1:
                continue
            zero = Fraction(0)
            middle, half = (
                {x: (a.get(x, zero) + s * b.get(x, zero)) / 2 for x in {**a, **b}} for s in (1, -1)
            )
            inner, outer = (_known(each, known) for each in (middle, half))
            if inner is None or outer is None:
                continue
            (first, sign), (second, turn) = inner, outer
            # B = A − 2 h: sin B = sin A − 2 cos m sin h, cos B = cos A + 2 sin m sin h
            sine = one.call.function == "sin"
            factor = -2 * turn if sine else 2 * sign * turn
            waved = [Call("cos" if sine else "sin", (first,)), Call("sin", (second,))]
            rest = [
                _times(one.number + other.number, [*one.rest, one.call], ordering),
                _times(factor * other.number, [*one.rest, *waved], ordering),
            ]
            shown = [term for term in rest if term is not None]
            left = [term for k, term in enumerate(terms) if k not in (i, j)]
            at = min(i, j)
            return [*left[:at], *shown, *left[at:]]
    return None


@record
class _Wave:
    """number × rest × sin x or cos x."""

    number: Fraction
    rest: tuple[Expression, ...]
    call: Call


def _wave(term: Expression) -> _Wave | None:
    minus, above, below = parts_of(term)
    calls = [f for f in above if isinstance(f, Call) and f.function in _OTHER and not f.primes]
    if len(calls) != 1 or below:
        return None
    numbers = [f.value for f in above if isinstance(f, Number)]
    rest = tuple(f for f in above if f is not calls[0] and not isinstance(f, Number))
    number = prod(numbers, start=Fraction(-1 if minus else 1))
    return _Wave(number, rest, calls[0])


def _times(
    number: Fraction, factors: Sequence[Expression], ordering: Ordering
) -> Expression | None:
    """The product, its factors in order; None of 0."""
    if not number:
        return None
    whole = power_product([Number(abs(number)), *factors], ordering)
    return Negative(whole) if number < 0 else whole


def _linear(angle: Expression) -> dict[str, Fraction] | None:
    """The numbers before the letters of x − 2 y; None of anything else."""
    value = multiplied_out(angle)
    if value is None or any(len(term) != 1 or next(iter(term))[1] != 1 for term in value):
        return None
    return {letter: number for term, number in value.items() for letter, _ in term}


def _known(
    angle: Mapping[str, Fraction], known: Mapping[_Linear, Expression]
) -> tuple[Expression, int] | None:
    """An angle that occurs, or the negative of one, and the sign."""
    for sign in (1, -1):
        found = known.get(frozenset((x, sign * c) for x, c in angle.items() if c))
        if found is not None:
            return found, sign
    letters = {repr(part): part for x in known.values() for part in walk(x)}
    parts = [(letters[x], c) for x, c in angle.items() if c and x in letters]
    # a letter alone, and x − z of x − y and y − z
    apart = {x for pair in known if len(pair) == 2 for x, _ in pair}
    some = len(parts) == 1 or (len(parts) == 2 and all(repr(x) in apart for x, _ in parts))
    whole = len(parts) == sum(map(bool, angle.values()))
    if not some or not whole or {abs(c) for _, c in parts} != {1}:
        return None
    first = parts[0][1]
    terms = [x if c == first else Negative(x) for x, c in parts]
    return (Sum((*terms,)) if len(terms) > 1 else terms[0]), int(first)


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
