"""Decimal digits that a formula loses in doubles, against 50 digits at the same numbers.

The parameters and the state are rounded to doubles first: what is lost is lost by the
formula, and a formula that is written better loses less.

References
----------
Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., sections 1.7 and 3.1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from lagcli.evaluation import evaluated
from lagcli.expression import Expression
from lagcli.numerics.certified.precise import precision
from lagcli.numerics.equations.arithmetic import Arithmetic, Balls, Doubles
from lagcli.studies.extremes.case import CaseFormula, Loss

#: What a double holds.
DIGITS = 53 * math.log10(2)
_HALF_UNIT = 2.0**-53
#: Digits that the reference has, and those tried to get them.
_REFERENCE = 50
_LADDER = (60, 120, 240, 480, 960)


def losses(formulas: Sequence[CaseFormula], values: Mapping[str, float]) -> tuple[Loss, ...]:
    """What each formula loses, as it is printed and rewritten.

    Parameters
    ----------
    formulas
        Of t, the coordinates and velocities by name (`x`, `x'`), and the parameters.
    values
        Of all of these.
    """
    return tuple(_loss(formula, values) for formula in formulas)


def _loss(formula: CaseFormula, values: Mapping[str, float]) -> Loss:
    exact = exactly(lambda a, given: number_of(formula.printed, given, a), values)
    printed = lost(formula.printed, values, exact)
    rewritten = printed
    if formula.rewritten is not None:
        rewritten = lost(formula.rewritten, values, exact)
    return Loss(group=formula.group, name=formula.name, printed=printed, rewritten=rewritten)


def exactly(
    work: Callable[[Arithmetic, Mapping[str, Any]], Any], values: Mapping[str, float]
) -> Any:
    """A ball of 50 digits and its precision; None where it is not defined, 0 where it vanishes."""
    arithmetic = Balls()
    found: Any = None
    for digits in _LADDER:
        with precision(digits):
            given = {name: arithmetic.ball(x) for name, x in values.items()}
            try:
                found = arithmetic.ball(work(arithmetic, given))
            except (ArithmeticError, LookupError, ValueError):
                return None
            if not found.is_finite():
                continue
            if found.rel_accuracy_bits() > _REFERENCE * math.log2(10) or found == 0:
                return found
    return arithmetic.ball(0) if found is not None and found.is_finite() else None


def lost(tree: Expression, values: Mapping[str, float], exact: Any) -> float | None:
    """The digits lost by a tree; None where there is no exact value."""
    if exact is None:
        return None
    try:
        found = float(number_of(tree, values, Doubles()))
    except (ArithmeticError, LookupError, ValueError):
        return DIGITS
    return digits_between(found, exact)


def digits_between(found: float, exact: Any) -> float:
    """Digits lost by a double: 0 where it is the nearest, all 16 where nothing is right."""
    if not math.isfinite(found):
        return DIGITS
    with precision(2 * _REFERENCE):
        if exact == 0:
            return DIGITS if found else 0.0
        relative = float(abs((type(exact)(found) - exact) / exact).mid())
    if relative <= _HALF_UNIT:
        return 0.0
    return min(DIGITS, math.log10(relative / _HALF_UNIT))


def number_of(node: Expression, values: Mapping[str, Any], arithmetic: Arithmetic) -> Any:
    """The value of a tree, worked out as it is written.

    Raises
    ------
    ArithmeticError, LookupError, ValueError
        Where a part is not defined.
    """
    functions = arithmetic.functions
    return evaluated(node, {**values, "pi": functions["pi"]()}, functions, arithmetic.number)
