"""Room for deep recursion: formulas are trees, and the algebra walks them by recursion."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import TypeVar

_BYTES = 512 * 1024 * 1024  # of address space; only what is used is taken
_LEAST_BYTES = 1024 * 1024
_BYTES_OF_FRAME = 8192  # of C stack, for a Python frame that is called from C

Result = TypeVar("Result")


def with_deep_stack(work: Callable[[], Result]) -> Result:
    """Call `work` where it may recurse deeply, and return or raise what it does.

    A thread has the stack that it was started with, the main thread that of the shell
    (8 MiB): so the work is done in a thread of its own.
    """
    results: list[Result] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            results.append(work())
        except BaseException as error:  # noqa: BLE001 - raised again below
            errors.append(error)

    usual = sys.getrecursionlimit()
    try:
        _started(run).join()  # an interrupt is raised here, in the main thread
    finally:
        sys.setrecursionlimit(usual)
    if errors:
        raise errors[0]
    return results[0]


def _started(run: Callable[[], None]) -> threading.Thread:
    """A thread with the largest stack that this machine grants, and as many frames."""
    size = _BYTES
    while True:
        sys.setrecursionlimit(max(1000, size // _BYTES_OF_FRAME))
        before = threading.stack_size(size)
        thread = threading.Thread(target=run, name="lagcli", daemon=True)
        try:
            thread.start()
        except RuntimeError:  # not so much address space here (ulimit -v)
            if size <= _LEAST_BYTES:
                raise
            size //= 4
        else:
            return thread
        finally:
            threading.stack_size(before)
