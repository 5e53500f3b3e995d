"""An extreme case, and what came of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from lagcli.expression import Expression, Name
from lagcli.problem_data import Problem
from lagcli.record import field, record

#: What a case is an extreme of, in the order of the report.
KINDS = {
    "given": "the file as it stands",
    "ratios": "parameters of one dimension in the ratio 1e±12, others times 1e±12",
    "angles": "1e-9 away from 0, pi/2 and pi",
    "singular": "at and near the zeros of the mass matrix's determinant",
    "separatrix": "near an unstable equilibrium, and with its energy",
    "light": "at, next to and far below the speed at which a root of velocities ends",
    "zero": "a mass, the gravity or another parameter that is 0",
    "spans": "a hundred times the span",
}

Group = Literal["accelerations", "multipliers", "charges"]
GROUPS: tuple[Group, ...] = ("accelerations", "multipliers", "charges")

Verdict = Literal["right", "claimed", "refused", "wrong", "undecided"]
#: Those after which the exit status is 1.
BAD: tuple[Verdict, ...] = ("wrong", "undecided")


@record(kw_only=True)
class Case:
    """One extreme.

    Attributes
    ----------
    kind
        Out of `KINDS`.
    name
        What is extreme, as `m1/m2 = 1e12`.
    problem
        The file's, with these values and this initial state.
    parameters, initial
        What differs from the file, for the report.
    stretch
        How many times the usual span is run.
    """

    kind: str
    name: str
    problem: Problem
    parameters: Mapping[str, Expression] = field(default_factory=dict)
    initial: Mapping[Name, Expression] = field(default_factory=dict)
    stretch: float = 1.0


@record(kw_only=True)
class CaseFormula:
    """A formula that `solve` prints, and the same without cancellation where that is known."""

    group: Group
    name: str
    printed: Expression
    rewritten: Expression | None = None


@record(kw_only=True)
class Loss:
    """Decimal digits that a formula loses in doubles, of 16; None: it is not defined there."""

    group: Group
    name: str
    printed: float | None
    rewritten: float | None


@record(kw_only=True)
class CaseTrial:
    """What came of a case.

    Attributes
    ----------
    verdict
        `right`: the certificate is met by a proof or a run with more digits; `claimed`: there was
        none; `refused`: with its reason; `wrong`, `undecided`: neither.
    reason
        Why it is refused, wrong or undecided.
    losses
        Of every printed formula.
    run_loss
        Of the accelerations and multipliers as a run works them out.
    condition
        Of the mass matrix scaled to a unit diagonal; inf where it is singular.
    until, holds_until
        The requested span, and the time until which the accuracy is claimed.
    accuracy, error
        The one claimed, and the true one.
    proved
        Whether the error is bounded by enclosures of the exact motion.
    drift
        The largest change of a charge.
    """

    verdict: Verdict
    reason: str = ""
    losses: tuple[Loss, ...] = ()
    run_loss: float | None = None
    condition: float | None = None
    until: float | None = None
    holds_until: float | None = None
    accuracy: float | None = None
    error: float | None = None
    proved: bool = False
    drift: float | None = None
    method: str = ""
    seconds: float | None = None
