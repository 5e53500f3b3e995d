"""All members of an ensemble on all cores, in chunks that are kept as they come."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import islice

from lagcli.numerics.hybrid.request import RunRequest
from lagcli.problem_data import Problem
from lagcli.studies.sweep.journal import Journal
from lagcli.studies.sweep.members import Member, Row, rows_of
from lagcli.studies.sweep.plan import Plan
from lagcli.studies.sweep.table import KNOWN, Table
from lagcli.studies.sweep.workers import cluster, cores, in_order_of_arrival, one_at_a_time

#: Members of a chunk at least, and chunks at most: a chunk makes its machine code anew (some
#: 40 ms of CPU time, as ten members take), and it is what is lost when a run is killed.
_CHUNK, _CHUNKS = 100, 64

Progress = Callable[[float, float], None]


def sweep(
    problem: Problem,
    request: RunRequest,
    plan: Plan,
    journal: Journal,
    *,
    along: bool = False,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> Table:
    """Run every member.

    Parameters
    ----------
    problem : Problem
    request : RunRequest
        Columns, span and accuracy of each motion.
    plan : Plan
        The members.
    journal : Journal
        Where finished chunks are kept; those that are there already are not made again.
    along : bool
        Every row of each motion; otherwise its end.
    jobs : int
        Processes.
    scheduler : str, optional
        The address of a Dask scheduler, whose workers run the members instead.
    progress : function, optional
        Called with the number of chunks that are done, and of all.

    Returns
    -------
    Table
        In the order of the plan, whatever ended first.

    Raises
    ------
    NoCluster
        When the scheduler cannot be reached, or was lost; what was finished is in the journal.
    """
    columns = (*plan.columns, *(column.name for column in request.columns), *KNOWN)
    chunks = list(_chunks(plan))
    todo = [k for k in range(len(chunks)) if k not in journal.done]
    make = partial(rows_of, problem, request, plan.names, along=along)
    for place, rows in _made(make, [chunks[k] for k in todo], jobs, scheduler):
        journal.keep(todo[place], rows)
        if progress is not None:
            progress(len(journal.done), len(chunks))
    made = [tuple(row) for k in range(len(chunks)) for row in journal.done[k]]
    return Table(columns=columns, rows=tuple(made), varied=plan.columns)


def _chunks(plan: Plan) -> Iterator[Sequence[Member]]:
    members = plan.members()
    size = max(1, min(max(_CHUNK, plan.count // _CHUNKS), plan.count // 8))
    while chunk := list(islice(members, size)):
        yield chunk


def _made(
    make: Callable[[Sequence[Member]], list[Row]],
    parts: Sequence[Sequence[Member]],
    jobs: int,
    scheduler: str | None,
) -> Iterator[tuple[int, list[Row]]]:
    if scheduler is not None:
        with cluster(scheduler) as (workers, count):
            yield from in_order_of_arrival(partial(one_at_a_time, make), parts, workers, count)
    elif jobs == 1 or len(parts) < 2:
        yield from ((place, make(part)) for place, part in enumerate(parts))
    else:
        with cores(jobs) as pool:
            yield from in_order_of_arrival(make, parts, pool, jobs)
