"""A unit as a file writes it: `kg m^2/s^2`, `N*m`, `1/s`, `kg·m²`, `J/(kg K)`.

    unit:   part (("*" | "·" | "/" | blank) part)*       from left to right
    part:   ("1" | name | "(" unit ")") ("^" exponent)?
    exponent: a whole number, or a fraction in parentheses; superscripts are read too

A product by a blank behind a `/` is refused: `J/kg m` is read in two ways.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from lagcli.units.table import meaning
from lagcli.units.unit import Unit

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_RAISED = frozenset("⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_DIGITS = frozenset("0123456789")
_TIMES = frozenset("*·⋅×")
#: Longer ones are nobody's unit.
_LONGEST = 200
_LARGEST = 100


class UnitMistake(Exception):
    """What is wrong in a unit, from character `start` to `end`, and what would be right."""

    def __init__(self, message: str, start: int, end: int, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.start, self.end, self.hint = message, start, end, hint


class _Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


def _tokens(text: str) -> Iterator[_Token]:
    """Names, numbers, raised digits and single marks; `**` is one mark."""
    at = 0
    while at < len(text):
        kind = _kind(text[at])
        end = at + 1
        if kind in {"name", "number", "raised"}:
            while end < len(text) and _goes_on(kind, text[end]):
                end += 1
        elif text[at : at + 2] == "**":
            end += 1
        if kind != "blank":
            yield _Token(kind, text[at:end], at, end)
        at = end


def _kind(character: str) -> str:
    if character in _RAISED:
        return "raised"
    if character in _DIGITS:
        return "number"
    if character.isspace():
        return "blank"
    return "name" if character.isalpha() or character in "%°" else "mark"


def _goes_on(kind: str, character: str) -> bool:
    """Whether a character belongs to the token before it."""
    if kind == "raised":
        return character in _RAISED
    if kind == "number":
        return character in _DIGITS or character == "."
    return character.isalpha() or character in _DIGITS or character == "_"


def read_unit(text: str) -> Unit:
    """The unit that a text writes.

    Raises
    ------
    UnitMistake
        When it writes none, with the place in the text.
    """
    if len(text) > _LONGEST:
        raise UnitMistake(f"a unit of more than {_LONGEST} characters", 0, _LONGEST)
    return _Reader(text).whole()


class _Reader:
    """Reads the tokens from left to right."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = list(_tokens(text))
        self.at = 0

    def whole(self) -> Unit:
        powers = self.product(depth=0)
        if (token := self.token) is not None:
            raise self.misplaced(token)
        return Unit(tuple((name, power) for name, power in powers.items() if power))

    def misplaced(self, token: _Token) -> UnitMistake:
        power = re.match(r"-\d+", self.text[token.start :])
        hint = f"a power is written with '^': ^{power[0]}" if power else ""
        hint = "write 1" if not re.search(r"\w|[%°]", self.text) else hint
        if token.text == ".":  # N.m-1
            hint = f"write {re.sub(r'(?<=[A-Za-z])(?=-?[0-9])', '^', self.text).replace('.', ' ')}"
        return self.mistake(f"'{token.text}' has no place in a unit", token, hint)

    @property
    def token(self) -> _Token | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def take(self, *texts: str) -> _Token | None:
        """The token, if it is one of these."""
        token = self.token
        if token is None or token.text not in texts:
            return None
        self.at += 1
        return token

    def product(self, depth: int) -> dict[str, Fraction]:
        powers = self.part(depth)
        divided: _Token | None = None
        while (token := self.token) is not None and token.text != ")":
            sign = 1
            if self.take("/"):
                sign, divided = -1, token
            elif not self.take(*_TIMES) and divided is not None:
                raise self.two_ways(divided, token)
            for name, power in self.part(depth).items():
                powers[name] = powers.get(name, Fraction(0)) + sign * power
        return powers

    def two_ways(self, divided: _Token, token: _Token) -> UnitMistake:
        below = self.text[divided.end : token.start].strip()
        rest = self.text[token.start :].split("/")[0].strip()
        hint = f"write …/({below} {rest}) or …/{below}*{rest}"
        start, end = divided.start, token.end
        return UnitMistake("a product behind '/' can be read in two ways", start, end, hint)

    def part(self, depth: int) -> dict[str, Fraction]:
        token = self.token
        if token is None:
            end = len(self.text)
            raise UnitMistake("a unit ends too early", max(0, end - 1), end, "such as kg m^2/s")
        self.at += 1
        if token.kind == "name":
            self.known(token)
            powers = {token.text: Fraction(1)}
        elif token.text == "(" and depth < _LONGEST:
            powers = self.product(depth + 1)
            if not self.take(")"):
                raise self.mistake("'(' is never closed", token)
        elif token.kind == "number":
            self.one(token)
            powers = {}
        else:
            raise self.misplaced(token)
        exponent = self.exponent()
        return {name: power * exponent for name, power in powers.items()}

    def one(self, token: _Token) -> None:
        if token.text != "1":
            hint = "write the number as the value"
            raise self.mistake("a unit has no number but 1", token, hint)

    def known(self, token: _Token) -> None:
        if meaning(token.text) is None:
            from lagcli.units.suggestion import suggestion

            raise self.mistake(f"unknown unit '{token.text}'", token, suggestion(token.text))

    def exponent(self) -> Fraction:
        token = self.token
        if token is not None and token.kind == "raised":
            self.at += 1
            return self.bounded(token, token.text.translate(_SUPERSCRIPTS))
        if self.take("^", "**") is None:
            return Fraction(1)
        if self.take("("):
            value = self.number()
            if self.take("/"):
                below = self.number()
                if below == 0:
                    raise self.mistake("a division by 0", self.tokens[self.at - 1])
                value /= below
            if not self.take(")"):
                raise self.expected("')'")
            return value
        return self.number()

    def number(self) -> Fraction:
        sign = -1 if self.take("-", "−") else 1
        token = self.token
        if token is None or token.kind != "number":
            raise self.expected("a number")
        self.at += 1
        return sign * self.bounded(token, token.text)

    def bounded(self, token: _Token, digits: str) -> Fraction:
        try:
            value = Fraction(digits)
        except ValueError:
            raise self.mistake(f"'{token.text}' is no exponent", token) from None
        if abs(value) > _LARGEST:
            raise self.mistake(f"an exponent above {_LARGEST}", token)
        return value

    def expected(self, what: str) -> UnitMistake:
        token = self.token
        if token is None:
            end = len(self.text)
            return UnitMistake(f"{what} is missing in a unit", max(0, end - 1), end)
        return self.mistake(f"{what} is missing before '{token.text}'", token)

    @staticmethod
    def mistake(message: str, token: _Token, hint: str = "") -> UnitMistake:
        return UnitMistake(message, token.start, token.end, hint)
