"""Bounds, ranges and relations: the assumption that a hint names is true of every value allowed."""

from __future__ import annotations

import operator
import random

import pytest

from lagcli.reader import read_problem
from lagcli.reader.sign_meant import sign_meant
from tests.reader.test_habits import messages, text

RELATIONS = {">": operator.gt, ">=": operator.ge, "<": operator.lt, "<=": operator.le}
TRUE_OF = {
    "positive": lambda x: x > 0,
    "negative": lambda x: x < 0,
    "nonnegative": lambda x: x >= 0,
    "nonzero": lambda x: x != 0,
}
VALUES = [each / 4 for each in range(-20, 21)]


def strongest(allowed):
    """The first assumption that is true of all values; `nonzero` is none of an interval."""
    return next((a for a in TRUE_OF if a != "nonzero" and all(map(TRUE_OF[a], allowed))), "")


@pytest.mark.parametrize("relation", RELATIONS)
@pytest.mark.parametrize("bound", [-3, -0.5, 0, 0.5, 2])
def test_a_relation_says_the_assumption_that_is_true_of_its_values(relation, bound):
    allowed = [x for x in VALUES if RELATIONS[relation](x, bound)]
    mirrored = relation.translate(str.maketrans("<>", "><"))
    expected = strongest(allowed)
    assert sign_meant(f"m {relation} {bound}") == expected
    assert sign_meant(f"{bound}", relation) == expected
    assert sign_meant(f"{bound} {mirrored} m") == expected


@pytest.mark.parametrize("seed", range(20))
def test_a_range_says_the_assumption_that_is_true_of_its_values(seed):
    draw = random.Random(seed)
    low, high = sorted(draw.sample([-3, -1, 0, 1, 2.5], 2))
    begin, end = draw.choice("[("), draw.choice("])")
    allowed = [x for x in VALUES if (low < x or (x == low and begin == "["))
               and (x < high or (x == high and end == "]"))]  # fmt: skip
    assert sign_meant(f"{begin}{low}, {high}{end}") == strongest(allowed)


WORDS = [
    ("[real, positive]", "positive"),
    ("[positive, real]", "positive"),
    ("[nonnegative, nonzero]", "positive"),
    ("{negative: true, real: true}", "negative"),
    ("real nonzero", "nonzero"),
    ("positive constant", "positive"),
    ("[positive, negative]", ""),
    ("not positive", ""),
    ("{positive: false}", ""),
    ("positive or zero", "nonnegative"),
    ("positive or negative", "nonzero"),
    ("negative or zero", ""),
    ("nonpositive", ""),
    ("> 0, real", "positive"),
    ("Element[g, Reals] && g > 0", "positive"),
    ("g ∈ Reals", "real"),
    ("R+", "positive"),
    ("positive reals", "positive"),
    ("0 <= m <= 5", "nonnegative"),
    ("-1 < m < 5", ""),
]


@pytest.mark.parametrize(("written", "sign"), WORDS)
def test_of_several_assumptions_the_strongest_is_meant(written, sign):
    assert sign_meant(written) == sign


HINTS = [
    (text(parameters="{m: {assume: [real, positive]}, k: 1}"), "write positive"),
    (text(parameters="{m: {assume: constant}, k: 1}"), "leave it out"),
    (text(parameters="{m: {value: 1, gt: 0}, k: 1}"), "write assume: positive"),
    (text(parameters="{m: {value: 1, exclusiveMinimum: 0}, k: 1}"), "write assume: positive"),
    (text(parameters="{m: {value: 1, min: 0}, k: 1}"), "write assume: nonnegative"),
    (text(parameters="{m: {value: 1, min: 1e-3}, k: 1}"), "write assume: positive"),
    (text(parameters="{m: {value: 1, min: 0.1 kg}, k: 1}"), "write assume: positive"),
    (text(parameters="{m: {value: 1, range: 0..5}, k: 1}"), "write assume: nonnegative; several"),
    (text(parameters="{m: {assume: positive, min: 0}, k: 1}"), "leave it out"),
    (text(parameters="{m: {value: 1, positive: false}, k: 1}"), "leave it out"),
    (
        text(parameters="{m: {value: 1, range: [0, 3]}, k: 1}"),
        "write assume: nonnegative; several are run by lagcli sweep p.yaml --vary m=0:3:4",
    ),
    (text(coordinates="{x: {range: [0, 3]}}"), "leave it out: a coordinate has no range"),
    (text(coordinates="{x: {min: 0}}"), "write assume: nonnegative"),
    (text(parameters="{m: {value: 1, displayUnit: g}, k: 1}"), "leave it out: numbers are in"),
    (text(parameters="{m: {value: 1, nominal: 2}, k: 1}"), "leave it out: value is given already"),
    (text(parameters="{m: {quantity: 1}, k: 1}"), "the key is value"),
    (text(parameters="{m: {value: 1, quantity: Mass}, k: 1}"), "leave it out"),
    (text(parameters="{m: {value: 1, tunable: true}, k: 1}"), "every parameter is a constant"),
    (text(parameters="{m: {value: 1, help: mass}, k: 1}"), "the key is description"),
    (text(parameters="{m: {value: 1, label: mass}, k: 1}"), "the key is description"),
    (text(parameters="{m: {unit: '-'}, k: 1}"), "write 1"),
    (text(parameters="{m: {value: {1, kg}}, k: 1}"), "write value: 1, unit: kg"),
    (text(parameters="{m: {value: [1, kg]}, k: 1}"), "write value: 1, unit: kg"),
    (text(parameters="{m: {value: 1, unit: kilogram square metre}, k: 1}"), "write kg*m^2"),
    (text(parameters="\n  m: float = 1.0\n  k: float = 2"), "write 1.0; in line 4 write 2"),
    (text(coordinates="[x(t) = 0.1]"), "write [x], and below it initial: {x: 0.1}"),
    (text(title="[Wheel, rolling]"), "write Wheel, rolling"),
    (
        text(parameters="\n  m: 1\n  k: [4, N/m, spring]"),
        "{value: 4, unit: N/m, description: spring}",
    ),
    (text(forces="{x: {value: -k*x, unit: N}}"), "write -k*x"),
    (text(coordinates="{x: {type: revolute}}"), "leave it out"),
    (text(T=None, V=None) + "L := m*x'^2/2:", "write L: m*x'^2/2"),
    (text(parameters="\n  m:\n    unit: -\n  k: 1"), "write unit: 1"),
    (text(parameters="\n  m:\n    unit: -  # none\n  k: 1"), "write unit: 1"),
    (text(parameters="\n  m:\n    value: -\n  k: 1"), "leave out the key"),
    (text(parameters="{m: {unit: unitless}, k: 1}"), "did you mean '1'?"),
]


@pytest.mark.parametrize(("written", "hint"), HINTS)
def test_what_other_programs_say_of_a_quantity_gets_the_hint_that_helps(written, hint):
    [only] = messages(written)
    assert hint in only.partition("; ")[2]


@pytest.mark.parametrize("written", ["nonpositive", "not positive", "negative or zero", "no sign"])
def test_no_stronger_assumption_is_proposed_than_what_is_said(written):
    [only] = messages(text(parameters=f"{{m: {{assume: {written}}}, k: 1}}"))
    assert only.endswith("; write one of real, positive, nonnegative, nonzero, negative")


def test_equal_hints_name_the_keys_of_their_lines():
    written = text(parameters="\n  m: {value: 1, gt: 0}\n  k: {value: 1, min: 1}\n  g: {gt: 0}")
    [only] = messages(written)
    assert only.endswith("write assume: positive; in lines 4 ('min'), 5 the same")
    written = text(parameters="\n  m: {unit: '-'}\n  k: {unit: '-'}\n  g: {unit: '-'}")
    [only] = messages(written)
    assert only.endswith("write 1; in lines 4, 5 the same")


@pytest.mark.parametrize("seed", range(16))
def test_what_is_assumed_of_several_names_stands_with_each(seed):
    """`parameters: {positive: [m, k]}`, or `assumptions: m > 0, k > 0` on a line of its own."""
    draw = random.Random(seed)
    signs = {"m": "positive", "k": draw.choice(["positive", "negative", "nonnegative"])}
    relation = {"positive": "> 0", "negative": "< 0", "nonnegative": ">= 0"}.get
    inner = {name: f"assume: {sign}" for name, sign in signs.items()}
    related = [f"{name} {relation(sign)}" for name, sign in signs.items()]
    by_sign = {sign: [x for x in signs if signs[x] == sign] for sign in signs.values()}
    listed = [f"{sign}: [{', '.join(names)}]" for sign, names in by_sign.items()]
    plain = [f"{sign}: {', '.join(names)}" for sign, names in by_sign.items()]
    written, line = draw.choice(
        [
            (text(parameters=f"{{{', '.join(listed)}}}"), ""),
            (text(parameters="".join(f"\n  {each}" for each in plain)), ""),
            (text(parameters="[m, k]") + f"assumptions: {', '.join(related)}\n", "parameters: "),
            (text(parameters="[m, k]") + f"assume: [{', '.join(related)}]\n", "parameters: "),
            (text(parameters="[m, k]") + f"assumptions: {signs}\n".replace("'", ""), "parameters: "),
            (
                text(parameters="{m: 2, k: {value: 1, assume: positive}}")
                + f"assumption: {signs}\n".replace("'", ""),
                "parameters: ",
            ),
        ]
    )  # fmt: skip
    if "value: 1" in written:
        inner = {"m": f"value: 2, {inner['m']}", "k": f"value: 1, {inner['k']}"}
    names = [name for names in by_sign.values() for name in names] if not line else [*signs]
    whole = ", ".join(f"{name}: {{{inner[name]}}}" for name in names)
    [only] = messages(written)
    assert only.endswith(f"write {line}{{{whole}}}")
    if "value" not in written:
        assert messages(text(parameters=f"{{{whole}}}")) == []


def test_an_attribute_beside_a_heading_is_that_of_all_its_names():
    [only] = messages(text(parameters="{names: [m, k], assume: positive}"))
    assert only.endswith("write {m: {assume: positive}, k: {assume: positive}}")


PROSE = "A mass on a spring"


@pytest.mark.parametrize("more", ["that moves", "with friction\nof 3 percent", "it", "of mass m."])
@pytest.mark.parametrize("mark", ["", "|\n", ">\n"])
def test_a_line_that_goes_on_with_a_text_is_told_to_be_indented(more, mark):
    written = f"description: {mark}{PROSE}\n{more}\n" + text()
    first, *others = range(2, 2 + (mark + more).count("\n") + 1)
    also = f", also in line{'s' * bool(others[1:])} {' and '.join(map(str, others))}"
    [only] = messages(written)
    hint = "begin the line further right: it goes on with line 1"
    assert only.endswith(hint + also * bool(others))
    indented = written.split("\n")
    for line in (first, *others):
        indented[line - 1] = f"  {indented[line - 1]}"
    assert messages("\n".join(indented)) == []


@pytest.mark.parametrize("line", ["parameters m, k", "kinetic energy m*x'^2/2", "V k*x", "model A"])
def test_a_line_of_its_own_below_a_title_goes_on_with_nothing(line):
    found = messages(f"title: A\n{line}\n" + text(parameters=None, T=None, V=None))
    assert not any("further right" in each for each in found)


def test_a_semicolon_that_is_left_out_does_not_part_the_lines_of_a_hint():
    written = text(T=None, V=None) + "T := m*x'^2/2;\nV := k*x^2/2;\n"
    [only] = messages(written)
    assert only.endswith("write T: m*x'^2/2, in line 4 write V: k*x^2/2")


@pytest.mark.parametrize("form", ["n: {}", "n: {{assume: {}}}", "n: {{value: {}}}"])
@pytest.mark.parametrize(
    ("said", "sign"),
    [("integer", ""), ("positive integer", "positive"), ("integer, nonzero", "nonzero"),
     ("natural", "positive"), ("natural number", "positive"), ("int", "")],
)  # fmt: skip
def test_an_integer_is_no_description(form, said, sign):
    """As a description, or as a sign alone, it would be accepted and lost."""
    if "," in said:
        said = f"'{said}'"
    given = {"coordinates": "[x]", "T": "x'^2/2", "V": "x^2*cos(2*pi*n)"}
    [found] = messages(text(**given, parameters=f"\n  {form.format(said)}"))
    assert "integer: yes" + f", assume: {sign}" * bool(sign) in found


@pytest.mark.parametrize(
    ("T", "V", "rest"),
    [
        ("m*x'^2/2 - m*g*x", "-m*g*x", "none of it"),
        ("m*x'^2/2 - m*g*x", "m*g*x", "it twice"),
        ("m*x'^2/2 + m*g*x", "k*x^2/2 + m*g*x", "none of it"),
        ("m*x'^2/2 + k*x^2/2", "m*g*x", None),
        ("m*x'^2/2 + m*g*x'", "-m*g*x", None),
    ],
)
def test_a_potential_in_t_and_in_v_is_warned_of(T, V, rest):
    file = f"coordinates: [x]\nparameters: [m, g, k]\nT: {T}\nV: {V}\n"
    found = [d.message for d in read_problem("p.yaml", file.encode()).diagnostics]
    assert [m.partition("L = T - V has ")[2] for m in found] == ([rest] if rest else [])
