"""What textbooks ask next: periods, minima, new Hamiltonians, Legendre transforms, rest.

Compared with the book's own formula, or with quadrature and finite differences.
"""

from __future__ import annotations

import mpmath
import pytest
import sympy

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.pipeline import Request, state

from .derived import derive

FUNCTIONS = {
    name: getattr(mpmath, name)
    for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "acos", "cosh", "acosh", "pi", "atan")
}


def section(text, name):
    return state(derive(text), Request(sections=(name,))).sections[name]


def number(tree, **values):
    """A tree at values, by Python's own evaluation of the grammar."""
    text = to_grammar(tree).replace("^", "**").replace("'", "_d")
    # the text is that of a formula that was printed here
    return eval(text, {**FUNCTIONS, "abs": abs}, values)


def one_freedom(text):
    return section(text, "reduction").one_freedom


NODES = 24

CENTRAL = """
coordinates: {r: {assume: positive}, phi: }
parameters: {m: {assume: positive}, g: {assume: positive}, a: {assume: positive}}
"""

# -- reduction ---------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(
    ("kinetic", "potential"),
    [
        ("m*((1 + 4*a^2*r^2)*r'^2 + r^2*phi'^2)/2", "m*g*a*r^2"),  # Whittaker: a paraboloid
        ("m*(r'^2 + r^2*phi'^2)/2 + a*r'^2/2", "a*g*r"),  # Goldstein 1.19: a hole in a table
    ],
)
def test_the_period_about_a_radius_is_that_of_quadrature(kinetic, potential):
    found = section(f"title: t\n{CENTRAL}T: {kinetic}\nV: {potential}\n", "reduction")
    [period] = found.one_freedom.periods
    given = {"m": "1.3", "g": "9.8", "a": "0.7", "p_phi": "2.1"}
    with mpmath.workdps(30):
        values = {name: mpmath.mpf(value) for name, value in given.items()}
        a = mpmath.mpf("0.02")
        stated = number(period.period, **values, **{period.amplitude: a})

        def U(r):
            return number(found.effective_potential, **values, r=r)

        low = mpmath.findroot(lambda r: U(r) - U(r + 2 * a), number(period.at["r"], **values) - a)
        measured = mpmath.mpf(0)
        for k in range(NODES):  # r = low + a (1 - cos s)
            s = (k + mpmath.mpf("0.5")) * mpmath.pi / NODES
            at = {"r": low + a * (1 - mpmath.cos(s)), "E": U(low)}
            measured += number(found.one_freedom.rate, **values, **at) * a * mpmath.sin(s)
        measured *= 2 * mpmath.pi / NODES
    assert abs(stated / measured - 1) < 1e-6
    assert abs(number(period.period, **values, **{period.amplitude: 0}) / measured - 1) > 1e-5


@pytest.mark.long
def test_the_turning_points_of_an_exponential_well():
    """Landau, Lifshitz, section 11, problem 2(b), and Morse's potential."""
    head = (
        "title: t\ncoordinates: [x]\nparameters: {m: {assume: positive}, U0: {assume: positive}, "
    )
    head += "a: {assume: positive}}\nT: m*x'^2/2\n"
    for potential, E in (("-U0/cosh(a*x)^2", -0.3), ("U0*(1 - exp(-a*x))^2", 0.3)):
        motion = one_freedom(f"{head}V: {potential}\n")
        assert len(motion.turning_points) == 2
        [period] = motion.periods
        for point in motion.turning_points:
            x = number(point, U0=0.8, a=1.7, E=E)
            V = eval(potential.replace("^", "**"), FUNCTIONS, {"U0": 0.8, "a": 1.7, "x": x})
            assert abs(V - E) < 1e-12
        assert period.order == 4


@pytest.mark.long
def test_a_period_that_is_the_same_for_all_amplitudes_says_so():
    """Huygens: the cycloid's, here 4 pi sqrt(a/g)."""
    motion = one_freedom(
        "title: t\ncoordinates: [s]\nparameters: {m: {assume: positive}, a: {assume: positive}, "
        "g: {assume: positive}}\nT: 2*m*a^2*cos(s/2)^2*s'^2\nV: m*g*a*(1 - cos(s))\n"
    )
    [period] = motion.periods
    assert (period.amplitude, period.order) == ("", 4)
    assert to_grammar(period.period) == "4*pi*sqrt(a/g)"


# -- phase space -------------------------------------------------------------------------------


def test_new_variables_of_polar_form_are_inverted():
    """Goldstein, 3rd ed., exercises 9.6 and 9.14: q = Q^2 + P^2."""
    found = section(
        "title: t\ncoordinates: {q: {assume: positive}}\nH: q\ncanonical_transformations:\n"
        "  root: {Q: sqrt(q)*cos(2*p_q), p_Q: sqrt(q)*sin(2*p_q), F3: -Q^2*tan(2*p_q)/2}\n"
        "  log: {Q: log(1 + sqrt(q)*cos(p_q)), p_Q: 2*(1 + sqrt(q)*cos(p_q))*sqrt(q)*sin(p_q)}\n",
        "canonical",
    )
    root, log = found.transformations
    assert root.generator.generates
    Q, P = 0.4, 0.7
    assert abs(number(root.hamiltonian, Q=Q, p_Q=P) - (Q**2 + P**2)) < 1e-12
    # sqrt(q) (cos, sin) p = (exp Q - 1, P exp(-Q)/2)
    expected = (mpmath.exp(Q) - 1) ** 2 + (P * mpmath.exp(-Q) / 2) ** 2
    assert abs(number(log.hamiltonian, Q=Q, p_Q=P) - expected) < 1e-12


def test_falling_together_leaves_a_free_particle():
    """Without a function of the time alone, which no equation of motion has."""
    found = section(
        "title: t\ncoordinates: [x]\nparameters: {m: {assume: positive}, g: }\nT: m*x'^2/2\n"
        "V: m*g*x\ncanonical_transformations: {f: {X: x + g*t^2/2, p_X: p_x + m*g*t}}\n",
        "canonical",
    )
    [falling] = found.transformations
    assert to_grammar(falling.hamiltonian) == "p_X^2/(2*m)"


def test_a_quartic_kinetic_energy_has_no_delta_functions():
    """From x' = p^3 and p' = -x: x'' = 3 p^2 p'."""
    text = "title: t\ncoordinates: [x]\nH: p_x^4/4 + x^2/2\n"
    found = section(text, "accelerations").accelerations["x"]
    for p in (0.8, -1.3):
        assert abs(number(found, x=0.6, x_d=p**3) + 3 * p**2 * 0.6) < 1e-12


def test_a_bracket_is_a_multiple_of_an_observable_and_the_energy():
    """Goldstein, 3rd ed., eq. (9.131): {A_x, A_y} = -2 m H L_z."""
    found = section(
        "title: t\ncoordinates: [x, y]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        "H: (p_x^2 + p_y^2)/(2*m) - k/sqrt(x^2 + y^2)\nobservables:\n  L: x*p_y - y*p_x\n"
        "  A_x: p_y*L - m*k*x/sqrt(x^2 + y^2)\n  A_y: -p_x*L - m*k*y/sqrt(x^2 + y^2)\n"
        "brackets: {a: [A_x, A_y], b: [L, A_x]}\n",
        "brackets",
    )
    a, b = found.brackets
    assert to_grammar(a.named) == "-2*m*H*L"
    assert to_grammar(b.named) == "A_y"


# -- rest and steady motions -------------------------------------------------------------------


def test_conditions_leave_out_a_rate_that_is_not_zero():
    """Landau, Lifshitz, section 37: a free top about its axis of the largest moment."""
    A, B = sympy.symbols("A B", positive=True)
    v = sympy.Symbol("phi'", real=True)
    [bound] = conditions([(A - B) * v**2], ["A", "B", "phi'"], (v**2,))
    assert (to_grammar(bound.left), to_grammar(bound.right)) == ("A", "B")


def test_half_angles_of_rest_depend_on_the_parameters():
    """A bead on a hoop, held by a spring of length R to its top: cos(theta/2) = k R/(2(k R - m g))."""
    text = (
        "title: t\ncoordinates: [theta]\nparameters: {m: {assume: positive}, R: {assume: positive}, "
        "k: {assume: positive}, g: {assume: positive}}\nT: m*R^2*theta'^2/2\n"
        "V: -m*g*R*cos(theta) + k*(2*R*cos(theta/2) - R)^2/2\n"
    )
    rest = RestPoints(derive(text).dynamics)
    assert rest.points
    assert rest.complete
    at = {"m": 1, "R": 1, "k": 4, "g": 1}
    values = [x for point in rest.points for x in point.values.values()]
    places = sorted(float(x.subs({s: at[s.name] for s in x.free_symbols})) for x in values)
    expected = 2 * mpmath.acos(mpmath.mpf(2) / 3)
    # with theta also -theta, and the top for the half angle pi
    assert places == pytest.approx([-float(expected), 0, float(expected), 2 * float(mpmath.pi)])


# -- contact -----------------------------------------------------------------------------------

LOOP = """
title: Ball in a loop
coordinates: {r: {assume: positive}, theta: , phi: }
parameters: {m: {assume: positive}, g: {assume: positive}, R: {assume: positive}, b: {assume: positive},
  u: {assume: positive}}
T: m*(r'^2 + r^2*theta'^2)/2 + m*b^2*phi'^2/5
V: -m*g*r*cos(theta)
constraints:
  track: {equation: R - b = r, multiplier: N, holds_while: N >= 0}
  rolling: (R - b)*theta = b*phi
"""


@pytest.mark.long
def test_a_ball_goes_round_a_loop_of_any_radius_and_from_any_height():
    """v^2 = 27/7 g (R - b) at the lowest point, let go at a height of 27/10 (R - b)."""
    R, b, g = 1.0, 0.2, 9.8
    for speed, least in (("u", 27 * g * (R - b) / 7), ("sqrt(10*g*u/7)", 27 * (R - b) / 10)):
        text = f"{LOOP}initial: {{r: R - b, theta: 0, theta': {speed}/(R - b)}}\n"
        found = section(f"{text}find: {{over: {{reaches: theta = pi, for: u}}}}\n", "find")
        [only] = found.answers["over"].ranges
        assert only.upper is None
        lowest = number(only.lower, R=R, b=b, g=g)
        assert abs((lowest**2 if speed == "u" else lowest) - least) < 1e-9


def test_a_point_on_a_sphere_rests_at_its_poles():
    """Where x = 0 the displacements (-y, x, 0), (-z, 0, x) vanish: no circle of states of rest."""
    found = section(
        "title: t\ncoordinates: [x, y, z]\nparameters: {m: {assume: positive}, l: {assume: positive}, "
        "g: {assume: positive}}\nT: m*(x'^2 + y'^2 + z'^2)/2\nV: m*g*z\n"
        "constraints: {rod: x^2 + y^2 + z^2 = l^2}\n",
        "equilibria",
    )
    places = {to_grammar(each.at["z"]): each.verdict.stable for each in found.equilibria}
    assert places == {"l": False, "-l": True}
    assert all(to_grammar(each.at["x"]) == "0" for each in found.equilibria)


# -- conditions ----------------------------------------------------------------------------------


def test_a_rod_in_a_bowl_rests_where_it_fits():
    """Lamb, *Statics*: the rod of length 2 l hangs as a pendulum of length √(R² - l²), R > l."""
    found = section(
        "title: t\ncoordinates: {u: }\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        "R: {assume: positive}, l: {assume: positive}}\n"
        "T: m*(R^2 - l^2 + l^2/3)*u'^2/2\nV: -m*g*sqrt(R^2 - l^2)*cos(u)\n",
        "equilibria",
    )
    places = {to_grammar(each.at["u"]): each for each in found.equilibria}
    assert {name: each.verdict.stable for name, each in places.items()} == {"0": True, "pi": False}
    for each in places.values():
        [needed] = each.where
        assert (to_grammar(needed.left), to_grammar(needed.right)) == ("R", "l")


@pytest.mark.parametrize("inertia", ["I", "0"])
def test_masses_on_a_turning_rod_are_held_by_any_spring_that_is_stretched(inertia):
    """r > a is the condition of existence, and 8 m r³ + a I > 6 m a r² then holds."""
    found = section(
        "title: t\ncoordinates: {r: {assume: positive}, phi: }\nparameters: {m: {assume: positive},"
        " k: {assume: positive}, a: {assume: positive}, I: {assume: positive}}\n"
        f"T: {inertia}*phi'^2/2 + m*(r'^2 + r^2*phi'^2)\nV: 2*k*(r - a)^2\n",
        "steady_motions",
    )
    [motion] = (each for each in found.motions if each.where)
    assert [to_grammar(x.left) + ">" + to_grammar(x.right) for x in motion.where] == ["r>a"]
    assert motion.verdict.stable is True
    assert not motion.verdict.unstable


def test_conditions_without_a_closed_solution_are_printed():
    """V = k x cos x: the extrema are at cot x = x."""
    found = section(
        "title: t\ncoordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        "T: m*x'^2/2\nV: k*x*cos(x)\n",
        "equilibria",
    )
    assert found.equilibria is None
    [condition] = found.open
    for place in (0.8603335890193798, 3.4256184594817283):
        assert abs(number(condition, k=1, x=place)) < 1e-12
    assert abs(number(condition, k=1, x=1)) > 0.1


@pytest.mark.parametrize("n", [3, pytest.param(5, marks=pytest.mark.long)])
def test_frequencies_of_a_chain_are_the_zeros_of_a_polynomial_of_laguerre(n):
    """A hanging chain of n equal links, m = l = g = 1: L_n(w²) = 0 (D. Bernoulli, 1732)."""
    q = [f"q{k}" for k in range(n)]
    x, z = (
        ["+".join(f"{wave}({angle})" for angle in q[: k + 1]) for k in range(n)]
        for wave in ("sin", "cos")
    )
    points = "\n".join(f"  p{k}: {{position: [{x[k]}, -({z[k]})], mass: 1}}" for k in range(n))
    found = section(
        f"title: t\ncoordinates: [{', '.join(q)}]\npoints:\n{points}\nV: -({' + '.join(z)})\n",
        "modes",
    )
    squares = [number(each.frequency) ** 2 for each in found.modes]
    assert len(squares) == n
    assert all(abs(mpmath.laguerre(n, 0, each)) < 1e-9 for each in squares)


@pytest.mark.long
@pytest.mark.parametrize(("a", "b"), [("a", "b"), ("a", "2*a"), ("a", "a")])
def test_two_pendulums_joined_by_a_spring_are_never_stable_upside_down(a, b):
    """det K > 0 needs m g > k (a + b), and then the trace of K is negative."""
    found = section(
        "title: t\ncoordinates: [u, v]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        "a: {assume: positive}, b: {assume: positive}, k: {assume: positive}}\n"
        f"T: m*(({a})^2*u'^2 + ({b})^2*v'^2)/2\n"
        f"V: -m*g*({a}*cos(u) + {b}*cos(v)) + k*({a}*sin(u) - {b}*sin(v))^2/2\n",
        "equilibria",
    )
    [top] = (
        each for each in found.equilibria if {to_grammar(x) for x in each.at.values()} == {"pi"}
    )
    assert top.verdict.stable is False
