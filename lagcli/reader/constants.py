"""Constant powers that are too large to write down, and divisions by a constant 0.

Nothing large is computed: a constant is followed exactly while it is small, and by the
number of its digits when it is not.  log10 of numerator and denominator of a power is
|exponent| times that of the base.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import inf, log10
from typing import NamedTuple

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
    name_nodes,
    postorder,
)
from lagcli.reader.builder import mistake
from lagcli.reader.limits import NUMBER_DIGITS
from lagcli.reader.text import Mistake

#: Functions without a value at 0.
_UNDEFINED_AT_ZERO = frozenset({"log", "cot", "csc"})


class _Constant(NamedTuple):
    """What is known of the number that a formula contains as a factor."""

    digits: float = 0.0  # log10 of the larger of numerator and denominator
    value: Fraction | None = None  # exactly, when the formula is a rational number not too large

    @classmethod
    def of(cls, value: Fraction) -> _Constant:
        """A number that is known exactly."""
        return cls(log10(max(abs(value.numerator), value.denominator)), value)


_NOTHING = _Constant()

#: Digits before the point up to which a double holds a number.
_DOUBLE = 300


def check_constants(*expressions: Expression) -> None:
    """`Mistake` with every power too large, and division by 0, among constants."""
    found: list[Diagnostic] = []
    for expression in expressions:
        if any(isinstance(node, Power | Quotient | Call) for node in postorder(expression)):
            _follow(expression, {}, found)
    if found:
        raise Mistake(*sorted(found, key=lambda diagnostic: diagnostic.span))


def rational_value(expression: Expression, known: Mapping[str, Fraction]) -> Fraction | None:
    """The number that an expression is for values of names; None where it is not known exactly."""
    wrong: list[Diagnostic] = []
    value = _follow(expression, known, wrong).value
    return None if wrong else value


def magnitude(expression: Expression) -> float:
    """The larger of numerator and denominator of the number that a formula contains as a factor."""
    found = _follow(expression, {}, [])
    if found.value is not None and found.digits < _DOUBLE:
        return max(abs(found.value.numerator), found.value.denominator)
    return 10**found.digits if found.digits < _DOUBLE else inf


def _follow(
    expression: Expression, known: Mapping[str, Fraction], wrong: list[Diagnostic]
) -> _Constant:
    """What is known of the whole, and in `wrong` the parts that have no value."""

    def value(node: Expression, parts: list[_Constant]) -> _Constant:
        if isinstance(node, Name) and node.primes == 0 and node.name in known:
            return _Constant.of(known[node.name])
        try:
            return _evaluated(node, parts)
        except Mistake as error:
            wrong.extend(error.diagnostics)
            return _NOTHING

    return folded(expression, value)


def _evaluated(node: Expression, parts: list[_Constant]) -> _Constant:
    found = _evaluate(node, parts)
    if found.digits > NUMBER_DIGITS:
        bound = f"{NUMBER_DIGITS:,}"
        what = "power" if isinstance(node, Power) else "number"
        message = f"a constant {what} of more than {bound} digits"
        raise mistake(message, node.span, f"the limit is {bound}")
    return found


def _evaluate(node: Expression, parts: list[_Constant]) -> _Constant:
    match node:
        case Number(value=value):
            return _Constant.of(value)
        case Negative():
            operand = parts[0].value
            return _Constant(parts[0].digits, None if operand is None else -operand)
        case Sum():
            return _sum(parts)
        case Product():
            return _product(parts)
        case Quotient():
            if parts[1].value == 0:
                raise mistake("division by zero", node.denominator.span)
            return _product([parts[0], _reciprocal(parts[1])])
        case Power():
            return _power(node, *parts)
        case Call(function=function) if function in _UNDEFINED_AT_ZERO and parts[0].value == 0:
            raise mistake(f"{function}(0) is not a number", node.span)
        case Call(function="sqrt", primes=0) if parts:
            return _Constant(parts[0].digits / 2)
        case _:
            return _NOTHING


def _sum(parts: list[_Constant]) -> _Constant:
    total = Fraction(0)
    for part in parts:
        if part.value is None:
            return _NOTHING
        total += part.value
        if max(total.numerator.bit_length(), total.denominator.bit_length()) > 4 * NUMBER_DIGITS:
            return _NOTHING
    return _Constant.of(total)


def _product(parts: list[_Constant]) -> _Constant:
    digits = sum(part.digits for part in parts)
    if digits > NUMBER_DIGITS:
        return _Constant(digits)
    product = Fraction(1)
    for part in parts:
        if part.value is None:
            return _Constant(digits)
        product *= part.value
    return _Constant.of(product)


def _reciprocal(part: _Constant) -> _Constant:
    return _Constant(part.digits, None if part.value is None else 1 / part.value)


def _power(node: Power, base: _Constant, exponent: _Constant) -> _Constant:
    if exponent.value is None:
        is_large = exponent.digits > NUMBER_DIGITS  # even 2 to it has no end
        return _Constant(inf if is_large and base.digits > 0 else 0.0)
    if exponent.value < 0 and base.value == 0:
        raise mistake("division by zero", node.span, "0 has no negative power")
    if base.digits == 0 or base.value == 0:
        exact = base.value is not None and exponent.value.denominator == 1
        return _Constant.of(_sign_power(base.value, exponent.value)) if exact else _NOTHING
    size = exponent.value.numerator / exponent.value.denominator if exponent.digits < 300 else inf
    digits = base.digits * abs(size)
    if base.value is None or exponent.value.denominator != 1 or digits > NUMBER_DIGITS:
        return _Constant(digits)
    return _Constant.of(base.value ** int(exponent.value))


def _sign_power(base: Fraction | None, exponent: Fraction) -> Fraction:
    """Powers of 0, 1 and -1, whatever the exponent."""
    if base == 0:
        return Fraction(1 if exponent == 0 else 0)
    return Fraction(1) if base == 1 or exponent % 2 == 0 else Fraction(-1)


def value_cycle(values: dict[str, Expression]) -> tuple[str, str] | None:
    """A parameter whose value needs itself, and the sentence on it; None without one."""
    from graphlib import CycleError, TopologicalSorter

    uses = {
        name: {node.name for node in name_nodes(value)} & values.keys()
        for name, value in values.items()
    }
    try:
        TopologicalSorter(uses).prepare()
    except CycleError as error:
        cycle = list(reversed(error.args[1]))
        return cycle[0], f"the value of '{cycle[0]}' needs itself: {' → '.join(cycle)}"
    return None
