"""What the model reduced to the requested columns saves: whole runs, certificate included, cut against uncut.

Three kinds of cases, each by `auto` at the same accuracy, which both runs must reach:

- constraints: every coordinate and velocity of a problem of the library whose constraints are
  solved, against the same columns by the model as it stands in the file;
- one column: the first coordinate of a problem of which more is left out than that, against all
  that the file has: coordinates, velocities, multipliers, constraint forces, charges;
- scene: the coordinates of one problem of the library in a file with the one after it, against
  all that that file has.

A problem without values gets numbers between 1 and 2, and without an initial state the nearest
one on its constraints to such numbers.  The time is that of the process from the problem to the
result.  Over the span of a file it is mostly what a run costs before its first step, so the span
is also made longer until the uncut run takes so long that its steps are what costs; a motion
whose series ends, like a fall, has no such span and counts over that of its file alone.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from time import process_time

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.diagnostics import ProblemError
from lagcli.evaluation import value_of
from lagcli.numerics.certified.ready_setup import ready_setup
from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.pipeline import Request, read, with_lagrangian
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column, read_columns, usual_columns
from lagcli.record import replace
from tests.bench.measure import ROOT, Row, show
from tests.bench.scenes import scenes

_BAR = 2.0
_ACCURACY, _SAMPLES = 1e-9, 101
#: The span of a file that gives none, and how much longer it may become.
_UNTIL, _LONGEST = 10.0, 1e5
#: From so many seconds of the uncut run on it is its steps that cost.
_MATTERS = 0.25
#: A run of no more steps, over a hundred times the span of a file, has a series that ends.
_FEW = 50
#: A run is repeated until so many seconds or times, the shortest counts.
_SECONDS, _TIMES = 0.2, 3
_GROUPS = ("multipliers", "constraint_forces", "charges")
_KINDS = ("constraints", "one column", "scene")

#: The problem, what is asked of the cut model, and of the whole one.
Case = tuple[Problem, tuple[Column, ...], tuple[Column, ...]]


def rows(kinds: Sequence[str] = _KINDS) -> Iterator[Row]:
    """Of each kind the cases, least first, and their median; then the median of all."""
    every: list[float] = []
    near: list[float] = []
    cases = list(_cases())
    for kind in kinds:
        gains: list[tuple[float, str, float, bool]] = []
        for name, case in ((name, case) for of, name, case in cases if of == kind):
            found = _gains(*case)
            if found is not None:
                first, last, until, matters = found
                near.append(first)
                gains.append((last, f"{name}, t = {until:g}", first, matters))
        for gain, name, first, matters in sorted(gains):
            told = "" if matters else "; no span matters"
            yield Row(f"  {name}", gain, f"x ({first:.2f} over the file's span{told})")
        long = [gain for gain, _, _, matters in gains if matters]
        every += long
        middle = median(long) if long else None
        yield Row(f"cut model, {kind}", middle, "x", note=f"{len(long)} cases")
    yield Row(
        "cut model, over the spans of the files", median(near), "x", note=f"{len(near)} cases"
    )
    yield Row(
        "cut model, all kinds", median(every), "x", _BAR, at_least=True, note=f"{len(every)} cases"
    )


def _cases() -> Iterator[tuple[str, str, Case]]:
    for path in sorted((ROOT / "problems").rglob("*.yaml")):
        problem = _with_numbers(path.read_bytes())
        if problem is None:
            continue
        name = str(path.relative_to(ROOT / "problems"))
        usual = tuple(usual_columns(problem))
        yield "constraints", name, (problem, usual, usual)
        if len(problem.coordinates) > 1:
            yield "one column", name, (problem, usual[:2], _all(problem))
    for name, text, count in scenes():
        problem = _with_numbers(text.encode())
        if problem is not None:
            asked = usual_columns(problem)[: 1 + count]
            yield "scene", name, (problem, tuple(asked), _all(problem))


def _with_numbers(data: bytes) -> Problem | None:
    problem = read("", data, Request()).problem
    if problem is None:
        return None
    missing = [p.name for p in problem.parameters if p.value is None]
    settings = tuple(f"{x}={1 + (0.618 * (k + 1)) % 1}" for k, x in enumerate(missing))
    try:
        problem = read("", data, Request(settings=settings)).problem
        return None if problem is None else with_lagrangian(problem)
    except ProblemError:
        return None


def _all(problem: Problem) -> tuple[Column, ...]:
    """All that the file has."""
    found = dict(usual_columns(problem))
    for group in _GROUPS:
        try:
            found |= dict(read_columns(problem, [group]))
        except ProblemError:  # there is none of these
            continue
    return tuple(Column(*each) for each in found.items())


def _gains(
    problem: Problem, columns: tuple[Column, ...], every: tuple[Column, ...]
) -> tuple[float, float, float, bool] | None:
    """How many times less, over the file's span and over the last one; that; whether it matters.

    None where nothing is cut.
    """
    end = problem.setup.until
    until = span = float((end and value_of(end)) or _UNTIL)
    asked = RunRequest(
        until=until, accuracy=_ACCURACY, samples=_SAMPLES, columns=columns, project=True
    )
    first: float | None = None
    last = (0.0, until, False)
    while until <= _LONGEST * span and not last[2]:
        less = replace(asked, until=until)
        try:
            if first is None and not _is_less(ready_setup(problem, less)[0], every):
                return None
            slow, steps = _shortest(problem, replace(less, columns=every, whole=True))
            quick, _ = _shortest(problem, less)
        except (Refusal, ArithmeticError):
            break
        if quick is None or slow is None:
            break
        last = (slow / quick, until, slow >= _MATTERS)
        first = first or last[0]
        if until >= 100 * span and steps <= _FEW:
            break
        until *= 10
    return None if first is None else (first, *last)


def _is_less(setup: Setup, every: tuple[Column, ...]) -> bool:
    """Whether something is cut; where all is shown, whether a constraint is solved."""
    cut = setup.cut
    shows_all = setup.request.columns == every
    return cut is not None and bool(cut.eliminated or (cut.dropped and not shows_all))


def _shortest(problem: Problem, asked: RunRequest) -> tuple[float | None, int]:
    """Seconds of a run, None where it does not claim the accuracy, and its steps."""
    best, begun = float("inf"), process_time()
    for _ in range(_TIMES):
        before = process_time()
        found = simulate(problem, asked)
        if not found.certificate.reached:
            return None, found.steps
        best = min(best, process_time() - before)
        if process_time() - begun > _SECONDS:
            break
    return best, found.steps


if __name__ == "__main__":
    for row in rows(sys.argv[1:] or _KINDS):
        show(row)
