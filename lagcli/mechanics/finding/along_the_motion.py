"""Expressions rewritten with all that is known along the motion from the initial state.

Accelerations and multipliers are replaced by the solved motion, momenta by dL/dq'.  Then
velocities and the other coordinates are eliminated with what holds along the motion: the
constraints, and the conserved quantities at their initial values.  Each result is put to
the test at random states with those values, at 50 digits.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., sections 11 and 14 (motion from conserved quantities).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import mpmath
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.decimals import written
from lagcli.algebra.elimination import EliminatedExpression, eliminate
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.expression import Expression
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.finding.level_set import LevelSet
from lagcli.mechanics.finding.roots_on_surface import roots_on_surface, with_roots, without_roots
from lagcli.mechanics.initial import InitialState, initial_state
from lagcli.mechanics.noether import Noether
from lagcli.mechanics.parameter_values import parameter_values
from lagcli.mechanics.states import State
from lagcli.platform.effort import Work

#: Units of work for one question.
UNITS = 12_000_000
_STATES = 3
_ZERO = mpf(10) ** -38
_NONZERO = mpf(10) ** -25  # measured: zeros are below 2e-55, others above 2e-10


class AlongTheMotion:
    """Expressions rewritten with all that is known along the motion."""

    def __init__(self, dynamics: Dynamics, noether: Noether) -> None:
        self.dynamics = dynamics
        self.noether = noether
        self.system = dynamics.system
        self.work = Work(float("inf"))
        self.why_not = ""
        self._named: dict[Symbol, Expr] = {}

    @cached_property
    def initial(self) -> InitialState | None:
        """The initial state; None where the file has no `initial` at all."""
        return initial_state(self.dynamics) if self.system.problem.initial else None

    @cached_property
    def level_set(self) -> LevelSet:
        """The states that share the conserved quantities of the initial one."""
        return LevelSet(self.dynamics, self.noether, self.initial)

    @cached_property
    def roots(self) -> dict[Expr, Expr]:
        """Square roots whose value a constraint gives, by their radicands."""
        return roots_on_surface(self.level_set.constraints, self.system.q)

    @cached_property
    def states(self) -> list[State]:
        """Random states of the level set."""
        bound = self.initial is not None and self.initial.only_at_values
        return self.level_set.states(_STATES, parameter_values(self.system) if bound else None)

    def tree(self, expression: Expr) -> Expression:
        """The readable shape as a tree."""
        return written(expression, self.system.order)

    @property
    def notes(self) -> list[str]:
        """What must be said with an answer that was found."""
        if self.initial is not None and self.initial.only_at_values:
            return ["the initial state satisfies the constraints for the values of the file only"]
        return []

    # -- substitution ------------------------------------------------------------------------

    def on_motion(self, expression: Expr) -> Expr | None:
        """Accelerations, multipliers and momenta replaced by functions of q, q', t."""
        momenta = dict(zip(self.system.momenta, self.dynamics.lagrange.momenta, strict=True))
        replaced = self.dynamics.on_motion(expression.xreplace(momenta))
        if replaced is None:
            self.why_not = "the accelerations or multipliers in it are not determined"
        return replaced

    def rewritten(self, expression: Expr, keep: Sequence[Symbol]) -> Expr | None:
        """The expression in the named quantities and parameters; None with `why_not`."""
        self.why_not = ""
        subject = self.on_motion(expression)
        if subject is None:
            return None
        if not self._define(keep):
            return None
        subject = with_roots(subject, self.roots)
        named = [with_roots(s - formula, self.roots) for s, formula in self._named.items()]
        for relations, remove in self.attempts(keep):
            found = self.eliminated(subject, (*named, *relations), remove)
            if not found.complete:
                continue
            value = simplify(found.expression)
            if self._agrees(subject - value):
                return value
        if self.work.over:
            self.why_not = "it would take too much work"
        elif not self.why_not:
            self.why_not = self._not_found(keep)
        return None

    def _define(self, keep: Sequence[Symbol]) -> bool:
        """Formulas of the momenta, accelerations and multipliers that are to be kept."""
        system = self.system
        plain = {*system.q, *system.qdot, *system.parameters, system.t}
        self._named = {}
        for symbol in keep:
            if symbol not in plain:
                formula = self.on_motion(symbol)
                if formula is None:
                    return False
                self._named[symbol] = formula
        return True

    def eliminated(
        self, expression: Expr, relations: Sequence[Expr], remove: Sequence[Symbol]
    ) -> EliminatedExpression:
        """The expression with symbols removed by the relations, within the time allowed."""
        return eliminate(expression, relations, remove, self.nonzero, work=self.work)

    def attempts(self, keep: Sequence[Symbol]) -> list[tuple[tuple[Expr, ...], list[Symbol]]]:
        """Relations to use and symbols to remove: constraints first, explicit time last."""
        system = self.system
        moving = (*system.qdot[::-1], *system.q[::-1], system.t)
        remove = [s for s in moving if s not in keep]
        constraints, laws = (
            tuple(without_roots(each, self.roots) for each in relations)
            for relations in (self.level_set.constraints, self.level_set.laws)
        )
        still = tuple(law for law in laws if system.t not in law.free_symbols)
        plans = [(constraints, remove)]
        if still:
            plans.append(((*constraints, *still), remove))
        if len(still) < len(laws):
            plans.append(((*constraints, *laws), remove))
        return plans

    @property
    def relations(self) -> str:
        """What a formula is sought with, in words."""
        number = len(self.dynamics.constraints.equations)
        parts = [f"the constraint{'s' * (number > 1)}"] * bool(number)
        parts += ["the conserved quantities"] if self.initial else []
        return " and ".join(parts) or "the accelerations alone"

    def _not_found(self, keep: Sequence[Symbol]) -> str:
        names = ", ".join(s.name for s in keep) or "the parameters"
        reason = f"no formula of it in {names} alone was found from {self.relations}"
        if self.initial is None:
            reason += "; with an `initial` state the conserved quantities could be used"
        return reason

    # -- tests -------------------------------------------------------------------------------

    def nonzero(self, divisor: Expr) -> bool:
        """Whether one may divide: the expression vanishes at none of the random states."""
        if divisor.is_number or not divisor.free_symbols - set(self.system.parameters):
            return is_zero(divisor) is not True
        plan = Evaluator([divisor.xreplace(self._named)])
        for state in self.states or self.dynamics.states.take(2):
            values = plan.where_defined(state)
            if values is None or not abs(values[0]) > _NONZERO:
                return False
        return True

    def _agrees(self, difference: Expr) -> bool:
        """Whether it vanishes at random states of the level set."""
        difference = difference.xreplace(self._named)
        if is_zero(difference) is True:
            return True
        if not self.states:
            self.why_not = "no state with the initial values was found to verify the result at"
            return False
        plan = Evaluator([*_terms(difference)])
        for state in self.states:
            with mpmath.workdps(DIGITS):
                values = plan.where_defined(state)
                if values is None:
                    return False
                size = max(mpf(1), *map(abs, values))
                if not abs(sum(values)) < _ZERO * size:
                    return False
        return True

    def initially(self, expression: Expr) -> Expr:
        """The value in the initial state; 0 without one."""
        if self.initial is None:
            return S.Zero
        return self.initial.at(expression, self.system.t)


def _terms(expression: Expr) -> Sequence[Expr]:
    terms: Sequence[Expr] = expression.as_ordered_terms() if expression.is_Add else [expression]
    return terms
