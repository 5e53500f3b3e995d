"""Many files at once: in order, each within its time, none lost."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from lagcli.diagnostics import Source
from lagcli.studies.check import CheckOutcome, check_all, workers
from lagcli.studies.check.findings import Report

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="workers are not forked there")


@pytest.fixture
def files(tmp_path):
    def make(*names):
        for name in names:
            (tmp_path / name).write_text("")
        return [str(tmp_path / name) for name in names]

    return make


@pytest.fixture(autouse=True)
def acting(monkeypatch):
    """The name of a file says what its check does."""

    def check_problem(name, data):
        match Path(name).stem.partition("-")[0]:
            case "slow":
                time.sleep(0.4)
            case "endless":
                time.sleep(1000)
            case "crash":
                os._exit(3)
            case "bug":
                raise KeyError("of a test")
            case "deep":
                return Report(Source(name, ""), checks=depth(5000))
        return Report(Source(name, ""), checks=1)

    monkeypatch.setattr(workers, "check_problem", check_problem)
    monkeypatch.setattr(workers, "spare_sympy", lambda: None)
    monkeypatch.setattr(workers, "keep_what_is_there", lambda: None)


def depth(levels):
    return 0 if levels == 0 else 1 + depth(levels - 1)


def test_reports_come_in_the_order_of_the_files(files):
    names = files("slow-1", "a", "b", "slow-2", "c")
    assert [report.source.name for report in check_all(names, 3, 60)] == names


def test_what_takes_too_long_is_ended_and_the_rest_goes_on(files):
    reports = list(check_all(files("endless-1", "a", "endless-2", "b"), 2, 1.0))
    assert [report.outcome for report in reports] == [
        CheckOutcome.TOO_LONG, CheckOutcome.PASSED, CheckOutcome.TOO_LONG, CheckOutcome.PASSED,
    ]  # fmt: skip


def test_a_crash_and_a_bug_are_reported_as_such(files):
    crash, bug, fine = check_all(files("crash", "bug", "a"), 1, 60)
    assert [crash.outcome, bug.outcome, fine.outcome] == [
        CheckOutcome.BROKEN, CheckOutcome.BROKEN, CheckOutcome.PASSED,
    ]  # fmt: skip
    assert "status 3" in crash.findings[0].message
    assert "KeyError: 'of a test'" in bug.findings[0].message


def test_a_file_that_vanished_is_invalid(tmp_path):
    [report] = check_all([str(tmp_path / "gone.yaml")], 1, 60)
    assert report.outcome is CheckOutcome.INVALID


def test_workers_may_recurse_deeply(files):
    [report] = check_all(files("deep"), 1, 60)
    assert report.checks == 5000


def test_stopping_early_leaves_no_worker(files):
    reports = check_all(files("a", "endless"), 2, 60)
    next(reports)
    reports.close()
    import multiprocessing

    assert multiprocessing.active_children() == []
