"""Equations of motion in a file: the energies of the hint give them again, by Lagrange's equation."""

import pytest
import sympy as sp

from lagcli.reader.equations_meant import energies_of

NAMES = {name: sp.Symbol(name) for name in ("m", "c", "k", "F", "w", "t")}
X, V, A = sp.symbols("X V A")


def value(text):
    named = text.replace("x''", "A").replace("x'", "V").replace("x", "X").replace("eXp", "exp")
    return sp.sympify(named.replace("^", "**"), {**NAMES, "X": X, "V": V, "A": A})


@pytest.mark.parametrize(
    "equation",
    ["m*x'' + c*x' + k*x = F*sin(w*t)", "m*x'' = -k*x - c*x'", "m*x''/2 + k/m*x = -F",
     "x'' - k*x = F*exp(-c*t - 1)", "2*m*x'' = F - w"],
)  # fmt: skip
def test_the_energies_give_the_equation(equation):
    parts = dict(
        each.split(": ", 1) for each in energies_of([equation], ["x"], list(NAMES)).split("; ")
    )
    kinetic, potential, lost = (value(parts.get(key, "0")) for key in ("T", "V", "dissipation"))
    force = value(parts.get("forces", "{x: 0}")[4:-1])
    left, right = map(value, equation.split("="))
    motion = kinetic.diff(V, 2) * A + potential.diff(X) + lost.diff(V) - force
    assert sp.simplify(motion - (left - right)) == 0


@pytest.mark.parametrize(
    "equation",
    ["m*x'' + k*sin(x) = 0", "x''*x = 0", "m*x'' + k*(x - c) = 0", "m*x'' = k/x", "k*x = F",
     "0 = k*x + m*x''", "m*x'' + k*x^2 = 0", "m*y'' = 0", "m*x'' + k*x"],
)  # fmt: skip
def test_what_is_not_linear_is_left(equation):
    assert energies_of([equation], ["x"], list(NAMES)) == ""
