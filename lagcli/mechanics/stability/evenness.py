"""Whether a family of equilibria can be stable as a whole.

V is the same on all of it.  Where V has a strict minimum across it, and evenly so, motion that
starts near the family stays near it, while along it nothing restores.  It is even where
the family is compact, or V does not change along it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.signs import sign

_TURNING = (sympy.sin, sympy.cos)


def even(
    values: Mapping[Symbol, Expr],
    free: Sequence[Symbol],
    forces: Sequence[Expr],
    surface: Sequence[Expr],
    q: Sequence[Symbol],
    relation: Expr | None = None,
) -> bool:
    """Whether the family is known to be compact, or V not to change along it.

    `forces` are those at rest, `surface` what vanishes by constraints.
    """
    if relation is not None:
        free = [s for s in free if s not in relation.free_symbols]
        if not _bounded(relation, forces, surface, q):
            return False
    return all(
        _turns(s, values, forces, surface) or _translates(s, values, forces, surface, q)
        for s in free
    )


def _bounded(
    relation: Expr, forces: Sequence[Expr], surface: Sequence[Expr], q: Sequence[Symbol]
) -> bool:
    """A quadratic relation whose form is definite, up to translations by which V stays."""
    second = [[simplify(relation.diff(a, b)) for b in q] for a in q]
    if any(not free_of(entry, q) for row in second for entry in row):
        return False
    flat = [v for v in nullspace(second) if not free_of(relation, _moved(v, q))]
    if not all(_stays(v, forces, surface, q) for v in flat):
        return False
    across = [k for k, s in enumerate(q) if s in relation.free_symbols]
    for v in flat:  # a complement of them: one coordinate less for each
        across.remove(next(k for k in reversed(across) if v[k] != 0))
    minors = [determinant([[second[i][j] for j in across[:k]] for i in across[:k]])
              for k in range(1, len(across) + 1)]  # fmt: skip
    signs = [None if minor is None else sign(minor) for minor in minors]
    n = len(across)
    return signs in ([1] * n, [-1, 1] * (n // 2) + [-1] * (n % 2))


def _moved(step: Sequence[Expr], q: Sequence[Symbol]) -> list[Symbol]:
    return [s for s, each in zip(q, step, strict=True) if each != 0]


def _turns(
    angle: Symbol, values: Mapping[Symbol, Expr], forces: Sequence[Expr], surface: Sequence[Expr]
) -> bool:
    """Whether all is periodic in it, and so in what turns with it."""
    following = [angle, *(s for s, value in values.items() if angle in value.free_symbols)]
    hidden: dict[Expr, Expr] = {}
    arguments = set()
    for expression in (*forces, *surface):
        for node in expression.atoms(*_TURNING):
            hidden[node] = S.Zero
            arguments.add(node.args[0])
    rates = [simplify(a.diff(s)) for a in arguments for s in following]
    return all(rate.is_Rational for rate in rates) and all(
        free_of(e.xreplace(hidden), following) for e in (*forces, *surface)
    )


def _translates(
    along: Symbol,
    values: Mapping[Symbol, Expr],
    forces: Sequence[Expr],
    surface: Sequence[Expr],
    q: Sequence[Symbol],
) -> bool:
    """Whether V does not change by constant displacements along the family, anywhere."""
    shift = {s: value.diff(along) for s, value in values.items()}
    steps = [S.One if s == along else shift.get(s, S.Zero) for s in q]
    return all(free_of(step, q) for step in steps) and _stays(steps, forces, surface, q)


def _stays(
    steps: Sequence[Expr], forces: Sequence[Expr], surface: Sequence[Expr], q: Sequence[Symbol]
) -> bool:
    """Whether this displacement does no work, nor leaves the constraints, anywhere."""
    work = dot(steps, forces)
    moved = [dot(steps, map(f.diff, q)) for f in surface]
    return all(is_zero(each) is True for each in (work, *moved))
