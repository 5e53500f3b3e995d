"""How runs are tightened, by runs whose errors are known."""

import math
from types import SimpleNamespace

import pytest

from lagcli.numerics.accuracy import Controller
from lagcli.numerics.run import Mark

ACCURACY, ROUNDED = 1e-9, 2e-15


def tolerances(error):
    """Those that are tried where a run with a tolerance has an error."""
    tried = []

    def runner(tolerance, longest, peaks, every):
        del longest, peaks, every
        tried.append(tolerance)
        rows = [[0.0], [1.0 + error(tolerance)]]
        marks = [Mark(float(k), row, [0.0], 0, k) for k, row in enumerate(rows)]
        return SimpleNamespace(
            rows=lambda: rows, marks=marks, phases=[0], peaks=[1.0, 1.0], events=[], event=None,
            stop=None, steps=100, step_limit=1000, evaluations=100, defect=0.0,
        )  # fmt: skip

    controller = Controller(
        runner, accuracy=ACCURACY, finest=1e-18, rounded=ROUNDED, span=1.0, charges=0
    )
    return tried, controller.outcome()


def test_rounding_that_no_tolerance_makes_less_is_not_tried_again():
    errors = {-11: 1e-9, -13: -1e-9, -15: 1e-9}
    tried, found = tolerances(lambda tolerance: errors.get(round(math.log10(tolerance)), 0.0))
    assert not found.reached
    assert tried == pytest.approx([1e-11, 1e-13, 1e-15])


def test_an_error_that_grows_less_with_the_tolerance_is_pursued():
    tried, found = tolerances(lambda tolerance: 1e6 * tolerance)
    assert found.reached
    assert max(found.errors) <= ACCURACY
    assert tried[-1] < 1e-15
