"""Values of the parameters for which conditions without a solution may have one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy
from sympy import Expr, S, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.decimals import written
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.systems import SolvedSystem, solve_system
from lagcli.algebra.vanishing_factors import can_vanish, may_vanish
from lagcli.expression import Expression
from lagcli.record import record

_MOST_OPEN = 8  # parameters that may be 0, each of which is put to 0 in turn
_MOST_CONDITIONS = 4  # of which each is left out in turn


def without_unknowns(
    conditions: Sequence[Expr], unknowns: Sequence[Symbol]
) -> tuple[Expr, ...] | None:
    """What no choice of the unknowns makes 0, but perhaps one of parameters.

    None where all conditions may hold for special values of parameters that are not known, or for
    special functions.
    """
    if any(e.atoms(AppliedUndef) for e in conditions):
        return None
    found = _factors_without(conditions, unknowns)
    if found or not all(map(can_vanish, conditions)):
        return found
    decided = _decided_by_parameters(conditions, unknowns)
    return _at_zero(conditions, unknowns) if decided == () else decided


def with_a_value(
    vanishing: tuple[Expr, ...] | None, given: Sequence[Expr]
) -> tuple[Expr, ...] | None:
    """Without those whose roots the given expressions exclude: cos(a) beside tan(a)."""
    if vanishing is None:
        return None
    return tuple(e for e in vanishing if not _has_no_value(e, given))


def _has_no_value(vanishing: Expr, given: Sequence[Expr]) -> bool:
    """Whether any of them has no value at each root of one parameter."""
    if len(vanishing.free_symbols) != 1:
        return False
    [p] = vanishing.free_symbols
    at = [f for f in given if p in f.free_symbols]
    solved = solve_system([vanishing], [p]) if at else SolvedSystem()
    return bool(solved.solutions and solved.complete) and all(
        any(f.xreplace(dict(each.values)).has(*NO_VALUE) for f in at) for each in solved.solutions
    )


def _decided_by_parameters(
    conditions: Sequence[Expr], unknowns: Sequence[Symbol]
) -> tuple[Expr, ...] | None:
    """What one condition is at all solutions of the others, in parameters alone.

    Empty where it vanishes for no values of them, None where they were not all found.
    """
    if len(conditions) > _MOST_CONDITIONS:
        return ()
    may_hold = False
    for k, left in enumerate(conditions):
        others = [e for j, e in enumerate(conditions) if j != k]
        solved = solve_system(others, unknowns, families=True) if others else SolvedSystem()
        rests = [simplify(left.xreplace(dict(each.values))) for each in solved.solutions]
        plain = [e for e in rests if e.free_symbols and free_of(e, unknowns)]
        product = sympy.Mul(*(f for e in plain for f in _perhaps_zero(e, unknowns)))
        special = _perhaps_zero(simplify(product), unknowns)  # (k + r) (k - r) is -4 F² c
        if special and solved.complete and len(plain) == len(rests):
            return (sympy.Mul(*special),)
        may_hold = may_hold or bool(special or (rests and _perhaps_zero(left, unknowns)))
    return None if may_hold else ()


def _at_zero(conditions: Sequence[Expr], unknowns: Sequence[Symbol]) -> tuple[Expr, ...] | None:
    """The product of the parameters without each of which the conditions can hold.

    That of a rate w, where they hold at all times: g sin(q) = a w² cos(q - w t).  Those that must
    vanish together; None where there may be other exceptions.
    """
    known = {p for e in conditions for p in e.free_symbols} - {*unknowns}
    open_ = sorted(filter(can_vanish, known), key=str)
    alone = [p for p in open_[:_MOST_OPEN] if _holds_without(conditions, [p], unknowns)]
    if not alone:
        together = len(open_) > 1 and _holds_without(conditions, open_, unknowns)
        return _each_for_itself(conditions, unknowns) if together else ()
    with_all = []
    for e in conditions:
        factors = [f for f, k in factors_of(simplify(e)) if k > 0 and can_vanish(f)]
        if {*alone} <= {*factors}:
            with_all.append(sympy.Mul(*(f for f in factors if f not in alone)))
    return (sympy.Mul(*alone),) if _exclude_each_other(with_all) else None


def _each_for_itself(
    conditions: Sequence[Expr], unknowns: Sequence[Symbol]
) -> tuple[Expr, ...] | None:
    """What must vanish for each condition, where that does not depend on the unknowns."""
    found = []
    for e in conditions:
        factor = sympy.Mul(*_perhaps_zero(e, unknowns))
        if can_vanish(simplify(e / factor)):
            return None
        found.append(factor)
    return tuple(dict.fromkeys(found))


def _holds_without(
    conditions: Sequence[Expr], parameters: Sequence[Symbol], unknowns: Sequence[Symbol]
) -> bool:
    """Whether a solution is known where these parameters are 0."""
    left = [simplify(e.xreplace(dict.fromkeys(parameters, S.Zero))) for e in conditions]
    left = [e for e in left if e != 0]
    if any(e.has(*NO_VALUE) or free_of(e, unknowns) for e in left):
        return False
    return not left or bool(solve_system(left, unknowns).solutions)


def _exclude_each_other(expressions: Sequence[Expr]) -> bool:
    """Whether they vanish together nowhere, as sin(a) and cos(a)."""
    squares = simplify(sympy.Add(*(e**2 for e in expressions)))
    return bool(squares.is_number and squares != 0)


def alternatives_written(factors: Sequence[Expr], order: Sequence[str]) -> tuple[Expression, ...]:
    """Of what one vanishes: the product, as q B; each for itself where one is a sum."""
    apart = factors if any(f.is_Add for f in factors) else [sympy.Mul(*factors)] * bool(factors)
    return tuple(written(e, order) for e in apart)


def unless_written(
    vanishing: Sequence[Expr] | None, order: Sequence[str]
) -> tuple[Expression, ...] | None:
    """`unless` as it is read."""
    return None if vanishing is None else tuple(written(e, order) for e in vanishing)


def _factors_without(conditions: Sequence[Expr], unknowns: Sequence[Symbol]) -> tuple[Expr, ...]:
    open_ = [simplify(e) for e in conditions if free_of(e, unknowns)]
    open_ = [e for e in open_ if e != 0]
    if open_:
        deciding = [_perhaps_zero(e, unknowns) for e in open_]
        found = tuple({sympy.Mul(*each): None for each in deciding}) if all(deciding) else ()
        return () if _exclude_each_other(found) else found
    common = _common_factors(conditions, unknowns)
    return (sympy.Mul(*common),) if common else ()


@record
class Vanishing:
    """What is to vanish, the unknowns in it, and the mass matrix, whose parameters are not 0."""

    conditions: Sequence[Expr]
    unknowns: Sequence[Symbol]
    masses: Sequence[Sequence[Expr]]

    @property
    def void(self) -> list[Expr]:
        """What may be 0, each by itself, and all conditions hold everywhere then."""
        return [f for f in _common_factors(self._open, self.unknowns) if not self._is_weightless(f)]

    @property
    def degenerate(self) -> list[Expr]:
        """What may be 0, each by itself, and some conditions hold everywhere then, not all."""
        void = _common_factors(self._open, self.unknowns)
        found = (f for e in self._open for f in _perhaps_zero(e, self.unknowns) if f not in void)
        return [f for f in dict.fromkeys(found) if not self._is_weightless(f)]

    @property
    def is_void_only_there(self) -> bool:
        """Whether all hold where one of `void` is 0 only: not (a x + b y) sin(c), with a = b = 0.

        Nor for a special choice of an unspecified function.
        """
        void = self.void
        return any(
            all(f in void or self._is_weightless(f) for f in may_vanish(coefficient))
            for condition in self._open
            for coefficient in _coefficients(condition, self.unknowns)
        )

    @property
    def _open(self) -> list[Expr]:
        return [e for e in self.conditions if e != 0]

    def _is_weightless(self, parameter: Expr) -> bool:
        """Whether a row of the mass matrix vanishes with a parameter."""
        rows = (row for row in self.masses if any(row))
        return any(all(is_zero(x.xreplace({parameter: S.Zero})) for x in row) for row in rows)


def _coefficients(condition: Expr, unknowns: Sequence[Symbol]) -> list[Expr]:
    """Those of what does not vanish for special parameters, as sin(w t), or functions."""
    open_ = filter(can_vanish, condition.free_symbols - {*unknowns})
    at_zero = dict.fromkeys(open_, S.Zero)
    return [
        simplify(coefficient)
        for moving, coefficient in _by_unknowns(condition, unknowns).items()
        if not moving.atoms(AppliedUndef) and moving.xreplace(at_zero) != 0
    ]


def _by_unknowns(condition: Expr, unknowns: Sequence[Symbol]) -> dict[Expr, Expr]:
    """The coefficients of the different functions of the unknowns that it is a sum of."""
    found: dict[Expr, Expr] = {}
    for term in sympy.Add.make_args(sympy.expand(condition)):
        coefficient, moving = term.as_independent(*unknowns, as_Add=False)
        found[moving] = found.get(moving, S.Zero) + coefficient
    return {moving: c for moving, c in found.items() if c != 0}


def _common_factors(conditions: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Expr]:
    """What all have without unknowns and may be 0."""
    factors = [_perhaps_zero(e, unknowns) for e in conditions]
    return [f for f in factors[0] if all(f in other for other in factors)] if factors else []


def _perhaps_zero(condition: Expr, unknowns: Sequence[Symbol]) -> list[Expr]:
    """The factors without unknowns that can vanish.

    Those of a sum are common to its coefficients; to factor it took 20 s of a triple pendulum's.
    """
    found: dict[Expr, None] = {}
    # each by itself: sin(a) (g cos(a) + X'' sin(a)) is a sum with cos(a)^2 when multiplied out
    for part in sympy.Mul.make_args(condition):
        if free_of(part, unknowns):
            found |= dict.fromkeys(may_vanish(part))
        elif (power := part.as_base_exp())[1].is_positive:
            found |= dict.fromkeys(_common_to(_by_unknowns(power[0], unknowns).values()))
    return [*found]


def _common_to(coefficients: Iterable[Expr]) -> list[Expr]:
    """The factors of all coefficients that can vanish."""
    common: list[Expr] | None = None
    for each in coefficients:
        factors = may_vanish(simplify(each))
        common = factors if common is None else [f for f in common if f in factors]
        if not common:
            break
    return common or []
