"""The problem files under some paths."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

SUFFIXES = (".yaml", ".yml")


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
        path = Path(name)
        if path.is_dir():
            found = sorted(
                file for file in path.rglob("*") if file.suffix in SUFFIXES and file.is_file()
            )
            if not found:
                mistakes.append(f"{name}: error: no problem (*.yaml) in this folder")
            files.update(dict.fromkeys(map(str, found)))
        elif path.exists():
            files[name] = None
        else:
            mistakes.append(f"{name}: error: no such file or directory")
    if mistakes:
        raise NothingToCheck(mistakes)
    return list(files)
