"""Some members of an ensemble, one after another, in one process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import ulp
from typing import TYPE_CHECKING

from lagcli.diagnostics import ProblemError
from lagcli.expression import Name, signed
from lagcli.numerics.certified.ensemble import Ensemble
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.record import replace

if TYPE_CHECKING:
    from lagcli.problem_data import Problem

Member = Sequence[float]
Row = list[float | None]


def rows_of(
    problem: Problem,
    request: RunRequest,
    names: Sequence[str],
    members: Sequence[Member],
    *,
    along: bool,
) -> list[Row]:
    """The rows of some members.

    Parameters
    ----------
    problem : Problem
    request : RunRequest
        Columns and span.
    names : sequence of str
        What a member's values are given to, parameters first.
    members : sequence
        Values, in the order of `names`.
    along : bool
        Every row of a motion; otherwise the last one.

    Returns
    -------
    list of rows
        The values of the member, the columns, and what is known of them: 1 where the accuracy
        holds at this row's motion to its end, until when it holds, the largest error.
    """
    free = {one.name for one in problem.parameters}
    split = sum(name in free for name in names)
    rows: list[Row] = []
    for values, group in groupby(members, key=lambda member: tuple(member[:split])):
        fixed = problem.with_values(dict(zip(names[:split], map(signed, values), strict=True)))
        rows += _of_one_system(fixed, request, names[split:], list(group), values, along=along)
    return rows


def _of_one_system(
    problem: Problem,
    request: RunRequest,
    names: Sequence[str],
    members: Sequence[Member],
    values: Sequence[float],
    *,
    along: bool,
) -> Iterator[Row]:
    ensemble: Ensemble | None = None
    for member in members:
        started = _with_state(problem, names, member[len(values) :])
        try:
            ensemble = ensemble or Ensemble(started, request)
            found = ensemble.result(started)
        except (Refusal, ProblemError, ArithmeticError):
            yield _row(member, [None] * len(request.columns), reached=0.0, until=0.0, error=None)
            continue
        yield from _rows(member, found, along=along, given=bool(request.times))


def _rows(member: Member, found: Result, *, along: bool, given: bool) -> Iterator[Row]:
    held = found.certificate
    stops = [event for event in found.events if event.what == "stopped"]
    late = [(event.error + ulp(event.t)) / held.scales[0] for event in stops]
    error = max([*held.global_error.values(), *late], default=0.0)
    rows = found.rows[given:] if along else found.rows[-1:]  # times that are given follow 0
    for row in rows or [(None,) * len(found.columns)]:
        yield _row(member, row, float(held.reached), held.holds_until, error)


def _row(
    member: Member, row: Sequence[float | None], reached: float, until: float, error: float | None
) -> Row:
    return [*member, *row, reached, until, error]


def _with_state(problem: Problem, names: Sequence[str], values: Sequence[float]) -> Problem:
    initial = dict(problem.initial)
    for name, value in zip(names, values, strict=True):
        primes = len(name) - len(name.rstrip("'"))
        initial[Name(name.rstrip("'"), primes)] = signed(value)
    return replace(problem, initial=initial)
