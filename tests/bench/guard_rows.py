"""What it costs that no step passes over a narrow feature: whole runs with the guard, and without it.

Every problem of the library with values and an initial state, over its own span or 10.  Both runs
are fresh processes that import the same modules; in one nothing is looked at (`narrow_parts`
finds nothing).  CPU time of the process, the certificate included; the least of a few runs.

    python tests/bench/guard_rows.py [FILE]...
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median

import yaml

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.bench.library import paths
from tests.bench.measure import ROOT, Row, cost, show

_BAR = 1.25
#: Those that run for longer are left out.
_LIMIT, _UNTIL, _ACCURACY = 30, "10", "1e-9"
_WITH = """
import sys
from lagcli.cli import main
from lagcli.numerics.compiled import machine
from lagcli.numerics.integrators import sight
"""
_WITHOUT = _WITH + "machine.narrow_parts = sight.narrow_parts = lambda *a, **k: []\n"


def rows(files: Sequence[str], runs: int) -> Iterator[Row]:
    """The largest ratios, then the median."""
    found = []
    for file in files:
        ratio = _ratio(file, runs)
        if ratio is not None:
            found.append((ratio, file))
    for ratio, file in sorted(found)[-5:]:
        yield Row(f"  guard, {file}", ratio, "x")
    middle = median(ratio for ratio, _ in found) if found else None
    yield Row("guard against steps over, median", middle, "x", _BAR, note=f"{len(found)} motions")


def _ratio(file: str, runs: int) -> float | None:
    """With against without; None where the problem has no run, or a long one."""
    given = yaml.safe_load((ROOT / file).read_text("utf-8"))
    if "initial" not in given:
        return None
    own = [] if "until" in given.get("simulation", {}) else ["--until", _UNTIL]
    arguments = ["simulate", str(ROOT / file), *own, "--accuracy", _ACCURACY, "--samples", "2"]
    least = [float("inf")] * 2
    for _ in range(runs):
        for k, text in enumerate((_WITH, _WITHOUT)):
            command = [sys.executable, "-c", f"{text}main()", *arguments]
            run = cost(command, limit=_LIMIT)
            if run.status != 0:
                return None
            least[k] = min(least[k], run.cpu)
    return least[0] / least[1]


if __name__ == "__main__":
    for row in rows(sys.argv[1:] or paths(quick=False), 3):
        show(row)
