"""The problem files under some paths."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lagcli.library import files_in, files_named

STANDARD = "-"  # standard input


class NothingToCheck(Exception):
    """Paths where there is no problem; `lines` say which and why."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("; ".join(lines))
        self.lines = tuple(lines)


def problem_files(paths: Sequence[str]) -> list[str]:
    """The files named, and those under the folders named, each once and in order.

    Raises
    ------
    NothingToCheck
        With a line for each path that holds no problem.
    """
    files: dict[str, None] = {}
    mistakes: list[str] = []
    for name in paths:
        try:
            files.update(dict.fromkeys(_files_of(name)))
        except OSError as error:
            mistakes.append(f"{name}: error: {error.strerror}")
    if mistakes:
        raise NothingToCheck(mistakes)
    return list(files)


def _files_of(name: str) -> list[str]:
    path = Path(name)
    if path.is_dir():
        return files_in(path)
    if name == STANDARD or path.exists():
        return [name]
    return files_named(name)
