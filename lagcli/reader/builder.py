# ruff: noqa: D102 - each method is named after its rule in grammar.lark
"""The grammar's rules as nodes of the plain tree: what the parser calls as it reduces.

Nothing here recurses, and sums and products grow in place, so that a sum of fifty
thousand terms is read as quickly as fifty sums of a thousand.
"""

from __future__ import annotations

import unicodedata
from contextvars import ContextVar
from fractions import Fraction
from typing import cast

from lagcli.diagnostics import Diagnostic, Span
from lagcli.expression import (
    ZERO,
    Call,
    Diff,
    Equation,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    factors_of,
    terms_of,
)
from lagcli.problem_data import Comparison, Inequality
from lagcli.reader.automaton import Token
from lagcli.reader.limits import NUMBER_DIGITS
from lagcli.reader.positions import Excerpt
from lagcli.reader.text import Mistake
from lagcli.record import replace

#: The text that is being read: where the spans of its nodes are looked up.
excerpt_being_read: ContextVar[Excerpt] = ContextVar("excerpt_being_read")

_COMPARISONS = {"≥": ">=", "≤": "<="}
_PRIME_COUNT = {"'": 1, "’": 1, "′": 1, "″": 2, "‴": 3}


def span_of(token: Token) -> Span:
    """The place of a token in the file."""
    return excerpt_being_read.get().span(token.start_pos, token.end_pos)


def mistake(message: str, span: Span, hint: str = "") -> Mistake:
    """The exception for one syntax mistake."""
    return Mistake(Diagnostic(message, span, hint))


class FormulaBuilder:
    """One method for each alternative of the grammar; `children` are its parts."""

    def expression(self, children: list[Expression]) -> Expression:
        return children[0]

    def equation(self, children: list[Expression]) -> Equation:
        left, right = children[0], children[1] if len(children) == 2 else None
        if right is None:
            return Equation(left, ZERO, span=left.span)
        return Equation(left, right, span=left.span.to(right.span))

    def comparison(self, children: list[Expression | Token]) -> Inequality:
        left, right = (cast("Expression", side) for side in (children[0], children[2]))
        sign = children[1]
        comparison = cast("Comparison", _COMPARISONS.get(str(sign), str(sign)))
        span = left.span.to(right.span)
        return Inequality(left=left, comparison=comparison, right=right, span=span)

    # Sums.

    def first_term(self, children: list[Expression]) -> list[Expression]:
        return list(terms_of(children[0]))

    def plus(self, children: list[Expression]) -> list[Expression]:
        terms = cast("list[Expression]", children[0])
        terms += terms_of(children[1])
        return terms

    def minus(self, children: list[Expression]) -> list[Expression]:
        terms = cast("list[Expression]", children[0])
        terms.append(self.negative(children[1:]))
        return terms

    def total(self, children: list[Expression]) -> Expression:
        terms = cast("list[Expression]", children[0])
        if len(terms) == 1:
            return terms[0]
        return Sum(tuple(terms), span=terms[0].span.to(terms[-1].span))

    def negative(self, children: list[Expression]) -> Expression:
        sign, operand = cast("Token", children[0]), children[1]
        return Negative(operand, span=span_of(sign).to(operand.span))

    # Products.

    def first_factor(self, children: list[Expression]) -> list[Expression]:
        return list(factors_of(children[0]))

    def times(self, children: list[Expression]) -> list[Expression]:
        factors = cast("list[Expression]", children[0])
        factors += factors_of(children[1])
        return factors

    def over(self, children: list[Expression]) -> list[Expression]:
        numerator, denominator = self.multiplied(children), children[1]
        span = numerator.span.to(denominator.span)
        return [Quotient(numerator, denominator, span=span)]

    def multiplied(self, children: list[Expression]) -> Expression:
        factors = cast("list[Expression]", children[0])
        if len(factors) == 1:
            return factors[0]
        return Product(tuple(factors), span=factors[0].span.to(factors[-1].span))

    def raised(self, children: list[Expression]) -> Expression:
        base, exponent = children
        return Power(base, exponent, span=base.span.to(exponent.span))

    # Atoms.

    def number(self, children: list[Token]) -> Expression:
        (token,) = children
        span = span_of(token)
        digits = _digits_written_out(token)
        if digits > NUMBER_DIGITS:
            bound = f"{NUMBER_DIGITS:,}"
            raise mistake(f"a number of more than {bound} digits", span, f"the limit is {bound}")
        return Number(Fraction(str(token)), span=span)

    def name(self, children: list[Token]) -> Expression:
        (token,) = children
        return Name(*_split_name(token), span=span_of(token))

    def group(self, children: list[Expression]) -> Expression:
        left, inner, right = children
        span = span_of(cast("Token", left)).to(span_of(cast("Token", right)))
        return replace(inner, span=span)

    # Calls.

    def arguments(self, children: list[Expression]) -> tuple[Expression, ...]:
        return tuple(children)

    def call(self, children: list[Expression]) -> Call:
        token, closing = cast("Token", children[0]), cast("Token", children[2])
        arguments = cast("tuple[Expression, ...]", children[1])
        function, primes = _split_name(token)
        return Call(function, arguments, primes, span=span_of(token).to(span_of(closing)))

    def called(self, children: list[Call]) -> Expression:
        (call,) = children
        return _diff(call) if call.function == "diff" else call

    def partial_derivative_called(self, children: list[Expression]) -> Expression:
        call, closing = cast("Call", children[0]), cast("Token", children[2])
        arguments = cast("tuple[Expression, ...]", children[1])
        span = call.span.to(span_of(closing))
        indices = _indices(call)
        if indices is None:
            hint = f"write {call.function}(…)*(…)"
            raise mistake("a '*' is missing between ')' and '('", span, hint)
        function = cast("Name", call.arguments[0]).name
        return PartialCall(function, indices, arguments, span=span)


def _indices(call: Call) -> tuple[int, ...] | None:
    """(1, 2) of `diff(Phi, 1, 2)`; None when the call is nothing of that kind."""
    if call.function != "diff" or call.primes or len(call.arguments) < 2:
        return None
    function, *rest = call.arguments
    if not isinstance(function, Name) or function.primes:
        return None
    if not all(isinstance(index, Number) and index.value.denominator == 1 for index in rest):
        return None
    return tuple(int(cast("Number", index).value) for index in rest)


def _diff(call: Call) -> Diff:
    """`diff(operand, name)`."""
    if _indices(call) is not None:
        function = cast("Name", call.arguments[0]).name
        hint = f"write diff({function}, …)(…) with the arguments of {function}"
        raise mistake(
            "a derivative by the number of an argument needs its arguments", call.span, hint
        )
    if call.primes:
        raise mistake("diff has no primes", call.span, "write diff(expression, name)")
    if len(call.arguments) != 2:
        message = f"diff takes 2 arguments, an expression and a name, not {len(call.arguments)}"
        raise mistake(message, call.span, "a second derivative is diff(diff(f, x), y)")
    operand, variable = call.arguments
    if not isinstance(variable, Name):
        raise mistake("diff differentiates by a name, such as x or x'", variable.span)
    return Diff(operand, variable, span=call.span)


def _digits_written_out(number: str) -> int:
    """How many digits a number has when its exponent is written out."""
    mantissa, _, exponent = number.lower().partition("e")
    whole, _, fraction = mantissa.partition(".")
    if len(exponent.lstrip("+-").lstrip("0")) > 6:
        return NUMBER_DIGITS + 1
    shift = int(exponent or "0")
    return max(len(whole) + shift, 0) + max(len(fraction) - shift, 0)


def _split_name(token: Token) -> tuple[str, int]:
    """The name in composed form, and the number of its primes."""
    written = str(token)
    letters = written.rstrip("".join(_PRIME_COUNT))
    primes = sum(_PRIME_COUNT[prime] for prime in written[len(letters) :])
    name = unicodedata.normalize("NFC", letters)
    for character in name:
        kind = unicodedata.category(character)
        if character != "_" and kind[0] != "L" and kind != "Nd":
            from lagcli.reader.habits import superscript

            message = f"a name has letters, digits and underscores, not '{character}'"
            message = "a power is written with '^'" if superscript(character) else message
            raise mistake(message, span_of(token))
    return name, primes
