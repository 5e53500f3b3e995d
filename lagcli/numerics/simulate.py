"""A problem and what is asked of it -> a table with its certificate."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from lagcli.expression import Expression
from lagcli.graph.nodes import Node
from lagcli.numerics.accuracy import Controller, Outcome, Row
from lagcli.numerics.arithmetic import Doubles
from lagcli.numerics.asked import Asked, Result
from lagcli.numerics.certificate import result_of
from lagcli.numerics.columns import Column, Reading, Values
from lagcli.numerics.constants import constants_of
from lagcli.numerics.dop853 import Dop853, generated_step
from lagcli.numerics.equations import Equations
from lagcli.numerics.events import Condition
from lagcli.numerics.motion import Motion
from lagcli.numerics.refusal import Refusal, told
from lagcli.numerics.run import Run
from lagcli.numerics.start import initial_state, rounded_components
from lagcli.numerics.steps import Tolerance
from lagcli.numerics.surface import Surface
from lagcli.problem import Problem

#: Local tolerances below this change nothing: an estimate is rounded at h |rate| 1e-16.
FINEST_DOUBLE = 1e-18
#: The intervals at which two runs are compared are at least so many.
_COMPARED = 100
#: Doubles that miss the accuracy, and are this good, miss it by their rounding.
_ROUNDING_REACH = 1e-5

_DIGITS = 30

Progress = Callable[[float], None]


def simulate(problem: Problem, asked: Asked, progress: Progress | None = None) -> Result:
    """Run a problem.

    Parameters
    ----------
    problem
        With values for its parameters and an initial state.
    asked
        Span, accuracy, columns.
    progress
        Told now and then which part of the span is done.

    Raises
    ------
    Refusal
        When there is nothing to run: values are missing, the initial state is off the
        constraints, the accelerations are not determined.
    """
    return Simulation(problem, asked, progress).result()


class Simulation:
    """One problem with its columns and conditions as nodes."""

    def __init__(self, problem: Problem, asked: Asked, progress: Progress | None = None) -> None:
        self.problem, self.asked, self.progress = problem, asked, progress
        self.equations = equations = Equations(problem)
        self.reading = Reading(equations)
        try:
            self.charges = equations.charges
            self.nodes = [self._column(column) for column in asked.columns]
            self.margins = [
                (c.name, "contact lost", self._margin(c.holds_while))
                for c in problem.constraints
                if c.holds_while is not None
            ]
        except ArithmeticError as error:
            raise Refusal(f"a column is not defined: {error}") from None
        every = max(1, -(-_COMPARED // (asked.samples - 1)))
        count = (asked.samples - 1) * every
        self.every = every
        self.times = [asked.until * k / count for k in range(count)] + [asked.until]
        self.finished = 0.0

    def _column(self, column: Column) -> Node:
        if column.expression is None:
            return self.equations.t
        return self.reading(column.expression)

    def _margin(self, condition: Any) -> Node:
        graph = self.equations.graph
        left, right = self.reading(condition.left), self.reading(condition.right)
        sides = (left, right) if condition.comparison[0] == ">" else (right, left)
        return graph.difference(*sides)

    @property
    def all_nodes(self) -> list[Node]:
        """Everything that is given a number: its parameters need values."""
        e = self.equations
        initial = [e.form.read(value) for value in self.problem.initial.values()]
        return [
            *(entry for row in e.mass for entry in row),
            *e.forcing,
            *(entry for row in e.rows for entry in row),
            *e.bias,
            *e.positions,
            *e.rates,
            *initial,
            *self.nodes,
            *(node for _, _, node in self.margins),
            *self.charges.values(),
            *([self.reading(self.asked.stop_when)] if self.asked.stop_when else []),
        ]

    # -- in doubles ------------------------------------------------------------------------------

    def result(self) -> Result:
        """The table."""
        arithmetic = Doubles()
        constants = constants_of(self.equations, self.all_nodes, arithmetic)
        motion = Motion(self.equations, constants, arithmetic)
        q, v = initial_state(motion, project=self.asked.project)
        self._check_start(motion, q, v)
        outcome = self._doubles(motion, q, v)
        beyond = self._beyond(outcome)
        if beyond is not None:
            from lagcli.numerics.precise import precise_outcome

            precise = precise_outcome(self, q, v, beyond)
            if precise is not None and precise.good_rows >= outcome.good_rows:
                outcome = precise
        return result_of(self, motion, outcome)

    def _beyond(self, outcome: Outcome) -> int | None:
        """How many digits to go on with, where doubles do not reach the accuracy."""
        if self.asked.method == "taylor":
            return self.asked.digits or _DIGITS
        if outcome.reached or self.asked.method == "dop853":
            return None
        if self.asked.digits is not None:
            return self.asked.digits
        stopped = outcome.run.stop is not None
        close = max(outcome.errors) <= _ROUNDING_REACH
        return _DIGITS if close and not stopped else None

    def _doubles(self, motion: Motion, q: list[float], v: list[float]) -> Outcome:
        asked = self.asked
        conditions = self.conditions(motion, q, v)
        tabulate = self.tabulator(motion)
        generated = generated_step(motion.n, motion.accelerations)
        # every other run begins at the next double: what the initial values are rounded by
        # must not matter either
        rounded = rounded_components(motion, q, v)
        moved = [
            math.nextafter(x, math.inf) if inexact else x
            for x, inexact in zip((*q, *v), rounded, strict=True)
        ]
        nudged = (moved[: motion.n], moved[motion.n :])
        total = 2  # runs that progress is told of

        def runner(
            tolerance: float, longest: float, peaks: Sequence[float] | None, every: int
        ) -> Run:
            surface = Surface(motion) if self.equations.rows else None
            bound = Tolerance(tolerance, motion.n, asked.until, longest, peaks)
            run = Run(motion, Dop853(motion, surface, generated), surface, bound, conditions)
            done = self.finished

            def told(part: float) -> None:
                if self.progress is not None:
                    self.progress((done + part) / max(total, done + 1))

            state = (q, v) if self.finished % 2 else nudged
            run.go(*state, self.times, probe_every=every, progress=told)
            self.finished += 1
            return run

        return Controller(
            runner,
            tabulate,
            accuracy=asked.accuracy,
            finest=FINEST_DOUBLE,
            span=asked.until,
            charges=len(self.charges),
        ).outcome()

    def _check_start(self, motion: Motion, q: list[float], v: list[float]) -> None:
        """Whether anything moves at all: the accelerations at t = 0."""
        try:
            found = motion.accelerations(0.0, *q, *v)
            if all(math.isfinite(a) for a in found):
                return
            reason = "they are not finite"
        except (ArithmeticError, ValueError) as error:
            reason = told(error)
        raise Refusal(f"at t = 0 the accelerations are not determined: {reason}", mistake=False)

    # -- for any numbers --------------------------------------------------------------------------

    def conditions(self, motion: Motion, q: Sequence[Any], v: Sequence[Any]) -> list[Condition]:
        """The contacts, and `--stop-when`."""
        found = [
            Condition(name, what, self._watched(motion, node)) for name, what, node in self.margins
        ]
        if self.asked.stop_when is not None:
            margin = self._watched(motion, self.stop_node(motion, self.asked.stop_when, q, v))
            found.append(Condition(self.asked.stop_name, "stopped", margin))
        return found

    def stop_node(
        self, motion: Motion, expression: Expression, q: Sequence[Any], v: Sequence[Any]
    ) -> Node:
        """The expression with the sign that it has, or takes, at the beginning."""
        node = self.reading(expression)
        rate = self.equations.form.read.total_derivative(node)
        for each in (node, rate):
            try:
                value = float(Values(motion, self.reading, [each])(0.0, q, v)[0])
            except (ArithmeticError, ValueError, KeyError):
                continue
            if value:
                return self.equations.graph.scaled(node, 1 if value > 0 else -1)
        return node

    def _watched(self, motion: Motion, node: Node) -> Callable[..., float]:
        values = Values(motion, self.reading, [node])

        def margin(t: float, q: Sequence[Any], v: Sequence[Any]) -> float:
            [value] = values(t, q, v)
            return math.inf if value is None else float(value)

        return margin

    def tabulator(self, motion: Motion) -> Row:
        """The columns and then the charges at a state."""
        nodes = [*self.nodes, *self.charges.values()]
        values = Values(motion, self.reading, nodes)
        single: list[Values] = []

        def row(t: float, q: Sequence[Any], v: Sequence[Any]) -> list[Any]:
            try:
                found = values(t, q, v)
                if all(x is None or math.isfinite(float(x)) for x in found):
                    return found
            except (ArithmeticError, ValueError):
                pass
            if not single:
                single.extend(Values(motion, self.reading, [node]) for node in nodes)
            return [_one(each, t, q, v) for each in single]

        return row


def _one(values: Values, t: float, q: Sequence[Any], v: Sequence[Any]) -> Any:
    """A column where it is defined, else None."""
    try:
        [value] = values(t, q, v)
    except (ArithmeticError, ValueError):
        return None
    return value if value is None or math.isfinite(float(value)) else None
