"""A problem and a request -> a table with its certificate."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext, suppress

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.attempts import attempt, groups
from lagcli.numerics.certified.branches import is_met, is_sharp, on_one_branch
from lagcli.numerics.certified.certificate import requested_rows, result_of
from lagcli.numerics.certified.escalation import (
    FEW,
    TIMES,
    first_tolerance,
    is_better,
    is_marginal,
    with_rounding,
    within_reach,
)
from lagcli.numerics.certified.methods import SHARP, SHARPER, STIFF
from lagcli.numerics.certified.prepared import Precision
from lagcli.numerics.certified.ready_setup import ReadySetup
from lagcli.numerics.certified.stiffness import STIFF as STIFFNESS
from lagcli.numerics.certified.stiffness import decay
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.integrators.steps import Grazes, NotPossible
from lagcli.problem_data import Problem
from lagcli.record import replace

#: The clocks of two runs differ by less than this part of the span.
_SAME_TIME = 1e-12
#: Whether a contact is struck may be known to a finer accuracy, down to what doubles reach, if that
#: is reached: 1e-10 tells a ray 2e-10 inside of a disc from a graze; behind it 1e-12 is not.
_FINER, _FINEST = 0.1, 1e-12


def simulate(problem: Problem, request: RunRequest, progress: Progress = None) -> Result:
    """Run a problem.

    Parameters
    ----------
    problem
        With values for its parameters and an initial state.
    request
        Span, accuracy, columns.
    progress
        Called now and then with the part of the span that is done.

    Raises
    ------
    Refusal
        When there is nothing to run: values are missing, the initial state is off the
        constraints, the accelerations are not determined.
    """
    return Simulation(problem, request, progress).result()


class Simulation(ReadySetup):
    """A setup, run."""

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
        self.start = initial_state(motion, project=self.request.project)
        self.check_start(motion, *self.start)

    # -- the run ---------------------------------------------------------------------------------

    def result(self) -> Result:
        """The table."""
        simulation, modes = self.ready()
        return simulation.run(modes)

    def run(self, modes: Modes) -> Result:
        """The table, from the state at the beginning, over the longest span that is certain."""
        outcome, result = self.first(modes)
        if (decided := self._told_from_a_graze(modes, outcome)) is not None:
            return decided
        is_last = outcome.run.method_name in self._last_methods and is_marginal(outcome)
        if self.request.furthest and (is_last or not outcome.reached):
            from lagcli.numerics.certified.horizon import longest

            def run(request: RunRequest) -> Result:
                return self.over(request).first(modes)[1]

            result = longest(self, modes, outcome, result, run)
        return self._with_rows_beyond(result) if self.request.beyond else result

    def _told_from_a_graze(self, modes: Modes, outcome: Outcome) -> Result | None:
        """The result of a finer accuracy that tells whether what is grazed is struck.

        Where one of its runs strikes and the other does not, the next one is tried.
        """
        accuracy = finer = self.request.accuracy
        grazes = isinstance(outcome.run.stop, Grazes)
        while grazes and finer > _FINEST:
            finer = max(_FINER * finer, _FINEST)
            request = replace(self.request, accuracy=finer, furthest=False)
            found = self.over(request).first(modes)[1]
            if found.certificate.reached:
                return replace(found, certificate=replace(found.certificate, accuracy=accuracy))
        return None

    @property
    def _last_methods(self) -> Sequence[str]:
        """Those after which none has more digits."""
        has_events = self.request.method == "auto" and (self.goes_on or self.equations.kinks)
        return ("taylor80",) if has_events else groups(self.request)[-1]

    def _with_rows_beyond(self, result: Result) -> Result:
        """The result with the rows after those that are certified."""
        last = result.certificate.holds_until
        last += _SAME_TIME * self.request.until
        is_cut = not result.certificate.reached
        beyond = (row for row in self.whole_span if is_cut and (row[0] or 0.0) > last)
        return replace(result, beyond=tuple(beyond))

    def first(self, modes: Modes) -> tuple[Outcome, Result]:
        """What comes of the span as it is, reached or not."""
        outcome = self._outcome(modes)
        return outcome, result_of(self, modes.first.motion, outcome)

    def _outcome(self, modes: Modes) -> Outcome:
        """The pair of runs of the first method that reaches the accuracy, or comes furthest."""
        outcome: Outcome | None = None
        digits: Precision = nullcontext
        if self.request.method == "auto" and decay(self, modes) > STIFFNESS:
            found, digits = attempt(self, STIFF, modes)
            if found and found.reached:
                self.whole_span = requested_rows(self, found)
                return on_one_branch(self, modes, found, digits)[0]
        for group in groups(self.request):
            names, first = (group, 1.0) if outcome is None else self._beyond(outcome, group)
            if names:
                found, with_digits = attempt(self, names, modes, first)
                if found and outcome is not None:
                    found = with_rounding(found, outcome)
                if found and (outcome is None or is_better(found, outcome)):
                    outcome, digits = found, with_digits
        if outcome is None:
            outcome, digits = attempt(self, ("dop853",), modes)
        if outcome is None:
            raise Refusal(f"no method for this problem{self.remark}", mistake=False)
        self.whole_span = requested_rows(self, outcome)
        if not outcome.reached:
            outcome = outcome.controller.furthest(outcome)
        if not outcome.reached and self.request.furthest:
            with digits(), suppress(NotPossible):
                outcome = outcome.controller.refined(outcome, self.look_between)
        return on_one_branch(self, modes, outcome, digits)[0]

    def _beyond(self, outcome: Outcome, group: Sequence[str]) -> tuple[Sequence[str], float]:
        """The methods that may reach with more digits what was not reached, and from where on."""
        if outcome.reached:
            return (), 1.0
        if self.request.digits is not None:
            return group, 1.0
        self.most_steps = TIMES * max(outcome.run.steps, FEW)
        if is_sharp(outcome):
            return (), 1.0
        if is_met(outcome):
            return SHARPER, SHARP
        return within_reach(outcome, group), first_tolerance(outcome)
