"""Motions of one problem from many initial states: equations and machine code are made once."""

from __future__ import annotations

from lagcli.numerics.certified.ready_setup import check_start, ready_setup
from lagcli.numerics.certified.simulate import certified_run, simulate
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.hybrid.setup import Setup
from lagcli.problem_data import Problem
from lagcli.record import replace


class Ensemble:
    """The members of an ensemble that differ in their initial state.

    Each is run with its own certificate, as `simulate` would.  With constraints, contacts or
    switching functions what is integrated depends on the state, so nothing is shared.

    Parameters
    ----------
    problem
        One of the members.
    request
        The same for all.

    Raises
    ------
    Refusal
        When this member cannot be run.
    """

    def __init__(self, problem: Problem, request: RunRequest) -> None:
        self._request = request
        self._ready: tuple[Setup, Modes] | None = None
        if problem.constraints or problem.contacts or request.stop_when is not None:
            return
        setup, modes = ready_setup(problem, request)
        if setup.cut is None and not setup.equations.kinks:
            self._ready = setup, modes

    def result(self, problem: Problem) -> Result:
        """The motion of a member.

        Raises
        ------
        Refusal
            When it cannot be run.
        """
        if self._ready is None:
            return simulate(problem, self._request)
        setup, modes = self._ready
        motion = modes.first.motion
        start = initial_state(motion, problem.initial, project=self._request.project)
        check_start(motion, *start)
        setup = replace(setup, problem=problem, whole=problem, start=start)
        return certified_run(setup, modes.by(modes.make_method, setup))
