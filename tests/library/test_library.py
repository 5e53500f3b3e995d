"""The library, solved once for everything that is asked of it.

A sample of it is examined before every commit, all of it in `make check-all`:
- the answers are those that the files expect, and keep the laws of mechanics;
- every printed claim holds by a reference (jets, virtual work, a numeric KKT system, Noether's
  formula in numbers) that shares no code with lagcli's algebra or mechanics, only the reader;
- answers and explanation compile as LaTeX, none too wide;
- the page of each logs nothing in a browser, asks for nothing and is no wider than a phone.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

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
from lagcli.statements.explanation import Explanation
from lagcli.statements.registry import built_in
from lagcli.studies.check.expectations import sections_expected
from lagcli.studies.check.initial import initial_mistakes
from lagcli.studies.check.one import SECTIONS as VERIFIED
from lagcli.studies.check.one import compared
from tests.browser import PROGRAM, Browser
from tests.formatters.test_latex import compiled, needs_latex
from tests.gallery import explained, made, write_list
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


@dataclass(frozen=True)
class Solved:
    """One problem with its derivation and all sections that a test below reads."""

    name: str
    problem: Problem
    derivation: Derivation
    answers: Answers

    @cached_property
    def explanation(self) -> Explanation | None:
        return explained(self.derivation)

    def with_sections(self, names: list[str]) -> Answers:
        kept = {n: s for n, s in self.answers.sections.items() if n in names}
        return replace(self.answers, sections=kept, absent=())


def usual(problem: Problem) -> list[str]:
    return [each.name for each in built_in() if each.by_default(problem)]


def checked(derivation: Derivation) -> list[str]:
    expected = [each.name for each in sections_expected(derivation.given.expect)]
    return expected if derivation.no_lagrangian else [*VERIFIED, *expected]


def examined(problem: Problem) -> list[str]:
    return [name for name in EXAMINED if name != "find" or problem.find]


def solve(path: Path) -> Solved:
    problem = load(path)
    derivation = derive(problem)
    names = (*usual(problem), *checked(derivation), *examined(problem))
    answers = state(derivation, Request(sections=tuple(dict.fromkeys(names))))
    return Solved(str(path.relative_to(LIBRARY)), problem, derivation, answers)


@pytest.fixture(
    scope="module",
    params=[pytest.param(n, marks=() if n == "sample" else pytest.mark.long) for n in GROUPS],
)
def library(request) -> list[Solved]:
    """The solved problems of one folder."""
    return [solve(path) for path in GROUPS[request.param]]


def test_the_answers_are_those_that_are_expected(library):
    for each in library:
        absent = [n for n in checked(each.derivation) if n in each.answers.absent]
        assert (each.name, absent) == (each.name, [])
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
        told = [each.explanation for each in library if each.explanation]
        compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)
        for line in explaining.render(told, "text", Options(width=80)).splitlines():
            assert display_width(line) <= 80, line
        for format_name in ("markdown", "html", "json"):
            assert explaining.render(told, format_name, Options())

    @pytest.mark.long
    def test_further_steps_of_explanations_compile(self, tmp_path):
        told = [
            explain(derive(load(LIBRARY / f"{name}.yaml")), also) for name, also in FURTHER.items()
        ]
        compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)


@pytest.mark.long
@pytest.mark.skipif(PROGRAM is None, reason="chromium is missing")
def test_the_pages_are_quiet_and_fit_on_a_phone(library, tmp_path):
    cards = [
        made(each.name.removesuffix(".yaml"), each.derivation, each.explanation, tmp_path)
        for each in library
    ]
    write_list(cards, tmp_path)
    wrong = {}
    with Browser() as browser:
        for name in ("index", *(card.name for card in cards)):
            said = browser.complaints(tmp_path / f"{name}.html")
            # the list of the gallery shows the pictures that lie beside it
            out = [each for each in said if not each.startswith(tmp_path.as_uri())]
            if out or browser.pixels_too_wide() > 0:
                wrong[name] = out
    assert wrong == {}


FURTHER = {
    "central/kepler": ("canonical", "discovered", "algebra"),
    "hamiltonian/oscillator-by-generating-function": ("canonical",),
    "rolling/disk-on-incline-with-contact": ("forces", "model", "dimensions"),
}
