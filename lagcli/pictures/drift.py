"""How far conserved quantities have moved from their values at the beginning.

|Q(t) - Q(0)| relative to the largest |Q|, beside the accuracy that was asked for.  An impact
changes the energy; from there on it is compared with its value just after the impact.
"""

from __future__ import annotations

from collections.abc import Callable

from lagcli.expression import Name
from lagcli.numerics.hybrid.request import Asked
from lagcli.pictures.drawing import (
    Axis,
    CannotDraw,
    Curve,
    Item,
    Panel,
    Picture,
    Piece,
    Rule,
    words,
)
from lagcli.pictures.run import PicturedRun, largest_so_far, run_with, short
from lagcli.problem_data import JACOBI_FUNCTION, Problem, charge_of
from lagcli.reader.columns import Shown

#: What is smaller cannot be told from 0 in doubles, and stands at the bottom.
FLOOR = 1e-17
_HEADROOM = 10.0


def drift(
    problem: Problem, asked: Asked, progress: Callable[[float], None] | None = None
) -> tuple[Picture, str]:
    """The drift of every charge that the run conserves.

    Raises
    ------
    CannotDraw
        Where nothing is conserved.
    """
    run = run_with(problem, asked, _candidates(problem), progress)
    drifts = run.result.certificate.charges
    conserved = [name for name in run.names[1:] if name in drifts]
    if not conserved:
        raise CannotDraw(
            "nothing is conserved along this motion that the file or its cyclic coordinates name: "
            "there is no drift to draw"
        )
    items: list[Item] = list(run.over_time())
    largest = FLOOR
    for colour, name in enumerate(conserved):
        pieces = largest_so_far(_changes(run, run.names.index(name)))
        largest = max([largest, *(y for piece in pieces for _, y in piece)])
        label = words(f"{name}, at most {short(drifts[name])} of its terms")
        items.append(Curve(pieces=pieces, role="series", colour=colour, label=label))
    bound = asked.accuracy
    items.append(Rule(at=bound, of="y", role="bound", colour=6, label=words("requested accuracy")))
    y = Axis(
        label=words("largest change so far, relative"),
        low=FLOOR,
        high=_HEADROOM * max(largest, bound),
        logarithmic=True,
    )
    panel = Panel(x=run.time_axis(), y=y, items=tuple(items))
    picture = Picture(title=problem.title, panels=(panel,), notes=run.notes())
    return picture, run.result.refusal


def _candidates(problem: Problem) -> list[Shown]:
    """The energy, the momenta and the charges of the file's symmetries, by their names."""
    names: list[Shown] = [("energy", JACOBI_FUNCTION)]
    names += [(f"p_{c.name}", Name(f"p_{c.name}")) for c in problem.coordinates]
    taken = {name for name, _ in names}
    return names + [(s.name, charge_of(s)) for s in problem.symmetries if s.name not in taken]


def _changes(run: PicturedRun, column: int) -> tuple[Piece, ...]:
    """|Q - Q at the start of the piece| / largest |Q|."""
    scale = max((abs(value) for value in run.values(column)), default=0.0) or 1.0
    return tuple(
        tuple((t, max(abs(value - piece[0][1]) / scale, FLOOR)) for t, value in piece)
        for piece in run.curve(0, column)
    )
