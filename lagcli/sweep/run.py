"""All members of an ensemble on all cores, in chunks that are kept as they come."""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from itertools import islice

from lagcli.numerics.asked import Asked
from lagcli.problem import Problem
from lagcli.sweep.journal import Journal
from lagcli.sweep.members import Member, Row, rows_of
from lagcli.sweep.plan import Plan
from lagcli.sweep.table import KNOWN, Table

#: Members of a chunk: enough to share the machine code, few enough to lose little.
_CHUNK = 100
#: Chunks that wait for a process, for each process.
_AHEAD = 4

Progress = Callable[[float, float], None]


def sweep(
    problem: Problem,
    asked: Asked,
    plan: Plan,
    journal: Journal,
    *,
    along: bool = False,
    jobs: int = 1,
    progress: Progress | None = None,
) -> Table:
    """Run every member.

    Parameters
    ----------
    problem : Problem
    asked : Asked
        Columns, span and accuracy of each motion.
    plan : Plan
        The members.
    journal : Journal
        Where finished chunks are kept; those that are there already are not made again.
    along : bool
        Every row of each motion; otherwise its end.
    jobs : int
        Processes.
    progress : function, optional
        Told how many of how many chunks are done.

    Returns
    -------
    Table
        In the order of the plan, whatever ended first.
    """
    columns = (*plan.columns, *(column.name for column in asked.columns), *KNOWN)
    chunks = list(_chunks(plan))
    todo = [(k, chunk) for k, chunk in enumerate(chunks) if k not in journal.done]
    for k, rows in _made(problem, asked, plan.names, todo, along=along, jobs=jobs):
        journal.keep(k, rows)
        if progress is not None:
            progress(len(journal.done), len(chunks))
    made = [tuple(row) for k in range(len(chunks)) for row in journal.done[k]]
    return Table(columns=columns, rows=tuple(made), varied=plan.columns)


def _chunks(plan: Plan) -> Iterator[list[tuple[float, ...]]]:
    members = plan.members()
    size = max(1, min(_CHUNK, plan.count // 8))
    while chunk := list(islice(members, size)):
        yield chunk


def _made(
    problem: Problem,
    asked: Asked,
    names: Sequence[str],
    todo: Sequence[tuple[int, Sequence[Member]]],
    *,
    along: bool,
    jobs: int,
) -> Iterator[tuple[int, list[Row]]]:
    if jobs == 1 or len(todo) < 2:
        for k, chunk in todo:
            yield k, rows_of(problem, asked, names, chunk, along=along)
        return
    kind = "fork" if sys.platform == "linux" else "spawn"
    context = multiprocessing.get_context(kind)
    waiting = iter(todo)
    with ProcessPoolExecutor(jobs, mp_context=context, initializer=_leave_signals) as pool:
        running: dict[Future[list[Row]], int] = {}
        while True:
            for k, chunk in islice(waiting, max(0, _AHEAD * jobs - len(running))):
                running[pool.submit(rows_of, problem, asked, names, chunk, along=along)] = k
            if not running:
                return
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                yield running.pop(future), future.result()


def _leave_signals() -> None:
    """Ctrl-C is the parent's to answer."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
