"""What a process costs, and the rows that are made of it."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
LAGCLI = [str(Path(sys.executable).with_name("lagcli"))]
IMPORT_TYPER = [sys.executable, "-c", "import typer"]
IMPORT_SYMPY = [sys.executable, "-c", "import sympy"]


@dataclass(frozen=True)
class Cost:
    """CPU seconds (user and system), seconds on the wall and the peak memory of a process."""

    cpu: float
    wall: float
    peak_mib: int
    status: int
    out: bytes
    mistakes: str

    @property
    def answered(self) -> bool:
        """Whether lagcli came to its end; status 1 alone says that something was not found."""
        return self.status in {0, 1} and "error: " not in self.mistakes


def cost(command: Sequence[str], good: Sequence[int] = (0,), limit: int | None = None) -> Cost:
    """Run a command to its end.

    Parameters
    ----------
    good
        Exit statuses that are none of a mistake.
    limit
        CPU seconds after which the system ends it; then no status is a mistake.
    """
    if limit is not None:
        command = ["/bin/sh", "-c", f'ulimit -t {limit}; exec "$@"', "sh", *command]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as mistakes:
        began = time.perf_counter()
        process = subprocess.Popen(command, cwd=ROOT, stdout=out, stderr=mistakes)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - began
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        mistakes.seek(0)
        told = mistakes.read().decode()
        if limit is None and process.returncode not in good:
            raise SystemExit(f"{' '.join(command)}: {told}")
        cpu, peak = used.ru_utime + used.ru_stime, used.ru_maxrss // 1024
        return Cost(cpu, wall, peak, process.returncode, out.read(), told)


@dataclass(frozen=True)
class Row:
    """A measured value with its bar, which it must not exceed (or, `at_least`, not fall below)."""

    what: str
    value: float | None
    unit: str
    bar: float | None = None
    at_least: bool = False
    note: str = ""

    @property
    def holds(self) -> bool:
        """Whether the bar holds; a row without one only tells."""
        if self.bar is None:
            return True
        if self.value is None:
            return False
        return self.value >= self.bar if self.at_least else self.value <= self.bar

    def kept(self) -> dict[str, Any]:
        """The row as it is kept."""
        value = None if self.value is None else round(self.value, 4)
        return {**asdict(self), "value": value, "holds": self.holds}


def show(row: Row) -> None:
    """Print the row as soon as there is one."""
    value = "-" if row.value is None else f"{row.value:.2f}"
    bar = "" if row.bar is None else f"{'≥' if row.at_least else '≤'} {row.bar:g}"
    told = "" if row.bar is None else "holds" if row.holds else "MISSED"
    note = f"  ({row.note})" if row.note else ""
    print(f"{row.what:44} {value:>8} {row.unit:16} {bar:8} {told:6}{note}".rstrip(), flush=True)
