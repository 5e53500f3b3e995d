"""The answers to the questions of a file."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.record import record


@record(kw_only=True)
class Solutions:
    """The answer to `where ... for ...`: the roots the motion can reach; None: not found.

    `remarks` is the note with its formulas as trees.
    """

    unknown: str
    solutions: tuple[Expression, ...] | None
    note: str = ""
    remarks: tuple[str | Expression, ...] = ()
    given_values: bool = False  # for the values of the file alone


@record(kw_only=True)
class Rewritten:
    """The answer to `value ... in_terms_of ...`; None: not found.

    `values` holds both where it is determined up to its sign only; `value` is None then.
    """

    value: Expression | None
    values: tuple[Expression, ...] = ()
    subject: Expression | None = None
    note: str = ""


@record(kw_only=True)
class Range:
    """An interval of an unknown; a bound that is None: none but the unknown's assumption."""

    lower: Expression | None = None
    upper: Expression | None = None
    lower_included: bool = True
    upper_included: bool = True

    @property
    def bounds(self) -> list[tuple[str, Expression]]:
        """The bounds, each with how the unknown compares with it."""
        bounds = []
        if self.lower is not None:
            bounds.append((">=" if self.lower_included else ">", self.lower))
        if self.upper is not None:
            bounds.append(("<=" if self.upper_included else "<", self.upper))
        return bounds


@record(kw_only=True)
class Proved:
    """What an enclosure of the motion proves for the values of the file.

    Attributes
    ----------
    holds : bool
        Whether the place is reached, or the condition lasts over the span.
    until : float
        The end of the span, or of the motion.
    at : str
        The proved digits of the time at which the place is reached or the condition fails.
    sentence : str
    """

    holds: bool
    until: float
    at: str = ""
    sentence: str


@record(kw_only=True)
class Ranges:
    """The answer to `always` or `reaches ... for ...`, in order; None: not decided."""

    unknown: str
    ranges: tuple[Range, ...] | None
    note: str = ""
    given_values: bool = False  # for the values of the file alone
    proved: Proved | None = None


Answer = Solutions | Rewritten | Ranges


@record(kw_only=True)
class FindSection:
    """The answers to the file's questions, by name."""

    answers: Mapping[str, Answer]

    @property
    def unanswered(self) -> list[tuple[str, str]]:
        """What was not found, and why."""
        return [
            (f"the answer to '{name}'", answer.note or "no closed form")
            for name, answer in self.answers.items()
            if _found(answer) is None
        ]


def _found(answer: Answer) -> object:
    match answer:
        case Solutions():
            return answer.solutions
        case Ranges():
            return answer.proved if answer.ranges is None else answer.ranges
        case Rewritten():
            return answer.value or answer.values or None
