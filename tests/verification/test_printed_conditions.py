"""Conditions of existence: derived where a root in L is real, tried where they fail as well."""

from __future__ import annotations

import math
import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.problem_data import Problem
from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.statements.answers import EquilibriaSection
from lagcli.statements.motions import Above
from lagcli.verification import verified
from tests.solved import solve

from .sheets import derived

HEAD = (
    "coordinates: [x]\nparameters: {a: {assume: positive}, b: {assume: positive},"
    " c: {assume: positive}}\nT: x'^2/2\nV: "
)


def _read(potential: str) -> Problem:
    return read_problem("test.yaml", (HEAD + f'"{potential}"\n').encode()).checked()


def _equilibria(potential: str) -> EquilibriaSection:
    answers = solve(_read(potential), ["equilibria"])
    assert answers.complete, answers.warnings
    return answers.sections["equilibria"]


def _value(formula: str, values: dict[str, float]) -> float:
    names = {"sqrt": math.sqrt, "cos": math.cos, "sin": math.sin, "log": math.log, "pi": math.pi}
    return eval(formula.replace("^", "**"), {**names, **values})


@pytest.mark.parametrize("argument", ["a - b*cos(x)", "a^2 - b^2*sin(x/2)^2", "a + b*cos(x) - c"])
@pytest.mark.parametrize("outer", ["c*sqrt({})", "-c*({})^(3/2)", "b*log({})", "c/sqrt({})"])
def test_an_equilibrium_exists_where_the_potential_is_real(outer: str, argument: str) -> None:
    potential, source = outer.format(argument), random.Random(outer + argument)
    section = _equilibria(potential)
    places = [(each, to_grammar(each.at["x"])) for each in section.equilibria]
    assert {"0", "pi"} <= {place for _, place in places}
    for each, place in places:
        for _ in range(30):
            values = {name: source.uniform(0.2, 3) for name in "abc"}
            there = {**values, "x": _value(place, values)}
            held = all(
                _value(f"{to_grammar(c.left)} - ({to_grammar(c.right)})", values) > 0
                for c in each.where
            )
            assert held == (_value(argument, there) > 0), (place, values)


@pytest.mark.parametrize(
    "potential",
    [
        "c*sqrt(a - b*cos(x))",
        "b*log(a + b*cos(x) - c)",
        "a*cos(x) + b*cos(x)^2",  # x = acos(-a/(2 b)), not real where a > 2 b
        "c*(x^2 - a + b)^2",
        "a*exp(x) - (b - c)*x",
    ],
)
def test_existence_said_for_too_many_parameters_is_refuted(potential: str) -> None:
    problem, answers, section = _derived(potential)
    bare = tuple(replace(each, where=()) for each in section.equilibria)
    assert bare != section.equilibria
    _is_refuted(problem, answers, replace(section, equilibria=bare))


@pytest.mark.parametrize(
    "potential", ["c*sqrt(a + b + b*cos(x))", "c*(x^2 - a*b)^2", "a*x^2 + b*x", "c*cos(a*x)"]
)
@pytest.mark.parametrize("condition", [("a", "b"), ("b*c", "a"), ("c", "1")])
def test_existence_said_for_too_few_parameters_is_refuted(
    potential: str, condition: tuple[str, str]
) -> None:
    problem, answers, section = _derived(potential)
    narrow = Above(*map(parse_text, condition))
    fewer = tuple(replace(each, where=(narrow,)) for each in section.equilibria)
    _is_refuted(problem, answers, replace(section, equilibria=fewer))


def _derived(potential: str):
    problem = _read(potential)
    answers = statements(derive(problem)).answers(["equilibria"])
    assert verified(problem, answers) is answers
    return problem, answers, answers.sections["equilibria"]


def _is_refuted(problem: Problem, answers, section: EquilibriaSection) -> None:
    found = verified(problem, replace(answers, sections={"equilibria": section}))
    assert not found.complete
    assert found.sections["equilibria"].equilibria is None


@pytest.mark.parametrize("f", ["a + b*x^2", "1 + x^4", "exp(a*x)", "2 + cos(x)", "1 + a*x^2 + x^3"])
def test_a_flat_effective_potential_has_steady_motions_everywhere(f: str) -> None:
    """L = x'^2 + c x' y' + y'^2/f + k f: U_eff = (p^2/4 - k) f is 0 for p^2 = 4 k."""
    text = (
        "coordinates: [x, y]\nparameters: {a: {assume: positive}, b: {assume: positive},"
        " c: , k: {assume: positive}}\n"
        f"L: x'^2 + c*x'*y' + y'^2/({f}) + k*({f})\n"
    )
    problem = read_problem("test.yaml", text.encode()).checked()
    answers = solve(problem, ["steady_motions"])
    assert answers.complete, answers.warnings
    flat = [m for m in answers.sections["steady_motions"].motions if "x" not in m.at]
    assert {to_grammar(square) for m in flat for square in m.frequencies_squared} == {"0"}


@pytest.mark.parametrize("other", ["m > c", "p_phi > 1"])
def test_conditions_of_steady_motions_are_tried_where_they_fail(other: str) -> None:
    problem, answers = derived("particles/relativistic-coulomb", ("steady_motions",))
    assert verified(problem, answers) is answers
    section = answers.sections["steady_motions"]
    narrow = Above(*map(parse_text, other.split(" > ")))
    motions = tuple(replace(each, where=(*each.where, narrow)) for each in section.motions)
    spoiled = {"steady_motions": replace(section, motions=motions)}
    assert not verified(problem, replace(answers, sections=spoiled)).complete
