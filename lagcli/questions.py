"""The answers to the questions of a file."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.record import record


@record(kw_only=True)
class Solutions:
    """The answer to `where ... for ...`: the roots the motion can reach; None: not found."""

    unknown: str
    solutions: tuple[Expression, ...] | None
    note: str = ""


@record(kw_only=True)
class Rewritten:
    """The answer to `value ... in_terms_of ...`; None: not found."""

    value: Expression | None
    subject: Expression | None = None
    note: str = ""


@record(kw_only=True)
class FindSection:
    """The answers to the file's questions, by name."""

    answers: Mapping[str, Solutions | Rewritten]

    @property
    def unanswered(self) -> list[tuple[str, str]]:
        """What was not found, and why."""
        return [
            (f"the answer to '{name}'", answer.note or "no closed form")
            for name, answer in self.answers.items()
            if (answer.solutions if isinstance(answer, Solutions) else answer.value) is None
        ]
