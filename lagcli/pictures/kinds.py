"""The kinds of pictures by name."""

from __future__ import annotations

from collections.abc import Callable

from lagcli.numerics.hybrid.request import Asked
from lagcli.pictures.drawing import Picture
from lagcli.problem_data import Problem
from lagcli.record import record

Progress = Callable[[float], None]


@record(kw_only=True)
class PictureRequest:
    """Which picture.

    Attributes
    ----------
    kind
        Its name.
    chosen
        Whether the columns are those that the user has named.
    section, orbits
        Of a Poincaré section: where it is, and of how many motions.
    """

    kind: str
    chosen: bool = False
    section: str | None = None
    orbits: int = 1


def picture_of(
    problem: Problem, asked: Asked, request: PictureRequest, progress: Progress | None = None
) -> tuple[Picture, str]:
    """The picture, and why the accuracy was not reached to the end; empty where it was.

    Raises
    ------
    CannotDraw
        When there is no such picture of this problem.
    Refusal
        When there is nothing to run.
    """
    return _KINDS[request.kind](problem, asked, request, progress)


Drawn = tuple[Picture, str]


def _series(problem: Problem, asked: Asked, _: PictureRequest, progress: Progress | None) -> Drawn:
    from lagcli.pictures.run import PicturedRun
    from lagcli.pictures.series import series

    run = PicturedRun(problem, asked, progress)
    return series(run), run.result.refusal


def _path(problem: Problem, asked: Asked, _: PictureRequest, progress: Progress | None) -> Drawn:
    from lagcli.pictures.path import path

    return path(problem, asked, progress)


def _drift(problem: Problem, asked: Asked, _: PictureRequest, progress: Progress | None) -> Drawn:
    from lagcli.pictures.drift import drift

    return drift(problem, asked, progress)


def _error(problem: Problem, asked: Asked, _: PictureRequest, progress: Progress | None) -> Drawn:
    from lagcli.pictures.error import error

    return error(problem, asked, progress)


def _phase(
    problem: Problem, asked: Asked, request: PictureRequest, progress: Progress | None
) -> Drawn:
    from lagcli.pictures.portrait import plane, portrait

    return (plane if request.chosen else portrait)(problem, asked, progress)


def _potential(problem: Problem, asked: Asked, _: PictureRequest, __: Progress | None) -> Drawn:
    from lagcli.pictures.potential import potential

    return potential(problem, asked)


def _poincare(
    problem: Problem, asked: Asked, request: PictureRequest, progress: Progress | None
) -> Drawn:
    from lagcli.pictures.section import section

    return section(problem, asked, request.section, request.orbits, progress, chosen=request.chosen)


_KINDS: dict[str, Callable[[Problem, Asked, PictureRequest, Progress | None], Drawn]] = {
    "series": _series,
    "phase": _phase,
    "path": _path,
    "potential": _potential,
    "poincare": _poincare,
    "drift": _drift,
    "error": _error,
}
#: What can be drawn.
NAMES = tuple(_KINDS)
