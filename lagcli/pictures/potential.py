"""The effective potential of one degree of freedom with its turning points at the energy E."""

from __future__ import annotations

from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.contours import grid
from lagcli.pictures.drawing import (
    Axis,
    Curve,
    Drawn,
    DrawnName,
    Item,
    Marks,
    Panel,
    Picture,
    Point,
    Rule,
    unbroken,
    words,
)
from lagcli.pictures.labels import Labels, with_unit
from lagcli.pictures.one_freedom import RemainingFreedom
from lagcli.pictures.portrait import constants
from lagcli.pictures.window import Window
from lagcli.problem_data import JACOBI_FUNCTION, Problem

_PLACES = 1201
#: Room below the lowest energy, in heights of what is shown.
_BELOW = 0.15


def potential(problem: Problem, request: RunRequest) -> Drawn:
    """U_eff over q, the energy of the initial state, and where the motion turns.

    Raises
    ------
    CannotDraw
        Where more than one degree of freedom is left, or the energy is not conserved.
    """
    del request  # states are drawn, no motion
    freedom = RemainingFreedom(problem)
    labels, window = Labels(problem), Window(freedom, Labels(problem))
    u, energy = freedom.potential, window.energy
    low, high = window.q
    height = window.highest - window.lowest
    bottom, top = min(window.lowest, energy) - _BELOW * height, window.highest
    if window.turns:
        top = max([energy, *map(u, window.unstable)]) + _BELOW * height
    items: list[Item] = [
        Curve(pieces=_pieces(freedom, window, bottom, top), role="potential", colour=0,
              label=_symbol(freedom)),
        Rule(at=energy, of="y", role="energy", colour=1, label=_value(energy)),
    ]  # fmt: skip
    turning = tuple((x, energy) for x in window.turning_points if low <= x <= high)
    if turning:
        shown = ", ".join(f"{_rounded(x, high - low):.6g}" for x, _ in turning)
        shown = shown.replace("-", "\N{MINUS SIGN}")
        text = words(f"turning points: {shown}" if len(turning) <= 4 else "turning points")
        items.append(Marks(points=turning, role="turning", colour=1, label=text))
    for role, places, colour in window.marked:
        points = tuple((x, u(x)) for x in places if bottom <= u(x) <= top)
        if points:
            text = words("minimum" if role == "stable" else "maximum")
            items.append(Marks(points=points, role=role, colour=colour, label=text))
    panel = Panel(
        x=labels.axis_over(freedom.columns[0], window.q),
        y=Axis(label=_energies(labels, freedom), low=bottom, high=top),
        items=tuple(items),
    )
    return Picture(title=problem.title, panels=(panel,), notes=constants(freedom)), ""


def _rounded(x: float, width: float) -> float:
    """0 for what rounding has left of it."""
    return 0.0 if abs(x) < 1e-12 * width else x


def _value(energy: float) -> DrawnName:
    shown = f"{energy:.6g}"
    minus = shown.replace("-", "\N{MINUS SIGN}")
    return DrawnName(plain=f"E = {minus}", ascii=f"E = {shown}", tex=f"$E = {shown}$")


def _symbol(freedom: RemainingFreedom) -> DrawnName:
    name = freedom.potential_name
    letter, _, index = name.partition("_")
    tex = rf"${letter}_{{\mathrm{{{index}}}}}$" if index else f"${letter}$"
    return DrawnName(plain=name, ascii=name, tex=tex)


def _energies(labels: Labels, freedom: RemainingFreedom) -> DrawnName:
    return with_unit(_symbol(freedom), labels.unit(JACOBI_FUNCTION))


def _pieces(
    freedom: RemainingFreedom, window: Window, bottom: float, top: float
) -> tuple[tuple[Point, ...], ...]:
    """The curve where it is defined; what is far outside of the panel is left out."""
    margin = 2 * (top - bottom)
    line = ((x, freedom.potential(x)) for x in grid(*window.q, _PLACES))
    return unbroken(p if bottom - margin <= p[1] <= top + margin else None for p in line)
