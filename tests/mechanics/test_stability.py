"""Stability with damping, gyroscopic terms and follower forces, against roots found by numbers."""

from __future__ import annotations

import random

import mpmath
import pytest
import sympy
from sympy import Rational

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.conditions import opposites
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.stability.hurwitz import hurwitz_conditions

from .derived import derive


def origin(text: str):
    found = equilibria(derive(text.replace("POSITIVE", "{assume: positive}")).dynamics).equilibria
    assert found is not None
    return found[0]


def told(conditions) -> list[str]:
    return [f"{to_grammar(each.left)} > {to_grammar(each.right)}" for each in conditions]


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("degree", [2, 3, 4, 5, 6])
def test_the_criterion_is_that_of_the_roots(seed, degree):
    """Products of factors with roots on either side of the axis."""
    place = [((7 * seed + 5 * k * k + 3 * k) % 11) - 7 for k in range(degree)]
    roots = [mpmath.mpf(p or -1) / 3 for p in place]
    powers = [mpmath.mpf(1)]
    for root in roots:
        powers = [
            (powers[k - 1] if k else 0) - root * (powers[k] if k < len(powers) else 0)
            for k in range(len(powers) + 1)
        ]
    exact = [Rational(str(mpmath.nstr(p, 30))) for p in powers]
    conditions = hurwitz_conditions(exact)
    assert conditions is not None
    assert all(c > 0 for c in conditions) == all(root < 0 for root in roots)


def test_complete_damping_destroys_what_gyroscopic_terms_hold():
    """Kelvin: the same saddle with and without damping."""
    saddle = """
coordinates: [x, y]
parameters: {w: POSITIVE, b: POSITIVE}
T: ((x' - w*y)^2 + (y' + w*x)^2)/2
V: x^2 - y^2
"""
    free = origin(saddle)
    assert free.verdict.stable is None
    assert free.verdict.spectrum is not None
    assert free.verdict.gyroscopic
    damped = origin(saddle + "dissipation: b*(x'^2 + y'^2)/2\n")
    assert damped.verdict.stable is False


def test_damping_of_one_coordinate_reaches_the_other():
    """Two masses joined by a spring, one of them damped: Hurwitz, not Lagrange alone."""
    found = origin("""
coordinates: [x, y]
parameters: {k: POSITIVE, b: POSITIVE}
L: (x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 - k*(x - y)^2/2
dissipation: b*x'^2/2
""")
    assert found.verdict.stable is True
    assert found.verdict.asymptotic is True


def test_damping_of_a_relative_motion_leaves_the_common_one():
    """The common oscillation of two equal masses joined by a damper goes on for ever."""
    found = origin("""
coordinates: [x, y]
parameters: {k: POSITIVE, b: POSITIVE}
L: (x'^2 + y'^2)/2 - k*(x^2 + y^2)/2
dissipation: b*(x' - y')^2/2
""")
    assert found.verdict.stable is True
    assert found.verdict.asymptotic is False


def test_negative_damping_is_unstable():
    found = origin("""
coordinates: [x]
parameters: {k: POSITIVE, b: POSITIVE}
L: x'^2/2 - k*x^2/2
forces: {x: b*(1 - x^2)*x'}
""")
    assert found.verdict.stable is False


def test_damping_of_either_sign_is_a_condition():
    found = origin("""
coordinates: [x]
parameters: {k: POSITIVE, b: {}}
L: x'^2/2 - k*x^2/2
forces: {x: -b*x'}
""")
    assert found.verdict.stable is None
    assert told(found.verdict.hurwitz) == ["b > 0"]


def test_a_force_that_feeds_energy_in_third_order_is_not_overlooked():
    found = origin("{coordinates: [x], L: x'^2/2 - x^2/2, forces: {x: x'^3}}")
    assert found.verdict.stable is None
    assert "may feed energy" in found.verdict.reason
    drag = origin("{coordinates: [x], L: x'^2/2 - x^2/2, forces: {x: -x'^3}}")
    assert drag.verdict.stable is True


def test_flutter_agrees_with_the_roots_at_numbers():
    """Ziegler's pendulum with damping, at a load on either side of the printed bound."""
    found = origin("""
coordinates: [a, b]
parameters: {P: POSITIVE, d: POSITIVE}
T: 3*a'^2/2 + a'*b'*cos(a - b) + b'^2/2
V: (a^2 + (b - a)^2)/2
dissipation: d*(a'^2 + (b' - a')^2)/2
forces: {a: P*sin(a - b)}
""")
    assert told(found.verdict.hurwitz) == ["41 + 14*d^2 > 28*P"]
    d = mpmath.mpf("0.3")
    bound = (14 * d**2 + 41) / 28
    for P, stable in ((bound - 0.01, True), (bound + 0.01, False)):
        # det(s² M + s C + K) with M = (3 1; 1 1), C = d (2 -1; -1 1), K = (2 - P, P - 1; -1, 1)
        at = [
            (3 * s**2 + 2 * d * s + 2 - P) * (s**2 + d * s + 1)
            - (s**2 - d * s + P - 1) * (s**2 - d * s - 1)
            for s in map(mpmath.mpf, range(5))
        ]
        powers = mpmath.lu_solve(mpmath.matrix([[s**k for k in range(5)] for s in range(5)]), at)
        roots = mpmath.polyroots([powers[k] for k in range(4, -1, -1)], maxsteps=200)
        assert (max(root.real for root in roots) < 0) is stable


@pytest.mark.parametrize("force", ["c*x'", "c*x' - x^2*x'", "2*c*x' - c*x'^3"])
def test_where_damping_is_negative_the_potential_is_not_blamed(force):
    """Van der Pol's oscillator: V has its minimum where it is unstable."""
    found = origin(
        f"coordinates: [x]\nparameters: {{k: POSITIVE, c: POSITIVE}}\nT: x'^2/2\nV: k*x^2/2\n"
        f"forces: {{x: {force}}}\n"
    )
    assert found.verdict.stable is False
    assert "root" in found.verdict.reason
    assert "{V}" not in found.verdict.reason


def test_a_pendulum_under_a_constant_torque_is_unstable_above_the_horizontal():
    section = equilibria(
        derive(
            "coordinates: [a]\nparameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, N: POSITIVE}\n"
            "T: m*l^2*a'^2/2\nV: -m*g*l*cos(a)\nforces: {a: N}\n".replace(
                "POSITIVE", "{assume: positive}"
            )
        ).dynamics
    )
    assert [each.verdict.stable for each in section.equilibria or ()] == [True, False]


def test_the_opposite_keeps_a_square_that_may_be_0_together_with_others():
    """k (a + b)² > 0 and c (a + b)² > 0: for a + b = 0 neither is negative, whatever k and c."""
    a, b, k, c = sympy.symbols("a b k c", real=True)
    found = opposites([k * (a + b) ** 2, c * (a + b) ** 2], ["a", "b", "c", "k"])
    assert {to_grammar(each.right) for each in found} == {"k", "c"}
    assert {to_grammar(each.left) for each in found} == {"0"}
    assert [[to_grammar(other.left) for other in each.besides] for each in found] == [
        ["(a + b)^2"]
    ] * 2


@pytest.mark.parametrize("seed", range(10))
def test_a_linear_motion_stays_near_a_family_just_where_its_exact_solutions_do(seed):
    # x and y turn into each other and z oscillates; y is free: a family of equilibria
    source = random.Random(seed)
    n, k, c, w = (source.randint(-4, 4) or 1 for _ in range(4))
    text = f"""
coordinates: [x, y, z]
L: (x'^2 + y'^2 + z'^2)/2 + {n}*(x*y' - y*x') - ({k}*x^2 + 2*{c}*x*z + {w * w}*z^2)/2
"""
    found = origin(text).verdict
    A = mpmath.matrix(6, 6)
    A[0, 3] = A[1, 4] = A[2, 5] = 1
    A[3, 0], A[3, 2], A[3, 4] = -k, -c, 2 * n
    A[4, 3] = -2 * n
    A[5, 0], A[5, 2] = -c, -w * w
    late = mpmath.expm(A * 2000)
    away = max(abs(late[i, j]) for i in range(6) if i != 1 for j in range(6))  # y may drift
    assert found.stable is (away < 500), away


@pytest.mark.long
def test_a_pendulum_over_a_repelling_charge_rests_aside_stably():
    """V' = l sin(θ) (m g - c/D²) vanishes at D² = c/(m g), and V'' = 2 c l² sin²(θ)/D³ there."""
    found = equilibria(
        derive("""
coordinates: [theta]
parameters: {m: {assume: positive}, l: {assume: positive}, g: {assume: positive}, c: {assume: positive}, d: {assume: positive}}
T: m*l^2*theta'^2/2
V: -m*g*l*cos(theta) + c/(l + d - l*cos(theta))
""").dynamics
    ).equilibria
    aside = [each for each in found if "acos" in to_grammar(each.at["theta"])]
    assert aside
    assert all(each.verdict.stable for each in aside)


@pytest.mark.parametrize("seed", range(4))
def test_a_condition_in_factors_stays_in_factors(seed):
    """V'' of (R - a) (n m g + (R - a) k) (1 - cos u): not multiplied out."""
    n = random.Random(seed).randint(1, 9)
    text = f"""
coordinates: [u]
parameters: {{m: POSITIVE, g: POSITIVE, R: POSITIVE, a: POSITIVE, k: POSITIVE}}
T: m*R^2*u'^2/2
V: (R - a)*({n}*m*g + (R - a)*k)*(1 - cos(u))
""".replace("POSITIVE", "{assume: positive}")
    found = equilibria(derive(text).dynamics).equilibria
    [below] = [each for each in found if to_grammar(each.at["u"]) == "0"]
    [condition] = below.verdict.minimum
    assert to_grammar(condition.right) == "0"
    at = {"m": 2, "g": 3, "k": 5}
    for R, a in ((4, 1), (1, 4), (1, 1 + Rational(6 * n, 5) + 7)):
        value = sympy.sympify(to_grammar(condition.left)).subs({**at, "R": R, "a": a})
        assert (value > 0) == ((R - a) * (n * 6 + (R - a) * 5) > 0)


@pytest.mark.parametrize(("a", "b"), [(3, 2), (2, -1), (-2, 3), (1, -3), (-1, -2)])
def test_what_has_no_inertia_must_be_held_by_the_potential(a, b):
    """0 = a (y - x) + b y gives y: x then has the spring a b/(a + b)."""
    verdict = origin(
        "coordinates: {x: {}, y: {}}\nparameters: {m: POSITIVE}\nT: m*x'^2/2\n"
        f"V: {a}*(x - y)^2/2 + {b}*y^2/2"
    ).verdict
    assert verdict.stable in ((True,) if a > 0 and b > 0 else (None,))
    assert not verdict.stable or a * b / (a + b) > 0


def test_a_multiplier_among_the_coordinates_is_no_minimum():
    """L = m (x' - y)²/2 + u (x - y) - k x²/2: x = y and m x'' = (m - k) x."""
    verdict = origin(
        "coordinates: {x: {}, y: {}, u: {}}\nparameters: {m: POSITIVE, k: POSITIVE}\n"
        "L: m*(x' - y)^2/2 + u*(x - y) - k*x^2/2"
    ).verdict
    assert verdict.stable is None
