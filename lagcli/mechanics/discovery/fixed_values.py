"""Integrals that are found where constants of the motion have fixed values: the energy, or momenta.

With the momenta c of cyclic coordinates fixed, those of the others are the motions of Routh's

    R = L0 - (c - b) A^-1 (c - b)/2,    b + A q_c' = c,

so that an integral Q(q, p; c) for all c is one of L.  A is often what spoils the curvature of T: of
geodesics in five dimensions R is a charge in space.

References
----------
Whittaker, *Analytical Dynamics*, 4th ed., section 38.
Feher, Horvathy, Phys. Lett. B 183 (1987) 182 (the monopole in five dimensions).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.killing import known_factors
from lagcli.mechanics.discovery.names import own_name
from lagcli.mechanics.discovery.products import integral_of
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.fewer_coordinates import problem_of
from lagcli.mechanics.noether import Noether, NoetherCharge
from lagcli.mechanics.system import System
from lagcli.problem_data import Parameter, Problem
from lagcli.record import replace

Vector = Sequence[Expr]


@dataclass(frozen=True, slots=True)
class FixedValues:
    """The problem in which letters stand for constants of the motion.

    Attributes
    ----------
    kept
        Its coordinates, by their numbers.
    put_in
        What the letters, and its velocities, are in the whole problem.
    slopes
        dC/dp of the constant C that a letter stands for.
    field
        dp/dC of the momenta of the problem, at constant q and q'.
    """

    problem: Problem
    kept: Sequence[int]
    put_in: Mapping[Expr, Expr]
    slopes: Mapping[Symbol, Vector]
    field: Mapping[Symbol, Vector]

    def of_whole(self, noether: Noether, found: Iterable[NoetherCharge]) -> Iterator[NoetherCharge]:
        """Q(q, p; C) of the integrals that were found, with dQ/dp as their multipliers."""
        momenta = noether.dynamics.lagrange.momenta
        constants = {*noether.system.parameters, *self.slopes}
        for charge in found:
            below = sympy.factor(sympy.denom(sympy.together(charge.charge)))
            factor = below.as_independent(*self.slopes, as_Add=False)[1]
            given = (charge.charge, *charge.transformation.changes)
            whole, *moves = scaled([simplify(factor * x) for x in given], constants)
            eta: list[Expr] = [sympy.S.Zero] * len(momenta)
            for k, move in zip(self.kept, moves, strict=True):
                eta[k] = move.xreplace(self.put_in)
            for letter, slopes in self.slopes.items():
                shift = whole.diff(letter) - dot(moves, self.field[letter])
                shift = shift.xreplace(self.put_in)
                eta = [e + shift * slope for e, slope in zip(eta, slopes, strict=True)]
            whole = whole.xreplace(self.put_in)
            gauge = dot(momenta, eta) - whole
            integral = integral_of(noether, tuple(eta), simplify(whole), gauge)
            if integral is not None:
                yield replace(integral, name=own_name(charge.name))


def at_fixed_momenta(noether: Noether, equations: SlotEquations) -> Iterator[FixedValues]:
    """The problems of R where it has known isometries and T has not."""
    cyclic, n = noether.cyclic, len(equations.q)
    if n < 3 or known_factors(equations):
        return
    mass = sympy.Matrix(equations.mass)
    for count in range(1, min(len(cyclic), n - 2) + 1):
        for gone in combinations(cyclic, count):
            inverse = _inverse(mass, gone)
            if inverse is not None and known_factors(_inertia(equations, gone, inverse)):
                yield _without(noether, mass, gone, inverse)


def _inertia(equations: SlotEquations, gone: Sequence[int], inverse: sympy.Matrix) -> SlotEquations:
    """That of R, without forces."""
    kept = [k for k in range(len(equations.q)) if k not in gone]
    mass = sympy.Matrix(equations.mass)
    M = mass.extract(kept, kept) - mass.extract(kept, gone) * inverse * mass.extract(gone, kept)
    rows = tuple(tuple(map(simplify, M.row(k))) for k in range(len(kept)))
    q, v = (tuple(x[k] for k in kept) for x in (equations.q, equations.v))
    return replace(equations, q=q, v=v, mass=rows, forcing=(sympy.S.Zero,) * len(kept))


def _without(
    noether: Noether, mass: sympy.Matrix, gone: Sequence[int], inverse: sympy.Matrix
) -> FixedValues:
    """The problem of R."""
    system, n = noether.system, mass.rows
    kept = [k for k in range(n) if k not in gone]
    letters = [system.momenta[k] for k in gone]
    momenta = [noether.dynamics.lagrange.momenta[k] for k in gone]
    still = dict.fromkeys([system.qdot[k] for k in gone], sympy.S.Zero)
    rest = sympy.Matrix([c - p.xreplace(still) for c, p in zip(letters, momenta, strict=True)])
    L = simplify(system.L.xreplace(still) - (rest.T * inverse * rest)[0] / 2)
    field = inverse * mass.extract(gone, kept)
    return FixedValues(
        problem_with(system, kept, L, [c.name for c in letters]),
        kept,
        dict(zip(letters, momenta, strict=True)),
        {c: [sympy.Integer(i == k) for i in range(n)] for c, k in zip(letters, gone, strict=True)},
        {c: list(field.row(i)) for i, c in enumerate(letters)},
    )


def _inverse(mass: sympy.Matrix, gone: Sequence[int]) -> sympy.Matrix | None:
    A = mass.extract(gone, gone)
    return None if simplify(A.det()) == 0 else A.inv(method="ADJ").applyfunc(simplify)


def problem_with(system: System, kept: Sequence[int], L: Expr, letters: Sequence[str]) -> Problem:
    """That of another L without forces, with letters more."""
    parameters = (*system.problem.parameters, *(Parameter(name=x) for x in letters))
    return problem_of(system, kept, L, [sympy.S.Zero] * len(kept), parameters)
