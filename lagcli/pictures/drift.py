"""How far conserved quantities have moved from their values at the beginning.

|Q(t) - Q(0)| relative to the largest |Q|, beside the requested accuracy.  An impact
changes the energy; from there on it is compared with its value just after the impact.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.expression import Name
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import (
    Axis,
    CannotDraw,
    Curve,
    Drawn,
    DrawnName,
    Item,
    Panel,
    Picture,
    Piece,
    Rule,
    words,
)
from lagcli.pictures.run import PicturedRun, largest_so_far, run_with, short
from lagcli.problem_data import JACOBI_FUNCTION, Problem, charge_of
from lagcli.reader.columns import Column

#: What is smaller cannot be told from 0 in doubles, and stands at the bottom.
FLOOR = 1e-17
_HEADROOM = 10.0


def drift(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The drift of every charge that the run conserves.

    Raises
    ------
    CannotDraw
        Where nothing is conserved.
    """
    run = run_with(problem, request, _candidates(problem), progress)
    drifts = run.result.certificate.charges
    conserved = [name for name in run.names[1:] if name in drifts]
    if not conserved:
        raise CannotDraw(
            "nothing is conserved along this motion that the file or its cyclic coordinates name: "
            "there is no drift to draw"
        )
    curves = [
        (words(f"{name}, at most {short(drifts[name])} of its terms"),
         _changes(run, run.names.index(name)))
        for name in conserved
    ]  # fmt: skip
    rule = Rule(
        at=request.accuracy, of="y", role="bound", colour=6, label=words("requested accuracy")
    )
    return largest_of_each(run, curves, [rule], "change"), run.result.refusal


def largest_of_each(
    run: PicturedRun,
    curves: Sequence[tuple[DrawnName, tuple[Piece, ...]]],
    rules: Sequence[Rule],
    what: str,
    notes: Sequence[str] = (),
) -> Picture:
    """The largest change or error so far of each column over time, in decades."""
    items: list[Item] = [*run.over_time()]
    largest = FLOOR
    for colour, (label, each) in enumerate(curves):
        pieces = largest_so_far(each)
        largest = max([largest, *(y for piece in pieces for _, y in piece)])
        items.append(Curve(pieces=pieces, role="series", colour=colour, label=label))
    y = Axis(
        label=words(f"largest {what} so far, relative"),
        low=FLOOR,
        high=_HEADROOM * max(largest, run.request.accuracy),
        logarithmic=True,
    )
    panel = Panel(x=run.time_axis(), y=y, items=(*items, *rules))
    return Picture(title=run.problem.title, panels=(panel,), notes=(*run.notes(), *notes))


def _candidates(problem: Problem) -> list[Column]:
    """The energy, the momenta and the charges of the file's symmetries, by their names."""
    names = [Column("energy", JACOBI_FUNCTION)]
    names += [Column(f"p_{c.name}", Name(f"p_{c.name}")) for c in problem.coordinates]
    taken = {name for name, _ in names}
    charges = (Column(s.name, charge_of(s)) for s in problem.symmetries)
    return [*names, *(charge for charge in charges if charge.name not in taken)]


def _changes(run: PicturedRun, column: int) -> tuple[Piece, ...]:
    """|Q - Q at the start of the piece| / largest |Q|."""
    scale = max((abs(value) for value in run.values(column)), default=0.0) or 1.0
    return tuple(
        tuple((t, max(abs(value - piece[0][1]) / scale, FLOOR)) for t, value in piece)
        for piece in run.curve(0, column)
    )
