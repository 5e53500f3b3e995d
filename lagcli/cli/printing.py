"""Where the result goes, in which form, and what was said beside it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

    from lagcli.formatters import Options

PIPE_WIDTH = 80


class Printing(NamedTuple):
    """Where to, and in which form."""

    format_name: str
    output: Path | None
    standalone: bool
    width: int | None

    @property
    def columns(self) -> int:
        """As asked for; else those of the terminal, or 80."""
        if self.width:
            return self.width
        if self.output is not None or not sys.stdout.isatty():
            return PIPE_WIDTH
        from shutil import get_terminal_size

        return get_terminal_size((PIPE_WIDTH, 24)).columns

    @property
    def encoding(self) -> str:
        """UTF-8, but for text on a terminal that has something else."""
        if self.output is not None or self.format_name != "text":
            return "utf-8"
        return sys.stdout.encoding or "utf-8"

    def options(self, *, several: bool) -> Options:
        """What the formatter is told of the place where its text will stand."""
        from lagcli.formatters import Options

        return Options(
            width=self.columns,
            unicode=self.encoding.lower().startswith("utf"),
            standalone=self.standalone,
            several=several,
        )
