"""Velocities in a function on phase space: the hint has the same function of the momenta."""

import random
import re

import pytest
import sympy as sp

from lagcli.reader import parse_text, read_problem
from tests.reader.test_foreign_formulas import plain

ENERGIES = [
    ("m*(x'^2 + y'^2)/2", {"x": "m", "y": "m"}),
    ("(m + M)*x'^2/2 + m*y'^2/2", {"x": "m + M", "y": "m"}),
    ("m/2*(x'^2 + x^2*y'^2)", {"x": "m", "y": "m*x**2"}),
    ("0.5*m*x'^2 + 0.5*M*y'^2", {"x": "m", "y": "M"}),
    ("m*x'^2 + M*y'^2/3", {"x": "2*m", "y": "2*M/3"}),
    ("1/2*m*x'^2 + y'^2/2", {"x": "m", "y": "1"}),
]
FUNCTIONS = [
    "m*x'",
    "m*(x*y' - y*x')",
    "x'",
    "(m + M)*x'",
    "x*x' + y*y'",
    "m*x'^2/2 + y'^2",
    "M*y'",
]


def file_with(kinetic, function, potential="0"):
    return (
        f"coordinates: [x, y]\nparameters: [m, M, k]\nT: {kinetic}\nV: {potential}\n"
        f"observables:\n  A: {function}\n"
    )


@pytest.mark.parametrize("seed", range(40))
def test_the_momenta_in_the_hint_are_those_of_the_energy(seed):
    draw = random.Random(seed)
    kinetic, inertia = draw.choice(ENERGIES)
    function = draw.choice(FUNCTIONS)
    [only] = read_problem("p.yaml", file_with(kinetic, function).encode()).diagnostics
    written = only.hint.removeprefix("write ").partition(": ")[0]
    momenta = {f"p_{q}": sp.sympify(a) * sp.Symbol(f"{q}dot") for q, a in inertia.items()}
    difference = plain(parse_text(written)).subs(momenta) - plain(parse_text(function))
    assert sp.nsimplify(sp.simplify(difference), rational=True) == 0
    mended = read_problem("p.yaml", file_with(kinetic, written).encode())
    assert mended.diagnostics == ()


@pytest.mark.parametrize(
    ("kinetic", "potential"),
    [("m*(x'^2 + y'^2)/2 + m*x'*y'", "0"), ("m*x'^4/2 + y'^2", "0"),
     ("m*(x'^2 + y'^2)/2", "k*x*y'")],
)  # fmt: skip
def test_other_energies_have_no_such_hint(kinetic, potential):
    found = read_problem("p.yaml", file_with(kinetic, "m*x'", potential).encode()).diagnostics
    assert "write" not in found[0].hint


@pytest.mark.parametrize(
    ("coordinates", "energy", "momenta"),
    [
        ("[q, p]", "p^2/(2*m) + k*q^2/2", ["p"]),
        ("[x, px]", "px^2/(2*m) + k*x^2/2", ["px"]),
        ("[q1, q2, p1, p2]", "(p1^2 + p2^2)/(2*m) + k*q1*q2", ["p1", "p2"]),
        ("[theta, p_theta]", "p_theta^2/(2*m) + k*cos(theta)", ["p_theta"]),
        ("[q, p]", "p_q^2/(2*m) + k*p^2", []),
    ],
)
def test_a_momentum_is_no_coordinate(coordinates, energy, momenta):
    text = f"coordinates: {coordinates}\nparameters: [m, k]\nH: {energy}\n"
    found = read_problem("p.yaml", text.encode()).diagnostics
    left_out = [each for each in found if each.hint.startswith("leave it out: ")]
    assert [each.message.split("'")[1] for each in left_out] == momenta


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("energy", ["T: {}\nV: k*r", "L: {} - k*r"])
def test_a_momentum_in_a_state_is_told_its_velocity(seed, energy):
    """The formula in the hint undoes p = ∂T/∂q', by numbers."""
    draw = random.Random(seed)
    inertia = draw.choice(["m*r^2", "m*k", "J", "2*m"])
    half = draw.choice(["{}*phi'^2/2", "1/2*{}*phi'^2", "0.5*{}*phi'^2"]).format(inertia)
    written = energy.format(f"m*r'^2/2 + {half}")
    [found] = read_problem(
        "p.yaml",
        f"coordinates: [r, phi]\nparameters: [m, k, J]\n{written}\ninitial: {{p_phi: 11}}\n".encode(),
    ).diagnostics
    rate = re.search("phi'(?: =|:) (.*)", found.hint)[1].replace("^", "**")
    names = {"m": 2.0, "k": 3.0, "J": 5.0, "r": 0.7, "p_phi": 11.0}
    speed = eval(rate, {}, names)
    assert speed * eval(inertia.replace("^", "**"), {}, names) == pytest.approx(11)


def test_a_momentum_of_a_mixed_energy_is_another_number():
    written = "coordinates: [x, y]\nT: x'^2 + y'^2 + x'*y'\ninitial: {p_x: 1}\n"
    [found] = read_problem("p.yaml", written.encode()).diagnostics
    assert found.hint.endswith("give x': its momentum is ∂L/∂x'")


@pytest.mark.parametrize("seed", range(8))
def test_an_initial_momentum_is_a_velocity(seed):
    draw = random.Random(seed)
    number = draw.choice(["3", "0", "-2.5", "p0"])
    x, square, inertia = draw.choice(
        [("x", "m*x'^2/2", "m"), ("theta", "m*l^2*theta'^2/2", "(m*l^2)"), ("q", "q'^2/2", "")]
    )
    begin = f"coordinates: [{x}]\nparameters: {{m: 2, l: 3, p0: 4}}\nT: {square}\ninitial: {{"
    [told] = read_problem("p", f"{begin}p_{x}: {number}}}\n".encode()).diagnostics
    over = f"({number})" if "-" in number else number
    rate = f"{over}/{inertia}" if inertia and number != "0" else number
    assert told.hint == f"a state has velocities, not momenta: write {x}': {rate}"
    assert read_problem("p", f"{begin}{x}': {rate}}}\n".encode()).diagnostics == ()
