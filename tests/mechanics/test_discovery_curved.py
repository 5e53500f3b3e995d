"""Symmetries in curved spaces and charts, and an integral on a sphere.

Isometries: Lee, *Introduction to Riemannian Manifolds*, 2nd ed., chapter 3 (half plane, sphere);
the plane by 1/r has the eight of the free particle.  Neumann's problem: Moser, *Various aspects
of integrable Hamiltonian systems*, in CIME Lectures 1978 (Uhlenbeck's integrals).
"""

import pytest
import sympy

from lagcli.algebra import is_zero
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.summary import summary

from .derived import derive


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "algebra", "dimension"),
    [
        ("{coordinates: {x: {}, y: {assume: positive}}, L: (x'^2 + y'^2)/(2*y^2)}",
         "sl(2,R) + R", 4),
        ("{coordinates: [x, y], L: 2*(x'^2 + y'^2)/(1 + x^2 + y^2)^2}", "so(3) + R", 4),
        ("{coordinates: {u: {assume: positive}, phi: {}}, L: u'^2/(2*u^4) + phi'^2/(2*u^2)}",
         "Schrödinger sch(2): sl(2,R) + so(2) with Heisenberg h(2), modulo constants", 8),
    ],
)  # fmt: skip
def test_isometries_of_the_second_degree(text, algebra, dimension):
    found = summary(derive(text).discovery)
    assert (found.name, found.dimension, found.integrable) == (algebra, dimension, True)


def test_a_half_plane_has_its_isometries_in_parabolic_coordinates():
    found = derive("{coordinates: [x, y], L: (1/x^2 + 1/y^2)*(x'^2 + y'^2)/2}").discovery
    assert summary(found).name == "sl(2,R) + R"


@pytest.mark.long
def test_a_surface_of_koenigs_has_constant_curvature_without_a_term():
    """a/x^2 + b/y^2 + d where d = 0 and b = a: a half plane, in parabolic coordinates."""
    cases = derive("""
coordinates: [x, y]
parameters: [a, b, d]
T: (a/x^2 + b/y^2 + d)*(x'^2 + y'^2)/2
""").special_cases
    given = {str(sorted(map(str, [(c.parameter, c.value), *c.given]))): c.number for c in cases}
    assert given["['(b, a)', '(d, 0)']"] == 4


@pytest.mark.parametrize(("wave", "sign"), [(sympy.cosh, 1), (sympy.cos, -1)])
def test_a_universe_of_constant_curvature_is_found_among_others(wave, sign):
    """-dt^2 + cosh(H t)^2 (dr^2/(1 - K r^2) + r^2 dphi^2) is de Sitter's where K = H^2."""
    t, r, phi, H, K = sympy.symbols("t r phi H K", real=True)
    a = wave(H * t) ** 2
    g = sympy.diag(-1, a / (1 - K * r**2), a * r**2)
    condition = Metric([t, r, phi], g.tolist()).constant_where([H, K])
    assert condition != 0
    assert condition.subs(K, sign * H**2).simplify() == 0
    assert condition.subs(K, -sign * H**2).simplify() != 0


@pytest.mark.long
def test_the_integral_of_uhlenbeck():
    """(a - b)(c - b) times y^2 + L_xy^2/(b - a) + L_yz^2/(b - c)."""
    derivation = derive("""
coordinates: [x, y, z]
parameters: [a, b, c]
T: (x'^2 + y'^2 + z'^2)/2
V: (a*x^2 + b*y^2 + c*z^2)/2
constraints: {sphere: x^2 + y^2 + z^2 = 1}
""")
    found = derivation.discovery
    assert summary(found).integrable is True
    [charge] = found.hidden_charges
    x, y, z = derivation.system.q
    u, v, w = derivation.system.qdot
    a, b, c = derivation.system.parameters
    known = (
        (a - b) * (c - b) * y**2 + (b - c) * (x * v - y * u) ** 2 + (b - a) * (y * w - z * v) ** 2
    )
    relations = derivation.dynamics.constraints.relations
    assert is_zero(charge.charge - known, relations) is True


@pytest.mark.long
def test_the_functions_of_time_of_coupled_oscillators_are_taken_once():
    """Wilberforce's pendulum: the energy and two solutions for each frequency."""
    found = derive("""
coordinates: [z, theta]
parameters: {k: {assume: positive}, d: {assume: positive}, e: {}}
T: (z'^2 + theta'^2)/2
V: (k*z^2 + d*theta^2 + e*z*theta)/2
""").discovery
    assert len(found.point_charges) == 5
    assert found.stopped == []
