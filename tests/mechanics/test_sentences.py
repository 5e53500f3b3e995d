"""What is said of energy, contacts, cyclic coordinates and turning points, on random systems."""

from __future__ import annotations

import random

import pytest

from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.impacts import between_impacts
from lagcli.mechanics.reduction.statement import reduction
from lagcli.mechanics.statements import Statements
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

SEEDS = range(6)
ALGEBRA = "The algebra of the symmetries"


def said(text, title, *also):
    return words(explain(derive(text), also), title)


def number(expression, at):
    value = expression.xreplace({s: at[s.name] for s in expression.free_symbols})
    return float(value)


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
    assert "is not conserved: what keeps up the prescribed motion does work" in sentences
    energy = derive(text).energy
    assert energy.conserved
    at = {name: source.uniform(0.3, 0.9) for name in ("m", "w", "k", "r", "r'")}
    system = energy.dynamics.system
    at["r''"] = number(energy.dynamics.motion.accelerations[0], at)
    expected = number(system.total_derivative(system.T + system.V), at)
    assert number(energy.total_rate, at) == pytest.approx(expected)


def test_a_free_particle_in_a_turning_frame_conserves_both():
    """T is the kinetic energy of an inertial frame, h = T - w L_z."""
    text = "coordinates: [x, y]\nparameters: [m, w]\nT: m*((x' - w*y)^2 + (y' + w*x)^2)/2\nV: 0\n"
    assert "T + V is conserved as well." in said(text, "The energy")


def test_a_relativistic_particle_has_no_drive():
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, c: {assume: positive}, k: {}}\n"
        "T: -m*c^2*sqrt(1 - x'^2/c^2)\nV: k*x^2/2\n"
    )
    sentences = said(text, "The energy")
    assert "h, Jacobi's integral, is conserved." in sentences
    assert "prescribed" not in sentences


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


def struck(system, gap, e, at):
    """Velocities after an impact: M (v+ - v-) = P dg/dq with dg/dt+ = -e dg/dt-."""
    mass = [[m.diff(v) for v in system.qdot] for m in (system.L.diff(v) for v in system.qdot)]
    n = len(system.q)
    M = [[number(entry, at) for entry in row] for row in mass]
    g = [number(gap.diff(q), at) for q in system.q]
    rate = sum(g[i] * at[system.qdot[i].name] for i in range(n)) + number(gap.diff(system.t), at)
    det = M[0][0] * M[1][1] - M[0][1] * M[1][0]
    push = [(M[1][1] * g[0] - M[0][1] * g[1]) / det, (M[0][0] * g[1] - M[1][0] * g[0]) / det]
    impulse = -(1 + e) * rate / sum(g[i] * push[i] for i in range(n))
    after = {system.qdot[i].name: at[system.qdot[i].name] + impulse * push[i] for i in range(n)}
    return {**at, **after}


GAPS = ("y", "x + 2*y", "1 - x^2 - y^2", "y - sin(t)", "x - y + t")
CHANGES = ("x: 1", "x: -2, y: 1", "x: -y, y: x", "t: 1", "x: 1, y: 1", "t: 1, x: -1")


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("e", ["1/2", "1", "e"])
def test_what_an_impact_changes_is_constant_between_impacts(gap, e):
    """Each charge before and after an impact, computed with the impulse itself."""
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
        after = struck(system, wall, restitution, at)
        same = abs(number(charge.charge, after) - number(charge.charge, at)) < 1e-9
        change = charge.transformation
        when = between_impacts(system, change.changes, change.time, charge.gauge)
        assert when == ("" if same else "between impacts"), charge.name


def test_contacts_are_named_and_what_follows_is_limited_to_between_impacts():
    text = (
        "coordinates: [x, y]\nparameters: [m, g, e]\nT: m*(x'^2 + y'^2)/2\nV: m*g*y\n"
        "contacts:\n  floor: {gap: y >= 0, restitution: e}\n"
    )
    system = said(text, "The system")
    assert "No constraint acts on them: the system has two degrees of freedom." in system
    assert "One contact acts only while its gap is 0" in system
    assert "What follows holds between impacts, while the gap is open." in system
    assert "h is conserved between impacts." in said(text, "The energy")
    assert derive(text).energy.reason.startswith("conserved between impacts: ")
    assert "impacts" not in said(text, "Conserved quantities")  # p_x


# -- cyclic coordinates that are kept ---------------------------------------------------------------

KEPT = (
    ("forces: {x: k}", False, "a force without a potential acts along it"),
    ("dissipation: k*x'^2/2", False, "a force without a potential acts along it"),
    ("forces: {y: k*x}", True, "a force without a potential depends on it"),
    ("constraints: {c: x' = y'*z}", False, "the constraint 'c' acts along it"),
    ("constraints: {c: z' = y'*x}", True, "the constraint 'c' contains it"),
)


@pytest.mark.parametrize(("acting", "conserved", "why"), KEPT)
def test_a_cyclic_coordinate_is_kept_for_a_reason(acting, conserved, why):
    text = (
        "coordinates: [x, y, z]\nparameters: [m, k]\nT: m*(x'^2 + y'^2 + z'^2)/2\n"
        f"V: k*(y^4 + z^4)\n{acting}\n"
    )
    section, _ = reduction(derive(text))
    assert section.irreducible["x"].why == why
    assert section.irreducible["x"].conserved is conserved
    sentences = said(text, "The reduction", "reduction")
    verdict = "is cyclic and p_x is constant, but" if conserved else "but p_x is not conserved:"
    assert verdict in sentences
    assert "No coordinate is cyclic" not in sentences


def test_what_the_constraints_eliminate_is_named_before_none_is_cyclic():
    text = (
        "coordinates: [x, th]\nparameters: {m: {assume: positive}, R: {assume: positive}, g: {}}\n"
        "T: m*x'^2/2 + m*R^2*th'^2/2\nV: -m*g*x\nconstraints: {rolling: x = R*th}\n"
    )
    sentences = said(text, "The reduction", "reduction")
    assert "used to eliminate" in sentences
    assert "None of the others is cyclic" in sentences


# -- turning points -------------------------------------------------------------------------------


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


def test_an_algebra_without_constants_is_not_extended():
    text = PLANE + "T: m*(x'^2 + y'^2)/2\nV: -k/sqrt(x^2 + y^2)"
    assert "constants" not in said(text, ALGEBRA, "algebra").partition("functionally")[0]


SEPARATING = (
    # quartic in x + y and x - y: no symmetry but the energy in the plane of x and y
    ("x", "y", "k*(x^4 + x^3) + g*y^4"),
    ("r", "phi", "k*r^3 + g*(2 + cos(phi))/r^2"),
    ("u", "v", "k*u^6 + exp(v)*g"),
)


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
    assert without.integrable is None
    derivation = derive(text + cubic)
    assert derivation.noether.charges[0].conserved is True
    [found] = Statements(derivation).answers(["algebra"]).sections.values()
    assert found.in_involution == 3
    assert found.integrable is True


def test_henon_and_heiles_at_a_general_value_is_not_decided():
    text = PLANE + "T: m*(x'^2 + y'^2)/2\nV: k*(x^2 + y^2)/2 + x^2*y - y^3/3"
    assert "which does not decide it." in said(text, ALGEBRA, "algebra")


def test_special_values_are_symmetric_in_three_frequencies():
    text = (
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, a: {assume: positive}, "
        "b: {assume: positive}, c: {assume: positive}}\nT: m*(x'^2 + y'^2 + z'^2)/2\n"
        "V: a*x^2/2 + b*y^2/2 + c*z^2/2\n"
    )
    special = derive(text).discovery.special
    assert {frozenset((case.parameter.name, str(case.value))) for case in special} >= {
        frozenset("ab"), frozenset("ac"), frozenset("bc"),
    }  # fmt: skip
