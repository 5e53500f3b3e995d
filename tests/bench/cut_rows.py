"""What the model cut to what is asked saves: integration at equal accuracy, cut against whole.

Every problem of the library whose model is cut, in two ways: all coordinates as columns
(constraints are solved), and the first coordinate alone (what it does not depend on is left
out).  A problem without values gets numbers between 1 and 2, and without an initial state the
nearest one on its constraints to such numbers.  The span is made longer until the whole model
takes so long that integration is what costs; a motion whose series ends, like a fall, has no
such span and is counted apart.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from time import process_time

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.decimals import value_of
from lagcli.diagnostics import ProblemError
from lagcli.numerics.asked import Asked
from lagcli.numerics.columns import Column
from lagcli.numerics.methods import METHODS, Prepared
from lagcli.numerics.refusal import Refusal
from lagcli.numerics.simulate import Simulation
from lagcli.numerics.steps import NotPossible, Tolerance
from lagcli.pipeline import Request, read, with_lagrangian
from lagcli.problem import Problem
from lagcli.reader.columns import usual_columns
from lagcli.record import replace
from tests.bench.measure import ROOT, Row, show

_BAR = 2.0
_TOLERANCE, _ACCURACY = 1e-11, 1e-9
#: The span of a file that gives none, how much longer it may become, the parts of it that a step
#: may take at most.
_UNTIL, _LONGEST, _PARTS = 10.0, 1e5, 10.0
#: From so many seconds on it is integration that costs.
_MATTERS = 0.01
#: A run is repeated until so many seconds or times, the shortest counts.
_SECONDS, _TIMES = 0.1, 10
_METHODS = ("taylor64", "dop853")


def rows() -> Iterator[Row]:
    """For each method the cases, least first, and their median."""
    problems = list(_problems())
    for method in _METHODS:
        gains: dict[str, float] = {}
        short: dict[str, float] = {}
        for name, problem in problems:
            for kind, columns in _columns(problem).items():
                found = _gain(problem, columns, method)
                if found is not None:
                    gain, matters = found
                    (gains if matters else short)[f"{name}, {kind}"] = gain
        for told, kinds in (("", gains), (", no span matters", short)):
            for name, gain in sorted(kinds.items(), key=lambda pair: pair[1]):
                yield Row(f"  {name}", gain, f"x {method}{told}")
        middle = median(gains.values()) if gains else None
        note = f"{len(gains)} cases; {len(short)} more have no span that matters"
        what = f"cut model, gain by {method}"
        yield Row(what, middle, "x", _BAR, at_least=True, note=note)


def _problems() -> Iterator[tuple[str, Problem]]:
    """The library with numbers."""
    for path in sorted((ROOT / "problems").rglob("*.yaml")):
        data = path.read_bytes()
        problem = read(str(path), data, Request()).problem
        if problem is None:
            continue
        missing = [p.name for p in problem.parameters if p.value is None]
        settings = tuple(f"{x}={1 + (0.618 * (k + 1)) % 1}" for k, x in enumerate(missing))
        try:
            problem = read(str(path), data, Request(settings=settings)).problem
            if problem is not None:
                yield str(path.relative_to(ROOT / "problems")), with_lagrangian(problem)
        except ProblemError:
            continue


def _columns(problem: Problem) -> dict[str, tuple[Column, ...]]:
    every = tuple(Column(*each) for each in usual_columns(problem))
    ways = {"all columns": every}
    if len(problem.coordinates) > 1:
        ways["one column"] = (every[0], every[1])
    return ways


def _gain(problem: Problem, columns: tuple[Column, ...], method: str) -> tuple[float, bool] | None:
    """Time of the whole model over that of the cut one, and whether it matters.

    None where nothing is cut.
    """
    end = problem.simulation.until
    until = float((end and value_of(end)) or _UNTIL)
    asked = Asked(until=until, accuracy=_ACCURACY, samples=11, columns=columns, project=True)
    last: tuple[float, bool] | None = None
    longest = _LONGEST * until
    while until <= longest:
        found = _times(problem, replace(asked, until=until), method)
        if found is None:
            return last
        quick, slow = found
        last = slow / quick, slow >= _MATTERS
        if last[1]:
            return last
        until *= 10
    return last


def _times(problem: Problem, asked: Asked, method: str) -> tuple[float, float] | None:
    """Seconds of the cut model and of the whole one."""
    try:
        cut, modes = Simulation(problem, asked).ready()
        if cut.cut is None:
            return None
        whole, all_modes = Simulation(problem, replace(asked, whole=True)).ready()
    except Refusal:
        return None
    entry = METHODS[method]
    less, more = entry.prepare(cut, modes), entry.prepare(whole, all_modes)
    if isinstance(less, str) or isinstance(more, str):
        return None
    try:
        quick, slow = _shortest(cut, less), _shortest(whole, more)
    except NotPossible:
        return None
    return None if quick is None or slow is None else (quick, slow)


def _shortest(simulation: Simulation, made: Prepared) -> float | None:
    """Seconds of a run; None where it does not come to the end."""
    until = simulation.asked.until
    best, begun = float("inf"), process_time()
    for _ in range(_TIMES):
        n = len(simulation.equations.q)
        bound = Tolerance(_TOLERANCE, n, until, until / _PARTS, None, made.floor)
        before = process_time()
        if made.run(bound, 0, None, moved=False).stop is not None:
            return None
        best = min(best, process_time() - before)
        if process_time() - begun > _SECONDS:
            break
    return best


if __name__ == "__main__":
    for row in rows():
        show(row)
