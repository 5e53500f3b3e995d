"""Questions in other keys: the hint is the question that stands there, by its values."""

import random

import pytest

from lagcli.reader import read_problem

PROBLEM = """\
coordinates: [r, theta]
parameters: {m: 1, g: 9.81, R: 1}
T: m*(r'^2 + r^2*theta'^2)/2
V: m*g*r*cos(theta)
constraints: {surface: {equation: r = R, multiplier: N}}
find:
  angle: """
FORMS = [
    ("where", "N = 0", "for", "theta"),
    ("where", "theta'^2 = g/R", "for", "g"),
    ("always", "N >= 0", "for", "R"),
    ("reaches", "theta = pi", "for", "m"),
    ("value", "theta'^2 + g/R", "in_terms_of", "[theta]"),
]
WORDS = "when solve condition equation variable unknown in at find of gives eq key what".split()


def read(question):
    return read_problem("f.yaml", f"{PROBLEM}{{{question}}}\n".encode())


def told(question):
    (mistake,) = read(question).diagnostics
    assert (mistake.span.line, mistake.span.column) == (7, 3)
    return mistake.hint


@pytest.mark.parametrize(("about", "law", "wanted", "name"), FORMS)
def test_the_values_tell_the_keys(about, law, wanted, name):
    good = f"{about}: {law}, {wanted}: {name}"
    assert read(good).problem is not None
    drawn = random.Random(good)
    for _ in range(6):
        one, other = drawn.sample(WORDS, 2)
        entries = [f"{one if about != 'reaches' else about}: {law}", f"{other}: {name}"]
        drawn.shuffle(entries)
        assert told(", ".join(entries)) == f"write angle: {{{good}}}"
    assert told(f"{about}: {law}, {drawn.choice(WORDS)}: {name}") == f"write angle: {{{good}}}"
    assert told(f"{good}, guess: 1") == f"write angle: {{{good}}}"


@pytest.mark.parametrize(
    ("question", "meant"),
    [
        ("where: N = 0, value: theta", "where: N = 0, for: theta"),
        ("where: N = 0, in_terms_of: [theta]", "where: N = 0, for: theta"),
        ("N = 0: theta", "where: N = 0, for: theta"),
        ("theta: N = 0", "where: N = 0, for: theta"),
        ("N: 0, for: theta", "where: N = 0, for: theta"),
        ("theta where N = 0", "where: N = 0, for: theta"),
        ("condition: N < 0, for: theta", "where: N = 0, for: theta"),
        ("for: theta", "where: theta' = 0, for: theta"),
        ("maximize: theta", "where: theta' = 0, for: theta"),
        ("always: N >= 0", "always: N >= 0, for: m"),
        ("where: theta'^2, in terms of: theta", "value: theta'^2, in_terms_of: [theta]"),
        ("value: theta'^2, for: theta", "value: theta'^2, in_terms_of: [theta]"),
        ("value: theta'^2, in_terms_of: theta, r", "value: theta'^2, in_terms_of: [theta, r]"),
    ],
)
def test_other_forms(question, meant):
    assert told(question) == f"write angle: {{{meant}}}"
    assert read(meant).problem is not None


@pytest.mark.parametrize("question", ["when: N = 0, solve: theta", "where: N = 0, for: theta"])
@pytest.mark.parametrize("begin", ["{%s}", "[{%s}]"])
def test_a_question_without_a_name(question, begin):
    text = PROBLEM.replace("\n  angle: ", f" {begin % question}\n")
    (mistake,) = read_problem("f.yaml", text.encode()).diagnostics
    assert "name: {where: N = 0, for: theta}" in mistake.hint


ASKED = ["period of small oscillations", "small oscillations", "[theta'', omega]", "frequency",
         "omega = sqrt(g/R)", "{omega: sqrt(g/R)}", "{T_0: 2*pi*sqrt(R/g)}", "{period: T}"]  # fmt: skip


@pytest.mark.parametrize("state", ["", "initial: {theta: 1}\n"])
@pytest.mark.parametrize("asked", ASKED)
def test_what_is_found_needs_no_question(asked, state):
    text = PROBLEM.partition("find:")[0] + f"{state}find: {asked}\n"
    (mistake,) = read_problem("f.yaml", text.encode()).diagnostics
    assert mistake.hint.startswith("leave it out: ")
    assert " frequencies and charges are found by lagcli solve f.yaml --show " in mistake.hint
    assert "modes" in mistake.hint
    example = mistake.hint.partition("; or write ")[2]
    assert not example or (state and read_problem("f.yaml", text.replace(asked, example).encode()))


@pytest.mark.parametrize("asked", ["T: theta'^2", "omega: r*theta'", "f: g*r"])
def test_a_formula_that_moves_is_a_question(asked):
    text = PROBLEM.partition("find:")[0] + f"find: {{{asked}}}\n"
    (mistake,) = read_problem("f.yaml", text.encode()).diagnostics
    assert mistake.hint.startswith(f"write {{value: {asked.partition(': ')[2]}, in_terms_of: [")


@pytest.mark.parametrize(
    "asked",
    [
        "lambda_rod(theta)",
        "{value: lambda_rod(theta), in_terms_of: [theta]}",
        "{value: tension, in_terms_of: [theta]}",
        "{value: normal_force, in_terms_of: [theta]}",
    ],
)
def test_a_multiplier_has_its_name_without_arguments(asked):
    begin = "coordinates: [r, theta]\nparameters: [m, g, l]\nT: m*(r'^2 + r^2*theta'^2)/2\n"
    rest = "V: -m*g*r*cos(theta)\nconstraints: {rod: r = l}\nfind: {tension: "
    [only] = read_problem("p.yaml", f"{begin}{rest}{asked}}}\n".encode()).diagnostics
    assert "write lambda_rod" in only.hint or "value: lambda_rod, in" in only.hint


@pytest.mark.parametrize(
    "written",
    ["{} and t > 0", "{} && t > 0", "t > 0 and {}", "{} or x = h", "[{}, t > 0]"],
)
@pytest.mark.parametrize("equation", ["y = 0", "y = h", "y' = v - x"])
def test_of_several_statements_the_equation_is_asked(equation, written):
    begin = "coordinates: [x, y]\nparameters: [m, g, h, v]\nT: m*(x'^2 + y'^2)/2\n"
    law = written.format(equation)
    text = f"{begin}V: m*g*y\nfind:\n  landing:\n    where: {law}\n    for: x\n"
    found = read_problem("p.yaml", text.encode()).diagnostics
    assert [each.hint.partition("write ")[2] for each in found] == [equation]


def test_a_question_is_for_one_name():
    begin = "coordinates: [x, y]\nparameters: [m, g]\nT: m*(x'^2 + y'^2)/2\nV: m*g*y\n"
    text = f"{begin}find: {{landing: {{where: y = 0, for: [x, t]}}}}\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint == "one alone: write x"
