"""What is carried over from Markdown, LaTeX, Python and other tongues: one mistake, one hint."""

from __future__ import annotations

import random

import pytest

from tests.reader.test_habits import messages, text

UNREAD = "this line is none of the file"


@pytest.mark.parametrize("seed", range(12))
def test_a_number_whose_exponent_is_not_one_is_named_so(seed):
    draw = random.Random(seed)
    number = draw.choice(["2.0", "1", "6.67", ".5", "30."])
    digits = draw.randrange(1, 30)
    letter = draw.choice("eE")
    [without] = messages(text(V=f"{number}{letter}*x"))
    assert f"as in {number}e-3; a product is {number}*{letter}" in without
    for written in (f"{number} {letter}-{digits}", f"{number}d-{digits}", f"{number}e - {digits}"):
        [apart] = messages(text(parameters=f"{{m: 1, k: {written}}}"))
        assert f"write {number}e-{digits}; a product is" in apart
    [times] = messages(text(parameters=f"{{m: 1, k: {number} x 10^-{digits}}}"))
    assert times.endswith(f"write {number}e-{digits}")


@pytest.mark.parametrize("going_on", ["- k*x", "+ k*x", "k*x", "= 1", "*k"])
@pytest.mark.parametrize("comment", ["# spring", "# a: b", "#"])
def test_a_comment_within_a_value_is_named_where_it_stands(going_on, comment):
    behind = text(V=f"k*x^2/2   {comment}\n  {going_on}")
    between = text(V=f"k*x^2/2\n  {comment}\n  {going_on}")
    for written in (behind, between):
        assert messages(written) == [
            "a comment ends the value that goes on below it; put it on a line above the key"
        ]


HINTS = [
    (text(V="**k*x^2/2**"), "leave out '**': write k*x^2/2"),
    (text(V="*k*x^2/2*"), "leave out '*': write k*x^2/2"),
    (text(V="`k*x^2/2`"), "leave out '`': write k*x^2/2"),
    (text(V=None, **{"**V**": "k*x"}), "leave out '**': write V:"),
    (text(V=None, **{"$V$": "k*x"}), "the key is V"),
    ("* coordinates: [x]\n* T: x'^2\n", "leave out '*': write coordinates:"),
    ("| coordinates | x |\n|---|---|\n", "without a table"),
    (text(source="[Goldstein](http://example.org)"), "put the whole text in quotes"),
    ('"""A pendulum"""\n' + text(), "a comment begins with '#'"),
    ("import sympy\n" + text(), "leave it out"),
    (text(V="{m*g}*x"), "group with parentheses ( )"),
    (text(V="&= k*x \\\\"), "leave out '&' and '='"),
    (text(V="\\arctan{x}"), "write atan"),
    (text(V="-\\partial U/\\partial x"), "write diff(expression, name)"),
    (text(V="k*\\mathrm{cos}(x)"), "write cos"),
    (text(T="m*x.diff(t)**2/2"), "write x'"),
    (text(T="m*x(t).diff(t)**2/2"), "write x'"),
    (text(forces="{x: m*x.diff(t, t)}"), "comma ends the value"),
    (text(forces="\n  x: m*x.diff(t, 2)"), "write x''"),
    (text(forces="\n  x: m*Derivative(x, t, 2)"), "write x''"),
    (text(forces="\n  x: -m.diff(x)"), "write diff(m, x)"),
    (text(T="sp.Rational(1, 2)*m*x'^2"), "write 1/2"),
    (text(T="Rational(1, 2)*m*x'^2"), "write 1/2"),
    (text(V="np.arctan2(x, k)"), "write atan2"),
    (text(V="k*norm(x, k)"), "write sqrt(x^2 + k^2)"),
    (text(V="cosd(x)"), "write cos(x*pi/180)"),
    (text(V="max(x, k, 0)"), "compare two at a time"),
    (text(V="-grad(U)"), "found from V"),
    (text(T="sum(m*x_i'^2, i=1..2)"), "write each term"),
    (text(T="sum(m*x_i'^2 for i in range(2))"), "write each term"),
    (text(V="x > 0 ? k*x : 0"), "(1 + sign(x))/2"),
    (text(V="k*\u200bx"), "leave it out"),
    (text(V="k\u2009\u202ax"), "leave it out"),
    (text().replace("T: ", "T:\u00a0"), "type a usual blank"),
    (text(T="m*(x)'^2/2"), "write x'"),
    (text(T="m*x^2'/2"), "write x'^2"),
    (text(parameters="{m: 1'000}"), "write 1000"),
    (text(parameters="{m: {value: 1,5, unit: kg}, k: 1}"), "a decimal point is written '.'"),
    (text(parameters="\n  m: [1, kg]\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="\n  m: 1 [kg]\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="\n  m: 1 (kg)\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="{m: 1, k: {value: 2, unit: kg s-2}}"), "'^': ^-2"),
    (text(parameters="symbols('m k')"), "write [m, k]"),
    (text(coordinates="[x = dynamicsymbols('x')]"), "write x"),
    (text(coordinates="[x[1], x[2]]"), "write x_1"),
    (text(coordinates="[θ]", T="m*θ'^2", V="cosθ*theta"), "write cos(θ)"),
    (text(constraints="{a: x → 1}"), "write an equation with '='"),
    (text(constraints="{a: 0 < x < 1}"), "as in floor: y >= 0"),
    (text(forces="(-k*x)"), "write x: "),
    (text(expect="{equations: m*x'' = -k*x}"), "write [m*x'' = -k*x]"),
    (text(D="m*x'^2"), "the key is dissipation"),
    (text(simulation="{t: 10}"), "the key is until"),
    (text(coordinates=None, Koordinaten="[x]"), "the key is coordinates"),
    (text(parameters=None, T="x'^2", V="x", paramètres="{m: 1}"), "the key is parameters"),
    (text(coordinates=None, coordnates="[x]"), "did you mean 'coordinates'"),
]


@pytest.mark.parametrize(("written", "hint"), HINTS)
def test_what_is_meant_is_named_first(written, hint):
    first = messages(written)[0]
    assert hint in first


@pytest.mark.parametrize("shape", ["(x, 0)", "(x, atan2(x, k))", "((x), 0)"])
def test_a_list_in_parentheses_is_one_mistake(shape):
    inner = f"[{shape[1:-1]}]"
    for points in (f"{{P: {{mass: m, position: {shape}}}}}",
                   f"\n  P:\n    mass: m\n    position: {shape}"):  # fmt: skip
        [only] = messages(text(points=points))
        assert inner in only


def test_a_name_that_is_misspelled_alike_is_told_once():
    written = text(coordinates="[θ]", T="m*theta'^2", V="theta + theta^2", initial="{θ: 1}")
    assert messages(written) == ["unknown name 'theta' in T; did you mean 'θ'?"]


@pytest.mark.parametrize("mark", ["//", ";", "%", "<!--", "--", "/*", '"""'])
@pytest.mark.parametrize("above", [0, 1, 3])
def test_a_comment_of_another_language_is_named(mark, above):
    lines = text().splitlines(keepends=True)
    written = "".join([*lines[:above], f"{mark} a spring\n", *lines[above:]])
    assert messages(written) == ["this line is none of the file; a comment begins with '#'"]


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        ("[problem]\ncoordinates = x\n", "a key is written without brackets"),
        ("<problem>x</problem>\n", "without tags"),
        (text(V="k\\,x"), "leave out \\,"),
        (text(forces="{x: m*\\ddot{x}}"), "write x''"),
        (text(T="m*x'[t]^2/2"), "write x'"),
        (text(T="m*der(x)^2/2"), "write x'"),
        (text(V="std::pow(x, 2)"), "write x^2"),
        (text(constraints='{a: "Eq(x, 1)"}'), "write left = right"),
        (text(parameters="\n  m: 1\n  k: N/m"), "write {unit: N/m}"),
        (text(coordinates="{x: {unit: °}}"), "did you mean 'deg'"),
        (text(V="m*g*„x“"), "leave them out"),
        (text(expect="{eom: [m*x'' = -k*x]}"), "the key is equations"),
    ],
)
def test_other_programs_and_other_marks(written, hint):
    [only] = messages(written)
    assert hint in only
