"""What a proof gives: enclosures, events, and what it stands on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lagcli.numerics.hybrid.events import Event
from lagcli.numerics.hybrid.result import Certificate, Result
from lagcli.record import record

Enclosure = tuple[Any, ...]


@record
class ProvedEvent:
    """An event that happens once within a ball of times."""

    t: Any
    name: str
    what: str
    before: Mapping[str, Any]


@record(kw_only=True)
class Proof:
    """What was proved.

    Attributes
    ----------
    columns : tuple of str
    rows : tuple of tuples of arb
        Each ball contains the exact value at that time; None where it jumps just then.
    accuracy, reached, holds_until
        As of a certificate; here they are proved.
    bits, kept, order, steps : int
        Of the successful attempt: bits of states, constants and the coefficients that weigh, and of
        the rest; what a step leaves out is below 2^-kept of the state.
    assumed : tuple of str
        What the proof stands on.
    events : tuple of ProvedEvent
        All that happened, in order.
    refusal : str
        Why the rows end early; empty where they do not.
    within : float, optional
        The rows are those of a motion whose initial values are as near to the file's; without it,
        of the file's own motion.
    """

    columns: tuple[str, ...]
    rows: tuple[Enclosure, ...]
    accuracy: float
    reached: bool
    holds_until: float
    bits: int
    kept: int
    order: int
    steps: int
    assumed: tuple[str, ...]
    events: tuple[ProvedEvent, ...] = ()
    refusal: str = ""
    within: float | None = None

    def as_result(self) -> Result:
        """The middles of all enclosures, as of a run."""
        certificate = Certificate(
            accuracy=self.accuracy,
            reached=self.reached,
            holds_until=self.holds_until,
            global_error={},
            scales=(),
            estimated_by="proof",
            charges={},
            constraints={},
        )
        events = [
            Event(float(e.t), e.name, e.what, float(e.t.rad()),
                  before={name: _middle(x) for name, x in e.before.items()})
            for e in self.events
        ]  # fmt: skip
        return Result(
            columns=self.columns,
            rows=tuple(tuple(map(_middle, row)) for row in self.rows),
            certificate=certificate,
            method="proof",
            reason="",
            steps=self.steps,
            evaluations=0,
            events=tuple(events),
            refusal=self.refusal,
        )


def _middle(x: Any) -> float | None:
    return None if x is None else float(x.mid())
