"""The grammar: precedence, exact numbers, names, primes, derivatives."""

import json
from fractions import Fraction

import pytest

from lagcli.diagnostics import ProblemError, Source
from lagcli.expression import (
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
)
from lagcli.reader import parse_equation_text, parse_text
from lagcli.reader.builder import excerpt_being_read
from lagcli.reader.parser import GRAMMAR, TABLES, automaton, make_parser
from lagcli.reader.positions import Excerpt


def shown(node: Expression) -> str:
    """The tree with every pair of parentheses written."""
    match node:
        case Number(value=value):
            return str(value)
        case Name():
            return str(node)
        case Negative(operand=operand):
            return f"(-{shown(operand)})"
        case Sum(terms=terms):
            return "(" + " + ".join(map(shown, terms)) + ")"
        case Product(factors=factors):
            return "(" + "*".join(map(shown, factors)) + ")"
        case Quotient(numerator=a, denominator=b):
            return f"({shown(a)}/{shown(b)})"
        case Power(base=a, exponent=b):
            return f"({shown(a)}^{shown(b)})"
        case Call(function=f, arguments=arguments, primes=primes):
            return f + "'" * primes + "(" + ", ".join(map(shown, arguments)) + ")"
        case _:
            raise AssertionError(node)


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("a + b*c", "(a + (b*c))"),
        ("a - b - c", "(a + (-b) + (-c))"),
        ("a - (b - c)", "(a + (-(b + (-c))))"),
        ("a + (b + c)", "(a + b + c)"),
        ("a*(b*c)*d", "(a*b*c*d)"),
        ("-x^2", "(-(x^2))"),
        ("-a*b", "(-(a*b))"),
        ("a*-b*c", "(a*(-b)*c)"),
        ("--x", "(-(-x))"),
        ("a - -b", "(a + (-(-b)))"),
        ("+x", "x"),
        ("2^3^4", "(2^(3^4))"),
        ("(a^b)^c", "((a^b)^c)"),
        ("2^-1", "(2^(-1))"),
        ("2^-x^2", "(2^(-(x^2)))"),
        ("x**2", "(x^2)"),
        ("a/b/c", "((a/b)/c)"),
        ("a/b*c", "((a/b)*c)"),
        ("a*b/c", "((a*b)/c)"),
        ("a/(b*c)", "(a/(b*c))"),
        ("-a/b", "(-(a/b))"),
        ("a^b*c", "((a^b)*c)"),
        ("sin(x)^2", "(sin(x)^2)"),
        ("atan2(y, x)", "atan2(y, x)"),
        ("U''(d)*x'", "(U''(d)*x')"),
        ("x − y", "(x + (-y))"),
        ("x’ + x′ + x″", "(x' + x' + x'')"),
        (" x\n + y ", "(x + y)"),
    ],
)
def test_precedence(text, tree):
    assert shown(parse_text(text)) == tree


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Fraction(1, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("1E+3", Fraction(1000)),
        (".5", Fraction(1, 2)),
        ("5.", Fraction(5)),
        ("010", Fraction(10)),
        ("9.81", Fraction(981, 100)),
        ("0", Fraction(0)),
    ],
)
def test_numbers_are_exact(text, value):
    assert parse_text(text) == Number(value)


@pytest.mark.parametrize(
    "name",
    ["x", "x_1", "θ", "theta", "φ", "ϕ", "I", "E", "S", "N", "Q", "e", "lambda", "ℓ", "ẍ", "no"],
)
def test_names_have_no_built_in_meaning(name):
    assert parse_text(name) == Name(name)


def test_composed_and_decomposed_letters_are_one_name():
    assert parse_text("e\u0301") == parse_text("\u00e9") == Name("\u00e9")


def test_look_alikes_are_two_names():
    assert parse_text("φ") != parse_text("ϕ")


def test_derivatives():
    x, a, b = Name("x"), Name("a"), Name("b")
    assert parse_text("diff(x^2, x')") == Diff(Power(x, Number(Fraction(2))), Name("x", 1))
    assert parse_text("diff(Phi, 1)(a, b)") == PartialCall("Phi", (1,), (a, b))
    assert parse_text("diff(Phi, 1, 2)(a, b)") == PartialCall("Phi", (1, 2), (a, b))


def test_an_expression_alone_is_an_equation_with_zero():
    assert parse_equation_text("x = y") == Equation(Name("x"), Name("y"))
    assert parse_equation_text("x") == Equation(Name("x"), Number(Fraction(0)))


@pytest.mark.parametrize(
    ("text", "columns"),
    [("ab + cd", (1, 8)), ("sin(x)", (1, 7)), ("(x)", (1, 4)), ("-x", (1, 3)), ("x^ 2", (1, 5))],
)
def test_a_span_covers_what_is_written(text, columns):
    span = parse_text(text).span
    assert (span.column, span.end_column) == columns


@pytest.mark.parametrize("text", ["x = = y", "a = b = c", "(a = b)"])
def test_an_equation_has_one_equals_sign(text):
    with pytest.raises(ProblemError):
        parse_equation_text(text)


def test_nothing_that_python_knows_is_run():
    for text in ("__import__('os')", "x.__class__", "[1]", "lambda: 1", "x if x else y", "f'{x}'"):
        with pytest.raises(ProblemError):
            parse_text(text)


def test_the_tables_belong_to_the_grammar():
    """`python -m lagcli.reader.parser` makes them anew after a change."""
    kept = json.loads(TABLES.read_text("utf-8"))
    assert kept["grammar"] == GRAMMAR.read_text("utf-8")


def test_the_tables_parse_as_the_grammar_does():
    text = "-a*b/c^-d + sin(x')*diff(Phi, 1)(y, 2) - U'(z)"
    reset = excerpt_being_read.set(Excerpt.whole(Source("-", text)))
    assert make_parser().parse(text, "equation") == automaton().parse(text, "equation")
    excerpt_being_read.reset(reset)
