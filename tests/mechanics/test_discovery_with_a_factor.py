"""Integrals of second degree where T = w(q) T0 and T0 has known Killing vectors; and their algebra.

Liouville, J. Math. Pures Appl. 11 (1846) 345; Koenigs, in Darboux, *Lecons sur la theorie generale
des surfaces* IV (1896) 368; Jacobi, J. reine angew. Math. 19 (1839) 309 (the ellipsoid);
Ballesteros, Enciso, Herranz, Ragnisco, Physica D 237 (2008) 505 (oscillator on a curved space);
Kalnins, Kress, Miller, Winternitz, J. Math. Phys. 44 (2003) 5811 (spaces of Darboux);
Evans, Phys. Rev. A 41 (1990) 5666 (three integrals beside the energy).
"""

import random

import pytest
import sympy

from lagcli.mechanics.discovery.summary import summary
from tests.oracle.constancy import digits_of

from .derived import derive
from .test_discovery_literature import POS, problem

pytestmark = pytest.mark.long  # of discovery, test_discovery.py is what runs before a commit

SQUARES = "(x'^2 + y'^2)"


def _liouville(seed):
    """T = (F + G)(x'^2 + y'^2)/2, V = (f + g)/(F + G)."""
    draw = random.Random(seed)
    F, f = (draw.choice(("x^2", "exp(x)", "x^4 + 1", "cosh(x)")) for _ in range(2))
    G, g = (draw.choice(("y^2", "y^4 + 2", "exp(2*y)", "y^6 + y^2")) for _ in range(2))
    a, b = draw.randint(2, 5), draw.randint(2, 5)
    return f"({F} + {a}*({G}))*{SQUARES}/2 - ({b}*({f}) + {g})/({F} + {a}*({G}))"


@pytest.mark.parametrize("seed", range(3))
def test_coordinates_of_liouville_separate(seed):
    text = problem(_liouville(seed), parameters="m")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (2, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(("L", "coordinates", "independent"), [
    (f"m*x*{SQUARES}", "[x, y]", 4),  # with a dilation
    (f"m*(1 + b/x^2)*{SQUARES}/2", "[x, y]", 3),
    ("m*(exp(-x) + b*exp(-2*x))*(x'^2 + y'^2)/2", "[x, y]", 3),
    (f"(1 + b*(x^2 + y^2))*{SQUARES}/2 - k*(x^2 + y^2)/(2*(1 + b*(x^2 + y^2)))", "[x, y]", 3),
    (f"(b + cos(x))*{SQUARES}/(2*sin(x)^2)", "[x, y]", 3),
    ("(r'^2 + r^(2/3)*phi'^2)/2 - k/r^(2/3)", f"{{r: {POS}, phi: {{}}}}", 3),  # by its arc length
    ("(1 + b/r)*(r'^2 + r^2*phi'^2)/2 - k/(r + b)", f"{{r: {POS}, phi: {{}}}}", 3),
])  # fmt: skip
def test_surfaces_of_koenigs_have_two_integrals_beside_a_momentum(L, coordinates, independent):
    text = problem(L, coordinates, "m b k")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (independent, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("axes", [(1, 2, 3), (2, 5, 7)])
@pytest.mark.long
def test_an_ellipsoid_in_its_own_coordinates(axes):
    u, v = (f"{x}/(({axes[0]} - {x})*({axes[1]} - {x})*({axes[2]} - {x}))" for x in "uv")
    text = problem(f"(u - v)*({u}*u'^2 - {v}*v'^2)/8 - k*(u + v)", "[u, v]", "k")
    found = summary(derive(text).discovery)
    assert (found.independent, found.name, found.integrable) == (2, "R^2", True)


@pytest.mark.parametrize("V", [
    "(x^2 + y^2 + z^2)^2 + a/x^2 + b/y^2 + c/z^2", "exp(x^2 + y^2 + z^2) + b/y^2 + c/z^2",
])  # fmt: skip
def test_a_sum_of_integrals_makes_three_in_involution(V):
    text = problem(f"(x'^2 + y'^2 + z'^2)/2 - ({V})", "[x, y, z]", "a b c")
    found = summary(derive(text).discovery)
    assert (found.in_involution, found.integrable) == (3, True)


@pytest.mark.parametrize("constant", ["- 3", "+ 2*m"])
def test_the_sign_of_the_energy_names_no_algebra_where_V_does_not_vanish_far_away(constant):
    text = problem(f"m*{SQUARES}/2 + k/sqrt(x^2 + y^2) {constant}", parameters="m k")
    found = summary(derive(text).discovery)
    assert (found.dimension, found.name, found.independent) == (2, "R^2", 3)


MONOPOLES = {
    "spherical": (f"{{r: {POS}, theta: {{}}, phi: {{}}}}", "r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2",
                  "cos(theta)*phi'", "r"),
    "cylindrical": (f"{{s: {POS}, phi: {{}}, z: {{}}}}", "s'^2 + s^2*phi'^2 + z'^2",
                    "z/sqrt(s^2 + z^2)*phi'", "sqrt(s^2 + z^2)"),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", MONOPOLES)
def test_two_monopoles_keep_the_runge_lenz_vector(name):
    """Gibbons, Manton, Nucl. Phys. B 274 (1986) 183."""
    coordinates, rates, field, r = MONOPOLES[name]
    L = f"(1 + b/{r})*({rates})/2 + g*b*{field} - g^2*b/(2*{r})"
    derivation = derive(problem(L, coordinates, "b|g"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.independent, found.integrable) == (7, 5, True)
    assert min(digits_of(derivation).values()) > 20


MASSES = {
    "m^2 + 2*m*k/sqrt(x^2 + y^2)": {"runge_lenz_x", "runge_lenz_y"},
    "m^2 + k*(x^2 + 4*y^2)": {"energy_x"},
    "m^2 + k/x^2 + m^2*y^2": {"energy_x"},
}


@pytest.mark.parametrize("square", MASSES)
@pytest.mark.parametrize("shape", ["-sqrt(M)*sqrt(1 - v2/c^2)", "-c^2*sqrt(M - M*v2)"])
def test_a_relativistic_particle_whose_mass_depends_on_the_place(square, shape):
    """H^2 = p^2 + M(q)^2 has the integrals of p^2/2 + M^2/2, with p = dL/dv."""
    L = shape.replace("M", f"({square})").replace("v2", "(x'^2 + y'^2)")
    found = derive(
        f'{{coordinates: [x, y], parameters: {{m: {POS}, k: {POS}, c: {POS}}}, L: "{L}"}}'
    )
    new = [c for c in found.discovery.charges if c.name not in {"energy", "L_z"}]
    assert new
    names = {c.name for c in new}
    assert MASSES[square] <= names or len(MASSES[square]) == len(names)
    assert all(c.conserved and c.verified == "exact" for c in new)
    assert summary(found.discovery).integrable


PLANE = "(x'^2 + y'^2)/2"
#: L0 and U of a problem with L0 - c^2 U/2 at a fixed momentum c, its coordinates and independent integrals
AT_FIXED_MOMENTUM = {
    "kepler": (PLANE, "{b} + {k}/sqrt(x^2 + y^2)", "x, y", 4),
    "winternitz": (PLANE, "{k}*(x^2 + y^2) + {b}/x^2", "x, y", 4),
    "koenigs": (
        "(1 + {b}/r)*(r'^2 + r^2*phi'^2)/2", "1 + {k}/(r + {b})", f"r: {POS}, phi: {{}}", 4),
}  # fmt: skip


@pytest.mark.parametrize("letters", [True, False])
@pytest.mark.parametrize("name", AT_FIXED_MOMENTUM)
def test_a_cyclic_coordinate_carries_a_superintegrable_potential(name, letters):
    """R = L0 - c^2 U/2 + c A.q' of L0 + (psi' + A.q')^2/(2 U), here with an A = grad a."""
    draw = random.Random(f"{name} {letters}")
    L0, U, coordinates, independent = AT_FIXED_MOMENTUM[name]
    b, k = ("b", "k") if letters else (draw.randint(1, 5), draw.randint(1, 5))
    x, a = coordinates[0], draw.randint(-2, 2)
    L0, U = L0.format(b=b), U.format(b=b, k=k)
    L = f"{L0} + (psi' + {a}*{x}*{x}')^2/(2*({U}))"
    assume = coordinates if ":" in coordinates else "x: {}, y: {}"
    derivation = derive(problem(L, f"{{{assume}, psi: {{}}}}", "b k"))
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (independent, True)
    assert "at fixed momenta" in derivation.discovery.ansatz
    assert min(digits_of(derivation).values()) > 20


def test_the_momenta_of_two_cyclic_coordinates_may_be_fixed_together():
    """McIntosh, Cisneros, J. Math. Phys. 11 (1970) 896: r' x J + ... with c^2/(2 r^2) and -d^2 k/r."""
    coordinates, rates, field, _ = MONOPOLES["spherical"]
    L = f"({rates})/2 + r^2*(psi' + {field})^2/2 + r*chi'^2/k"
    derivation = derive(problem(L, f"{coordinates[:-1]}, psi: {{}}, chi: {{}}}}", "k"))
    assert summary(derivation.discovery).independent == 9
    assert len(derivation.discovery.hidden_charges) == 3
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("b", ["b", "3"])
def test_the_monopole_in_five_dimensions_keeps_the_runge_lenz_vector(b):
    """Feher, Horvathy, Phys. Lett. B 183 (1987) 182: its z-component along an independent motion."""
    coordinates, rates, field, r = MONOPOLES["spherical"]
    w = f"(1 + {b}/{r})"
    L = f"{w}*({rates})/2 + {b}^2*(psi' + {field})^2/(2*{w})"
    derivation = derive(problem(L, f"{coordinates[:-1]}, psi: {{}}}}", "b"))
    discovery, system = derivation.discovery, derivation.system
    found = summary(discovery)
    assert (len(discovery.charges), found.independent, found.in_involution) == (8, 6, 4)
    assert min(digits_of(derivation).values()) > 20
    [vector] = [c for c in discovery.hidden_charges if system.q[2] not in c.charge.free_symbols]
    (r, theta, _, _), v = system.q, system.qdot
    size = system.parameters[0] if b == "b" else sympy.Integer(3)
    w, p = 1 + size / r, system.L.diff(v[3])
    square = v[0] ** 2 + r**2 * v[1] ** 2 + r**2 * sympy.sin(theta) ** 2 * v[2] ** 2
    energy = w * square / 2 + p**2 * w / (2 * size**2)
    textbook = (
        r * sympy.cos(theta) * w**2 * square
        - w**2 * r * v[0] * (v[0] * sympy.cos(theta) - r * sympy.sin(theta) * v[1])
        - p * w * r * sympy.sin(theta) ** 2 * v[2]
        - (size * energy - p**2 / size) * sympy.cos(theta)
    )
    ratio = sympy.simplify(vector.charge / textbook)
    assert not ratio.free_symbols & {*system.q, *v}
