"""Problems against their known answers and against the mathematics itself."""

from __future__ import annotations

from lagcli.check.collect import NothingToCheck, problem_files
from lagcli.check.findings import CheckOutcome, Finding, Report
from lagcli.check.workers import check_all

__all__ = ["CheckOutcome", "Finding", "NothingToCheck", "Report", "check_all", "problem_files"]
