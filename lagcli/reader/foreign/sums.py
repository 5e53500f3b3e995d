"""Sums, products and powers of a foreign formula; their atoms are in `translation`."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from math import factorial
from typing import NamedTuple

from lagcli.reader.foreign.tokens import SIGNS, Token, prepared, tokens
from lagcli.reader.foreign.words import UnclearText, Vocabulary
from lagcli.reader.habits import fraction, superscript

#: What stands behind an angle or a ratio, and what it multiplies it by.
_BEHIND = {
    **dict.fromkeys(["%", "percent"], "/100"),
    **dict.fromkeys(["°", "˚", "º", "deg", "degree", "degrees"], "*pi/180"),
    **dict.fromkeys(["rad", "radian", "radians"], ""),
}
#: Powers in words.
_WORDS = {"squared": 2, "cubed": 3}
_PRIMES = {"″": 2, "‴": 3}


class Part(NamedTuple):
    """A part in the notation of the format."""

    text: str
    level: int  # 0 a sum, 1 a product, 2 a power, 3 an atom
    is_call: bool = False

    def within(self, level: int) -> str:
        """In parentheses where it binds less than the level."""
        return self.text if self.level >= level else f"({self.text})"


class Sums(ABC):
    """One text on its way; each method takes a part of it from the left."""

    def __init__(self, text: str, names: Vocabulary) -> None:
        self.tokens = tokens(prepared(text, names), names)
        self.names = names
        self.at = 0
        self.depth = 0
        self.calls = 0  # around the place, whose commas are between arguments
        self.bars = 0  # |, that are open
        self.by_letter: set[str] = set()  # the coordinates whose velocity was called v or ω

    def whole(self) -> str:
        """Everything: a formula, an equation or a comparison."""
        sides = [self.sum().text]
        while self.sign() in {"=", ">=", "<=", ">", "<"}:
            sides += [self.take().text, self.sum().text]
        if self.at < len(self.tokens):
            raise UnclearText
        text = " ".join(SIGNS.get(each, each) for each in sides)
        if self.by_letter & {*re.findall(r"\b\w+\b(?!')", text)}:
            raise UnclearText  # ω beside θ may be a parameter
        return text

    # What comes next.

    def peek(self, ahead: int = 0) -> Token | None:
        """The next token, or one behind it."""
        place = self.at + ahead
        return self.tokens[place] if place < len(self.tokens) else None

    def sign(self, ahead: int = 0) -> str:
        """The next sign as the format has it; nothing where none is."""
        token = self.peek(ahead)
        if token is None or token.kind not in {"sign", "macro"}:
            return ""
        return SIGNS.get(token.text, token.text if token.kind == "sign" else "")

    def take(self) -> Token:
        """The next token, which is passed."""
        token = self.peek()
        if token is None:
            raise UnclearText
        self.at += 1
        return token

    def closed(self, sign: str) -> None:
        """Pass this sign."""
        if self.sign() != sign:
            raise UnclearText
        self.at += 1

    # Sums, products and powers.

    def sum(self) -> Part:
        """Products with + and - between them."""
        text, level, is_call = "", 0, False
        while True:
            sign = self.sign()
            minus = sign == "-"
            if sign in {"-", "+"}:
                self.at += 1
            part = self.product()
            if not text:
                text, level = ("-" if minus else "") + part.text, 1 if minus else part.level
                is_call = part.is_call and not minus
            else:
                text, level, is_call = f"{text} {'-' if minus else '+'} {part.text}", 0, False
            if self.sign() not in {"-", "+"}:
                return Part(text, level, is_call)

    def product(self) -> Part:
        """Powers with or without a sign between them."""
        first = self.power()
        text, level, last, over = first.within(1), first.level, first, False
        while True:
            sign, token = self.sign(), self.peek()
            if sign in {"*", "/"}:
                self.at += 1
                minus = self.sign() == "-"
                self.at += minus
                part = self.power()
                text += sign + (f"(-{part.within(2)})" if minus else part.within(2))
                over = sign == "/"
            elif token is not None and self.begins(token):
                above = text.rpartition("*")[2].partition("/")[0]
                tells = _number(last.text) and (
                    _number(above)
                    or (token.apart and (self.sign() == "(" or "*" not in text.partition("/")[0]))
                )
                if token.kind == "number":
                    raise UnclearText  # x 2
                part = self.power()
                factor = part.text if _is_names(part.text) else part.within(2)
                tells |= _number(last.text) and re.search(r"'|\)\^2$", factor) is not None
                moving = {*re.findall(r"[^\W\d]\w*", factor)} & {*self.names.coordinates}
                of_number = _number(last.text) and factor[0] == "(" and not self.names.momenta
                tells |= of_number and bool(moving)  # k/4(x + a)
                if not over or tells or (last.text[:1] == factor[:1] == "("):
                    text += f"*{factor}"
                    over = False
                elif not token.apart and last.level == 3 and not last.text.startswith("("):
                    head = text[: len(text) - len(last.within(2))]
                    text = f"{head}({last.text}*{factor})"  # p^2/2m
                else:
                    raise UnclearText
            else:
                return Part(text, level, first.is_call if level == 3 else False)
            last, level = part, 1

    def begins(self, token: Token) -> bool:
        """Whether a factor begins here, with no sign before it."""
        if token.kind == "sign" or token.text in SIGNS:
            return SIGNS.get(token.text, token.text) in {"(", "√", "" if self.bars else "|"}
        return token.kind != "primes"

    def power(self) -> Part:
        """An atom and its exponents."""
        base = self.atom()
        while True:
            token = self.peek()
            if self.sign() == "^":
                self.at += 1
                exponent = self.exponent()
                base = _raise(self.with_primes(base), "^" + exponent)
            elif token is not None and token.kind == "raised" and not fraction(token.text):
                self.at += 1
                base = _raise(base, raised(token.text))
            elif token is not None and token.text == "!" and re.fullmatch(r"1?\d", base.text):
                self.at += 1
                base = Part(str(factorial(int(base.text))), 3)
            elif (
                token is not None
                and not token.apart
                and base.text[-1:] == "'"
                and token.text in {*"234"}
            ):
                self.at += 1
                base = _raise(base, f"^{token.text}")  # x'2
            elif token is not None and token.text in _WORDS and token.text not in self.names.known:
                self.at += 1
                base = _raise(self.with_primes(base), f"^{_WORDS[token.text]}")
            elif token is not None and base.level == 3 and token.text in _BEHIND:
                self.at += 1
                base = Part(base.text + _BEHIND[token.text], 1 if _BEHIND[token.text] else 3)
                following = self.peek()
                if "/100" in base.text and following is not None and self.begins(following):
                    raise UnclearText  # x % 2, or a comment of TeX
            else:
                return base

    def exponent(self) -> str:
        """What stands behind ^."""
        minus = self.sign() == "-"
        self.at += minus
        part = self.atom()
        if self.sign() == "^":
            raise UnclearText
        return f"(-{part.within(2)})" if minus else part.within(3)

    def primes(self) -> int:
        """How many primes stand here, which are passed."""
        token = self.peek()
        if token is None or token.kind != "primes":
            return 0
        self.at += 1
        return sum(_PRIMES.get(each, 1) for each in token.text)

    def with_primes(self, part: Part) -> Part:
        """`x'` for (x)' and x^2'."""
        primes = self.primes()
        if primes and not re.fullmatch(r"\w+'*", part.text):
            raise UnclearText
        return part._replace(text=part.text + "'" * primes)

    @abstractmethod
    def atom(self) -> Part:
        """A number, a name, a call or a group."""


def _is_names(text: str) -> bool:
    return re.fullmatch(r"[\w*]+'*(?:\^[\w.]+)?", text) is not None


def _raise(base: Part, power: str) -> Part:
    """A power; of the last letter where a name means a product, as in mx^2.

    A modulus has none in an even power: |x'|^2.
    """
    if base.is_call and base.text.startswith("abs(") and power in {"^2", "^4"}:
        inner = base.text[4:-1]
        base = Part(inner, 3 if re.fullmatch(r"\w+'*", inner) else 0)
    if base.level == 1 and _is_names(base.text):
        return Part(base.text + power, 1)
    return Part(base.within(3) + power, 2)


def raised(text: str) -> str:
    """`^2` for ², `^(-1)` for ⁻¹."""
    minus, digits = text.startswith("⁻"), text.lstrip("⁻")
    power = superscript(digits)
    if not power:
        raise UnclearText
    return f"^(-{power[1:]})" if minus else power


def _number(text: str) -> bool:
    return re.fullmatch(r"-?[\d.]+", text) is not None
