"""The error of a run as it really is, beside the bound of its certificate.

The reference is another run, a thousand times as exact and with as many digits as that takes:
what the run of the file claims is compared with numbers that it has not seen.
"""

from __future__ import annotations

from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import CannotDraw, Drawn, Piece, Rule, words
from lagcli.pictures.drift import FLOOR, largest_of_each
from lagcli.pictures.run import PicturedRun, short
from lagcli.problem_data import Problem
from lagcli.record import replace

#: By this factor the reference is more exact; the most digits it may carry.
_FINER, _DIGITS = 1e-3, 40
_MOST = 7


def error(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The error of each column, relative to its scale, and the largest bound.

    Raises
    ------
    CannotDraw
        Where the reference does not reach so far.
    """
    run = PicturedRun(problem, request, progress)
    finer = replace(
        request, accuracy=max(request.accuracy * _FINER, 1e-25), digits=_DIGITS, until=request.until
    )
    reference = PicturedRun(problem, finer, progress)
    held = run.result.certificate
    if reference.certain_until <= 0:
        raise CannotDraw(f"there is no reference to compare with: {reference.result.refusal}")
    curves = [
        (run.labels.of(run.columns[place - 1].expression, run.names[place]),
         _errors(run, reference, place, held.scales[place] or 1.0))
        for place in range(1, min(len(run.names), _MOST + 1))
    ]  # fmt: skip
    how = f"The reference is a run to {short(finer.accuracy)} by {reference.result.method}"
    notes = [f"{how}; that of the file is by {run.result.method}."]
    picture = largest_of_each(run, curves, _bounds(run), "error", notes)
    return picture, run.result.refusal


def _bounds(run: PicturedRun) -> list[Rule]:
    held = run.result.certificate
    bound = max(max(held.global_error.values(), default=0.0), FLOOR)
    rules = [
        Rule(at=bound, of="y", role="bound", colour=6,
             label=words(f"bound of the certificate, {short(bound)}")),
    ]  # fmt: skip
    if bound < held.accuracy:
        text = words(f"requested accuracy, {short(held.accuracy)}")
        rules.append(Rule(at=held.accuracy, of="y", role="energy", colour=7, label=text))
    return rules


def _errors(
    run: PicturedRun, reference: PicturedRun, place: int, scale: float
) -> tuple[Piece, ...]:
    """|x - reference| / scale at the rows that both have; rows beside an event differ in time."""
    known = {row[0]: row[place] for row in reference.result.rows}
    found = (
        tuple(
            (row[0] or 0.0, max(abs(value - other) / scale, FLOOR))
            for row in piece
            if (value := row[place]) is not None and (other := known.get(row[0])) is not None
        )
        for piece in run.pieces
    )
    return tuple(line for line in found if line)
