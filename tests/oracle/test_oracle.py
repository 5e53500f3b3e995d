"""The oracle itself: right derivatives, and able to fail."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from mpmath import mp, mpf

from lagcli import load
from lagcli.formatters.built_in.json import to_object
from lagcli.problem_data import Problem
from tests.library.test_library import EXAMINED as SECTIONS
from tests.library.test_library import LIBRARY
from tests.solved import solve

from .examine import examine
from .functions import ELEMENTARY, StandIn
from .jets import Jet, Number, coefficient, constant, family, infinitesimal, power, real_part

POINTS = {"acosh": "1.7", "asin": "0.3", "acos": "0.3", "atanh": "0.3"}


def third_derivative(f: Callable[[Number], Number], at: mpf) -> mpf:
    with family() as a, family() as b, family() as c:
        x = constant(at) + infinitesimal(a) + infinitesimal(b) + infinitesimal(c)
        return real_part(coefficient(coefficient(coefficient(f(x), a), b), c))


@pytest.mark.parametrize("name", [n for n in ELEMENTARY if n not in {"atan2", "sign"}])
def test_third_derivatives_are_those_of_finite_differences(name: str) -> None:
    with mp.workdps(40):
        at = mpf(POINTS.get(name, "1.3"))
        f = ELEMENTARY[name]
        assert abs(third_derivative(f, at) - mp.diff(f, at, 3)) < mpf(10) ** -8


def test_a_power_with_a_real_exponent() -> None:
    with mp.workdps(40):
        a = mpf(7) / 3
        true = a * (a - 1) * (a - 2) * mpf("1.3") ** (a - 3)
        assert abs(third_derivative(lambda x: power(x, a), mpf("1.3")) - true) < mpf(10) ** -30


def test_the_angle_of_a_point_that_turns_grows_by_one() -> None:
    with mp.workdps(40), family() as later:
        e: Jet = infinitesimal(later)
        x, y = mpf(-2) + e * mpf("-0.5"), mpf("0.5") + e * mpf(-2)
        assert abs(real_part(coefficient(ELEMENTARY["atan2"](y, x), later)) - 1) < mpf(10) ** -30


def test_stand_ins_know_their_mixed_derivatives() -> None:
    with mp.workdps(40), family() as a, family() as b:
        f = StandIn("Phi", 2)
        x, y = mpf("0.3"), mpf("0.8")
        mixed = coefficient(coefficient(f([infinitesimal(a) + x, infinitesimal(b) + y]), a), b)
        assert abs(real_part(mixed) - real_part(f([x, y], (0, 1)))) < mpf(10) ** -30


@cache
def hoop() -> tuple[Problem, dict[str, Any]]:
    problem = load(LIBRARY / "hoop.yaml")
    return problem, json.loads(json.dumps(to_object(solve(problem, SECTIONS))))


def set_in(sheet: Any, keys: tuple[Any, ...], change: Callable[[Any], Any]) -> None:
    *outer, last = keys
    for key in outer:
        sheet = sheet[key]
    sheet[last] = change(sheet[last])


@pytest.mark.first_quick
@pytest.mark.parametrize(
    ("keys", "change"),
    [
        (("degrees_of_freedom",), lambda n: n + 1),
        (("lagrangian",), lambda s: f"{s} + x"),
        (("equations", 0, "equation"), lambda s: s.replace("= ", "= -")),
        (("matrix_form", "forcing", 0), lambda s: f"-({s})"),
        (("accelerations", "x"), lambda s: f"2*({s})"),
        (("accelerations", "theta"), lambda s: f"({s})*(1 + x - R*theta + 1e-9)"),
        (("accelerations",), lambda _: None),
        (("multipliers", "rolling", "value"), lambda s: f"-({s})"),
        (("multipliers", "rolling", "kind"), lambda _: "nonholonomic"),
        (("constraint_forces", "rolling", "theta"), lambda s: f"-({s})"),
        (("total_constraint_force", "x"), lambda s: f"2*({s})"),
        (("momenta", "x"), lambda s: f"{s} + M"),
        (("energy", "function"), lambda s: f"{s} - x"),
        (("energy", "conserved"), lambda _: False),
        (("energy", "is_total_energy"), lambda _: None),
        (("hamiltonian",), lambda s: f"{s} + p_x"),
        (("canonical_equations", "theta", "p"), lambda s: f"-({s})"),
        (("charges", 0, "charge"), lambda s: f"{s} + t"),
        (("charges", 0, "gauge"), lambda _: "0"),
        (("charges", 0, "conserved"), lambda _: False),
        (("charges", 0, "rate"), lambda _: "g"),
        (("charges",), lambda charges: charges[1:]),
        (("find", "speed_squared", "value"), lambda s: f"2*({s})"),
    ],
)
def test_a_changed_claim_is_found_out(keys: tuple[Any, ...], change: Callable[[Any], Any]) -> None:
    problem, sheet = hoop()
    assert examine(problem, sheet) == []
    changed = copy.deepcopy(sheet)
    set_in(changed, keys, change)
    assert examine(problem, changed)


def test_the_library_is_where_it_is_looked_for() -> None:
    assert Path(LIBRARY, "hoop.yaml").is_file()
