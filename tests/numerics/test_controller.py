"""How runs follow each other, by runs whose errors and peaks are known."""

import math
from types import SimpleNamespace

import mpmath
import pytest

from lagcli.numerics.certified.accuracy import Controller
from lagcli.numerics.hybrid.mark import Mark

from .running import column, last, simulated

ACCURACY, ROUNDED = 1e-9, 2e-15


def tolerances(error, shortened=0):
    """Those that are tried where a run with a tolerance has an error."""
    tried = []

    def runner(tolerance, longest, peaks, every, slow, times):
        del longest, peaks, every
        tried.append(tolerance)
        rows = [[0.0], [1.0 + error(tolerance)]]
        marks = [Mark(float(k), row, [0.0], 0, k) for k, row in enumerate(rows)]
        return SimpleNamespace(
            rows=lambda: rows, marks=marks, phases=[], scales=[1.0, 1.0], peaks=[1.0, 1.0], events=[], event=None,
            stop=None, steps=100, step_limit=1000, evaluations=100, defect=0.0, shortened=shortened,
        )  # fmt: skip

    controller = Controller(
        runner, accuracy=ACCURACY, finest=1e-18, rounded=ROUNDED, span=1.0, charges=0,
        scales=lambda *_: [1.0],
    )  # fmt: skip
    return tried, controller.outcome()


def test_rounding_that_no_tolerance_makes_less_is_not_tried_again():
    errors = {-11: 1e-9, -13: -1e-9, -15: 1e-9}
    tried, found = tolerances(lambda tolerance: errors.get(round(math.log10(tolerance)), 0.0))
    assert not found.reached
    assert tried == pytest.approx([1e-11, 1e-13, 1e-15])


def test_two_runs_past_something_narrow_that_agree_by_chance_claim_nothing():
    """The first two err alike, the others not."""
    tried, found = tolerances(lambda each: 1e-8 * (round(math.log10(each), 2) in (-11, -13)), 1)
    assert found.reached
    assert found.rows[-1] == [1.0]
    assert len(tried) > 3


def test_an_error_that_grows_less_with_the_tolerance_is_pursued():
    tried, found = tolerances(lambda tolerance: 1e6 * tolerance)
    assert found.reached
    assert max(found.errors) <= ACCURACY
    assert tried[-1] < 1e-15


def test_what_grows_is_as_fine_at_first_as_a_tolerance_says():
    """x'' = x from rest: the last peak, e^100 times the first, is no scale for the beginning."""
    text = "{coordinates: [x], L: x'^2/2 + x^2/2, initial: {x: 1}}"
    result = simulated(text, 100, 1e-9, samples=5)
    assert result.certificate.reached
    assert "runs with local tolerances 1e-11 and 1e-13" in result.certificate.estimated_by
    assert last(result, "x") == pytest.approx(math.cosh(100), rel=1e-9)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9])
def test_two_runs_take_other_steps_in_a_short_phase(accuracy):
    """x' = t/2 comes to sin(t), friction holds it there until cos(t) = -1/2, and it is braked."""
    text = "{coordinates: [x], T: x'^2/2, forces: {x: \"-sign(x' - sin(t))/2\"}, initial: {x: 0}}"
    result = simulated(text, 10, accuracy, samples=3)
    held = mpmath.findroot(lambda t: t / 2 - mpmath.sin(t), 1.9)
    free = 2 * mpmath.pi / 3
    place = held**2 / 4 + mpmath.cos(held) - mpmath.cos(free)
    after = 5 - free
    true = place + mpmath.sin(free) * after - after**2 / 4
    scale = result.certificate.scales[1]
    error = abs(column(result, "x")[1] - true) / scale
    assert error <= result.certificate.global_error["x"] + 2.0**-52


@pytest.mark.parametrize("angle", ["0", "0.3", "0.7", "1.3", "1.9", "2.9"])
@pytest.mark.parametrize("accuracy", [1e-9, 1e-12])
def test_the_bound_holds_for_rounding_that_an_unstable_motion_enlarges(angle, accuracy):
    """Three equal masses turn as a triangle, which is unstable (Lagrange 1772), from any side."""
    corners = [f"{angle} + {2 * k}*pi/3" for k in range(3)]
    start = ", ".join(
        f"x{k}: cos({a})/sqrt(3), y{k}: sin({a})/sqrt(3), x{k}': -sin({a}), y{k}': cos({a})"
        for k, a in enumerate(corners)
    )
    kinetic = " + ".join(f"(x{k}'^2 + y{k}'^2)/2" for k in range(3))
    pairs = "".join(
        f" - 1/sqrt((x{i} - x{j})^2 + (y{i} - y{j})^2)" for i, j in ((0, 1), (0, 2), (1, 2))
    )
    text = f"""{{coordinates: [x0, y0, x1, y1, x2, y2], T: "{kinetic}", V: "{pairs}",
        initial: {{{start}}}}}"""
    result = simulated(text, 6, accuracy, samples=9)
    with mpmath.workdps(30):
        root = mpmath.sqrt(3)
        for j, name in enumerate(result.columns[1:], 1):
            turned = (mpmath.pi / 2 if name[0] == "y" else 0) - (
                mpmath.pi / 2 if name.endswith("'") else 0
            )
            first = mpmath.mpf(angle) + 2 * int(name[1]) * mpmath.pi / 3 - turned
            scale = 1 if name.endswith("'") else root
            for row in result.rows:
                error = abs(row[j] * scale - mpmath.cos(root * mpmath.mpf(row[0]) + first))
                assert error <= result.certificate.global_error[name] + 2.0**-52


@pytest.mark.parametrize(
    "error", [lambda t: 3e-15 if t < 1e-12 else 0.0, lambda t: 1e-2 * t, lambda t: 1e6 * t]
)
def test_the_multiple_that_is_stated_is_that_of_the_bound(error):
    """The bound of a single column beside the difference of the two runs it is made of."""
    _, found = tolerances(error)
    coarse, fine = found.tolerances
    assert found.held[0] == pytest.approx(
        found.multiples[1] * abs(error(coarse) - error(fine)), rel=0.2
    )
