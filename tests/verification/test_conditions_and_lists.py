"""Conditions, free coordinates and empty lists that are not those of the motion are noticed."""

from __future__ import annotations

import pytest

from lagcli.expression import Product
from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.statements.motions import Above
from lagcli.verification import verified

HEAD = (
    "coordinates: %s\nparameters: {m: {assume: positive}, k: {assume: positive},"
    " b: {assume: positive}, w: {assume: positive}}\n%s\n"
)


def derived(coordinates: str, physics: str, section: str):
    listed = coordinates if coordinates.startswith("{") else f"[{coordinates}]"
    problem = read_problem("t.yaml", (HEAD % (listed, physics)).encode()).checked()
    answers = statements(derive(problem)).answers([section])
    assert verified(problem, answers) is answers
    return problem, answers, answers.sections[section]


def after(problem, answers, section):
    """The section after the verification, and its warnings."""
    [name] = answers.sections
    found = verified(problem, replace(answers, sections={name: section}))
    return found.sections[name], found.warnings


HOOPS = ["m*(x'^2 + w^2*sin(x)^2)/2|-k*cos(x)", "m*(x'^2 + w^2*x^2)/2|k*x^2/2 + b*x^4"]


@pytest.mark.parametrize("hoop", HOOPS)
@pytest.mark.parametrize("where", ["m*k > w", "w > k", "0 > -1", "m*w > 3*k"])
def test_a_period_with_other_conditions_is_refuted(hoop: str, where: str) -> None:
    T, V = hoop.split("|")
    problem, answers, section = derived("x", f"T: {T}\nV: {V}", "reduction")
    one = section.one_freedom
    assert all(each.where for each in one.periods if each.at)
    condition = Above(*map(parse_text, where.split(" > ")))
    periods = tuple(replace(each, where=(condition,)) for each in one.periods)
    false = replace(section, one_freedom=replace(one, periods=periods))
    _, warnings = after(problem, answers, false)
    assert any("period" in warning for warning in warnings)


@pytest.mark.parametrize("factor", ["1/2", "2", "-1"])
@pytest.mark.parametrize(
    ("coordinates", "physics"),
    [
        ("{x: {assume: positive}, u: {}}", "L: m*(x'^2 + x^2*u'^2)/2 + k*exp(-x)/x"),
        ("x", "L: m*x'^2/2 - k*sin(w*sin(x))"),
    ],
)
def test_a_period_about_a_minimum_that_is_rarely_there_is_examined(coordinates, physics, factor):
    """Yukawa's potential has one for small momenta only."""
    problem, answers, section = derived(coordinates, physics, "reduction")
    one = section.one_freedom
    false_periods = tuple(
        replace(p, period=Product((parse_text(factor), p.period))) for p in one.periods
    )
    false = replace(section, one_freedom=replace(one, periods=false_periods))
    _, warnings = after(problem, answers, false)
    assert any("period" in w and "could not be confirmed" in w for w in warnings)


@pytest.mark.parametrize("assume", ["positive", "negative", "nonnegative", "nonzero"])
def test_a_minimum_where_a_coordinate_may_not_be_is_none(assume: str) -> None:
    """V = (x - a)^2 with any a: rest, and a period, where the coordinate may be a."""
    text = (
        f"coordinates: {{x: {{assume: {assume}}}}}\nparameters: {{a: }}\nL: x'^2/2 - (x - a)^2/2\n"
    )
    problem = read_problem("t.yaml", text.encode()).checked()
    for section in ("equilibria", "reduction"):
        answers = statements(derive(problem)).answers([section])
        assert verified(problem, answers) is answers


@pytest.mark.parametrize("V", ["k*x^2/2", "-k*cos(x)", "b*x^4 - k*x^2", "k*x"])
def test_a_motion_that_turns_is_not_said_to_have_no_turning_point(V: str) -> None:
    problem, answers, section = derived("x", f"T: m*x'^2/2\nV: {V}", "reduction")
    false = replace(section, one_freedom=replace(section.one_freedom, turning_points=()))
    _, warnings = after(problem, answers, false)
    assert any("turning points" in warning for warning in warnings)


@pytest.mark.parametrize("V", ["k*x^2/2", "-k*cos(x)", "b*x^4 - k*x^2"])
def test_a_coordinate_with_a_value_is_not_free(V: str) -> None:
    physics = f"T: m*(x'^2 + y'^2)/2\nV: {V}"
    problem, answers, section = derived("x, y", physics, "equilibria")
    found = tuple(replace(each, free=("x", "y")) for each in section.equilibria)
    after_, _ = after(problem, answers, replace(section, equilibria=found))
    assert after_.equilibria is None


@pytest.mark.parametrize("sides", [("0", "0"), ("1", "0"), ("pi", "4")])
def test_a_condition_without_a_quantity_is_refuted(sides: tuple[str, str]) -> None:
    physics = "T: m*(x'^2 + w^2*x^2)/2\nV: k*x^2/2"
    problem, answers, section = derived("x", physics, "equilibria")
    void = (Above(*map(parse_text, sides)),)
    [each] = section.equilibria
    false = replace(each, verdict=replace(each.verdict, minimum=void))
    found, _ = after(problem, answers, replace(section, equilibria=(false,)))
    assert found.equilibria[0].verdict.stable is None
    assert not found.equilibria[0].verdict.minimum


@pytest.mark.parametrize("value", ["acos(6)", "asin(2) + 1", "sqrt(-3)", "log(-1)"])
def test_a_place_that_is_not_real_is_no_answer(value: str) -> None:
    physics = (
        "T: m*x'^2/2\nV: -k*cos(x)\ninitial: {x: 1, x': 0}\n"
        'find: {turn: {where: "x\' = 0", for: x}}'
    )
    problem = read_problem("t.yaml", (HEAD % ("[x]", physics)).encode()).checked()
    answers = statements(derive(problem)).answers(["find"])
    section = answers.sections["find"]
    [(name, answer)] = section.answers.items()
    false = replace(section, answers={name: replace(answer, solutions=(parse_text(value),))})
    found, _ = after(problem, answers, false)
    assert found.answers[name].solutions is None


@pytest.mark.parametrize("wrong", ["k > m*w", "k > m*w^3", "k*m > m*w^2", "k > 2*m*w^2"])
def test_the_condition_of_a_period_has_the_right_powers(wrong: str) -> None:
    """k > m w for k > m w² differs for some sizes of w only."""
    problem, answers, section = derived(
        "x", "T: m*(x'^2 + w^2*sin(x)^2)/2\nV: -k*cos(x)", "reduction"
    )
    periods = list(section.one_freedom.periods)
    [place] = [k for k, each in enumerate(periods) if to_grammar(each.at["x"]) == "0"]
    left, right = map(parse_text, wrong.split(">"))
    assert periods[place].where
    periods[place] = replace(periods[place], where=(Above(left=left, right=right),))
    one = replace(section.one_freedom, periods=tuple(periods))
    found, warnings = after(problem, answers, replace(section, one_freedom=one))
    assert found.one_freedom is None
    assert any("period" in each for each in warnings)
