"""Integrals by the motion at a fixed energy in another time: Q(q, p; E) for all E gives Q(q, p; H).

Of T = w(q) T0 in a magnetic field: in the momenta p, w (H - E) = H0 - E w + w V with H0 of T0 and
the same field.  With dt = w ds its motions at the value 0 are those of H at the value E.

Of L = -sqrt(M^2 - v.B v) + A.v - V, as of a relativistic particle whose mass depends on the place:
(H - V)^2 = M^2 + M^2 (p - A).B^-1 (p - A), with dt = (H - V) ds.

References
----------
Hietarinta, Grammaticos, Dorizzi, Ramani, Phys. Rev. Lett. 53 (1984) 1707 (exchange of H and w).
Gibbons, Manton, Nucl. Phys. B 274 (1986) 183 (two monopoles: Kepler's vector).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.mechanics.discovery.fixed_values import FixedValues, problem_with
from lagcli.mechanics.system import System

_ENERGY = "E_fixed"
_E = Symbol(_ENERGY, real=True)


def has_fixed_energy(system: System) -> bool:
    """Whether it is such a problem already: its letter is taken."""
    return _ENERGY in (*system.names, *(p.name for p in system.problem.parameters))


def at_fixed_energy(system: System, w: Expr) -> FixedValues:
    """The problem of L0 + w (E - V), L0 with T0 = T/w."""
    rest, linear = _below_second_degree(system.L, system.qdot)
    T0 = simplify((system.L - rest - linear) / w)
    return _in_another_time(system, T0 + linear + simplify(w * (rest + _E)), w)


def relativistic(system: System) -> Iterator[FixedValues]:
    """The problem of L0 = v.B v/(2 M^2) + A.v + ((E - V)^2 - M^2)/2."""
    v = system.qdot
    roots = {p for p in system.L.atoms(sympy.Pow) if p.exp == sympy.Rational(1, 2) and p.has(*v)}
    if len(roots) != 1:
        return
    mark = Symbol("#root", positive=True)
    [root] = roots
    rest = sympy.expand(system.L.xreplace({root: mark}))
    factor = rest.coeff(mark, 1)
    other = rest - factor * mark
    potential, linear = _below_second_degree(other, v)
    square = sympy.expand(factor**2 * root.base)
    mass, first = _below_second_degree(square, v)
    if factor.has(*v) or other.has(mark) or is_zero(other - potential - linear) is not True:
        return
    inertia = mass - square
    if is_zero(first) is not True or not inertia.is_polynomial(*v) or is_zero(mass) is not False:
        return
    if sympy.Poly(inertia, *v).total_degree() != 2:
        return
    L = simplify(inertia / mass) / 2 + linear + simplify(((_E + potential) ** 2 - mass) / 2)
    yield _in_another_time(system, L, -mass / (factor * root))


def _below_second_degree(L: Expr, v: Sequence[Symbol]) -> tuple[Expr, Expr]:
    """What is left without velocities, and what is linear in them."""
    still = dict.fromkeys(v, sympy.S.Zero)
    return L.xreplace(still), dot(v, [L.diff(x).xreplace(still) for x in v])


def _in_another_time(system: System, L: Expr, w: Expr) -> FixedValues:
    """With dt = w ds."""
    v, kept = system.qdot, range(len(system.q))
    h = dot(v, [system.L.diff(x) for x in v]) - system.L  # with the roots of L as they are
    return FixedValues(
        problem_with(system, kept, L, [_ENERGY]),
        kept,
        {_E: h, **{x: w * x for x in v}},
        {_E: v},
        {_E: [sympy.S.Zero] * len(v)},
    )
