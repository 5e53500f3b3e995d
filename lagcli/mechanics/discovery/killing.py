"""Killing vectors of the kinetic energy, or of what is left of it without a factor w(q).

References
----------
Thompson, J. Math. Phys. 27 (1986) 2693 (Killing tensors in spaces of constant curvature).
Perelomov, *Integrable Systems of Classical Mechanics and Lie Algebras*, vol. I, section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.hidden import is_gyroscopic
from lagcli.mechanics.discovery.isometries import Isometries, Vector
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.slots import SlotEquations

_COORDINATES = (2, 3)


@dataclass(frozen=True, slots=True)
class KillingFrame:
    """Killing vectors of T0, those among them that span the space, and its coordinates X.

    Attributes
    ----------
    factor
        w of T = w T0.
    squares
        Killing tensors A B where the vectors themselves are not elementary.
    """

    fields: Sequence[Vector]
    spanning: Sequence[Vector]
    X: Sequence[Expr]
    factor: Expr = sympy.S.One
    squares: Sequence[tuple[Vector, ...]] = ()

    @classmethod
    def of(cls, equations: SlotEquations, isometries: Isometries | None) -> KillingFrame | None:
        """For constant M, or constant curvature, where the forces are those of a V(q)."""
        entries = sympy.Tuple(*(m for row in equations.mass for m in row))
        fixed = free_of(sympy.Tuple(entries, *equations.forcing), [equations.t])
        if not fixed or is_gyroscopic(equations):
            return None
        if free_of(entries, [*equations.q, *equations.v]):
            shifts = _units(len(equations.q))
            return cls([*shifts, *_rotations(equations)], shifts, equations.q)
        if isometries is None or not isometries.functions:
            return None
        spanning = isometries.translations or isometries.rotations
        return cls(isometries.fields, spanning, isometries.functions)

    @classmethod
    def without_factor(cls, equations: SlotEquations, allowed: Allowance) -> Iterator[KillingFrame]:
        """For T = w T0 with T0 of constant curvature, or a sum of squares of own coordinates."""
        for w in _common_factors(equations):
            rows = (tuple(simplify(m / w) for m in row) for row in equations.mass)
            given = replace(equations, mass=tuple(rows))
            curved = Isometries(given, sympy.S.Zero, allowed) if Isometries.apply(given) else None
            frame = cls.of(given, curved) or cls._of_squares(given)
            if frame is not None:
                yield replace(frame, factor=w)

    @classmethod
    def _of_squares(cls, equations: SlotEquations) -> KillingFrame | None:
        """p_i^2/g_ii for T0 = sum g_ii(q_i) q_i'^2/2."""
        q, mass, units = set(equations.q), equations.mass, _units(len(equations.q))
        if is_gyroscopic(equations) or any(
            m.free_symbols & q - {x} if i == k else m != 0
            for k, (x, row) in enumerate(zip(equations.q, mass, strict=True))
            for i, m in enumerate(row)
        ):
            return None
        squares = [(e, tuple(x / mass[k][k] for x in e)) for k, e in enumerate(units)]
        return cls((), (), equations.q, squares=squares)

    def products(self, degree: int) -> Iterable[tuple[Vector, ...]]:
        """Killing tensors as symmetric products A B ..."""
        return self.squares or combinations_with_replacement(self.fields, degree)


def _units(n: int) -> list[Vector]:
    return [tuple(sympy.Integer(i == k) for i in range(n)) for k in range(n)]


def _rotations(equations: SlotEquations) -> list[Vector]:
    """X_i e_k - X_k e_i, X = M q."""
    X = [dot(row, equations.q) for row in equations.mass]
    found = []
    for i, k in combinations(range(len(X)), 2):
        field: list[Expr] = [sympy.S.Zero] * len(X)
        field[i], field[k] = -X[k], X[i]
        found.append(tuple(field))
    return found


def _common_factors(equations: SlotEquations) -> list[Expr]:
    """w: M_kk, the factors with coordinates that all M_ik have in common, and sums among them."""
    if len(equations.q) not in _COORDINATES:
        return []
    entries = [sympy.factor(m) for row in equations.mass for m in row if m != 0]
    shared = set.intersection(*(set(sympy.Mul.make_args(e)) for e in entries))
    moving = [f for f in shared if not free_of(f, equations.q)]
    sums = [f for f in moving if f.as_base_exp()[0].is_Add]
    own = [row[k] for k, row in enumerate(equations.mass) if moving]
    return [w for w in dict.fromkeys((*own, sympy.Mul(*moving), sympy.Mul(*sums))) if w != 1]
