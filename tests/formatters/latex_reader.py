"""Reads exactly the LaTeX that the formatter writes, to see that it says the same."""

from __future__ import annotations

import re
from fractions import Fraction

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
)
from lagcli.formatters.latex_names import LatexNames

from .strategies import NAMES

_SPACING = re.compile(r"\\(?:[bB]igg?[lr]|,|quad)(?![a-zA-Z])|&|\\\\|\s+|\{\}")
_NAMED = {
    LatexNames().name(name, primes): Name(name, primes) for name in NAMES for primes in range(3)
}
_BY_LENGTH = sorted(_NAMED, key=len, reverse=True)
_FUNCTIONS = {
    r"\sin": "sin",
    r"\ln": "log",
    r"\operatorname{atan2}": "atan2",
    r"\operatorname{pow}": "pow",
    "U": "U",
}


def read_latex(text: str):
    reader = _Reader(text)
    node = reader.sum()
    reader.skip()
    assert reader.at == len(text), text[reader.at :]
    return node


class _Reader:
    def __init__(self, text):
        self.text = text
        self.at = 0

    def skip(self):
        while match := _SPACING.match(self.text, self.at):
            if match[0] == r"\\" and self.text[match.end() : match.end() + 1].isalpha():
                return
            self.at = match.end()

    def take(self, token):
        self.skip()
        if not self.text.startswith(token, self.at):
            return False
        after = self.text[self.at + len(token) : self.at + len(token) + 1]
        if token[0] == "\\" and token[-1].isalpha() and after.isalpha():
            return False
        self.at += len(token)
        return True

    def expect(self, token):
        assert self.take(token), f"{token} expected at {self.text[self.at :]}"

    def sum(self):
        terms = [self.term()]
        while True:
            if self.take("+"):
                terms.append(self.product())
            elif self.take("-"):
                terms.append(Negative(self.product()))
            else:
                return terms[0] if len(terms) == 1 else Sum(tuple(terms))

    def term(self):
        return Negative(self.product()) if self.take("-") else self.product()

    def product(self):
        factors = [self.power()]
        while not self.ends():
            if self.take("/"):
                factors.append(Quotient(Number(Fraction(1)), self.power()))
            else:
                self.take(r"\cdot")
                factors.append(self.power())
        return factors[0] if len(factors) == 1 else Product(tuple(factors))

    def ends(self):
        self.skip()
        rest = self.text[self.at :]
        return not rest or rest[0] in "+-=),}" or rest.startswith(r"\rvert")

    def power(self):
        base = self.atom()
        if self.take("^"):
            return Power(base, self.braced())
        return base

    def braced(self):
        self.expect("{")
        node = self.sum()
        self.expect("}")
        return node

    def arguments(self):
        self.expect("(")
        arguments = [self.sum()]
        while self.take(","):
            arguments.append(self.sum())
        self.expect(")")
        return tuple(arguments)

    def atom(self):
        self.skip()
        if match := re.compile(r"[0-9]+").match(self.text, self.at):
            self.at = match.end()
            return Number(Fraction(int(match[0])))
        if self.take("("):
            node = self.sum()
            self.expect(")")
            return node
        if self.take(r"\frac{\partial}{\partial"):
            variable = self.name()
            self.expect("}")
            return Diff(*self.arguments(), variable)
        if self.take(r"\frac{\partial "):
            operand = self.name()
            self.expect(r"}{\partial")
            variable = self.name()
            self.expect("}")
            return Diff(operand, variable)
        if self.take(r"\frac"):
            return Quotient(self.braced(), self.braced())
        if self.take(r"\sqrt"):
            return Call("sqrt", (self.braced(),))
        if self.take(r"\lvert"):
            node = self.sum()
            self.expect(r"\rvert")
            return Call("abs", (node,))
        if self.take(r"\partial_{1} \partial_{2} \Phi"):
            return PartialCall("Phi", (1, 2), self.arguments())
        for macro, function in _FUNCTIONS.items():
            if self.take(macro):
                return self.function(function)
        return self.name()

    def function(self, function):
        primes = 0
        while self.take("'"):
            primes += 1
        exponent = self.braced() if self.take("^") else None
        self.skip()
        bracketed = self.text.startswith("(", self.at)
        arguments = self.arguments() if bracketed else (self.name(),)
        if function == "pow":
            return Power(*arguments)
        node = Call(function, arguments, primes)
        return node if exponent is None else Power(node, exponent)

    def name(self):
        for text in _BY_LENGTH:
            if self.take(text):
                return _NAMED[text]
        raise AssertionError(f"no name at {self.text[self.at :]}")
