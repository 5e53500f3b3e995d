"""For reading: a line for each problem, and where and what for each failure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from lagcli.studies.check.findings import CheckOutcome, Report


def render(reports: Iterable[Report]) -> Iterator[str]:
    """The lines of each report when it comes, then how many ended how."""
    outcomes: Counter[CheckOutcome] = Counter()
    checks = 0
    for report in reports:
        outcomes[report.outcome] += 1
        checks += report.checks
        yield f"{report}\n"
    counts = [
        f"{outcomes[outcome]} {outcome.value}" for outcome in CheckOutcome if outcomes[outcome]
    ]
    problems = outcomes.total()
    yield f"{problems} problem{'s' * (problems != 1)}, {checks} checks: {', '.join(counts)}\n"
