"""Verdicts on stability against the motion itself, on the library and on random systems."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from lagcli import load
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import with_lagrangian
from lagcli.reader import read_problem

from .perturbed import Claim, claims, contradiction
from .random_systems import system

PROBLEMS = Path(__file__).parents[2] / "problems"
LIBRARY = sorted(PROBLEMS.rglob("*.yaml"))
SAMPLE = 7
ALL = 500
SHORT = (
    "pendulums/plane-pendulum",
    "contact/car-in-loop",
    "friction/block-stops-on-incline",
    "impact/bouncing-ball",
    "steady/penning-trap",
)


def claimed(text: str) -> list[Claim]:
    return list(claims(Derivation(read_problem("random.yaml", text.encode()).checked())))


def examined(found: list[Claim]) -> list[str]:
    return [f"{dict(claim.state)}: {what}" for claim in found if (what := contradiction(claim))]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(SAMPLE))
def test_what_is_called_stable_stays_and_what_is_called_unstable_leaves(seed: int) -> None:
    assert not examined(claimed(system(seed)))


@pytest.mark.hours
@pytest.mark.parametrize("seed", range(SAMPLE, ALL))
def test_the_same_of_many_systems(seed: int) -> None:
    assert not examined(claimed(system(seed)))


@pytest.mark.first_quick
@pytest.mark.parametrize("name", SHORT)
def test_some_problems_of_the_library(name: str) -> None:
    problem = load(PROBLEMS / f"{name}.yaml")
    assert not examined(list(claims(Derivation(with_lagrangian(problem)))))


@pytest.mark.hours
@pytest.mark.parametrize("path", LIBRARY, ids=lambda path: path.stem)
def test_the_library(path: Path) -> None:
    problem = load(path)
    derivation = Derivation(with_lagrangian(problem))
    if problem.functions or derivation.large_form is not None or derivation.no_lagrangian:
        return  # nothing to run, or nothing said
    assert not examined(list(claims(derivation)))


@pytest.mark.long
@pytest.mark.parametrize("seed", [0, 1, 3])
def test_a_wrong_verdict_is_found(seed: int) -> None:
    """Of a claim and its opposite, the motion contradicts one."""
    found = claimed(system(seed))
    assert found
    for claim in found:
        assert contradiction(replace(claim, stable=not claim.stable))
