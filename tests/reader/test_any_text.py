"""Whatever the bytes are, the answer is a problem or diagnostics, and it comes quickly."""

from contextlib import suppress

from hypothesis import given, settings
from hypothesis import strategies as st

from lagcli.diagnostics import ProblemError, render
from lagcli.reader import parse_equation_text, parse_text, read_problem

GOOD = """\
title: A problem
coordinates: {x: {unit: rad, symbol: '\\xi'}, θ: }
parameters: {m: {assume: positive}, g: 9.81, n: {integer: true}}
functions: {U: [r]}
definitions:
  r: sqrt(x^2 + 1e-3)
T: >-
  m*x'^2/2
  + m*θ'^2/2
V: "U(r) + m*g*x"
points: {p: {position: [x, θ], mass: m, force: [1, atan(x)]}}
constraints: {c: {equation: x = θ, multiplier: N, holds_while: N >= 0}}
symmetries: {s: {x: 1, θ: 1}}
initial: {x: 1, x': -2}
find: {f: {where: N = 0, for: x}, k: {value: x'^2, in_terms_of: [x]}}
expect: {degrees_of_freedom: 1, charges: {s: not conserved, energy: x}, modes: [sqrt(g)]}
"""
PIECES = "'\"{}[]:,&*!|>-#%@`\t\n \r\x00\x1b()=^/+x1.eθ′−\u0301\u2028\ufeff中é"


def check(data: bytes) -> None:
    reading = read_problem("any.yaml", data)
    assert (reading.problem is None) == any(one.is_error for one in reading.diagnostics)
    shown = render(reading.source, reading.diagnostics)
    assert not any(ord(character) < 32 and character != "\n" for character in shown)


def test_the_file_to_start_from_is_good():
    assert read_problem("good.yaml", GOOD.encode()).diagnostics == ()


@settings(max_examples=150)
@given(st.binary(max_size=300))
def test_bytes(data):
    check(data)


@settings(max_examples=150)
@given(st.text(alphabet=PIECES, max_size=60))
def test_texts_of_yaml_characters(text):
    check(text.encode("utf-8", "surrogatepass"))


@settings(max_examples=300)
@given(
    st.lists(
        st.tuples(
            st.integers(0, len(GOOD)), st.integers(0, 12), st.text(alphabet=PIECES, max_size=4)
        ),
        min_size=1,
        max_size=4,
    )
)
def test_changes_of_a_good_file(changes):
    text = GOOD
    for at, length, new in changes:
        text = text[:at] + new + text[at + length :]
    check(text.encode())


@settings(max_examples=300)
@given(st.text(alphabet="xU'()+-*/^.,=<> 12e\n", max_size=40))
def test_expressions(text):
    for parse in (parse_text, parse_equation_text):
        with suppress(ProblemError):
            parse(text)
