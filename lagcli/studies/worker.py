"""Processes that do one piece of work after another, killed where one takes too long."""

from __future__ import annotations

import multiprocessing
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import Any

from lagcli.platform.stack import with_deep_stack
from lagcli.record import record

#: Forked workers share what the parent has imported: SymPy's start-up is paid once.
_FORKS = sys.platform == "linux"
_PROCESSES = multiprocessing.get_context("fork") if _FORKS else multiprocessing.get_context("spawn")


class Worker:
    """A process that calls a function with what it is sent, and sends back what that returns.

    Parameters
    ----------
    work : function
        Of the module, so that a process that is not forked finds it.
    others : sequence of Worker
        Those that run already.
    """

    def __init__(self, work: Callable[..., Any], others: Sequence[Worker] = ()) -> None:
        self.connection, theirs = _PROCESSES.Pipe()
        inherited = [each.connection for each in (*others, self)] if _FORKS else []
        self._process = _PROCESSES.Process(
            target=_serve, args=(theirs, inherited, work), daemon=True
        )
        self._process.start()
        theirs.close()

    def kill(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.join()
        self.connection.close()

    def ended(self) -> int | None:
        """The exit status of a process that has closed its connection."""
        self._process.join()
        return self._process.exitcode


@record
class NoAnswer:
    """A task that was not done: its process took too long (None), or ended with a status."""

    status: int | None = None


class Pool:
    """Processes that work on tasks, each with a time limit that is kept by killing it.

    Parameters
    ----------
    work : function
        As for `Worker`.
    count
        How many work at the same time.
    """

    def __init__(self, work: Callable[..., Any], count: int) -> None:
        self._work, self._count = work, count
        self._workers: list[Worker] = []
        self._busy: dict[Worker, tuple[int, float]] = {}  # the place of its task, the deadline

    def answers(self, tasks: Sequence[tuple[Any, ...]], limit: float) -> Iterator[Any]:
        """What the work returns for each task, or `NoAnswer`, in the order of the tasks.

        Parameters
        ----------
        tasks
            The arguments of each.
        limit
            Seconds of wall time for each.
        """
        waiting, found = iter(enumerate(tasks)), dict[int, Any]()
        for place in range(len(tasks)):
            while place not in found:
                self._feed(waiting, limit)
                found.update(self._next())
            self._feed(waiting, limit)
            yield found.pop(place)

    def _feed(self, waiting: Iterator[tuple[int, tuple[Any, ...]]], limit: float) -> None:
        while len(self._busy) < self._count and (task := next(waiting, None)) is not None:
            free = [worker for worker in self._workers if worker not in self._busy]
            if not free:
                free = [Worker(self._work, self._workers)]
                self._workers += free
            self._busy[free[0]] = task[0], time.monotonic() + limit
            free[0].connection.send(task[1])

    def _next(self) -> Iterator[tuple[int, Any]]:
        """Wait for an answer or a deadline: what came, by the place of the task."""
        first = min(deadline for _, deadline in self._busy.values())
        ready = wait([w.connection for w in self._busy], max(0.0, first - time.monotonic()))
        for worker, (place, deadline) in list(self._busy.items()):
            if worker.connection in ready:
                yield place, self._answer_of(worker)
            elif time.monotonic() >= deadline:
                self._end(worker)
                yield place, NoAnswer()

    def _answer_of(self, worker: Worker) -> Any:
        try:
            answer = worker.connection.recv()
        except (EOFError, OSError):
            answer = NoAnswer(worker.ended())
            self._end(worker)
        else:
            del self._busy[worker]
        return answer

    def _end(self, worker: Worker) -> None:
        worker.kill()
        self._workers.remove(worker)
        del self._busy[worker]

    def stop(self) -> None:
        """End all processes."""
        for worker in self._workers:
            worker.kill()


def _serve(connection: Connection, others: Sequence[Connection], work: Callable[..., Any]) -> None:
    """Answer until the other end of the pipe is closed: the parent is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends its workers
    for other in others:  # else the end of the parent would not be seen here
        other.close()

    def serve() -> None:
        with suppress(EOFError, OSError):
            while True:
                connection.send(work(*connection.recv()))

    with_deep_stack(serve)
