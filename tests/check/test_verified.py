"""The mathematics is checked too: an answer that breaks a law is found without `expect`."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from lagcli.expression import Negative, Number, Product
from lagcli.platform.effort import OutOfWork
from lagcli.sections import accelerations, charges, multipliers
from lagcli.studies.check.findings import CheckOutcome
from lagcli.studies.check.one import check_problem

PENDULUM = b"""\
coordinates: [x, y]
parameters: {m: {assume: positive}, g: {assume: positive}, l: {assume: positive}}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {rod: x^2 + y^2 = l^2}
symmetries: {rotation: {x: -y, y: x}}
"""


def changed(monkeypatch, room, change):
    """The findings of a pendulum of which a section is derived wrong."""
    derive = room.SECTION.derive
    wrong = replace(room.SECTION, derive=lambda statements: change(derive(statements)))
    monkeypatch.setattr(room, "SECTION", wrong)
    return check_problem("pendulum.yaml", PENDULUM).findings


def test_right_answers_obey():
    report = check_problem("pendulum.yaml", PENDULUM)
    assert report.passed
    assert report.checks == 3


def test_a_wrong_acceleration(monkeypatch):
    def turned(section):
        old = section.accelerations
        return replace(section, accelerations={**old, "x": Negative(old["x"])})

    [finding] = changed(monkeypatch, accelerations, turned)
    assert finding.outcome is CheckOutcome.WRONG
    assert "could not be confirmed; this is left out" in finding.message


def test_a_multiplier_of_the_wrong_sign(monkeypatch):
    def turned(section):
        old = section.multipliers["rod"]
        return replace(section, multipliers={"rod": replace(old, value=Negative(old.value))})

    [finding] = changed(monkeypatch, multipliers, turned)
    assert finding.outcome is CheckOutcome.WRONG


def test_a_rate_that_is_not_the_charge_s(monkeypatch):
    def doubled(section):
        charges = tuple(
            replace(each, rate=Product((Number(Fraction(2)), each.rate)))
            if each.name == "rotation"
            else each
            for each in section.charges
        )
        return replace(section, charges=charges)

    [finding] = changed(monkeypatch, charges, doubled)
    assert finding.outcome is CheckOutcome.WRONG
    assert "rotation" in finding.message


@pytest.mark.parametrize(
    ("error", "outcome"),
    [(ZeroDivisionError, CheckOutcome.BROKEN), (OutOfWork, CheckOutcome.UNDECIDED)],
)
def test_a_section_that_could_not_be_made_is_not_called_wrong(monkeypatch, error, outcome):
    def fails(_self):
        raise error

    monkeypatch.setattr(charges, "SECTION", replace(charges.SECTION, derive=fails))
    [finding] = check_problem("pendulum.yaml", PENDULUM).findings
    assert (finding.outcome, finding.subject) == (outcome, "charges")
