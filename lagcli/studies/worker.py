"""A process that does one piece of work after another, and is killed where it takes too long."""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from lagcli.platform.stack import with_deep_stack

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
