"""Sentences about conditions, critical values, drives and forces, on random systems."""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli import pipeline
from lagcli.algebra import is_zero
from lagcli.algebra.signs import sign
from lagcli.document import Equations
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.inequalities import one_is_negative
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.exceptions import without_unknowns
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain
from lagcli.reader import parse_text
from lagcli.statements.wording import enumerated

from .derived import derive
from .test_explanation import words

SEEDS = range(5)
RATE = "phi'"


def said(text, title, *also):
    return words(explain(derive(text), also), title)


# -- conditions -----------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_no_condition_contradicts_where_it_exists(seed):
    """Of x (A x + B y² + …): conditions of any sign, all of which some values fulfil."""
    source = random.Random(seed)
    V = f"A*x^2/2 + B*y^2/2 + C*x^2*y + {source.randint(1, 3)}*D*y^3/3"
    text = f"coordinates: [x, y]\nparameters: [A, B, C, D]\nL: (x'^2 + y'^2)/2 - ({V})\n"
    derivation = derive(text)
    build, parameters = derivation.system.build, derivation.system.parameters
    draws = [
        {p: build_number(build, source.uniform(-2, 2)) for p in parameters} for _ in range(3000)
    ]

    def difference(each):
        return build(each.left) - build(each.right)

    def possible(*conditions):
        return any(all(difference(c).xreplace(d) > 0 for c in conditions) for d in draws)

    for state in equilibria(derivation.dynamics).equilibria:
        assert possible(*state.where)
        verdict = state.verdict
        assert verdict.minimum is None or possible(*state.where, *verdict.minimum)
        assert all(possible(*state.where, each) for each in verdict.unstable)


def build_number(build, value):
    from fractions import Fraction

    from lagcli.expression import Negative, Number

    number = Number(Fraction(abs(value)).limit_denominator(1000))
    return build(Negative(number) if value < 0 else number)


@pytest.mark.parametrize("name", ["k", "q", "charge"])
def test_the_sign_of_one_parameter_decides_a_sum(name):
    """m - 2 k/(c² r) of Weber's potential is positive where k is negative."""
    system = derive(
        f"{{coordinates: {{r: {{assume: positive}}}}, parameters: {{m: {{assume: positive}}, "
        f"c: {{assume: positive}}, {name}: }}, L: m*r'^2/2 - {name}/r*(1 + r'^2/c^2)}}"
    ).system
    m, c, k, [r] = *system.parameters, system.q
    mass = m - 2 * k / (c**2 * r)
    assert sign(mass, [-k]) == 1
    assert sign(mass, [-k / m]) == 1
    assert sign(mass, [k]) is None
    assert sign(-k, [k]) == -1


def test_squares_that_are_not_zero_are_stated_so():
    text = "coordinates: [x, y]\nparameters: [m, q, B]\nL: (x'^2 + y'^2)/2 + q*B*(x*y' - y*x')/2\n"
    sentences = said(text, "Equilibria", "equilibria")
    assert "where B ≠ 0 and q ≠ 0" in sentences.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize("factors", ["q*s", "a*q*s", "q*s*b^2"])
def test_the_sign_of_a_product_implies_that_its_factors_are_not_zero(factors):
    factors = sympy.sympify(factors.replace("^", "**"), {n: sympy.Symbol(n) for n in "abqs"})
    squares = [symbol**2 for symbol in factors.free_symbols]
    alone = conditions([-factors], "abqs")
    assert conditions([-factors, *squares], "abqs") == alone
    assert len(conditions([-factors, sympy.Symbol("p") ** 2], "abqsp")) == len(alone) + 1


# -- critical values ------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(8))
def test_at_a_critical_value_the_next_derivative_decides(seed):
    source = random.Random(seed)
    order, factor = source.choice([3, 4, 6]), source.choice([-3, -1, 2, 5])
    text = (
        f"coordinates: [x]\nparameters: [a]\n"
        f"L: x'^2*(2 + sin(x))/2 - a*x^2/2 - ({factor})*x^{order}/{order}\n"
    )
    [state] = [
        e for e in equilibria(derive(text).dynamics).equilibria if to_grammar(e.at["x"]) == "0"
    ]
    assert state.verdict.critical == (order if order % 2 == 0 and factor > 0 else -order)


@pytest.mark.parametrize("shape", ["cos(theta)", "cos(theta)^2", "sin(theta)^2", "cos(theta)^3"])
def test_where_a_product_vanishes_in_one_factor_the_other_is_not_put_to_zero(shape):
    """On a sphere with V = k f(theta): of k f'' = 0 the factor k is not 0 where a motion turns.

    Whether U_eff is constant is seen by its values where f'' vanishes at the motion.
    """
    derivation = derive(
        "coordinates: [theta, phi]\nparameters: {k: }\n"
        f"T: (theta'^2 + sin(theta)^2*phi'^2)/2\nV: k*{shape}\n"
    )
    motions = [m for m in steady_motions(derivation)[0].motions if "theta" in m.free]
    assert motions
    theta, p, k = sympy.symbols("theta p k", real=True)
    V = k * sympy.sympify(shape.replace("^", "**"), {"theta": theta})
    momentum = sympy.solve((p / (2 * sympy.sin(theta) ** 2) + V).diff(theta), p)[0]
    for place in (sympy.Rational(7, 5), sympy.pi / 3):
        known = {k: -1, p: momentum.subs({theta: place, k: -1})}
        U = (p / (2 * sympy.sin(theta) ** 2) + V).subs(known)
        assert abs(float(U.subs(theta, 1.1)) - float(U.subs(theta, 0.7))) > 1e-6  # not constant
    assert all(m.verdict.critical != 0 for m in motions)


@pytest.mark.parametrize(
    ("order", "factor", "stable"),
    [(4, 1, True), (6, 2, True), (4, -1, False), (3, 1, False), (8, 1, True), (9, 2, False),
     (12, 5, True), (20, -1, False)],
)  # fmt: skip
def test_a_potential_without_a_second_derivative(order, factor, stable):
    """Landau and Lifshitz, section 21: an oscillation that is not harmonic."""
    text = f"{{coordinates: [x], L: x'^2/2 - ({factor})*x^{order}}}"
    [state] = equilibria(derive(text).dynamics).equilibria
    assert state.verdict.stable is stable


@pytest.mark.parametrize("seed", range(3))
def test_a_momentum_that_is_critical_is_not_0(seed):
    """U_eff = p² (1 + n x² + h x⁴)/2 − c x²/2 is p² h x⁴/2 up to a constant where n p² = c > 0."""
    source = random.Random(seed)
    n, h = source.randint(1, 9), source.choice([-2, -1, 1, 3])
    motions, _ = steady_motions(
        derive(
            "coordinates: [x, psi]\nparameters: {c: {assume: positive}}\nV: -c*x^2/2\n"
            f"T: x'^2/2 + psi'^2/(2*(1 + {n}*x^2 + ({h})*x^4))\n"
        )
    )
    [there] = [m for m in motions.motions if m.at.get("x") is not None and "psi" in m.rates]
    assert to_grammar(there.at["x"]) == "0"
    assert there.verdict.critical == (4 if h > 0 else -4)


@pytest.mark.long
def test_the_sleeping_top_is_stable_at_its_critical_spin():
    """Landau and Lifshitz, section 35, problem 2; U_eff is of fourth order at equality."""
    [_, upright, _] = steady_motions(
        derive("""
coordinates: [theta, phi, psi]
parameters: {I: {assume: positive}, J: {assume: positive}, k: {assume: positive}}
T: I*(theta'^2 + phi'^2*sin(theta)^2)/2 + J*(psi' + phi'*cos(theta))^2/2
V: k*cos(theta)
""")
    )[0].motions
    assert to_grammar(upright.at["theta"]) == "0"
    assert upright.verdict.critical == 4


# -- what acts ------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_steady_motions_under_a_drive_are_those_without_the_driven_coordinate(seed):
    source = random.Random(seed)
    V = f"{source.choice([2, -3])}*k*cos(theta) + {source.choice([0, 1])}*k*cos(theta)^2"
    T = "m*(theta'^2 + (1 + sin(theta)^2)*phi'^2)/2"
    head = "parameters: {m: {assume: positive}, k: {assume: positive}, w: {assume: positive}}\n"
    driven = f"coordinates: [theta, phi]\n{head}T: {T}\nV: {V}\nconstraints: {{drive: phi' = w}}\n"
    put_in = f"coordinates: [theta]\n{head}T: {T.replace(RATE, 'w')}\nV: {V}\n"
    one, other = (steady_motions(derive(text))[0].motions for text in (driven, put_in))
    places = [{to_grammar(m.at["theta"]) for m in motions} for motions in (one, other)]
    assert places[0] == places[1]
    verdicts = [{to_grammar(m.at["theta"]): m.verdict for m in motions} for motions in (one, other)]
    for place in places[0]:
        assert {v[place].stable for v in verdicts} != {True, False}
        assert verdicts[0][place].unstable == verdicts[1][place].unstable


@pytest.mark.parametrize("factor", ["1", "2*m", "-3"])
def test_a_momentum_that_a_candidate_names_may_change(factor):
    """x is cyclic, p_x is not constant, whatever multiple of it the file lists."""
    derivation = derive(f"""
coordinates: [x, phi]
parameters: {{m: {{assume: positive}}, F: {{assume: positive}}}}
L: m*(x'^2 + phi'^2)/2
forces: {{x: -F*sin(phi)}}
symmetries: {{push: {{x: {factor}}}}}
""")
    [(conserved, why)] = [Routh(derivation).irreducible[0]]
    assert conserved is False
    assert why == "a force that is not in L acts along it"


@pytest.mark.parametrize("seed", SEEDS)
def test_forces_whose_work_a_boundary_term_balances_are_said_to_work(seed):
    source = random.Random(seed)
    n = source.choice([2, 3, 4])
    text = f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
L: m*(x'^2 + y'^2)/2
forces: {{x: -k*x^{n - 1}}}
symmetries: {{time: {{t: 1, gauge: k*x^{n}/{n}}}, across: {{y: 1}}}}
"""
    sentences = said(text, "Conserved quantities")
    assert "The work of the applied forces along it is on the motion the total time" in sentences
    assert "changes only by a boundary term" not in sentences
    assert "The applied forces do no work along this transformation." in sentences


@pytest.mark.parametrize("seed", SEEDS)
def test_a_change_that_forces_balance_is_not_called_a_boundary_term(seed):
    """L = m x'²/2 - V(x) with Q = V'(x) + F: dL = -V' is no total derivative, dL + Q is F."""
    source = random.Random(seed)
    n, a = source.choice([3, 4, 5]), source.choice([1, 2, 3])
    text = f"""
coordinates: [x]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
L: m*x'^2/2 - k*x^{n}
forces: {{x: k*{n}*x^{n - 1} + {a}*k}}
symmetries: {{shift: {{x: 1, gauge: {a}*k*t}}}}
"""
    sentences = said(text, "Conserved quantities")
    assert "Under it the action changes. Together with the work of the applied forces" in sentences
    assert "changes only by a boundary term" not in sentences


@pytest.mark.parametrize("seed", SEEDS)
def test_conditions_that_constraints_give_are_not_laid_to_the_forces(seed):
    """f(q) = 0 or a drift a q' + b(q) = 0 are conditions of rest, and not of a force."""
    source = random.Random(seed)
    c, W = source.choice([1, 2, 3]), source.choice(["W*x", "W*y"])
    rods = {
        f"y = {c}*sin(x)": True,
        f"x'*cos(z) + {c}*y'*sin(z) = 0": False,
        f"y' - {c}*x'*sin(z) = {W}": True,
    }
    for constraint, held in rods.items():
        text = f"""
coordinates: [x, y, z]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, W: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + z'^2)/2
V: m*g*x^2
constraints: {{one: "{constraint}"}}
"""
        sentences = said(text, "Equilibria", "equilibria")
        assert ("The constraint holds, and Lagrange's equations then" in sentences) is held


def test_momenta_with_a_rate_are_not_said_to_be_constant():
    """A knife edge with its centre apart (Chaplygin's sleigh): the momenta change."""
    text = """
coordinates: [x, y, f]
parameters: {m: {assume: positive}, a: {assume: positive}, J: {assume: positive}}
T: m*((x' - a*f'*sin(f))^2 + (y' + a*f'*cos(f))^2)/2 + J*f'^2/2
constraints: {blade: "y'*cos(f) = x'*sin(f)"}
"""
    sentences = said(text, "Discovered symmetries", "discovered")
    assert "of each Q below without a rate Q' is 0 on the motion" in sentences


@pytest.mark.parametrize(("constraint", "quick"), [
    ("x*sin(f) = y*cos(f)", False), ("x'*sin(f) = y'*cos(f)", True),
])  # fmt: skip
def test_the_unit_of_a_multiplier_is_that_of_its_own_constraint(constraint, quick):
    """J/m of f in metres, and of a velocity J/(m/s s): a force in both cases."""
    text = f"""
coordinates: {{x: {{unit: m}}, y: {{unit: m}}, f: {{unit: rad}}}}
parameters: {{m: {{unit: kg, assume: positive}}, J: {{unit: kg m^2, assume: positive}}}}
T: m*(x'^2 + y'^2)/2 + J*f'^2/2
constraints: {{blade: "{constraint}"}}
"""
    sentences = said(text, "Units", "dimensions")
    assert "A multiplier has that of L divided by that of its constraint" in sentences
    assert ("of one on velocities also by that of the time:" in sentences) is quick


@pytest.mark.parametrize("seed", SEEDS)
def test_integrals_are_all_only_where_they_determine_the_state(seed):
    """z = 0 twice leaves four numbers x, y, x', y'; of y'' = -4 k y³ no fourth integral is known."""
    source = random.Random(seed)
    twice = [f"{source.choice([2, 3, -1])}*z = 0", "z = 0", f"{source.choice([2, 5])}*z' = 0"]
    source.shuffle(twice)
    rows = ", ".join(f'c{k}: "{row}"' for k, row in enumerate(twice))
    for V, complete in (("k*y^4", False), ("k*y", True)):
        text = f"""
coordinates: [x, y, z]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + z'^2)/2
V: {V}
constraints: {{{rows}}}
"""
        sentences = said(text, "Discovered symmetries", "discovered")
        assert (
            "every other integral is in general a function of these" in sentences
        ) is complete, V


def test_no_integrals_are_functions_of_none():
    text = """
coordinates: [x, y]
parameters: {m: {assume: positive}, g: {assume: positive}}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {one: x = y, two: x = -y}
"""
    sentences = said(text, "Discovered symmetries", "discovered")
    assert "None is sought: the constraints prescribe the motion." in sentences
    assert "function of these" not in sentences


@pytest.mark.parametrize("seed", SEEDS)
def test_a_relation_that_several_constraints_give_together_is_told(seed):
    """a z' - b y x' = 0 twice, with c u' added to one: their difference u' = 0 is a relation."""
    source = random.Random(seed)
    a, b, c = (source.choice([-3, -2, 2, 3]) for _ in range(3))
    contact = f"({a})*z' - ({b})*y*x'"
    files = {
        f'{{one: "{contact} + ({c})*u\'", two: "{contact}"}}': True,
        f'{{one: "{contact} + ({c})*u\'"}}': False,
        f'{{one: "{contact}", two: "u\' = ({c})*y\'"}}': False,
    }
    for constraints, together in files.items():
        text = f"""
coordinates: [x, y, z, u]
parameters: {{m: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + z'^2 + u'^2)/2
constraints: {constraints}
"""
        sentences = said(text, "The system")
        told = "can be integrated to one relation between the coordinates, so that together"
        assert (told in sentences) is together, constraints
        assert "together with the others" not in sentences


@pytest.mark.parametrize("seed", SEEDS)
def test_only_what_needs_the_others_is_integrable_together_with_them(seed):
    """z' = y x' is a relation where y' = 0, which is one alone, as u' = c x' is."""
    c = random.Random(seed).choice([2, 3, 5])
    text = f"""
coordinates: [x, y, z, u]
parameters: {{m: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + z'^2 + u'^2)/2
constraints: {{one: "z' = {c}*y*x'", two: "y' = 0", three: "u' = {c}*x'"}}
"""
    sentences = said(text, "The system")
    assert sentences.count("together with the others it can be integrated") == 1
    assert "'one' is written with velocities, yet together with the others" in sentences


@pytest.mark.parametrize("names", [["x"], ["x", "y"]])
def test_where_all_is_cyclic_no_others_are_told_of(names):
    T = " + ".join(f"m*{name}'^2/2" for name in names)
    text = f"coordinates: [{', '.join(names)}]\nparameters: [m]\nT: {T}\n"
    sentences = said(text, "The model of a numerical run", "model")
    assert "cyclic: the equations of motion do not depend on" in sentences
    assert "the others does not" not in sentences


@pytest.mark.parametrize("seed", SEEDS)
def test_what_constraints_eliminate_is_not_called_cyclic(seed):
    c = random.Random(seed).choice([1, 2, 3])
    text = f"""
coordinates: [x, z]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}}}
T: m*(x'^2 + z'^2)/2
V: m*g*z
constraints: {{level: z = {c}}}
"""
    sentences = said(text, "Steady motions", "steady_motions")
    assert "Every coordinate that is left is cyclic" in sentences


@pytest.mark.parametrize(
    ("drag", "forces"),
    [
        ("dissipation: b*x'^2/2", "plus the dissipative forces:"),
        ("forces: {x: -b*x}", "plus the applied forces:"),
        ("dissipation: b*x'^2/2\nforces: {x: b}", "plus the applied forces and the dissipative"),
    ],
)
def test_the_forces_of_the_canonical_equations_are_named(drag, forces):
    text = f"coordinates: [x]\nparameters: [m, b]\nT: m*x'^2/2\n{drag}\n"
    assert forces in said(text, "Canonical equations", "canonical_equations")


@pytest.mark.parametrize("seed", range(3))
def test_a_hamiltonian_has_one_form_in_all_steps(seed):
    """H of the canonical equations, and E = H of the Hamilton-Jacobi equation."""
    source = random.Random(seed)
    mass, field = (source.choice(["m", "2*m", "a*m"]) for _ in range(2))
    radius = source.choice(["x^2 + y^2", "x^2 - y^2", "x*y"])
    text = (
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, a: {assume: positive}}\n"
        f"L: {mass}*(x'^2 + y'^2)/2 + {field}*(x*y' - y*x')/2 - a*({radius})/3\n"
    )
    steps = explain(derive(text), ("canonical_equations", "hamilton_jacobi")).steps
    rows = [
        row for s in steps for b in s.blocks if isinstance(b, Equations) for row in b.rows
        if "p_x" in str(row.right) and str(row.left) in {"H", "E"}
    ]  # fmt: skip
    assert len(rows) == 2
    assert len({str(row.right) for row in rows}) == 1


def test_integrals_with_time_are_said_to_be_of_second_degree():
    """A drive w(t) of two coordinates: quadratic ones are sought without and with the time."""
    text = """
coordinates: [x, y]
parameters: {m: {assume: positive}, k: {assume: positive}}
L: m*(x'^2 + y'^2)/2 - k*(x^2 - 2*y^2)*cos(t)
"""
    sentences = said(text, "Discovered symmetries", "discovered")
    assert "second degree in the velocities without explicit time" in sentences
    assert "also with the same functions of time in the coefficients" in sentences


def test_a_gauge_of_the_file_that_is_wrong_is_named():
    text = """
coordinates: [s]
parameters: {m: {assume: positive}, g: {assume: positive}}
L: m*s'^2/2 + m*g*s
symmetries: {fall: {s: 1, gauge: 0}}
"""
    sentences = said(text, "Conserved quantities")
    assert "Under it the action changes; the boundary term that the file gives is 0." in sentences


# -- what there is not ----------------------------------------------------------------------------


@pytest.mark.parametrize("motion", ["A*sin(w*t)", "w*t^2", "w*t"])
def test_a_prescribed_motion_is_not_called_steady(motion):
    text = f"""
coordinates: [y]
parameters: {{m: {{assume: positive}}, A: {{assume: positive}}, w: {{assume: positive}}}}
L: m*y'^2/2
constraints: {{table: "y = {motion}"}}
"""
    assert "they prescribe the motion" in said(text, "Steady motions", "steady_motions")
    assert "cyclic" not in said(text, "The reduction", "reduction")


@pytest.mark.parametrize(("force", "vanishes"), [("(a - b)*k", "a = b"), ("k*sin(c)", "… = 0")])
def test_an_equilibrium_for_special_parameters_is_not_denied(force, vanishes):
    text = f"""
coordinates: [x]
parameters: {{a: {{assume: positive}}, b: {{assume: positive}}, c: , k: {{assume: positive}}}}
L: x'^2/2 + {force}*x
"""
    sides = {vanishes, " = ".join(reversed(vanishes.split(" = ")))}
    sentences = said(text, "Equilibria", "equilibria").replace("\N{NO-BREAK SPACE}", " ")
    assert any(f"there is no equilibrium unless {side}." in sentences for side in sides)


def test_alternatives_of_which_one_always_holds_are_no_condition():
    """Bateman's oscillator: the mirror image grows for every damping."""
    text = (
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, c: {assume: positive}, "
        "k: {assume: positive}}\nL: m*x'*y' + c*(x*y' - x'*y)/2 - k*x*y\n"
    )
    assert "Unstable: a root of the characteristic" in said(text, "Equilibria", "equilibria")
    gamma, m, k = sympy.symbols("gamma m k", positive=True)
    pair = [gamma**2 - 4 * m * k, 2 * k / gamma - gamma / m]
    assert one_is_negative(pair)
    assert not one_is_negative([pair[0], -pair[1]])
    assert not one_is_negative([pair[0], 5 * m * k - gamma**2])


@pytest.mark.long
@pytest.mark.parametrize("rate", ["x'*sin(a) - y'*cos(a) = 0", "x' - y*y' = 0"])
def test_rest_everywhere_is_called_equilibrium(rate):
    text = (
        "coordinates: [x, y, a]\nparameters: {m: {assume: positive}}\n"
        f"T: m*(x'^2 + y'^2 + a'^2 + x'*a'*cos(a)/2)/2\nconstraints: {{blade: {rate}}}\n"
    )
    sentences = said(text, "Steady motions", "steady_motions")
    assert "in steady motion" not in sentences
    assert ": Steady motion 1" not in sentences


def test_a_condition_without_coordinates_has_no_other_solutions():
    text = (
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, g: {assume: positive}}\n"
        "T: m*(x'^2 + y'^2)/2\nV: m*g*y + m*x^2\n"
    )
    assert list(map(str, RestPoints(derive(text).dynamics).conditions)) == ["2*m*x"]


@pytest.mark.parametrize("seed", SEEDS)
def test_what_vanishes_with_a_parameter_in_every_condition_is_not_denied(seed):
    source = random.Random(seed)
    x, y, a, b = sympy.symbols("x y a b", real=True)
    k = sympy.Symbol("k", positive=True)
    first, second = (sympy.exp(x) * source.randint(1, 5), (1 + y**2) * k)
    assert without_unknowns([a * first, -a * b * second], [x, y]) == (a,)
    assert without_unknowns([a * first, b * second], [x, y]) == (a, b)
    assert without_unknowns([k * first, k * second], [x, y]) == ()
    assert without_unknowns([a * first, b], [x, y]) == (b,)
    assert without_unknowns([], [x, y]) == ()
    assert without_unknowns([a, first, 2 * a, k * a], [x, y]) == (a,)


def test_a_tangent_vanishes_with_its_sine_only():
    alpha, m = sympy.Symbol("alpha", real=True), sympy.Symbol("m", positive=True)
    assert without_unknowns([m * sympy.tan(alpha)], []) == (sympy.sin(alpha),)


@pytest.mark.parametrize(
    "rolling", ["x' - R*theta' = 0", "x - R*theta = 0, again: x' - R*theta' = 0"]
)
def test_a_steady_motion_for_special_parameters_is_not_denied(rolling):
    """A hoop on an incline whose angle may be 0, and it then rolls on."""
    text = (
        "coordinates: [x, theta]\nparameters: {m: {assume: positive}, R: {assume: positive}, "
        "g: {assume: positive}, alpha: {unit: rad}}\nT: m*x'^2/2 + m*R^2*theta'^2/2\n"
        f"V: -m*g*x*sin(alpha)\nconstraints: {{rolling: {rolling}}}\n"
    )
    assert "unless … = 0." in said(text, "Steady motions", "steady_motions")


@pytest.mark.parametrize("power", [4, 6])
def test_where_a_legendre_transform_folds(power):
    """Henneaux, Teitelboim, Zanelli, Phys. Rev. A 36 (1987) 4417."""
    text = f"{{coordinates: [x], L: x'^{power}/{power} - x'^2/2 - x^2/2}}"
    derivation = derive(text)
    [v] = derivation.system.qdot
    assert is_zero(derivation.hamiltonian.fold - ((power - 1) * v ** (power - 2) - 1)) is True
    assert "There is no Hamiltonian" in said(text, "Canonical equations", "canonical_equations")
    assert "The Hamiltonian is h" not in said(text, "The energy")


def test_a_kinetic_energy_without_a_sign_can_be_unstable():
    """Bateman's pair of oscillators, Phys. Rev. 38 (1931) 815: one grows as the other decays."""
    text = (
        "coordinates: [x, y]\n"
        "parameters: {m: {assume: positive}, c: {assume: positive}, k: {assume: positive}}\n"
        "L: m*x'*y' + c*(x*y' - y*x')/2 - k*x*y\n"
    )
    [state] = equilibria(derive(text).dynamics).equilibria
    assert state.verdict.stable is False
    assert not state.verdict.unstable


# -- enumerations ---------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_causes_are_enumerated_with_one_and(count):
    words = [f"cause {k}" for k in range(count)]
    text = enumerated(words)
    assert text.count(" and ") == (count > 1)
    assert text.count(", ") == max(0, count - 2)
    assert all(word in text for word in words)


@pytest.mark.long
def test_the_linear_part_of_a_drive_given_by_points_is_found():
    """r'' = w² r: five symmetries, with exp(w t) and exp(-w t), though T is that of a point."""
    text = """
coordinates: [r]
parameters: {m: {assume: positive}, w: {assume: positive}}
points: {bead: {mass: m, position: [r*cos(w*t), r*sin(w*t)]}}
"""
    assert "dimension 5 modulo constants" in said(text, "The algebra of the symmetries", "algebra")


@pytest.mark.parametrize("seed", range(3))
def test_where_a_potential_is_constant_every_position_is_an_equilibrium(seed):
    """A bead on a turning parabola: V_eff = (n g - w²) x²/2, so that n g = w² leaves no force."""
    n = random.Random(seed).randint(1, 5)
    text = (
        "coordinates: [x]\nparameters: {g: {assume: positive}, w: {assume: positive}}\n"
        f"L: (1 + {n}^2*x^2)*x'^2/2 + w^2*x^2/2 - {n}*g*x^2/2 BESIDE\n"
    )
    [level] = equilibria(derive(text.replace("BESIDE", "")).dynamics).equilibria
    assert level.verdict.critical == 0
    bent = equilibria(derive(text.replace("BESIDE", "- x^4")).dynamics).equilibria
    assert {e.verdict.critical for e in bent if to_grammar(e.at["x"]) == "0"} == {4}


@pytest.mark.parametrize("length", ["R - r", "R - 2*r", "2*R + r"])
def test_without_inertia_nothing_is_called_an_equilibrium_for_special_values(length):
    """A cylinder in a pipe of its own radius: the potential is constant, and so is T."""
    parameters = "{m: {assume: positive}, R: {assume: positive}, r: {assume: positive}}"
    energy = f"T: m*({length})^2*x'^2/2\nV: -m*({length})*cos(x)"
    found = equilibria(derive(f"coordinates: [x]\nparameters: {parameters}\n{energy}").dynamics)
    assert found.equilibria
    assert all(each.verdict.critical is None for each in found.equilibria)


@pytest.mark.parametrize("drag", ["x'*abs(x')", "x'^3", "x'*(1 + x'^2)"])
def test_a_steady_motion_is_listed_once(drag):
    section, _ = steady_motions(
        derive(f"coordinates: [x]\nparameters: [c]\nT: x'^2/2\nforces: {{x: -c*{drag}}}")
    )
    assert len(section.motions) == 1


@pytest.mark.parametrize("root", ["sqrt(R^2 - l^2/4)", "sqrt(4*R^2 - l^2)", "sqrt(R - l)"])
def test_where_the_lagrangian_is_not_real_nothing_is_said_to_be_conserved(root):
    parameters = "{R: {assume: positive}, l: {assume: positive}}"
    text = f"coordinates: [x]\nparameters: {parameters}\nT: x'^2/2\nV: -{root}*cos(x)\n"
    assert "imaginary" not in said(text, "Discovered symmetries", "discovered")


@pytest.mark.parametrize("name", ["theta", "alpha"])
def test_an_angle_that_is_an_arccosine_is_not_asked_to_be_positive(name):
    """0 ≤ arccos x ≤ π; what is asked is that it is real."""
    x, y = sympy.symbols(f"{name} y", positive=True)
    [real] = conditions([1 - (x / y) ** 2, sympy.acos(x / y)], [name, "y"])
    assert {to_grammar(real.left), to_grammar(real.right)} == {"y", name}


@pytest.mark.long
@pytest.mark.parametrize("mass", ["m*r^2", "m*(1 + r^2)"])
def test_a_cubic_momentum_is_inverted_in_real_numbers(mass):
    """p = M φ' + b φ'³: Cardano's root that is real for every p, not one of complex parts."""
    derivation = derive(
        f"{{coordinates: {{r: {{assume: positive}}, phi: }}, parameters: {{m: {{assume: positive}}}}, "
        f"L: m*r'^2/2 + {mass}*phi'^2/2 + phi'^4/4}}"
    )
    routh = Routh(derivation)
    assert routh.reduced is not None
    assert not any(v.has(sympy.I) for v in routh.velocities)


@pytest.mark.parametrize("shape", ["x*(1 + c*x)", "x + c*x^3", "x*exp(c*x)"])
def test_no_equilibrium_is_said_to_be_there_where_1_vanishes(shape):
    """k x = F(x) cos(w t) at all times: F(x) = 0 and x = 0 for no F that pushes at x = 0."""
    states = equilibria(
        derive(
            "{coordinates: [x], parameters: {k: {assume: positive}, F: {assume: positive}, "
            "w: {assume: positive}, c: {assume: positive}}, "
            f"L: x'^2/2 - k*x^2/2 + F*({shape})*cos(w*t)}}"
        ).dynamics
    )
    assert states.equilibria == ()
    assert states.unless == ()


@pytest.mark.parametrize(("drive", "rate"), [("cos", "W"), ("sin", "W"), ("sin", "2*W")])
def test_a_rapid_drive_without_equilibria_has_those_of_the_average(drive, rate):
    """Landau and Lifshitz, section 30, problem 2: cos φ = 2 g l/(a² γ²), where that is below 1."""
    explanation = explain(
        derive(
            "{coordinates: [phi], parameters: {m: {assume: positive}, g: {assume: positive}, "
            "l: {assume: positive}, a: {assume: positive}, W: {assume: positive}}, "
            f"points: {{bob: {{position: [a*{drive}({rate}*t) + l*sin(phi), -l*cos(phi)], "
            "mass: m}}, V: -m*g*l*cos(phi)}"
        ),
        ("reduction",),
    )
    [step] = (s for s in explanation.steps if s.title == "The reduction")
    found = [str(b) for b in step.blocks]
    assert sum("The averaged motion has the equilibrium" in b for b in found) == 3
    rows = [row for b in step.blocks if isinstance(b, Equations) for row in b.rows]
    inclined = next(row.right for row in rows if "acos" in str(row.right))
    bound = {"W": "2*g*l/(a^2*W^2)", "2*W": "g*l/(2*a^2*W^2)"}[rate]
    system = derive("{coordinates: [q], parameters: [g, l, a, W], L: q'^2}").system
    cosine = sympy.cos(system.build(inclined.operand))
    assert is_zero(cosine - system.build(parse_text(bound))) is True


@pytest.mark.parametrize("factor", ["1", "m", "3"])
def test_special_values_are_said_with_what_the_same_search_finds(factor):
    """V = k x^n: linear equations have five (Lutzky), k/x^2 three (de Alfaro, Fubini, Furlan)."""
    text = (
        "coordinates: {x: {assume: positive}}\n"
        "parameters: {m: {assume: positive}, k: {assume: positive}, n: {}}\n"
        f"L: m*x'^2/2 - {factor}*k*x^n\n"
    )
    told = said(text, "The algebra of the symmetries", "algebra")
    numbers = [part.split()[0] for part in told.split("the same search finds ")[1:]]
    assert sorted(set(numbers)) == ["3", "5"]
    assert told.count("symmetries, of which these are no linear combinations") == len(numbers)


@pytest.mark.parametrize("drive", ["sin(x - w*t)", "x*cos(w*t)"])
def test_special_values_are_said_where_there_is_no_symmetry_for_others(drive):
    """At w = 0 nothing depends on the time: the energy is conserved."""
    text = (
        "coordinates: {x: {}}\nparameters: {a: {assume: positive}, w: {}}\n"
        f"L: x'^2/2 + cos(x) + a*{drive}\n"
    )
    told = said(text, "The algebra of the symmetries", "algebra")
    assert "No symmetry was found" in told
    assert "For w = … the same search finds 1 symmetry:" in told


@pytest.mark.long
@pytest.mark.parametrize("offset", ["l", "2*l"])
def test_the_name_of_an_algebra_has_the_condition_under_which_its_charges_are_real(offset):
    """Of r'' = (w² − k/m) r + …: the other sign has the hyperbolic oscillator algebra.

    Beside y'' = -4 y³/m no stretching of time is left.
    """
    text = (
        "coordinates: [r, phi, y]\nparameters: {m: {assume: positive}, k: {}, w: {}, l: {}}\n"
        f"T: m*(r'^2 + r^2*phi'^2 + y'^2)/2\nV: k*(r - {offset})^2/2 + y^4\n"
        "constraints: {motor: phi = w*t}\n"
    )
    answers = pipeline.state(derive(text), pipeline.Request(sections=("algebra",)))
    [where] = answers.sections["algebra"].named_where
    assert (to_grammar(where.left), to_grammar(where.right)) == ("k", "m*w^2")
    assert "oscillator algebra where" in said(text, "The algebra of the symmetries", "algebra")


@pytest.mark.parametrize("drag", ["c*x'^2/2", "c*(x' - a')^2/2", "c*x'^2/2 + c*a'^2"])
def test_roots_without_a_closed_form_are_not_left_unsaid(drag):
    text = (
        "coordinates: [x, a]\n"
        "parameters: {M: {assume: positive}, m: {assume: positive}, g: {assume: positive},"
        " c: {assume: positive}}\n"
        "T: M*x'^2/2 + m*(x'^2 + 2*x'*a'*cos(a) + a'^2)/2\nV: -m*g*cos(a)\n"
        f"dissipation: {drag}\n"
    )
    told = said(text, "Small oscillations", "modes")
    assert "Its roots are" not in told
    assert "Among its roots are" in told
    assert "No closed form was found for the others." in told


# -- what is prescribed, and what may have any value ----------------------------------------------


@pytest.mark.parametrize("seed", SEEDS)
def test_no_symmetry_is_denied_of_a_prescribed_motion(seed):
    """As many holonomic constraints as coordinates, in random combinations."""
    source = random.Random(seed)
    n = source.randint(1, 3)
    q = ["x", "y", "z"][:n]
    rows = [
        " + ".join([f"({j + 2})*{q[j]}", *(f"{source.randint(0, 2)}*{other}" for other in q[:j])])
        for j in range(n)
    ]
    right = source.choice(["0", "t", "c*t^2", "sin(t)"])
    given = "\n".join(f"  f{j}: {row} = {right if j == 0 else 0}" for j, row in enumerate(rows))
    squares = " + ".join(f"{name}'^2" for name in q)
    V = source.choice(["0", f"m*{q[0]}", f"m*{q[-1]}^2"])
    text = f"coordinates: [{', '.join(q)}]\nparameters: [m, c]\nT: m*({squares})/2\nV: {V}\n"
    text += f"constraints:\n{given}\n"
    for title, also in (
        ("Discovered symmetries", "discovered"),
        (
            "The algebra of the symmetries",
            "algebra",
        ),
    ):
        told = said(text, title, also)
        assert told.endswith("sought: the constraints prescribe the motion.")
        assert "ansatz" not in told


@pytest.mark.parametrize("beside", [("x",), ("x", "y"), ("x", "y", "s")])
def test_of_an_upright_top_all_free_momenta_are_named(beside):
    """A top that slides on a floor, perhaps with a bead on a line: only p_phi is given."""
    names = [*beside, "phi", "psi"]
    squares = " + ".join(f"m*{q}'^2/2" for q in beside)
    text = f"""
coordinates: [{", ".join(beside)}, phi, theta, psi]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, A: {{assume: positive}},
  C: {{assume: positive}}}}
T: {squares} + A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2
V: m*g*cos(theta)
"""
    section = steady_motions(derive(text))[0]
    upright = [motion for motion in section.motions if motion.rates is None]
    assert len(upright) == 2
    for motion in upright:
        given = {name for name, p in motion.momenta.items() if to_grammar(p) != f"p_{name}"}
        assert given == {"phi"}
        assert {*motion.free} == {f"p_{name}" for name in names if name not in given}


@pytest.mark.parametrize("start", ["", "initial: {x: 1, x': 0}\n"])
@pytest.mark.parametrize("constraints", [0, 1, 2])
def test_an_answer_says_what_is_used(constraints, start):
    """Without constraints there are no multipliers, and one constraint is not several."""
    tied = "".join(f"  c{k}: {name} = {k + 2}*x\n" for k, name in enumerate("yz"[:constraints]))
    text = f"""
coordinates: [x{"".join(f", {name}" for name in "yz"[:constraints])}]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
T: m*(x'^2{"".join(f" + {name}'^2" for name in "yz"[:constraints])})/2
V: k*x^2/2
{start}find: {{speed: {{value: x'^2, in_terms_of: [x]}}}}
"""
    text += f"constraints:\n{tied}" if tied else ""
    told = said(text, "Questions", "find")
    assert "solved accelerations" in told
    assert ("multipliers" in told) == bool(constraints)
    assert ("constraint" in told) == bool(constraints)
    assert ("constraints" in told) == (constraints == 2)


@pytest.mark.parametrize("offset", ["a", "2*a", "-a"])
def test_the_coordinates_that_rest_in_a_steady_motion_are_named(offset):
    """A sled that runs straight: phi' = 0, as the accelerations depend on phi."""
    text = f"""
coordinates: [x, y, phi]
parameters: {{m: {{assume: positive}}, I: {{assume: positive}}, a: {{assume: positive}}}}
T: m*((x' - ({offset})*phi'*sin(phi))^2 + (y' + ({offset})*phi'*cos(phi))^2)/2 + I*phi'^2/2
V: 0
constraints: {{blade: "y'*cos(phi) = x'*sin(phi)"}}
"""
    told = said(text, "Steady motions", "steady_motions")
    assert told.startswith("The constraint gives y' in terms of the other velocities")
    assert "So is the coordinate that the accelerations depend on, phi." in told


@pytest.mark.parametrize(("force", "named"), [("k", False), ("k*sin(y)", True)])
def test_no_coordinate_is_said_to_rest_where_the_accelerations_depend_on_none(force, named):
    """x'' = k has no steady motion; x'' = k sin(y), y'' = 1 neither, and y is named."""
    text = (
        "{coordinates: [x, y], parameters: {k: {assume: positive}}, "
        f"T: (x'^2 + y'^2)/2, V: 0, forces: {{x: '{force}', y: 1}}}}"
    )
    told = said(text, "Steady motions", "steady_motions")
    assert told.startswith("In a steady motion the velocities are constant.")
    assert ("accelerations depend on, y." in told) is named
    assert ("depend on" in told) is named
