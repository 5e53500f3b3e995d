"""Killing vectors of the kinetic energy, or of what is left of it without a factor w(q).

References
----------
Thompson, J. Math. Phys. 27 (1986) 2693 (Killing tensors in spaces of constant curvature).
Perelomov, *Integrable Systems of Classical Mechanics and Lie Algebras*, vol. I, section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.linear import unit_vectors
from lagcli.mechanics.discovery.ansatz import affine, quadratic_unknowns
from lagcli.mechanics.discovery.constant_curvature import Vector
from lagcli.mechanics.discovery.hidden import is_gyroscopic
from lagcli.mechanics.discovery.isometries import Isometries
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.search import Search
from lagcli.mechanics.discovery.slots import SlotEquations, combined, point_slots
from lagcli.record import replace

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
    accelerations
        q'' of T alone where those that span are no Killing vectors but the M^-1 e_k, with A.p = q'.
    """

    fields: Sequence[Vector]
    spanning: Sequence[Vector]
    X: Sequence[Expr]
    factor: Expr = sympy.S.One
    squares: Sequence[tuple[Vector, ...]] = ()
    accelerations: Sequence[Expr] = ()

    @classmethod
    def of(cls, equations: SlotEquations, isometries: Isometries | None) -> KillingFrame | None:
        """For constant M, or constant curvature, where the forces are those of a V(q)."""
        entries = sympy.Tuple(*(m for row in equations.mass for m in row))
        fixed = free_of(sympy.Tuple(entries, *equations.forcing), [equations.t])
        if not fixed or is_gyroscopic(equations):
            return None
        if free_of(entries, [*equations.q, *equations.v]):
            shifts = unit_vectors(len(equations.q))
            return cls([*shifts, *_rotations(equations)], shifts, equations.q)
        if isometries is None or not isometries.functions:
            return None
        spanning = isometries.translations or isometries.rotations
        return cls(isometries.fields, spanning, isometries.functions)

    @classmethod
    def found(
        cls, equations: SlotEquations, kinds: Kinds, allowed: Allowance
    ) -> KillingFrame | None:
        """For any other T(q, q') that has n Killing vectors or more, as that of a top."""
        q, v, mass = equations.q, equations.v, sympy.Matrix(equations.mass)
        timed = equations.t in sympy.Tuple(*mass, *equations.forcing).free_symbols
        if timed or len(q) not in _COORDINATES or is_gyroscopic(equations):
            return None
        still = dict.fromkeys(v, sympy.S.Zero)
        alone = replace(equations, forcing=tuple(f - f.xreplace(still) for f in equations.forcing))
        slots = point_slots(alone)[1:]
        unknowns = quadratic_unknowns(range(len(q)), affine(kinds))
        search = Search(alone, slots, unknowns, allowed)
        fields = [combined(search.combination(s), len(q)) for s in search.solutions()]
        if len(fields) < len(q):
            return None
        inverse = mass.inv(method="ADJ").applyfunc(simplify)
        rows = [tuple(inverse.row(k)) for k in range(len(q))]
        moving = [x for x in q if x in mass.free_symbols]
        X = [
            f for x in moving for f in ((sympy.sin(x), sympy.cos(x)) if x in kinds.angles else (x,))
        ]
        return cls(fields, rows, X, accelerations=[dot(row, alone.forcing) for row in rows])

    @classmethod
    def without_factor(cls, equations: SlotEquations, allowed: Allowance) -> Iterator[KillingFrame]:
        """For T = w T0 with T0 of constant curvature, or a sum of squares of own coordinates."""
        for w in common_factors(equations):
            rows = (tuple(simplify(m / w) for m in row) for row in equations.mass)
            given = replace(equations, mass=tuple(rows))
            curved = Isometries(given, sympy.S.Zero, allowed) if Isometries.apply(given) else None
            frame = cls.of(given, curved) or cls._of_squares(given)
            if frame is not None:
                yield replace(frame, factor=w)

    @classmethod
    def _of_squares(cls, equations: SlotEquations) -> KillingFrame | None:
        """p_i^2/g_ii for T0 = sum g_ii(q_i) q_i'^2/2."""
        q, mass = set(equations.q), equations.mass
        if is_gyroscopic(equations) or any(
            m.free_symbols & q - {x} if i == k else m != 0
            for k, (x, row) in enumerate(zip(equations.q, mass, strict=True))
            for i, m in enumerate(row)
        ):
            return None
        squares = [
            (e, tuple(x / mass[k][k] for x in e)) for k, e in enumerate(unit_vectors(len(mass)))
        ]
        return cls((), (), equations.q, squares=squares)

    @property
    def degrees(self) -> Sequence[int]:
        """Those that are searched after the second."""
        n = len(self.spanning[0])
        return (3, 4) if n in _COORDINATES else ()

    def products(self, degree: int) -> Iterable[tuple[Vector, ...]]:
        """Killing tensors as symmetric products A B ..."""
        return self.squares or combinations_with_replacement(self.fields, degree)


def _rotations(equations: SlotEquations) -> list[Vector]:
    """X_i e_k - X_k e_i, X = M q."""
    X = [dot(row, equations.q) for row in equations.mass]
    found = []
    for i, k in combinations(range(len(X)), 2):
        field: list[Expr] = [sympy.S.Zero] * len(X)
        field[i], field[k] = -X[k], X[i]
        found.append(tuple(field))
    return found


def common_factors(equations: SlotEquations) -> list[Expr]:
    """w: M_kk, the factors with coordinates that all M_ik have in common, and sums among them.

    Each sum alone, too: (x^2 + y^2) (x'^2 + y'^2) is flat, in (x + i y)^2.
    """
    if len(equations.q) not in _COORDINATES:
        return []
    entries = [sympy.factor(m) for row in equations.mass for m in row if m != 0]
    shared = set.intersection(*(set(sympy.Mul.make_args(e)) for e in entries))
    moving = [f for f in shared if not free_of(f, equations.q)]
    sums = [f for f in moving if f.as_base_exp()[0].is_Add]
    own = [row[k] for k, row in enumerate(equations.mass) if moving or len(equations.q) == 2]
    found: list[Expr] = [sympy.S.One]
    for w in (*own, sympy.Mul(*moving), sympy.Mul(*sums), *sums):
        if all(not free_of(simplify(w / other), equations.q) for other in found):
            found.append(w)
    return found[1:]


def known_factors(equations: SlotEquations) -> list[Expr]:
    """The w, 1 among them, for which T/w is constant or has a constant curvature.

    In two dimensions M_xx of a cyclic x is a factor without which every T is flat.
    """
    q, mass = equations.q, equations.mass
    entries = sympy.Tuple(*chain(*mass))
    of_cyclic = [row[k] for k, row in enumerate(mass) if free_of(entries, [q[k]])]
    found = []
    for w in (sympy.S.One, *(w for w in common_factors(equations) if w not in of_cyclic)):
        rows = [[simplify(m / w) for m in row] for row in mass]
        if free_of(sympy.Tuple(*chain(*rows)), q) or Metric(q, rows).curvature is not None:
            found.append(w)
    return found
