"""Whole-process times as ratios, measured in one run: `make bench`.

    python tests/bench/bench.py [--runs N] [--against FILE] [--quick]

Every row is a command, timed from start to exit, over a command of the same run: the
machine's speed drops out.  The result is kept as .bench/<commit>.json, so that two
versions can be compared with `--against`.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
LAGCLI = [str(Path(sys.executable).with_name("lagcli"))]
NAIVE = [sys.executable, str(Path(__file__).with_name("naive.py"))]
IMPORT_TYPER = [sys.executable, "-c", "import typer"]
IMPORT_SYMPY = [sys.executable, "-c", "import sympy"]

PROBLEMS = (
    "hoop",
    "pendulums/plane-pendulum",
    "pendulums/double-pendulum",
    "pendulums/pendulum-cartesian",
    "central/kepler",
    "classics/spherical-pendulum",
    "classics/particle-on-cone",
    "pulleys/double-atwood",
    "nonholonomic/chaplygin-sleigh",
    "chains/coupled-pendulums",
)
ANSWERS = ["--show", "equations,accelerations,multipliers"]


@dataclass(frozen=True)
class Row:
    """A command against another; `bar` is the ratio that must not be exceeded."""

    what: str
    seconds: float
    against: str
    against_seconds: float
    bar: float | None = None

    @property
    def ratio(self) -> float:
        return self.seconds / self.against_seconds

    @property
    def holds(self) -> bool:
        return self.bar is None or self.ratio <= self.bar


class Clock:
    """Whole-process wall times of two commands, run in turn so that both see the same load.

    The least of several runs is what a command takes undisturbed.
    """

    def __init__(self, runs: int) -> None:
        self.runs = runs

    def row(
        self,
        what: str,
        command: Sequence[str],
        against: str,
        other: Sequence[str],
        bar: float | None = None,
    ) -> Row:
        pairs = [(_seconds(command), _seconds(other)) for _ in range(self.runs)]
        return Row(what, min(a for a, _ in pairs), against, min(b for _, b in pairs), bar)


def _seconds(command: Sequence[str]) -> float:
    began = time.perf_counter()
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=False)
    seconds = time.perf_counter() - began
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}: {done.stderr.decode()}")
    return seconds


def startup_rows(clock: Clock) -> list[Row]:
    """What answers without any algebra, against `import typer`."""
    return [
        clock.row(f"lagcli {words}", [*LAGCLI, *words.split()], "import typer", IMPORT_TYPER, 2.0)
        for words in ("--help", "solve --help", "formats")
    ]


def completion_row(clock: Clock) -> Row:
    """What the shell waits for at a tab, against `import typer`."""
    asked = {"_LAGCLI_COMPLETE": "complete_bash", "COMP_WORDS": "lagcli so", "COMP_CWORD": "1"}
    command = ["env", *(f"{name}={value}" for name, value in asked.items()), *LAGCLI]
    return clock.row("completion of 'lagcli so'", command, "import typer", IMPORT_TYPER, 2.0)


def check_row() -> Row:
    """The whole library, start-up included: seconds for each problem."""
    count = len(list((ROOT / "problems").rglob("*.yaml")))
    seconds = _seconds([*LAGCLI, "check", "problems/", "--jobs", "2"])
    return Row("check problems/, for each", seconds / count, "one second", 1.0, 0.25)


def solve_rows(clock: Clock) -> list[Row]:
    """Each problem, all of its usual sections, against `import sympy`; then from the cache."""
    cold = [
        clock.row(
            f"lagcli solve {name}",
            [*LAGCLI, "solve", _path(name), "--no-cache"],
            "import sympy",
            IMPORT_SYMPY,
            1.4 if name == "hoop" else None,
        )
        for name in PROBLEMS
    ]
    again = [*LAGCLI, "solve", _path("hoop")]
    _seconds(again)  # the first of them fills the cache
    return [*cold, clock.row("solve hoop, again", again, "import sympy", IMPORT_SYMPY, 0.4)]


def naive_rows(clock: Clock) -> list[Row]:
    """The same answers, against SymPy's LagrangesMethod, LUsolve and simplify."""
    return [
        clock.row(
            f"the equations of {name}",
            [*LAGCLI, "solve", _path(name), *ANSWERS, "--no-cache"],
            "LagrangesMethod",
            [*NAIVE, _path(name)],
            1.0,
        )
        for name in PROBLEMS
    ]


def _path(name: str) -> str:
    return f"problems/{name}.yaml"


def _version() -> str:
    described = subprocess.run(
        ["git", "describe", "--always", "--dirty"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return described.stdout.strip() or "unknown"


def _show(rows: Sequence[Row], earlier: dict[str, float]) -> None:
    width = max(len(row.what) for row in rows)
    for row in rows:
        bar = "" if row.bar is None else f"  (bar {row.bar:g})"
        told = "" if row.holds else "  MISSED"
        before = f"  was {earlier[row.what]:.2f}" if row.what in earlier else ""
        print(f"{row.what:{width}}  {row.seconds:7.3f} s  {row.ratio:6.2f} x {row.against}"
              f"{bar}{before}{told}")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5, help="the least of so many")
    parser.add_argument("--quick", action="store_true", help="without LagrangesMethod")
    parser.add_argument("--against", type=Path, help="an earlier .bench/*.json")
    arguments = parser.parse_args()
    clock = Clock(arguments.runs)
    rows = [*startup_rows(clock), completion_row(clock), *solve_rows(clock), check_row()]
    if not arguments.quick:
        rows += naive_rows(Clock(1))
    earlier = json.loads(arguments.against.read_text()) if arguments.against else {"rows": []}
    _show(rows, {row["what"]: row["ratio"] for row in earlier["rows"]})
    if not arguments.quick:
        gains = [1 / row.ratio for row in rows if row.against == "LagrangesMethod"]
        print(f"median gain over LagrangesMethod: {statistics.median(gains):.1f}")
    folder = ROOT / ".bench"
    folder.mkdir(exist_ok=True)
    kept = {
        "version": _version(),
        "python": sys.version.split()[0],
        "cores": os.cpu_count(),
        "runs": arguments.runs,
        "rows": [{**asdict(row), "ratio": round(row.ratio, 3)} for row in rows],
    }
    path = folder / f"{kept['version']}.json"
    path.write_text(json.dumps(kept, indent=2) + "\n", encoding="utf-8")
    print(f"kept in {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
