"""Text to an expression, an equation or a comparison, by the grammar beside this file.

The text is read once.  Names are not looked up here: see `lagcli.reader.scope`.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar, cast

from lagcli.diagnostics import ProblemError, Source
from lagcli.expression import Equation, Expression, Negative, terms_of
from lagcli.problem_data import Inequality
from lagcli.reader.automaton import Token, Unexpected
from lagcli.reader.builder import excerpt_being_read, mistake
from lagcli.reader.constants import check_constants
from lagcli.reader.limits import EXPRESSION_CHARACTERS
from lagcli.reader.parser import automaton
from lagcli.reader.positions import Excerpt
from lagcli.reader.text import Mistake, SourceText

Tree = TypeVar("Tree")


def read_expression(excerpt: Excerpt) -> Expression:
    """The expression that a text writes; `Mistake` if it writes none."""
    expression = cast("Expression", _parse(excerpt, "expression"))
    check_constants(expression)
    return expression


def read_equation(excerpt: Excerpt) -> Equation:
    """`left = right`, or an expression, which is `expression = 0`."""
    equation = cast("Equation", _parse(excerpt, "equation"))
    check_constants(equation.left, equation.right)
    return equation


def read_comparison(excerpt: Excerpt) -> Inequality:
    """One comparison, such as `N >= 0`."""
    comparison = cast("Inequality", _parse(excerpt, "comparison"))
    check_constants(comparison.left, comparison.right)
    return comparison


def parse_text(text: str) -> Expression:
    """Read back one printed expression with any names; `ProblemError` if it is none."""
    return _read_back(text, "<expression>", read_expression)


def formula_or_none(text: str) -> Expression | None:
    """What a text of any kind means as an expression, if it is one."""
    try:
        return parse_text(text)
    except ProblemError:
        return None


def signed_terms(text: str) -> list[tuple[bool, str]]:
    """Whether each term of a sum has a minus, and its text without it; empty for no formula."""
    formula = formula_or_none(text)
    source = SourceText.of(Source("", text))
    terms = terms_of(formula) if formula is not None else ()
    bare = (each.operand if isinstance(each, Negative) else each for each in terms)
    return [
        (term is not inner, source.written(inner.span))
        for term, inner in zip(terms, bare, strict=True)
    ]


def parse_equation_text(text: str) -> Equation:
    """Read back one printed equation with any names; `ProblemError` if it is none."""
    return _read_back(text, "<equation>", read_equation)


def _read_back(text: str, source_name: str, read: Callable[[Excerpt], Tree]) -> Tree:
    return read_or_raise(Excerpt.whole(Source(source_name, text)), read)


def read_or_raise(excerpt: Excerpt, read: Callable[[Excerpt], Tree]) -> Tree:
    """What a text means; `ProblemError` where it is not read."""
    try:
        return read(excerpt)
    except Mistake as error:
        raise ProblemError(excerpt.text.source, error.diagnostics) from None


def _parse(excerpt: Excerpt, start: str) -> Expression | Equation | Inequality:
    length = len(excerpt.value)
    if length > EXPRESSION_CHARACTERS:
        message = f"an expression of {length:,} characters, the limit is {EXPRESSION_CHARACTERS:,}"
        raise mistake(message, excerpt.span(0, 1))
    reset = excerpt_being_read.set(excerpt)
    try:
        return cast("Expression | Equation | Inequality", automaton().parse(excerpt.value, start))
    except Unexpected as error:
        from lagcli.reader.syntax_errors import explain

        raise Mistake(explain(error, _tokens(excerpt.value), excerpt, start)) from None
    finally:
        excerpt_being_read.reset(reset)


def _tokens(value: str) -> list[Token]:
    """The tokens up to the first character that begins none."""
    tokens: list[Token] = []
    with suppress(Unexpected):
        tokens.extend(automaton().tokens(value))
    return tokens


def sides_of(formula: Expression | Equation | Inequality) -> tuple[Expression, ...]:
    """A formula, or both sides of a relation."""
    if isinstance(formula, Equation | Inequality):
        return formula.left, formula.right
    return (formula,)
