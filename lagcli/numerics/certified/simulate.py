"""A problem and what is asked of it -> a table with its certificate."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import nullcontext, suppress
from copy import copy
from itertools import pairwise
from typing import Any

from lagcli.graph.nodes import Node
from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.branches import on_one_branch, through_meeting
from lagcli.numerics.certified.certificate import result_of, rows_asked_for
from lagcli.numerics.certified.escalation import TIMES, first_tolerance, is_better, within_reach
from lagcli.numerics.certified.methods import (
    AUTO,
    METHODS,
    MORE_DIGITS,
    SHARP,
    SHARPER,
    STIFF,
    Precision,
    outcome_of,
)
from lagcli.numerics.certified.reduced_run import Cut, cut_simulation
from lagcli.numerics.certified.stiffness import STIFF as STIFFNESS
from lagcli.numerics.certified.stiffness import decay
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.columns import Column, Reading
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import one_sided, with_contacts
from lagcli.numerics.equations.equations import Equations
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal, told
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.equations.surface import ROUNDING
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import Asked, Result
from lagcli.numerics.integrators.dop853 import dop853
from lagcli.numerics.integrators.steps import NotPossible
from lagcli.problem import Problem, charge_of
from lagcli.record import replace

#: The intervals at which two runs are compared are at least so many.
_COMPARED = 100
_GOLDEN = 0.6180339887498949
#: Where the accuracy is lost between two rows, so many are compared there.
_CLOSER = 64
#: Doubles claim nothing better: the parameters are rounded too, alike in all runs.
_LEAST_DOUBLE = 1e-13
#: The clocks of two runs differ by less than this part of the span.
_SAME_TIME = 1e-12

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
        #: with the contacts among the constraints
        self.whole = with_contacts(problem)
        self.equations = equations = Equations(self.whole)
        self.reading = Reading(equations)
        #: the constraints that act at the beginning, whatever the contacts do
        self.given = frozenset(range(len(problem.constraints)))
        self.contacts = one_sided(self.whole, len(problem.constraints))
        try:
            self.stop = None if asked.stop_when is None else self.reading(asked.stop_when)
            self.nodes = [self._column(column) for column in asked.columns]
            self.margins = {
                k: self._margin(c.holds_while)
                for k, c in enumerate(self.whole.constraints)
                if c.holds_while is not None
            }
            self.gaps = self._gaps()
            self.charges = dict(equations.holding(frozenset()).evident_charges)
            self.candidates = self._candidates()
        except ArithmeticError as error:
            raise Refusal(f"a column is not defined: {error}") from None
        #: the rows asked for are those at multiples of this
        self.every = _parts_of_rows(asked)
        self.notes: list[str] = []
        #: what the model was cut by
        self.cut: Cut | None = None
        self.begin()

    def begin(self) -> None:
        """Nothing has been run."""
        self.times = self._times()
        #: so many of the times are those asked for, and what lies between them
        self.regular = len(self.times)
        self.finished = 0
        #: whether a run was so long that doubles were left for numbers of more bits
        self.is_long = False
        #: of one run with more digits than doubles, where it is an attempt
        self.most_steps: int | None = None
        #: what is said beside the reason for the method
        self.remark = ""
        #: the rows of the run over the whole span, certified or not, where they are requested
        self.whole_span: list[tuple[float | None, ...]] = []

    def restart(self, problem: Problem, modes: Modes) -> None:
        """Take another initial state of the same problem, without constraints or contacts.

        Raises
        ------
        Refusal
            When there is no motion from it.
        """
        self.problem = self.whole = self.equations.problem = problem
        self.begin()
        motion = modes.first.motion
        self.start = initial_state(motion, project=self.asked.project)
        self._check_start(motion, *self.start)

    def _column(self, column: Column) -> Node:
        if column.expression is None:
            return self.equations.t
        return self.reading(column.expression)

    def _times(self) -> list[float]:
        """The rows, and between them what two runs are compared at as well."""
        every, until = self.every, self.asked.until
        # out of step with whatever the rows asked for are in step with
        parts = [(k + (_GOLDEN * k % 1.0 - 0.5 if k else 0.0)) / every for k in range(every)]
        given = self.asked.times
        if given:
            between = [a + (b - a) * part for a, b in pairwise(given) for part in parts]
            return [*between, until]
        count = self.asked.samples - 1
        return [until * (k + part) / count for k in range(count) for part in parts] + [until]

    def _gaps(self) -> dict[int, Node]:
        """Of the contacts that can be open."""
        e = self.equations
        gaps = {}
        for k, contact in self.contacts.items():
            position = e.constraints[k].position
            if not contact.stops and position is not None:
                gaps[k] = e.graph.scaled(position, contact.sign)
        return gaps

    def _candidates(self) -> list[str]:
        """The names of the candidates' charges, which are added to the charges."""
        names = []
        for symmetry in self.problem.symmetries:
            name = symmetry.name
            while name in self.charges:
                name += "*"
            self.charges[name] = self.reading(charge_of(symmetry))
            names.append(name)
        return names

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
            *self.margins.values(),
            *self.gaps.values(),
            *self.charges.values(),
            *([self.stop] if self.stop is not None else []),
            *(e.form.read(c.restitution) for c in self.contacts.values() if c.restitution),
        ]

    # -- the run ---------------------------------------------------------------------------------

    def result(self) -> Result:
        """The table."""
        simulation, modes = self.ready()
        return simulation.run(modes)

    def run(self, modes: Modes) -> Result:
        """The table, from the state at the beginning, over the longest span that is certain."""
        outcome, result = self.first(modes)
        if not outcome.reached and self.asked.furthest:
            from lagcli.numerics.certified.horizon import longest

            result = longest(self, modes, outcome, result)
        return self._with_rows_beyond(result) if self.asked.beyond else result

    def _with_rows_beyond(self, result: Result) -> Result:
        """The result with the rows after those that are certified."""
        last = result.certificate.holds_until
        last += _SAME_TIME * self.asked.until
        is_cut = not result.certificate.reached
        beyond = (row for row in self.whole_span if is_cut and (row[0] or 0.0) > last)
        return replace(result, beyond=tuple(beyond))

    def over(self, asked: Asked) -> Simulation:
        """The same motion from the same state with other rows."""
        other = copy(self)
        other.asked = asked
        other.every = _parts_of_rows(asked)
        other.begin()
        other.finished = self.finished
        return other

    @property
    def rows_at(self) -> list[float]:
        """The times of the rows asked for."""
        return self._times()[:: self.every]

    def first(self, modes: Modes) -> tuple[Outcome, Result]:
        """What comes of the span as it is, reached or not."""
        outcome = self._outcome(modes)
        return outcome, result_of(self, modes.first.motion, outcome)

    def _outcome(self, modes: Modes) -> Outcome:
        """The pair of runs of the first method that reaches the accuracy, or comes furthest."""
        outcome: Outcome | None = None
        digits: Precision = nullcontext
        if self.asked.method == "auto" and decay(self, modes) > STIFFNESS:
            found, digits = self.attempt(STIFF, modes)
            if found and found.reached:
                self.whole_span = rows_asked_for(self, found)
                return on_one_branch(self, modes, found, digits)[0]
        for group in self._groups():
            names, first = (group, 1.0) if outcome is None else self._beyond(outcome, group)
            if names:
                found, with_digits = self.attempt(names, modes, first)
                if found and (outcome is None or is_better(found, outcome)):
                    outcome, digits = found, with_digits
        if outcome is None:
            outcome, digits = self.attempt(("dop853",), modes)
        if outcome is None:
            raise Refusal(f"no method for this problem{self.remark}", mistake=False)
        self.whole_span = rows_asked_for(self, outcome)
        if not outcome.reached:
            outcome, digits = through_meeting(self, modes, outcome, digits)
        if not outcome.reached:
            with digits(), suppress(NotPossible):
                outcome = outcome.controller.refined(outcome, self._between)
        return on_one_branch(self, modes, outcome, digits)[0]

    def ready(self) -> tuple[Simulation, Modes]:
        """What is integrated, this or less, in doubles; the initial state is found and tried."""
        arithmetic = Doubles()
        constants = constants_of(self.equations, self.all_nodes, arithmetic)
        modes = Modes(self, constants, arithmetic, dop853, ROUNDING)
        self.start = initial_state(modes.first.motion, project=self.asked.project)
        self._keep_conserved(modes)
        reduced = None if self.asked.whole else cut_simulation(self, modes, *self.start)
        if reduced is not None:
            modes = Modes(reduced, constants, arithmetic, dop853, ROUNDING)
        integrated = reduced or self
        self._check_start(modes.first.motion, *integrated.start)
        return integrated, modes

    def _between(self, good: float, bad: float) -> None:
        """Rows as they were up to a time, then many up to another."""
        kept = [t for t in self.times if t <= good]
        self.regular = len(kept)
        step = (bad - good) / _CLOSER
        self.times = [*kept, *(good + step * k for k in range(1, _CLOSER)), bad]
        if bad < self.asked.until:
            self.times.append(self.asked.until)

    def _groups(self) -> Sequence[Sequence[str]]:
        """The methods, each group for what those before it do not reach."""
        if self.asked.method != "auto":
            return ((self.asked.method,),)
        return AUTO[1:] if self.asked.accuracy < _LEAST_DOUBLE else AUTO

    def attempt(
        self, group: Sequence[str], modes: Modes, first: float = 1.0
    ) -> tuple[Outcome | None, Precision]:
        """What the first method gives that is possible, and its digits; why others are not.

        Its first tolerance is no coarser than `first`.
        """
        remark, names = "", list(group)
        while names:
            name = names.pop(0)
            made = METHODS[name].prepare(self, modes)
            if not isinstance(made, str):
                try:
                    found = outcome_of(self, modes, made, first)
                except NotPossible as reason:
                    made = str(reason)
                    if self.is_long:
                        self.remark += f"; not {name}: {made}"
                        return None, nullcontext
                    if names and reason.needs_digits and MORE_DIGITS not in names:
                        names[:0] = SHARPER
                        first = SHARP
                else:
                    self.remark += remark
                    return found, made.precision
            remark += f"; not {name}: {made}"
        if len(self._groups()) == 1:
            self.remark += remark
        return None, nullcontext

    def _beyond(self, outcome: Outcome, group: Sequence[str]) -> tuple[Sequence[str], float]:
        """The methods that may reach with more digits what was not reached, and from where on."""
        if outcome.reached:
            return (), 1.0
        if self.asked.digits is not None:
            return group, 1.0
        self.most_steps = TIMES * outcome.run.steps
        return within_reach(outcome, group), first_tolerance(outcome)

    @property
    def goes_on(self) -> bool:
        """Whether the motion may go on in another mode than the first."""
        return bool(self.gaps) or any(c.on_loss == "release" for c in self.problem.constraints)

    def _keep_conserved(self, modes: Modes) -> None:
        """Leave out the candidates that are conserved in no mode."""
        if not self.candidates:
            return
        kept = dict(zip(self.charges, modes.first.conserved, strict=True))
        shown = {column.name for column in self.asked.columns}
        self.notes = [
            f"{s.name} is shown without a gauge, since the file gives none: it is not conserved"
            for s in self.problem.symmetries
            if s.gauge is None and s.name in shown and not kept.get(s.name, True)
        ]
        if not self.goes_on:
            self.charges = {name: node for name, node in self.charges.items() if kept[name]}
            self.candidates = [name for name in self.candidates if kept[name]]
            del modes.first.conserved

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


def _parts_of_rows(asked: Asked) -> int:
    """Into how many intervals of comparison that between two rows is divided."""
    return max(1, -(-_COMPARED // (asked.samples - 1)))
