"""Symmetries, first integrals and momentum equations of systems with constraints.

Numbers from the literature: on the surface the rolling disk is free in its two angles
(Bloch, Nonholonomic Mechanics and Control, 2nd ed., section 1.4), a rigid body in the plane
has the momenta of the Galilei group and its spin (Goldstein, section 4.1).
"""

import random
from pathlib import Path

import pytest
import sympy

from lagcli import load
from lagcli.algebra import is_zero
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.discovery.constrained import rank_on_surface
from lagcli.mechanics.discovery.discovery import Discovery
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.summary import summary
from lagcli.mechanics.discovery.surface import independent_on_surface
from lagcli.pipeline import explain
from lagcli.platform.effort import OutOfWork
from lagcli.reader import parse_text, read_problem
from tests.solved import solve

from .derived import derive
from .test_explanation import words

LIBRARY = Path(__file__).parents[2] / "problems"

# file -> names that are there, names of momentum equations, algebra, integrable
KNOWN = {
    "nonholonomic/rolling-vertical-disk": (
        "energy p_phi momentum_theta boost_phi boost_theta dilation conformal", "", None, None),
    "nonholonomic/chaplygin-sleigh": ("energy", "p_phi momentum_2", None, None),
    "nonholonomic/ball-on-turntable": (
        "p_phi momentum_x momentum_y moving_energy", "", None, None),
    "nonholonomic/nonholonomic-free-particle": (
        "energy p_y momentum_x boost_y charge_1", "", None, None),
    "nonholonomic/two-wheeled-cart": ("energy constraint_integral charge_1", "", None, None),
    "nonholonomic/skate-on-incline": ("energy p_phi boost_phi charge_1 charge_2", "", None, None),
    "discovery/snakeboard": ("energy p_psi p_phi", "momentum_1", None, None),
    "discovery/ball-in-cylinder": ("energy momentum_phi_alpha charge_1", "", None, None),
    "discovery/kepler-in-slanted-plane": (
        "energy charge_1 charge_2 charge_3", "", "so(3) where the energy is negative", True),
    "discovery/triangle-of-points": (
        "energy momentum_x momentum_y L_z boost_x boost_y charge_1", "", "Galilei", True),
    "classics/spherical-pendulum-cartesian": ("energy L_z", "", "R^2", True),
    "classics/particle-in-paraboloid": ("energy L_z", "", None, None),
    "driven/bead-on-wire-turning-horizontally": (
        "conformal_exp conformal_exp_2 translation_r_exp_2", "", "sch(1)", True),
    "chains/cartesian-double-pendulum": ("energy", "", "R", None),
    "driven/bead-on-wire-turning-in-vertical-plane": (
        "conformal_exp conformal_exp_2 moving_energy translation_r_exp translation_r_exp_2", "",
        "sch(1)", True),
    "classics/particle-on-helix": (
        "energy momentum_phi_z boost_phi_z dilation conformal", "", "sch(1)", True),
    "pulleys/double-atwood-tension": ("energy dilation conformal", "", "sch(2)", True),
}  # fmt: skip


def derived(name):
    return Derivation(load(LIBRARY / f"{name}.yaml"))


@pytest.mark.long
@pytest.mark.parametrize("name", KNOWN)
def test_what_is_known_is_found(name):
    names, changing, algebra, integrable = KNOWN[name]
    discovery = derived(name).discovery
    found = summary(discovery)
    assert not discovery.stopped
    assert set(names.split()) <= {c.name for c in discovery.charges}
    assert [c.name for c in discovery.momentum_equations] == changing.split()
    assert (algebra or "") in (found.name or "")
    assert found.integrable is integrable


def built(derivation, text):
    return derivation.system.build(parse_text(text))


# Bloch, 2nd ed., sections 1.7 (sleigh) and 5.8 (snakeboard, there divided by sin(phi)).
EQUATIONS = {
    "nonholonomic/chaplygin-sleigh": [
        ("p_phi", "(I + m*a^2)*phi' + m*a*(y'*cos(phi) - x'*sin(phi))",
         "-m*a*phi'*(x'*cos(phi) + y'*sin(phi))"),
        ("momentum_2", "m*(x'*cos(phi) + y'*sin(phi))", "m*a*phi'^2"),
    ],
    "discovery/snakeboard": [
        ("momentum_1",
         "l*m*cos(phi)*(x'*cos(theta) + y'*sin(theta)) + (m*l^2*theta' + J0*psi')*sin(phi)",
         "J0*psi'*phi'*cos(phi)"),
    ],
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", EQUATIONS)
def test_momentum_equations_are_those_of_the_textbook(name):
    derivation = derived(name)
    relations = derivation.dynamics.constraints.relations
    found = derivation.discovery.momentum_equations
    for charge, (title, momentum, rate) in zip(found, EQUATIONS[name], strict=True):
        assert charge.name == title
        assert charge.conserved is False
        assert is_zero(charge.charge - built(derivation, momentum), relations) is True
        assert is_zero(charge.rate - built(derivation, rate), relations) is True


@pytest.mark.long
@pytest.mark.parametrize("name", ["nonholonomic/rolling-vertical-disk", "discovery/snakeboard"])
def test_displacements_are_admissible(name):
    derivation = derived(name)
    for charge in (*derivation.discovery.charges, *derivation.discovery.momentum_equations):
        for equation in derivation.dynamics.constraints.equations:
            across = sympy.Add(
                *(a * x for a, x in zip(equation.row, charge.transformation.changes, strict=True))
            )
            assert is_zero(across, derivation.dynamics.constraints.relations) is True


@pytest.mark.long
def test_nothing_is_listed_twice():
    derivation = derived("discovery/triangle-of-points")
    charges = [c.charge for c in derivation.discovery.charges]
    area = built(derivation, "x1*(y2 - y3) + x2*(y3 - y1) + x3*(y1 - y2)")
    kept = independent_on_surface(charges, derivation.dynamics, Allowance(), [area])
    assert kept == list(range(7))


def test_momenta_that_contain_the_time_may_have_a_combination_without_it():
    """Along the level lines of a uniform field the momentum is constant (Liouville: integrable)."""
    found = summary(
        derive("""
coordinates: [x, y, a]
T: (x'^2 + y'^2 + a'^2)/2
V: x + 2*y
constraints: {wheel: x = a}
""").discovery
    )
    assert (found.in_involution, found.integrable) == (2, True)


@pytest.mark.long
@pytest.mark.parametrize(
    ("rod", "squared"),
    [
        ("sqrt(x^2 + y^2) = l", "x^2 + y^2 = l^2"),
        ("l - sqrt((x - 2)^2 + y^2) = 0", "(x - 2)^2 + y^2 = l^2"),
        ("y = sqrt(l^2 + x^2)", "y^2 = l^2 + x^2"),
    ],
)
def test_a_root_in_a_constraint_finds_what_its_square_finds(rod, squared):
    text = """
coordinates: [x, y, z]
parameters: {m: {assume: positive}, k: {assume: positive}, l: {assume: positive}}
T: m*(x'^2 + y'^2 + z'^2)/2
V: k*z
constraints: {rod: "%s"}
"""
    found = [derive(text % each).discovery for each in (rod, squared)]
    assert not found[0].stopped
    assert len(found[0].point_charges) == len(found[1].point_charges) >= 3
    # put in, it may list energy_z as well, a function of the momentum and the boost along z
    independent = [summary(each).independent for each in found]
    assert independent[0] == independent[1] >= 3


@pytest.mark.parametrize("place", ["h = 0", "h = s - l"])
def test_a_coordinate_that_is_0_on_the_constraints_ends_no_search(place):
    """The ansatz has 1/h; on a circle of any distance from the axis the angle moves uniformly."""
    text = (
        "coordinates: {s: {assume: positive}, h: {}, phi: {}}\n"
        "parameters: {m: {assume: positive}, l: {assume: positive}, k: {assume: positive}}\n"
        "T: m*(s'^2 + h'^2 + (s + k*h)^2*phi'^2)/2\n"
        f"constraints: {{string: s = l, cone: {place}}}\n"
    )
    found = derive(text).discovery
    assert "boost_phi" in {each.name for each in found.charges}
    assert not found.stopped


@pytest.mark.parametrize("friction", ["-c*r'", "-2*c*r'"])
def test_what_is_a_function_of_the_others_is_not_missed(friction):
    """A bead on a turning wire: two integrals with the time are all that there can be."""
    text = (
        "coordinates: {r: {assume: positive}, phi: {}}\n"
        "parameters: {m: {assume: positive}, w: {assume: positive}, c: {assume: positive}}\n"
        "T: m*(r'^2 + r^2*phi'^2)/2\nconstraints: {drive: phi = w*t}\n"
        f"forces: {{r: {friction}}}\n"
    )
    found = derive(text).discovery
    assert "every other integral is in general a function of these" in found.ansatz
    assert not found.stopped


@pytest.mark.parametrize("a", [1, -2, 3])
def test_constraints_that_free_motion_fulfils_cost_no_symmetry(a):
    """z' = a (y x' - x y') of straight lines: z'' = a (y x'' - x y'') is 0 by itself.

    x', y' and the places at t = 0 are five constants of it.
    """
    found = derive(
        f"{{coordinates: [x, y, z], T: (x'^2 + y'^2 + z'^2)/2, "
        f"constraints: {{c: z' = {a}*(y*x' - x*y')}}}}"
    ).discovery
    assert {"p_x", "p_y", "boost_x"} <= {c.name for c in found.charges}
    assert summary(found).independent == 5


def test_on_a_turning_wire_the_five_are_constant_along_the_known_motion():
    """r = A exp(w t) + B exp(-w t) + g sin(w t)/(2 w^2) solves r'' = w^2 r - g sin(w t)."""
    derivation = derived("driven/bead-on-wire-turning-in-vertical-plane")
    system = derivation.system
    m, g, w, A, B, t = sympy.Rational(3, 2), 7, sympy.Rational(2, 3), 5, -2, system.t
    r = A * sympy.exp(w * t) + B * sympy.exp(-w * t) + g * sympy.sin(w * t) / (2 * w**2)
    assert sympy.simplify(r.diff(t, 2) - w**2 * r + g * sympy.sin(w * t)) == 0
    along = dict(zip(system.parameters, (m, g, w), strict=True))
    along |= dict(zip((*system.q, *system.qdot), (r, w * t, r.diff(t), w), strict=True))
    charges = [c.charge.xreplace(along) for c in derivation.discovery.charges]
    assert len(charges) == 5
    for Q in charges:
        start, end = (Q.subs(t, x).evalf(30) for x in (sympy.Rational(1, 7), 2))
        assert abs(start - end) < 1e-20 * (1 + abs(start))


FREE = "coordinates: [x]\n{}L: m*x'^2/2 {}"
HELD = [
    ("coordinates: [x, y]\n{}T: m*(x'^2 + 3*y'^2)/8\nV: -({})\nconstraints: {{c: y = x + 2}}"),
    ("coordinates: [y, x]\n{}T: m*(x'^2 + y'^2/4)/4\nV: -({})\nconstraints: {{c: y' - 2*x' = 0}}"),
    ("coordinates: [a, x, y]\n{}T: m*(x'^2 + (y' + a*x')^2/4)/4\nV: -({})\n"
     "constraints: {{c: y = 2*x, d: a = 0}}"),
]  # fmt: skip


@pytest.mark.parametrize("held", HELD)
@pytest.mark.parametrize("force", ["-k*x^2/2", "m*g*x", "k*x^2 + x*sin(w*t)", "-k*x^2/2 + x*t"])
def test_a_linear_system_has_the_same_five_with_and_without_a_constraint(held, force):
    parameters = "parameters: {m: {assume: positive}, k: {assume: positive}, g: {}, w: {}}\n"
    free = summary(derive(FREE.format(parameters, f"+ {force}")).discovery)
    discovery = derive(held.format(parameters, force)).discovery
    found = summary(discovery)
    assert len([c for c in discovery.charges if c.name != "constraint_integral"]) == 5
    if "x' = 0" not in held:
        assert (found.dimension, found.name, found.integrable) == (5, free.name, True)


def test_a_constraint_that_is_put_in_leaves_its_constant():
    discovery = derived("canonical/bead-on-rotating-hoop-multiplier").discovery
    assert {c.name for c in discovery.charges} == {"moving_energy", "constraint_integral"}
    [angle] = [c.charge for c in discovery.charges if c.name == "constraint_integral"]
    assert is_zero(angle - built(discovery, "omega*t - phi")) is True


def test_of_two_dilations_the_difference_is_a_rotation():
    """Two falling bodies in oblique coordinates: the Schroedinger algebra of a plane."""
    discovery = derived("pulleys/double-atwood-tension").discovery
    assert sum(c.transformation.time != 0 for c in discovery.point_charges) == 3
    assert len(discovery.point_charges) == 8


def test_without_a_degree_of_freedom_nothing_is_conserved():
    assert derived("contact/block-on-shaking-table-kept").discovery.charges == ()


MOVING = {  # a cylinder on a plank, a block on a belt with drag, Atwood's machine in a lift
    "T: x'^2/2 + R^2*th'^2/4\nconstraints: {plank: X = %s, roll: x' - X' = R*th'}": ("x th X", 6),
    "T: x'^2/2\nV: R*(x - X)^2/2\ndissipation: x'^2/3\nconstraints: {belt: X = %s}": ("x X", 5),
    "T: (X' - x')^2/2 + R*(X' - y')^2/2\nV: 2*X - x - y\n"
    "constraints: {lift: X = %s, string: x + y = 1}": ("x y X", 5),
}  # fmt: skip


@pytest.mark.parametrize("motion", ["R*t", "3*t^2/2", "sin(2*t)"])
@pytest.mark.parametrize("text", MOVING)
def test_linear_systems_with_moving_supports_have_five(text, motion):
    """With the constant of rolling that is one more; 2 n = 2 of them are independent, or 3."""
    coordinates, number = MOVING[text]
    given = "\nparameters: {R: {assume: positive}}\n"
    derivation = derive(f"coordinates: [{', '.join(coordinates.split())}]{given}{text % motion}\n")
    assert len(derivation.discovery.charges) == number
    assert not derivation.discovery.stopped
    assert summary(derivation.discovery).independent == number - 3


def test_the_counts_are_confirmed_where_only_the_constraints_make_the_inertia_regular():
    text = """
coordinates: [x, y, h]
parameters: {m: {assume: positive}, n: {assume: positive}, a: {}, l: {assume: positive}}
T: m*(h' - x')^2/2 + n*(h' - y')^2/2
constraints: {lift: h = a*t^2/2, string: x + y = l}
"""
    answers = solve(read_problem("lift.yaml", text.encode()).checked(), ["algebra"])
    assert not answers.warnings
    assert answers.sections["algebra"].independent == 2


def test_what_was_not_sought_without_constraints_is_said_of_the_system_with_them():
    """Airy's equation on a line: x'' = -t x."""
    text = "coordinates: [x, y]\nL: (x'^2 + y'^2)/2 - 5*t*x^2/2\nconstraints: {line: y = 2*x}\n"
    found = derive(text).discovery
    assert not found.charges
    assert any("no elementary formula was found" in reason for reason in found.stopped)


@pytest.mark.parametrize(
    ("constraint", "again"),
    [
        ("x^2 + y^2 = a^2", "2*x^2 + 2*y^2 = 2*a^2"),
        ("x^2 + y^2 = a^2", "(x^2 + y^2)^2 = a^4"),
        ("x^2 + y^2 = (a - z)^2", "x^2 + y^2 - z^2 = a^2 - 2*a*z"),
        ("x^2 + y^2 + z^2 = a^2", "\"x*x' + y*y' + z*z' = 0\", c3: 3*a^2 - 3*y^2 = 3*x^2 + 3*z^2"),
    ],
)
def test_a_constraint_that_is_given_twice_takes_no_symmetry_away(
    constraint: str, again: str
) -> None:
    text = (
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, g: , a: {assume: positive}}\n"
        "T: m*(x'^2 + y'^2 + z'^2)/2\nV: m*g*z\nconstraints: {c1: %s%s}\n"
    )
    once, twice = (
        {charge.name for charge in derive(text % (constraint, more)).discovery.charges}
        for more in ("", f", c2: {again}")
    )
    assert {"energy", "L_z"} <= once == twice


BALL = """
coordinates: {{x: {{}}, y: {{}}, phi: {{}}, theta: {{}}, psi: {{}}}}
definitions:
  w_x: theta'*cos(phi) + psi'*sin(phi)*sin(theta)
  w_y: theta'*sin(phi) - psi'*sin(theta)*cos(phi)
  w_z: phi' + psi'*cos(theta)
T: (x'^2 + y'^2)/2 + {k}*(w_x^2 + w_y^2 + w_z^2)/2
V: -{g}*x
constraints: {{roll_x: x' - w_y + {W}*y = 0, roll_y: y' + w_x - {W}*x = 0}}
"""


@pytest.mark.parametrize("seed", range(3))
def test_of_a_rolling_ball_all_five_constants_are_found(seed):
    """x'' = g/(1 + k) on an incline; circles at the rate k W/(1 + k) on a table that turns.

    Gersten, Soodak, Tiersten, Am. J. Phys. 60 (1992) 43.  The five are functions of x, y, x', y' and the spin
    w_z: along the known motion they are constant whatever the angles are.
    """
    random.seed(seed)
    k = sympy.Rational(random.randint(1, 9), 10)
    W, g = [(0, random.randint(1, 9)), (random.randint(1, 5), 0)][seed % 2]
    derivation = derive(BALL.format(k=k, g=g, W=W))
    found = summary(derivation.discovery)
    assert found.independent == 5
    system = derivation.system
    a, rate = g / (1 + k), k * W / (1 + k)
    values = []
    for t in (sympy.Rational(1, 3), sympy.Rational(7, 5)):
        x, y = 1 + 2 * t + a * t**2 / 2, 3 - t
        dx, dy = 2 + a * t, sympy.Integer(-1)
        if W:
            x, y = 1 + 2 * sympy.cos(rate * t), 3 + 2 * sympy.sin(rate * t)
            dx, dy = -2 * rate * sympy.sin(rate * t), 2 * rate * sympy.cos(rate * t)
        w_x, w_y, w_z = W * x - dy, dx + W * y, sympy.Rational(4, 3)
        phi, theta, psi = (sympy.Rational(random.randint(1, 9), 7) for _ in range(3))
        dpsi = (w_x * sympy.sin(phi) - w_y * sympy.cos(phi)) / sympy.sin(theta)
        dtheta = w_x * sympy.cos(phi) + w_y * sympy.sin(phi)
        state = (x, y, phi, theta, psi, dx, dy, w_z - dpsi * sympy.cos(theta), dtheta, dpsi)
        point = {system.t: t, **dict(zip((*system.q, *system.qdot), state, strict=True))}
        values.append([c.charge.subs(point).evalf(30) for c in derivation.discovery.charges])
    assert all(abs(u - v) < 1e-20 for u, v in zip(*values, strict=True))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("turning", [True, False])
def test_a_boundary_term_has_the_work_of_constraints_that_move(turning, seed):
    """dG/dt = dL + the work: a turntable works on its ball, a plane at rest does not."""
    W, k = f"{random.Random(seed).randint(2, 5)}*W" if turning else "0", seed + 1
    told = words(
        explain(
            derive(
                "{coordinates: [x, y, u, v], parameters: [W], "
                f"T: (x'^2 + y'^2)/2 + {k}*(u'^2 + v'^2)/5, constraints: {{"
                f"roll_x: {{equation: x' = u' - {W}*y}}, roll_y: {{equation: y' = v' + {W}*x}}}}}}"
            ),
            ["discovered"],
        ),
        "Discovered symmetries",
    )
    assert "minus G" in told
    assert ("is the change of L plus the work of the constraints." in told) is turning


# minus the potential, and the forces beside it
PUSHED = {
    "-k*x^2/2 - k*y^2/2": "",
    "-k*x^2/2 + F*y": "",
    "-k*x^2/2": "{x: -c*x'}",
    "F*x - F*y": "",
}


@pytest.mark.parametrize("force", PUSHED)
def test_of_a_ball_that_rolls_under_forces_those_of_its_centre_are_found(force):
    """(I/R^2 + m) x'' = f(x, x'), (I/R^2 + m) y'' = g(y): two functions of the time for each.

    Neimark, Fufaev, *Dynamics of Nonholonomic Systems*, chapter III, section 2.
    """
    text = f"""
coordinates: [x, y, phi, theta, psi]
parameters: {{m: {{assume: positive}}, R: {{assume: positive}}, I: {{assume: positive}},
  k: {{assume: positive}}, c: {{assume: positive}}, F: {{assume: positive}}}}
T: m*(x'^2 + y'^2)/2 + I*(theta'^2 + phi'^2 + psi'^2 + 2*phi'*psi'*cos(theta))/2
V: -({force})
forces: {PUSHED[force] or "{}"}
constraints:
  along_x: x' - R*(theta'*sin(phi) - psi'*sin(theta)*cos(phi)) = 0
  along_y: y' + R*(theta'*cos(phi) + psi'*sin(theta)*sin(phi)) = 0
"""
    discovery = derive(text).discovery
    assert summary(discovery).independent == 5
    assert all(c.conserved is True and c.verified == "exact" for c in discovery.charges)


@pytest.mark.parametrize("letters", [True, False])
@pytest.mark.parametrize("seed", range(2))
def test_a_rod_with_a_blade_at_its_centre_of_mass_has_three(seed, letters):
    """phi = w t, v' = -g sin(phi - a): w v - g cos(phi - a), with a the direction of the slope.

    Gantmacher, *Lectures in Analytical Mechanics*, sections 3 and 8.
    """
    draw = random.Random(seed)
    m, n, p, q = draw.randint(1, 4), draw.randint(1, 4), draw.randint(1, 3), draw.randint(0, 3)
    length, g = draw.randint(2, 5), draw.randint(2, 9)
    given = {"l": length, "g": g, "p": p, "q": q, "k": 1}
    L, G, P, Q, K = given if letters else given.values()
    derivation = derive(f"""
coordinates: [x1, y1, x2, y2]
parameters: {{l: {{assume: positive}}, g: {{}}, p: {{}}, q: {{}}, k: {{assume: positive}}}}
T: {K}*({m}*(x1'^2 + y1'^2)/2 + {n}*(x2'^2 + y2'^2)/2)
V: {K}*{G}*({m}*({P}*y1 + {Q}*x1) + {n}*({P}*y2 + {Q}*x2))
constraints:
  rod: (x1 - x2)^2 + (y1 - y2)^2 = {L}^2
  blade: ({m}*x1' + {n}*x2')*(y2 - y1) = ({m}*y1' + {n}*y2')*(x2 - x1)
""")
    discovery = derivation.discovery
    assert summary(discovery).independent == len(discovery.charges) == 3
    assert "not solved" not in discovery.ansatz
    system = derivation.system
    put = {x: given[x.name] for x in system.parameters}
    t, w = sympy.Symbol("t"), sympy.Rational(draw.randint(1, 9), 5)
    phi = w * t + 1
    v = 2 + g * (p * sympy.cos(phi) - q * sympy.sin(phi)) / w
    x, y = (sympy.integrate(sympy.expand(v * f(phi)), t) for f in (sympy.cos, sympy.sin))
    places = [
        centre + arm * f(phi)
        for arm in (-sympy.Rational(n * length, m + n), sympy.Rational(m * length, m + n))
        for centre, f in ((x, sympy.cos), (y, sympy.sin))
    ]
    values = []
    for time in (sympy.Rational(1, 3), sympy.Rational(7, 5)):
        state = (f.subs(t, time) for f in (*places, *(place.diff(t) for place in places)))
        point = dict(zip((*system.q, *system.qdot), state, strict=True)) | put
        values.append([c.charge.subs(point).evalf(30) for c in discovery.charges])
    assert all(abs(u - v) < 1e-20 for u, v in zip(*values, strict=True))


def test_suslovs_free_body_turns_uniformly_in_space_and_in_itself():
    """omega is constant on both sets of axes, with |omega|^2 in common.

    Suslov, *Theoretical Mechanics* (1946), section 53; Bloch, section 8.6.
    """
    derivation = derive("""
coordinates: [phi, theta, psi]
parameters: {A: {assume: positive}, B: {assume: positive}, C: {assume: positive}}
definitions:
  p: phi'*sin(theta)*sin(psi) + theta'*cos(psi)
  q: phi'*sin(theta)*cos(psi) - theta'*sin(psi)
  r: phi'*cos(theta) + psi'
T: (A*p^2 + B*q^2 + C*r^2)/2
constraints: {suslov: phi'*cos(theta) + psi' = 0}
""")
    assert summary(derivation.discovery).independent == 4
    system = derivation.system
    (phi, theta, _), (dphi, dtheta, _) = system.q, system.qdot
    in_space = (
        dtheta * sympy.cos(phi) - dphi * sympy.sin(theta) * sympy.cos(theta) * sympy.sin(phi),
        dtheta * sympy.sin(phi) + dphi * sympy.sin(theta) * sympy.cos(theta) * sympy.cos(phi),
        dphi * sympy.sin(theta) ** 2,
    )  # with psi' = -phi' cos(theta)
    constants = dict.fromkeys(system.parameters, sympy.Rational(7, 5))
    states = [
        dict(zip((*system.q, *system.qdot), map(sympy.Rational, numbers), strict=True))
        for numbers in ("4/7 6/5 3/8 1/3 2/9 5/7".split(), "1/7 8/5 9/8 2/3 4/9 1/7".split())
    ]
    charges = [c.charge.subs(constants) for c in derivation.discovery.charges]
    for component in in_space:
        ratios = [[(c / component).subs(state).evalf(30) for state in states] for c in charges]
        assert any(abs(one - other) < 1e-20 * abs(one) for one, other in ratios)


ROLLING = {
    # Routh, Advanced Rigid Dynamics, article 225; the cone's half angle is 30 degrees
    "cone": ("""
coordinates: {s: {assume: positive}, phi: {}, f: {}, th: {}, h: {}}
parameters: {m: {assume: positive}, a: {assume: positive}, g: {assume: positive}}
definitions:
  wx: th'*cos(f) + h'*sin(th)*sin(f)
  wy: th'*sin(f) - h'*sin(th)*cos(f)
  wz: f' + h'*cos(th)
T: m*(s'^2 + s^2*phi'^2/4)/2 + m*a^2*(wx^2 + wy^2 + wz^2)/5
V: m*g*s*sqrt(3)/2
constraints:
  up: s' = a*(-wx*sin(phi) + wy*cos(phi))
  around: s*phi'/2 = -a*((wx*cos(phi) + wy*sin(phi))/2 + wz*sqrt(3)/2)
""", "s^2*phi'", 3),
    # Neimark, Fufaev, Dynamics of Nonholonomic Systems, chapter III
    "lying cylinder": ("""
coordinates: [theta, z, f, h, s]
parameters: {m: {assume: positive}, a: {assume: positive}, rho: {assume: positive}, g: {assume: positive}}
definitions:
  wx: h'*cos(f) + s'*sin(h)*sin(f)
  wy: h'*sin(f) - s'*sin(h)*cos(f)
  wz: f' + s'*cos(h)
T: m*(rho^2*theta'^2 + z'^2)/2 + m*a^2*(wx^2 + wy^2 + wz^2)/5
V: -m*g*rho*cos(theta)
constraints:
  across: rho*theta' = -a*wz
  along: z' = a*(-wx*sin(theta) + wy*cos(theta))
""", ("z'*cos(sqrt(2/7)*theta) + a*sqrt(2/7)*(h'*cos(f - theta)"
      "+ s'*sin(h)*sin(f - theta))*sin(sqrt(2/7)*theta)"), 3),
    "skate on a turntable": ("""
coordinates: [x, y, phi]
parameters: {m: {assume: positive}, J: {assume: positive}, W: {assume: positive}}
T: m*(x'^2 + y'^2)/2 + J*phi'^2/2
constraints: {blade: (x' + W*y)*sin(phi) = (y' - W*x)*cos(phi)}
""", "(W - phi')*(x'*cos(phi) + y'*sin(phi)) - W*phi'*(y*cos(phi) - x*sin(phi))", 4),
    "wheel on a turntable": ("""
coordinates: [x, y, phi, psi]
parameters: {m: {assume: positive}, I: {assume: positive}, J: {assume: positive}, R: {assume: positive}, W: {assume: positive}}
T: m*(x'^2 + y'^2)/2 + J*phi'^2/2 + I*psi'^2/2
constraints:
  along: x' + W*y = R*psi'*cos(phi)
  across: y' - W*x = R*psi'*sin(phi)
""", "(W - phi')*R*psi' - m*R^2/(m*R^2 + I)*W^2*(y*cos(phi) - x*sin(phi))", 4),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", ROLLING)
def test_of_what_rolls_on_a_moving_or_curved_ground_all_are_found(name):
    text, wanted, number = ROLLING[name]
    found = derive(text)
    discovery, system = found.discovery, found.dynamics.system
    expected = system.build(parse_text(wanted))
    charges = [c.charge for c in discovery.charges]
    assert rank_on_surface(found.dynamics, charges) == number
    assert rank_on_surface(found.dynamics, [*charges, expected]) == number


@pytest.mark.parametrize(("axis", "power"), [("z", 2), ("x", 2), ("y", 4)])
def test_without_its_field_a_charge_on_a_cylinder_turns_and_glides(axis, power):
    """As with an angle in place of the constraint."""
    u, w = (x for x in "xyz" if x != axis)
    derivation = derive(
        f"{{coordinates: [x, y, z], parameters: {{m: {{assume: positive}}, B: {{}}}}, "
        f"L: \"m*(x'^2 + y'^2 + z'^2)/2 + B*{u}*{axis}'\", "
        f"constraints: {{tube: {u}^{power} + {w}^{power} = 1}}}}"
    )
    [case] = derivation.special_cases
    assert (str(case.parameter), case.value) == ("B", 0)
    new = {c.name for c in case.charges}
    assert f"boost_{axis}" in new
    assert (f"L_{axis}" in new) is (power == 2)


@pytest.mark.parametrize("pull", ["g*(m*y + n*v)", "0", "-g*x*m - g*u*n"])
def test_products_whose_time_cancels_are_not_listed_on_constraints(pull):
    """P_y² + 2 M g (m y + n v) of a rod in free fall is a sum of products of p_y + M g t, the boost."""
    text = (
        "coordinates: [x, y, u, v]\n"
        "parameters: {m: {assume: positive}, n: {assume: positive}, g: {assume: positive}}\n"
        f"T: m*(x'^2 + y'^2)/2 + n*(u'^2 + v'^2)/2\nV: {pull}\n"
        "constraints: {rod: (x - u)^2 + (y - v)^2 = 1}\n"
    )
    discovery = derive(text).discovery
    assert discovery.hidden_charges == ()
    assert summary(discovery).independent >= 5


def test_what_was_found_is_kept_where_a_later_search_takes_too_much(monkeypatch):
    def endless(_):
        raise OutOfWork

    monkeypatch.setattr(Discovery, "_on_surface", endless)
    text = (
        "{coordinates: [x, y, theta], parameters: {m: {assume: positive}, J: {assume: positive}}, "
        "T: \"m*(x'^2 + y'^2)/2 + J*theta'^2/2\", "
        "constraints: {edge: \"x'*sin(theta) - y'*cos(theta) = 0\"}}"
    )
    found = derive(text).discovery
    assert "energy" in {charge.name for charge in found.charges}
    assert any("too much work" in each for each in found.stopped)
