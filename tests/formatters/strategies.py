"""Random formulas, the shape two of them must share, and their values."""

from __future__ import annotations

import math
from fractions import Fraction

from hypothesis import strategies as st

from lagcli.expression import (
    Call,
    Diff,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    walk,
)

NAMES = ("x", "theta", "theta_1", "lambda_rolling", "p_theta", "phase", "omega_max", "pi", "α")

numbers = st.builds(
    lambda p, q: Number(Fraction(p, q)),
    st.integers(1, 999),
    st.sampled_from([1, 1, 1, 2, 3, 10]),
)
names = st.builds(Name, st.sampled_from(NAMES), st.integers(0, 2))
leaves = st.one_of(numbers, names)


def _larger(parts):
    several = st.lists(parts, min_size=2, max_size=4).map(tuple)
    return st.one_of(
        st.builds(Negative, parts),
        st.builds(Sum, several),
        st.builds(Product, several),
        st.builds(Quotient, parts, parts),
        st.builds(Power, parts, parts),
        st.builds(
            lambda f, x: Call(f, (x,)), st.sampled_from(["sin", "sqrt", "log", "abs"]), parts
        ),
        st.builds(lambda x, y: Call("atan2", (x, y)), parts, parts),
        st.builds(lambda x, n: Call("U", (x,), n), parts, st.integers(0, 2)),
        st.builds(lambda a, b: PartialCall("Phi", (1, 2), (a, b)), parts, parts),
        st.builds(Diff, parts, st.builds(Name, st.just("x"), st.integers(0, 1))),
    )


expressions = st.recursive(leaves, _larger, max_leaves=12)


def has_refused_constants(node) -> bool:
    """Whether the reader may refuse it: a constant 1/0, or a power of a million digits."""
    return any(
        isinstance(part, (Quotient, Power, Call, Product))
        and not any(isinstance(each, Name) for each in walk(part))
        for part in walk(node)
    )


def shape(node):
    """The tree up to associativity, with a fraction as the quotient it is written as."""
    match node:
        case Number(value=value) if value.denominator != 1:
            return ("/", str(value.numerator), str(value.denominator))
        case Number(value=value):
            return str(value)
        case Name():
            return str(node)
        case Negative(operand=a):
            return ("-", shape(a))
        case Sum(terms=parts):
            return ("+", *_flat("+", map(shape, parts)))
        case Product(factors=parts):
            return ("*", *_flat("*", map(shape, parts)))
        case Quotient(numerator=a, denominator=b):
            return ("/", shape(a), shape(b))
        case Power(base=a, exponent=b):
            return ("^", shape(a), shape(b))
        case Call(function=f, arguments=parts, primes=n):
            return (f + "'" * n, *map(shape, parts))
        case PartialCall(function=f, indices=indices, arguments=parts):
            return (f, indices, *map(shape, parts))
        case Diff(operand=a, variable=x):
            return ("diff", shape(a), shape(x))
    raise TypeError(node)


def _flat(operation, shapes):
    for each in shapes:
        if isinstance(each, tuple) and each[0] == operation:
            yield from each[1:]
        else:
            yield each


def value(node) -> complex:
    """A number that tells formulas apart: unspecified functions are some function."""
    match node:
        case Number(value=number):
            return complex(number)
        case Name(name=name, primes=primes):
            return _scatter(name.replace("α", "alpha"), primes)
        case Negative(operand=a):
            return -value(a)
        case Sum(terms=parts):
            return sum(map(value, parts))
        case Product(factors=parts):
            return math.prod(map(value, parts))
        case Quotient(numerator=a, denominator=b):
            return value(a) / value(b)
        case Power(base=a, exponent=b):
            return value(a) ** value(b)
        case Call(function="sqrt", arguments=(a,)):
            return value(a) ** 0.5
        case Call(function=f, arguments=parts, primes=n):
            return _combined(f, n, map(value, parts))
        case PartialCall(function=f, indices=indices, arguments=parts):
            return _combined(f, indices, map(value, parts))
        case Diff(operand=a, variable=x):
            return _combined("diff", 0, (value(a), value(x)))
    raise TypeError(node)


def _scatter(*key) -> complex:
    """A fixed number for each name, neither real nor large."""
    total = sum((i + 1) * ord(c) for i, c in enumerate(repr(key)))
    return complex(0.5 + (total % 97) / 97, 0.1 + (total % 31) / 50)


def _combined(*key_and_values) -> complex:
    *key, values = key_and_values
    result = _scatter(*key)
    for i, part in enumerate(values, 1):
        result = result * (0.7 + 0.1 * i) + part / (1 + abs(part)) * (i + 0.3j)
    return result
