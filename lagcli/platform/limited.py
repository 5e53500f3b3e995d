"""Work that ends: a call that takes more than it is allowed is stopped, wherever it is.

Whether it is stopped depends on the work that is counted (`work_done`), not on a clock: a
watcher compares it with the limit now and then, and once more at the end.  What does nothing
that is counted is stopped by the processor time of the process, the only clock here.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TypeVar

from lagcli.platform.effort import OutOfWork, work_done

_EVERY = 0.2  # seconds between two looks; a look takes 0.3 ms
_AGAIN = 10  # looks after which a call that has swallowed the exception is given another

Result = TypeVar("Result")


def limited(call: Callable[[], Result], units: float, seconds: float) -> Result:
    """What the call returns.

    Parameters
    ----------
    units
        How much counted work it may do.
    seconds
        Processor time of the process, for what counts nothing.

    Raises
    ------
    OutOfWork
        When it takes more.  What it was working on is then in no certain state.
    """
    watcher = _Watcher(work_done() + units, time.process_time() + seconds)
    _limits.append(watcher)
    try:
        result = call()
        watcher.close()
    except BaseException:
        watcher.close()
        raise
    finally:
        _limits.remove(watcher)
    if work_done() > watcher.end:
        raise OutOfWork
    return result


def limited_to(share: float, call: Callable[[], Result]) -> Result:
    """What the call returns, within a share of what the call around it has left."""
    if not _limits:
        return call()
    around = _limits[-1]
    units, seconds = around.end - work_done(), around.last_second - time.process_time()
    return limited(call, share * units, share * seconds)


class _Watcher:
    """Raises `OutOfWork` in the thread that made it, once that has done too much."""

    def __init__(self, end: float, last_second: float) -> None:
        self.end = end
        self.last_second = last_second
        self._thread = threading.get_ident()
        self._lock = threading.Lock()
        self._closed = threading.Event()
        threading.Thread(target=self._watch, name="lagcli limit", daemon=True).start()

    def close(self) -> None:
        """Stop watching; what was raised and has not arrived is taken back."""
        with self._lock:
            self._closed.set()
            if self._raised:
                _raise_in(self._thread, None)

    _raised = False

    def _watch(self) -> None:
        looks = 0
        while not self._closed.wait(_EVERY):
            over = work_done() > self.end or time.process_time() > self.last_second
            if over and looks % _AGAIN == 0:
                with self._lock:
                    if not self._closed.is_set():
                        self._raised = True
                        _raise_in(self._thread, OutOfWork)
            looks += over


_limits: list[_Watcher] = []  # of the calls that are running, the innermost last


def _raise_in(thread: int, exception: type[BaseException] | None) -> None:
    """Raise an exception in another thread at its next instruction; None: take it back."""
    import ctypes

    raising = None if exception is None else ctypes.py_object(exception)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raising)
