"""`lagcli sweep` beside a loop over SciPy's DOP853 whose right-hand side is compiled.

Double pendulums from rest at random angles, to 10 s.  The loop's tolerance is the loosest with
which nine members of ten are right to 1e-9; every row of the sweep has a certificate of that.
The reference has 1e-13.

    python tests/bench/sweep_rows.py [MEMBERS]
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.bench.measure import ROOT, Row, cost, show
from tests.bench.motion_rows import peers

PROBLEM = """\
coordinates: [a, b]
T: a'^2 + b'^2/2 + a'*b'*cos(a - b)
V: -9.81*(2*cos(a) + cos(b))
"""
#: Four in each decade, up to the finest that SciPy takes.
_TOLERANCES = [f"{10 ** (-k / 4):.3g}" for k in range(40, 55)] + ["2.3e-14"]
_ACCURACY, _SHARE = 1e-9, 0.9
#: Members of the loop and of the reference, out of the ensemble.
_SOME = 100

Table = list[list[float]]


def rows(members: int = 10_000) -> Iterator[Row]:
    """The ratio of the times, and how much of it is the second core."""
    bar = "sweep, double pendulums against a SciPy loop"
    python = peers("numba")
    if python is None:
        yield Row(bar, None, "times", 20, at_least=True, note="LAGCLI_PEERS has no numba and SciPy")
        return
    with TemporaryDirectory() as folder:
        problem = Path(folder) / "pendulums.yaml"
        problem.write_text(PROBLEM, encoding="utf-8")
        ours, wall, cpu = _swept(problem, members, _ACCURACY)
        true, *_ = _swept(problem, members, 1e-13, _SOME)
        through = _on_cluster(problem, members)
    some = ours[:_SOME]
    assert [row[:2] for row in some] == [row[:2] for row in true]
    error = _within(_errors([row[3:5] for row in some], true))
    claimed = sum(row[-3] for row in ours) / len(ours)
    loop, tolerance, theirs = _loop(python, true)
    each, theirs_cpu = (loop[time] / _SOME * members for time in ("wall", "cpu"))
    note = (
        f"{members} members, {100 * claimed:.2f} % certified; {wall:.1f} s, {cpu:.1f} s CPU; "
        f"error of nine in ten {error:.0e}, the loop's {theirs:.0e} at {tolerance}"
    )
    yield Row(bar, each / wall, "times", 20, at_least=True, note=note)
    cores = os.cpu_count() or 1
    name = "the same through Dask, two workers, to without"
    yield Row(name, None if through is None else through / wall, "times", 1.3)
    yield Row(f"the same by CPU time, on {cores} cores", theirs_cpu / cpu * cores, "times")


def _on_cluster(problem: Path, members: int) -> float | None:
    """The wall time through two local workers; None without Dask."""
    try:
        from distributed import LocalCluster
    except ImportError:
        return None
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(**options) as cluster:
        there = ("--scheduler", cluster.scheduler_address)
        return _swept(problem, members, _ACCURACY, options=there)[1]


def _swept(
    problem: Path, members: int, accuracy: float, first: int = 0, options: Sequence[str] = ()
) -> tuple[Table, float, float]:
    """The rows of the sweep, its wall time and its CPU time; only the first members where given."""
    output = problem.with_suffix(".csv")
    command = [sys.executable, "-m", "lagcli", "sweep", str(problem), "--until", "10"]
    command += ["--vary", "a=0.1:2", "--vary", "b=0.1:2", "--random", str(first or members)]
    command += ["--accuracy", str(accuracy), "--show", "a,b", "-o", str(output), *options]
    begin = time.perf_counter()
    run = cost(command, good=(0, 1))
    wall = time.perf_counter() - begin
    with output.open(encoding="utf-8", newline="") as lines:
        table = [[float(x) for x in row] for row in list(csv.reader(lines))[1:]]
    return table, wall, run.cpu


def _loop(python: str, true: Table) -> tuple[dict[str, Any], str, float]:
    """The cheapest run of the loop that is right, its tolerance and its error."""
    script = [python, str(Path(__file__).parent / "peers" / "ensemble_scipy.py")]
    members = json.dumps([row[:2] for row in true])
    for tolerance in _TOLERANCES:
        done = subprocess.run(
            [*script, tolerance],
            input=members,
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=True,
        )
        found: dict[str, Any] = json.loads(done.stdout)
        error = _within(_errors(found["ends"], true))
        if error <= _ACCURACY:
            break
    return found, tolerance, error


def _errors(ends: Table, true: Table) -> list[float]:
    return [
        max(abs(x - y) / max(1.0, abs(y)) for x, y in zip(end, row[3:5], strict=True))
        for end, row in zip(ends, true, strict=True)
    ]


def _within(errors: list[float]) -> float:
    """The error that nine in ten do not exceed."""
    return sorted(errors)[int(_SHARE * len(errors)) - 1]


if __name__ == "__main__":
    for row in rows(*map(int, sys.argv[1:])):
        show(row)
