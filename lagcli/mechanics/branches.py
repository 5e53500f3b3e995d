"""Constraints that several factors fulfil: y (x - 2 y) = 0 is two surfaces."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.factors import factors_of
from lagcli.algebra.signs import sign
from lagcli.document import Sentence
from lagcli.expression import Expression

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


class Surfaces:
    """Sentences on surfaces on which the factors of constraints are 0, as `write` has these."""

    def __init__(self, write: Callable[[Expr], Expression]) -> None:
        self.write = write

    def of_factors(
        self,
        name: str,
        factors: Sequence[Expr],
        velocities: Collection[Symbol],
        position: Expr | None,
    ) -> Sentence:
        """What the factors of a constraint f = 0 on the `position`, or of another, mean."""
        if position is None:
            alone = _either(f for f in factors if free_of(f, velocities))
            start = f"constraint '{name}' does not restrict the velocities where "
            return self._sentence(start, *alone, ": the answers hold elsewhere")
        flat = [f for f, power in factors_of(position) if power > 1 and f in factors]
        hold: list[str | Expr] = ["the answers hold on each"]
        if flat:
            gradient = ", since its gradient vanishes there"
            hold = ["the answers do not hold where ", *_either(flat), gradient]
        return self._sentence(
            f"constraint '{name}' holds where ",
            *_either(factors, " or where "),
            ": ",
            *hold,
            "; what is conserved on some of these only is called not conserved",
        )

    def of_another_rank(self, forms: Sequence[Expr], rank: int, usual: int) -> Sentence:
        """A surface on which other constraints are independent than where the answers hold."""
        rest = (
            "other constraints are redundant"
            if rank == usual
            else f"the constraints have rank {rank}, not {usual}"
        )
        where = _either(dict.fromkeys(forms), " and ")
        return self._sentence("where ", *where, f", {rest}: the answers do not hold there")

    def _sentence(self, *pieces: str | Expr) -> Sentence:
        text = (p if isinstance(p, str) else str(p).replace("**", "^") for p in pieces)
        parts = (p if isinstance(p, str) else self.write(p) for p in pieces)
        return Sentence.of("".join(text), tuple(parts))


def _either(forms: Iterable[Expr], between: str = " or ") -> list[str | Expr]:
    return [part for form in forms for part in (between, form, " = 0")][1:]
