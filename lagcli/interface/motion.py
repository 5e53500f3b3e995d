"""A computed motion: columns of numbers with their certificate."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from lagcli.interface.columns import Columns

if TYPE_CHECKING:
    from lagcli.diagnostics import ProblemError
    from lagcli.interface.picture import Animation, Plot
    from lagcli.numerics.hybrid.events import Event
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.numerics.hybrid.result import Certificate, Result
    from lagcli.problem_data import Problem


class Motion(Columns):
    """What `simulate` gives: a table, and how well it is known.

    Attributes
    ----------
    columns : tuple of str
        The first is `t`.
    rows : tuple of tuples of float
        None where a column is not defined.
    certificate : Certificate
        Accuracy, until when it holds, the error of each column, drift of the charges.
    events : tuple of Event
        Impacts, releases and the like.
    method : str
    warnings : tuple of str
    refusal : str
        Why the rows end early; empty when they do not.
    """

    def __init__(self, result: Result, problem: Problem, request: RunRequest) -> None:
        self._result = result
        self._problem = problem
        self._request = request
        self.title = problem.title
        self.columns = result.columns
        self.rows = result.rows
        self.certificate: Certificate = result.certificate
        self.events: tuple[Event, ...] = result.events
        self.method = result.method
        self.warnings = result.warnings
        self.refusal = result.refusal

    def to_pandas(self) -> Any:
        """A pandas table with t as its index."""
        return super().to_pandas().set_index("t")

    def to_csv(self) -> str:
        """CSV with every digit of a double."""
        from lagcli.numerics.tables.writing import to_csv

        return to_csv(self._result)

    def to_json(self) -> str:
        """The contract of `lagcli simulate --format json`."""
        from lagcli.numerics.tables.writing import to_json

        return to_json(self._result)

    def plot(self, kind: str = "series", *, section: str | None = None, orbits: int = 1) -> Plot:
        """Draw the motion.

        Parameters
        ----------
        kind : str
            As `lagcli plot --kind` takes it: `series` draws the columns over time.
        section, orbits
            Of a Poincaré section: where it is, and of how many motions.

        Raises
        ------
        ValueError
            When there is no such kind.
        CannotDraw
            When there is no such picture of this motion.
        """
        from lagcli.interface.picture import Plot
        from lagcli.pictures.kinds import NAMES, PictureRequest, picture_of

        if kind == "series":
            from lagcli.pictures.run import PicturedRun
            from lagcli.pictures.series import series

            run = PicturedRun(self._problem, self._request, result=self._result)
            return Plot(series(run), self.refusal)
        if kind not in NAMES:
            raise ValueError(f"unknown kind {kind!r}: the kinds are {', '.join(NAMES)}")
        drawing = PictureRequest(kind=kind, section=section, orbits=orbits)
        return Plot(*picture_of(self._problem, self._request, drawing))

    def animate(self, *, forces: bool = False) -> Animation:
        """Show the motion as it goes on; `forces` adds arrows.

        Raises
        ------
        CannotDraw
            When the file does not state where its bodies are.
        """
        from lagcli.interface.picture import Animation
        from lagcli.pictures.scene import scene

        return Animation(*scene(self._problem, self._request, forces=forces))

    def __str__(self) -> str:
        from lagcli.numerics.tables.writing import to_table

        return to_table(self._result).rstrip("\n")

    def __repr__(self) -> str:
        last = self.rows[-1][0] if self.rows else 0
        return f"<Motion of {self.title!r}: {len(self.rows)} rows to t = {last}>"

    def _repr_html_(self) -> str:
        from lagcli.interface.tables import motion_as_html

        plot = self._plot_if_any
        shown = "" if plot is None else plot.to_html()
        return shown + motion_as_html(self._result, self.title)

    def _repr_png_(self) -> bytes | None:
        return None if self._plot_if_any is None else self._plot_if_any._repr_png_()

    @cached_property
    def _plot_if_any(self) -> Plot | None:
        """The columns over time; nothing where they cannot be drawn."""
        from importlib.util import find_spec

        from lagcli.pictures.drawing import CannotDraw

        try:
            return self.plot() if find_spec("matplotlib") else None
        except CannotDraw:
            return None


def integrate(problem: Problem, **options: Any) -> Motion:
    """Run a problem; see `lagcli.simulate`.

    Raises
    ------
    ProblemError
        When an option does not fit the problem.
    """
    from lagcli.numerics.certified.simulate import simulate

    request = request_of(problem, **options)
    return Motion(simulate(problem, request), problem, request)


def request_of(problem: Problem, **options: Any) -> RunRequest:
    """The requested run, by the names of `RunOptions`.

    Raises
    ------
    ProblemError
        When an option does not fit the problem.
    """
    from lagcli.studies.run_options import PYTHON, OptionReader, RunOptions

    def raised(error: ProblemError) -> None:
        raise error

    request = OptionReader(problem, PYTHON, raised).request(RunOptions(**options))
    assert request is not None  # else a mistake was raised
    return request
