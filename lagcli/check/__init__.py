"""Problems against their known answers and against the mathematics itself."""

from __future__ import annotations

from lagcli.check.collect import NothingToCheck, problem_files
from lagcli.check.findings import Finding, Outcome, Report
from lagcli.check.workers import check_all

__all__ = ["Finding", "NothingToCheck", "Outcome", "Report", "check_all", "problem_files"]
