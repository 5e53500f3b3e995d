"""What the model cut to what is asked saves: integration at equal accuracy, cut against whole.

Every problem that can be run and whose model is cut, in two ways: all coordinates as
columns (constraints are solved), and the first coordinate alone (what it does not depend
on is left out).  The spans are so long that integration is what costs.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from time import process_time

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.numerics.asked import Asked
from lagcli.numerics.columns import Column
from lagcli.numerics.methods import METHODS, Prepared
from lagcli.numerics.refusal import Refusal
from lagcli.numerics.simulate import Simulation
from lagcli.numerics.steps import NotPossible, Tolerance
from lagcli.pipeline import load, with_lagrangian
from lagcli.problem import Problem
from lagcli.reader.columns import usual_columns
from lagcli.record import replace
from tests.bench.certificate import givens
from tests.bench.measure import ROOT, Row, show

_BAR = 2.0
_TOLERANCE, _ACCURACY = 1e-11, 1e-9
#: The span, in those of the file, and the longest step as a part of it.
_LONGER, _PARTS = 5.0, 200.0
#: A run is repeated until so many seconds or times, the shortest counts.
_SECONDS, _TIMES = 0.2, 30
_METHODS = ("taylor64", "dop853")


def rows() -> Iterator[Row]:
    """For each method the cases, least first, and their median."""
    problems = [
        (given, with_lagrangian(load(ROOT / given.name)))
        for given in givens([], 20)
        if given.name.endswith(".yaml")
    ]
    for method in _METHODS:
        gains: dict[str, float] = {}
        for given, problem in problems:
            for kind, columns in _columns(problem).items():
                found = _gain(problem, columns, _LONGER * given.until, method)
                if found is not None:
                    gains[f"{given.name.removeprefix('problems/')}, {kind}"] = found
        for name, gain in sorted(gains.items(), key=lambda pair: pair[1]):
            yield Row(f"  {name}", gain, f"x {method}")
        middle = median(gains.values()) if gains else None
        what = f"cut model, gain by {method}"
        yield Row(what, middle, "x", _BAR, at_least=True, note=f"{len(gains)} cases")


def _columns(problem: Problem) -> dict[str, tuple[Column, ...]]:
    every = tuple(Column(*each) for each in usual_columns(problem))
    count = len(problem.coordinates)
    ways = {"all columns": every}
    if count > 1:
        ways["one column"] = (every[0], every[1])
    return ways


def _gain(problem: Problem, columns: tuple[Column, ...], until: float, method: str) -> float | None:
    """Time of the whole model over that of the cut one; None where nothing is cut."""
    asked = Asked(until=until, accuracy=_ACCURACY, samples=11, columns=columns)
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
    return None if quick is None or slow is None else slow / quick


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
