"""Kinetic energies that are positive definite by construction are known to be so."""

from __future__ import annotations

import random
from typing import Any

import pytest

from lagcli.formatters.built_in.json import to_object
from lagcli.mechanics.statements import Statements
from tests.mechanics.derived import derive

HEAD = "parameters: {{{}}}\n".format(
    ", ".join(f"{p}: {{assume: positive}}" for p in ("m", "M", "R", "b", "J", "k", "g"))
)


def equilibria(text: str) -> list[dict[str, Any]]:
    """The equilibria as JSON has them."""
    printed: Any = to_object(Statements(derive(text)).answers(["equilibria"]))
    return list(printed["equilibria"])


#: Speeds whose squares, with positive weights, make up a kinetic energy.
SPEEDS = [
    "x'", "y'", "(x' - y')", "(R*x' - b*y')", "(x'*cos(x) + y'*sin(x))", "(R - b)*x'",
    "(R - b*cos(x))*x'", "b*sin(x)*x'", "(R + b*cos(y))*y'", "sin(y)*(x' + y')",
]  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_a_minimum_of_V_is_stable_under_any_sum_of_squares(seed: int) -> None:
    source = random.Random(f"inertia {seed}")
    speeds = source.sample(SPEEDS, source.choice([1, 2]))
    terms = [f"{source.choice(['m', 'M', '2*m'])}*({s})^2/2" for s in speeds]
    text = (
        f"coordinates: [x, y]\n{HEAD}T: {' + '.join(terms)} + J*x'^2/2 + M*y'^2/2\n"
        "V: k*x^2/2 + g*y^2 + k*(x - y)^2\n"
    )
    [found] = equilibria(text)
    assert found["stable"] is True


@pytest.mark.parametrize(
    ("T", "V"),
    [
        ("m*(R^2 + b^2 - 2*R*b*cos(x))*x'^2/2 + J*x'^2/2", "-m*g*b*cos(x)"),
        ("m*(R^2 + b^2 - 2*R*b*cos(x))*x'^2/2", "-m*g*b*cos(x)"),
        ("m*x'^2*(1 + b^2*sin(x)^2)/2", "-m*g*b*cos(x)"),
        ("M*R^2*x'^2/2 + m*x'^2*(b^2 + R^2 + 2*b*R*cos(x))/2", "-g*cos(x)"),
    ],
)
def test_a_body_that_rocks_is_stable_below(T: str, V: str) -> None:
    below = next(e for e in equilibria(f"coordinates: [x]\n{HEAD}T: {T}\nV: {V}\n"))
    assert below["stable"] is True


@pytest.mark.long
def test_the_arms_of_a_governor_are_stable_where_they_stand_out() -> None:
    """M = 2 a² (m₁ + 2 m₂ sin² θ) (J. C. Maxwell, Proc. R. Soc. 16 (1868) 270)."""
    text = (
        f"coordinates: [x]\n{HEAD}T: m*R^2*(x'^2 + k^2*sin(x)^2) + 2*M*R^2*sin(x)^2*x'^2\n"
        "V: -2*(m + M)*g*R*cos(x)\n"
    )
    out = [e for e in equilibria(text) if e.get("condition")]
    assert [e["stable"] for e in out] == [True, True]


def test_the_upper_equilibrium_of_a_spring_pendulum_is_judged() -> None:
    text = (
        f"coordinates: [x, y]\n{HEAD}T: m*(x'^2 + (R + x)^2*y'^2)/2\n"
        "V: -m*g*(R + x)*cos(y) + k*x^2/2\n"
    )
    above = [e for e in equilibria(text) if "pi" in e["at"]["y"]]
    assert len(above) == 1
    assert above[0]["minimum"] or above[0]["stable"] is False


@pytest.mark.parametrize("T", ["m*x'^2/2 - M*y'^2/2", "m*x'*y'", "(m - M)*x'^2/2 + J*y'^2/2"])
def test_what_is_not_definite_is_not_called_so(T: str) -> None:
    [found] = equilibria(f"coordinates: [x, y]\n{HEAD}T: {T}\nV: k*x^2/2 + g*y^2\n")
    assert found["stable"] is not True


@pytest.mark.parametrize(
    ("first", "second", "needed"),
    [
        ("L1", "L2", ["L1*L2", "M^2"]),  # Landau, Lifshitz, Pitaevskii, section 33
        ("2*L1", "3*L2", ["6*L1*L2", "M^2"]),
        ("L1 + L2", "3*L2", ["3*(L1 + L2)*L2", "M^2"]),
    ],
)
def test_coupled_circuits_are_stable_where_their_energy_is_positive(first, second, needed):
    """sum L_ij q_i' q_j'/2 + sum q_i²/(2 C_i): the inductances decide alone, at any C_i."""
    text = f"""
coordinates: [x, y]
parameters: {{L1: POSITIVE, L2: POSITIVE, C: POSITIVE, D: POSITIVE, M: }}
T: ({first})*x'^2/2 + ({second})*y'^2/2 + M*x'*y'
V: x^2/(2*C) + y^2/(2*D)
"""
    [found] = equilibria(text.replace("POSITIVE", "{assume: positive}"))
    assert found["spectrum"] == [" > ".join(needed)]
    assert found["unstable"] == [" > ".join(needed[::-1])]
