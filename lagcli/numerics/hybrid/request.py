"""What is asked of a run, and what comes of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from lagcli.expression import Expression
from lagcli.numerics.equations.columns import Column
from lagcli.numerics.hybrid.events import Event
from lagcli.record import field, record


@record(kw_only=True)
class Asked:
    """A run as the user wants it.

    Attributes
    ----------
    until, accuracy, samples
        The span of time, the bound on the global error of every column, the rows.
    end : Expression or None
        `until` as it is written; None where it is that double.
    times : tuple of float
        The rows, from 0 to `until`, where they are not evenly spread.
    columns : tuple of Column
        What is shown; the first is the time.
    project : bool
        Take the nearest consistent initial state for one off the constraints.
    stop_when : Expression or None
        The run stops where it changes its sign.
    method : str
        `auto`, or one by its name.
    digits : int or None
        How many may be carried where doubles do not suffice; None leaves it at doubles,
        and at what lies within their rounding.
    whole : bool
        Integrate the model as the file has it, nothing eliminated and nothing left out.
    furthest : bool
        Where the accuracy is not reached to the end, run shorter spans to find how long it holds.
    beyond : bool
        Keep the rows after those that are within the accuracy, apart from these.
    written : function
        Writes a formula of the cut model as text of the grammar.
    """

    until: float
    accuracy: float
    samples: int
    columns: tuple[Column, ...]
    end: Expression | None = None
    times: tuple[float, ...] = ()
    project: bool = False
    stop_when: Expression | None = None
    stop_name: str = ""
    method: str = "auto"
    digits: int | None = None
    whole: bool = False
    furthest: bool = True
    beyond: bool = False
    written: Callable[[Expression], str] = str


@record(kw_only=True)
class Certificate:
    """How well the numbers are known, and how that is known.

    Attributes
    ----------
    accuracy, reached, holds_until
        What was asked for, whether it holds to the end, and until when.
    global_error : mapping of str to float
        Of each column but the time, relative to its scale.
    scales : tuple of float
        Of all columns.
    estimated_by
        How the errors are known.
    charges : mapping of str to float
        The largest change of each.
    constraints : mapping of str to (float or None, float)
        The largest residual, and that of the rate.
    """

    accuracy: float
    reached: bool
    holds_until: float
    global_error: Mapping[str, float]
    scales: tuple[float, ...]
    estimated_by: str
    charges: Mapping[str, float]
    constraints: Mapping[str, tuple[float | None, float]]


@record
class EliminatedCoordinate:
    """A coordinate that a constraint gives: coordinate = formula."""

    coordinate: str
    constraint: str
    formula: str


@record
class Cut:
    """What the model was cut by."""

    kept: tuple[str, ...]
    eliminated: tuple[EliminatedCoordinate, ...]
    #: coordinates whose motion nothing asked for depends on
    dropped: tuple[str, ...]
    #: kept coordinates whose momentum is conserved
    ignorable: tuple[str, ...]


@record(kw_only=True)
class Result:
    """The table, its certificate, and how it was made.

    Attributes
    ----------
    beyond : tuple of rows, or None
        Rows of the run over the whole span after the certified ones, of which nothing is
        certified; None where they are not requested.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[float | None, ...], ...]
    certificate: Certificate
    method: str
    reason: str
    steps: int
    evaluations: int
    events: tuple[Event, ...] = ()
    warnings: tuple[str, ...] = field(default=())
    cut: Cut | None = None  # what the model was cut by
    beyond: tuple[tuple[float | None, ...], ...] | None = None
    refusal: str = ""  # why not all is there; empty when it is
