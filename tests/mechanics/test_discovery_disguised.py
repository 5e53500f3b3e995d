"""Simple systems in disguise: other coordinates, masses that change, drives, and their charges.

Lewis, Leach, J. Math. Phys. 23 (1982) 2371 (oscillators that depend on time); Huygens (the
cycloid); Chandrasekar, Senthilvelan, Lakshmanan, Proc. R. Soc. A 461 (2005) 2451 (1/(x' + k x^2)).
"""

import random

import pytest

from lagcli.formatters.built_in.json import to_object
from lagcli.mechanics.discovery.summary import summary
from lagcli.reader import read_problem
from lagcli.verification.claims.algebra import signatures_of
from tests.oracle.constancy import digits_of
from tests.solved import solve

from .derived import derive
from .test_discovery_literature import problem

pytestmark = pytest.mark.long  # of discovery, test_discovery.py is what runs before a commit

LINE = r"Schrödinger sch(1): sl(2,R) with Heisenberg h(1), modulo constants"


def known(L, coordinates="[x]", parameters=""):
    """The discovery, its summary, and the least digits kept along a motion where there is one."""
    derivation = derive(problem(L, coordinates, parameters))
    found = derivation.discovery
    assert not found.stopped
    return found, summary(found), min(digits_of(derivation).values(), default=30)


def whole(source, least=1, most=5):
    return source.randint(least, most)


def quadratic(source):
    """a x^2 + b x + c without real roots, or with a < 0 and positive at x = 0."""
    a, b = whole(source), source.randint(-2, 2)
    sign = source.choice((1, 1, -1))
    return f"({sign * a}*x^2 + {b}*x + {a + 2 + (20 if sign < 0 else 0)})"


@pytest.mark.parametrize("seed", range(4))
def test_an_arc_length_of_a_quadratic_leaves_free_motion(seed):
    source = random.Random(seed)
    Q = quadratic(source)
    L = f"m*x'^2*{Q}/2" if seed % 2 else f"m*x'^2/(2*{Q})"
    found, algebra, digits = known(L, parameters="m")
    assert (len(found.charges), algebra.name, algebra.independent) == (5, LINE, 2)
    assert digits > 20


@pytest.mark.parametrize(
    "L", ["-3*x*x'^2 + {a}*x^3", "-x^2*x'^2 - {a}*x^4", "-x'^2/x^2", "3*x*x'^2"]
)
def test_a_negative_inertia_has_an_arc_length_as_well(L):
    """Of -3 x x'² + a x³, a flat universe, u = x^(3/2) has u'' = -3 a u/4."""
    a = whole(random.Random(L))
    found, algebra, digits = known(L.format(a=a), "{x: {assume: positive}}")
    assert (len(found.charges), algebra.name, algebra.independent) == (5, LINE, 2)
    assert digits > 20


@pytest.mark.parametrize("sign", ["+", "-"])
def test_a_cycloid_is_an_oscillator(sign):
    L = f"m*a^2*(1 {sign} cos(x))*x'^2 + m*g*a*(1 {sign} cos(x))"
    found, algebra, digits = known(L, parameters="m a g")
    assert (len(found.charges), algebra.name) == (5, LINE)
    assert digits > 20


@pytest.mark.parametrize("power", [2, 3, 4])
def test_sheared_by_any_power_a_plane_is_flat(power):
    a = random.Random(power).randint(1, 4)
    found, algebra, _ = known(f"(x'^2 + (y' - {a * power}*x^{power - 1}*x')^2)/2", "[x, y]")
    assert len(found.charges) == 8
    assert algebra.name.startswith("Schrödinger sch(2)")


CHANGING = (
    "(1 + {a}*t)*x'^2/2",
    "x'^2/2 - {a}*x^2/(2*(1 + {b}*t)^2)",
    "x'^2/2 - {a}*x^2/(2*(1 + {b}*t)^4)",
    "x'^2/2 + {a}*x^2/(2*(3 + {b}*t)^4)",
    "cosh({a}*t)^2*x'^2/2",
    "exp({a}*t)*(x'^2/2 - {a}*x^2 + {b}*x*exp(-{b}*t))",
)


@pytest.mark.parametrize("L", CHANGING)
def test_coefficients_that_change_keep_five_charges(L):
    source = random.Random(L)
    found, algebra, digits = known(L.format(a=whole(source), b=whole(source)))
    assert (len(found.charges), algebra.name, algebra.independent) == (5, LINE, 2)
    assert digits > 20


def test_beside_an_inverse_square_the_stretching_of_time_is_left():
    c = random.Random("Ermakov").randint(1, 9)
    L = f"x'^2/2 - {c}*x^2/(50*(1 + t)^2) - k/(2*x^2)"
    found, algebra, digits = known(L, "{x: {assume: positive}}", "k")
    assert (len(found.charges), algebra.name) == (3, "sl(2,R)")
    assert digits > 20


def test_a_driven_damped_oscillator_has_its_charges_proved():
    L = "exp(c*t)*(m*x'^2/2 - k*x^2/2 + F*x*exp(-b*t))"
    found = derive(problem(L, "[x]", "m c k b | F")).discovery
    assert (len(found.charges), found.stopped, summary(found).name) == (5, [], LINE)


def test_a_lagrangian_that_is_no_square_has_the_charges_of_a_free_particle():
    """x'' + 3 k x x' + k^2 x^3 = 0, the modified Emden equation: k x = y'/y makes it y''' = 0."""
    found, algebra, digits = known("1/(x' + k*x^2)", "{x: {assume: positive}}", "k")
    assert (len(found.charges), algebra.independent) == (5, 2)
    assert algebra.name.startswith("Schrödinger sch(1)")
    assert digits > 20


def test_polar_coordinates_change_nothing_where_an_oscillator_is_part_of_the_potential():
    L = "(r'^2 + r^2*phi'^2)/2 - w*r^2/2 - a/(r^2*cos(phi)^2) - b/(r^2*sin(phi)^2)"
    found = derive(problem(L, "{r: {assume: positive}, phi: {}}", "w a b")).discovery
    assert {c.name for c in found.charges} >= {"energy", "conformal_cos", "conformal_sin"}
    algebra = summary(found)
    assert (algebra.name, algebra.independent, algebra.integrable) == ("sl(2,R)", 4, True)


def test_an_oscillator_in_parabolic_coordinates_keeps_all():
    L = "m*(u^2 + v^2)*(u'^2 + v'^2)/2 - k*(u^2 + v^2)^2/8"
    found = derive(problem(L, "[u, v]", "m k")).discovery
    assert (len(found.charges), summary(found).independent) == (10, 4)


def test_an_inverse_square_on_the_sphere_leaves_neumanns_integral():
    V = "(a*sin(u)^2*cos(v)^2 + b*sin(u)^2*sin(v)^2 + c*cos(u)^2)/2 + p/(sin(u)^2*cos(v)^2)"
    found = derive(problem(f"(u'^2 + sin(u)^2*v'^2)/2 - {V}", "[u, v]", "p | a b c")).discovery
    assert "all first integrals of second degree" in found.ansatz
    assert (len(found.charges), summary(found).integrable) == (2, True)


def test_a_special_value_lists_only_what_is_new():
    L = "m*(x'^2 + y'^2)/2 + q*B*(x*y' - y*x')/2 + k*(x^2 + y^2)/2"
    found = derive(problem(L, "[x, y]", "m B k | q"))
    at_zero = next(case for case in found.special_cases if case.value == 0)
    assert [c.name for c in at_zero.charges] == ["energy_x", "fradkin_xy"]


def test_a_hoop_on_an_incline_has_all_its_integrals():
    text = problem("m*x'^2/2 + J*u'^2/2 + m*g*x/2", "[x, u]", "m J R g",
                   """, constraints: {r: "x' = R*u'"}""")  # fmt: skip
    found = derive(text).discovery
    assert "every other integral is in general a function of these" in found.words
    assert summary(found).independent == 3  # two of the motion, and x - R u


def test_a_sum_with_the_schroedinger_algebra_keeps_its_name():
    name = f"{LINE.removesuffix(', modulo constants')} + R, modulo constants"
    assert signatures_of(name) == {None: (6, 2, 1, 6, 0, 0)}
    text = problem("(r'^2 + r^2*v'^2 + z'^2)/2 - k*(r^2 + z^2)/2 - b/r^2",
                   "{r: {assume: positive}, v: {}, z: {}}", "k b")  # fmt: skip
    answers = solve(read_problem("test.yaml", text.encode()).checked(), ["algebra"])
    assert to_object(answers)["algebra"]["name"].startswith("Schrödinger sch(1)")


def test_without_a_term_what_is_left_may_be_linear():
    """Of a curved universe, -3 x x'² + 3 k x - a x³, the flat one has five (Friedmann)."""
    L = "-3*x*x'^2 + 3*k*x - a*x^3"
    cases = derive(problem(L, "{x: {assume: positive}}", "a | k")).special_cases
    assert {(str(c.parameter), c.value): c.number for c in cases} == {("k", 0): 5}
