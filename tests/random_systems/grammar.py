"""A reader of its own for formulas: text -> a function of numbers.

Shares nothing with lagcli, so that a mistake of its reader or writer shows.  A formula is a
closure that takes a table name -> value; velocities stand in it as `x'`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from mpmath import mp, mpf

Value = mpf
Names = Mapping[str, object]
Formula = Callable[[Names], mpf]

TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)|(?P<name>[^\W\d]\w*)(?P<primes>'*)"
    r"|(?P<sign>\*\*|[-+*/^(),=]))"
)
STEP = mpf(10) ** -12


class Unreadable(Exception):
    """The text is no formula."""


class Undefined(Exception):
    """The formula has no real value there."""


def read(text: str) -> Formula:
    """Read a formula; `left = right` is left - right."""
    parser = _Parser(_tokens(text))
    formula = parser.sum()
    if parser.take("="):
        right, left = parser.sum(), formula

        def formula(names):
            return left(names) - right(names)

    if parser.here is not None:
        raise Unreadable(f"{text!r} at {parser.here}")
    return formula


def sides(text: str) -> tuple[Formula, Formula]:
    """The two sides of an equation."""
    left, _, right = text.partition("=")
    return read(left), read(right)


def _tokens(text: str) -> list[tuple[str, str, int]]:
    found, at = [], 0
    text = text.strip()
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise Unreadable(f"{text!r} at {text[at:]!r}")
        kind = match.lastgroup if match.lastgroup != "primes" else "name"
        found.append((kind, match[kind], len(match["primes"] or "")))
        at = match.end()
    return found


class _Parser:
    def __init__(self, tokens):
        self.tokens, self.at = tokens, 0

    @property
    def here(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def take(self, *signs):
        if self.here is not None and self.here[0] == "sign" and self.here[1] in signs:
            self.at += 1
            return self.tokens[self.at - 1][1]
        return None

    def need(self, sign):
        if not self.take(sign):
            raise Unreadable(f"{sign} is missing at {self.here}")

    def sum(self):
        value = self.product()
        while sign := self.take("+", "-"):
            value = _binary(sign, value, self.product())
        return value

    def product(self):
        value = self.signed()
        while sign := self.take("*", "/"):
            value = _binary(sign, value, self.signed())
        return value

    def signed(self):
        if sign := self.take("-", "+"):
            value = self.signed()
            return (lambda names: -value(names)) if sign == "-" else value
        return self.power()

    def power(self):
        base = self.atom()
        if not self.take("^", "**"):
            return base
        return _binary("^", base, self.signed())

    def atom(self):
        if self.here is None:
            raise Unreadable("the formula ends too early")
        kind, text, primes = self.here
        self.at += 1
        if kind == "number":
            number = mpf(text)
            return lambda _: number
        if kind == "name":
            return self.name(text, primes)
        if text == "(":
            value = self.sum()
            self.need(")")
            return value
        raise Unreadable(f"{text!r} where a value must stand")

    def name(self, text, primes):
        if text == "diff" and self.take("("):
            return self.derivative()
        if text == "integral" and self.take("("):
            return self.integral()
        if not self.take("("):
            return _pi if text == "pi" else _lookup(text + "'" * primes)
        arguments = self.arguments()
        if text in FUNCTIONS and not primes:
            return _elementary(FUNCTIONS[text], arguments)
        slots = (1,) * primes
        return lambda names: _declared(names, text, slots, arguments)

    def integral(self):
        """integral(f, x, a, b): of f by x from a to b."""
        body = self.sum()
        self.need(",")
        by = self.here[1]
        self.at += 1
        self.need(",")
        low, high = self.arguments()
        return lambda names: mp.quad(lambda x: body(names | {by: x}), [low(names), high(names)])

    def arguments(self):
        found = [self.sum()]
        while self.take(","):
            found.append(self.sum())
        self.need(")")
        return found

    def derivative(self):
        start = self.at
        body = self.sum()
        self.need(",")
        if self.here[0] == "number":
            function, slots = self.tokens[start][1], []
            self.at -= 1
            while self.take(","):
                slots.append(int(self.here[1]))
                self.at += 1
            self.need(")")
            self.need("(")
            arguments = self.arguments()
            return lambda names: _declared(names, function, tuple(slots), arguments)
        by = self.here[1] + "'" * self.here[2]
        self.at += 1
        self.need(")")
        return lambda names: _slope(body, names, by)


def _slope(body, names, by):
    up, down = dict(names), dict(names)
    up[by], down[by] = names[by] + STEP, names[by] - STEP
    for name, formula in names.get("#definitions", {}).items():
        up[name], down[name] = formula(up), formula(down)
    return (body(up) - body(down)) / (2 * STEP)


def _pi(names):
    return +mp.pi


def _lookup(name):
    def look(names):
        value = names[name]
        if isinstance(value, mpf):
            return value
        if callable(value):
            return value(names)
        raise Unreadable(f"{name} is a function")

    def known(names):
        try:
            return look(names)
        except KeyError:
            raise Unreadable(f"unknown name {name}") from None

    return known


def _declared(names, function, slots, arguments):
    if function not in names:
        raise Unreadable(f"unknown function {function}")
    return names[function].slope(slots, [each(names) for each in arguments])


def _binary(sign, left, right):
    def value(names):
        a, b = left(names), right(names)
        if sign == "+":
            return a + b
        if sign == "-":
            return a - b
        if sign == "*":
            return a * b
        return _quotient(a, b) if sign == "/" else _power(a, b)

    return value


def _quotient(a, b):
    if b == 0:
        raise Undefined("division by 0")
    return a / b


def _power(a, b):
    if a == 0 and b < 0:
        raise Undefined("division by 0")
    if a < 0 and b != int(b):
        raise Undefined("root of a negative number")
    return a ** (int(b) if b == int(b) else b)


def _elementary(function, arguments):
    def value(names):
        try:
            found = function(*(each(names) for each in arguments))
        except (ZeroDivisionError, ValueError) as error:
            raise Undefined(str(error)) from None
        except TypeError as error:
            raise Unreadable(str(error)) from None
        if not isinstance(found, mpf):
            raise Undefined("not real")
        return found

    return value


FUNCTIONS = {
    name: getattr(mp, name)
    for name in (
        "sqrt exp log sign sin cos tan cot sec csc asin acos atan atan2 sinh cosh tanh"
        " asinh acosh atanh"
    ).split()
} | {"abs": abs}


class Unspecified:
    """A function that the file leaves unspecified, made definite: A exp(a.x) + B sin(b.x + c)."""

    def __init__(self, rng, arity):
        self.a = [mpf(rng.randint(-9, 9)) / 11 + mpf(1) / 23 for _ in range(arity)]
        self.b = [mpf(rng.randint(5, 19)) / 13 for _ in range(arity)]
        self.c, self.A, self.B = (mpf(rng.randint(1, 30)) / 17 for _ in range(3))

    def slope(self, slots, x):
        """The derivative by the arguments `slots`, counted from 1."""
        if len(x) != len(self.a) or any(slot > len(x) for slot in slots):
            raise Unreadable("an argument too many or too few")
        rise, turn = self.A, self.B
        for slot in slots:
            rise, turn = rise * self.a[slot - 1], turn * self.b[slot - 1]
        first = sum(a * each for a, each in zip(self.a, x, strict=True))
        second = sum(b * each for b, each in zip(self.b, x, strict=True))
        return rise * mp.exp(first) + turn * mp.sin(second + self.c + len(slots) * mp.pi / 2)
