"""A computed motion: columns of numbers with their certificate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.interface.columns import Columns

if TYPE_CHECKING:
    from lagcli.expression import Expression
    from lagcli.interface.picture import Animation, Plot
    from lagcli.numerics.hybrid.events import Event
    from lagcli.numerics.hybrid.request import Asked
    from lagcli.numerics.hybrid.result import Certificate, Result
    from lagcli.problem_data import Problem

_USUAL_ACCURACY = 1e-9


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

    def __init__(self, result: Result, problem: Problem, asked: Asked) -> None:
        self._result = result
        self._problem = problem
        self._asked = asked
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

            run = PicturedRun(self._problem, self._asked, result=self._result)
            return Plot(series(run), self.refusal)
        if kind not in NAMES:
            raise ValueError(f"unknown kind {kind!r}: the kinds are {', '.join(NAMES)}")
        request = PictureRequest(kind=kind, section=section, orbits=orbits)
        return Plot(*picture_of(self._problem, self._asked, request))

    def animate(self, *, forces: bool = False) -> Animation:
        """Show the motion as it goes on; `forces` adds arrows.

        Raises
        ------
        CannotDraw
            When the file does not state where its bodies are.
        """
        from lagcli.interface.picture import Animation
        from lagcli.pictures.scene import scene

        return Animation(*scene(self._problem, self._asked, forces=forces))

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

    asked = asked_of(problem, **options)
    return Motion(simulate(problem, asked), problem, asked)


def asked_of(
    problem: Problem,
    *,
    until: float | str | None = None,
    accuracy: float | None = None,
    samples: int = 101,
    times: Sequence[float] = (),
    show: Sequence[str] = (),
    method: str = "auto",
    stop_when: str | None = None,
    project: bool = False,
    precision: int | None = None,
    whole_model: bool = False,
) -> Asked:
    """The options of a run as values.

    Raises
    ------
    ProblemError, ValueError
        When one does not fit the problem.
    """
    from lagcli.formatters.grammar import to_grammar
    from lagcli.numerics.equations.columns import Column
    from lagcli.numerics.hybrid.request import Asked
    from lagcli.problem_data import METHODS
    from lagcli.reader.columns import read_along, read_columns, usual_columns

    run = problem.simulation
    chosen = run.method if method == "auto" and run.method else method
    if chosen not in METHODS:
        raise ValueError(f"unknown method {chosen!r}: the methods are {', '.join(METHODS)}")
    shown = read_columns(problem, list(show)) if show else usual_columns(problem)
    return Asked(
        until=_number(problem, _formula(until, run.until, "until"), "until"),
        end=_formula(until, run.until, "until"),
        accuracy=_number(
            problem, _formula(accuracy, run.accuracy, "accuracy"), "accuracy", _USUAL_ACCURACY, 1
        ),
        samples=samples,
        times=tuple(map(float, times)),
        columns=tuple(Column(name, expression) for name, expression in shown),
        project=project,
        stop_when=None if stop_when is None else read_along(problem, stop_when, "stop_when"),
        stop_name=stop_when or "",
        method=chosen,
        digits=precision,
        whole=whole_model,
        written=to_grammar,
    )


def _formula(given: float | str | None, of_file: Expression | None, what: str) -> Expression | None:
    """A number of the call, or else of the file, as it is written."""
    from lagcli.reader.columns import read_number

    if given is None:
        return of_file
    return read_number(repr(given) if isinstance(given, float) else str(given), what)


def _number(
    problem: Problem,
    formula: Expression | None,
    what: str,
    usual: float | None = None,
    below: float = math.inf,
) -> float:
    """Its value, which is positive."""
    from lagcli.evaluation import value_of

    if formula is None:
        if usual is None:
            raise ProblemError(problem.source, (Diagnostic(f"{what} is missing: give {what}=…"),))
        return usual
    value = value_of(formula)
    if value is None or not 0 < float(value) < below:
        wanted = "a positive number" if below == math.inf else f"between 0 and {below:g}"
        raise ProblemError(problem.source, (Diagnostic(f"{what} must be {wanted}"),))
    return float(value)
