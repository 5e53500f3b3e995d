"""The mathematics is checked too: an answer that breaks a law is found without `expect`."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from lagcli.expression import Negative, Number, Product
from lagcli.pipeline import Request, derive, read, state
from lagcli.platform.effort import OutOfWork
from lagcli.sections import charges as room
from lagcli.studies.check.findings import CheckOutcome
from lagcli.studies.check.laws import SECTIONS, Laws
from lagcli.studies.check.one import check_problem

PENDULUM = b"""\
coordinates: [x, y]
parameters: {m: {assume: positive}, g: {assume: positive}, l: {assume: positive}}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {rod: x^2 + y^2 = l^2}
symmetries: {rotation: {x: -y, y: x}}
"""

TWICE = Number(Fraction(2))


@pytest.fixture(scope="module")
def pendulum():
    derivation = derive(read("pendulum.yaml", PENDULUM).problem)
    return derivation, state(derivation, Request(sections=SECTIONS))


def broken_laws(derivation, answers):
    return {finding.subject for finding in Laws(derivation, answers) if finding is not None}


def with_section(answers, name, **changes):
    section = replace(answers.sections[name], **changes)
    return replace(answers, sections={**answers.sections, name: section})


def test_right_answers_obey(pendulum):
    assert broken_laws(*pendulum) == set()


def test_a_wrong_acceleration(pendulum):
    derivation, answers = pendulum
    old = answers.sections["accelerations"].accelerations
    wrong = with_section(answers, "accelerations", accelerations={**old, "x": Negative(old["x"])})
    assert broken_laws(derivation, wrong) >= {"equations.x", "constraints.rod"}


def test_a_multiplier_of_the_wrong_sign(pendulum):
    derivation, answers = pendulum
    old = answers.sections["multipliers"].multipliers["rod"]
    wrong = with_section(
        answers, "multipliers", multipliers={"rod": replace(old, value=Negative(old.value))}
    )
    assert broken_laws(derivation, wrong) == {"equations.x", "equations.y"}


def test_a_rate_that_is_not_the_charge_s(pendulum):
    derivation, answers = pendulum
    charges = answers.sections["charges"].charges
    wrong = tuple(
        replace(charge, rate=Product((TWICE, charge.rate))) if charge.name == "rotation" else charge
        for charge in charges
    )
    assert broken_laws(derivation, with_section(answers, "charges", charges=wrong)) == {
        "charges.rotation"
    }


@pytest.mark.parametrize(
    ("error", "outcome"),
    [(ZeroDivisionError, CheckOutcome.BROKEN), (OutOfWork, CheckOutcome.UNDECIDED)],
)
def test_a_section_that_could_not_be_made_is_not_called_wrong(monkeypatch, error, outcome):
    def fails(_self):
        raise error

    monkeypatch.setattr(room, "SECTION", replace(room.SECTION, derive=fails))
    [finding] = check_problem("pendulum.yaml", PENDULUM).findings
    assert (finding.outcome, finding.subject) == (outcome, "charges")
