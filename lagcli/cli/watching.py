"""A command again and again: whenever one of its files has changed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from time import sleep
from typing import NoReturn

import click

from lagcli.cli.error_output import report_line
from lagcli.cli.files import STANDARD

#: Seconds between two looks: shorter than an editor takes to save and an eye to move.
_PAUSE = 0.2
_CLEAR = "\x1b[2J\x1b[3J\x1b[H"

#: Of each file its time, its size and its place on the disk; nothing where it is missing.
Look = dict[Path, tuple[int, int, int]]


def watch(files: Sequence[str], answer: Callable[[], int]) -> NoReturn:
    """Answer, and answer again after each change; Ctrl-C ends it.

    Parameters
    ----------
    files : sequence of str
        Files, folders, or names of the library.
    answer : function
        The command; its mistakes are shown, and the files are watched on.

    Raises
    ------
    click.UsageError
        Where standard input is among the files.
    KeyboardInterrupt
        At Ctrl-C.
    """
    if STANDARD in files:
        raise click.UsageError("--watch needs a file, which standard input is not")
    while True:
        seen = _look(files)
        if sys.stdout.isatty():
            sys.stdout.write(_CLEAR)
        answer()
        sys.stdout.flush()
        changed = _wait(files, seen)
        if not sys.stdout.isatty():
            report_line(f"{', '.join(changed)}: changed")


def _wait(files: Sequence[str], seen: Look) -> list[str]:
    """Wait for a change, and for files that an editor is putting in place of old ones."""
    while True:
        sleep(_PAUSE)
        now = _look(files)
        if now != seen and seen.keys() <= now.keys():
            return [str(path) for path in now if now[path] != seen.get(path)]
        if len(now) < len(seen) and any(Path(name).is_dir() for name in files):
            return [str(path) for path in seen if path not in now]


def _look(files: Sequence[str]) -> Look:
    found: Look = {}
    for path in map(Path, files):
        try:
            inside = [*path.rglob("*.y*ml")] if path.is_dir() else [path]
            for each in inside:
                state = each.stat()
                found[each] = (state.st_mtime_ns, state.st_size, state.st_ino)
        except OSError:
            continue
    return found
