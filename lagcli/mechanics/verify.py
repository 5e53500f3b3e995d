"""Whether a formula vanishes on the motion: decided exactly, else at 50 digits.

An exact decision comes from the normal form.  Where that does not decide, the formula is
put to the test at random states on the constraint surface, at 50 digits.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator, Sequence

import mpmath
from mpmath import mpf
from sympy import Add, Expr

from lagcli.algebra import is_zero
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.row_rank import independent_rows, rows_of
from lagcli.mechanics.constraints import Constraints
from lagcli.mechanics.states import Contradiction, RandomStates, State, random_value
from lagcli.record import record
from lagcli.statements.answers import Verification

_STATES = 3  # three: one may lie on a root, two on a curve through the start
#: A surface may have branches: of x^2 y = x y^2 three states met one, twelve all of three.
_STATES_OF_SURFACES = 12
_ZERO = mpf(10) ** -(DIGITS - 12)  # of the sum of magnitudes: cancelled
_NONZERO = mpf(10) ** -20


@record
class ZeroVerdict:
    """`holds` is None where neither way decided; `how` says which way did."""

    holds: bool | None
    how: Verification | None


def conjunction(verdicts: Iterable[bool | None]) -> bool | None:
    """Whether all hold; None where that is open."""
    found = {*verdicts}
    return False if False in found else None if None in found else True


def disjunction(verdicts: Iterable[bool | None]) -> bool | None:
    """Whether one holds; None where that is open."""
    found = {*verdicts}
    return True if True in found else None if None in found else False


class Verifier:
    """Tests of identities on the constraint surface of one system."""

    def __init__(self, constraints: Constraints, states: RandomStates) -> None:
        self.constraints = constraints
        self.states = states

    def is_zero(self, expression: Expr) -> ZeroVerdict:
        """Whether the expression vanishes wherever the constraints hold."""
        if expression == 0:
            return ZeroVerdict(True, "exact")
        exact = is_zero(expression, self.constraints.relations)
        if exact is True:
            return ZeroVerdict(True, "exact")
        numeric = self.vanishes_at_random_states([expression])
        if numeric is None:
            return ZeroVerdict(exact, None if exact is None else "exact")
        # a value that is not 0 at one state is a proof; 0 at a few states is none
        return ZeroVerdict(numeric, "50 digits" if numeric else "exact")

    def identically_zero(self, expression: Expr) -> bool | None:
        """Whether the expression is 0 for all values of its symbols, on the constraints or not."""
        exact = is_zero(expression)
        if exact is not None:
            return exact
        source = random.Random("identity")
        symbols = sorted(expression.free_symbols, key=lambda s: s.name)
        states = [{s: random_value(source, s, 0.3, 1.3) for s in symbols} for _ in range(_STATES)]
        return self._vanishes_at([expression], iter(states))

    def all_zero(self, expressions: Sequence[Expr]) -> ZeroVerdict:
        """Whether all vanish; the weakest of the single verdicts."""
        how: Verification = "exact"
        for expression in expressions:
            verdict = self.is_zero(expression)
            if verdict.holds is not True:
                return verdict
            if verdict.how == "50 digits":
                how = "50 digits"
        return ZeroVerdict(True, how)

    def vanishes_at_random_states(
        self,
        expressions: Sequence[Expr],
        along: Callable[[Iterator[State]], Iterator[State]] = iter,
    ) -> bool | None:
        """The numeric test; None where no state could be evaluated.

        `along` adds to the states what the expressions use besides.
        """
        bent = any(equation.holonomic for equation in self.constraints.equations)
        few = _STATES_OF_SURFACES if bent else _STATES
        wanted = max(few, 2 * self.states.surfaces)
        return self._vanishes_at(expressions, along(self._states(4 * wanted)), wanted)

    def is_fixed(self, quantity: Expr) -> bool:
        """Whether the constraints alone keep a quantity from changing between states.

        Its gradient by q and q' is then a combination of those of f and of A q' + b.
        """
        system, constraints = self.states.system, self.constraints
        moving = (*system.q, *system.qdot)
        held = [e.f for e in constraints.equations if e.holonomic]
        forms = [*held, *constraints.velocity_forms, quantity]
        evaluate = Evaluator([form.diff(x) for form in forms for x in moving], DIGITS)
        width, tolerance = len(moving), mpf(10) ** -20
        try:
            with mpmath.workdps(DIGITS):
                return bool(constraints.equations) and all(
                    _last_depends(rows_of(evaluate(state), width), tolerance)
                    for state in self.states.take(_STATES)
                )
        except (ArithmeticError, ValueError, Contradiction):
            return False

    def _states(self, most: int) -> Iterator[State]:
        for count in range(1, most + 1):
            try:
                yield self.states.take(count)[-1]
            except Contradiction:
                return
            except (ArithmeticError, ValueError):
                continue

    def _vanishes_at(
        self, expressions: Sequence[Expr], states: Iterator[State], wanted: int = _STATES
    ) -> bool | None:
        terms = [Add.make_args(expression) for expression in expressions]
        evaluate = Evaluator([x for group in terms for x in group], DIGITS + 10)
        tested = 0
        with mpmath.workdps(DIGITS + 10):
            for state in states:
                values = evaluate.where_defined(state)
                if values is None or not all(mpmath.isfinite(v) for v in values):
                    continue
                verdict = _vanish(terms, values)
                if verdict is not True:
                    return verdict
                tested += 1
                if tested == wanted:
                    break
        return True if tested else None


def _last_depends(rows: Sequence[Sequence[mpf]], tolerance: mpf) -> bool:
    """Whether the last row is a combination of the others, as one of 0 up to rounding is."""
    if all(abs(x) <= tolerance for x in rows[-1]):
        return True
    return len(rows) - 1 in independent_rows(rows, tolerance).dependent


def _vanish(groups: Sequence[Sequence[Expr]], values: Sequence[mpf]) -> bool | None:
    """Whether each sum is 0 beside its terms at one state; None where that is not certain."""
    start = 0
    for group in groups:
        part = values[start : start + len(group)]
        start += len(group)
        total, scale = abs(sum(part)), max(mpf(1), sum(map(abs, part)))
        if total > _NONZERO * scale:
            return False
        if total > _ZERO * scale:
            return None
    return True
