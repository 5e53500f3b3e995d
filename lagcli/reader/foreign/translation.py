"""Atoms and functions of a foreign formula, and the whole of it."""

from __future__ import annotations

import re
from itertools import pairwise

from lagcli.reader.foreign.functions import Functions, bare
from lagcli.reader.foreign.sums import Part
from lagcli.reader.foreign.tokens import SIGNS, Token
from lagcli.reader.foreign.words import VELOCITIES, UnclearText, Vocabulary, function_named, meant
from lagcli.reader.habits import CASES, foreign_function, fraction

_DEEPEST = 30
#: How often `x.dot` and the like differentiate.
METHODS = {**dict.fromkeys("diff dt dot d der deriv derivative".split(), 1), "ddot": 2, "dd": 2}


def translated(text: str, names: Vocabulary) -> str:
    """The formula, or the equation, in the notation of a problem file; `UnclearText` if unclear."""
    return _Translation(text, names).whole()


class _Translation(Functions):
    """A foreign formula on its way."""

    def atom(self) -> Part:
        """A number, a name, a call or a group."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise UnclearText
        token = self.take()
        part = self._atom(token)
        self.depth -= 1
        return part

    def _atom(self, token: Token) -> Part:
        match token.kind:
            case "number":
                return self.number(token)
            case "raised" if fraction(token.text):
                return Part(f"({fraction(token.text)})", 3)
            case "name":
                return self.name(token)
            case "macro":
                return self.macro(token.text[1:])
            case "primes" if self.is_name(following := self.peek()) and following is not None:
                self.at += 1
                return self.named(following.text, primes=len(token.text))  # 'x
        sign = SIGNS.get(token.text, token.text)
        if sign == "(":
            inner = self.sum()
            self.closed(")")
            return self.with_primes(inner) if inner.level == 3 else Part(f"({inner.text})", 3)
        if sign == "|":
            self.bars += 1
            inner = self.sum()
            self.closed("|")
            self.bars -= 1
            return Part(f"abs({inner.text})", 3, is_call=True)
        if sign == "√":
            return Part(f"sqrt({bare(self.atom())})", 3, is_call=True)
        raise UnclearText

    def number(self, token: Token) -> Part:
        """With a decimal point, without groups of digits, and e for 6.67d-11 and 6.67*^-11."""
        text = re.sub(r"[dD]|\*\^", "e", re.sub(r"[' _fF]", "", token.text)).removesuffix("e0")
        if "," in text and self.calls:
            raise UnclearText  # f(1,234.5)
        if "," in text and text.index(",") < text.find("."):  # 1,234.5
            text = text.replace(",", "")
        elif "," in text:  # 1.234,5
            text = text.replace(".", "").replace(",", ".")
        comma, digits = self.peek(), self.peek(1)
        if comma is None or comma.text != "," or self.calls or "." in text or digits is None:
            return Part(text, 3)
        if digits.kind != "number" or digits.apart or len(digits.text) == 3:
            raise UnclearText
        self.at += 2
        return Part(f"{text}.{digits.text}", 3)

    def name(self, token: Token) -> Part:
        """A word, without its module."""
        return self.named(_indexed(re.sub(r"^[\w.]+(?:\.|::)", "", token.text)))

    def macro(self, word: str) -> Part:
        """LaTeX."""
        if word in {"frac", "dfrac", "tfrac"}:
            above, below = self.argument(), self.argument()
            return Part(f"{above.within(1)}/{below.within(2)}", 1)
        if word == "sqrt" and self.sign() == "(" and self.tokens[self.at].text == "[":
            degree = self.argument()
            return Part(f"{self.argument().within(3)}^(1/{degree.within(2)})", 2)
        if word == "sqrt":
            return Part(f"sqrt({bare(self.argument())})", 3, is_call=True)
        if word in {"dot", "ddot"}:
            name = self.argument().text + self.index()
            return self.named(name, primes=1 if word == "dot" else 2)
        if word in {"mathrm", "operatorname", "text", "mathit"}:
            self.closed("(")
            inner = self.take()
            self.closed(")")
            return self.named(inner.text)
        return self.named(word + self.index())

    def index(self) -> str:
        """The `_1` that stands behind a macro."""
        token = self.peek()
        is_index = token is not None and token.kind == "name" and token.text.startswith("_")
        return _indexed(self.take().text) if is_index else ""

    def argument(self) -> Part:
        """The argument of a macro: a group, or one letter or digit."""
        token = self.peek()
        if token is not None and token.kind == "number" and len(token.text) > 1:
            self.tokens[self.at] = token._replace(text=token.text[1:])
            return Part(token.text[0], 3)
        if self.sign() == "(":
            self.at += 1
            inner = self.sum()
            self.closed(")")
            return inner
        return self.atom()

    def named(self, word: str, primes: int = 0) -> Part:
        """A name with its primes and arguments."""
        if word in CASES or (word == "Σ" and word not in self.names.known):
            raise UnclearText
        primes += self.primes()
        function = function_named(word, self.names)
        if function and not primes:
            return self.call(function)
        if foreign_function(word) and self.sign() == "(" and word not in self.names.known:
            return self.foreign(word)
        if word in {"e", "E"} and word not in self.names.known and self.sign() == "^":
            return self.exponential()
        if word in {"e", "E"} and word not in self.names.known and self.sign() == "(":
            return self.call("exp")
        if word in self.names.functions:
            return self.applied(word + "'" * primes)
        if self.sign() == "(" and f"{word}.x" in self.names.components:
            raise UnclearText  # bob[1] is x or y
        word += self.index_behind(word)
        primes += self.primes()
        self.refuse_unknown_call(word)
        name, more = meant(word, self.names)
        if word in VELOCITIES and more and self.has_time:
            name, more = word, 0  # cos(omega*t), x - v*t
        primes += more
        is_letter = word in VELOCITIES and name != self.names.turning
        if is_letter and more and not (word == "v" and self.sign() == "^"):
            self.by_letter.add(name)
        if self.called_by_time():
            if name not in self.names.dependent or (more and "dot" not in word):
                raise UnclearText
            primes += self.primes()
        while self.sign() == "." and (method := self.peek(1)) and method.text in METHODS:
            self.at += 2
            arguments = self.arguments() if self.sign() == "(" else []
            if len(arguments) == 1 and arguments[0] != "t":
                return self.partial("diff", [name + "'" * primes, *arguments])
            primes += self.order(arguments) * METHODS[method.text]
        text = name + "'" * primes
        return Part(text, 1 if "*" in text else 3)

    def index_behind(self, word: str) -> str:
        """The index of x[0] and of dq(1), which is passed; from 0 where no name has one."""
        opening, index = self.peek(), self.peek(1)
        if opening is None or index is None or index.kind != "number" or self.sign(2) != ")":
            return ""
        place = str(int(index.text) + self.from_zero) if index.text.isdigit() else index.text
        numbered = meant(f"{word}{place}", self.names)[0] in self.names.known
        place = place if numbered else index.text
        if opening.text != "[" and (
            opening.text != "(" or word in self.names.known or not numbered
        ):
            return ""
        self.at += 3
        return place if numbered else f"_{place}"

    @property
    def has_time(self) -> bool:
        """Whether t stands in the formula, and not only as x(t)."""
        texts = ["", *(each.text for each in self.tokens), ""]
        return any(texts[k] == "t" and (texts[k - 1], texts[k + 1]) not in {("(", ")"), ("[", "]")}
                   for k in range(1, len(texts) - 1))  # fmt: skip

    @property
    def from_zero(self) -> bool:
        """Whether x[0] is the first of x1, x2."""
        pairs = pairwise(self.tokens)
        counted = any(one.text in {"(", "["} and other.text == "0" for one, other in pairs)
        return counted and not any(re.search(r"\D0$", each) for each in self.names.known)

    def refuse_unknown_call(self, word: str) -> None:
        """U(x) may be a function, x(t - 1) is an earlier time; k(x - 1) is a product."""
        opening, inside = self.peek(), self.peek(1)
        if self.sign() != "(" or opening is None or opening.apart or inside is None:
            return
        word = meant(word, self.names)[0]
        if word not in self.names.known and len(word) > 2:
            raise UnclearText
        alone = self.sign(2) == ")"
        if alone != (inside.text == "t") and (alone or word in self.names.coordinates):
            raise UnclearText


def _indexed(name: str) -> str:
    return re.sub(r"_\{\\?(\w+)\}", r"_\1", name)
