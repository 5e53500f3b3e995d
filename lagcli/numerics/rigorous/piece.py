"""The motion over one step of a proof: a polynomial, the flow about it, and bounds of the rest."""

from __future__ import annotations

from typing import Any

from lagcli.numerics.rigorous.sets import LohnerSet
from lagcli.numerics.rigorous.solution import horner
from lagcli.record import record


@record
class StepFlow:
    """P and what bounds the rest.

    Attributes
    ----------
    coefficients : list of arb_mat
        P_0 .. P_Q.
    error : arb_mat
        D, entry by entry, for every time of the step.
    defect : arb_mat
        d, a column, likewise.
    """

    coefficients: list[Any]
    error: Any
    defect: Any


@record
class Piece:
    """The motion over one step.

    Attributes
    ----------
    begin, end : arb
        The times, exact.
    centre : list of list of arb
        c_0 .. c_K of each component.
    flow : StepFlow
    start : LohnerSet
        The set at the beginning.
    """

    begin: Any
    end: Any
    centre: list[list[Any]]
    flow: StepFlow
    start: LohnerSet

    def middle(self, t: Any) -> list[Any]:
        """Where the middle of the set goes, with the defect of its polynomial."""
        s, defect = t - self.begin, self.flow.defect
        return [horner(c, s) + defect[i, 0] for i, c in enumerate(self.centre)]

    def derivative(self, t: Any) -> Any:
        """An enclosure of the derivative of the flow over the set."""
        return horner(self.flow.coefficients, t - self.begin) + self.flow.error

    def at(self, t: Any) -> list[Any]:
        """An enclosure of (q, v) at a time of the step, or at all times of a ball."""
        spread = (self.derivative(t) * self.start.frame) * self.start.radii
        return [x + spread[i, 0] for i, x in enumerate(self.middle(t))]

    def first_part(self, part: float) -> Piece:
        """The beginning of the step."""
        end = (self.begin + part * (self.end - self.begin)).mid()
        return Piece(self.begin, end, self.centre, self.flow, self.start)

    def at_end(self) -> LohnerSet:
        """The set at the end of the step."""
        return self.start.moved(self.middle(self.end), self.derivative(self.end))
