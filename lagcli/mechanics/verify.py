"""Whether a formula vanishes on the motion: decided exactly, else at 50 digits.

An exact decision comes from the normal form.  Where that does not decide, the formula is
put to the test at random states on the constraint surface, at 50 digits.
"""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
from mpmath import mpf
from sympy import Add, Expr

from lagcli.algebra import is_zero
from lagcli.algebra.numeric import Evaluator
from lagcli.answers import Verification
from lagcli.mechanics.constraints import Constraints
from lagcli.mechanics.states import DIGITS, Contradiction, RandomStates
from lagcli.record import record

_STATES = 3
_ZERO = mpf(10) ** -(DIGITS - 12)  # of the sum of magnitudes: cancelled
_NONZERO = mpf(10) ** -20


@record
class Verdict:
    """`holds` is None where neither way decided; `how` says which way did."""

    holds: bool | None
    how: Verification | None


class Verifier:
    """Tests of identities on the constraint surface of one system."""

    def __init__(self, constraints: Constraints, states: RandomStates) -> None:
        self.constraints = constraints
        self.states = states

    def is_zero(self, expression: Expr) -> Verdict:
        """Whether the expression vanishes wherever the constraints hold."""
        if expression.is_zero:
            return Verdict(True, "exact")
        exact = is_zero(expression, self.constraints.relations)
        if exact is True:
            return Verdict(True, "exact")
        numeric = self.vanishes_at_random_states([expression])
        if numeric is None:
            return Verdict(exact, None if exact is None else "exact")
        # a value that is not 0 at one state is a proof; 0 at a few states is none
        return Verdict(numeric, "50 digits" if numeric else "exact")

    def all_zero(self, expressions: Sequence[Expr]) -> Verdict:
        """Whether all vanish; the weakest of the single verdicts."""
        how: Verification = "exact"
        for expression in expressions:
            verdict = self.is_zero(expression)
            if verdict.holds is not True:
                return verdict
            if verdict.how == "50 digits":
                how = "50 digits"
        return Verdict(True, how)

    def vanishes_at_random_states(self, expressions: Sequence[Expr]) -> bool | None:
        """The numeric test; None where no state could be evaluated."""
        terms = [Add.make_args(expression) for expression in expressions]
        evaluate = Evaluator([x for group in terms for x in group], DIGITS + 10)
        tested = 0
        taken = 0
        with mpmath.workdps(DIGITS + 10):
            while tested < _STATES and taken < 4 * _STATES:
                taken += 1
                try:
                    values = evaluate(self.states.take(taken)[-1])
                except (ArithmeticError, ValueError):
                    continue
                except Contradiction:
                    break
                if not all(mpmath.isfinite(v) for v in values):
                    continue
                tested += 1
                start = 0
                for group in terms:
                    part = values[start : start + len(group)]
                    start += len(group)
                    total, scale = abs(sum(part)), max(mpf(1), sum(map(abs, part)))
                    if total > _NONZERO * scale:
                        return False
                    if total > _ZERO * scale:
                        return None
        return True if tested else None
