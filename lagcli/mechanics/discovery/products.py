"""Energies of parts, and integrals that are products of others: those of the modes stand for them.

Q_a Q_b has the multipliers Q_a eta_b + Q_b eta_a, where dQ/dt = sum eta_j (left side j).
Q_cos^2 + Q_sin^2 = 2 mu E of a mode xi cos(omega t), with mu = xi M xi.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.point import with_gauge
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import content_of
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation

Vector = tuple[Expr, ...]


def products_of(
    charges: Sequence[NoetherCharge], linear: Sequence[NoetherCharge], eta: Mapping[int, Vector]
) -> list[Vector]:
    """The multipliers `eta` of charges, and those of the products of two of the linear ones."""
    return [
        *(eta[id(c)] for c in charges),
        *(
            tuple(a.charge * y + b.charge * x
                  for x, y in zip(eta[id(a)], eta[id(b)], strict=True))
            for a, b in combinations_with_replacement(linear, 2)
        ),
    ]  # fmt: skip


class Products:
    """What follows from the charges of point symmetries, those with the time among them."""

    def __init__(
        self, noether: Noether, points: Sequence[NoetherCharge], allowed: Allowance
    ) -> None:
        self.noether = noether
        self.allowed = allowed
        self._linear = [
            c for c in points if c.transformation.displaces_without(noether.system.qdot)
        ]
        self._eta = {id(c): self._multipliers(c) for c in points}
        self._known = products_of(points, self._linear, self._eta)

    def includes(self, charge: NoetherCharge) -> bool:
        """Whether it is a combination of them and of products of two of them."""
        return not self._beyond(self._known, charge)

    def charge_of(self, transformation: Transformation) -> NoetherCharge | None:
        """That of a point symmetry whose charge is a sum of products of two known ones."""
        noether, system = self.noether, self.noether.system
        pairs = list(combinations_with_replacement(self._linear, 2))
        vectors = products_of((), self._linear, self._eta)
        moved = [-x for x in noether.characteristic(transformation)]
        variables = (system.t, *system.q, *system.qdot)
        try:
            factors = Relation([*vectors, moved], variables, self.allowed).of_last()
        except (NoPoint, ZeroDivisionError):
            return None
        if factors is None:
            return None
        whole = dot(factors, [a.charge * b.charge for a, b in pairs])
        zero = noether.charge("", "discovered", transformation, sympy.S.Zero)
        return with_gauge(noether, transformation, simplify(zero.charge - whole))

    def modes(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """The energies of single modes that are no combinations of the known charges."""
        found = list(self._energies())
        return [
            charge for k, charge in enumerate(found)
            if self._beyond([self._multipliers(c) for c in (*known, *found[:k])], charge)
        ]  # fmt: skip

    def _multipliers(self, charge: NoetherCharge) -> Vector:
        return self.noether.characteristic(charge.transformation)

    def _beyond(self, known: Sequence[Vector], charge: NoetherCharge) -> bool:
        system = self.noether.system
        vectors = [*known, self._multipliers(charge)]
        relation = Relation(vectors, [system.t, *system.q, *system.qdot], self.allowed)
        return len(vectors) - 1 in relation.independent()

    def _energies(self) -> Iterator[NoetherCharge]:
        system = self.noether.system
        momenta = self.noether.dynamics.lagrange.momenta
        for a, b in combinations(self._linear, 2):
            xi, other = self._amplitude(a), self._amplitude(b)
            if xi is None or other is None or type(*_turns(a)) is type(*_turns(b)):
                continue
            if any(is_zero(x - y) is not True for x, y in zip(xi, other, strict=True)):
                continue
            mu = dot(xi, [p.xreplace(dict(zip(system.qdot, xi, strict=True))) for p in momenta])
            along = [a.charge * x + b.charge * y
                     for x, y in zip(self._eta[id(a)], self._eta[id(b)], strict=True)]  # fmt: skip
            eta = tuple(simplify(e / mu) for e in along)
            whole = simplify((a.charge**2 + b.charge**2) / (2 * mu))
            if system.t in sympy.Tuple(whole, *eta).free_symbols:
                continue
            charge = integral_of(self.noether, eta, whole, dot(momenta, eta) - whole)
            if charge is not None:
                yield charge

    def _amplitude(self, charge: NoetherCharge) -> Vector | None:
        """Xi of a displacement xi cos(omega t) or xi sin(omega t) with constant xi."""
        turns = _turns(charge)
        if len(turns) != 1:
            return None
        [turn] = turns
        xi = tuple(sympy.cancel(e / turn) for e in charge.transformation.changes)
        moving = {self.noether.system.t, *self.noether.system.q}
        return xi if moving.isdisjoint(sympy.Tuple(*xi).free_symbols) else None


def _turns(charge: NoetherCharge) -> set[Expr]:
    return {*sympy.Tuple(*charge.transformation.changes).atoms(sympy.sin, sympy.cos)}


def energies_of_parts(noether: Noether) -> Iterator[NoetherCharge]:
    """Of coordinates that no term of L has together with others: L = L1(x, x') + L2(y, y')."""
    system = noether.system
    rate = dict(zip(system.q, system.qdot, strict=True))
    terms = [(t, t.free_symbols) for t in sympy.Add.make_args(sympy.expand(system.L))]
    own = [{q for q, v in rate.items() if {q, v} & symbols} for _, symbols in terms]
    edges = [pair for each in own for pair in combinations(each, 2)]
    parts = sympy.utilities.iterables.connected_components((list(system.q), edges))
    for part in parts if len(parts) > 1 else ():
        L = sympy.Add(*(t for (t, _), coordinates in zip(terms, own, strict=True)
                        if coordinates & {*part}))  # fmt: skip
        if free_of(L, [system.t]):
            eta = tuple(v if q in part else sympy.S.Zero for q, v in rate.items())
            whole = dot([L.diff(v) for v in rate.values()], eta) - L
            charge = integral_of(noether, eta, whole, L)
            if charge is not None:
                yield charge


def integral_of(noether: Noether, eta: Vector, whole: Expr, gauge: Expr) -> NoetherCharge | None:
    """Q where dQ/dt = sum eta_j (d/dt dL/dq_j' - dL/dq_j) identically: then 0 on the motion."""
    left_sides = noether.dynamics.lagrange.left_sides
    system = noether.system
    left = system.total_derivative(whole) - dot(eta, left_sides)
    if not _vanishes(left, {system.t, *system.q, *system.parameters}):
        return None
    content = content_of([*eta, whole], frozenset(system.parameters) - _masses(noether))
    return NoetherCharge(
        "",
        "discovered",
        Transformation(tuple(simplify(e / content) for e in eta), sympy.S.Zero),
        gauge / content,
        whole / content,
        conserved=True,
        rate=sympy.S.Zero,
        verified="exact",
        broken_by="",
    )


def _masses(noether: Noether) -> set[Expr]:
    """Letters of which an inertia is a multiple: p_x p_y is m² x' y'."""
    inertia = (row[j] for j, row in enumerate(noether.dynamics.lagrange.mass_matrix))
    factors = (f for m in inertia for f in sympy.Mul.make_args(simplify(m)))
    return {factor.as_base_exp()[0] for factor in factors}


def _vanishes(formula: Expr, still: set[Symbol]) -> bool:
    """Whether it is 0: each coefficient of the velocities and accelerations, or else the whole.

    Of sinh(x - y), sinh(y - z), ... a coefficient is a short fraction in exponentials.
    """
    parts: dict[Expr, Expr] = {}
    for term in sympy.Add.make_args(sympy.expand_mul(formula)):
        moving = [f for f in sympy.Mul.make_args(term) if f.free_symbols - still]
        rate = sympy.Mul(*moving)
        parts[rate] = parts.get(rate, sympy.S.Zero) + term / rate
    return all(is_zero(c) for c in parts.values()) or is_zero(formula) is True
