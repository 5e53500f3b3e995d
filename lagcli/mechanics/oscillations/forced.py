"""The forced motion of linear equations: one solution x(t) in the functions of time of the drive.

Of q'' = A q + B q' + g(t) with constant A and B and a g of sines, cosines, exponentials and powers
of t, by undetermined coefficients; at resonance these have a factor t.  It is substituted.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., sections 22 and 26.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Dummy, Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.discovery.spectrum import forced_motion
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.reduction.routh import Routh

_WAVES = (sympy.sin, sympy.cos, sympy.exp)
_MOST_UNKNOWNS = 40
_MOST_OPERATIONS = 400


def forced(derivation: Derivation) -> dict[Symbol, Expr] | None:
    """x(t) by coordinate, of those that constraints leave; None where the equations are not so."""
    dynamics = derivation.dynamics
    if dynamics.constraints.equations:
        routh = Routh(derivation)
        if routh.cyclic or routh.reduced is None:
            return None
        dynamics = routh.reduced.dynamics
    if dynamics.constraints.equations or dynamics.motion is None:
        return None
    return _solution(dynamics, dynamics.motion.accelerations)


def amplitude(found: Sequence[Expr], t: Symbol) -> Expr | None:
    """sqrt(A^2 + B^2) of the one x = A cos(w t) + B sin(w t); None of any other."""
    waves = sorted({f for x in found for f in x.atoms(sympy.sin, sympy.cos)}, key=str)
    if len(found) != 1 or len(waves) != 2 or waves[0].args != waves[1].args:
        return None
    marks: dict[Expr, Expr] = {wave: Dummy() for wave in waves}
    x = found[0].xreplace(marks)
    parts = [x.diff(mark) for mark in marks.values()]
    rest = x - dot(parts, marks.values())
    if not all(free_of(part, [t]) for part in parts) or is_zero(rest) is not True:
        return None
    return sympy.sqrt(simplify(parts[0] ** 2 + parts[1] ** 2))


def _solution(dynamics: Dynamics, accelerations: Sequence[Expr]) -> dict[Symbol, Expr] | None:
    system = dynamics.system
    q, v, t = system.q, system.qdot, system.t
    still = dict.fromkeys((*q, *v), S.Zero)
    drive = [a.xreplace(still) for a in accelerations]
    if all(free_of(g, [t]) for g in drive) or sum(map(sympy.count_ops, drive)) > _MOST_OPERATIONS:
        return None
    parts = [[a.diff(x) for x in (*q, *v)] for a in accelerations]
    if not all(free_of(x, [*q, *v, t]) for row in parts for x in row):
        return None
    suggested = forced_motion(drive, q, v, t)
    growing = [f for f in suggested if f.func is sympy.exp]
    turning = [f for f in suggested if f.func in (sympy.sin, sympy.cos)]
    suggested += [a * b for a in growing for b in turning]
    plain = [S.One, *(f for f in suggested if f != S.One)]
    for functions in (plain, [*plain, *(t * f for f in suggested if f.has(*_WAVES))]):
        found = _of_these(functions, parts, drive, t)
        if found is not None:
            return dict(zip(q, found, strict=True))
    return None


def _of_these(
    functions: Sequence[Expr], parts: Sequence[Sequence[Expr]], drive: Sequence[Expr], t: Symbol
) -> list[Expr] | None:
    """The combinations of these functions that solve it."""
    n = len(drive)
    if n * len(functions) > _MOST_UNKNOWNS:
        return None
    unknowns = [[Dummy(f"c{j}_{k}") for k in range(len(functions))] for j in range(n)]
    x = [dot(row, functions) for row in unknowns]
    motion = [*x, *(f.diff(t) for f in x)]
    hidden: dict[Expr, Expr] = {f: Dummy() for f in functions if f.has(*_WAVES) and not f.is_Mul}
    equations: list[Expr] = []
    for j in range(n):
        left = sympy.expand(x[j].diff(t, 2) - dot(parts[j], motion) - drive[j])
        left = left.xreplace(hidden)
        variables = [t, *hidden.values()]
        if left.has(*_WAVES) or not left.is_polynomial(*variables):
            return None
        equations += sympy.Poly(left, *variables).coeffs()
    flat = [c for row in unknowns for c in row]
    nothing = dict.fromkeys(flat, S.Zero)
    rows = [[*(e.diff(c) for c in flat), e.xreplace(nothing)] for e in equations if e != 0]
    solved = next((c for c in nullspace(rows) if c[-1] != 0), None)
    if solved is None:
        return None
    values = {c: x / solved[-1] for c, x in zip(flat, solved, strict=False)}
    found = [simplify(f.xreplace(values)) for f in x]
    motion = [*found, *(f.diff(t) for f in found)]
    left_over = (found[j].diff(t, 2) - dot(parts[j], motion) - drive[j] for j in range(n))
    return found if all(is_zero(e) is True for e in left_over) else None
