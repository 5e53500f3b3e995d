"""What is printed in the grammar of the problem format is read back as the same formula."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings

from lagcli import expression
from lagcli.expression import (
    Call,
    Diff,
    Equation,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Rate,
    Sum,
)
from lagcli.formatters.grammar import GrammarPrinter, equation_to_grammar, to_grammar
from lagcli.formatters.layout import joined
from lagcli.formatters.unicode import AsciiPrinter, UnicodePrinter
from lagcli.reader.expressions import parse_text

from .examples import TWO, M, R, g, number, plus, sin, square, theta, times, x
from .strategies import expressions, has_refused_constants, shape


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (plus(times(M, Name("x", 2)), Negative(times(M, g, sin(theta)))), "M*x'' - M*g*sin(theta)"),
        (Quotient(times(g, sin(theta)), times(TWO, R)), "g*sin(theta)/(2*R)"),
        (Negative(Quotient(times(M, g), TWO)), "-M*g/2"),
        (times(number(1, 2), M), "1/2*M"),
        (times(M, number(1, 2)), "M*(1/2)"),
        (Power(number(1, 2), x), "(1/2)^x"),
        (Power(x, number(1, 2)), "x^(1/2)"),
        (Power(x, Negative(TWO)), "x^(-2)"),
        (square(Negative(x)), "(-x)^2"),
        (Negative(square(x)), "-x^2"),
        (square(square(x)), "(x^2)^2"),
        (Power(x, square(x)), "x^(x^2)"),
        (Negative(Negative(x)), "-(-x)"),
        (plus(x, Negative(plus(g, R))), "x - (g + R)"),
        (plus(x, Negative(Negative(g))), "x - (-g)"),
        (times(M, Negative(x)), "M*(-x)"),
        (times(Negative(M), x), "(-M)*x"),
        (Quotient(x, Quotient(g, R)), "x/(g/R)"),
        (Call("U", (Name("d"),), 1), "U'(d)"),
        (PartialCall("Phi", (1, 2), (x, g)), "diff(Phi, 1, 2)(x, g)"),
        (Diff(plus(x, g), Name("x", 1)), "diff(x + g, x')"),
        (Call("atan2", (x, g)), "atan2(x, g)"),
    ],
)
def test_brackets_are_where_they_must_be_and_nowhere_else(node, text):
    assert to_grammar(node) == text
    assert shape(parse_text(text)) == shape(node)


@pytest.mark.long
@settings(max_examples=300, deadline=None)
@given(expressions)
def test_what_is_printed_reads_back(node):
    assume(not has_refused_constants(node))
    assert shape(parse_text(to_grammar(node))) == shape(node)


@pytest.mark.parametrize(
    ("value", "grammar", "unicode"),
    [
        (Fraction(981, 100), "9.81*x", "9.81 x"),
        (Fraction(6674, 10**14), "6.674e-11*x", "6.674·10⁻¹¹ x"),
        (Fraction(10**20), "1e20*x", "1·10²⁰ x"),
        (Fraction(3), "3*x", "3 x"),
    ],
)
def test_decimals_of_numeric_answers(value, grammar, unicode):
    node = times(Number(value, decimal=True), x)
    assert to_grammar(node) == grammar
    assert joined(UnicodePrinter().show(node)) == unicode
    assert parse_text(grammar) == node


def test_an_integral_has_its_sign_and_its_bounds():
    node = times(TWO, Call("integral", (Call("F", (Name("s"),)), Name("s"), number(0), Name("t"))))
    assert joined(UnicodePrinter().show(node)) == "2 ∫[0 … t] F(s) ds"
    assert to_grammar(node) == "2*integral(F(s), s, 0, t)"


def test_an_equation():
    assert equation_to_grammar(Equation(x, Negative(g))) == "x = -g"


@pytest.mark.long
def test_no_formula_is_too_deep_or_number_too_long():
    node = x
    for _ in range(5000):
        node = Call("sin", (node,))
    assert to_grammar(node).count("(") == 5000
    assert len(to_grammar(Number(Fraction(10**9999)))) == 10_000


#: The kinds of nodes (`slots=True` leaves a shadow of each class among the subclasses).
EVERY_KIND = {
    kind for kind in Expression.__subclasses__() if vars(expression)[kind.__name__] is kind
}

ONE_OF_EACH = {
    Number: number(3),
    Name: x,
    Negative: Negative(x),
    PlusMinus: PlusMinus(x),
    Sum: plus(x, g),
    Product: times(x, g),
    Quotient: Quotient(x, g),
    Power: square(x),
    Call: sin(x),
    PartialCall: PartialCall("Phi", (1,), (x, g)),
    Diff: Diff(x, g),
    Rate: Rate(Diff(x, g)),
}


@pytest.mark.parametrize("printer", [GrammarPrinter, UnicodePrinter, AsciiPrinter])
def test_no_kind_of_node_is_forgotten(printer):
    assert set(ONE_OF_EACH) == EVERY_KIND
    for node in ONE_OF_EACH.values():
        assert printer().show(node)


def test_sharing_of_parts_changes_nothing():
    part = plus(x, g)
    assert to_grammar(times(part, part)) == "(x + g)*(x + g)"


def test_a_printer_can_be_used_again():
    printer = GrammarPrinter()
    assert printer.show(Sum((x, g))) == printer.show(Sum((x, g)))
    assert printer.show(Product((x, g))) != printer.show(Sum((x, g)))
