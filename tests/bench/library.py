"""The library against a plain SymPy script: times, equal answers, operations."""

from __future__ import annotations

import json
import statistics
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from tests.bench.measure import HERE, LAGCLI, ROOT, Cost, Row, cost

QUICK = (
    "hoop",
    "pendulums/plane-pendulum",
    "pendulums/pendulum-cartesian",
    "central/kepler",
    "pulleys/double-atwood",
    "classics/spherical-pendulum",
    "nonholonomic/doubled-rolling-constraint",
    "forces/rod-pushed",
)
DOUBLE_PENDULUM = "problems/pendulums/double-pendulum.yaml"
#: Below so many CPU seconds both sides are run again, and the least of each counts: twice, and
#: more often where the gain is not clear.
SHORT = 4.0
CLEAR = 1.1
RUNS = 5
PROCESSES = 2

Problems = dict[str, dict[str, Any]]


def paths(quick: bool) -> list[str]:
    """The files, relative to the checkout."""
    if quick:
        return [f"problems/{name}.yaml" for name in QUICK] + [DOUBLE_PENDULUM]
    return sorted(str(p.relative_to(ROOT)) for p in (ROOT / "problems").rglob("*.yaml"))


def measured(
    files: Sequence[str], cap: float, kept: Problems, keep: Callable[[], None]
) -> Problems:
    """What is in `kept`, and every other file by SymPy and by lagcli, two at a time.

    Each is added to `kept` as it comes, and `keep` called: a run cut short can be resumed.
    """
    left = [file for file in files if file not in kept]
    with ThreadPoolExecutor(PROCESSES) as pool:
        for file, found in zip(left, pool.map(lambda f: _problem(f, cap), left), strict=True):
            print(f"  {file}: {_told(found)}", flush=True)
            kept[file] = found
            keep()
    return {file: kept[file] for file in files}


def _problem(file: str, cap: float) -> dict[str, Any]:
    found = _naive(file, cap)
    lagcli = _lagcli(file, cap)
    for again in range(1, RUNS):
        if found["fails"] or found["cpu"] > SHORT or lagcli.cpu > SHORT:
            break
        if again > 1 and found["cpu"] > CLEAR * lagcli.cpu:
            break
        found["cpu"] = min(found["cpu"], _naive(file, cap, "--only-time")["cpu"])
        lagcli = min(lagcli, _lagcli(file, cap), key=lambda run: run.cpu)
    times = {"lagcli_cpu": lagcli.cpu, "lagcli_wall": lagcli.wall}
    return found | times | {"lagcli_fails": not lagcli.answered}


def _naive(file: str, cap: float, *options: str) -> dict[str, Any]:
    command = [sys.executable, str(HERE / "naive.py"), file, "--cap", f"{cap:g}", *options]
    run = cost(command, limit=int(3 * cap) + 60)
    lines = run.out.splitlines()
    if not lines:
        raise SystemExit(f"{' '.join(command)}: {run.mistakes}")
    return json.loads(lines[-1])  # only the times, where the comparison has no end


def _lagcli(file: str, cap: float) -> Cost:
    shown = ["--no-cache", "--show", "accelerations,multipliers", "-f", "json"]
    return cost([*LAGCLI, "solve", file, *shown], limit=int(2 * cap))


def gain(found: dict[str, Any]) -> float | None:
    """How many times faster lagcli is: at least, where SymPy was late; 0 where it has no answer.

    None: there is nothing to compare with, since SymPy fails, or both have no answer.
    """
    printed = any("lagcli" in formula for formula in found.get("formulas", {}).values())
    if found["fails"] or not (printed or not found["late"]):
        return None
    return found["cpu"] / found["lagcli_cpu"] if printed and not found["lagcli_fails"] else 0.0


def _told(found: dict[str, Any]) -> str:
    if found["fails"]:
        return f"SymPy fails ({found['fails'].split(':')[0]}); lagcli {found['lagcli_cpu']:.2f} s"
    if gain(found) is None:
        return "no answer here or there"
    least = "at least " if found["late"] else ""
    equal = {True: "equal", None: "not compared"}.get(found.get("agrees"), "DIFFERENT")
    return f"{least}{gain(found):.2f} x ({found['lagcli_cpu']:.2f} s), {equal}"


def speed_rows(problems: Problems) -> Iterator[Row]:
    """Least and median gain over the plain script, and whether the answers are the same."""
    gains = {file: g for file, found in problems.items() if (g := gain(found)) is not None}
    slower = sorted((g, file) for file, g in gains.items() if g < 1)
    late = sum(problems[file]["late"] for file in gains)
    note = f"{len(gains)} problems, {late} of them at least; {len(slower)} slower"
    yield Row("library, least gain over SymPy", min(gains.values()), "x", 1, True, note)
    yield Row("library, median gain", statistics.median(gains.values()), "x", 2, True)
    different = [f for f in gains if problems[f].get("agrees") not in {True, None}]
    compared = sum(problems[f].get("agrees") is not None for f in gains)
    note = f"of {compared} compared"
    yield Row("library, answers that differ", len(different), "problems", 0, note=note)
    for g, file in slower:
        yield Row(f"  {Path(file).relative_to('problems')}", g, "x", note="slower")
    for file in different:
        yield Row(f"  {Path(file).relative_to('problems')}", None, "", note="differs")


def operation_rows(problems: Problems) -> Iterator[Row]:
    """How often a printed formula has at most as many operations."""
    for other, name, bar in (("simplify", "sympy.simplify's", 95), ("book", "textbook's", 100)):
        pairs = list(_pairs(problems, other))
        if not pairs:
            continue
        held = sum(mine <= theirs for _, _, mine, theirs in pairs)
        note = f"{held} of {len(pairs)} formulas"
        share = 100 * held / len(pairs)
        yield Row(f"operations ≤ {name}", share, "% of formulas", bar, True, note)
        absent = [formula for _, _, formula in _formulas(problems) if other in formula]
        missing = sum("lagcli" not in formula for formula in absent)
        if missing:
            yield Row("  not printed by lagcli", missing, "formulas", note=f"{name} exists")


def exceptions(problems: Problems) -> Iterator[str]:
    """Each formula with more operations than another's, with both forms."""
    for other in ("simplify", "book"):
        worst = sorted(_pairs(problems, other), key=lambda pair: pair[3] - pair[2])
        for file, name, mine, theirs in worst:
            if mine > theirs:
                formula = problems[file]["formulas"][name]
                yield f"{mine} > {theirs} {file} {name}\n  {formula['lagcli']}\n  {other}: {formula[other]}"


def _pairs(problems: Problems, other: str) -> Iterator[tuple[str, str, int, int]]:
    for file, name, formula in _formulas(problems):
        if "lagcli" in formula and other in formula:
            yield file, name, formula["lagcli_operations"], formula[f"{other}_operations"]


def _formulas(problems: Problems) -> Iterator[tuple[str, str, dict[str, Any]]]:
    for file, found in problems.items():
        for name, formula in found.get("formulas", {}).items():
            yield file, name, formula


def double_pendulum_rows(problems: Problems, runs: int) -> Iterator[Row]:
    """Explicit accelerations in process, CPU: all of it here, sympy.simplify alone there."""
    found = problems[DOUBLE_PENDULUM]
    script = [sys.executable, str(HERE / "inprocess.py"), DOUBLE_PENDULUM]
    seconds = min(json.loads(cost(script).out) for _ in range(runs))
    theirs = sum(found["simplify"])
    note = f"{seconds:.3f} s CPU, derived, solved and verified, against {theirs:.2f} s"
    what = "double pendulum, gain over simplify"
    yield Row(what, theirs / seconds, "x", 8, True, note)
    pairs = list(_pairs({DOUBLE_PENDULUM: found}, "simplify"))
    over = max((mine - other for *_, mine, other in pairs), default=None)
    counts = ", ".join(f"{mine} against {other}" for *_, mine, other in pairs)
    yield Row("double pendulum, operations above simplify's", over, "operations", 0, note=counts)
