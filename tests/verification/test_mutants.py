"""The verification alone notices changes of the program that make an answer wrong."""

from __future__ import annotations

from collections import Counter

import pytest

from . import mutants
from .meaning import Meaning
from .mutants import ROOT, in_a_process, outcome, solved
from .sites import Site, sites

#: Changes that make answers wrong: (file, what the line holds, change).
KNOWN = (
    ("mechanics/euler_lagrange.py", "total_derivative(momentum) - force", "a - b -> a + b"),
    ("mechanics/energy.py", "return system.T + system.V", "a + b -> a - b"),
    ("mechanics/noether.py", "force * change + momentum", "a + b -> b"),
)
QUICK = ("hoop", "nonholonomic/chaplygin-sleigh")


def site(file: str, text: str, change: str) -> Site:
    """The first place of a change in a line that holds a text."""
    lines = (ROOT / file).read_text().splitlines()
    numbers = {n for n, line in enumerate(lines, 1) if text in line}
    return next(each for each in sites({file: numbers}) if each.change == change)


@pytest.mark.parametrize(
    ("file", "text", "change"),
    [*KNOWN[:2], *(pytest.param(*each, marks=pytest.mark.long) for each in KNOWN[2:])],
)
def test_a_known_change_is_noticed(file: str, text: str, change: str) -> None:
    before = in_a_process(lambda: ((name, solved(name)) for name in QUICK))
    found = outcome(site(f"lagcli/{file}", text, change), before, QUICK)
    assert found.kind != "escaped", found.escaped


def differences(
    before: dict[str, object],
    after: dict[str, object],
    name: str = "chains/coupled-pendulums",
) -> list[str]:
    from lagcli import load

    problem = load(ROOT / f"problems/{name}.yaml")
    sheets = ({"warnings": [], **each} for each in (before, after))
    return [f"{d.kind} {d.path}" for d in Meaning(problem, *sheets).differences()]


@pytest.mark.parametrize(
    ("mode", "true"),
    [
        ({"frequency": "sqrt(g/l + 2*k/m)", "shape": {"theta1": "2", "theta2": "-2"}}, True),
        ({"frequency": "sqrt(g/l + k/m)", "shape": {"theta1": "1", "theta2": "-1"}}, False),
        ({"frequency": "sqrt(g/l)", "shape": {"theta1": "1", "theta2": "-1"}}, False),
        ({"frequency_squared": "-g/l", "shape": {"theta1": "1", "theta2": "1"}}, False),
    ],
)
def test_a_normal_mode_that_is_true_is_no_wrong_claim(
    mode: dict[str, object], *, true: bool
) -> None:
    more = {"at": {"theta1": "0", "theta2": "0"}, **mode}
    assert (differences({"modes": []}, {"modes": [more]}) == []) is true


@pytest.mark.parametrize(
    ("before", "after", "found"),
    [
        ({"find": {"a": {"solutions": ["g/l", "0"]}}},
         {"find": {"a": {"solutions": ["0", "2*g/(2*l)"]}}}, []),
        ({"find": {"a": {"solutions": ["g/l", "0"]}}},
         {"find": {"a": {"solutions": ["g/l"]}}},
         ["wrong find/a/solutions: 1 of 2 missing, 0 others"]),
        ({"modes": [{"shape": {"theta1": "1", "theta2": "-1"}}]},
         {"modes": [{"shape": {"theta1": "-2", "theta2": "2"}}]}, []),
        ({"charges": [{"name": "a", "conserved": True, "charge": "theta1'", "gauge": "0"}]},
         {"charges": [{"name": "a", "conserved": True, "charge": "theta1' + m", "gauge": "-m"}]},
         []),
        ({"hamilton_jacobi": {"constants": ["a"], "derivatives": {"theta1": "sqrt(9 + a)"}}},
         {"hamilton_jacobi": {"constants": ["b"], "derivatives": {"theta1": "sqrt(9 - b)"}}}, []),
        ({"hamilton_jacobi": {"constants": ["a"], "derivatives": {"theta1": "sqrt(9 + a)"}}},
         {"hamilton_jacobi": {"constants": ["b"], "derivatives": {"theta1": "sqrt(8 - b)"}}},
         ["wrong hamilton_jacobi/derivatives/theta1"]),
        ({"lagrangian": "theta1'^2"}, {"lagrangian": "theta1'^2 + m"}, ["wrong lagrangian"]),
        ({"periods": [{"amplitude": "a", "order": 4, "period": "pi*(1 + a^2/16 + 11*a^4/3072)"}]},
         {"periods": [{"amplitude": "a", "order": 2, "period": "pi*(1 + a^2/16)"}]}, []),
        ({"periods": [{"amplitude": "a", "order": 4, "period": "pi*(1 + a^2/16 + 11*a^4/3072)"}]},
         {"periods": [{"amplitude": "a", "order": 2, "period": "pi*(1 + a^2/8)"}]},
         ["wrong periods: 1 of 1 missing, 1 others"]),
        ({"periods": [{"amplitude": "a", "order": 4, "period": "pi*(1 + a^2/16 + 11*a^4/3072)"}]},
         {"periods": [{"amplitude": None, "order": 0, "period": "pi"}]}, []),
        ({"periods": [{"amplitude": "a", "order": 4, "period": "pi*(1 + a^2/16 + 11*a^4/3072)"}]},
         {"periods": [{"amplitude": None, "order": 0, "period": "pi + 1/10"}]},
         ["wrong periods: 1 of 1 missing, 1 others"]),
        ({"lagrangian": "theta1'^2"}, {"lagrangian": None}, ["weaker lagrangian"]),
        ({"equilibria": [{"condition": "g > l"}]}, {"equilibria": [{"condition": "2*g > 2*l"}]}, []),
        ({"equilibria": [{"stable": True, "condition": "g > l"}]},
         {"equilibria": [{"stable": None, "condition": "g > l",
                          "minimum": ["2*g > 2*l"], "unstable": ["l > g"]}]}, []),
        ({"equilibria": [{"stable": True, "condition": "g > l"}]},
         {"equilibria": [{"stable": None, "condition": "g > l",
                          "minimum": ["g > 2*l"], "unstable": ["2*l > g"]}]},
         ["wrong equilibria: 1 of 1 missing, 1 others"]),
        ({"equilibria": [{"minimum": ["g > l"], "unstable": ["l > g"]}]},
         {"equilibria": [{"minimum": ["g > l"], "spectrum": ["2*g > 2*l"], "unstable": ["l > g"]}]},
         []),
        ({"equilibria": [{"minimum": ["g > l"], "unstable": ["l > g"]}]},
         {"equilibria": [{"minimum": ["g > l"], "spectrum": ["g > 2*l"], "unstable": ["l > g"]}]},
         ["wrong equilibria: 1 of 1 missing, 1 others"]),
    ],
)  # fmt: skip
def test_answers_are_compared_by_meaning(
    before: dict[str, object], after: dict[str, object], found: list[str]
) -> None:
    assert differences(before, after) == found


@pytest.mark.parametrize(
    ("name", "coordinate", "before", "after", "same"),
    [
        ("classics/spherical-pendulum", "theta", "0", "-2*pi", True),
        ("classics/spherical-pendulum", "theta", "pi", "3*pi", True),
        ("classics/spherical-pendulum", "theta", "pi", "0", False),
        ("steady/bead-on-rotating-hoop", "theta", "acos(1/3)", "-acos(1/3)", False),
        ("steady/bead-on-rotating-hoop", "theta", "acos(g/(R*w^2))", "acos(g/(R*w^2)) - 2*pi", True),
        ("classics/spherical-pendulum", "phi", "0", "6*pi", True),
        ("driven/pendulum-horizontal-drive", "theta", "0", "2*pi", True),
        ("hoop", "theta", "0", "2*pi", False),  # x = R theta
        ("oscillations/coupled-oscillators", "x1", "0", "2*pi", False),
    ],
)  # fmt: skip
def test_angles_that_are_whole_turns_apart_are_one_place(
    name: str, coordinate: str, before: str, after: str, *, same: bool
) -> None:
    sheets = ({"equilibria": [{"at": {coordinate: x}, "stable": True}]} for x in (before, after))
    assert (differences(*sheets, name=name) == []) is same


@pytest.mark.hours
def test_of_200_changes_that_make_an_answer_wrong_95_in_100_are_noticed() -> None:
    found = list(mutants.run(200, seed=1))
    kinds = Counter(each.kind for each in found)
    escaped = [(str(each.site), each.escaped) for each in found if each.kind == "escaped"]
    assert kinds["noticed"] >= 0.95 * (kinds["noticed"] + kinds["escaped"]), escaped
