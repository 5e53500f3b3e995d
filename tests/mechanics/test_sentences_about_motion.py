"""What is said of oscillations, rest and steady motions: not void, once, of both sections alike."""

from __future__ import annotations

import random
from itertools import pairwise

import numpy as np
import pytest
import sympy

from lagcli.algebra.positivity import sign_of
from lagcli.document import Equations
from lagcli.expression import ZERO, factors_of
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.options import Options
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import Request, explain, render, state
from tests.marks import mostly_long

from .derived import derive
from .test_explanation import words

SEEDS = range(4)
_HAMILTON_JACOBI = "The Hamilton-Jacobi equation"
_POSITIVE = "parameters: {m: {assume: positive}, c: {assume: positive}, k: {assume: positive}}"


def answered(text, section):
    found = state(derive(text), Request(sections=(section,)))
    return render([found], "text", Options(width=200))


@pytest.mark.parametrize("seed", SEEDS)
def test_roots_that_never_oscillate_are_no_frequencies(seed):
    """(m s² + c s + k)(m s² − c s + k) = 0 in random coordinates, with an oscillator apart."""
    source = random.Random(seed)
    a, b = source.randint(1, 3), source.randint(1, 3)
    text = (
        f"coordinates: [x, y, z]\n{_POSITIVE}\n"
        f"definitions: {{u: {a}*x + {b}*y, w: x - y}}\n"
        "L: m*u'*w' + c*(u*w' - u'*w)/2 - k*u*w + m*z'^2/2 - k*z^2/2\n"
    )
    found = modes(derive(text).dynamics).modes or ()
    assert [(each.frequency is None, each.negative) for each in found] == [
        (False, False),
        (True, True),
    ]
    for _ in range(200):
        m, c, k = (10 ** source.uniform(-1, 1) for _ in range(3))
        squares = [-(s**2) for s in np.roots([m, c, k])]
        assert not any(abs(W.imag) < 1e-9 and W.real > 0 for W in squares)


def test_where_no_root_oscillates_there_are_no_modes():
    text = f"coordinates: [x, y]\n{_POSITIVE}\nL: m*x'*y' + c*(x*y' - x'*y)/2 - k*x*y\n"
    section = modes(derive(text).dynamics)
    assert section.modes == ()
    assert "real and positive" in section.reason


@pytest.mark.long
@pytest.mark.parametrize("seed", SEEDS)
def test_a_pole_has_one_verdict_at_rest_and_among_the_steady_motions(seed):
    """A charge on a sphere: inverted it is held by the magnetic field where q B² R > 4 m E."""
    source = random.Random(seed)
    a, b, c = (source.randint(1, 4) for _ in range(3))
    text = (
        "coordinates: [theta, phi]\nparameters: {E: {assume: positive}, B: {}}\n"
        f"L: {a}*(theta'^2 + sin(theta)^2*phi'^2) + {b}*B*sin(theta)^2*phi' + {c}*E*cos(theta)\n"
    )
    derivation = derive(text)
    [_, inverted] = equilibria(derivation.dynamics).equilibria
    *_, steady = steady_motions(derivation)[0].motions
    assert inverted.verdict.minimum
    assert inverted.verdict.minimum == steady.verdict.minimum
    assert inverted.verdict.unstable == steady.verdict.unstable


@pytest.mark.parametrize("n", [2, 3])
def test_conditions_that_are_opposite_are_printed_once(n):
    names = [f"a{k}" for k in range(n)]
    T = " + ".join(f"{k + 1}*{q}'^2" for k, q in enumerate(names))
    V = " + ".join(f"k*({p} - {q})^2" for p, q in pairwise(names))
    text = f"coordinates: [{', '.join(names)}]\nparameters: [k]\nT: {T}\nV: {V}\n"
    told = answered(text, "steady_motions")
    assert told.count("0 = ") == (1 if n == 2 else 3)


@pytest.mark.long
def test_what_is_said_of_several_equilibria_is_said_once():
    """Two rods of a slider-crank, in which the two branches differ in more than a sign."""
    text = (
        "coordinates: [a, b, x]\nparameters: {l: {assume: positive}, r: {assume: positive}}\n"
        "T: a'^2 + b'^2 + x'^2\nV: sin(a)\n"
        "constraints: {along: x = r*cos(a) + l*cos(b), across: r*sin(a) = l*sin(b)}\n"
    )
    told = answered(text, "equilibria")
    assert told.count("They exist where") == told.count("\n  and ") == 4
    assert "It exists" not in told


@pytest.mark.parametrize(("C", "word"), [("c", "decay"), ("-c", "grow")])
def test_the_cases_of_a_damped_and_of_a_fed_oscillator(C, word):
    """Its roots at random values, in the case that the sentence names."""
    text = f"coordinates: [x]\n{_POSITIVE}\nT: m*x'^2/2\nV: k*x^2/2\nforces: {{x: -({C})*x'}}\n"
    told = words(explain(derive(text), ["modes"]), "Small oscillations")
    weak, strong = told.index("oscillates with"), told.index("a sum of two")
    assert told[:weak].endswith("For … < … the displacement ")
    assert told[weak:strong].endswith("For … > … it is ")
    assert told.count(word) == 2
    source = random.Random(1)
    for _ in range(50):
        m, c, k = (10 ** source.uniform(-1, 1) for _ in range(3))
        roots = np.roots([m, c if C == "c" else -c, k])
        assert bool(abs(roots[0].imag) > 1e-9) is (c**2 < 4 * m * k)
        assert {bool(s.real < 0) for s in roots} == {word == "decay"}


def test_one_coordinate_has_its_equation_once_but_for_a_root():
    text = "coordinates: [x]\nL: x'^2/2 - x^2/2\n"
    assert "0 = " not in words(explain(derive(text), ["hamilton_jacobi"]), _HAMILTON_JACOBI)
    text = "coordinates: [x]\nL: -sqrt(1 - x'^2) - x^2/2\n"
    assert "without its root" in words(explain(derive(text), ["hamilton_jacobi"]), _HAMILTON_JACOBI)


def test_friction_that_is_0_at_rest_balances_nothing():
    text = (
        f"coordinates: [a, b]\n{_POSITIVE}\nT: m*(a'^2 + sin(a)^2*b'^2)/2\nV: -k*cos(a)\n"
        "dissipation: c*a'^2/2\n"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert "vanish, with the momenta" in told
    assert "balance" not in told


def test_a_cubic_momentum_leaves_a_hamilton_jacobi_equation():
    """Equal powers of roots cancel where the shape of its second derivative is sought."""
    text = (
        "coordinates: [x]\nparameters: {a: {assume: positive}, k: {assume: positive}}\n"
        "L: x'^4/4 + a*x'^2/2 - k*x^2/2\n"
    )
    assert "not quadratic in its momentum" in answered(text, "hamilton_jacobi")


FRAMES = {
    "T: a'^2 + 3*b'^2\nV: k*(a - b)^2": "ȧ = ḃ",
    "T: a'^2 + a'*b' + 3*b'^2\nV: k*(2*a - b)^4\ndissipation: c*(2*a' - b')^2": "ȧ = ḃ/2",
    "T: a'^2 + 3*b'^2\nV: k*(a - b)^2\ndissipation: c*a'^2": None,
    "T: a'^2 + (2 + cos(a - b))*b'^2\nV: k*(a - b)^2": None,
    "T: a'^2 + 3*b'^2\nV: k*(a - b)^2\nforces: {a: c*b', b: -c*a'}": None,
    "T: a'^2 + 3*b'^2\nV: k*(a^2 + b^2)": None,
}


@pytest.mark.parametrize(("text", "frame"), FRAMES.items())
def test_what_a_frame_that_moves_along_leaves_the_same(text, frame):
    told = answered(f"coordinates: [a, b]\n{_POSITIVE}\n{text}\n", "steady_motions")
    assert ("any constant" in told) is (frame is not None)
    assert frame is None or f"any constant {frame}:" in told


@pytest.mark.long
@pytest.mark.parametrize("seed", mostly_long(SEEDS, 3))
def test_a_frame_that_moves_along_may_have_constraints(seed):
    """A bob on a rod whose support slides: with u - n x alone in all, u' = n x' is any constant."""
    source = random.Random(seed)
    n, wall = source.choice([1, 2, 3]), source.choice(["c*x^2/2", "c*(u^2 + x^2)"])
    rod = f"(u - {n}*x)^2 + v^2 = c^2"
    head = f"coordinates: [x, u, v]\n{_POSITIVE}\nT: m*x'^2/2 + k*(u'^2 + v'^2)/2\n"
    for V, constraint, moves in (
        ("c*v", f'"{rod}"', True),
        (f"c*v + {wall}", f'"{rod}"', False),
        ("c*v", f'"{rod} + x"', False),
    ):
        sections = [*(["equilibria", "modes"] * moves), "steady_motions"]
        text = f"{head}V: {V}\nconstraints: {{rod: {constraint}}}\n"
        told = words(explain(derive(text), sections), "Steady motions")
        assert ("at any constant" in told) is moves, (V, constraint)
        assert (
            "momentum: in these coordinates the steady motions are the equilibria." in told
        ) <= (not moves)


@pytest.mark.parametrize("mass", ["1 + c*t", "2 + cos(t)", "exp(-t) + m"])
def test_a_mass_that_changes_makes_the_equations_depend_on_the_time(mass):
    """x = 0 rests, and nothing is proportional to exp(s t) near it."""
    text = f"coordinates: [x, y]\n{_POSITIVE}\nL: ({mass})*x'^2/2 + y'^2/2 - k*(x - y)^2/2 - y^2\n"
    derivation = derive(text)
    [rest] = equilibria(derivation.dynamics).equilibria
    assert rest.verdict.stable is None
    assert "time" in rest.verdict.reason
    assert modes(derivation.dynamics).modes == ()
    assert steady_motions(derivation)[0].motions is None


def test_a_negative_kinetic_energy_turns_about_the_maxima():
    """-L of a pendulum has its motions; U_eff has its minimum where the pendulum stands."""
    text = f"coordinates: [x]\n{_POSITIVE}\nL: -m*x'^2/2 - k*cos(x)\n"
    told = words(explain(derive(text), ["reduction"]), "The reduction")
    assert "does not turn back" not in told
    assert "has no minimum" not in answered(text, "reduction")
    told = words(
        explain(derive(text.replace("L: -m*x'^2/2 - k", "L: m*x'^2/2 + k")), ["reduction"])
    )
    assert "does not turn back" in told


@pytest.mark.parametrize("drag", ["0", "a'^2 + sin(a)^2*b'^2"])
def test_a_pole_is_no_family(drag):
    """At the pole of a sphere that turns the azimuth has no value: nothing is displaced along it."""
    text = (
        f"coordinates: [a, b]\n{_POSITIVE}\nT: m*(a'^2 + sin(a)^2*(b' + c)^2)/2\n"
        f"V: -k*cos(a)\ndissipation: {drag}\n"
    )
    found = equilibria(derive(text).dynamics).equilibria
    [pole] = [e for e in found if "b" in e.indeterminate and e.verdict.minimum]
    assert not pole.verdict.across
    assert "family" not in answered(text, "equilibria").split("a = 0:")[-1].split("a = π:")[0]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_a_sign_that_a_condition_gives_holds_where_the_condition_does(seed):
    """Random polynomials under a random condition, at random values that fulfil it."""
    source, letters = random.Random(seed), sympy.symbols("a b c d", positive=True)
    decided = 0
    for _ in range(12):
        p, q, r = (sympy.Mul(*source.sample(letters, source.randint(1, 2))) for _ in range(3))
        condition = p - source.randint(1, 3) * q
        expression = source.choice((1, -1)) * (r * condition + source.choice((1, -1)) * r * p)
        known = sign_of(sympy.expand(expression), [condition])
        for _ in range(60 if known else 0):
            values = {s: 10 ** source.uniform(-1, 1) for s in letters}
            if condition.subs(values) > 0:
                decided += 1
                assert expression.subs(values) * known > 0
    assert decided


@pytest.mark.long
def test_no_condition_is_stated_that_existence_excludes():
    """Upside down in a turning frame it exists where k l > m g, and is never a minimum there."""
    text = (
        "coordinates: {r: {assume: positive}, a: {}}\n"
        f"{_POSITIVE.replace('}}', '}, l: {assume: positive}}')}\n"
        "L: m*(r'^2 + r^2*a'^2 + c^2*r^2*sin(a)^2)/2 + m*r*cos(a) - k*(r - l)^2/2\n"
    )
    found = equilibria(derive(text).dynamics).equilibria
    upside_down = [e for e in found if to_grammar(e.at["a"]) == "pi"]
    assert [e.verdict.stable for e in upside_down] == [False]


@pytest.mark.parametrize("n", [2, 3])
def test_a_characteristic_polynomial_is_printed_in_factors(n):
    """Equal oscillators that only their differences damp: together they are free."""
    q = [f"x{j}" for j in range(n)]
    squares = " + ".join(f"{x}^2" for x in q)
    moving = squares.replace("^", "'^")
    differences = " + ".join(f"({x}' - {y}')^2" for x, y in pairwise(q))
    text = (
        f"coordinates: [{', '.join(q)}]\n{_POSITIVE}\n"
        f"T: m*({moving})/2\nV: k*({squares})/2\n"
        f"dissipation: c*({differences})/2\n"
    )
    steps = (s for s in explain(derive(text), ("modes",)).steps if s.title == "Small oscillations")
    rows = [row for s in steps for b in s.blocks if isinstance(b, Equations) for row in b.rows]
    [polynomial] = (row.right for row in rows if row.left == ZERO)
    assert "m*s^2 + k" in map(to_grammar, factors_of(polynomial))


@pytest.mark.parametrize("wall", ["x >= 0", "x >= -2"])
def test_a_contact_that_is_closed_at_the_minimum_is_not_called_a_constraint(wall):
    text = f"coordinates: [x]\nT: x'^2/2\nV: x^2/2 + x\ncontacts: {{wall: {wall}}}\n"
    found = answered(text, "reduction")
    assert ("contacts are not open" in found) == (wall == "x >= 0")
    assert "one-sided constraint does not hold" not in found


@pytest.mark.parametrize(
    ("contact", "points", "conditions"),
    [("x <= d", 2, 1), ("x >= -d", 2, 1), ("x >= d", 1, 1), ("x <= -d", 1, 1)],
)
def test_a_turning_point_that_a_stop_never_reaches_needs_no_condition(contact, points, conditions):
    """±sqrt(2 E/k) with d > 0: -sqrt(2 E/k) <= d always, and sqrt(2 E/k) <= -d never."""
    found = answered(
        f"coordinates: [x]\n{_POSITIVE.replace('c:', 'd:')}\nL: m*x'^2/2 - k*x^2/2\n"
        f"contacts: {{stop: '{contact}'}}\n",
        "reduction",
    )
    assert ("±" in found) == (points == 2)
    left_out = points == 1
    assert ("these are real and the one-sided constraint holds:" in found) == left_out
    assert found.count("one-sided constraint holds") == conditions + left_out


@pytest.mark.parametrize("n", random.Random(5).sample(range(1, 9), 2))
@pytest.mark.parametrize("mass", ["1 - cos(x)", "1 + sin(x)"])
def test_what_reaches_a_zero_of_the_inertia_is_not_said_to_go_on(n, mass):
    """On a cycloid a bead with more energy than the cusp has reaches it, at a finite speed."""
    text = f"coordinates: [x]\n{_POSITIVE}\nT: {n}*m*({mass})*x'^2\nV: -k*({mass})\n"
    told = words(explain(derive(text), ["reduction"]), "The reduction")
    assert "They are real for" in told
    assert "there is none." in told
    assert "does not turn back" not in told


@pytest.mark.parametrize("seed", range(3))
def test_rest_of_one_surface_of_an_integrable_velocity_constraint_alone_is_not_called_stable(seed):
    """On y = c the ball falls along a line of slope c: it rests at c = 0 and accelerates beside."""
    a, b = (random.Random(seed).randint(1, 9) for _ in range(2))
    text = (
        f"coordinates: [x, y, z]\n{_POSITIVE}\nT: m*(x'^2 + y'^2 + z'^2)/2\nV: {b}*m*z\n"
        f"constraints: {{c1: z' = {a}*y*x', c2: y' = 0}}\n"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria
    assert rest.verdict.stable is False  # beside c = 0 the acceleration is constant
    level = text.replace(f"{a}*y*x'", f"{a}*y*y'")  # z = a y²/2 + constant: all is level
    [rest] = equilibria(derive(level).dynamics).equilibria
    assert rest.verdict.stable is True


@pytest.mark.parametrize("drag", ["k*(a'^2 + b'^2)/2", "k*(a' - b')^2/2"])
def test_a_damped_oscillation_is_told_with_its_condition(drag):
    text = (
        f"coordinates: [a, b]\n{_POSITIVE}\nT: m*(a'^2 + b'^2)/2\nV: c*(a - b)^2/2\n"
        f"dissipation: {drag}\n"
    )
    told = words(explain(derive(text), ["modes"]), "Small oscillations")
    assert "It oscillates only where omega is real and positive." in told


def test_the_forces_of_contacts_are_not_said_to_vanish():
    text = (
        f"coordinates: [x, y]\n{_POSITIVE}\nT: m*(x'^2 + y'^2)/2\nV: k*y\n"
        "contacts: {floor: {gap: y - c >= 0, restitution: 1/2}}\n"
    )
    told = words(explain(derive(text), ["equilibria"]), "Equilibria")
    assert "Where no contact is closed, Lagrange's equations then require" in told
    assert "Where a contact is closed, it pushes, and this force is added to them." in told


@pytest.mark.parametrize("V", ["0", "c*r^2/2", "k*(r - c)^2"])
@pytest.mark.parametrize("motor", ["phi = k*t", "phi - k*t = c", "2*phi = k*t + c"])
def test_what_rests_on_a_moving_wire_is_not_called_an_equilibrium(V, motor):
    """The wire turns: nothing is at rest, but r may be constant."""
    text = (
        f"coordinates: [r, phi]\n{_POSITIVE}\nT: m*(r'^2 + r^2*phi'^2)/2\nV: {V}\n"
        f"constraints: {{motor: {motor}}}\n"
    )
    found = explain(derive(text), ["equilibria", "steady_motions"])
    assert "there is no equilibrium" in words(found, "Equilibria")
    told = words(found, "Steady motions")
    assert "equilibria" not in told
    assert "in a steady motion the coordinates that are left rest" in told


@pytest.mark.parametrize("n", random.Random(29).sample(range(1, 7), 2))
@pytest.mark.parametrize(("sided", "subject"), [
    (False, "The assumed sign of y holds there"),
    (True, "The one-sided constraint and the assumed sign of y hold there"),
])  # fmt: skip
def test_an_assumed_sign_is_not_called_a_one_sided_constraint(n, sided, subject):
    """A rod of length c with one end on a floor, its centre at y = c cos(th) >= 0."""
    while_ = ", multiplier: N, holds_while: N >= 0" if sided else ""
    text = (
        f"coordinates: {{y: {{assume: nonnegative}}, th: {{}}}}\n{_POSITIVE}\n"
        f"T: m*y'^2/2 + {n}*m*c^2*th'^2/2\nV: k*y\n"
        f"constraints: {{floor: {{equation: y = c*cos(th){while_}}}}}\n"
    )
    assert subject in words(explain(derive(text), ["reduction"]), "The reduction")


@pytest.mark.parametrize(("walls", "moving"), [("", True), ("k*x^2/2", False)])
@pytest.mark.parametrize("mass", ["m", "k"])
def test_what_a_rod_joins_moves_along_freely(walls, moving, mass):
    """Landau and Lifshitz, section 3: the laws are the same in each inertial frame."""
    text = (
        f"coordinates: [x, y, u, v]\n{_POSITIVE}\n"
        f"T: m*(x'^2 + y'^2)/2 + {mass}*(u'^2 + v'^2)/2\nV: {walls or 0}\n"
        "constraints: {rod: (x - u)^2 + (y - v)^2 = c^2}\n"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert ("at any constant x' = u'" in told) is moving
    assert "at any constant y' = v'" in told


@pytest.mark.long
def test_a_triangle_of_rods_moves_along_freely():
    text = (
        "coordinates: [a, b, c, d, e, f]\nT: (a'^2 + b'^2 + c'^2 + d'^2 + e'^2 + f'^2)/2\n"
        "constraints:\n  one: (a - c)^2 + (b - d)^2 = 1\n  two: (c - e)^2 + (d - f)^2 = 1\n"
        "  three: (e - a)^2 + (f - b)^2 = 1\n"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert "every position that the constraints allow is an equilibrium" in told
    assert "at any constant a' = c' = e'" in told
    assert "at any constant b' = d' = f'" in told


@pytest.mark.parametrize(
    ("V", "said_so"),
    [
        ("m*g*y", "It oscillates only where this is positive."),  # ω² = -g/y
        ("(a*x^2 + 2*b*x*y + c*y^2)/2", "It oscillates only where this is real and positive."),
    ],
)
def test_only_a_root_may_not_be_real(V, said_so):
    rod = "constraints: {rod: x*x' + y*y' = 0}, " if "g" in V else ""
    text = (
        "{coordinates: [x, y], parameters: {m: {assume: positive}, g: {assume: positive}, a: {}, "
        f"b: {{}}, c: {{}}}}, T: m*(x'^2 + y'^2)/2, {rod}V: {V}}}"
    )
    assert said_so in words(explain(derive(text), ("modes",)), "Small oscillations")
