"""The numbers of formulas that do not depend on the motion: parameters, and the time."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.expression import Expression
from lagcli.numerics.equations.arithmetic import Doubles, UndefinedFunction
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.refusal import Refusal, reason_of
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.problem_data import Problem


def numbers_of(
    problem: Problem, formulas: Sequence[Expression], times: Sequence[float] = (0.0,)
) -> list[tuple[float, ...]]:
    """The formulas at each time, with the values of the parameters.

    Raises
    ------
    Refusal
        Where a parameter has no value, or a formula is not defined.
    """
    equations = EquationsOfMotion(problem)
    nodes = [equations.form.read(formula) for formula in formulas]
    arithmetic = Doubles()
    constants = constants_of(equations, nodes, arithmetic)
    try:
        function = straight_line((equations.t,), nodes, constants, arithmetic)
        return [tuple(map(float, function(t))) for t in times]
    except UndefinedFunction as error:
        raise Refusal(f"the function '{error}' has no numbers") from None
    except (ArithmeticError, ValueError) as error:
        raise Refusal(reason_of(error)) from None
