"""A sample of the random systems in every run of the tests, all of them where asked for.

`python -m tests.random_systems.run` is the same with a count, and says what is not right.
"""

from __future__ import annotations

import pytest

from .kinds import KINDS
from .run import in_a_fork, judged, system

#: A bar of 1 %: what may not have been found.  Nothing may be wrong, crash, or take 60 s.
ALL, MISSING = 5000, 50
LARGE = {
    "linkages",
    "crowds",
    "factored_pairs",
    "curved",
    "branches",
    "near_miss",
    "names",
    "hamiltonians",
    "turning",
    "equal_springs",
    "two_angles",
    "field_gauges",
    "passing_ranks",
}
MILD = {"missing", "trivial"}


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_said_of_some_is_true(kind: str) -> None:
    numbers = (0,) if kind in LARGE else (0, 1)
    found = [each for number in numbers for each in judged(system(kind, number))]
    assert [each for each in found if each.verdict not in MILD] == []


@pytest.mark.hours
@pytest.mark.timeout(4 * 3600)
def test_what_is_said_of_all_is_true() -> None:
    wrong, missing = [], 0
    for count in range(ALL):
        kind = list(KINDS)[count % len(KINDS)]
        found, _ = in_a_fork(system(kind, count // len(KINDS)))
        verdicts = {each["verdict"] for each in found}
        missing += "missing" in verdicts
        if verdicts - MILD:
            wrong.append((kind, count // len(KINDS), found))
    assert wrong == []
    assert missing <= MISSING
