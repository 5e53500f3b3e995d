"""Equations of motion in a file: the energies of the hint give them again, by Lagrange's equation."""

import pytest
import sympy as sp

from lagcli.reader import read_problem
from lagcli.reader.equations_meant import energies_of

NAMES = {name: sp.Symbol(name) for name in ("m", "c", "k", "F", "w", "t")}
X, V, A = sp.symbols("X V A")


def value(text):
    named = text.replace("x''", "A").replace("x'", "V").replace("x", "X").replace("eXp", "exp")
    return sp.sympify(named.replace("^", "**"), {**NAMES, "X": X, "V": V, "A": A})


@pytest.mark.parametrize(
    "equation",
    ["m*x'' + c*x' + k*x = F*sin(w*t)", "m*x'' = -k*x - c*x'", "m*x''/2 + k/m*x = -F",
     "x'' - k*x = F*exp(-c*t - 1)", "2*m*x'' = F - w", "x'' - c*(1 - x^2)*x' + x = 0",
     "m*x'' + k*sin(x) = 0", "m*x'' + k*(x - c) = 0", "m*x'' = k/x", "m*x'' + k*x^2 = -(F - c)*x'^3",
     "(m + k)*x'' = -c*x' - k*x^3 + w*x*x'", "x'' = -(F - c)*x + cos(x - w*t)"],
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
    ["x''*x = 0", "m*x'' + x*x'' = 0", "k*x = F", "0 = k*x + m*x''", "x''^2 = k", "sin(x'') = x",
     "m*y'' = 0", "m*x'' + k*x", "m*x'' = b*x"],
)  # fmt: skip
def test_what_is_not_linear_in_the_acceleration_is_left(equation):
    assert energies_of([equation], ["x"], list(NAMES)) == ""


def test_coupled_equations_have_forces_with_the_other_coordinate():
    laws = ["m*x'' = -k*x + c*y", "m*y'' = -k*(y - x)"]
    energies = energies_of(laws, ["x", "y"], list(NAMES))
    assert energies == "T: m*x'^2/2 + m*y'^2/2; V: k*x^2/2; forces: {x: c*y, y: -k*(y - x)}"


@pytest.mark.parametrize("key", ["equations: [{}'' = {}]", "accelerations: {{{}: {}}}",
                                 "equation: {}'' = {}", "eom: {{law: {}'' = {}}}"])  # fmt: skip
@pytest.mark.parametrize("law", ["-k*x^3", "k*sin(x) - c*x'*abs(x')"])
def test_a_file_of_equations_has_one_mistake_with_its_energies(key, law):
    head = "coordinates: [x]\nparameters: [k, c]\n"
    [found] = read_problem("p.yaml", (head + key.format("x", law) + "\n").encode()).diagnostics
    lines = found.hint.partition(": write ")[2].replace(", and on a line of its own ", "\n")
    assert lines.startswith("T: x'^2/2\nforces: {x: ")
    assert read_problem("p.yaml", (head + lines + "\n").encode()).diagnostics == ()
