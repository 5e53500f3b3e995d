"""Random states in phase space, and whether a function vanishes there."""

from __future__ import annotations

import random
from collections.abc import Sequence

import mpmath
from mpmath import mpf
from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.mechanics.states import Contradiction, State, is_real, random_value
from lagcli.mechanics.system import System
from lagcli.statements.answers import Verification

_ATTEMPTS = 60
_TESTED = 3


class PhaseStates:
    """Random q, p, t and parameters at which all that is needed is finite and real.

    Parameters
    ----------
    system, needed
        The names, and the functions that must have values.
    reach
        The largest magnitude of a coordinate or momentum; with 3 an angle is in any quadrant.
    """

    def __init__(self, system: System, needed: Sequence[Expr], reach: float = 1.0) -> None:
        self._reach = reach
        self._system = system
        self._needed = Evaluator(list(needed), DIGITS + 10)

    def take(self, count: int) -> list[State]:
        """So many states, always the same ones.

        Raises
        ------
        Contradiction
            When too few were found.
        """
        source = random.Random("lagcli")
        found: list[State] = []
        for _ in range(_ATTEMPTS):
            with mpmath.workdps(DIGITS + 10):
                state = self._drawn(source)
                values = self._needed.where_defined(state)
            found += [state] if values is not None and all(map(is_real, values)) else []
            if len(found) == count:
                return found
        raise Contradiction(-1)

    def vanishes(self, expression: Expr) -> tuple[bool | None, Verification | None]:
        """Whether a function of q, p, t is 0, and how that was seen.

        The normal form decides, or else numbers at random states.
        """
        verdict = is_zero(expression)
        if verdict is True:
            return True, "exact"
        seen = self.is_zero_at_states(expression, _TESTED)
        if seen is None:
            return (False, "exact") if verdict is False else (None, None)
        if seen is False:
            return False, "50 digits"
        return (True, "50 digits") if verdict is None else (None, None)

    def is_zero_at_states(self, expression: Expr, count: int) -> bool | None:
        """Whether a function of q, p, t is 0 to 50 digits; None where it has no values."""
        value = Evaluator([expression], DIGITS + 10)
        with mpmath.workdps(DIGITS + 10):
            try:
                values = [value(state)[0] for state in self.take(count)]
            except (ArithmeticError, ValueError, Contradiction):
                return None
        return all(abs(each) <= mpf(10) ** -(DIGITS - 15) for each in values)

    def _drawn(self, source: random.Random) -> State:
        system = self._system
        state = {p: random_value(source, p, 0.6, 1.7) for p in system.parameters}
        state[system.t] = random_value(source, system.t, 0.1, 0.9)
        state |= {q: random_value(source, q, 0.3, self._reach) for q in system.q}
        return state | {p: random_value(source, p, 0.1, self._reach) for p in system.momenta}
