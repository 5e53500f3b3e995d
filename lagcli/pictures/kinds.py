"""The kinds of pictures by name."""

from __future__ import annotations

from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import Drawn
from lagcli.problem_data import Problem
from lagcli.record import record

#: What can be drawn.
NAMES = ("series", "phase", "path", "potential", "poincare", "drift", "error")


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
    problem: Problem, request: RunRequest, drawing: PictureRequest, progress: Progress = None
) -> Drawn:
    """The picture, and why the accuracy was not reached to the end; empty where it was.

    Raises
    ------
    CannotDraw
        When there is no such picture of this problem.
    Refusal
        When there is nothing to run.
    """
    match drawing.kind:
        case "phase":
            from lagcli.pictures.portrait import plane, portrait

            return (plane if drawing.chosen else portrait)(problem, request, progress)
        case "path":
            from lagcli.pictures.path import path

            return path(problem, request, progress)
        case "potential":
            from lagcli.pictures.potential import potential

            return potential(problem, request)
        case "poincare":
            from lagcli.pictures.section import section

            where, orbits = drawing.section, drawing.orbits
            return section(problem, request, where, orbits, progress, chosen=drawing.chosen)
        case "drift":
            from lagcli.pictures.drift import drift

            return drift(problem, request, progress)
        case "error":
            from lagcli.pictures.error import error

            return error(problem, request, progress)
        case _:
            from lagcli.pictures.run import PicturedRun
            from lagcli.pictures.series import series

            run = PicturedRun(problem, request, progress)
            return series(run), run.result.refusal
