"""The energy function: conserved or not, T + V or not, and why."""

from __future__ import annotations

import pytest

from lagcli.algebra import is_zero
from lagcli.mechanics.statements import Statements
from lagcli.notation.likeness import signed_key
from lagcli.reader import parse_text
from lagcli.statements.wording import constraints_named

from .derived import derive, same


def test_a_bead_on_a_turning_wire_conserves_h_which_is_not_the_energy():
    """Goldstein, 3rd ed., section 2.7: h = m (r'^2 - r^2 w^2)/2, T = m (r'^2 + r^2 w^2)/2."""
    energy = derive("coordinates: [r]\nparameters: [m, w]\nT: m*(r'^2 + r^2*w^2)/2").energy
    assert energy.conserved is True
    assert energy.is_total_energy is False
    assert "T is not homogeneous of degree two" in energy.reason


def test_a_force_in_time_makes_h_the_energy_and_not_conserved():
    d = derive("coordinates: [x]\nparameters: [m, F]\nfunctions: {f: [t]}\nT: m*x'^2/2\nV: -x*f(t)")
    assert d.energy.conserved is False
    assert d.energy.is_total_energy is True
    assert same(d, d.energy.rate, "-x*f'(t)")
    assert "L depends on t explicitly" in d.energy.reason


def test_a_moving_constraint_does_work():
    """r = l0 + v t: dh/dt = -lambda b with b = df/dt = -v, the rod's power lambda v.

    lambda = -m r phi'^2; on the constraint r and l0 + v t are the same.
    """
    d = derive(
        "coordinates: {r: {assume: positive}, phi: {}}\nparameters: [m, l0, v]\n"
        "T: m*(r'^2 + r^2*phi'^2)/2\nconstraints: {rod: r = l0 + v*t}"
    )
    assert d.energy.conserved is False
    assert "the constraint 'rod' moves" in d.energy.reason
    assert same(d, d.energy.rate, "-m*r*phi'^2*v")


def test_dissipation_takes_twice_rayleighs_function():
    """dE/dt = -2 D; Goldstein, 3rd ed., section 1.5."""
    d = derive(
        "coordinates: [x]\nparameters: [m, k, b]\nT: m*x'^2/2\nV: k*x^2/2\ndissipation: b*x'^2/2"
    )
    assert d.energy.conserved is False
    assert same(d, d.energy.rate, "-b*x'^2")


def test_a_gyroscopic_force_does_no_work():
    """Q = B (y', -x'): no potential, no power."""
    d = derive(
        "coordinates: [x, y]\nparameters: [m, B]\nT: m*(x'^2+y'^2)/2\nforces: {x: B*y', y: -B*x'}"
    )
    assert d.energy.conserved is True


def test_a_velocity_dependent_potential_is_not_in_h():
    """Weber's potential k/r (1 - r'^2/(2 c^2)): h = m r'^2/2 + k/r (1 + r'^2/(2 c^2))."""
    d = derive(
        "coordinates: {r: {assume: positive}}\nparameters: {m: {}, k: {}, c: {assume: positive}}\n"
        "T: m*r'^2/2\nV: k/r*(1 - r'^2/(2*c^2))"
    )
    assert d.energy.is_total_energy is False
    assert "V depends on the velocities" in d.energy.reason
    assert same(d, d.energy.function, "m*r'^2/2 + k/r*(1 + r'^2/(2*c^2))")


@pytest.mark.parametrize("potential", ["V: k*x^2/2", "V: U(x)\nfunctions: {U: [x]}"])
def test_the_ordinary_case(potential: str):
    energy = derive(f"coordinates: [x]\nparameters: [m, k]\nT: m*x'^2/2\n{potential}").energy
    assert energy.conserved is True
    assert energy.is_total_energy is True


def test_constraints_of_one_kind_are_named_together():
    assert constraints_named("the moving constraint", ["a"]) == "the moving constraint 'a'"
    assert constraints_named("the constraint", "abc") == "the constraints 'a', 'b' and 'c'"
    moved = "constraints: {a: x = F(t), b: y = G(t)}\nfunctions: {F: [t], G: [t]}\n"
    energy = derive(f"coordinates: [x, y, z]\nL: x'^2 + y'^2 + z'^2\n{moved}").energy
    assert "the constraints 'a' and 'b' move and do work" in energy.reason


@pytest.mark.parametrize("stretched", ["(x - l)^2 + (y - x - l)^2", "(y - x)^2 + (x + l)^2 + y^2"])
def test_h_of_a_turning_rod_keeps_the_potential_of_the_file(stretched):
    found = derive(f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}, w: {{assume: positive}}, l: {{}}}}
T: m*(x'^2 + y'^2 + w^2*(x^2 + y^2))/2
V: k*({stretched})/2
""")
    h = Statements(found).by_terms(found.energy.readable_function, as_given=True)
    expected = f"m*(x'^2 + y'^2)/2 - m*w^2*(x^2 + y^2)/2 + k*({stretched})/2"
    assert signed_key(h) == signed_key(parse_text(expected))  # up to the order of terms


@pytest.mark.parametrize(
    "lagrangian",
    [
        "(1 + x')*(log(1 + x') - 1) - k*x^2",
        "(x' + 2)*exp(x')",
        "(x'^2 + x)*(x' + k)",
        "k*(x'^2 + x)*(x' + 1)*cosh(x')",
        "k*(x'^2 + x)/(2 + cos(x'))",
    ],
)
def test_a_product_of_brackets_with_velocities_is_differentiated_as_a_whole(lagrangian):
    d = derive(f'coordinates: [x]\nparameters: [k]\nL: "{lagrangian}"')
    assert is_zero(d.energy.readable_function - d.energy.function) is True
