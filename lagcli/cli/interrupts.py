"""Ctrl-C: it ends the process at once while modules are loaded, and is an exception afterwards.

`KeyboardInterrupt` in the middle of an import is often turned into another exception (a
`RuntimeError` where a class is being made), or is raised before anything can catch it.
"""

from __future__ import annotations

import os
import signal

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
    _handle(_raise)


def interrupted() -> bool:
    """Whether an interrupt came, whatever exception has become of it."""
    return bool(_came)


def _raise(*_: object) -> NoReturn:
    _came.append(True)
    raise KeyboardInterrupt


def _handle(handler: Callable[..., object]) -> None:
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:  # as behind nohup
        signal.signal(signal.SIGINT, handler)
