"""Equilibria and normal modes against textbooks; each test's input is the YAML in it."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import sympy
from mpmath import mpf
from sympy import Expr, Matrix, acos

import lagcli
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import ZERO, Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.oscillations.normal_modes import beats
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.reader import read_problem

from .derived import derive
from .formulas import formula, formulas, normal


def dynamics(text: str) -> Dynamics:
    text = text.replace("POSITIVE", "{assume: positive}")
    return Derivation(read_problem("test.yaml", text.encode()).checked()).dynamics


def frequencies(text: str) -> list[Expr | None]:
    found = modes(dynamics(text)).modes
    assert found is not None
    return [normal(m.frequency) for m in found]


def value(tree: Expression) -> float:
    return float(evaluated(tree, {}, FUNCTIONS))


def shapes(text: str) -> list[list[Expr | None]]:
    found = modes(dynamics(text)).modes
    assert found is not None
    return [list(map(normal, m.shape.values())) for m in found if m.shape is not None]


def rest_states(text: str) -> dict[tuple[str, ...], bool | None]:
    found = equilibria(dynamics(text)).equilibria
    assert found is not None
    return {tuple(map(to_grammar, e.at.values())): e.verdict.stable for e in found}


def told(conditions) -> list[str]:
    return [f"{to_grammar(each.left)} > {to_grammar(each.right)}" for each in conditions]


HOOP = """
coordinates: {theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, w: POSITIVE}
T: m*R^2*(theta'^2 + w^2*sin(theta)^2)/2
V: -m*g*R*cos(theta)
"""


def test_the_bead_on_a_rotating_hoop_has_two_more_equilibria_when_it_turns_fast():
    """Taylor, *Classical Mechanics*, section 7.6; Goldstein, chapter 2, exercise 18."""
    assert rest_states(HOOP) == {
        ("-acos(g/(R*w^2))",): True,
        ("acos(g/(R*w^2))",): True,
        ("0",): None,  # stable where g > R w^2
        ("pi",): False,
    }
    found = equilibria(dynamics(HOOP)).equilibria
    assert found is not None
    assert [told(e.where) for e in found] == [["R*w^2 > g"], ["R*w^2 > g"], [], []]
    assert found[2].verdict.minimum is not None
    assert told(found[2].verdict.minimum) == ["g > R*w^2"]


def test_the_bead_oscillates_about_the_tilted_equilibrium():
    """Taylor, section 7.6: Omega'^2 = omega^2 - (g/(omega R))^2."""
    assert frequencies(HOOP)[0] == formula("sqrt(w^2 - g^2/(R^2*w^2))")


def test_a_turning_frame_shifts_the_frequency():
    """Landau and Lifshitz, section 39: at rest both are sqrt(k/m)."""
    text = """
coordinates: [x, y]
parameters: {m: POSITIVE, k: POSITIVE, W: POSITIVE}
L: m*((x' - W*y)^2 + (y' + W*x)^2)/2 - k*(x^2 + y^2)/2
"""
    assert set(frequencies(text)) == {*formulas("abs(W - sqrt(k/m))", "W + sqrt(k/m)")}


@pytest.mark.parametrize("angle", [0.7, 2.3])
def test_roots_of_a_sum_and_a_difference_hold_for_both_signs_of_what_they_share(angle):
    """ω = p ± q with 4 p² = W_1 + W_2 + 2 sqrt(W_1 W_2), W_1 W_2 = a² cot² c/(b d) here."""
    a, b, d = sympy.symbols("a b d", positive=True)
    c = sympy.Symbol("c", real=True)
    both = (1 + a / b) * a / d + (1 + 4 * a / b) / sympy.tan(c) ** 2
    root = sympy.sqrt(both**2 - 4 * a**2 / (b * d * sympy.tan(c) ** 2))
    squares = [sympy.expand(both - root) / 2, sympy.expand(both + root) / 2]
    pair = beats(squares, [{a: mpf("0.7"), b: mpf("1.3"), d: mpf("2.1"), c: mpf("0.7")}])
    assert pair is not None
    values = {a: 0.7, b: 1.3, d: 2.1, c: angle}
    found = [float(each.subs(values)) ** 2 for each in pair]
    assert found == pytest.approx([float(each.subs(values)) for each in squares])


@pytest.mark.long
def test_the_double_pendulum():
    """Landau and Lifshitz, section 23, problem 2, with equal masses and lengths."""
    text = """
coordinates: [a, b]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
L: m*l^2*(a'^2 + b'^2/2 + a'*b'*cos(a - b)) + m*g*l*(2*cos(a) + cos(b))
"""
    assert frequencies(text) == formulas("sqrt(g*(2 - sqrt(2))/l)", "sqrt(g*(sqrt(2) + 2)/l)")
    assert shapes(text) == [formulas("1", "sqrt(2)"), formulas("1", "-sqrt(2)")]
    assert list(rest_states(text).values()) == [True, False, False, False]


def test_a_linear_triatomic_molecule():
    """Goldstein, section 6.4; CO2 along its line."""
    text = """
coordinates: [x1, x2, x3]
parameters: {m: POSITIVE, M: POSITIVE, k: POSITIVE, b: POSITIVE}
T: (m*x1'^2 + M*x2'^2 + m*x3'^2)/2
V: k*((x2 - x1 - b)^2 + (x3 - x2 - b)^2)/2
"""
    assert frequencies(text) == formulas("0", "sqrt(k/m)", "sqrt(k*(2*m + M)/(m*M))")
    translation, symmetric, antisymmetric = shapes(text)
    assert translation == formulas("1", "1", "1")
    assert symmetric == formulas("1", "0", "-1")
    assert antisymmetric == formulas("1", "-2*m/M", "1")
    [equilibrium] = equilibria(dynamics(text)).equilibria or ()
    assert equilibrium.free == ("x3",)
    assert equilibrium.verdict.stable is True


@pytest.mark.long
def test_coupled_pendulums():
    """Taylor, section 11.3 (method)."""
    text = """
coordinates: [a, b]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, k: POSITIVE}
T: m*l^2*(a'^2 + b'^2)/2
V: -m*g*l*(cos(a) + cos(b)) + k*l^2*(sin(a) - sin(b))^2/2
"""
    assert frequencies(text) == formulas("sqrt(g/l)", "sqrt(2*k/m + g/l)")
    assert shapes(text) == [formulas("1", "1"), formulas("1", "-1")]


PENDULUM = """
coordinates: [x, y]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {rod: x^2 + y^2 = l^2}
"""


def test_the_constraint_force_bends_the_potential_of_a_cartesian_pendulum():
    assert rest_states(PENDULUM) == {("0", "l"): False, ("0", "-l"): True}
    assert frequencies(PENDULUM) == formulas("sqrt(g/l)")
    assert shapes(PENDULUM) == [formulas("1", "0")]


def test_only_an_unstable_equilibrium_has_no_real_frequency():
    text = """
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE}
T: m*x'^2/2
V: -k*x^2/2
"""
    [mode] = modes(dynamics(text)).modes or ()
    assert mode.frequency is None
    assert mode.frequency_squared is not None
    assert to_grammar(mode.frequency_squared) == "-k/m"


def test_a_double_well():
    text = """
coordinates: [x]
parameters: {m: POSITIVE, a: POSITIVE, b: POSITIVE}
T: m*x'^2/2
V: -a*x^2/2 + b*x^4/4
"""
    assert rest_states(text) == {("0",): False, ("-sqrt(a/b)",): True, ("sqrt(a/b)",): True}
    assert frequencies(text) == formulas("sqrt(2*a/m)", "sqrt(2*a/m)")


def test_the_pendulum_under_a_cart_drifts_and_swings():
    """Landau and Lifshitz, section 5, problem 2 (the Lagrangian)."""
    text = """
coordinates: [x, theta]
parameters: {M: POSITIVE, m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: M*x'^2/2 + m*(x'^2 + 2*l*x'*theta'*cos(theta) + l^2*theta'^2)/2
V: -m*g*l*cos(theta)
"""
    assert rest_states(text) == {("0",): True, ("pi",): False}
    assert frequencies(text) == formulas("0", "sqrt(g*(M + m)/(M*l))")


def test_the_foucault_pendulum_splits_its_frequency():
    """Landau and Lifshitz, section 39, problem 3: omega +- W."""
    text = """
coordinates: [x, y]
parameters: {m: POSITIVE, w: POSITIVE, W: POSITIVE}
L: m*(x'^2 + y'^2)/2 + m*W*(x*y' - y*x') - m*w^2*(x^2 + y^2)/2
"""
    assert frequencies(text) == formulas("sqrt(w^2 + W^2) - W", "sqrt(w^2 + W^2) + W")
    assert rest_states(text) == {("0", "0"): True}


def test_a_penning_trap_has_its_magnetron_and_cyclotron_frequencies():
    """Brown and Gabrielse, Rev. Mod. Phys. 58 (1986) 233, section II; real for w > sqrt(2) u."""
    text = """
coordinates: [x, y, z]
parameters: {m: POSITIVE, w: POSITIVE, u: POSITIVE}
L: m*(x'^2 + y'^2 + z'^2)/2 + m*w*(x*y' - y*x')/2 - m*u^2*(2*z^2 - x^2 - y^2)/4
"""
    expected = formulas("(w - sqrt(w^2 - 2*u^2))/2", "(w + sqrt(w^2 - 2*u^2))/2", "u")
    assert set(frequencies(text)) == set(expected)
    found = modes(dynamics(text)).modes
    assert found is not None
    assert [each.open_sign for each in found].count(True) == 2


def test_three_pendulums_have_the_roots_of_a_laguerre_polynomial():
    """L_3(W l/g) = 0 has three real roots, given by Viete's cosines."""
    text = """
coordinates: [a, b, c]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*l^2*(3*a'^2 + 2*b'^2 + c'^2 + 4*a'*b' + 2*a'*c' + 2*b'*c')/2
V: m*g*l*(3*a^2 + 2*b^2 + c^2)/2
"""
    found = frequencies(text)
    assert len(found) == 3
    assert all(f is not None and f.has(acos) for f in found)


def test_a_damped_oscillator_is_stable_and_has_its_exponents():
    """Landau and Lifshitz, section 25: exp(-c t/2m) and the root of k/m - c^2/4m^2."""
    text = """
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE, c: POSITIVE}
T: m*x'^2/2
V: k*x^2/2
dissipation: c*x'^2/2
"""
    assert rest_states(text) == {("0",): True}
    [mode] = modes(dynamics(text)).modes or ()
    assert mode.damped
    assert mode.open_sign
    assert [to_grammar(mode.decay), to_grammar(mode.frequency)] == [
        "c/(2*m)",
        "sqrt(k/m - c^2/(4*m^2))",
    ]


@pytest.mark.parametrize("seed", range(6))
def test_exponents_of_damped_systems_are_eigenvalues(seed):
    """det(K + s C + s² M) = 0 of two like oscillators that are coupled, in numbers."""
    random = Random(seed)
    m, k, c = (random.randint(1, 9) for _ in range(3))
    n, j, d = (random.randint(1, m), random.randint(0, k), random.randint(0, 20))
    text = f"""
coordinates: [x, y]
T: {2 * m}*(x'^2 + y'^2)/2 + {n}*x'*y'
V: {k}*(x^2 + y^2)/2 + {j}*(x - y)^2/2
dissipation: {c}*(x'^2 + y'^2)/2 + {d}*(x' - y')^2/2
"""
    found: list[complex] = []
    for mode in modes(dynamics(text)).modes or ():
        found += [complex(value(each)) for each in mode.exponents]
        if mode.decay is not None:
            decay, frequency = value(mode.decay), value(mode.frequency)
            found += [-decay + 1j * frequency, -decay - 1j * frequency] * mode.multiplicity
    M = np.array([[2 * m, n], [n, 2 * m]])
    K, C = (np.array([[a + b, -b], [-b, a + b]]) for a, b in ((k, j), (c, d)))
    zero, one = np.zeros((2, 2)), np.eye(2)
    inverse = np.linalg.inv(M)
    expected = np.linalg.eigvals(np.block([[zero, one], [-inverse @ K, -inverse @ C]]))
    assert len(found) == 4
    for s in found:
        assert min(abs(s - each) for each in expected) < 1e-6


def test_equal_frequencies_are_one_entry():
    text = """
coordinates: [x, y]
parameters: {m: POSITIVE, k: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: k*(x^2 + y^2)/2
"""
    [mode] = modes(dynamics(text)).modes or ()
    assert mode.multiplicity == 2


def test_a_bead_on_a_wire_with_a_spring_from_the_side():
    """Strogatz, Nonlinear Dynamics and Chaos, 2nd ed., exercise 3.5.4: rest at |x|^2 = b^2 - h^2."""
    text = """
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE, h: POSITIVE, b: POSITIVE}
T: m*x'^2/2
V: k*(sqrt(h^2 + x^2) - b)^2/2
"""
    found = equilibria(dynamics(text)).equilibria
    assert found is not None
    assert [e.verdict.reason for e in found if "other" in e.verdict.reason] == []
    aside = [e for e in found if to_grammar(e.at["x"]) != "0"]
    assert [normal(e.at["x"]) for e in aside] == formulas(
        "-sqrt((b + h)*(b - h))", "sqrt((b + h)*(b - h))"
    )
    assert [e.verdict.stable for e in aside] == [True, True]
    assert told(aside[0].where) == ["b > h"]


def test_all_shapes_of_a_multiple_frequency():
    """Three masses on a ring; Goldstein, 3rd ed., section 6.4 (method): K a = W M a."""
    text = """
coordinates: [x, y, z]
parameters: {m: POSITIVE, k: POSITIVE}
T: m*(x'^2 + y'^2 + z'^2)/2
V: k*((x - y)^2 + (y - z)^2 + (z - x)^2)/2
"""
    uniform, double = modes(dynamics(text)).modes or ()
    assert not uniform.more_shapes
    assert normal(double.frequency) == formula("sqrt(3*k/m)")
    both = [list(map(normal, shape.values())) for shape in (double.shape, *double.more_shapes)]
    assert len(both) == double.multiplicity == 2
    assert all(sum(shape) == 0 for shape in both)  # at rest in the mean
    assert Matrix(both).rank() == 2


def test_numbers_where_the_polynomial_has_no_radicals():
    text = """
coordinates: [a, b, c, d]
T: (a'^2 + 2*b'^2 + 3*c'^2 + d'^2)/2
V: (a^2 + (a - b)^2 + (b - c)^2 + (c - d)^2)/2
"""
    found = modes(dynamics(text)).modes
    assert found is not None
    assert [m.frequency is not None for m in found] == [True] * 4


@pytest.mark.parametrize("system", ["V: m*g*x", "V: m*g*x*sin(t)"])
def test_no_equilibrium_no_modes(system):
    text = f"coordinates: [x]\nparameters: {{m: POSITIVE, g: POSITIVE}}\nT: m*x'^2/2\n{system}\n"
    assert not equilibria(dynamics(text)).equilibria
    assert not modes(dynamics(text)).modes


def test_it_is_told_why_there_are_none():
    driven = dynamics("coordinates: [x]\nT: x'^2/2\nV: x^2/2\nforces: {x: cos(t)}\n")
    why = "the equations depend explicitly on the time"
    assert equilibria(driven).equilibria == ()
    assert equilibria(driven).reason == why
    assert modes(driven).modes == ()
    elsewhere = "coordinates: [x]\nparameters: {a: 1}\nT: x'^2/2\nV: x^3/3 + a*x^2/2 + a*x\n"
    absent = modes(dynamics(elsewhere))  # x^2 + a x + a = 0
    assert absent.reason.endswith("do not exist for the values of the file")
    falling = modes(dynamics("coordinates: [x]\nT: x'^2/2\nV: x\n"))
    assert (falling.modes, falling.reason) == ((), "there is no equilibrium to expand about")
    radial = modes(dynamics("coordinates: {r: POSITIVE}\nT: r'^2/2\nV: r^2\n"))
    assert radial.reason == "there is no equilibrium in these coordinates to expand about"  # r = 0
    masses = "parameters: {a: {assume: positive}, b: {assume: positive}}\n"
    balanced = modes(dynamics(f"coordinates: [x]\n{masses}T: (a + b)*x'^2/2\nV: (a - b)*x\n"))
    assert balanced.reason == "in general there is no equilibrium to expand about"  # but for a = b


def test_what_a_moving_constraint_carries_along_is_not_at_rest():
    """r = l + v t has a rate without t, and yet no state that stays."""
    paid_out = dynamics(
        "coordinates: [r, theta]\nparameters: {l: POSITIVE, v: POSITIVE}\n"
        "T: (r'^2 + r^2*theta'^2)/2\nV: -r*cos(theta)\nconstraints: {string: r = l + v*t}\n"
    )
    assert equilibria(paid_out).equilibria == ()
    assert modes(paid_out).modes == ()


@pytest.mark.parametrize(
    ("sign", "ring", "condition"),
    [("+", ("x^2 + y^2", "mu"), []), ("-", ("x^2 + y^2", "-mu"), ["0 > mu"])],
    ids=["repulsion", "attraction"],
)
def test_two_powers_of_one_distance_balance(sign, ring, condition):
    """V = -1/r + mu/(3 r^3) has its minimum on the circle r^2 = mu, and none for -mu/(3 r^3)."""
    assume = "positive" if sign == "+" else "real"
    text = f"""
coordinates: [x, y]
parameters: {{mu: {{assume: {assume}}}}}
T: (x'^2 + y'^2)/2
V: -1/sqrt(x^2 + y^2) {sign} mu/(3*(x^2 + y^2)^(3/2))
"""
    found = equilibria(dynamics(text)).equilibria
    assert found is not None
    [circle] = found
    assert tuple(map(to_grammar, circle.on)) == ring
    assert told(circle.where) == condition


def test_the_singular_centre_of_a_force_is_no_equilibrium():
    kepler = """
coordinates: [x, y]
parameters: {m: POSITIVE, k: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: -k/sqrt(x^2 + y^2)
"""
    found = equilibria(dynamics(kepler)).equilibria
    assert not found


def test_a_mass_on_a_spring_also_rests_above_it_where_the_spring_is_strong():
    """k (y - l) = -m g above the point of suspension, k (|y| - l) = m g below it."""
    states = rest_states("""
coordinates: [x, y]
parameters: {m: POSITIVE, k: POSITIVE, l: POSITIVE, g: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: k*(sqrt(x^2 + y^2) - l)^2/2 + m*g*y
""")
    assert sorted(states.values()) == [False, True]


CAR = """
coordinates: [z, theta]
parameters: {m: POSITIVE, J: POSITIVE, k1: POSITIVE, k2: POSITIVE, a: POSITIVE, b: POSITIVE}
T: m*z'^2/2 + J*theta'^2/2
V: k1*(z - a*theta)^2/2 + k2*(z + b*theta)^2/2
"""


@pytest.mark.long
def test_the_shapes_of_bounce_and_pitch_need_a_coupling():
    """Thomson, Theory of Vibration, section 5.2: uncoupled for k1 a = k2 b, where it is 0/0."""
    found = modes(dynamics(CAR)).modes
    assert [told(mode.shaped_where) for mode in found] == [["(k2*b - k1*a)^2 > 0"]] * 2
    uncoupled = modes(dynamics(CAR.replace("k2*(z + b*", "k1*(z + a*"))).modes
    assert [told(mode.shaped_where) for mode in uncoupled] == [[]] * 2
    assert len({to_grammar(mode.shape["z"]) for mode in uncoupled}) == 2


@pytest.mark.parametrize("order", ["x, s", "s, x"])
def test_a_shape_is_over_what_moves_at_every_angle(order):
    """A block on a wedge that slides: the wedge stays where the slope is vertical, not the block."""
    [_, swing] = modes(
        dynamics(f"""
coordinates: [{order}]
parameters: {{m: POSITIVE, M: POSITIVE, k: POSITIVE, alpha: }}
T: M*x'^2/2 + m*(x'^2 + s'^2 + 2*x'*s'*cos(alpha))/2
V: k*s^2/2
""")
    ).modes
    assert normal(swing.shape["s"]) == 1
    assert normal(swing.shape["x"]) == formula("-m*cos(alpha)/(m + M)")
    assert not swing.shaped_where


@pytest.mark.parametrize("seed", range(3))
def test_a_shape_has_a_value_where_it_is_said_to_have_one(seed):
    """Under a follower force, as of Ziegler's pendulum: (k ± sqrt(…))/(2 (P - 2 k))."""
    a, b, c = Random(seed).sample(range(2, 9), 3)
    derivation = derive(
        "coordinates: [x, y]\nparameters: {k: {assume: positive}, P: {assume: positive}}\n"
        f"T: ({a + c}*x'^2 + 2*{min(b, c)}*x'*y' + {c + b}*y'^2)/2\n"
        "V: k*(x^2 + (y - x)^2)/2\nforces: {x: P*(x - y)}\n"
    )
    build, found = derivation.system.build, modes(derivation.dynamics).modes
    assert found
    for mode in found:
        shape = [sympy.radsimp(build(part)) for part in mode.shape.values()]
        below = sympy.Mul(*(sympy.fraction(part)[1] for part in shape))
        [P] = [s for s in below.free_symbols if s.name == "P"]
        where = [build(each.left) - build(each.right) for each in mode.shaped_where]
        for critical in sympy.solve(below, P):
            assert any(sympy.simplify(x.subs(P, critical)) == 0 for x in where)


@pytest.mark.parametrize("name", ["chains/triple-pendulum", "steady/penning-trap"])
def test_frequencies_without_shapes_are_called_frequencies(name):
    """Roots of a cubic equation and gyroscopic modes have no shapes here, and none is missed."""
    found = lagcli.solve(name, sections=["modes"])
    assert "Angular frequencies about the equilibri" in str(found)
    assert "shapes" not in str(found)


@pytest.mark.parametrize("seed", range(6))
def test_shapes_of_damped_modes_by_construction(seed: int) -> None:
    """T, V and D are sums of squares of the same forms: each form moves by itself."""
    draw = Random(seed)
    forms = [[1, 1], [1, -1]] if seed % 2 else [[1, draw.choice([2, 3])], [draw.choice([2, 3]), -1]]
    if not seed % 2:
        forms[1][1] = -draw.choice([1, 2])
    written = [f"({a}*x{{0}} + ({b})*y{{0}})^2/2" for a, b in forms]
    primed, plain = ([w.format(mark) for w in written] for mark in ("'", ""))
    charge = draw.choice(["1/c", "k"])  # as of a capacitor, or of a spring
    drag = draw.choice(["r", "0"])
    text = f"""
coordinates: [x, y]
parameters: {{m: POSITIVE, k: POSITIVE, c: POSITIVE, r: POSITIVE}}
T: m*({primed[0]} + {primed[1]})
V: ({charge})*({plain[0]} + 3*{plain[1]})
dissipation: r*{primed[0]} + {drag}*{primed[1]}
"""
    found = modes(dynamics(text)).modes
    assert found is not None
    (a, b), (c, d) = forms
    wanted = {sympy.Rational(-a, b), sympy.Rational(-c, d)}  # one form at rest: y/x
    assert len(found) == 2
    assert all(mode.damped for mode in found)
    ratios = {normal(mode.shape["y"]) / normal(mode.shape["x"]) for mode in found}
    assert ratios == wanted


def test_modes_without_a_real_shape_have_none() -> None:
    text = """
coordinates: [x, y]
parameters: {m: POSITIVE, k: POSITIVE, r: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: k*(x^2 + y^2 + (x - y)^2)/2
dissipation: r*x'^2/2
"""
    found = modes(dynamics(text)).modes
    assert found is not None
    assert all(mode.shape is None for mode in found)


@pytest.mark.parametrize(("drag", "said"), [("r*x'^2/2", "exponents"), ("0", "")])
def test_roots_without_a_closed_form_are_said_to_be_missing(drag: str, said: str) -> None:
    text = f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}, r: {{assume: positive}}}}
T: m*x'^2/2 + m*y'^2
V: k*(x^2 + (x - y)^2)/2
dissipation: {drag}
"""
    found = lagcli.solve(lagcli.loads(text), sections=["modes"])
    assert any(f"closed form of all {said}" in each for each in found.warnings) is bool(said)


@pytest.mark.parametrize(
    "bowl", ["z = c*r^2", "z = c*r^2 + k*r^4", "z + r^2*z^2 = c*r^2", "z = c*r^2 - z^3"]
)
def test_at_the_bottom_of_a_bowl_a_charge_has_the_modes_of_the_plane(bowl):
    """z = c r² to second order: m w² ± B w - 2 m g c = 0 (Larmor; Landau and Lifshitz, Fields, 22)."""
    dynamics = derive(
        "coordinates: [r, phi, z]\n"
        "parameters: {m: {assume: positive}, g: {assume: positive}, c: {assume: positive}, "
        "B: {assume: positive}, k: {assume: positive}}\n"
        "L: m*(r'^2 + r^2*phi'^2 + z'^2)/2 - m*g*z + B*r^2*phi'/2\n"
        f"constraints: {{bowl: {bowl}}}\n"
    ).dynamics
    known = {"m": 1.3, "g": 9.7, "c": 0.6, "B": 2.1, "k": 0.4}
    found = [
        evaluated(mode.frequency, known, FUNCTIONS)
        for mode in modes(dynamics).modes
        if mode.at["r"] == ZERO and mode.at["z"] == ZERO
    ]
    root = math.sqrt(known["B"] ** 2 + 8 * known["m"] ** 2 * known["g"] * known["c"])
    expected = [(root + side * known["B"]) / (2 * known["m"]) for side in (-1, 1)]
    assert sorted(found) == pytest.approx(expected)


def test_a_constraint_that_turns_with_the_azimuth_leaves_no_regular_form():
    """z = r² (1 + cos²(phi)) has another curvature in each direction: nothing is given."""
    dynamics = derive(
        "coordinates: [r, phi, z]\nL: (r'^2 + r^2*phi'^2 + z'^2)/2 - z\n"
        "constraints: {bowl: z = r^2*(1 + cos(phi)^2)}\n"
    ).dynamics
    assert not modes(dynamics).modes


def test_an_unstable_top_on_a_smooth_floor_falls_alike_in_all_directions():
    """A th'' = m g l th: the height l cos(th) changes in second order alone."""
    problem = lagcli.load("symmetric-top-on-smooth-floor")
    found = modes(Derivation(problem).dynamics).modes
    assert [(to_grammar(m.frequency_squared), m.multiplicity) for m in found] == [
        ("-m*g*l/A", 2), ("0", 3),
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(6))
def test_a_corner_of_the_wire_has_no_small_oscillations(seed):
    """y = b x² + a |x|, with no corner for a = 0: w² = 2 b g, whatever c x² |x| is added."""
    source = Random(seed)
    b, c = source.randint(1, 5), source.randint(0, 3)
    a = source.choice([0, 0, 1, 2])
    found = modes(
        dynamics(
            "coordinates: {x: {}, y: {}}\nparameters: {m: POSITIVE, g: POSITIVE}\n"
            "T: m*(x'^2 + y'^2)/2\nV: m*g*y\n"
            f"constraints: {{wire: 'y = {b}*x^2 + {a}*abs(x) + {c}*x^2*abs(x)'}}"
        )
    ).modes
    assert [normal(m.frequency) for m in found or ()] == ([] if a else formulas(f"sqrt({2 * b}*g)"))
