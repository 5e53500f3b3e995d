"""Atoms and functions of a foreign formula, and the whole of it."""

from __future__ import annotations

import re

from lagcli.expression import FUNCTIONS
from lagcli.reader.foreign.sums import Part, Sums, raised
from lagcli.reader.foreign.tokens import SIGNS, Token
from lagcli.reader.foreign.words import BY_LETTER, Unclear, Vocabulary, function_named, meant
from lagcli.reader.habits import CASES, fraction, habits

_DEEPEST = 30
_PRIMES = {"″": 2, "‴": 3}
_RATES = frozenset("Derivative derivative D ddt dt Dt der deriv diff dot".split())
_POWERS = frozenset("pow power Pow Power".split())
_SQUARES = frozenset("square sqr sq".split())
_FOREIGN = _RATES | _POWERS | _SQUARES | {"norm", "hypot", "Subscript"}


def translated(text: str, names: Vocabulary) -> str:
    """The formula, or the equation, in the notation of a problem file.

    Raises
    ------
    Unclear
        Where it is not known what is meant.
    """
    return _Translation(text, names).whole()


class _Translation(Sums):
    """A foreign formula on its way."""

    def atom(self) -> Part:
        """A number, a name, a call or a group."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise Unclear
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
        sign = SIGNS.get(token.text, token.text)
        if sign == "(":
            inner = self.sum()
            self.closed(")")
            return inner if inner.level == 3 else Part(f"({inner.text})", 3)
        if sign == "|":
            inner = self.sum()
            self.closed("|")
            return Part(f"abs({inner.text})", 3, is_call=True)
        if sign == "√":
            return Part(f"sqrt({_bare(self.atom())})", 3, is_call=True)
        raise Unclear

    def number(self, token: Token) -> Part:
        """With a decimal point, without groups of digits, and e for the d of Fortran."""
        text = re.sub(r"[dD]", "e", re.sub(r"[' _fF]", "", token.text)).removesuffix("e0")
        comma, digits = self.peek(), self.peek(1)
        if comma is None or comma.text != "," or self.depth > 1 or "." in text or digits is None:
            return Part(text, 3)
        if digits.kind != "number" or digits.apart or len(digits.text) == 3:
            raise Unclear
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
        if word == "sqrt":
            return Part(f"sqrt({_bare(self.argument())})", 3, is_call=True)
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
        if word in CASES:
            raise Unclear
        primes += self.primes()
        function = function_named(word, self.names)
        if function and not primes:
            return self.call(function)
        foreign = word in _FOREIGN or word in habits()["written_out"]
        if foreign and self.sign() == "(" and word not in self.names.known:
            return self.foreign(word)
        if word in {"e", "E"} and word not in self.names.known and self.sign() == "^":
            return self.exponential()
        if word in self.names.functions:
            return self.applied(word + "'" * primes)
        self.refuse_unknown_call(word)
        name, more = meant(word, self.names)
        primes += more
        if word in BY_LETTER and more:
            self.by_letter = name
        if self.called_by_time():
            if name not in self.names.coordinates or (more and "dot" not in word):
                raise Unclear
            primes += self.primes()
        if self.sign() == "." and (method := self.peek(1)) and method.text in {"diff", "dt"}:
            self.at += 2
            primes += self.order(self.arguments() if self.sign() == "(" else [])
        text = name + "'" * primes
        return Part(text, 1 if "*" in text else 3)

    def exponential(self) -> Part:
        """`exp(-a*x)` for e^(-a x)."""
        self.at += 1
        power = self.exponent()
        following = self.peek()
        if following is not None and not following.apart and self.begins(following):
            raise Unclear  # e^2x
        return Part(f"exp({_bare_text(power)})", 3, is_call=True)

    def refuse_unknown_call(self, word: str) -> None:
        """U(x) may be a function, x(t - 1) is an earlier time; k(x - 1) is a product."""
        opening, inside = self.peek(), self.peek(1)
        if self.sign() != "(" or opening is None or opening.apart or inside is None:
            return
        alone = self.sign(2) == ")"
        if alone != (inside.text == "t") and (alone or word in self.names.coordinates):
            raise Unclear

    def called_by_time(self) -> bool:
        """Whether `(t)` stands here, which is passed."""
        inside = self.peek(1)
        if self.sign() != "(" or inside is None or inside.text != "t" or self.sign(2) != ")":
            return False
        self.at += 3
        return True

    def primes(self) -> int:
        """How many primes stand here, which are passed."""
        token = self.peek()
        if token is None or token.kind != "primes":
            return 0
        self.at += 1
        return sum(_PRIMES.get(each, 1) for each in token.text)

    # Functions.

    def call(self, function: str) -> Part:
        """A function with its power and its argument: sin^2 x."""
        power = ""
        token = self.peek()
        if self.sign() == "^":
            self.at += 1
            power = self.exponent()
        elif token is not None and token.kind == "raised":
            self.at += 1
            power = raised(token.text)[1:]
        if power == "(-1)":
            function, power = f"a{function}", ""
            if function not in FUNCTIONS:
                raise Unclear
        part = self.applied(function) if self.sign() == "(" else self.without_brackets(function)
        return Part(f"{part.text}^{power}", 2) if power else part

    def applied(self, function: str) -> Part:
        """A function with its arguments in brackets."""
        if self.sign() != "(":
            raise Unclear
        arguments = self.arguments()
        if function == "atan" and len(arguments) == 2:
            function = "atan2"
        return Part(f"{function}({', '.join(arguments)})", 3, is_call=True)

    def without_brackets(self, function: str) -> Part:
        """`sin 2 x` and `cos theta`: numbers, then one name with its power."""
        text = ""
        while (token := self.peek()) is not None and token.kind == "number":
            text += self.power().text + "*"
        token = self.peek()
        if not self.is_name(token):
            if not text:
                raise Unclear
            return Part(f"{function}({text[:-1]})", 3, is_call=True)
        part = self.power()
        if part.level < 3 or self.sign() in {"/", "^"} or (text and function == "sqrt"):
            raise Unclear  # sin x^2, sin x/2
        text += part.text
        if part.text.rstrip("'") not in self.names.coordinates and self.is_name(self.peek()):
            raise Unclear  # cos a x
        return Part(f"{function}({text})", 3, is_call=True)

    def is_name(self, token: Token | None) -> bool:
        """Whether a token is a name and no function."""
        if token is None or token.kind not in {"name", "macro"}:
            return False
        return not function_named(token.text.lstrip("\\"), self.names)

    def arguments(self) -> list[str]:
        """What stands in brackets, between commas."""
        self.closed("(")
        self.depth += 1
        if self.sign() == ")":
            self.at += 1
            return []
        within = self.sign() == "(" and self.ends_list()
        self.at += within
        found = [self.sum().text]
        while self.sign() == ",":
            self.at += 1
            found.append(self.sum().text)
        for _ in range(1 + within):
            self.closed(")")
        self.depth -= 1
        return found

    def ends_list(self) -> bool:
        """Whether the arguments are one list, as in norm([x, y])."""
        texts = [SIGNS.get(each.text, each.text) for each in self.tokens[self.at :]]
        level = 0
        for place, text in enumerate(texts):
            level += {"(": 1, ")": -1}.get(text, 0)
            if level == 0:
                return texts[place + 1 : place + 2] == [")"] and "," in texts[:place]
        return False

    def foreign(self, word: str) -> Part:
        """A function of other programs."""
        arguments = self.arguments()
        if not arguments:
            raise Unclear
        grouped = [each if re.fullmatch(r"[\w.]+'*", each) else f"({each})" for each in arguments]
        if word in _RATES:
            x = arguments[0]
            if not re.fullmatch(r"\w+'*", x):
                return self.partial(word, arguments)
            if len(arguments) > 1 and arguments[1] != "t":
                return self.partial(word, arguments)
            rate = x + "'" * self.order(arguments[1:])
            self.called_by_time()
            return Part(rate, 3)
        if word in {"norm", "hypot"}:
            squares = " + ".join(f"{each}^2" for each in grouped)
            return Part(f"sqrt({squares})", 3, is_call=True)
        if word == "Subscript" and len(arguments) == 2:
            return self.named("_".join(arguments))
        if word in _SQUARES and len(arguments) == 1:
            return Part(f"{grouped[0]}^2", 2)
        if word in _POWERS and len(arguments) == 2:
            return Part(f"{grouped[0]}^{grouped[1]}", 2)
        form = habits()["written_out"].get(word, "")
        if form.count("{}") != len(arguments):
            raise Unclear
        text = form.format(*(grouped if "{}*" in form or "/{}" in form else arguments))
        return Part(text, 3 if form == "{}" and re.fullmatch(r"[\w.]+", text) else 1)

    def partial(self, word: str, arguments: list[str]) -> Part:
        """A derivative by a name other than t."""
        if word not in {"diff", "D"} or len(arguments) != 2 or arguments[1] == "t":
            raise Unclear
        return Part(f"diff({arguments[0]}, {arguments[1]})", 3, is_call=True)

    def order(self, arguments: list[str]) -> int:
        """How often is differentiated: (), (t), (t, t), (t, 2)."""
        if set(arguments) <= {"t"}:
            return max(1, len(arguments))
        if len(arguments) == 2 and arguments[0] == "t" and arguments[1].isdigit():
            return int(arguments[1])
        raise Unclear


def _indexed(name: str) -> str:
    return re.sub(r"_\{\\?(\w+)\}", r"_\1", name)


def _bare(part: Part) -> str:
    return _bare_text(part.text) if not part.is_call else part.text


def _bare_text(text: str) -> str:
    """Without the parentheses around it."""
    if not (text.startswith("(") and text.endswith(")")):
        return text
    depth = 0
    for place, each in enumerate(text):
        depth += {"(": 1, ")": -1}.get(each, 0)
        if depth == 0 and place + 1 < len(text):
            return text
    return text[1:-1]
