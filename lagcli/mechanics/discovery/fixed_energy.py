"""Integrals of T = w(q) T0 in a magnetic field, by the motion at a fixed energy in another time.

In the momenta p, w (H - E) = H0 - E w + w V with H0 of T0 and the same field.  With dt = w ds its
motions at the value 0 are those of H at the value E, so that an integral Q(q, p; E) for all E gives
Q(q, p; H).

References
----------
Hietarinta, Grammaticos, Dorizzi, Ramani, Phys. Rev. Lett. 53 (1984) 1707 (exchange of H and w).
Gibbons, Manton, Nucl. Phys. B 274 (1986) 183 (two monopoles: Kepler's vector).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.products import integral_of
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.fewer_coordinates import problem_of
from lagcli.mechanics.noether import Noether, NoetherCharge
from lagcli.mechanics.system import System
from lagcli.problem_data import Parameter, Problem

_ENERGY = "E_fixed"


def at_fixed_energy(system: System, w: Expr) -> Problem | None:
    """The problem of L0 + w (E - V), L0 with T0 = T/w; None where its letter is taken."""
    if _ENERGY in (*system.names, *(p.name for p in system.problem.parameters)):
        return None
    v = system.qdot
    still = dict.fromkeys(v, sympy.S.Zero)
    rest = system.L.xreplace(still)
    linear = dot(v, [system.L.diff(x).xreplace(still) for x in v])
    T0 = simplify((system.L - rest - linear) / w)
    L = T0 + linear + simplify(w * (rest + Symbol(_ENERGY, real=True)))
    parameters = (*system.problem.parameters, Parameter(name=_ENERGY))
    forces = [sympy.S.Zero] * len(v)
    return problem_of(system, range(len(v)), L, forces, parameters)


def in_the_first_time(
    noether: Noether, w: Expr, found: Iterable[NoetherCharge]
) -> Iterator[NoetherCharge]:
    """Q(q, p; H) of the integrals Q(q, p; E) that were found, with dQ/dp as their multipliers."""
    v = noether.system.qdot
    h, momenta = noether.energy.function, noether.dynamics.lagrange.momenta
    E = Symbol(_ENERGY, real=True)
    back = {E: h, **{x: w * x for x in v}}
    for charge in found:
        below = sympy.factor(sympy.denom(sympy.together(charge.charge)))
        factor = below.as_independent(E, as_Add=False)[1]
        given = (charge.charge, *charge.transformation.changes)
        whole, *moves = scaled([simplify(factor * x) for x in given], {*noether.system.parameters})
        shift = whole.diff(E).xreplace(back)
        along = zip(moves, v, strict=True)
        eta = tuple(simplify(x.xreplace(back) + shift * rate) for x, rate in along)
        whole = whole.xreplace(back)
        integral = integral_of(noether, eta, simplify(whole), dot(momenta, eta) - whole)
        if integral is not None:
            yield integral
