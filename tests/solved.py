"""The answers to a problem, as the sections state them."""

from collections.abc import Sequence

from lagcli.pipeline import Request, derive, state
from lagcli.problem_data import Problem
from lagcli.statements.answers import Answers


def solve(problem: Problem, sections: Sequence[str] | None = None) -> Answers:
    """Derive and state what the sections (the usual ones for None) say of a problem."""
    return state(derive(problem), Request(sections=None if sections is None else tuple(sections)))
