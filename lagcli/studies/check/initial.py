"""Whether the initial state of the file lies on its constraints, as a numerical run wants it."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from lagcli.diagnostics import Diagnostic
from lagcli.expression import Expression, Negative, Number
from lagcli.problem_data import Problem

#: Fewer decimals than three are no rounded number.
_ROUNDED = Fraction(1, 1000)


def initial_mistakes(problem: Problem) -> tuple[Diagnostic, ...]:
    """What a run would refuse of `initial`; nothing where values of parameters are missing."""
    if not (problem.initial and problem.constraints):
        return ()
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.numerics.equations.start import OffConstraints, completed_state

    try:
        completed_state(problem)
    except OffConstraints as refusal:
        return () if _as_written(problem, refusal.nearest) else refusal.diagnostics
    except Refusal:
        return ()
    return ()


def _as_written(problem: Problem, nearest: Mapping[str, float]) -> bool:
    """Whether a state on the constraints is the one of the file within its last decimal.

    A file that says 0.7071 says so of a number that it rounds.
    """
    given = {str(name): _decimal(formula) for name, formula in problem.initial.items()}
    values = [value for value in given.values() if value is not None]
    units = [unit for unit in map(_last_decimal, values) if unit <= _ROUNDED]
    if not nearest or not units or len(values) < len(given):
        return False
    return all(abs(nearest[n] - v) <= max(units) for n, v in given.items() if v is not None)


def _decimal(formula: Expression) -> Fraction | None:
    match formula:
        case Number(value=value):
            return value
        case Negative(operand=Number(value=value)):
            return -value
        case _:
            return None


def _last_decimal(value: Fraction) -> Fraction:
    """The unit of the last decimal of a number: 1/1000 for 0.125, 1 for what has none."""
    places = next((k for k in range(40) if (value * 10**k).denominator == 1), 0)
    return Fraction(1, 10**places)
