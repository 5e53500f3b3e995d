"""Steady motions under velocity constraints against the classical equations of a rolling hoop."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import pytest
from sympy import Symbol

from lagcli.algebra.build import Builder, symbol
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.steady.statement import steady_motions

from .derived import derive

HOOP = """
coordinates: [x, y, theta, phi, psi]
definitions:
  X: x - cos(theta)*sin(phi)
  Y: y + cos(theta)*cos(phi)
  Z: sin(theta)
T: (X'^2 + Y'^2 + Z'^2)/2 + (theta'^2 + phi'^2*sin(theta)^2)/4 + (psi' + phi'*cos(theta))^2/2
V: 10*Z
constraints:
  along: x' + psi'*cos(phi) = 0
  across: y' + psi'*sin(phi) = 0
"""


@pytest.fixture(scope="module")
def hoop():
    section, missing = steady_motions(derive(HOOP))
    assert not missing
    return section


def rates(theta: float, spins: tuple[float, float]) -> tuple[float, float, float]:
    """theta'', phi'', psi'' at theta' = 0 by the moments about the centre (m = R = 1).

    With W = psi' + phi' cos: (A + 1) theta'' = A phi'^2 sin cos - (C + 1) W phi' sin - g cos.
    """
    phi, psi = spins
    whole = psi + phi * cos(theta)
    bend = 0.5 * phi**2 * sin(theta) * cos(theta) - 2 * whole * phi * sin(theta)
    return (bend - 10 * cos(theta)) / 1.5, 0.0, 0.0


def square(theta: float, spins: tuple[float, float]) -> float:
    """omega^2 by differences: theta'' along the changes of phi', psi' that theta' brings.

    A phi'' sin = theta' (C W - 2 A phi' cos), (C + 1) W' = theta' phi' sin.
    """
    phi, psi = spins
    whole = psi + phi * cos(theta)
    dphi = (whole - phi * cos(theta)) / (0.5 * sin(theta))
    dpsi = phi * sin(theta) / 2 - dphi * cos(theta) + phi * sin(theta)
    h = 1e-5
    ends = [rates(theta + s * h, (phi + s * h * dphi, psi + s * h * dpsi))[0] for s in (1.0, -1.0)]
    return -(ends[0] - ends[1]) / (2 * h)


def value(tree, **at: float) -> float:
    names = {name: symbol(name) for name in at}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'"))
    put_in = {**{names[n]: v for n, v in at.items()}, **{Symbol(n + "'"): v for n, v in at.items()}}
    return float(build(tree).subs({s: put_in[s] for s in build(tree).free_symbols}))


@pytest.mark.long
def test_a_hoop_rolls_in_a_circle_and_its_oscillation(hoop):
    circle = next(m for m in hoop.motions if not m.at)
    assert circle.free == ("theta", "phi'")
    for theta, phi in ((1.1, 2.0), (0.7, -3.0), (2.3, 0.9)):
        psi = value(circle.rates["psi"], theta=theta, phi=phi)
        assert abs(rates(theta, (phi, psi))[0]) < 1e-12
        found = value(circle.frequencies_squared[0], theta=theta, phi=phi)
        assert found == pytest.approx(square(theta, (phi, psi)), rel=1e-8)


@pytest.mark.long
def test_upright_it_rolls_on_where_it_is_fast_enough(hoop):
    straight = next(m for m in hoop.motions if {n: to_grammar(v) for n, v in m.at.items()}
                    == {"theta": "pi/2"})  # fmt: skip
    assert to_grammar(straight.rates["phi"]) == "0"
    [limit] = straight.verdict.spectrum
    assert (to_grammar(limit.left), to_grammar(limit.right)) == ("2*psi'^2", "5")
    speed = sqrt(2.5)
    assert square(pi / 2, (0.0, speed)) == pytest.approx(0, abs=1e-8)


def test_a_knife_edge_in_coordinates_that_turn_is_not_decided():
    section, _ = steady_motions(
        derive("""
coordinates: [x, y, phi]
T: (x'^2 + y'^2 + phi'^2)/2
constraints: {blade: x'*sin(phi) = y'*cos(phi)}
""")
    )
    assert not section.complete


@pytest.mark.parametrize("arm", [2, 3, 5])
def test_the_conditions_are_the_balance_of_the_forces(arm):
    # a ring dragged along a rod, with a pendulum: friction alone, and gravity's moment alone
    section, missing = steady_motions(
        derive(f"""
coordinates: [x, theta]
T: 2*x'^2 + {arm}*x'*theta'*cos(theta) + {arm**2}*theta'^2/2
V: -{arm}*g*cos(theta)
parameters: {{g: {{assume: positive}}, b: {{assume: positive}}}}
dissipation: b*x'^2/2
""")
    )
    assert not missing
    for rate, angle in ((0.3, 0.0), (0.0, 0.7), (-1.1, 2.0)):
        at = {"x": rate, "theta": angle, "g": 9.0, "b": 0.4}  # of x the rate alone occurs
        dragged, turned = (value(tree, **at) for tree in section.conditions.values())
        assert dragged == pytest.approx(rate)  # b x' = 0 and m g l sin θ = 0, without what
        assert turned == pytest.approx(sin(angle))  # cannot be 0


@pytest.mark.parametrize("arm", [-2, -1, 1, 3])
@pytest.mark.parametrize("direction", [0, 4])
def test_a_sleigh_runs_straight_on_with_its_centre_of_mass_in_front(arm, direction):
    """Chaplygin's sleigh (Bloch, chapter 1): φ'' = -m a v φ'/(I + m a²), v along the blade."""
    turned = f"(phi + {direction}*pi/6)"
    section, missing = steady_motions(
        derive(f"""
coordinates: [x, y, phi]
T: ((x' - {arm}*phi'*sin{turned})^2 + (y' + {arm}*phi'*cos{turned})^2)/2 + phi'^2
constraints: {{blade: x'*sin{turned} = y'*cos{turned}}}
""")
    )
    assert not missing
    [motion] = section.motions
    assert not section.complete  # without an arm it runs in circles, too
    [falls] = motion.verdict.hurwitz
    for phi in (0.2, 1.3, 2.8, -2.0):
        for v in (1.0, -1.0):
            at = {"phi": phi, "x": v * cos(phi + direction * pi / 6)}  # of x the rate alone occurs
            assert (value(falls.left, **at) > value(falls.right, **at)) == (arm * v > 0)


@pytest.mark.parametrize("inertia", [(1, 2, 3), (3, 1, 2), (2, 2, 1)])
def test_at_a_pole_of_the_angles_nothing_moves_steadily(inertia):
    """Suslov: with ω₃ = 0, φ' and ψ' turn nothing at θ = π, where ω = 0 for every φ'."""
    A, B, C = inertia
    section, missing = steady_motions(
        derive(f"""
coordinates: {{theta: {{assume: positive}}, phi: , psi: }}
definitions:
  w1: phi'*sin(theta)*sin(psi) + theta'*cos(psi)
  w2: phi'*sin(theta)*cos(psi) - theta'*sin(psi)
  w3: phi'*cos(theta) + psi'
T: ({A}*w1^2 + {B}*w2^2 + {C}*w3^2)/2
constraints: {{suslov: psi' + phi'*cos(theta) = 0}}
""")
    )
    assert not missing
    assert section.motions
    angles = [value(m.at["theta"]) for m in section.motions if "theta" in m.at]
    assert all(abs(sin(angle)) > 0.1 for angle in angles)


@pytest.mark.parametrize("slope", ["y", "sin(y)", "1/(2 + y^2)", "y*exp(y)"])
@pytest.mark.parametrize(
    ("across", "drifts"),
    [
        ("5*y'^2/2", True),  # y'' = 0: Rosenberg's particle
        ("5*y'^2/2 + 3*x'^2*cosh(y)", False),  # y'' is x'^2 times a function of y
        ("5*y'^2/2 - y^2", False),  # steady where y = 0 only
    ],
)
def test_what_drifts_uniformly_from_one_steady_motion_to_another_is_stable_among_them(
    slope, across, drifts
):
    """z' = f(y) x': a motion with a small y' = const is always as near to one with y' = 0."""
    section, missing = steady_motions(
        derive(f"""
coordinates: [x, y, z]
L: (x'^2 + z'^2)/2 + {across}
constraints: {{plane: z' = ({slope})*x'}}
""")
    )
    assert not missing
    found = [m.verdict for m in section.motions or ()]
    assert any("0 in all of it" in each.reason for each in found) is drifts
    assert all(each.stable and each.across for each in found) or not drifts


SLOPE = "parameters: {m: {assume: positive}, g: {assume: positive}, al: {}}\nV: -m*g*x*sin(al)\n"
SKATE = """
coordinates: [x, y, phi]
T: m*(x'^2 + y'^2)/2 + phi'^2/2
constraints: {blade: x'*sin(phi) = y'*cos(phi)}
"""
CART = """
coordinates: [x, y, phi, a, b]
T: m*(x'^2 + y'^2)/2 + phi'^2/2 + (a'^2 + b'^2)/2
constraints:
  skid: y'*cos(phi) = x'*sin(phi)
  right: x'*cos(phi) + y'*sin(phi) + phi' = a'
  left: x'*cos(phi) + y'*sin(phi) - phi' = b'
"""
BEAD = """
coordinates: [z, y, x]
T: m*(x'^2 + y'^2 + z'^2)/2
constraints: {contact: x' = y*z', level: y' = 0}
"""


@pytest.mark.parametrize(
    ("text", "held", "moving"), [(SKATE, "phi", "y"), (CART, "phi", "b"), (BEAD, "y", "z")]
)
def test_what_moves_across_the_slope_keeps_its_velocity(text, held, moving):
    """With the heading at a right angle to the slope nothing accelerates, at any speed."""
    section, _ = steady_motions(derive(text + SLOPE))
    assert section.motions
    for motion in section.motions:
        assert motion.free == (f"{moving}'",)
        assert abs(value(motion.at[held])) == pytest.approx(0 if held == "y" else pi / 2)
        assert motion.verdict.stable is not True
