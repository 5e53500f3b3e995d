"""Functions of a foreign formula with their arguments."""

from __future__ import annotations

import re
from abc import abstractmethod

from lagcli.reader.assignments import levels
from lagcli.reader.foreign.sums import Part, Sums, raised
from lagcli.reader.foreign.tokens import SIGNS, Token
from lagcli.reader.foreign.words import UnclearText, function_named
from lagcli.reader.habits import POWERS, RATES, SQUARES, written_out
from lagcli.reader.regex import balanced, outside, regex

_NUMBER = regex(r"\d+\.?\d*|\.\d+")


class Functions(Sums):
    """What is called: sin^2 x, Sqrt[x], pow(x, 2), Derivative(x, t)."""

    @abstractmethod
    def named(self, word: str, primes: int = 0) -> Part:
        """A name with its primes and arguments."""

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
        if function == "exp" and power and self.sign() != "(":
            return Part(f"exp({bare_text(power)})", 3, is_call=True)  # exp^(-x)
        if power == "(-1)":
            function, power = f"a{function}", ""
        if self.sign() == "|":  # ln|x|
            part = Part(f"{function}({self.atom().text})", 3, is_call=True)
        else:
            part = self.applied(function) if self.sign() == "(" else self.without_brackets(function)
        return Part(f"{part.text}^{power}", 2) if power else part

    def applied(self, function: str) -> Part:
        """A function with its arguments in brackets."""
        if self.sign() != "(":
            raise UnclearText
        is_square = self.tokens[self.at].text == "["
        arguments = self.arguments()
        if function == "atan" and len(arguments) == 2:
            function = "atan2"
            arguments = arguments[::-1] if is_square else arguments  # ArcTan[x, y]
        if function == "sign" and len(arguments) == 2:  # |a| sign(b) of Fortran
            size = arguments[0] if _NUMBER.fullmatch(arguments[0]) else f"abs({arguments[0]})"
            factor = "" if size in {"1", "1.0"} else f"{size}*"
            return Part(f"{factor}sign({arguments[1]})", 1 if factor else 3, is_call=not factor)
        return Part(f"{function}({', '.join(arguments)})", 3, is_call=True)

    def without_brackets(self, function: str) -> Part:
        """`sin 2 x` and `cos theta`: numbers, then one name with its power."""
        text = ""
        while (token := self.peek()) is not None and token.kind == "number":
            text += self.power().text + "*"
        token = self.peek()
        if not self.is_name(token):
            return Part(f"{function}({text[:-1]})", 3, is_call=True)
        part = self.power()
        if part.level < 3 or self.sign() in {"/", "^"} or (text and function == "sqrt"):
            raise UnclearText  # sin x^2, sin x/2
        text += part.text
        time = self.peek()
        if time is not None and time.text == "t" and part.text not in self.names.coordinates:
            text += f"*{self.power().text}"  # cos ωt
        if part.text.rstrip("'") not in self.names.coordinates and self.is_name(self.peek()):
            raise UnclearText  # cos a x
        return Part(f"{function}({text})", 3, is_call=True)

    def is_name(self, token: Token | None) -> bool:
        """Whether a token is a name and no function."""
        if token is None or token.kind not in {"name", "macro"}:
            return False
        return not function_named(token.text.lstrip("\\"), self.names)

    def arguments(self) -> list[str]:
        """What stands in brackets, between commas."""
        self.closed("(")
        if self.sign() == ")":
            self.at += 1
            return []
        self.calls += 1
        within = self.sign() == "(" and self.ends_list()
        self.at += within
        found = [self.sum().text]
        while self.sign() in {",", ";"}:
            self.at += 1
            found.append(self.sum().text)
        for _ in range(1 + within):
            self.closed(")")
        self.calls -= 1
        return found

    def ends_list(self) -> bool:
        """Whether the arguments are one list, as in norm([x, y])."""
        texts = [SIGNS.get(each.text, each.text) for each in self.tokens[self.at :]]
        end = next((place for place, level in enumerate(levels(texts)) if level == 0), len(texts))
        return texts[end + 1 : end + 2] == [")"] and "," in texts[:end]

    def foreign(self, word: str) -> Part:
        """A function of other programs."""
        arguments = self.arguments()
        if not arguments:
            raise UnclearText
        grouped = [each if re.fullmatch(r"[\w.]+'*", each) else f"({each})" for each in arguments]
        if word in RATES:
            x = arguments[0]
            if not re.fullmatch(r"\w+'*", x) or arguments[1:2] not in ([], ["t"]):
                return self.partial(word, arguments)
            rate = x + "'" * (RATES[word] * self.order(arguments[1:]))
            self.called_by_time()
            return Part(rate, 3)
        if word in {"norm", "hypot"}:
            squares = " + ".join(f"{each}^2" for each in grouped)
            return Part(f"sqrt({squares})", 3, is_call=True)
        if word in SQUARES and len(arguments) == 1:
            used = {*re.findall(r"\w+", arguments[0])}
            if word == "square" and "t" in used and not used & {*self.names.coordinates}:
                raise UnclearText  # a square wave?
            return Part(f"{grouped[0]}^2", 2)
        if word in POWERS and len(arguments) == 2:
            return Part(f"{grouped[0]}^{grouped[1]}", 2)
        form = written_out(word)
        if len(set(re.findall(r"{\d}", form))) != len(arguments):
            raise UnclearText
        text = form.format(*(grouped if re.search(r"}[*^]|[/^]{|- {", form) else arguments))
        text = re.sub(r"(?<=abs\()0 - |(?<=\()0 \+ | [-+] 0(?=[ )])", "", text)
        if form == "{0}" and re.fullmatch(r"[\w.]+", text):
            return Part(text, 3)
        is_sum = re.search(r"[-+]", outside(form)) is not None
        return Part(text, 0 if is_sum else 3 if re.fullmatch(r"\w+\([^()]*\)", form) else 1)

    def partial(self, word: str, arguments: list[str]) -> Part:
        """A derivative by a name other than t."""
        if word not in {"diff", "D"} or len(arguments) != 2 or arguments[1] == "t":
            raise UnclearText
        return Part(f"diff({arguments[0]}, {arguments[1]})", 3, is_call=True)

    def order(self, arguments: list[str]) -> int:
        """How often is differentiated: (), (t), (t, t), (t, 2)."""
        if set(arguments) <= {"t"}:
            return max(1, len(arguments))
        if len(arguments) == 2 and arguments[0] == "t" and arguments[1].isdigit():
            return int(arguments[1])
        raise UnclearText

    def exponential(self) -> Part:
        """`exp(-a*x)` for e^(-a x)."""
        self.at += 1
        power = self.exponent()
        following = self.peek()
        if following is not None and not following.apart and self.begins(following):
            raise UnclearText  # e^2x
        return Part(f"exp({bare_text(power)})", 3, is_call=True)

    def called_by_time(self) -> bool:
        """Whether `(t)` stands here, which is passed."""
        inside = self.peek(1)
        if self.sign() != "(" or inside is None or inside.text != "t" or self.sign(2) != ")":
            return False
        self.at += 3
        return True


def bare(part: Part) -> str:
    """Without the parentheses around it."""
    return bare_text(part.text) if not part.is_call else part.text


def bare_text(text: str) -> str:
    """Without the parentheses around it."""
    inner = text[1:-1]
    return inner if text == f"({inner})" and balanced(inner) else text
