"""What is said of energy, contacts, cyclic coordinates and turning points, on random systems."""

from __future__ import annotations

import math
import random
import re

import pytest
import sympy

import lagcli
from lagcli.algebra.build import symbol
from lagcli.algebra.numeric import Evaluator
from lagcli.document import Paragraph
from lagcli.expression import Name
from lagcli.formatters import explaining
from lagcli.formatters.built_in.text import render
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.options import Options
from lagcli.mechanics.averaged import averaged
from lagcli.mechanics.conditions import conditions, opposites
from lagcli.mechanics.explaining.recurring import recurrences
from lagcli.mechanics.impacts import when_constant
from lagcli.mechanics.reduction.statement import reduction
from lagcli.mechanics.statements import Statements
from lagcli.pipeline import explain
from lagcli.statements.wording import conditions as in_words

from .derived import derive
from .test_explanation import rows, words

SEEDS = range(6)
ALGEBRA = "The algebra of the symmetries"


def said(text, title, *also):
    return words(explain(derive(text), also), title)


def candidate(text):
    return next(c for c in derive(text).noether.charges if c.source == "candidate")


def number(expression, at):
    value = expression.xreplace({s: at[s.name] for s in expression.free_symbols})
    return float(value)


# -- special values -------------------------------------------------------------------------------

# V, and what must vanish for L_z = m (x y' - y x') to be conserved: one of these sets of parameters
BREAKING = {
    "c*x^3": [["c"]],
    "c*x*y + c*d*x": [["c"]],
    "c*(a*x + b*y)": [["c"], ["a", "b"]],
    "c*x*sin(a*t)": [["c"], ["a"]],
    "c*f(x)": [["c"], []],
    "a*x + b*y": [["a", "b"]],
}


@pytest.mark.parametrize("V", BREAKING)
def test_not_conserved_unless_names_what_alone_makes_the_rate_vanish(V):
    functions = "functions: {f: [x]}\n" * ("f(x)" in V)
    text = (
        f"coordinates: [x, y]\nparameters: [m, a, b, c, d]\n{functions}"
        f"T: m*(x'^2 + y'^2)/2\nV: {V} + (x^2 + y^2)^2\nsymmetries: {{turn: {{x: -y, y: x}}}}\n"
    )
    charge = candidate(text)
    for vanishing in BREAKING[V]:
        zeros = {s: 0 for s in charge.rate.free_symbols if s.name in vanishing}
        assert not vanishing or charge.rate.xreplace(zeros) == 0
    told = said(text, "Conserved quantities")
    only = len(BREAKING[V]) == 1 == len(BREAKING[V][0])
    assert (f"It is not conserved unless {BREAKING[V][0][0]} = 0, because" in told) is only
    assert ("It is not conserved in general, because" in told) is not only


@pytest.mark.parametrize("power", [2, 3])
def test_a_change_that_is_a_total_derivative_for_special_values_does_not_conserve_Q(power):
    """The charge is Q - G there."""
    text = (
        "coordinates: [x, y]\nparameters: {m: , k: {assume: positive}, s: }\nT: m*(x'^2 + y'^2)/2\n"
        f"V: k*(x^2 + y^2)/2 + s*x*y^{power}\nsymmetries: {{two: {{x: x', y: -y'}}}}\n"
    )
    charge = candidate(text)
    assert charge.rate.xreplace({s: 0 for s in charge.rate.free_symbols if s.name == "s"}) != 0
    told = said(text, "Conserved quantities")
    because = "because of a change of L that is not a total time derivative unless s = 0:"
    assert f"It is not conserved, {because}" in told


# -- the energy -----------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", SEEDS)
def test_on_a_driven_wire_h_is_conserved_and_the_drive_does_work(seed):
    """T = T_2 + T_0 (+ T_1): dh/dt = 0 and d(T + V)/dt is the power of the drive."""
    source = random.Random(seed)
    shape = source.choice(["r^2", "(1 + r^2)", "sin(r)^2", "(2 + cos(r))"])
    mixed = source.choice(["", f" + m*w*r'*{source.choice(['r', 'cos(r)'])}"])
    text = f"coordinates: [r]\nparameters: [m, w, k]\nT: m*(r'^2 + w^2*{shape})/2{mixed}\nV: k*r^4"
    sentences = said(text, "The energy")
    assert "h, Jacobi's integral, is conserved." in sentences
    assert (
        "is not conserved unless w = 0: the prescribed motion does work on the system" in sentences
    )
    energy = derive(text).energy
    assert energy.conserved
    at = {name: source.uniform(0.3, 0.9) for name in ("m", "w", "k", "r", "r'")}
    system = energy.dynamics.system
    at["r''"] = number(energy.dynamics.motion.accelerations[0], at)
    expected = number(system.total_derivative(system.T + system.V), at)
    assert number(energy.total_rate, at) == pytest.approx(expected)


def test_a_free_particle_in_a_turning_frame_conserves_both():
    """T is the kinetic energy of an inertial frame, h = T - w L_z."""
    text = "coordinates: [x, y]\nparameters: [m, w]\nT: m*((x' - w*y)^2 + (y' + w*x)^2)/2\n"
    for V, total in (("0", "T"), ("m*(x^2 + y^2)", "T + V")):
        told = said(f"{text}V: {V}\n", "The energy")
        assert f"so h does not equal {total} unless w = 0." in told
        assert f". {total} is conserved as well." in told


def test_a_relativistic_particle_has_no_drive():
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, c: {assume: positive}, k: {}}\n"
        "T: -m*c^2*sqrt(1 - x'^2/c^2)\nV: k*x^2/2\n"
    )
    sentences = said(text, "The energy")
    assert "h, Jacobi's integral, is conserved." in sentences
    assert "prescribed" not in sentences


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_a_magnetic_potential_drops_out_of_h(seed):
    source = random.Random(seed)
    A = [source.choice(["x", "y", "x*y", "y^2", "sin(x)"]) for _ in range(2)]
    text = (
        "coordinates: [x, y]\nparameters: [m, q, k]\nT: m*(x'^2 + y'^2)/2\n"
        f"V: k*x^2 - q*(({A[0]})*x' + ({A[1]})*y')\n"
    )
    energy = derive(text).energy
    assert energy.conserved
    system = energy.dynamics.system
    assert (energy.function - system.T - energy.static_potential).expand() == 0
    assert "drop out: h equals T plus the rest of V." in said(text, "The energy")


# -- contacts -------------------------------------------------------------------------------------


def pushed(system, gap, e, at):
    """Velocities after an impact, M (v+ - v-) = P dg/dq with dg/dt+ = -e dg/dt-, and M^-1 dg/dq."""
    mass = [[m.diff(v) for v in system.qdot] for m in (system.L.diff(v) for v in system.qdot)]
    n = len(system.q)
    M = [[number(entry, at) for entry in row] for row in mass]
    g = [number(gap.diff(q), at) for q in system.q]
    rate = sum(g[i] * at[system.qdot[i].name] for i in range(n)) + number(gap.diff(system.t), at)
    det = M[0][0] * M[1][1] - M[0][1] * M[1][0]
    push = [(M[1][1] * g[0] - M[0][1] * g[1]) / det, (M[0][0] * g[1] - M[1][0] * g[0]) / det]
    impulse = -(1 + e) * rate / sum(g[i] * push[i] for i in range(n))
    after = {system.qdot[i].name: at[system.qdot[i].name] + impulse * push[i] for i in range(n)}
    return {**at, **after}, {system.qdot[i].name: push[i] for i in range(n)}


GAPS = ("y", "x + 2*y", "1 - x^2 - y^2", "y - sin(t)", "x - y + t")
CHANGES = ("x: 1", "x: -2, y: 1", "x: -y, y: x", "t: 1", "x: 1, y: 1", "t: 1, x: -1")


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("e", ["1/2", "1", "e"])
def test_what_a_contact_changes_is_constant_without_it(gap, e):
    """Each charge before and after an impact, and its rate while the contact is closed."""
    listed = "".join(f"  s{k}: {{{change}}}\n" for k, change in enumerate(CHANGES))
    derivation = derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, e: {assume: positive}}\n"
        f"T: m*(x'^2 + y'^2)/2\ncontacts:\n  wall: {{gap: '{gap} >= 0', restitution: {e}}}\n"
        f"symmetries:\n{listed}"
    )
    system = derivation.system
    source = random.Random(gap)
    for charge in derivation.noether.charges:
        at = {name: source.uniform(0.3, 0.9) for name in ("x", "y", "x'", "y'", "m", "t", "e")}
        wall = system.build(system.problem.contacts[0].equation.left)
        wall -= system.build(system.problem.contacts[0].equation.right)
        restitution = {"1/2": 0.5, "1": 1.0, "e": at["e"]}[e]
        after, push = pushed(system, wall, restitution, at)
        same = abs(number(charge.charge, after) - number(charge.charge, at)) < 1e-9
        closed, _ = pushed(system, wall, 0, at)  # dg/dt = 0
        faster = {name: v + 1e-3 * push.get(name, 0) for name, v in closed.items()}
        slower = {name: v - 1e-3 * push.get(name, 0) for name, v in closed.items()}
        kept = abs(number(charge.charge, faster) - number(charge.charge, slower)) < 1e-9
        change = charge.transformation
        when = when_constant(system, change.changes, change.time, charge.gauge)
        apart = "between impacts" if kept else "while the gap is open"
        assert when == ("" if same and kept else apart), charge.name


def test_contacts_are_named_and_what_follows_is_limited_to_between_impacts():
    text = (
        "coordinates: [x, y]\nparameters: [m, g, e]\nT: m*(x'^2 + y'^2)/2\nV: m*g*y\n"
        "contacts:\n  floor: {gap: y >= 0, restitution: e}\n"
    )
    system = said(text, "The system")
    assert "No constraint is stated: the system has two degrees of freedom." in system
    assert "One contact acts only while its gap is 0" in system
    assert "What follows holds between impacts, while the gap is open." in system
    assert "h is conserved between impacts." in said(text, "The energy")
    assert derive(text).energy.reason.startswith("conserved between impacts: ")
    assert "impacts" not in said(text, "Conserved quantities")  # p_x
    shaken = text.replace("y >= 0", "y >= sin(t)")  # it carries what lies on it
    assert "h is conserved while the gap is open." in said(shaken, "The energy")


@pytest.mark.parametrize("count", [1, 2])
def test_cyclic_coordinates_and_their_momenta_are_said_in_their_number(count):
    """Circular orbits, and those of two bodies without a force between them."""
    bodies = "ab"[:count]
    radii = ", ".join(f"r{b}: {{assume: positive}}, f{b}: {{}}" for b in bodies)
    kinetic = " + ".join(f"r{b}'^2 + r{b}^2*f{b}'^2" for b in bodies)
    potential = " + ".join(f"k*r{b}^2/2" for b in bodies)
    text = (
        f"coordinates: {{{radii}}}\nparameters: {{k: {{assume: positive}}}}\n"
        f"T: ({kinetic})/2\nV: {potential}\n"
    )
    several = "" if count == 1 else "s"
    reduced = said(text, "The reduction", "reduction")
    velocity = "velocities" if several else "velocity"
    assert f"Solved for the {velocity} of the cyclic coordinate{several}:" in reduced
    assert f"Lagrangian of the other coordinate{several}:" in reduced
    steady = said(text, "Steady motions", "steady_motions")
    assert f"he {velocity} of the cyclic coordinate{several}" in steady
    assert "and the momentum is" in steady  # the other one is free


# -- cyclic coordinates that are kept ---------------------------------------------------------------

KEPT = (
    ("forces: {x: k}", False, "a force that is not in L acts along it"),
    ("dissipation: k*x'^2/2", False, "a force that is not in L acts along it"),
    ("forces: {y: k*x}", True, "a force that is not in L depends on it"),
    ("constraints: {c: x' = y'*z}", False, "the constraint 'c' acts along it"),
    ("constraints: {c: z' = y'*x}", True, "the constraint 'c' contains it"),
    (
        "constraints: {c: x' = y'*z}\nforces: {x: k}",
        False,
        "the constraint 'c' and a force that is not in L act along it",
    ),
    (
        "constraints: {a: x' = u'*z, b: y' = x'*v, c: u' = v'*y}",
        False,
        "the constraints 'a' and 'b' act along it",
    ),
    (
        "constraints: {a: u' = v'*cos(x), b: z' = v'*sin(x), c: y' = v'*z}",
        True,
        "the constraints 'a' and 'b' contain it",
    ),
)


@pytest.mark.long
@pytest.mark.parametrize(("acting", "conserved", "why"), KEPT)
def test_a_cyclic_coordinate_is_kept_for_a_reason(acting, conserved, why):
    text = (
        "coordinates: [x, y, z, u, v]\nparameters: [m, k]\n"
        "T: m*(x'^2 + y'^2 + z'^2 + u'^2 + v'^2)/2\n"
        f"V: k*(y^4 + z^4 + u^4 + v^4)\n{acting}\n"
    )
    section, _ = reduction(derive(text))
    assert section.irreducible["x"].why == why
    assert section.irreducible["x"].conserved is conserved
    sentences = said(text, "The reduction", "reduction")
    verdict = "is cyclic and p_x is constant, but" if conserved else "but p_x is not conserved:"
    assert verdict in sentences
    assert "No momentum eliminates a coordinate, so the Routhian is L." in sentences
    assert "No coordinate is cyclic" not in sentences


def test_a_coordinate_that_a_constraint_holds_still_is_eliminated():
    text = (
        "coordinates: [x, y, z]\nparameters: [m, k]\nT: m*(x'^2 + y'^2 + z'^2)/2\n"
        "V: k*(y^4 + z^4)\nconstraints: {c: x' = 0}\n"
    )
    section, _ = reduction(derive(text))
    assert section.irreducible == {}
    assert "eliminate x" in said(text, "The reduction", "reduction")


def test_what_the_constraints_eliminate_is_named_before_none_is_cyclic():
    text = (
        "coordinates: [x, th]\nparameters: {m: {assume: positive}, R: {assume: positive}, g: {}}\n"
        "T: m*x'^2/2 + m*R^2*th'^2/2\nV: -m*g*x\nconstraints: {rolling: x = R*th}\n"
    )
    sentences = said(text, "The reduction", "reduction")
    assert "used to eliminate" in sentences
    assert "None of the other coordinates is cyclic" in sentences
    answers = " ".join(str(lagcli.solve(lagcli.loads(text), sections=["reduction"])).split())
    assert "None of the other coordinates is cyclic: the Routhian is the Lagrangian." in answers
    assert "with the constraint put in" in said(text, "Discovered symmetries", "discovered")


# -- turning points -------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_turning_points_are_real_just_between_the_energies_named(seed):
    source = random.Random(seed)
    wave = source.choice(["cos(th)", "-cos(th)", "sin(th)", "-sin(th)"])
    shift = source.choice(["", " + a", " - 2*a"])
    derivation = derive(
        "coordinates: [th]\nparameters: {m: {assume: positive}, a: {assume: positive}}\n"
        f"T: m*th'^2/2\nV: 3*a*{wave}{shift}\n"
    )
    section, _ = reduction(derivation)
    [(lower, upper)] = section.one_freedom.turning_energies
    build = derivation.system.build
    at = {"a": source.uniform(0.5, 2)}
    bounds = [number(build(lower), at), number(build(upper), at)]
    V = Evaluator([derivation.system.V], 20)
    a, th = derivation.system.symbol_of("a"), derivation.system.symbol_of("th")
    values = [V({a: at["a"], th: k / 100})[0] for k in range(629)]
    assert float(min(values)) == pytest.approx(bounds[0], abs=1e-3)
    assert float(max(values)) == pytest.approx(bounds[1], abs=1e-3)


# -- algebras and integrability -------------------------------------------------------------------

LINE = "coordinates: [x]\nparameters: {m: {}, k: {assume: positive}}\n"
PLANE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {assume: positive}, g: {}}\n"


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "generators", "with_constants"),
    [
        # Niederer 1972: sl(2,R) with h(1) has dimension 6, with h(2) and so(2) 9
        ("coordinates: [x]\nparameters: {m: {assume: positive}}\nT: m*x'^2/2", 5, 6),
        (LINE + "T: m*x'^2/2\nV: m*k^2*x^2/2", 5, 6),
        (PLANE + "T: m*(x'^2 + y'^2)/2", 8, 9),
        # Levy-Leblond 1971: {p, boost} = m extends Galilei in one dimension to four
        (PLANE + "functions: {U: [d]}\nT: m*(x'^2 + y'^2)/2\nV: U(x - y)", 3, 4),
    ],
)  # fmt: skip
def test_constants_among_the_brackets_belong_to_the_algebra(text, generators, with_constants):
    [found] = Statements(derive(text)).answers(["algebra"]).sections.values()
    assert found.dimension == generators
    assert found.name.endswith(", modulo constants")
    sentences = said(text, ALGEBRA, "algebra")
    assert f"dimension {generators} modulo constants and {with_constants} with them" in sentences


@pytest.mark.long
def test_an_algebra_without_constants_is_not_extended():
    text = PLANE + "T: m*(x'^2 + y'^2)/2\nV: -k/sqrt(x^2 + y^2)"
    assert "constants" not in said(text, ALGEBRA, "algebra").partition("functionally")[0]


SEPARATING = (
    # quartic in x + y and x - y: no symmetry but the energy in the plane of x and y
    ("x", "y", "k*(x^4 + x^3) + g*y^4"),
    ("r", "phi", "k*r^3 + g*(2 + cos(phi))/r^2"),
    ("u", "v", "k*u^6 + exp(v)*g"),
)


@pytest.mark.long
@pytest.mark.parametrize(("one", "two", "potential"), SEPARATING)
def test_what_separates_is_integrable(one, two, potential):
    """n constants of a complete integral are in involution (Arnold, section 47)."""
    inertia = f"{one}'^2 + {one}^2*{two}'^2" if one == "r" else f"{one}'^2 + {two}'^2"
    text = (
        f"coordinates: {{{one}: {{assume: positive}}, {two}: {{}}}}\n"
        f"parameters: {{m: {{assume: positive}}, k: {{}}, g: {{}}}}\nT: m*({inertia})/2\n"
        f"V: {potential}"
    )
    [found] = Statements(derive(text)).answers(["algebra"]).sections.values()
    assert found.integrable is True
    assert "it is integrable" in (sentences := said(text, ALGEBRA, "algebra")) or (
        "the motion is integrable by quadratures (Liouville)." in sentences
    )


@pytest.mark.long
def test_a_cubic_charge_of_the_file_counts():
    """Holt 1982: V = 3 x^(4/3)/4 + ... has a cubic one; here Toda's three particles, Hénon 1974."""
    text = (
        "coordinates: [x, y, z]\nT: (x'^2 + y'^2 + z'^2)/2\n"
        "V: exp(x - y) + exp(y - z) + exp(z - x)\n"
    )
    cubic = (
        "symmetries:\n  henon: {x: y'*z' - exp(y - z), y: x'*z' - exp(z - x), "
        "z: x'*y' - exp(x - y)}\n"
    )
    [without] = Statements(derive(text)).answers(["algebra"]).sections.values()
    assert without.integrable is True  # the search finds the integral of third degree itself
    derivation = derive(text + cubic)
    assert derivation.noether.charges[0].conserved is True
    [found] = Statements(derivation).answers(["algebra"]).sections.values()
    assert found.in_involution == 3
    assert found.integrable is True


@pytest.mark.long
def test_henon_and_heiles_at_a_general_value_is_not_decided():
    text = PLANE + "T: m*(x'^2 + y'^2)/2\nV: k*(x^2 + y^2)/2 + x^2*y - y^3/3"
    assert "which does not decide it." in said(text, ALGEBRA, "algebra")


@pytest.mark.parametrize(("factor", "at"), [("q*B", "B = … or q = …"), ("B", "B = …")])
def test_special_values_with_the_same_symmetries_are_named_together(factor, at):
    """Of a charge without field, and of a field without charge, a free particle is left."""
    names = ", ".join(f"{name}: {{}}" for name in ("q", "B") if name in factor)
    text = (
        f"coordinates: [x, y, z]\nparameters: {{m: {{assume: positive}}, {names}}}\n"
        f"L: m*(x'^2 + y'^2 + z'^2)/2 + {factor}*x*y'"
    )
    told = said(text, ALGEBRA, "algebra")
    assert told.count("the same search finds") == 1
    assert f"For {at} the same search finds" in told


@pytest.mark.long
def test_special_values_are_symmetric_in_three_frequencies():
    text = (
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, a: {assume: positive}, "
        "b: {assume: positive}, c: {assume: positive}}\nT: m*(x'^2 + y'^2 + z'^2)/2\n"
        "V: a*x^2/2 + b*y^2/2 + c*z^2/2\n"
    )
    special = derive(text).special_cases
    assert {frozenset((case.parameter.name, str(case.value))) for case in special} >= {
        frozenset("ab"), frozenset("ac"), frozenset("bc"),
    }  # fmt: skip


# -- what a textbook adds ---------------------------------------------------------------------------


def runge_kutta(acceleration, x, v, until, steps):
    h = until / steps
    for k in range(steps):
        t = k * h
        a1 = acceleration(x, t)
        a2 = acceleration(x + h * v / 2, t + h / 2)
        a3 = acceleration(x + h * v / 2 + h * h * a1 / 4, t + h / 2)
        a4 = acceleration(x + h * v + h * h * a2 / 2, t + h)
        x, v = x + h * v + h * h * (a1 + a2 + a3) / 6, v + h * (a1 + 2 * a2 + 2 * a3 + a4) / 6
    return x, v


@pytest.mark.parametrize("seed", SEEDS)
def test_the_averaged_potential_moves_the_average(seed):
    """Landau and Lifshitz, section 30: X = q - F1 cos(w t)/(M w^2) follows V_eff."""
    source = random.Random(seed)
    shape = source.choice(["x^3/3", "sin(x)", "x^2/2", "cos(x)"])
    strength = source.choice([30, 40])
    text = (
        "coordinates: [x]\nparameters: {w: {assume: positive}}\n"
        f"T: x'^2/2\nV: x^4/4 - {strength}*({shape})*cos(w*t)\n"
    )
    dynamics = derive(text).dynamics
    found = averaged(dynamics)
    x = dynamics.system.q[0]
    w = 60.0
    fixed = dict.fromkeys(dynamics.system.parameters, w)
    slow = sympy.lambdify(x, -found.potential.diff(x).subs(fixed), "math")
    force = sympy.lambdify((x, dynamics.system.t), dynamics.lagrange.forcing[0].subs(fixed), "math")
    start = 0.7
    until = 30 * 2 * math.pi / w
    shake = force(start, 0.0) - force(start, math.pi / (2 * w))
    moved, _ = runge_kutta(force, start - shake / w**2, 0.0, until, 6000)
    shake = force(moved, 0.0) - force(moved, math.pi / (2 * w))
    expected, _ = runge_kutta(lambda q, _: slow(q), start, 0.0, until, 2000)
    without, _ = runge_kutta(lambda q, _: -(q**3), start, 0.0, until, 2000)
    assert abs(moved + shake / w**2 - expected) < 0.15 * max(abs(without - expected), 0.02)


@pytest.mark.parametrize(
    "potential", ["-x*cos(w*t)*cos(2*w*t)", "k*x'*x*t", "-x*cos(w*t + x)", "k*x^2*t"]
)
def test_no_average_is_claimed_of_other_forces(potential):
    text = f"coordinates: [x]\nparameters: {{w: {{assume: positive}}, k: {{}}}}\nT: x'^2/2\nV: {potential}"
    assert averaged(derive(text).dynamics) is None


@pytest.mark.parametrize("also", [("equilibria", "reduction"), ("reduction",), ("equilibria",)])
def test_the_averaged_potential_is_stated_once(also):
    text = (
        "coordinates: [theta]\nparameters: {g: {assume: positive}, a: {assume: positive}, "
        "w: {assume: positive}}\n"
        "points: {bob: {position: [sin(theta), a*cos(w*t) - cos(theta)], mass: 1}}\n"
        "V: -g*cos(theta)\n"
    )
    explanation = explain(derive(text), also)
    titles = {"equilibria": "Equilibria", "reduction": "The reduction"}
    steps = " ".join(words(explanation, titles[name]) for name in also)
    assert steps.count("averaged over its period has the potential") == 1


@pytest.mark.long
def test_a_body_slips_before_it_leaves():
    """F = m g sin(theta)/3 and N = m (g cos(theta) - (R + a) theta'^2): |F|/N has no bound."""
    text = (
        "coordinates: {r: {assume: positive}, theta: {}, psi: {}}\n"
        "parameters: {m: {assume: positive, value: 1}, g: {assume: positive, value: 10},\n"
        "  R: {assume: positive, value: 1}, a: {assume: positive, value: 0.3}}\n"
        "points:\n  axis: {position: [r*sin(theta), r*cos(theta)]}\n"
        "T: m*(r'^2 + r^2*theta'^2)/2 + m*a^2*psi'^2/4\nV: m*g*r*cos(theta)\nconstraints:\n"
        "  contact: {equation: r = R + a, multiplier: N, holds_while: N >= 0}\n"
        "  rolling: {equation: (R + a)*theta = a*psi, acts_as: friction}\n"
    )
    assert "slipping begins before the contact is lost" in said(text, "Forces", "forces")


@pytest.mark.long
def test_a_string_pulls_and_a_rod_pushes_too():
    text = (
        "coordinates: {{x: {{}}, y: {{}}}}\nparameters: {{m: {{assume: positive}}, g: {{}}, "
        "l: {{assume: positive}}}}\npoints: {{bob: {{position: [x, y], mass: m}}}}\nV: m*g*y\n"
        "constraints:\n  s: {{equation: x^2 + y^2 = l^2, acts_as: tension{}}}\n"
    )
    rod = said(text.format(""), "Forces", "forces")
    string = said(text.format(", holds_while: lambda_s <= 0"), "Forces", "forces")
    assert "a push where it is negative" in rod
    assert "push" not in string
    assert "It can only pull: it is taut while" in string


@pytest.mark.parametrize(
    ("unit", "kind"), [("m", "force"), ("rad", "torque"), (None, "generalized")]
)
def test_a_multiplier_is_called_force_or_torque_by_its_coordinate(unit, kind):
    attribute = "{}" if unit is None else f"{{unit: {unit}}}"
    text = (
        f"coordinates: {{u: {attribute}, v: {{}}}}\nparameters: [m]\nT: m*(u'^2 + v'^2)/2\n"
        "constraints: {hold: u = 0}"
    )
    assert f"equals this {kind}" in said(text, "What the multipliers mean")


@pytest.mark.long
def test_regular_precession_needs_a_large_enough_spin():
    """Goldstein, section 5.7: p_psi^2 >= 4 I1 m g l cos(theta)."""
    text = (
        "coordinates: {phi: {}, theta: {}, psi: {}}\nparameters: {A: {assume: positive}, "
        "C: {assume: positive}, k: {assume: positive}}\n"
        "T: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2\n"
        "V: k*cos(theta)\n"
    )
    explanation = explain(derive(text), ["steady_motions"])
    [parts] = [
        block.parts
        for step in explanation.steps
        for block in step.blocks
        if isinstance(block, Paragraph) and Name("p_psi") in block.parts
        and any("quadratic equation" in str(part) for part in block.parts)
    ]  # fmt: skip
    shown = [to_grammar(part) for part in parts if not isinstance(part, str)]
    assert shown == ["p_psi", "cos(theta)", "phi'", "p_psi^2", "4*A*k*cos(theta)"]


@pytest.mark.long
@pytest.mark.parametrize("c", ["1/2", "2", "5"])
def test_the_roots_of_a_damped_oscillator(c):
    """s = -c/2m +- i sqrt(k/m - c^2/4m^2) put into m s^2 + c s + k."""
    text = (
        f"coordinates: [x]\nparameters: {{m: {{assume: positive}}, k: {{assume: positive}}, "
        f"c: {{assume: positive}}}}\nT: m*x'^2/2\nV: k*x^2/2\ndissipation: ({c})*c*x'^2/2\n"
    )
    shown = {row.left: row.right for row in rows(explain(derive(text), ["modes"]))}
    at = {"m": 1.3, "k": 0.9, "c": 0.4}
    build = derive(text).system.build
    delta, omega = (
        complex(x.subs({s: at[s.name] for s in x.free_symbols}))
        for x in (build(shown[Name("delta")]), build(shown[Name("omega")]))
    )
    s = -delta + 1j * omega
    damping = float(sympy.Rational(c)) * at["c"]
    assert abs(at["m"] * s * s + damping * s + at["k"]) < 1e-12
    assert "critical damping" in said(text, "Small oscillations", "modes")


def test_several_damped_coordinates_have_their_polynomial():
    text = (
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "c: {assume: positive}}\nT: m*(x'^2 + y'^2)/2\nV: k*(x^2 + (x - y)^2)/2\n"
        "dissipation: c*y'^2/2\n"
    )
    explanation = explain(derive(text), ["modes"])
    last = rows(explanation, "Small oscillations")[-1]
    build = derive(text).system.build
    build.names["s"] = sympy.Symbol("s")
    shown = build(last.right)
    m, k, c = (derive(text).system.symbol_of(n) for n in "mkc")
    s = sympy.Symbol("s")
    determinant = sympy.Matrix([[m * s**2 + 2 * k, -k], [-k, m * s**2 + c * s + k]]).det()
    assert sympy.expand(shown - determinant) == 0


@pytest.mark.parametrize(
    ("k", "only"),
    [("", " in general a uniform drift"), ("{assume: positive}", " a uniform drift")],
)
def test_a_charge_beside_a_hill_drifts_where_0_is_a_simple_root(k, only):
    """s² (s² + k + b²): at k = -b² displacements grow in proportion to t³."""
    text = (
        f"{{coordinates: [x, y], parameters: {{b: , k: {k}}}, "
        "L: (x'^2 + y'^2)/2 + b*(x*y' - y*x')/2 - k*y^2/2}"
    )
    told = said(text, "Small oscillations", "modes")
    assert f"To first order this is not an oscillation but{only}." in told


def test_a_frequency_0_is_a_drift():
    text = PLANE + "T: m*(x'^2 + y'^2)/2\nV: k*(x - y)^2/2"
    assert "not an oscillation but a uniform drift" in said(text, "Small oscillations", "modes")


@pytest.mark.long
def test_a_period_has_no_correction_that_is_0_on_its_branch():
    """The isotropic oscillator in polar coordinates: T = pi/w for every amplitude."""
    text = (
        "coordinates: {r: {assume: positive}, phi: {}}\n"
        "parameters: {m: {assume: positive}, w: {assume: positive}}\n"
        "T: m*(r'^2 + r^2*phi'^2)/2\nV: m*w^2*r^2/2\n"
    )
    section, _ = reduction(derive(text))
    [oscillation] = section.one_freedom.periods
    assert to_grammar(oscillation.period) == "pi/w"
    assert oscillation.amplitude == ""


@pytest.mark.parametrize("seed", range(12))
def test_the_order_of_three_is_what_the_sign_of_a_product_says(seed):
    """(A - B) (A - C) > 0 just where A is not between the others (Goldstein, section 5.6)."""
    source = random.Random(seed)
    symbols = [symbol(name, "positive") for name in ("A", "B", "C")]
    source.shuffle(symbols)
    A, B, C = symbols
    expression = source.choice([(A - B) * (A - C), (A - B) * (C - A), (B - A) * (C - A)])
    for inequality in (conditions([expression], ("A", "B", "C")), opposites([expression], "ABC")):
        *_, name, place = in_words(inequality)
        values = {s: source.uniform(1, 3) for s in symbols}
        at = {s.name: value for s, value in values.items()}
        holds = bool(expression.xreplace(values) > 0)
        if inequality == opposites([expression], "ABC"):
            holds = not holds
        middle = sorted(at.values())[1] == at[name.name]
        assert name.name == A.name
        assert holds is (middle if "between" in place else not middle)


@pytest.mark.long
def test_the_frequency_has_a_letter_of_its_own():
    """A hoop that turns with omega: its bead does not oscillate with omega^2 = omega^2 - ..."""
    text = (
        "coordinates: [th]\nparameters: {m: {assume: positive}, omega: {assume: positive}, "
        "g: {assume: positive}}\nT: m*(th'^2 + omega^2*sin(th)^2)/2\nV: -m*g*cos(th)\n"
    )
    answers = Statements(derive(text)).answers(["modes", "steady_motions"])
    printed = render([answers], Options())
    assert "ω_sys² = " in printed
    assert not re.search(r"ω²\s*=", printed)
    explanation = explain(derive(text), ["modes", "steady_motions"])
    explained = explaining.render([explanation], "text", Options())
    assert "ω_sys² = " in explained
    assert not re.search(r"ω²\s*=", explained)


@pytest.mark.long
def test_a_search_that_left_something_out_does_not_say_that_there_is_nothing():
    """x + F(t): the translation by cos(w t) has the gauge of an integral over F."""
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        "functions: {F: [t]}\nT: m*x'^2/2\nV: k*x^2/2 - x*F(t)\n"
    )
    derivation = derive(text)
    assert bool(derivation.discovery.stopped) is (not derivation.discovery.charges)
    assert "there is no symmetry" not in said(text, "Discovered symmetries", "discovered")


@pytest.mark.long
@pytest.mark.parametrize("back", ["(x' + a*s*b')*s = (y' - a*c*b')*c", "(x' - a*s*b')*s = y'*c"])
def test_two_skates_on_a_rod_do_not_only_rest(back):
    """With both blades along the rod it runs straight on: what is listed is not all."""
    back = back.replace("*s", "*sin(b)").replace("*c", "*cos(b)")
    text = (
        "coordinates: [x, y, b, d]\nparameters: {a: {assume: positive}}\n"
        "T: (x'^2 + y'^2 + b'^2 + d'^2)/2\n"
        f"constraints: {{front: x'*sin(d) = y'*cos(d), back: {back}}}\n"
    )
    told = words(explain(derive(text), ["equilibria", "modes", "steady_motions"]), "Steady motions")
    assert "the steady motions are the equilibria" not in told
    assert "There may be others." in told


@pytest.mark.parametrize("n", random.Random(32).sample(range(1, 9), 2))
@pytest.mark.parametrize(("constraint", "glides"), [("x*x' + y*y'", False), ("x*y' - y*x'", True)])
def test_on_surfaces_of_velocity_constraints_all_that_is_steady_is_known(constraint, glides, n):
    """A bob rests below or above its pivot; along a level ray it glides, and that is not listed."""
    text = (
        f"{{coordinates: [x, y], T: {n}*(x'^2 + y'^2), V: y, constraints: {{c: {constraint} = 0}}}}"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert ("There may be others." in told) is glides


def test_no_motion_is_called_steady_through_an_impact():
    text = (
        "{coordinates: [q, s], parameters: {e: {assume: positive}}, T: q'^2 + s'^2,"
        " contacts: {buffer: {gap: s - q, restitution: e}}}"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert "steady while the contact is open" in told


@pytest.mark.parametrize("walls", [1, 2])
def test_steady_motions_are_said_to_be_sought_without_contacts(walls):
    """At rest on a contact its force would have to be added."""
    contacts = ", ".join(f"w{k}: {{gap: x >= {-k - 1}, restitution: 0}}" for k in range(walls))
    text = f"{{coordinates: [x, y], T: x'^2 + y'^2, V: x^2 + y^4, contacts: {{{contacts}}}}}"
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    contact = "the contact is open" if walls == 1 else "the contacts are open"
    assert f"They were sought only while {contact}." in told
    assert "There may be others." not in told


@pytest.mark.long
@pytest.mark.parametrize("wheels", ["J1*phi'^2", "J1*phi'^2/2 + J1*theta'^2/2"])
def test_a_condition_that_always_holds_is_no_empty_formula(wheels):
    """A snakeboard: nothing restores, so there is no condition for a steady motion."""
    text = (
        "coordinates: [x, y, theta, psi, phi]\nparameters: {m: {assume: positive}, "
        "l: {assume: positive}, J0: {assume: positive}, J1: {assume: positive}}\n"
        f"T: m*(x'^2 + y'^2 + l^2*theta'^2 + J0*psi'^2)/2 + J0*psi'*theta' + {wheels}\n"
        "constraints:\n"
        "  back: x'*sin(theta + phi) - y'*cos(theta + phi) - l*theta'*cos(phi) = 0\n"
        "  front: x'*sin(theta - phi) - y'*cos(theta - phi) + l*theta'*cos(phi) = 0\n"
    )
    told = said(text, "Steady motions", "steady_motions")
    assert "What is left of the equations of motion vanishes." in told


@pytest.mark.parametrize("growth", ["exp(a*t)", "1 + a*t", "1"])
def test_constant_momenta_make_constant_velocities_without_the_time_only(growth):
    text = f"{{coordinates: [q, s], parameters: {{a: {{assume: positive}}}}, L: ({growth})*(q'^2 + s'^2)/2}}"
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert ("every motion is steady" in told) == (growth == "1")
    assert ("all momenta are constant" in told) == (growth != "1")


@pytest.mark.parametrize("count", [1, 2, 3])
def test_one_sided_constraints_limit_what_follows_once(count):
    names = "uvw"[:count]
    constraints = "".join(
        f"  c_{q}: {{equation: {q} = x^2, holds_while: lambda_c_{q} >= 0}}\n" for q in names
    )
    system = said(
        f"coordinates: [x, {', '.join(names)}]\nT: (x'^2 + {' + '.join(q + chr(39) + '^2' for q in names)})/2\n"
        f"V: {' + '.join(names)}\nconstraints:\n{constraints}",
        "The system",
    )
    assert system.count("is one-sided") == count
    assert system.count("What follows is valid as long as") == 1


@pytest.mark.parametrize("seed", range(4))
def test_states_in_a_periodic_potential_recur_after_its_period(seed):
    """Of harmonics of one wave, or of a tilted one: the places found are solved for in numbers."""
    source = random.Random(f"wave {seed}")
    n, tilt = source.choice((1, 2, 3)), source.choice(("", " - U*a*x/5"))
    text = (
        "coordinates: [x]\nparameters: {a: {assume: positive}, U: {assume: positive}}\n"
        f"T: x'^2/2\nV: U*cos({n}*a*x){tilt}\n"
    )
    told = words(explain(derive(text), ["equilibria"]), "Equilibria")
    told = told.replace("\N{NO-BREAK SPACE}", " ")
    ways = ("They repeat in x with the period", "All of them recur where x grows by")
    assert [told.count(each) for each in ways] in ([1, 0], [0, 1])  # and not both
    [period] = recurrences(derive(text).dynamics).values()
    assert period.subs(sympy.Symbol("a", positive=True), 1) == 2 * sympy.pi / n


@pytest.mark.parametrize(
    "V", ["cos(x)", "cos(2*x) + sin(x)", "cos(a*x) + x^2", "cos(a*x) + cos(x)"]
)
def test_whole_turns_and_what_is_not_periodic_are_not_said_to_recur(V):
    text = f"coordinates: [x]\nparameters: {{a: {{assume: positive}}}}\nT: x'^2/2\nV: {V}\n"
    assert recurrences(derive(text).dynamics) == {}


@pytest.mark.long
def test_conditions_that_fill_lines_are_put_in_words():
    """A ladder whose foot is held by a spring, with two contacts at three turning points."""
    positive = ", ".join(f"{name}: {{assume: positive}}" for name in "mglk")
    text = (
        f"coordinates: [x, y, b]\nparameters: {{{positive}}}\n"
        f"T: m*(x'^2 + y'^2)/2 + m*l^2*b'^2/24\nV: m*g*y + k*(x + l*cos(b)/2)^2/2\nconstraints:\n"
        "  wall: {equation: x = l*cos(b)/2, multiplier: N, holds_while: N >= 0}\n"
        "  floor: {equation: y = l*sin(b)/2, multiplier: F, holds_while: F >= 0}\n"
    )
    told = said(text, "The reduction", "reduction")
    assert "It depends on E whether the one-sided constraints hold there." in told


@pytest.mark.parametrize("beside", ["x*y", "2*x*y + x^2*y"])
def test_a_place_that_is_no_minimum_is_not_called_one(beside):
    """On y = 0 the wall presses by dV/dy = x + …, not at x = 0, where V has its maximum."""
    text = (
        f"coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: -x^2/2 + {beside}\nconstraints:\n"
        "  wall: {equation: y = 0, multiplier: N, holds_while: N >= 0}\n"
    )
    section, _ = reduction(derive(text))
    assert section.one_freedom.reason == (
        "V has no minimum at which its second derivative is positive"
    )


@pytest.mark.parametrize("force", ["-k*sign(x')", "-k*x'^3", "k*cos(t) - x'"])
def test_without_a_law_none_is_announced(force):
    text = (
        "coordinates: [x]\nparameters: {k: {assume: positive}}\nT: x'^2/2\n"
        f"forces: {{x: {force}}}\ninitial: {{x: 0, x': 1}}\nfind: {{far: {{where: x' = 0, for: x}}}}\n"
    )
    assert "0 on the motion:." not in (told := said(text, "Questions", "find"))
    assert "no conserved quantity is known" in told


@pytest.mark.parametrize(("w", "may_vanish"), [("", True), ("{assume: positive}", False)])
def test_charges_that_coincide_where_a_rate_vanishes_are_counted_for_other_values(w, may_vanish):
    """m r' exp(w t) - m w r exp(w t) and its twin: at w = 0 both are m r'."""
    text = f"{{coordinates: [r], parameters: {{w: {w}}}, L: r'^2/2 + w^2*r^2/2}}"
    told = said(text, "The algebra of the symmetries", "algebra")
    assert ("for general values of the parameters." in told) == may_vanish


def test_a_charge_that_vanishes_for_special_masses_is_counted_for_general_ones():
    """(m - M) x' - (m + M - 2 k) y' is 0 at m = M = k: of no coefficient the sign is known."""
    text = (
        "coordinates: [x, y]\nparameters: {m: POSITIVE, M: POSITIVE, k: POSITIVE, g: POSITIVE}\n"
        "T: k*(x'^2 + y'^2)/2\nV: g*((m + M - 2*k)*x + (m - M)*y)"
    ).replace("POSITIVE", "{assume: positive}")
    told = said(text, "The algebra of the symmetries", "algebra")
    assert "for general values of the parameters." in told
    told = said(text.replace("(m - M)", "m"), "The algebra of the symmetries", "algebra")
    assert "general values" not in told


@pytest.mark.parametrize(("force", "jumps"), [("-c*sign(x')", True), ("-c*x'", False)])
def test_static_friction_is_told_where_a_force_jumps(force, jumps):
    text = f"{{coordinates: [x], parameters: [c], T: x'^2/2, forces: {{x: {force}}}}}"
    assert ("Where a force jumps" in said(text, "The Lagrangian")) == jumps
