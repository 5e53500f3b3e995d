"""Problems against their known answers and against the mathematics itself."""

from __future__ import annotations

from lagcli.studies.check.collect import NothingToCheck, problem_files
from lagcli.studies.check.findings import CheckOutcome, Finding, Report
from lagcli.studies.check.workers import check_all

__all__ = ["CheckOutcome", "Finding", "NothingToCheck", "Report", "check_all", "problem_files"]
