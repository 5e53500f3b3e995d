"""Who runs the parts of a sweep: the cores of this machine, or the workers of a Dask cluster.

Either is an executor of `concurrent.futures`; the parts, and so the bytes, are the same.
"""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from itertools import islice
from threading import Lock, Thread
from typing import TypeVar

Part = TypeVar("Part")
Made = TypeVar("Made")

#: Parts that wait for a worker, for each worker.
_AHEAD = 4
#: Processes that Windows waits for at once.
_MOST = 61
#: Seconds in which a scheduler answers.
_ANSWERS = 10
#: python-flint's precision is one for all threads of a process.
_ONE_AT_A_TIME = Lock()


class NoCluster(Exception):
    """Processes or a scheduler cannot be reached, or were lost; the sentence says which."""


def in_order_of_arrival(
    make: Callable[[Part], Made], parts: Sequence[Part], workers: Executor, count: int
) -> Iterator[tuple[int, Made]]:
    """The place of each part and what was made of it, as they come."""
    waiting = iter(enumerate(parts))
    running: dict[Future[Made], int] = {}
    while True:
        for k, part in islice(waiting, max(0, _AHEAD * count - len(running))):
            running[workers.submit(make, part)] = k
        if not running:
            return
        done, _ = wait(running, return_when=FIRST_COMPLETED)
        for future in done:
            yield running.pop(future), future.result()


@contextmanager
def cores(jobs: int) -> Iterator[Executor]:
    """Processes of this machine."""
    context = multiprocessing.get_context("fork" if sys.platform == "linux" else "spawn")
    jobs = min(jobs, _MOST) if sys.platform == "win32" else jobs
    with ProcessPoolExecutor(jobs, mp_context=context, initializer=_prepared) as pool:
        try:
            yield pool
        except BrokenProcessPool:
            raise NoCluster("a process of this sweep was killed, or had no memory left") from None


def _prepared() -> None:
    """Ctrl-C is the parent's to answer; where the parent was killed, its process ends too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """The workers behind a Dask scheduler, and how many parts they run at once.

    Parameters
    ----------
    address : str
        As the scheduler prints it: `tcp://host:8786`.

    Raises
    ------
    NoCluster
        No Dask here, no scheduler there, no worker behind it, or it was lost on the way.
    """
    try:
        from distributed import Client
        from distributed.scheduler import KilledWorker
    except ImportError:
        raise NoCluster("--scheduler needs Dask: pip install 'lagcli[dask]'") from None
    logging.disable(logging.CRITICAL)  # Dask's own; what a user needs is in NoCluster
    try:
        client = Client(address, timeout=_ANSWERS, set_as_default=False)
    except (OSError, ValueError) as error:  # TimeoutError is an OSError
        logging.disable(logging.NOTSET)
        raise NoCluster(f"no scheduler answers at {address}: {_first_line(error)}") from None
    try:
        count = sum(client.nthreads().values())
        if not count:
            raise NoCluster(f"the scheduler at {address} has no workers: dask worker {address}")
        yield client.get_executor(pure=False), count
    except (CancelledError, KilledWorker, OSError) as error:
        reason = _first_line(error) or "the connection broke"
        raise NoCluster(
            f"the scheduler at {address}, or its workers, were lost: {reason}"
        ) from None
    finally:
        with suppress(OSError):
            client.close()
        logging.disable(logging.NOTSET)


def _first_line(error: BaseException) -> str:
    return str(error).partition("\n")[0]


def one_at_a_time(make: Callable[[Part], Made], part: Part) -> Made:
    """Run a part in a process whose threads run others: they wait for each other."""
    with _ONE_AT_A_TIME:
        return make(part)
