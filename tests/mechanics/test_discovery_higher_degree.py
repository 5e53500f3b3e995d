"""Integrals of third and fourth degree in the velocities.

Hietarinta, Phys. Rep. 147 (1987) 87, section 3 (Holt; Fokas and Lagerstrom); Henon, Phys. Rev. B
9 (1974) 1921 (Toda); Bogoyavlensky, Commun. Math. Phys. 51 (1976) 201 (open chains);
Ramani, Dorizzi, Grammaticos, Phys. Rev. Lett. 49 (1982) 1539 (fourth degree); Inozemtsev,
Meshcheryakov, Lett. Math. Phys. 9 (1985) 13 (root systems BC).
"""

import pytest
import sympy

from lagcli.mechanics.discovery.summary import summary
from tests.marks import mostly_long
from tests.oracle.constancy import digits_of

from .derived import derive
from .test_discovery_literature import problem

pytestmark = pytest.mark.long  # of discovery, test_discovery.py is what runs before a commit

T2, T3 = "m*(x'^2 + y'^2)/2", "m*(x'^2 + y'^2 + z'^2)/2"
TURNED = "((3*x + 4*y)/5)", "((3*y - 4*x)/5)"


def holt(x, y):
    return f"k*(3*{x}^2/4 + {y}^2 + d)/{x}^(2/3)"


PLANE = {
    "Holt": f"{T2} - {holt('x', 'y')}",
    "Holt, turned": f"{T2} - {holt(*TURNED)}",
    "Fokas and Lagerstrom": f"{T2} - k/(x^2 - y^2)^(2/3)",
    "Fokas and Lagerstrom, turned": f"{T2} - k/(x*y)^(2/3)",
    "Toda's in relative coordinates":
        f"{T2} - k*(exp(2*a*y) + exp(a*(sqrt(3)*x - y)) + exp(-a*(sqrt(3)*x + y)))",
}  # fmt: skip


@pytest.mark.parametrize("name", PLANE)
def test_an_integral_of_third_degree_makes_it_integrable(name):
    text = problem(PLANE[name], parameters="m k a d")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (2, 2, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("chain", [
    "k*(exp(a*(x - y)) + exp(a*(y - z)) + exp(a*(z - x)))", "k*exp(x - y) + b*exp(y - z)",
    "k*exp(a*(x - y)) + b*exp(a*(y - z)) + c*exp(a*(z - x)) + d*(x + y + z)",
])  # fmt: skip
def test_three_masses_of_toda(chain):
    text = problem(f"{T3} - ({chain})", "[x, y, z]", "m k a b c d")
    derivation = derive(text)
    assert "of degree 3" in derivation.discovery.ansatz
    found = summary(derivation.discovery)
    assert found.integrable is True
    assert found.with_constants  # {P, boost} = 3 m, though the algebra has no name


@pytest.mark.parametrize("V", [
    "k*(exp(x - y) + exp(y - z) + 2*exp(2*(z - x)))", "k*((x - y)^4 + (y - z)^4 + (z - x)^2)",
])  # fmt: skip
def test_a_chain_of_another_force_has_none(V):
    found = derive(problem(f"{T3} - {V}", "[x, y, z]", "m k")).discovery
    assert {c.name for c in found.charges} == {"energy", "momentum", "boost"}
    assert summary(found).integrable is None


@pytest.mark.parametrize("V", [
    "x^2*y^2", "k*(x^2 + y^2)/2 + x^2*y + 5*y^3", "k*(x^2 + 3*y^2)/x^(2/3)",
])  # fmt: skip
def test_what_is_not_integrable_gets_no_third_or_fourth_degree(V):
    found = derive(problem(f"{T2} - {V}", parameters="m k")).discovery
    assert [c.name for c in found.charges] == ["energy"]


def test_what_lower_degrees_decide_is_not_searched():
    found = derive(problem(f"{T2} + k/sqrt(x^2 + y^2)", parameters="m k")).discovery
    assert found.ansatz.count("of degree 3") == 1
    assert "of degree 3 or higher were not sought" in found.ansatz


def henon_heiles(x, y):
    return f"{T2} - k*({x}^2 + 16*{y}^2)/2 - b*({x}^2*{y} + 16*{y}^3/3)"


def quartic(x, y):
    return f"{T2} - k*({x}^4 + 6*{x}^2*{y}^2 + 8*{y}^4)"


FOURTH = {
    "Henon and Heiles, 1:16": henon_heiles("x", "y"),
    "1:6:8": quartic("x", "y"),
    "1:6:8, turned": quartic(*TURNED),
    "Holt, fourth degree": f"{T2} - k*(9*x^2/2 + y^2 + d)/x^(2/3)",
    **{
        f"BC2, {f}": f"{T2} - k*({f}(x - y)^-2 + {f}(x + y)^-2) - b*({f}(x)^-2 + {f}(y)^-2)"
        for f in ("sin", "sinh")
    },
    "Inozemtsev, hyperbolic": f"{T2} - k*(sinh(x - y)^-2 + sinh(x + y)^-2)"
    " - b*(cosh(4*x) + cosh(4*y)) - d*(cosh(2*x) + cosh(2*y))",
    "Inozemtsev, rational": f"{T2} - k*((x - y)^-2 + (x + y)^-2) - b*(x^6 + y^6) - d*(x^4 + y^4)",
}


@pytest.mark.parametrize("name", mostly_long(FOURTH, "Holt, fourth degree"))
def test_an_integral_of_fourth_degree_makes_it_integrable(name):
    text = problem(FOURTH[name], parameters="m k b d")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (2, 2, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(
    ("A", "V", "integrals"),
    [("2*C", "a*sin(psi) + b*cos(psi)", 3), ("3*C", "a*sin(psi)", 2)],
)
def test_of_the_tops_that_lean_kovalevskayas_has_an_integral_of_fourth_degree(A, V, integrals):
    """Whittaker, *Analytical Dynamics*, 4th ed., section 74; with 3 in place of 2 there is none."""
    T = f"{A}*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2"
    text = problem(f"{T} - sin(theta)*({V})", "[theta, phi, psi]", "C a b")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution) == (integrals, integrals)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("turned", ["", pytest.param(" + pi/3", marks=pytest.mark.long)])
def test_kovalevskayas_top_in_two_equal_crossed_fields_has_one(turned):
    """Bogoyavlensky, Commun. Math. Phys. 94 (1984) 255; a turn about the axis changes nothing."""
    V = f"(1 + cos(theta))*cos(phi + psi{turned})"
    T = "J*(theta'^2 + phi'^2*sin(theta)^2) + J*(psi' + phi'*cos(theta))^2/2"
    derivation = derive(problem(f"{T} + c*{V}", "[phi, theta, psi]", "J c"))
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (3, 3, True)
    assert min(digits_of(derivation).values()) > 20


def test_a_gas_cloud_has_an_integral_of_third_degree():
    """Gaffet, J. Phys. A 31 (1998) 1581."""
    lengths = "{x: {assume: positive}, y: {assume: positive}, z: {assume: positive}}"
    derivation = derive(problem(f"{T3} - k*(x*y*z)^(-2/3)", lengths, "m k"))
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (4, 3, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("V", [
    holt("(r*cos(phi))", "(r*sin(phi))"),
    "k*(exp(2*a*r*sin(phi)) + 2*exp(-a*r*sin(phi))*cosh(sqrt(3)*a*r*cos(phi)))",
])  # fmt: skip
def test_third_degree_is_found_in_polar_coordinates(V):
    text = problem(f"m*(r'^2 + r^2*phi'^2)/2 - {V}", "{r: {assume: positive}, phi: {}}", "m k a d")
    assert summary(derive(text).discovery).integrable is True


D3 = {
    "exp(x - y) + exp(y - z) + exp(y + z)": 3,
    "a*exp(y - z) + exp(z - x) + 2*exp(x + z)": 3,
    "(x - y)^-2 + (x + y)^-2 + (y - z)^-2 + (y + z)^-2 + (z - x)^-2 + (z + x)^-2": 5,
}


@pytest.mark.parametrize(("V", "independent"), D3.items())
def test_what_has_the_roots_of_d3_is_integrable(V, independent):
    """Bogoyavlensky, Commun. Math. Phys. 51 (1976) 201: degrees 2, 3 and 4.

    Inverse squares: Wojciechowski, Phys. Lett. A 95 (1983) 279 (five are independent).
    """
    derivation = derive(problem(f"{T3} - k*({V})", "[x, y, z]", "m k a"))
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (independent, 3, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("V", [
    "1/sinh(x - y)^2 + 1/sinh(y - z)^2 + 1/sinh(z - x)^2",
    "1/sinh(x - y)^2 - 1/cosh(y - z)^2 - 1/cosh(z - x)^2",
])  # fmt: skip
def test_hyperbolic_inverse_squares_have_their_integral_of_third_degree(V):
    """Calogero and Sutherland; two kinds: Olshanetsky, Perelomov, Phys. Rep. 71 (1981) 313."""
    found = derive(problem(f"{T3} - k*({V})", "[x, y, z]", "m k")).discovery
    assert not found.stopped
    assert (summary(found).in_involution, summary(found).integrable) == (3, True)


@pytest.mark.parametrize("masses", [("m", "m", "m"), ("m", "3*m", "m")])
@pytest.mark.parametrize("spring", ["0", "k"])
def test_what_is_integrable_has_its_last_integral_of_third_degree(spring, masses):
    """Calogero, J. Math. Phys. 10 (1969) 2191: only of equal masses; Wojciechowski, 1983."""
    a, b, c = masses
    T = f"({a}*x'^2 + {b}*y'^2 + {c}*z'^2)/2"
    V = f"g/(x - y)^2 + g/(y - z)^2 + g/(z - x)^2 + {spring}*({a}*x^2 + {b}*y^2 + {c}*z^2)/2"
    derivation = derive(problem(f"{T} - ({V})", "[x, y, z]", "m k g"))
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (6 if a == b else 5, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(("x", "y"), [("x", "y"), TURNED])
def test_frequencies_one_to_three_have_an_integral_of_third_degree(x, y):
    """Jauch and Hill, Phys. Rev. 57 (1940) 641."""
    derivation = derive(problem(f"{T2} - k*({x}^2 + 9*{y}^2)/2", "[x, y]", "m k"))
    assert [c for c in derivation.discovery.fixed_charges if _degree(c, derivation) == 3]
    assert min(digits_of(derivation).values()) > 20


def _degree(charge, derivation):
    return sympy.Poly(charge.charge, *derivation.system.qdot).total_degree()
