"""`expect: trajectory` is compared: what is right passes, a changed digit does not."""

import pytest

from lagcli.studies.check.findings import CheckOutcome
from lagcli.studies.check.one import check_problem

BALL = """
coordinates: [x, y]
parameters: {g: 10, h: 5, e: 1/2}
T: (x'^2 + y'^2)/2
V: g*y
contacts: {floor: {gap: y >= 0, restitution: e, multiplier: N}}
symmetries: {shift: {x: 1}}
initial: {y: h, x': 1}
simulation: {until: 2}
expect:
  trajectory:
    x: t
    shift: 1
    tolerance: 1e-8
    at:
      - {t: 1/3, y: h - g/18, floor.y: 0}
      - {t: 1.5, y: e^2*h, energy: 1/2 + e^2*g*h}
    events:
      - {name: floor, what: impact, t: 1, y': -10}
"""


def outcomes(text):
    return [
        (f.outcome, f.subject, f.span.line) for f in check_problem("b.yaml", text.encode()).findings
    ]


def test_a_known_motion_passes():
    report = check_problem("b.yaml", BALL.encode())
    assert report.passed, report.findings
    # 2 formulas, 2 + 2 numbers, an event and its number
    without = check_problem("b.yaml", BALL[: BALL.index("expect")].encode())
    assert report.checks - without.checks == 8


@pytest.mark.long
@pytest.mark.parametrize(
    ("right", "wrong", "subject", "line"),
    [
        ("x: t\n", "x: t + 1e-6*t^2\n", "trajectory.x", 12),
        ("shift: 1\n", "shift: 1.0000001\n", "trajectory.shift", 13),
        ("y: h - g/18", "y: h - g/18.00001", "trajectory.at.0", 16),
        ("y: e^2*h,", "y: e^2*h*1.0000001,", "trajectory.at.1", 17),
        ("y': -10", "y': 10", "trajectory.events.0", 19),
        ("impact, t: 1,", "impact, t: 1.0000001,", "trajectory.events.0", 19),
        ("what: impact", "what: contact lost", "trajectory.events.0", 19),
    ],
)
def test_a_changed_number_is_wrong_at_its_place(right, wrong, subject, line):
    assert BALL.count(right) == 1
    assert outcomes(BALL.replace(right, wrong)) == [(CheckOutcome.WRONG, subject, line)]


def test_a_known_motion_is_proved_where_the_file_says_so():
    text = BALL.replace("    x: t\n", "    rigorous: yes\n    x: t\n")
    report = check_problem("b.yaml", text.encode())
    assert report.passed, report.findings
    assert outcomes(text.replace("y': -10", "y': -10.000001")) == [
        (CheckOutcome.WRONG, "trajectory.events.0", 20)
    ]
    report = check_problem("b.yaml", text.replace("rigorous: yes", "rigorous: maybe").encode())
    assert "'rigorous' has no value 'maybe'" in str(report.findings or report)


def test_a_run_that_stops_early_is_wrong():
    text = BALL.replace(", restitution: e", "").replace("e^2*h, energy: 1/2 + e^2*g*h", "0")
    found = outcomes(text.replace("what: impact", "what: contact closes"))
    assert found == [(CheckOutcome.WRONG, "trajectory.at.1", 17)]


def test_an_accuracy_that_is_not_reached_is_undecided():
    text = "{coordinates: [r], L: r'^2/2 + 1/r, initial: {r: 1}, expect: {trajectory: {at: [{t: 2, r: 0}]}}}"
    assert [outcome for outcome, *_ in outcomes(text)] == [CheckOutcome.UNDECIDED]


def test_a_missing_value_is_undecided():
    text = "{coordinates: [x], parameters: [k], L: x'^2/2 - k*x^2, initial: {x: 1}, expect: {trajectory: {x: 1, until: 1}}}"
    assert [outcome for outcome, *_ in outcomes(text)] == [CheckOutcome.UNDECIDED]
