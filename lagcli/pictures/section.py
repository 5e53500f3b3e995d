"""Poincaré sections: the states in which a motion passes a surface, or at every period of a drive.

Where the surface is passed is found from the rows of the motion: the polynomials through twelve
of them around a change of sign have the root and the state in it. At 24 rows a turn that leaves
5e-12 of an oscillation, and 3e-6 of its third harmonic.

References
----------
Hénon, Heiles, "The applicability of the third integral of motion", Astron. J. 69 (1964) 73.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from lagcli.expression import Expression, Name, Negative, Sum
from lagcli.numerics.equations.parameter_formulas import numbers_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.extrema import crossing, polynomial
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import CannotDraw, Drawn, Marks, Picture, Point, extent
from lagcli.pictures.labels import Labels
from lagcli.pictures.run import PicturedRun, Values, run_with, short
from lagcli.pictures.starts import other_starts
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column, phase_columns, read_along
from lagcli.record import record, replace

#: Rows at first and at most, rows between two passages at least, and what more is taken.
_FIRST, _MOST, _BETWEEN, _MORE = 1001, 200_000, 24, 1.5
_PLACES = 12
_SECTION = "the section"
#: Fewer points do not show what the motion is like.
_FEW = 20


@record(kw_only=True)
class SectionSurface:
    """Where the motion is cut: an expression that passes 0 upwards, or a period of the time."""

    text: str
    expression: Expression | None = None
    period: float = 0.0


def section(
    problem: Problem,
    request: RunRequest,
    where: str | None,
    orbits: int = 1,
    progress: Progress = None,
    *,
    chosen: bool = False,
) -> Drawn:
    """The section of a motion, and of others of the same energy.

    Parameters
    ----------
    problem, request
        The motion; with `chosen` its two columns are the axes.
    where
        Such as `x`, `x = 1` or `t = 2*pi`; None for the first coordinate.
    orbits
        How many motions.

    Raises
    ------
    CannotDraw
        Where the surface is not passed, or there are not two columns.
    """
    surface = _surface(problem, where)
    columns = _plane(problem, request, surface, chosen=chosen)
    labels = Labels(problem)
    passages = [_passages(problem, request, surface, columns, progress)]
    points = [_points(passages[0][0], labels, columns)]
    if surface.expression is not None:  # the others come through about as often
        samples = min(_MOST, round(_MORE * _BETWEEN * len(points[0])))
        request = replace(request, samples=max(request.samples, samples))
    if orbits > 1:
        for other in other_starts(problem, _plain(surface), points[0], columns, orbits - 1):
            try:
                passages.append(_passages(other, request, surface, columns, progress))
            except (CannotDraw, Refusal):
                continue  # it does not come through the surface
            points.append(_points(passages[-1][0], labels, columns))
    refusal = passages[0][1].result.refusal
    return _picture(
        problem, labels, columns, surface, points, [run for _, run in passages]
    ), refusal


def _surface(problem: Problem, where: str | None) -> SectionSurface:
    if where is None:
        name = problem.coordinates[0].name
        if len(problem.coordinates) < 2:
            raise CannotDraw(
                "a motion of one coordinate is cut at the period of what drives it: "
                "--section t=2*pi"
            )
        return SectionSurface(text=f"{name} = 0", expression=Name(name))
    left, equals, right = where.partition("=")
    if equals and left.strip() == "t":
        [(period,)] = numbers_of(problem, [read_along(problem, right, "--section")])
        if not 0 < period < math.inf:
            raise CannotDraw(f"--section {where}: the period must be a time after 0")
        return SectionSurface(text=f"t = 0, T, 2 T, … with T = {period:.6g}", period=period)
    expression = read_along(problem, left, "--section")
    if equals:
        other = read_along(problem, right, "--section")
        expression = Sum((expression, Negative(other)))
    return SectionSurface(text=where if equals else f"{where} = 0", expression=expression)


def _plain(surface: SectionSurface) -> str | None:
    """The coordinate that is 0 in the section, where it is that simple."""
    expression = surface.expression
    return expression.name if isinstance(expression, Name) and not expression.primes else None


def _plane(
    problem: Problem, request: RunRequest, surface: SectionSurface, *, chosen: bool
) -> list[Column]:
    """The two columns of the picture: a coordinate that is not the section's, and its velocity."""
    if chosen:
        shown = list(request.columns[1:])
        if len(shown) != 2:
            raise CannotDraw(f"a section has two axes, and {len(shown)} columns are given")
        return shown
    names = [c.name for c in problem.coordinates]
    name = next((n for n in names if n != _plain(surface)), names[0])
    return phase_columns(name)


# -- passages ------------------------------------------------------------------------------------


def _passages(
    problem: Problem,
    request: RunRequest,
    surface: SectionSurface,
    columns: Sequence[Column],
    progress: Progress,
) -> tuple[list[tuple[float | None, ...]], PicturedRun]:
    """The rows in the section, and the run they are of."""
    if surface.expression is None:
        count = int(request.until / surface.period * (1 + 1e-12))
        times = {surface.period * k for k in range(count + 1)}
        every = tuple(sorted({0.0, *times, request.until}))
        run = run_with(problem, request, columns, progress, times=every, samples=len(every))
        return [row for row in run.result.rows if row[0] in times], run
    found = _crossings(problem, request, surface.expression, columns, progress)
    if found is None:
        raise CannotDraw(
            f"the motion does not pass {surface.text} upwards until t = {request.until:g}: "
            "give another --section, or a longer --until"
        )
    return found


def _crossings(
    problem: Problem,
    request: RunRequest,
    expression: Expression,
    columns: Sequence[Column],
    progress: Progress | None,
) -> tuple[list[tuple[float | None, ...]], PicturedRun] | None:
    """The columns where the expression passes 0 upwards; None where it never does."""
    every = [Column(_SECTION, expression), *columns]
    samples = max(request.samples, _FIRST)
    while True:
        run = run_with(problem, request, every, progress, samples=samples)
        passed = [
            (piece, k)
            for piece in run.pieces
            for k, (before, after) in enumerate(pairwise(piece))
            if before[1] is not None and after[1] is not None and before[1] < 0 <= after[1]
        ]
        if samples >= min(_MOST, _BETWEEN * len(passed)):
            break
        samples = min(_MOST, round(_MORE * _BETWEEN * len(passed)))
    return ([_passage(piece, k) for piece, k in passed], run) if passed else None


def _passage(piece: Sequence[Values], k: int) -> tuple[float | None, ...]:
    """The time and the columns between rows k and k + 1 of a piece, where the section is passed."""
    first = max(0, min(k + 1 - _PLACES // 2, len(piece) - _PLACES))
    near = [row for row in piece[first : first + _PLACES] if row[1] is not None]
    times, heights, *lines = zip(*near, strict=True)
    t = _root(times, heights, piece[k], piece[k + 1])
    return (t, *(_at(times, line, t) for line in lines))


def _at(times: Sequence[float], values: Sequence[float | None], t: float) -> float | None:
    known = [value for value in values if value is not None]
    return polynomial(times, known)(t) if len(known) == len(times) else None


def _root(times: Sequence[float], heights: Sequence[float], before: Values, after: Values) -> float:
    """Where the polynomial through the places is 0, between two of them."""
    (low, a), (high, b) = before[:2], after[:2]
    assert low is not None and high is not None and a is not None and b is not None  # noqa: PT018
    below = polynomial(times, [-height for height in heights])
    return crossing(below, low, high, -a, -b or -1e-300)


# -- the picture ---------------------------------------------------------------------------------


def _points(
    rows: Sequence[tuple[float | None, ...]], labels: Labels, columns: Sequence[Column]
) -> list[Point]:
    turns = [labels.is_angle(formula) for _, formula in columns]
    found = []
    for _, x, y in rows:
        if x is not None and y is not None:
            found.append((_within(x, turns[0]), _within(y, turns[1])))
    return found


def _within(value: float, turns: bool) -> float:
    """An angle between -pi and pi."""
    return math.remainder(value, 2 * math.pi) if turns else value


def _picture(
    problem: Problem,
    labels: Labels,
    columns: Sequence[Column],
    surface: SectionSurface,
    points: Sequence[list[Point]],
    runs: Sequence[PicturedRun],
) -> Picture:
    everything = [point for line in points for point in line]
    if not everything:
        raise CannotDraw("the columns have no values in the section")
    spans = [extent([point[k] for point in everything]) for k in (0, 1)]
    items = [Marks(points=tuple(line), role="dots", colour=k) for k, line in enumerate(points)]
    panel = labels.panel(columns, spans, items)
    notes = (_told(surface, points, runs), *_certain(runs))
    return Picture(title=problem.title, panels=(panel,), notes=notes)


def _told(
    surface: SectionSurface, points: Sequence[list[Point]], runs: Sequence[PicturedRun]
) -> str:
    count = sum(map(len, points))
    upwards = "" if surface.expression is None else " upwards"
    many = (
        f"{len(runs)} motions of the same energy" if surface.expression else f"{len(runs)} motions"
    )
    who = "of one motion" if len(runs) == 1 else f"of {many}"
    few = "; a longer --until has more" if count < _FEW * len(points) else ""
    return f"{count} passages{upwards} through {surface.text} {who}{few}."


def _certain(runs: Sequence[PicturedRun]) -> tuple[str, ...]:
    cut = [run for run in runs if run.is_cut_short]
    if len(runs) == 1:
        return runs[0].notes()
    accuracy = short(runs[0].result.certificate.accuracy)
    if not cut:
        return (f"All are certain to {accuracy} until t = {runs[0].request.until:g}.",)
    first = min(run.certain_until for run in cut)
    many = f"{len(cut)} of them" if len(cut) < len(runs) else "All"
    return (f"{many} end where the accuracy {accuracy} is lost, the first at t = {first:.4g}.",)
