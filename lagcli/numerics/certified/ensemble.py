"""Motions of one problem from many initial states: equations and machine code are made once."""

from __future__ import annotations

from lagcli.numerics.certified.simulate import Simulation, simulate
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.problem_data import Problem


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
        self._simulation = simulation = Simulation(problem, request)
        plain = not (problem.constraints or problem.contacts or simulation.equations.kinks)
        self._shares = plain and request.stop_when is None
        if self._shares:
            self._integrated, self._modes = simulation.ready()
            self._shares = self._integrated is simulation

    def result(self, problem: Problem) -> Result:
        """The motion of a member.

        Raises
        ------
        Refusal
            When it cannot be run.
        """
        if not self._shares:
            return simulate(problem, self._request)
        self._simulation.restart(problem, self._modes)
        return self._simulation.run(self._modes)
