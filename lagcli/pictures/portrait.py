"""The phase portrait of one degree of freedom: energy levels, separatrix, equilibria, motion.

The levels are E(q, q') = const; a separatrix is the level of an unstable equilibrium.  Where the
energy is not conserved, `flow` draws motions instead.  With `--show`
it is the motion in the plane of any two columns, without levels.
"""

from __future__ import annotations

import math

from lagcli.expression import Name
from lagcli.formatters.unicode import unicode_name
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.contours import Contours, grid
from lagcli.pictures.drawing import (
    CannotDraw,
    Curve,
    Drawn,
    DrawnName,
    Item,
    Picture,
    equilibria,
    extent,
    words,
)
from lagcli.pictures.flow import flow
from lagcli.pictures.labels import Labels
from lagcli.pictures.one_freedom import EnergyNotConserved, RemainingFreedom
from lagcli.pictures.run import run_with
from lagcli.pictures.window import Window
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column

_ACROSS, _UP = 221, 161
#: So many levels, closer where the energy is low; none where a separatrix is as near as this.
_LEVELS, _TOO_NEAR = 10, 0.03
_IN_A_WELL = (0.11, 0.44)
_SEPARATRIX = 1


def portrait(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The portrait with the motion in it, where that has an end.

    Raises
    ------
    CannotDraw
        Where more than one degree of freedom is left, or the equations depend on the time.
    """
    try:
        freedom = RemainingFreedom(problem)
    except EnergyNotConserved:
        return flow(problem, request, progress)
    labels = Labels(problem)
    run = run_with(problem, request, freedom.columns, progress) if request.until > 0 else None
    seen = tuple(run.values(1)) if run is not None else ()
    window = Window(freedom, labels, (min(seen), max(seen)) if seen else ())
    items = _levels(freedom, window)
    if run is not None:
        items += run.in_the_plane(turns=window.turns)
    items += equilibria(window.marked, window.q)
    panel = labels.panel(freedom.columns, (window.q, window.v), items)
    notes = (*constants(freedom), *(run.notes() if run is not None else ()))
    picture = Picture(title=problem.title, panels=(panel,), notes=notes)
    return picture, run.result.refusal if run is not None else ""


def constants(freedom: RemainingFreedom) -> tuple[str, ...]:
    """The momenta that the picture is for, and what it leaves out."""
    notes = []
    if freedom.momenta:
        shown = ", ".join(f"{unicode_name(n)} = {x:.6g}" for n, x in freedom.momenta.items())
        notes.append(f"For the constant momenta of the initial state: {shown}.")
    if freedom.problem.contacts:
        names = ", ".join(contact.name for contact in freedom.problem.contacts)
        notes.append(f"Energies are those without contact: {names}.")
    return tuple(notes)


def _levels(freedom: RemainingFreedom, window: Window) -> list[Item]:
    lines = Contours(freedom.energy, grid(*window.q, _ACROSS), grid(*window.v, _UP))
    height = window.highest - window.lowest
    named = window.separatrices
    items: list[Item] = []
    label: DrawnName | None = words("energy levels")
    energies = [window.lowest + height * (k / _LEVELS) ** 2 for k in range(1, _LEVELS + 1)]
    energies = [e for e in energies if all(abs(e - n) >= _TOO_NEAR * height for n in named)]
    inner = min(named, default=math.inf)
    if not any(energy < inner for energy in energies):  # a shallow well has its levels, too
        energies += [window.lowest + (inner - window.lowest) * part for part in _IN_A_WELL]
    for energy in sorted(energies):
        pieces = lines.at(energy)
        if pieces:
            items.append(Curve(pieces=pieces, role="level", label=label))
            label = None
    for energy in named:
        if energy <= window.highest:
            pieces = lines.at(energy)
            if pieces:
                name = words("separatrix")
                items.append(
                    Curve(pieces=pieces, role="separatrix", colour=_SEPARATRIX, label=name)
                )
    return items


# -- any two columns -----------------------------------------------------------------------------


def plane(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The motion in the plane of two columns; of one coordinate q, that of q and q'.

    Raises
    ------
    CannotDraw
        Where it is not two columns.
    """
    columns = list(request.columns[1:])
    first = columns[0].expression if columns else None
    if len(columns) == 1 and isinstance(first, Name) and first.primes < 2:
        rate = Name(first.name, first.primes + 1)
        columns.append(Column(str(rate), rate))
    if len(columns) != 2:
        raise CannotDraw(
            f"--kind phase draws one column over another, and {len(columns)} are given: "
            "--show x draws x' over x, --show x,y draws y over x"
        )
    run = run_with(problem, request, columns, progress)
    items = run.in_the_plane(named=False)
    if not items:
        raise CannotDraw("the columns have no values together")
    spans = [extent(run.values(place)) for place in (1, 2)]
    panel = run.labels.panel(columns, spans, items)
    picture = Picture(title=problem.title, panels=(panel,), notes=run.notes())
    return picture, run.result.refusal
