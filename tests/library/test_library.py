"""The library, solved once for everything that is asked of it.

A sample of it is examined before every commit, all of it in `make check-all`:
- the answers are those that the files expect, and keep the laws of mechanics;
- every printed claim holds by a reference (jets, virtual work, a numeric KKT system, Noether's
  formula in numbers) that shares no code with lagcli's algebra or mechanics, only the reader;
- answers and explanation compile as LaTeX, none too wide.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import pytest

from lagcli import load
from lagcli.abbreviations import written_out
from lagcli.formatters import explaining
from lagcli.formatters.built_in.json import to_object
from lagcli.formatters.built_in.latex import render
from lagcli.formatters.display_width import display_width
from lagcli.formatters.options import Options
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import Request, derive, explain, state
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.answers import Answers
from lagcli.statements.registry import built_in
from lagcli.studies.check.expectations import sections_expected
from lagcli.studies.check.initial import initial_mistakes
from lagcli.studies.check.laws import SECTIONS as LAWS
from lagcli.studies.check.one import compared
from tests.formatters.test_latex import compiled, needs_latex
from tests.oracle.examine import examine

LIBRARY = Path(__file__).parents[2] / "problems"
FOLDERS = sorted({path.parent for path in LIBRARY.rglob("*.yaml")})
#: The first problem of every third folder.
SAMPLE = [min(folder.glob("*.yaml")) for folder in FOLDERS[::3]]
GROUPS = {
    "sample": SAMPLE,
    **{f.name: [p for p in sorted(f.glob("*.yaml")) if p not in SAMPLE] for f in FOLDERS},
}
EXAMINED = (
    "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
    "constraint_forces", "momenta", "energy", "hamiltonian", "canonical_equations",
    "charges", "find",
)  # fmt: skip


class Solved(NamedTuple):
    """One problem with its derivation and all sections that a test below reads."""

    name: str
    problem: Problem
    derivation: Derivation
    answers: Answers

    def with_sections(self, names: list[str]) -> Answers:
        kept = {n: s for n, s in self.answers.sections.items() if n in names}
        return replace(self.answers, sections=kept, absent=())


def usual(problem: Problem) -> list[str]:
    return [each.name for each in built_in() if each.unasked(problem)]


def checked(solved: Solved) -> list[str]:
    expected = [each.name for each in sections_expected(solved.problem.expect)]
    return expected if solved.derivation.no_lagrangian else [*LAWS, *expected]


def examined(problem: Problem) -> list[str]:
    return [name for name in EXAMINED if name != "find" or problem.find]


def solve(path: Path) -> Solved:
    problem = load(path)
    derivation = derive(problem)
    solved = Solved(str(path.relative_to(LIBRARY)), problem, derivation, None)
    names = (*usual(problem), *checked(solved), *examined(problem))
    return solved._replace(answers=state(derivation, Request(sections=tuple(dict.fromkeys(names)))))


@pytest.fixture(
    scope="module",
    params=[pytest.param(n, marks=() if n == "sample" else pytest.mark.long) for n in GROUPS],
)
def library(request) -> list[Solved]:
    """The solved problems of one folder."""
    return [solve(path) for path in GROUPS[request.param]]


def test_the_answers_are_those_that_are_expected(library):
    for each in library:
        assert (each.name, [n for n in checked(each) if n in each.answers.absent]) == (
            each.name,
            [],
        )
        if not each.derivation.no_lagrangian:
            assert (each.name, initial_mistakes(each.derivation.problem)) == (each.name, ())
        findings = [found for found in compared(each.derivation, each.answers) if found is not None]
        assert (each.name, findings) == (each.name, [])


def test_every_printed_claim_holds(library):
    for each in library:
        sheet = to_object(written_out(each.with_sections(examined(each.problem))))
        found = examine(each.problem, json.loads(json.dumps(sheet)), count=2)
        assert (each.name, [str(finding) for finding in found]) == (each.name, [])


class TestSet:
    pytestmark = needs_latex

    def test_the_answers_compile(self, library, tmp_path):
        answers = [each.with_sections(usual(each.problem)) for each in library]
        compiled(render(answers, Options(standalone=True)), tmp_path)

    def test_the_explanations_compile(self, library, tmp_path):
        # there is nothing to tell from an H whose velocities do not determine the momenta
        told = [explain(each.derivation) for each in library if not each.derivation.no_lagrangian]
        compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)
        for line in explaining.render(told, "text", Options(width=80)).splitlines():
            assert display_width(line) <= 80, line
        for format_name in ("markdown", "html", "json"):
            assert explaining.render(told, format_name, Options())

    def test_further_steps_of_explanations_compile(self, tmp_path):
        told = [
            explain(derive(load(LIBRARY / f"{name}.yaml")), also) for name, also in FURTHER.items()
        ]
        compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)


FURTHER = {
    "central/kepler": ("canonical", "discovered", "algebra"),
    "hamiltonian/oscillator-by-generating-function": ("canonical",),
    "rolling/disk-on-incline-with-contact": ("forces", "model", "dimensions"),
}
