"""An ensemble of motions: one row for each member, or for each time of each member."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.interface.columns import Columns
from lagcli.studies.sweep import WRITERS, Table, WrongPlan, at_times, plan_of, sweep
from lagcli.studies.sweep.journal import Journal

if TYPE_CHECKING:
    from lagcli.problem_data import Problem

Vary = Mapping[str, str | Sequence[float]]


class Sweep(Columns):
    """What `sweep` gives.

    Attributes
    ----------
    title : str
    columns : tuple of str
        What is varied, the columns of the motion, and of each row `reached` (1 or 0),
        `holds_until` and `error`.
    rows : tuple of tuples of float
        None where a member cannot be run.
    varied : tuple of str
        The first columns: parameters, and initial values such as `theta(0)`.
    complete : bool
        Whether every motion reached its accuracy.
    """

    def __init__(self, table: Table, title: str) -> None:
        self._table = table
        self.title = title
        self.columns = table.columns
        self.rows = table.rows
        self.varied = table.varied
        self.complete = table.complete

    def to_csv(self) -> str:
        """CSV with every digit of a double."""
        return self._written("csv")

    def to_json(self) -> str:
        """The contract of `lagcli sweep --format json`."""
        return self._written("json")

    def __str__(self) -> str:
        return self._written("table").rstrip("\n")

    def __repr__(self) -> str:
        return f"<Sweep of {self.title!r} over {', '.join(self.varied)}: {len(self.rows)} rows>"

    def _repr_html_(self) -> str:
        from lagcli.interface.tables import table_as_html

        return table_as_html(self.columns, self.rows, self.title)

    def _written(self, form: str) -> str:
        return WRITERS[form](self._table).decode()


def ensemble(
    problem: Problem,
    vary: Vary,
    *,
    random: int | None,
    seed: int,
    along: bool,
    jobs: int,
    samples: int,
    times: Sequence[float],
    **options: Any,
) -> Sweep:
    """Run every member; see `lagcli.studies.sweep`.

    Raises
    ------
    ProblemError
        When an option does not fit the problem.
    """
    from lagcli.interface.motion import request_of

    ranges = [f"{name}={_range(values)}" for name, values in vary.items()]
    try:
        plan = plan_of(problem, ranges, random, seed)
    except WrongPlan as error:
        raise ProblemError(problem.source, tuple(map(Diagnostic, error.lines))) from None
    if times:
        options["until"] = times[-1]
    request = request_of(problem, samples=samples if along else 2, **options)
    request, along = at_times(request, times), along or bool(times)
    with Journal(None, "") as journal:
        return Sweep(sweep(problem, request, plan, journal, along=along, jobs=jobs), problem.title)


def _range(values: str | Sequence[float]) -> str:
    """A range as the command line has it."""
    return values if isinstance(values, str) else ",".join(repr(float(x)) for x in values)
