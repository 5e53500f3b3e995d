"""Plane waves and homogeneous spaces whose isometries mix cyclic coordinates.

Plane waves: Stephani, Kramer, MacCallum, Hoenselaers, Herlt, *Exact Solutions of Einstein's Field
Equations*, 2nd ed., section 24.5 (five Killing vectors, six where the profile is constant); in an
electromagnetic one: Landau and Lifshitz, *The Classical Theory of Fields*, section 47, problem 2.
Goedel's universe: Stephani and others, section 12.4 (five Killing vectors and more).
Nil and Sol: Scott, Bull. London Math. Soc. 15 (1983) 401, section 4 (isometries of dimension 4, 3).
"""

import pytest

from lagcli.mechanics.discovery.summary import summary
from tests.oracle.constancy import digits_of

from .derived import derive
from .test_discovery_literature import problem

WAVE = "u'*v' + (x'^2 + y'^2)/2"
U = "{u: {assume: positive}, v: {}, x: {}, y: {}}"


@pytest.mark.parametrize(
    ("L", "coordinates", "number", "independent"),
    [
        # energy, p_u, p_v, t p_v - u, the dilation, and two f(u) d/dx - x f'(u) d/dv for each of x, y
        (f"{WAVE} - u'^2*(a*x^2 - b*y^2)/2", "[u, v, x, y]", 9, 8),
        (f"{WAVE} - u'^2*(a*x^2 + b*y^2)/2", "[u, v, x, y]", 9, 8),
        ("s'*w' + z'^2/2 + a*s'^2*z^2", "[w, s, z]", 7, 6),
        # an x^2/u^2 has powers of u, and u d/du - v d/dv for p_u (Blau, O'Loughlin, 2003)
        (f"{WAVE} - a*u'^2*(x^2 - y^2)/(2*u^2)", U, 9, 8),
        ("u'*v' + x'^2/2 + b*u'^2*x^2/(u + a)^2", U.replace(", y: {}", ""), 7, 6),
        # of the field of a monochromatic wave: p_x, p_y, E - p_z and two null rotations
        ("-m*sqrt(1 - x'^2 - y'^2 - z'^2) + a*cos(t - z)*x'", "[x, y, z]", 5, 5),
        ("-m*sqrt(1 - x'^2 - y'^2 - z'^2) + a*sin(b*(t + y))*z'", "[x, y, z]", 5, 5),
    ],
)
@pytest.mark.long
def test_plane_waves_have_a_heisenberg_algebra(L, coordinates, number, independent):
    derivation = derive(problem(L, coordinates, "m a b"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.independent) == (number, independent)
    assert found.integrable is True
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("u", ["1", "u"])
@pytest.mark.long
def test_a_number_is_no_special_strength_of_a_plane_wave(u):
    """With sin(u), or u^2, alone a = 1, or 2, had two charges that every a has with sin(sqrt(a) u)."""
    wave = f"u'*v' + x'^2/2 - a*u'^2*x^2/(2*{u}^2)"
    assert derive(problem(wave, U.replace(", y: {}", ""), "a")).special_cases == ()


@pytest.mark.parametrize(
    ("L", "number"),
    [
        ("(x'^2 + y'^2)/2 + (z' - x*y')^2/2", 5),
        ("m*(x'^2 + y'^2 + (z' + b*y*x')^2)/2", 5),
        ("(exp(2*z)*x'^2 + exp(-2*z)*y'^2 + z'^2)/2", 4),
        ("m*(exp(2*x/b)*y'^2 + exp(-2*x/b)*z'^2 + x'^2)/2", 4),
    ],
)
def test_nil_and_sol_have_all_their_isometries(L, number):
    derivation = derive(problem(L, "[x, y, z]", "m b"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.independent) == (number, 4)
    assert found.in_involution == 3
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(
    ("L", "coordinates", "name", "independent"),
    [
        ("m*(u'^2 + sin(u)^2*v'^2 + b*(w'^2 + sin(w)^2*s'^2))/2", "[u, v, w, s]", "so(4) + R", 6),
        (
            "m*(u'^2 + exp(2*u)*v'^2 + w'^2 + sin(w)^2*s'^2)/2",
            "[u, v, w, s]",
            "so(3) + sl(2,R) + R",
            6,
        ),
        (
            "-(s' + exp(x)*y')^2/2 + (x'^2 + exp(2*x)*y'^2/2 + z'^2)/2",
            "[s, x, y, z]",
            "Galilei in 1 dimension + sl(2,R) + R, modulo constants",
            6,
        ),
    ],
)
@pytest.mark.long
def test_products_of_spaces_have_the_isometries_of_each(L, coordinates, name, independent):
    derivation = derive(problem(L, coordinates, "m b"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.name, found.independent) == (7, name, independent)
    assert found.in_involution == 4
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(
    ("f", "g"), [("1 + a/r", "1/(1 + a/r)"), ("1/(1 - a^4/r^4)", "r^2*(1 - a^4/r^4)"), ("r", "r^4")]
)
@pytest.mark.long
def test_a_twisted_circle_over_a_sphere_has_the_rotations(f, g):
    """Gibbons, Manton, Nucl. Phys. B 274 (1986) 183 (Taub-NUT); Eguchi, Hanson, 1978."""
    L = f"m*({f})*(r'^2 + r^2*(u'^2 + sin(u)^2*v'^2))/2 + m*({g})*(w' + cos(u)*v')^2/2"
    derivation = derive(problem(L, "{r: {assume: positive}, u: {}, v: {}, w: {}}", "m a"))
    found = summary(derivation.discovery)
    assert (found.in_involution, found.integrable) == (4, True)
    assert "so(3)" in found.name
    assert min(digits_of(derivation).values()) > 20
