"""Integrals on constraint surfaces whose displacements are tangent only with a part along the normal.

Jacobi, *Vorlesungen ueber Dynamik*, lecture 28; Joachimsthal, J. reine angew. Math. 26 (1843) 155;
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 47 (ellipsoid). Kepler's
problem on a sphere: Schroedinger, Proc. R. Irish Acad. A 46 (1940) 9; Higgs, J. Phys. A 12 (1979) 309.
"""

import pytest

from lagcli.mechanics.discovery.summary import summary
from tests.oracle.constancy import digits_of

from .derived import derive
from .test_discovery_literature import problem

T = "m*(x'^2 + y'^2 + z'^2)/2"
QUADRICS = {
    "x^2/a^2 + y^2/b^2 + z^2/c^2 = 1": "",
    "a*x^2 + b*y^2 + c*z^2 = 1": "k*(x^2 + y^2 + z^2)/2",
    "x^2/a^2 + y^2/b^2 - z^2/c^2 = 1": "",
    "z^2/c^2 - x^2/a^2 - y^2/b^2 = 1": "",
    "z = x^2/a + y^2/b": "m*g*z",
    "a*z = x^2 - y^2": "",
}


def on(surface, V=""):
    potential = f" - {V}" if V else ""
    return problem(T + potential, "[x, y, z]", "m a b c k g", f', constraints: {{s: "{surface}"}}')


@pytest.mark.parametrize("surface", QUADRICS)
@pytest.mark.long
def test_geodesics_of_a_quadric_have_jacobis_integral(surface):
    derivation = derive(on(surface, QUADRICS[surface]))
    charges = derivation.discovery.charges
    assert [c.name for c in charges] == ["energy", "charge_1"]
    assert charges[1].conserved is True
    assert charges[1].verified == "exact"
    assert summary(derivation.discovery).integrable is True


@pytest.mark.parametrize("surface", ["x^2/a^2 + y^2/b^2 + z^2/c^2 = 1", "a*z = x^2 - y^2"])
@pytest.mark.long
def test_it_stays_on_an_independent_motion(surface):
    digits = digits_of(derive(on(surface, QUADRICS[surface])))
    assert len(digits) == 2
    assert min(digits.values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("surface", ["a*z = x^3 - x*y^2 + y", "x^4 + y^4 + z^4 = a^4"])
def test_other_surfaces_have_the_energy_alone(surface):
    found = summary(derive(on(surface)).discovery)
    assert (found.independent, found.integrable) == (1, None)


@pytest.mark.parametrize(
    ("x", "y", "z"),
    [
        ("x", "y", "z"),
        pytest.param("y", "z", "x", marks=pytest.mark.long),
        ("(3*x + 4*y)/5", "(3*y - 4*x)/5", "z"),
    ],
)
def test_keplers_problem_on_a_sphere_has_a_runge_lenz_vector(x, y, z):
    V = f"(-1)*k*({z})/sqrt(({x})^2 + ({y})^2)"
    found = summary(derive(on("x^2 + y^2 + z^2 = 1", V)).discovery)
    assert (found.independent, found.integrable) == (3, True)


@pytest.mark.long
@pytest.mark.parametrize("V", ["(a*x^2 + b*y^2 + c*z^2)/2 + k/x^2 + m/y^2 + g/z^2"])
def test_no_integral_is_said_to_be_left_that_was_found_in_other_terms(V):
    """Rosochatius, 1877; Moser, *Various aspects of integrable Hamiltonian systems* (1980)."""
    derivation = derive(on("x^2 + y^2 + z^2 = 1", V))
    assert not any("not solved" in reason for reason in derivation.discovery.stopped)
    assert summary(derivation.discovery).integrable is True
