"""What the exit status says."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """The exit status of every command."""

    WELL = 0
    NOT_FOUND = 1  # a check failed, an answer was not found, or lagcli itself is wrong
    USAGE = 2  # the command line or a file is wrong
    INTERRUPTED = 130  # 128 + SIGINT, as shells have it
