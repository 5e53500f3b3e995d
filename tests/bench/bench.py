"""Everything that is promised about speed and length, measured in one run: `make bench`.

    python tests/bench/bench.py [--quick] [--runs N] [--cap SECONDS] [--output FILE]
                                [--resume FILE] [--against FILE] [--only PART,PART] [--long]
    python tests/bench/bench.py --compare A.json B.json

Every time is the CPU time of a whole process, over that of another command of the same run, so
that the machine's speed and most of its load drop out.  The result is kept as JSON under
.bench/, so that two versions can be compared.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.bench import (
    auto_rows,
    certificate,
    commands,
    cut_rows,
    discovering,
    form,
    guard_rows,
    library,
    long_rows,
    motion_rows,
    scaling,
    sweep_rows,
    verification_rows,
)
from tests.bench.compare import compare
from tests.bench.measure import ROOT, Row, show

#: What `--only` takes; without it the first three are measured.
PARTS = (
    "commands", "scaling", "library", "discovery", "motions", "integration", "auto", "cut", "certificate",
    "form", "verification", "sweep", "guard",
)  # fmt: skip
_USUAL = PARTS[:3]


class Run:
    """The rows of one run, shown and kept as they come."""

    def __init__(self, path: Path, earlier: dict[str, Any]) -> None:
        self.path = path
        self.rows: list[Row] = []
        self.library: library.Problems = earlier.get("library", {})
        self.facts = {
            "version": _version(),
            "date": datetime.now(UTC).isoformat(timespec="seconds"),
            "python": sys.version.split()[0],
            "cores": os.cpu_count(),
            "load_at_start": os.getloadavg()[0],
        }

    def take(self, rows: Iterator[Row]) -> None:
        """Show the rows as they are measured."""
        for row in rows:
            show(row)
            self.rows.append(row)
        self.keep()

    def keep(self) -> None:
        """Write what there is."""
        self.path.parent.mkdir(exist_ok=True)
        kept = {**self.facts, "rows": [row.kept() for row in self.rows], "library": self.library}
        self.path.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")


def _version() -> str:
    described = subprocess.run(
        ["git", "describe", "--always", "--dirty"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return described.stdout.strip() or "unknown"


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5, help="of short commands: the least counts")
    parser.add_argument("--cap", type=float, default=60, help="CPU seconds for SymPy, each problem")
    parser.add_argument("--quick", action="store_true", help="a few problems, no n = 100")
    parser.add_argument(
        "--only", type=lambda text: text.split(","), default=list(_USUAL), metavar="PART,PART",
        help=f"out of {', '.join(PARTS)}; without it {', '.join(_USUAL)}",
    )  # fmt: skip
    parser.add_argument("--long", action="store_true", help="with integration: 1e6 Kepler periods")
    parser.add_argument("--output", type=Path, help="instead of .bench/<commit>.json")
    parser.add_argument("--resume", type=Path, help="a run that was cut short: its problems count")
    parser.add_argument("--against", type=Path, help="an earlier run to compare this one with")
    parser.add_argument("--compare", type=Path, nargs=2, metavar=("A", "B"))
    arguments = parser.parse_args()
    wrong = [part for part in arguments.only if part not in PARTS]
    if wrong:
        parser.error(f"--only {','.join(wrong)}: there is {', '.join(PARTS)}")
    return arguments


def _measure(part: str, run: Run, arguments: argparse.Namespace) -> None:
    quick, runs = arguments.quick, arguments.runs
    match part:
        case "commands":
            run.take(commands.rows(runs))
        case "scaling":
            run.take(scaling.rows(quick))
        case "verification":
            run.take(verification_rows.rows(library.paths(quick)))
        case "library":
            files = library.paths(quick)
            problems = library.measured(files, arguments.cap, run.library, run.keep)
            run.take(library.double_pendulum_rows(problems, runs))
            run.take(library.speed_rows(problems))
            run.take(library.operation_rows(problems))
            run.take(iter([commands.check_row(files if quick else ["problems/"])]))
            for line in library.exceptions(problems):
                print(line)
        case "discovery":
            run.take(discovering.rows(library.paths(quick)))
        case "motions":
            run.take(motion_rows.rows(runs))
        case "integration":
            run.take(long_rows.rows(runs))
            run.take(long_rows.held_rows())
            if arguments.long:
                run.take(iter([long_rows.kepler_row()]))
        case "auto":
            run.take(auto_rows.rows(2))
            run.take(auto_rows.rows(2, kept=True))
        case "cut":
            run.take(cut_rows.rows())
        case "form":
            run.take(form.rows(form.of_library(), listed=True))
        case "guard":
            run.take(guard_rows.rows(library.paths(quick), 2))
        case "sweep":
            run.take(sweep_rows.rows())
        case "certificate":
            run.take(certificate.rows(certificate.study([], 2, arguments.cap, None)))


def main() -> int:
    """Measure, show, keep; 1 when a bar was missed."""
    arguments = _arguments()
    if arguments.compare:
        compare(*arguments.compare)
        return 0
    quick, only = arguments.quick, arguments.only
    chosen = "" if tuple(only) == _USUAL else f"-{'-'.join(only)}"
    name = f"{_version()}{'-quick' if quick else ''}{chosen}.json"
    earlier = json.loads(arguments.resume.read_text("utf-8")) if arguments.resume else {}
    run = Run(arguments.output or ROOT / ".bench" / name, earlier)
    for part in PARTS:
        if part in only:
            _measure(part, run, arguments)
    missed = [row.what for row in run.rows if not row.holds]
    print(f"kept in {run.path}; {f'missed: {missed}' if missed else 'every bar holds'}")
    if arguments.against:
        compare(arguments.against, run.path)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
