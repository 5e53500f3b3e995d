"""Linear functions of the velocities that turn into each other, under velocity constraints."""

from random import Random

import pytest
import sympy

from lagcli.algebra import is_zero
from lagcli.mechanics.discovery.summary import summary

from .derived import derive

POS = "{assume: positive}"


def along(text):
    """The charges, and the rate of a formula on the motion."""
    derivation = derive(text)
    system, motion = derivation.dynamics.system, derivation.dynamics.motion
    solved = dict(zip(system.qddot, motion.accelerations, strict=True))
    relations = derivation.dynamics.constraints.relations

    def rate(formula):
        found = system.total_derivative(formula).xreplace(solved)
        return found if relations is None else relations.substitute(found)

    return derivation.discovery, rate


@pytest.mark.parametrize("seed", range(3))
def test_suslovs_body_with_a_rotor_along_the_axis_of_no_turn(seed):
    """A w1' = -h w2, B w2' = h w1; Maciejewski, Przybylska, J. Math. Phys. 45 (2004) 1065."""
    rng = Random(seed)
    A, B = rng.sample(["A", "B", "2*A", "A + B"], 2)
    discovery, rate = along(f"""
coordinates: [phi, theta, psi]
parameters: {{A: {POS}, B: {POS}, C: {POS}, h: {POS}}}
definitions:
  p: phi'*sin(theta)*sin(psi) + theta'*cos(psi)
  q: phi'*sin(theta)*cos(psi) - theta'*sin(psi)
  r: phi'*cos(theta) + psi'
L: (({A})*p^2 + ({B})*q^2 + C*r^2)/2 + h*r
constraints: {{no_turn: phi'*cos(theta) + psi' = 0}}
""")
    turned = [c.charge for c in discovery.charges if c.name != "energy"]
    assert len(turned) == 2
    assert all(is_zero(rate(charge)) for charge in turned)
    assert all(
        charge.has(sympy.sin) and discovery.system.t in charge.free_symbols for charge in turned
    )
    assert summary(discovery).independent == 2


@pytest.mark.parametrize("seed", range(2))
def test_a_vehicle_on_omniwheels_turns_its_velocity_by_a_part_of_its_angle(seed):
    """Three wheels 120 degrees apart: Campion, Bastin, d'Andréa-Novel, IEEE Trans. 12 (1996) 47."""
    rng = Random(seed)
    mass, inertia = rng.choice([("m", "J"), ("m", "2*J"), ("3*m", "J")])
    wheels = "\n".join(
        f"  w{k}: R*{w}' = y'*cos(theta + {k}*2*pi/3) - x'*sin(theta + {k}*2*pi/3) + l*theta'"
        for k, w in enumerate("abc")
    )
    discovery, _ = along(f"""
coordinates: [x, y, theta, a, b, c]
parameters: {{m: {POS}, I: {POS}, J: {POS}, R: {POS}, l: {POS}}}
T: ({mass})*(x'^2 + y'^2)/2 + I*theta'^2/2 + ({inertia})*(a'^2 + b'^2 + c'^2)/2
constraints:
{wheels}
""")
    theta, dx, dy = (discovery.system.symbol_of(n) for n in ("theta", "x'", "y'"))
    symbol = {s.name: s for s in discovery.system.parameters}
    M, K = 3 * symbol["m"] if mass == "3*m" else symbol["m"], symbol["J"]
    K = 2 * K if inertia == "2*J" else K
    kappa = 3 * K / (3 * K + 2 * M * symbol["R"] ** 2)
    expected = dx * sympy.cos(kappa * theta) + dy * sympy.sin(kappa * theta)
    assert any(is_zero(c.charge - expected) for c in discovery.charges)
    assert summary(discovery).independent == 9


@pytest.mark.long
def test_suslovs_body_with_two_equal_moments_keeps_its_angular_momentum():
    """Where B = A; in general only the energy and what turns are constant."""
    cases = derive(f"""
coordinates: [phi, theta, psi]
parameters: {{A: {POS}, B: {POS}, C: {POS}, h: {POS}}}
definitions:
  p: phi'*sin(theta)*sin(psi) + theta'*cos(psi)
  q: phi'*sin(theta)*cos(psi) - theta'*sin(psi)
  r: phi'*cos(theta) + psi'
L: (A*p^2 + B*q^2 + C*r^2)/2 + h*r
constraints: {{no_turn: phi'*cos(theta) + psi' = 0}}
""").special_cases
    [case] = cases
    assert (str(case.parameter), str(case.value)) == ("B", "A")
    assert {c.name for c in case.charges} == {"p_phi", "L_x", "L_y"}


@pytest.mark.parametrize("seed", range(4))
def test_a_momentum_has_an_integrating_factor_under_forces_along_the_velocity(seed):
    """v' = g' v + ...: p_f exp(-g); Gorringe, Leach, Am. J. Phys. 61 (1993) 991."""
    rng = Random(seed)
    n, k = rng.choice(["3/2", "-1", "a"]), rng.choice(["", " + b*f'", " + 2*t"])
    rate = f"({n})*r'/r{k}"
    discovery, rate_of = along(f"""
coordinates: {{r: {POS}, f: {{}}}}
parameters: {{a: {POS}, b: {POS}, mu: {POS}}}
T: (r'^2 + r^2*f'^2)/2
V: mu*r^2/2
forces: {{r: "({rate})*r'", f: "({rate})*r^2*f'"}}
""")
    [charge] = [c.charge for c in discovery.charges]
    assert is_zero(rate_of(charge))


@pytest.mark.parametrize("seed", range(4))
def test_a_skate_in_a_field_has_one_with_a_part_at_rest(seed):
    """z' = f(y) x', in a field B along z: x' sqrt(1 + f^2) - B int dy/sqrt(1 + f^2)."""
    f, h = Random(seed).choice([("y", "1"), ("2*y", "2"), ("sinh(y)", "1"), ("3", "1")])
    discovery, rate = along(f"""
coordinates: [x, y, z]
parameters: {{B: {{}}}}
L: (x'^2 + y'^2 + z'^2)/2 + {h}*B*x*y'
constraints: {{edge: "z' = ({f})*x'"}}
""")
    assert all(is_zero(rate(c.charge)) for c in discovery.charges)
    assert summary(discovery).independent >= 3
