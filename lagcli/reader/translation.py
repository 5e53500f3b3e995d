"""A formula in the notation of a book or of another program, in that of a problem file.

It is read as its author reads it: products without a sign, LaTeX, raised digits, the brackets
of Mathematica, the modules of Python, x(t), dx/dt, ẋ and xdot.  What may mean two things is not
translated.  Nothing is solved with it: the text goes into a hint, once the reader accepts it.
"""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

from lagcli.expression import FUNCTIONS
from lagcli.reader.habits import fraction, habits, meanings, product_meant, superscript
from lagcli.reader.suggest import alike


class Unclear(Exception):
    """The text means nothing that is known, or may mean two things."""


class Vocabulary(NamedTuple):
    """The names of a file."""

    coordinates: tuple[str, ...]
    others: frozenset[str]  #: parameters, definitions, multipliers, t and pi
    functions: frozenset[str] = frozenset()
    momenta: bool = False

    @property
    def known(self) -> tuple[str, ...]:
        """Everything that may stand alone."""
        momenta = [f"p_{each}" for each in self.coordinates] if self.momenta else []
        return (*self.coordinates, *self.others, *momenta)


class _Part(NamedTuple):
    text: str
    level: int  # 0 a sum, 1 a product, 2 a power, 3 an atom
    is_call: bool = False

    def within(self, level: int) -> str:
        return self.text if self.level >= level else f"({self.text})"


class _Token(NamedTuple):
    kind: str
    text: str
    apart: bool  # a blank stands before it


_DEEPEST = 30
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻½⅓⅔¼¾⅛"
_LETTER = rf"[^\W\d{_RAISED}]"
_TOKEN = re.compile(
    r"(?P<skip>(?:\s|\$|\\[,;:! ]|\\(?:left|right|[bB]igg?[lr]?|q?quad|displaystyle|limits)(?![A-Za-z]))+)"
    r"|(?P<number>(?:\d{1,3}(?:[' _]\d{3})+(?![\w.])|\d+(?:\.\d+)?|\.\d+|\d+\.)(?:[eEdD][-+]?\d+)?(?=[^\W_]?))"
    r"|(?P<macro>\\[A-Za-z]+)"
    rf"|(?P<name>(?:(?:np|numpy|math|Math|sp|sympy|cmath|std|jnp)(?:\.|::))?{_LETTER}"
    rf"(?:[\w\u0300-\u036f](?<![{_RAISED}]))*(?:(?<=_)\{{\w+\}})?)"
    rf"|(?P<raised>[⁻{_RAISED}]+)"
    r"|(?P<primes>['’′″‴`´]+)"
    r"|(?P<sign>\*\*|\.\^|\.\*|\./|==|:=|>=|<=|\\[{}|]|\S)"
)  # fmt: skip
_SIGNS = {
    **dict.fromkeys(["·", "×", "∙", "⋅", "∗", "•", ".*", "\\cdot", "\\times", "\\ast"], "*"),
    **dict.fromkeys(["÷", "∕", "⁄", "./", "\\div"], "/"),
    **dict.fromkeys(["−", "–", "—", "‐", "‑"], "-"),
    **dict.fromkeys(["**", ".^"], "^"),
    **dict.fromkeys(["==", ":="], "="),
    **dict.fromkeys(["≥", "\\ge", "\\geq", "\\geqslant"], ">="),
    **dict.fromkeys(["≤", "\\le", "\\leq", "\\leqslant"], "<="),
    "\\{": "(", "\\}": ")", "[": "(", "]": ")", "{": "(", "}": ")", "\\|": "|",
}  # fmt: skip
_PRIMES = {"″": 2, "‴": 3}
_DOTS = {"\u0307": 1, "\u0308": 2}
_RATES = frozenset("Derivative derivative D ddt dt Dt der deriv diff dot".split())


def translated(text: str, names: Vocabulary) -> str:
    """The formula, or the equation, in the notation of a problem file.

    Raises
    ------
    Unclear
        Where it is not known what is meant.
    """
    return _Translation(_leibniz(text, names), names).whole()


def _leibniz(text: str, names: Vocabulary) -> str:
    """A prime for each dx/dt, d/dt x and \\frac{dx}{dt}."""
    for x in sorted(names.coordinates, key=len, reverse=True):
        d, name = r"(?:d|\\mathrm\{?d\}?|∂|\\partial)\s*", rf"\\?{re.escape(x)}(?!\w)(?:\(t\))?"
        for order, above, below in ((1, "", ""), (2, r"(?:\^\{?2\}?|²)", r"(?:\^\{?2\}?|²)")):
            prime = x + "'" * order
            forms = [
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*{name}\s*\}}\{{\s*{d}t{below}\s*\}}",
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*\}}\{{\s*{d}t{below}\s*\}}\s*{name}",
                rf"(?<!\w){d}{above}\s*{name}\s*/\s*\(?{d}t{below}\)?(?!\w)",
                rf"(?<!\w){d}{above}\s*/\s*\(?{d}t{below}\)?\s*(?:\({name}\)|{name})",
            ]
            for form in forms:
                text = re.sub(form, lambda _, prime=prime: f" {prime} ", text)
    return text


def _tokens(text: str) -> list[_Token]:
    found = []
    at, apart = 0, False
    while at < len(text):
        match = _TOKEN.match(text, at)
        assert match is not None
        at = match.end()
        kind = match.lastgroup or ""
        if kind != "skip":
            found.append(_Token(kind, match[0], apart))
        apart = kind == "skip"
    return found


class _Translation:
    """One text on its way; each method takes a part of it from the left."""

    def __init__(self, text: str, names: Vocabulary) -> None:
        self.tokens = _tokens(text.strip().rstrip(";,"))
        self.names = names
        self.at = 0
        self.depth = 0

    def whole(self) -> str:
        sides = [self.sum().text]
        while self.sign() in {"=", ">=", "<=", ">", "<"}:
            sides += [self.take().text, self.sum().text]
        if self.at < len(self.tokens):
            raise Unclear
        return " ".join(_SIGNS.get(each, each) for each in sides)

    # What comes next.

    def peek(self, ahead: int = 0) -> _Token | None:
        place = self.at + ahead
        return self.tokens[place] if place < len(self.tokens) else None

    def sign(self, ahead: int = 0) -> str:
        token = self.peek(ahead)
        if token is None or token.kind not in {"sign", "macro"}:
            return ""
        return _SIGNS.get(token.text, token.text if token.kind == "sign" else "")

    def take(self) -> _Token:
        token = self.peek()
        if token is None:
            raise Unclear
        self.at += 1
        return token

    def closed(self, sign: str) -> None:
        if self.sign() != sign:
            raise Unclear
        self.at += 1

    # Sums, products and powers.

    def sum(self) -> _Part:
        text, level = "", 0
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
                return _Part(text, level, is_call)

    def product(self) -> _Part:
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
                numbers = _number(last.text) and _number(text.rpartition("*")[2].partition("/")[0])
                part = self.power()
                factor = part.text if _is_names(part.text) else part.within(2)
                if not over or numbers:
                    text += f"*{factor}"
                    over = False
                elif not token.apart and last.level == 3 and not last.text.startswith("("):
                    head = text[: len(text) - len(last.within(2))]
                    text = f"{head}({last.text}*{factor})"  # p^2/2m
                else:
                    raise Unclear
            else:
                return _Part(text, level, first.is_call if level == 3 else False)
            last, level = part, 1

    def begins(self, token: _Token) -> bool:
        if token.kind == "sign" or token.text in _SIGNS:
            return _SIGNS.get(token.text, token.text) in {"(", "√"}
        return token.kind != "primes"

    def power(self) -> _Part:
        base = self.atom()
        while True:
            token = self.peek()
            if self.sign() == "^":
                self.at += 1
                base = _raise(base, "^" + self.exponent())
            elif token is not None and token.kind == "raised" and not fraction(token.text):
                self.at += 1
                base = _raise(base, _raised(token.text))
            else:
                return base

    def exponent(self) -> str:
        minus = self.sign() == "-"
        self.at += minus
        part = self.atom()
        if self.sign() == "^":
            raise Unclear
        return f"(-{part.within(2)})" if minus else part.within(3)

    # Atoms.

    def atom(self) -> _Part:
        self.depth += 1
        if self.depth > _DEEPEST:
            raise Unclear
        token = self.take()
        part = self._atom(token)
        self.depth -= 1
        return part

    def _atom(self, token: _Token) -> _Part:
        match token.kind:
            case "number":
                following = self.peek()
                text = re.sub(r"[' _]", "", token.text)
                text = re.sub(r"[dD]", "e", text)
                if text.endswith("e0"):
                    text = text[:-2]
                comma = following is not None and following.text == ","
                if comma and "." not in text and self.depth == 1 and self.sign(1) == "":
                    digits = self.peek(1)
                    if digits is not None and digits.kind == "number" and not digits.apart:
                        self.at += 2
                        text = f"{text}.{digits.text}"
                return _Part(text, 3)
            case "raised" if fraction(token.text):
                return _Part(f"({fraction(token.text)})", 3)
            case "name":
                return self.name(token)
            case "macro":
                return self.macro(token.text[1:])
        sign = _SIGNS.get(token.text, token.text)
        if sign == "(":
            inner = self.sum()
            self.closed(")")
            return inner if inner.level == 3 else _Part(f"({inner.text})", 3)
        if sign == "|":
            inner = self.sum()
            self.closed("|")
            return _Part(f"abs({inner.text})", 3, is_call=True)
        if sign == "√":
            return _Part(f"sqrt({_bare(self.atom())})", 3, is_call=True)
        raise Unclear

    def name(self, token: _Token) -> _Part:
        return self.named(_indexed(re.sub(r"^\w+(?:\.|::)", "", token.text)))

    def macro(self, word: str) -> _Part:
        """LaTeX."""
        if word in {"frac", "dfrac", "tfrac"}:
            above, below = self.argument(), self.argument()
            return _Part(f"{above.within(1)}/{below.within(2)}", 1)
        if word == "sqrt":
            return _Part(f"sqrt({_bare(self.argument())})", 3, is_call=True)
        if word in {"dot", "ddot"}:
            braced = self.sign() == "("
            self.at += braced
            inner = self.take()
            if braced:
                self.closed(")")
            name = _indexed(inner.text.lstrip("\\")) + self.index()
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

    def argument(self) -> _Part:
        """The argument of a macro: a group, or one letter or digit."""
        token = self.peek()
        if token is not None and token.kind == "number" and len(token.text) > 1:
            self.tokens[self.at] = token._replace(text=token.text[1:])
            return _Part(token.text[0], 3)
        if self.sign() == "(":
            self.at += 1
            inner = self.sum()
            self.closed(")")
            return inner
        return self.atom()

    def named(self, word: str, primes: int = 0) -> _Part:
        """A name with its primes and arguments."""
        primes += self.primes()
        function = self.function_named(word)
        if function and not primes:
            return self.call(function)
        if word in _RATES | habits()["written_out"].keys() | {"pow", "power", "Pow", "Power"} | {
            "square", "sqr", "sq"
        } and self.sign() == "(" and word not in self.names.known:  # fmt: skip
            return self.foreign(word)
        if word in {"e", "E"} and word not in self.names.known and self.sign() == "^":
            self.at += 1
            return _Part(f"exp({_bare_text(self.exponent())})", 3, is_call=True)
        if word in self.names.functions:
            return self.applied(word + "'" * primes)
        name, more = self.meant(word)
        primes += more
        following = self.peek()
        if self.sign() == "(" and following is not None and name in self.names.coordinates:
            inside = self.peek(1)
            if inside is not None and inside.text == "t" and self.sign(2) == ")":
                self.at += 3
                primes += self.primes()
        if self.sign() == "." and (method := self.peek(1)) and method.text in {"diff", "dt"}:
            self.at += 2
            if self.sign() == "(":
                primes += self.order(self.arguments())
            else:
                primes += 1
        text = name + "'" * primes
        return _Part(text, 1 if "*" in text else 3)

    def primes(self) -> int:
        token = self.peek()
        if token is None or token.kind != "primes":
            return 0
        self.at += 1
        return sum(_PRIMES.get(each, 1) for each in token.text)

    def meant(self, word: str) -> tuple[str, int]:
        """The name of the file that a word stands for, and the primes that belong to it."""
        known = self.names.known
        plain = word
        primes = 0
        if word not in known:
            apart = unicodedata.normalize("NFD", word)
            primes = sum(_DOTS.get(each, 0) for each in apart)
            plain = unicodedata.normalize("NFC", "".join(e for e in apart if e not in _DOTS))
            plain = re.sub(r"[₀-₉]+", lambda m: "_" + unicodedata.normalize("NFKC", m[0]), plain)
        for spelled in (plain, plain.replace("_", ""), re.sub(r"(\D)(\d+)$", r"\1_\2", plain)):
            if spelled in known:
                return spelled, primes
            if same := alike(spelled, known):
                return same, primes
        if plain in meanings("functions") and meanings("functions")[plain] == "pi":
            return "pi", primes
        if rate := self.rate(plain):
            return rate
        if len(plain) < 9 and (product := product_meant(plain, known)):
            return product, 0
        return plain, primes

    def rate(self, word: str) -> tuple[str, int] | None:
        """`x` and 1 for xdot, dx, vx, v_x, omega and the like."""
        found = [
            (x, order)
            for x in self.names.coordinates
            for order, forms in enumerate(_rates(x), start=1)
            if word in forms
        ]
        if found:
            return found[0]
        single = len(self.names.coordinates) == 1
        if single and word in {"v", "velocity", "speed", "omega", "ω", "\\omega"}:
            return self.names.coordinates[0], 1
        if single and self.names.momenta and word in {"p", "P"}:
            return f"p_{self.names.coordinates[0]}", 0
        return None

    # Functions.

    def function_named(self, word: str) -> str:
        if word in self.names.known:
            return ""
        usual = meanings("functions")
        for spelled in (word, word.casefold(), word.casefold().replace("arc", "a", 1)):
            if (name := usual.get(spelled, spelled)) in FUNCTIONS:
                return name
        return ""

    def call(self, function: str) -> _Part:
        power = ""
        raised = self.peek()
        if self.sign() == "^":
            self.at += 1
            power = self.exponent()
        elif raised is not None and raised.kind == "raised":
            self.at += 1
            power = _raised(raised.text)[1:]
        if power == "(-1)":
            function, power = f"a{function}", ""
            if function not in FUNCTIONS:
                raise Unclear
        part = self.applied(function) if self.sign() == "(" else self.without_brackets(function)
        return _Part(f"{part.text}^{power}", 2) if power else part

    def applied(self, function: str) -> _Part:
        if self.sign() != "(":
            raise Unclear
        arguments = self.arguments()
        if function == "atan" and len(arguments) == 2:
            function = "atan2"
        return _Part(f"{function}({', '.join(arguments)})", 3, is_call=True)

    def without_brackets(self, function: str) -> _Part:
        """`sin 2 x` and `cos theta`: numbers, then one name with its power."""
        text = ""
        while (token := self.peek()) is not None and token.kind == "number":
            text += self.power().text + "*"
        token = self.peek()
        if not self.is_name(token):
            if not text:
                raise Unclear
            return _Part(f"{function}({text[:-1]})", 3, is_call=True)
        part = self.power()
        text += part.text
        if part.text.rstrip("'") not in self.names.coordinates and self.is_name(self.peek()):
            raise Unclear  # cos a x
        return _Part(f"{function}({text})", 3, is_call=True)

    def is_name(self, token: _Token | None) -> bool:
        named = token is not None and token.kind in {"name", "macro"}
        return named and not self.function_named(token.text.lstrip("\\"))

    def arguments(self) -> list[str]:
        self.closed("(")
        self.depth += 1
        found = [self.sum().text]
        while self.sign() == ",":
            self.at += 1
            found.append(self.sum().text)
        self.closed(")")
        self.depth -= 1
        return found

    def foreign(self, word: str) -> _Part:
        """A function of other programs."""
        arguments = self.arguments()
        grouped = [each if re.fullmatch(r"[\w.]+'*", each) else f"({each})" for each in arguments]
        if word in _RATES:
            x = arguments[0]
            if not re.fullmatch(r"\w+'*", x):
                return self.partial(word, arguments)
            if len(arguments) > 1 and arguments[1] != "t":
                return self.partial(word, arguments)
            return _Part(x + "'" * self.order(arguments[1:]), 3)
        if word in {"square", "sqr", "sq"} and len(arguments) == 1:
            return _Part(f"{grouped[0]}^2", 2)
        if word in {"pow", "power", "Pow", "Power"} and len(arguments) == 2:
            return _Part(f"{grouped[0]}^{grouped[1]}", 2)
        form = habits()["written_out"].get(word, "")
        if form.count("{}") != len(arguments):
            raise Unclear
        text = form.format(*(grouped if "{}*" in form or "/{}" in form else arguments))
        return _Part(text, 3 if form == "{}" and re.fullmatch(r"[\w.]+", text) else 1)

    def partial(self, word: str, arguments: list[str]) -> _Part:
        if word not in {"diff", "D"} or len(arguments) != 2 or arguments[1] == "t":
            raise Unclear
        return _Part(f"diff({arguments[0]}, {arguments[1]})", 3, is_call=True)

    def order(self, arguments: list[str]) -> int:
        """How often is differentiated: (), (t), (t, t), (t, 2)."""
        if set(arguments) <= {"t"}:
            return max(1, len(arguments))
        if len(arguments) == 2 and arguments[0] == "t" and arguments[1].isdigit():
            return int(arguments[1])
        raise Unclear


def _rates(x: str) -> tuple[set[str], set[str]]:
    """How others write x' and x''."""
    stem, _, index = x.partition("_")
    first = {f"{x}{dot}" for dot in ("dot", "_dot", "_d", "d", "p", "_t", "_p", "Dot", "_prime")}
    first |= {f"{dot}{x}" for dot in ("d", "v", "v_", "D", "d_", "dot_", "dot")}
    second = {f"{x}{dot}" for dot in ("ddot", "_ddot", "dd", "_dd", "pp", "_tt")}
    second |= {f"{dot}{x}" for dot in ("dd", "a", "a_", "ddot_", "ddot")}
    if index:
        first |= {f"{stem}dot_{index}", f"{stem}dot{index}", f"{stem}_dot_{index}", f"v_{index}"}
    return first, second


def _is_names(text: str) -> bool:
    return re.fullmatch(r"[\w*]+'*(?:\^[\w.]+)?", text) is not None


def _raise(base: _Part, power: str) -> _Part:
    """A power; of the last letter where a name means a product, as in mx^2."""
    if base.level == 1 and _is_names(base.text):
        return _Part(base.text + power, 1)
    return _Part(base.within(3) + power, 2)


def _raised(text: str) -> str:
    minus, digits = text.startswith("⁻"), text.lstrip("⁻")
    power = superscript(digits)
    if not power:
        raise Unclear
    return f"^(-{power[1:]})" if minus else power


def _indexed(name: str) -> str:
    return re.sub(r"_\{(\w+)\}", r"_\1", name)


def _number(text: str) -> bool:
    return re.fullmatch(r"-?[\d.]+", text) is not None


def _bare(part: _Part) -> str:
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
