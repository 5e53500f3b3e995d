"""Ctrl-C: it ends the process at once while modules are loaded, and is an exception afterwards.

`KeyboardInterrupt` in the middle of an import is often turned into another exception (a
`RuntimeError` where a class is being made), or is raised before anything can catch it.  So the
handler is set before anything else is loaded, even `signal`, which makes enumerations first.
"""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]  # `signal` takes 2 ms to load
import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import NoReturn

_STATUS = 130  # 128 + SIGINT, as shells have it; cli/status.py takes too long to load
_came: list[bool] = []


def end_at_once() -> None:
    """Let an interrupt end the process without a word."""
    _handle(lambda *_: os._exit(_STATUS))


def raise_exceptions() -> None:
    """Let an interrupt raise `KeyboardInterrupt`, and be remembered."""
    sys.unraisablehook = _end_where_nothing_is_raised
    _handle(_raise)


def interrupted() -> bool:
    """Whether an interrupt came, whatever exception has become of it."""
    return bool(_came)


def _raise(*_: object) -> NoReturn:
    _came.append(True)
    raise KeyboardInterrupt


def _end_where_nothing_is_raised(unraisable: sys.UnraisableHookArgs) -> None:
    """In a finalizer or the callback of a weak reference an exception is only printed."""
    if issubclass(unraisable.exc_type, KeyboardInterrupt):
        os._exit(_STATUS)
    sys.__unraisablehook__(unraisable)


def _handle(handler: Callable[..., object]) -> None:
    if _signal.getsignal(_signal.SIGINT) != _signal.SIG_IGN:  # as behind nohup
        _signal.signal(_signal.SIGINT, handler)
