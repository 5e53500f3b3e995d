"""What comes of a run: the table, its certificate, and what the model was reduced to."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.numerics.hybrid.events import Event
from lagcli.record import field, record


@record(kw_only=True)
class Certificate:
    """How well the numbers are known, and how that is known.

    Attributes
    ----------
    accuracy, reached, holds_until
        The request, whether it holds to the end, and until when.
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
    #: coordinates whose motion nothing requested depends on
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
