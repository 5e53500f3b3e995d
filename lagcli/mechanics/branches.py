"""Constraints that several factors fulfil: y (x - 2 y) = 0 is two surfaces."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.factors import factors_of
from lagcli.algebra.signs import sign

_LONGEST = 400  # operations of a form that is factored


def vanishing_factors(form: Expr, moving: Collection[Symbol]) -> tuple[Expr, ...]:
    """The irreducible factors that depend on the state and are 0 somewhere."""
    if form.has(sympy.Abs, sympy.sign) or sympy.count_ops(form) > _LONGEST:
        return ()
    try:
        found = [f for f, power in factors_of(form) if power > 0 and not free_of(f, moving)]
    except ZeroDivisionError:
        return ()
    return tuple(f for f in found if f.is_nonzero is not True and sign(f) not in {1, -1})


def without_time_alone(form: Expr, t: Symbol, moving: Collection[Symbol]) -> Expr:
    """The form without the factors of t alone: t (x' - 2 y') = 0 is x' - 2 y' = 0."""
    if free_of(form, [t]) or form.has(sympy.Abs, sympy.sign) or sympy.count_ops(form) > _LONGEST:
        return form
    try:
        found = factors_of(form)
    except ZeroDivisionError:
        return form
    timed = [f**power for f, power in found if free_of(f, moving) and not free_of(f, [t])]
    kept = [f**power for f, power in found if f**power not in timed]
    return sympy.Mul(*kept) if timed else form


def restricting(factors: Sequence[Expr], velocities: Collection[Symbol]) -> Expr:
    """The factor of a velocity constraint that has the velocities in it."""
    return next((f for f in factors if not free_of(f, velocities)), factors[-1])


def sentence(
    name: str, factors: Sequence[Expr], velocities: Collection[Symbol], position: Expr | None
) -> str:
    """What the factors of a constraint f = 0 on the `position`, or of another, mean."""
    if position is not None:
        either = " or where ".join(f"{_written(f)} = 0" for f in factors)
        flat = [f for f, power in factors_of(position) if power > 1 and f in factors]
        there = " or ".join(f"{_written(f)} = 0" for f in flat)
        hold = (
            f"the answers do not hold where {there}, since its gradient vanishes there"
            if flat
            else "the answers hold on each"
        )
        return (
            f"constraint '{name}' holds where {either}: {hold}; "
            "what is conserved on some of these only is called not conserved"
        )
    where = " or ".join(f"{_written(f)} = 0" for f in factors if free_of(f, velocities))
    return (
        f"constraint '{name}' does not restrict the velocities where {where}: "
        "the answers hold elsewhere"
    )


def of_another_rank(forms: Sequence[Expr], rank: int, usual: int) -> str:
    """A surface on which other constraints are independent than where the answers hold."""
    where = " and ".join(f"{_written(f)} = 0" for f in dict.fromkeys(forms))
    if rank == usual:
        return f"where {where}, other constraints are redundant: the answers do not hold there"
    return (
        f"where {where}, the constraints have rank {rank}, not {usual}: "
        "the answers do not hold there"
    )


def _written(factor: Expr) -> str:
    return str(factor).replace("**", "^")
