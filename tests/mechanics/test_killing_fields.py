"""Isometries of metrics whose curvature is not constant: their number, and each put back.

Numbers: Stephani and others, *Exact Solutions of Einstein's Field Equations*, 2nd ed., chapters 8
and 12; Bardeen, Horowitz, Phys. Rev. D 60 (1999) 104030 (the throat of the extremal Kerr hole).
"""

from random import Random

import pytest
import sympy

from lagcli.mechanics.discovery.killing_fields import KillingFields
from lagcli.mechanics.discovery.killing_jets import KillingJets
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.summary import summary
from tests.oracle.constancy import digits_of

from .derived import derive

t, r, x, y, z, u, v, w = q = sympy.symbols("t r x y z u v w", real=True)
a, b, c = sympy.symbols("a b c", positive=True)
sin, cos, exp, sinh, cosh = sympy.sin, sympy.cos, sympy.exp, sympy.sinh, sympy.cosh


def metric(coordinates, *squares):
    """g of sum k (one-form)^2, each given as (k, components)."""
    n = range(len(coordinates))
    g = [[sympy.Add(*(k * f[i] * f[j] for k, f in squares)) for j in n] for i in n]
    return Metric(coordinates, g)


def sphere(radius, theta, phi, places):
    """radius^2 (d theta^2 + sin^2 theta d phi^2) among more coordinates."""
    one = [sympy.Integer(k == places[0]) for k in range(places[2])]
    other = [sympy.Integer(k == places[1]) for k in range(places[2])]
    return (radius**2, one), ((radius * sin(theta)) ** 2, other)


def complex_plane(k):
    """That of Fubini and Study, or of Bergman, in real coordinates: su(3) or su(2,1)."""
    N = 1 + k * (x**2 + y**2 + u**2 + v**2)
    units = [tuple(int(i == j) for j in range(4)) for i in range(4)]
    along = [(-k / N**2, form) for form in ((x, y, u, v), (-y, x, -v, u))]
    return metric((x, y, u, v), *((1 / N, form) for form in units), *along)


# name -> metric, isometries, whether something stretches it
KNOWN = {
    "hole": (
        metric((t, r, u, v), (-(1 - a / r), (1, 0, 0, 0)), (1 / (1 - a / r), (0, 1, 0, 0)),
               *sphere(r, u, v, (2, 3, 4))), 4, False),
    "Godel": (
        metric((t, x, y, z), (-1, (1, 0, exp(x), 0)), (1, (0, 1, 0, 0)),
               (exp(2 * x) / 2, (0, 0, 1, 0)), (1, (0, 0, 0, 1))), 5, False),
    "throat": (
        metric((t, r, u, v), (-r**2 * (1 + cos(u) ** 2), (1, 0, 0, 0)),
               ((1 + cos(u) ** 2) / r**2, (0, 1, 0, 0)), (1 + cos(u) ** 2, (0, 0, 1, 0)),
               (4 * sin(u) ** 2 / (1 + cos(u) ** 2), (r, 0, 0, 1))), 4, False),
    "warped anti-de Sitter": (
        metric((t, x, v), (-cosh(x) ** 2, (1, 0, 0)), (1, (0, 1, 0)), (a, (sinh(x), 0, 1))),
        4, False),
    "symmetric top": (
        metric((u, v, w), (a, (1, 0, 0)), (a * sin(u) ** 2, (0, 1, 0)), (b, (0, cos(u), 1))),
        4, False),
    "asymmetric top": (
        metric((u, v, w), (a, (cos(w), sin(u) * sin(w), 0)), (b, (-sin(w), sin(u) * cos(w), 0)),
               (c, (0, cos(u), 1))), 3, False),
    "cone over a sphere": (
        metric((r, u, v), (1, (1, 0, 0)), *sphere(a * r, u, v, (1, 2, 3))), 3, True),
    "Heisenberg": (
        metric((x, y, z), (1, (1, 0, 0)), (1, (0, 1, 0)), (a, (-y, 0, 1))), 4, False),
    "universe": (
        metric((t, x, y, z), (-1, (1, 0, 0, 0)),
               *((t**3, tuple(int(k == j) for k in range(4))) for j in (1, 2, 3))), 6, True),
    **{f"complex {name} plane": (complex_plane(k), 8, False)
       for name, k in (("projective", 1), ("hyperbolic", -1))},
    "nothing": (metric((x, y), (1 + x**4 + y**2, (1, 0)), (1 + x * y**3, (0, 1))), 0, False),
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_the_number_of_isometries_is_that_of_the_literature(name):
    g, number, stretched = KNOWN[name]
    jets = KillingJets(g, Allowance())
    assert (jets.isometries, jets.number) == (number, number + stretched)


@pytest.mark.parametrize("name", [name for name in KNOWN if name != "nothing"])
def test_all_are_found_and_change_the_metric_by_a_factor(name):
    g, number, stretched = KNOWN[name]
    fields = KillingFields(g, Allowance()).fields
    assert len(fields) == number + stretched
    draw = Random(name)
    constants = {k: sympy.Rational(draw.randint(11, 19), 7) for k in (a, b, c)}
    factors = set()
    for xi in fields:
        for _ in range(2):
            at = constants | {s: sympy.Rational(draw.randint(21, 29), 7) for s in g.q}
            changes = [
                lie(g, xi, i, j).subs(at).evalf(30) for i in range(g.n) for j in range(i + 1)
            ]
            entries = [g.g[i][j].subs(at).evalf(30) for i in range(g.n) for j in range(i + 1)]
            k = next(s / e for s, e in zip(changes, entries, strict=True) if e != 0)
            assert all(abs(s - k * e) < 1e-20 for s, e in zip(changes, entries, strict=True))
            factors.add(abs(k) > 1e-20)
    assert any(factors) is stretched


def lie(g, xi, i, j):
    """(L_xi g)_ij."""
    n = range(g.n)
    return sympy.Add(*(xi[k] * g.g[i][j].diff(g.q[k]) + g.g[k][j] * xi[k].diff(g.q[i])
                       + g.g[i][k] * xi[k].diff(g.q[j]) for k in n))  # fmt: skip


# of the first coordinate, on which the factors of the two one-forms depend, and the isometries
PLANES = {
    "sphere": (lambda x: (1, sin(x)), 3),
    "half plane": (lambda x: (1 / x, 1 / x), 3),
    "de Sitter": (lambda x: (1 / sympy.sqrt(1 - x**2), sympy.I * sympy.sqrt(1 - x**2)), 3),
    "catenoid": (lambda x: (cosh(x), cosh(x)), 1),
}


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.long) for k in (1, 2, 3))])
def test_a_product_has_the_isometries_of_its_factors(seed):
    """Of two lines those of their plane."""
    draw = Random(seed)
    (one, first), (other, second) = draw.sample(list(PLANES.values()), 2)
    scale, forms = draw.choice([1, a, 3]), (*one(x), *other(u))
    squares = [
        ((scale if k < 2 else 1) * f**2, tuple(int(k == j) for j in range(4)))
        for k, f in enumerate(forms)
    ]
    assert len(KillingFields(metric((x, y, u, v), *squares), Allowance()).fields) == first + second
    lines = ((1, (0, 0, 1, 0)), (draw.choice([1 / w**2, exp(w), 1 + w**2]), (0, 0, 0, 1)))
    plane = KillingFields(metric((x, y, z, w), *squares[:2], *lines), Allowance())
    assert len(plane.fields) == plane.isometries == first + 3


@pytest.mark.parametrize("seed", range(4))
def test_a_throat_of_any_profile_has_four(seed):
    """f(u) (-r^2 dt^2 + dr^2/r^2 + du^2) + h(u) (dv + k r dt)^2 has sl(2,R) and d/dv."""
    draw = Random(seed)
    f = 1 + draw.choice([cos(u) ** 2, u**2, exp(2 * u), sinh(u) ** 2])
    h = draw.choice([sin(u) ** 2, 2 + u**2, exp(u)]) / f
    k = draw.choice([1, 2, a])
    g = metric((t, r, u, v), (-f * r**2, (1, 0, 0, 0)), (f / r**2, (0, 1, 0, 0)),
               (f, (0, 0, 1, 0)), (h, (k * r, 0, 0, 1)))  # fmt: skip
    assert len(KillingFields(g, Allowance()).fields) == 4


@pytest.mark.long
def test_a_body_of_revolution_in_a_fluid_is_integrable_by_its_momenta():
    """e(3), the energy and p_psi: Kirchhoff; Lamb, *Hydrodynamics*, 6th ed., section 126."""
    discovery = derive("""
coordinates: [x, y, z, phi, theta, psi]
parameters: {A: {assume: positive}, C: {assume: positive}, a: {assume: positive},
  c: {assume: positive}}
definitions:
  n: x'*sin(theta)*sin(phi) - y'*sin(theta)*cos(phi) + z'*cos(theta)
T: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2
  + a*(x'^2 + y'^2 + z'^2)/2 + (c - a)*n^2/2
""").discovery
    found = summary(discovery)
    assert (found.independent, found.integrable) == (8, True)
    assert "e(3)" in (found.name or "")


@pytest.mark.parametrize("seed", range(4))
def test_what_stretches_a_cone_has_the_times_of_an_oscillator(seed):
    """r = x^n of dr^2 + r^2 dl^2 with V = k r^2/2 + h/r^2: E and two more, sl(2,R), as of r alone.

    De Alfaro, Fubini, Furlan, Nuovo Cim. A 34 (1976) 569.
    """
    draw = Random(seed)
    n, sign = draw.choice([2, 3, "3/2"]), draw.choice(["", "-"])
    profile = draw.choice(["exp(2*u)", "(1 + u^2)", "(2 + sin(u))"])
    square = f"({n})^2*x^(2*({n}) - 2)*x'^2 + x^(2*({n}))*(u'^2 + {profile}*w'^2)"
    V = f"{sign}k*x^(2*({n}))/2 + h/x^(2*({n}))"
    derivation = derive(
        "{coordinates: {x: {assume: positive}, u: {}, w: {}},"
        f" parameters: {{k: {{assume: positive}}, h: {{}}}}, T: ({square})/2, V: {V}}}"
    )
    timed = [
        c
        for c in derivation.discovery.point_charges
        if derivation.system.t in c.charge.free_symbols
    ]
    assert len(timed) == 2
    assert min(digits_of(derivation).values()) > 20
    # with that of the half plane, so(2,2)
    name = summary(derivation.discovery).name
    assert name == "so(2,2)" if "exp" in profile else "sl(2,R)" in name
