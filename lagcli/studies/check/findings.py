"""What a check has to say of one problem."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import Enum

from lagcli.diagnostics import NOWHERE, Diagnostic, Source, Span, printable, render
from lagcli.record import record

#: The path of an expectation, the verdict, what was expected and what was found.
Judged = tuple[list[str], bool | None, str, str]


class CheckOutcome(Enum):
    """How the check of one problem ended."""

    PASSED = "passed"
    WRONG = "wrong"
    UNDECIDED = "undecided"
    TOO_LONG = "took too long"
    BROKEN = "broken"  # lagcli itself failed
    INVALID = "invalid file"


@record
class Finding:
    """One answer that is wrong, or of which nobody could say whether it is right.

    Attributes
    ----------
    outcome
        `WRONG`, `UNDECIDED`, `TOO_LONG` or `BROKEN`.
    subject
        Which answer: `accelerations.x`.
    message
        What is the matter with it.
    span
        Where the file expects it.
    """

    outcome: CheckOutcome
    subject: str
    message: str
    span: Span = NOWHERE


@record
class Report:
    """The check of one file.

    `checks` counts the comparisons made; `diagnostics` say why a file is invalid.
    """

    source: Source
    checks: int = 0
    findings: Sequence[Finding] = ()
    diagnostics: Sequence[Diagnostic] = ()
    seconds: float = 0.0

    @property
    def outcome(self) -> CheckOutcome:
        """The worst that was found: what is wrong over what is undecided."""
        if any(diagnostic.is_error for diagnostic in self.diagnostics):
            return CheckOutcome.INVALID
        found = {finding.outcome for finding in self.findings}
        worst = (
            CheckOutcome.BROKEN,
            CheckOutcome.WRONG,
            CheckOutcome.TOO_LONG,
            CheckOutcome.UNDECIDED,
        )
        return next((outcome for outcome in worst if outcome in found), CheckOutcome.PASSED)

    @property
    def passed(self) -> bool:
        """Whether everything holds."""
        return self.outcome is CheckOutcome.PASSED

    def __str__(self) -> str:
        return "\n".join(self._lines())

    __repr__ = __str__

    def _lines(self) -> Iterator[str]:
        name = printable(self.source.name)
        if self.passed:
            yield f"passed  {name}  ({self.checks} checks)"
            return
        yield f"FAILED  {name}  ({self.outcome.value})"
        for line in render(self.source, self.diagnostics).splitlines():
            yield f"    {line}"
        for finding in self.findings:
            yield f"    {place(self, finding)}: {finding.outcome.value}: {finding.subject}"
            yield f"        {printable(finding.message)}"


def place(report: Report, finding: Finding) -> str:
    """`file:line:column` of the expectation, or the file alone."""
    name = printable(report.source.name)
    if finding.span == NOWHERE:
        return name
    return f"{name}:{finding.span.line}:{finding.span.column}"
