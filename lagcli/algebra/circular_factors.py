"""Sines, cosines and tangents among the factors of a product."""

from __future__ import annotations

from fractions import Fraction

from lagcli.expression import Call, Expression, Negative, Number, Product, Sum
from lagcli.notation.ordering import Factor


def upright(coefficient: Fraction, pairs: list[Factor]) -> tuple[Fraction, list[Factor]]:
    """sin(-u) = -sin(u), cos(-u) = cos(u)."""
    found: list[Factor] = []
    for base, exponent in pairs:
        if isinstance(base, Call) and base.function in ("sin", "cos") and exponent.denominator == 1:
            (angle,) = base.arguments
            if isinstance(angle, Negative):
                base = Call(base.function, (angle.operand,))
                if base.function == "sin" and exponent % 2:
                    coefficient = -coefficient
        found.append((base, exponent))
    return coefficient, found


def single_angles(coefficient: Fraction, pairs: list[Factor]) -> tuple[Fraction, list[Factor]]:
    """sin(2x)/sin(x) as 2 cos(x), and sin(2x)/cos(x) as 2 sin(x)."""
    exponents = dict(pairs)
    for base, exponent in pairs:
        if not isinstance(base, Call) or base.function not in ("sin", "cos") or exponent >= 0:
            continue
        sine = Call("sin", (_doubled(base.arguments[0]),))
        power = exponents.get(sine, Fraction(0))
        if power <= 0 or power.denominator != 1:
            continue
        for function in ("sin", "cos"):
            half = Call(function, base.arguments)
            exponents[half] = exponents.get(half, Fraction(0)) + power
        del exponents[sine]
        coefficient *= 2 ** int(power)
    return coefficient, [pair for pair in exponents.items() if pair[1]]


def _doubled(node: Expression) -> Expression:
    """Twice an angle, as it is written: 2 a - 2 b."""
    match node:
        case Sum(terms=terms):
            return Sum(tuple(map(_doubled, terms)))
        case Negative(operand=operand):
            return Negative(_doubled(operand))
        case Product(factors=(Number(value=value), *rest)):
            return Product((Number(2 * value), *rest))
        case Product(factors=factors):
            return Product((Number(Fraction(2)), *factors))
        case _:
            return Product((Number(Fraction(2)), node))


_RATIOS = {"sin": ("cos", "tan"), "sinh": ("cosh", "tanh")}


def tangents(pairs: list[Factor]) -> list[Factor]:
    """sin(x)/cos(x) as tan(x), cos(x)/sin(x) as 1/tan(x)."""
    exponents = dict(pairs)
    for base, exponent in pairs:
        if not isinstance(base, Call) or base.function not in _RATIOS or base.primes:
            continue
        cosine, tangent = _RATIOS[base.function]
        other = Call(cosine, base.arguments)
        second = exponents.get(other, Fraction(0))
        if exponent * second >= 0:
            continue
        # sin^a cos^-b = tan^a cos^(a - b)
        if abs(exponent) == abs(second):
            del exponents[base], exponents[other]
            ratio = Call(tangent, base.arguments)
            exponents[ratio] = exponents.get(ratio, Fraction(0)) + exponent
    return list(exponents.items())
