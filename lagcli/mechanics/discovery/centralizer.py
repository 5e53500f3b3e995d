"""Symmetries made invariant under the total momenta: relative angular momentum and the like.

Two bodies have the rotation of all, the rotation about the centre of mass and their
difference; the basis with fewest entries has a mixture.  Where a combination with other
time-independent rotations commutes with all translations, it is taken instead: with the
components Y X_a of a displacement Y along Cartesian X_a, those of P are constant, and [Y, P] = 0
is P (Y X_a) = 0.
Of two with one stretching of time the difference leaves the time: of two dilations of a falling
body in oblique coordinates, the rotation.
Likewise the charges p_i - F_i t of a uniform force have combinations without the time, and so have
two dilations of a free point in oblique coordinates, their rotation.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.listing import times
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.noether import NoetherCharge, Transformation
from lagcli.mechanics.system import System
from lagcli.record import replace


def centralized(
    transformations: Sequence[Transformation],
    system: System,
    allowed: Allowance,
    lengths: Sequence[Expr] = (),
) -> list[Transformation]:
    """The same space of symmetries, with the last rotations made to commute with translations.

    The `lengths` are Cartesian coordinates, where those of the system are not.
    """
    result = list(transformations)
    q = system.q
    static = [k for k, x in enumerate(result) if x.displaces_without([system.t])]
    along = {k: _along(result[k].changes, q, lengths) for k in static}
    momenta = [k for k in static if free_of(sympy.Tuple(*along[k]), q)]
    turns = [k for k in static if k not in momenta]
    joint = [k for k in momenta if sum(c != 0 for c in along[k]) > 1]
    if not joint or len(turns) < 2:
        return result
    vectors: list[list[Expr]] = [
        [dot(result[m].changes, [e.diff(x) for x in q]) for m in joint for e in along[k]]
        for k in turns
    ]
    for values in Relation(vectors, [system.t, *system.q], allowed).all():
        if len(values) < 2:
            continue
        columns = zip(*(result[turns[i]].changes for i in values), strict=True)
        changes = scaled([dot(list(values.values()), c) for c in columns], set(system.parameters))
        last = turns[max(values)]
        result[last] = Transformation(changes, sympy.S.Zero)
        for k in turns:
            if k != last:
                result[k] = _sparser(result[k], result[last], system)
    return result


def with_one_stretching(
    transformations: Sequence[Transformation], system: System
) -> list[Transformation]:
    """The same space, in which no two displace the time by multiples of one function."""
    result = list(transformations)
    constants = set(system.parameters)
    for k, last in enumerate(result):
        for first in result[:k]:
            if last.time == 0 or first.time == 0:
                continue
            ratio = sympy.cancel(last.time / first.time)
            if ratio.free_symbols <= constants:
                pairs = zip(last.changes, first.changes, strict=True)
                changes = scaled([sympy.expand(a - ratio * b) for a, b in pairs], constants)
                result[k] = Transformation(changes, sympy.S.Zero)
                break
    return result


def _along(changes: Sequence[Expr], q: Sequence[Symbol], lengths: Sequence[Expr]) -> Sequence[Expr]:
    """The components along Cartesian coordinates."""
    return [simplify(dot(changes, [X.diff(x) for x in q])) for X in lengths] or changes


def _sparser(turn: Transformation, central: Transformation, system: System) -> Transformation:
    """The turn plus that multiple of another that leaves the fewest coefficients: L of all."""

    def slopes(changes: Sequence[Expr]) -> list[Expr]:
        return [sympy.expand(e.diff(x)) for e in changes for x in system.q]

    def entries(changes: Sequence[Expr]) -> int:
        return sum(e != 0 for e in slopes(changes))

    best = turn
    pairs = zip(slopes(turn.changes), slopes(central.changes), strict=True)
    for ratio in dict.fromkeys(sympy.cancel(a / b) for a, b in pairs if a != 0 and b != 0):
        if ratio.free_symbols & set(system.q):
            continue
        sums = zip(turn.changes, central.changes, strict=True)
        changes = [sympy.expand(sympy.cancel(a - ratio * b)) for a, b in sums]
        if entries(changes) < entries(best.changes):
            best = Transformation(scaled(changes, set(system.parameters)), sympy.S.Zero)
    return best


def without_time(
    charges: Sequence[NoetherCharge], system: System, allowed: Allowance
) -> list[NoetherCharge]:
    """The same space of charges, with combinations that have no t."""
    t, result = system.t, list(charges)
    chosen = [k for k, c in enumerate(result) if t in c.charge.free_symbols]
    if len(chosen) < 2:
        return result
    rates = [[result[k].charge.diff(t)] for k in chosen]
    for values in Relation(rates, [t, *system.q, *system.qdot], allowed).all():
        if len(values) > 1:
            factors = scaled(list(values.values()), set(system.parameters))
            parts = [result[chosen[i]] for i in values]
            result[chosen[max(values)]] = _combined(parts, factors, set(system.parameters))
    return result


def _combined(
    charges: Sequence[NoetherCharge], factors: Sequence[Expr], constants: set[Symbol]
) -> NoetherCharge:
    """The sum of multiples of charges, with short coefficients."""

    def total(values: Sequence[Expr | None]) -> Expr:
        return sympy.expand(dot(factors, [x or sympy.S.Zero for x in values]))

    given = [c.transformation for c in charges]
    changes = [total(column) for column in zip(*(x.changes for x in given), strict=True)]
    whole = [*changes, total([x.time for x in given])]
    factor = next(
        (
            simplify(new / old)
            for new, old in zip(scaled(whole, constants), whole, strict=True)
            if old
        ),
        sympy.S.One,
    )
    return times(
        replace(
            charges[-1],
            transformation=Transformation(tuple(changes), whole[-1]),
            gauge=total([c.gauge for c in charges]),
            charge=total([c.charge for c in charges]),
        ),
        factor,
    )
