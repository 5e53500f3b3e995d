"""Every discovered charge stays to twenty digits along a motion that shares nothing with it.

`python -m tests.oracle.constancy problems` prints the figures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from mpmath import mp

from lagcli import load
from lagcli.problem_data import Problem
from lagcli.reader import parse_text
from tests.marks import one_of

from .constancy import digits_kept, kept_at, searched
from .examine import DIGITS, examine
from .jets import OutsideDomain
from .reference import Reference
from .states import random_moments

LIBRARY = Path(__file__).parents[2] / "problems"
PROBLEMS = sorted(LIBRARY.rglob("*.yaml"))


def stays(path: Path) -> None:
    problem = load(path)
    charges, _ = searched(problem, "discovered")
    kept = digits_kept(problem, charges)
    assert {name: digits for name, digits in kept.items() if digits < 20} == {}
    for conditions in {tuple(c.get("where", ())) for c in charges}:
        given = [c for c in charges if tuple(c.get("where", ())) == conditions]
        sheet = {"degrees_of_freedom": None, "discovered": given}
        found = examine(problem, sheet, count=2, seed=seed_where(problem, given))
        assert [str(f) for f in found if f.where.startswith("charges")] == []


def seed_where(problem: Problem, charges: Sequence[Mapping[str, Any]]) -> int:
    """The first seed of random states at which the printed conditions hold.

    A charge that is even in a root is real without one; its formula is taken where the root is.
    """
    conditions = {c for charge in charges for c in charge.get("where", ())}
    with mp.workdps(DIGITS):
        reference = Reference(problem)
        sides = [tuple(reference.of(parse_text(s)) for s in c.split(" > ")) for c in conditions]
        formulas = [reference.of(parse_text(charge["charge"])) for charge in charges]

        def hold_at(seed: int) -> bool:
            for moment in random_moments(reference, 2, seed):
                if not all(left(moment) > right(moment) for left, right in sides):
                    return False
                try:
                    [formula(moment) for formula in formulas]
                except OutsideDomain:
                    return False
            return True

        return next(filter(hold_at, range(1, 1000)))


def one_of_many(path: Path) -> object:
    mark = pytest.mark.long if path.parent.name == "discovery" else pytest.mark.hours
    return pytest.param(path, marks=mark, id=str(path.relative_to(LIBRARY)))


@pytest.mark.parametrize("path", one_of(3, PROBLEMS), ids=lambda p: str(p.relative_to(LIBRARY)))
def test_no_library_problem_gets_a_false_charge(path: Path) -> None:
    stays(path)


@pytest.mark.parametrize("path", [*map(one_of_many, PROBLEMS)])
def test_special_values_get_no_false_charge(path: Path) -> None:
    """A search at each value: those of the folder on discovery, and `-m hours` the others."""
    problem = load(path)
    _, special = searched(problem, "algebra")
    kept = {}
    for case in special:
        kept |= kept_at(problem, case)
    assert {name: digits for name, digits in kept.items() if digits < 20} == {}


def test_a_special_charge_that_changes_elsewhere_is_noticed() -> None:
    problem = load(LIBRARY / "particles/anisotropic-oscillator.yaml")
    charge = {"charges": {"L_z": "m*(x*y' - y*x')"}, "parameter": "k2"}
    [equal] = kept_at(problem, {**charge, "value": "k1"}).values()
    [other] = kept_at(problem, {**charge, "value": "2*k1"}).values()
    assert equal > 20 > other


def test_a_charge_that_changes_is_noticed() -> None:
    problem = load(LIBRARY / "central/kepler.yaml")
    [energy, *_], _ = searched(problem, "discovered")
    wrong = {**energy, "charge": energy["charge"] + " + x*x'/10^12"}
    assert 10 < digits_kept(problem, [wrong])["energy"] < 14
