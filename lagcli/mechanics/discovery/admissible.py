"""Vector fields along which the constraints let the system be displaced: a_k . e = 0.

Of m constraints, the maximal minors of every m + 1 columns give one field each (Cramer).
Together they span the admissible virtual displacements at every point where A has full
rank, and have no poles, which a basis of them may need: on a sphere they are the rotations.
Where they are of higher degree than the first, and n - m of the first degree have a minor that
is constant on the surface, these span the same: a rod's displacement along itself, and its turn.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 1.4 (virtual displacements).
Bloch, *Nonholonomic Mechanics and Control*, 2nd ed., section 5.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, combinations

import sympy
from sympy import Expr

from lagcli.algebra import Field, dot, is_zero, nullspace, simplify
from lagcli.algebra.field import over_common_denominator
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.surface import relations_on_surface
from lagcli.mechanics.dynamics import Dynamics

_MOST_MINORS = 60  # measured: at most 10
_MOST_ROWS = 3  # measured: at most 2

Vector = tuple[Expr, ...]


def admissible_fields(dynamics: Dynamics, allowed: Allowance) -> list[Vector]:
    """Fields that span the admissible displacements, the simplest first."""
    relations = dynamics.constraints.relations
    equations = dynamics.constraints.equations
    rows = [equations[k].row for k in dynamics.independent_constraints]
    if relations is not None:
        rows = [tuple(map(relations.substitute, row)) for row in rows]
    n = len(dynamics.system.q)
    fields = [tuple(v) for v in nullspace(rows)]
    if len(rows) <= _MOST_ROWS and _count(n, len(rows) + 1) <= _MOST_MINORS:
        fields += _minors(rows, n, allowed)
    fields = _distinct([_upward(primitive(f)) for f in fields])
    return _of_first_degree(fields, rows, dynamics, allowed) or fields


def _of_first_degree(
    fields: Sequence[Vector], rows: Sequence[Vector], dynamics: Dynamics, allowed: Allowance
) -> list[Vector]:
    """A basis of such; none where they are not needed, or do not span at every point."""
    q, size = dynamics.system.q, len(dynamics.system.q) - len(rows)
    forms = [e.f for e in dynamics.constraints.equations if e.holonomic]
    entries = list(chain(*fields[:size]))
    if not forms or not all(x.is_polynomial(*q) for x in (*forms, *chain(*rows), *entries)):
        return []
    if all(sympy.Poly(x, *q).total_degree() <= 1 for x in entries):
        return []
    candidates = [(j, f) for f in (sympy.S.One, *q) for j in range(len(q))]
    columns = [[row[j] * f for row in rows] for j, f in candidates]
    found = []
    for relation in relations_on_surface(columns, dynamics, allowed):
        field: list[Expr] = [sympy.S.Zero] * len(q)
        for k, c in relation.items():
            j, f = candidates[k]
            field[j] += c * f
        found.append(_upward(primitive(field)))
    found = _distinct(found)[:size]
    return found if len(found) == size and _span(found, dynamics) else []


def _span(fields: Sequence[Vector], dynamics: Dynamics) -> bool:
    """Whether a minor of them is constant on the surface, and not 0."""
    relations, q = dynamics.constraints.relations, dynamics.system.q
    for columns in combinations(range(len(q)), len(fields)):
        minor = sympy.Matrix([[e[k] for k in columns] for e in fields]).det(method="berkowitz")
        slopes = (dot(e, [minor.diff(x) for x in q]) for e in fields)
        if is_zero(minor, relations) is not True and all(is_zero(x, relations) for x in slopes):
            return True
    return False


def _count(n: int, k: int) -> int:
    return int(sympy.binomial(n, k))


def _minors(rows: Sequence[Vector], n: int, allowed: Allowance) -> list[Vector]:
    found = []
    for columns in combinations(range(n), len(rows) + 1):
        allowed.check()
        field: list[Expr] = [sympy.S.Zero] * n
        for sign, column in enumerate(columns):
            rest = [c for c in columns if c != column]
            minor = sympy.Matrix([[row[c] for c in rest] for row in rows])
            field[column] = (-1) ** sign * simplify(minor.det(method="berkowitz"))
        if any(is_zero(x) is not True for x in field):
            found.append(tuple(field))
    return found


def primitive(vector: Sequence[Expr]) -> Vector:
    """The vector without denominators and common factors."""
    field = Field(vector)
    ring = field.ring
    tops = over_common_denominator(field, [field(x) for x in vector])
    common = None
    for top in tops:
        if top != 0:
            common = ring.lift(top) if common is None else ring.lift(common).gcd(ring.lift(top))
    if common is None:
        return tuple(vector)
    return tuple(
        simplify(field.polynomial_to_sympy(ring.lift(top) / ring.lift(common))) for top in tops
    )


def _upward(field: Vector) -> Vector:
    """The last component that is not 0 is positive, where that can be said."""
    last = next((x for x in reversed(field) if x != 0), sympy.S.One)
    return tuple(-x for x in field) if last.could_extract_minus_sign() else field


def _distinct(fields: Sequence[Vector]) -> list[Vector]:
    """Each once."""
    return list(dict.fromkeys(sorted(fields, key=_size)))


def _size(field: Vector) -> tuple[int, int, str]:
    return (
        sum(sympy.count_ops(x) for x in field),
        sum(1 for x in field if x != 0),
        str(field),
    )
