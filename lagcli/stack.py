"""Room for deep recursion: formulas are trees, and the algebra walks them by recursion."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import TypeVar

_FRAMES = 60_000
_BYTES = 512 * 1024 * 1024  # of address space; only what is used is taken

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

    thread = _started(run)
    thread.join()  # an interrupt is raised here, in the main thread
    if errors:
        raise errors[0]
    return results[0]


def _started(run: Callable[[], None]) -> threading.Thread:
    """A thread with the largest stack that this machine grants."""
    size = _BYTES
    while True:
        before = threading.stack_size(size)
        thread = threading.Thread(target=run, name="lagcli", daemon=True)
        try:
            thread.start()
        except RuntimeError:  # not so much address space here (ulimit -v)
            if size <= 1024 * 1024:
                raise
            size //= 4
        else:
            # about 8 KiB of C stack for a Python frame called from C
            sys.setrecursionlimit(max(1000, min(_FRAMES, size // 8192)))
            return thread
        finally:
            threading.stack_size(before)
