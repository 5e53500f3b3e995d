"""Each formula that is printed, made wrong: it is not printed, and a warning says so."""

from __future__ import annotations

import json

import pytest

from lagcli.formatters.json import to_object
from lagcli.formatters.options import Options
from lagcli.motions import Verdict
from lagcli.pipeline import render
from lagcli.record import replace
from lagcli.verification import verified

from .sheets import derived, each_spoiled

SECTIONS = {
    "hoop": (
        "lagrangian",
        "equations",
        "accelerations",
        "multipliers",
        "constraint_forces",
        "momenta",
        "energy",
        "charges",
    ),
    "pendulums/double-pendulum": ("accelerations", "hamiltonian", "canonical_equations"),
    "pendulums/pendulum-cartesian": ("matrix_form", "multipliers", "constraint_forces", "forces"),
    "central/kepler": ("charges", "energy", "momenta"),
    "nonholonomic/chaplygin-sleigh": ("equations", "accelerations", "constraint_forces"),
    "central/two-bodies": ("accelerations", "charges"),
    "oscillations/damped-oscillator": ("equations", "charges", "energy"),
}


@pytest.mark.parametrize("name", SECTIONS)
def test_every_formula_is_examined(name: str) -> None:
    problem, answers = derived(name, SECTIONS[name])
    assert verified(problem, answers) is answers
    for section in answers.sections:
        for place, wrong in each_spoiled(answers, section):
            found = verified(problem, wrong)
            where = f"{section}, formula {place}"
            assert found.sections[section] != wrong.sections[section], where
            assert not found.complete, where
            assert found.warnings[len(answers.warnings) :], where
            for format_name in ("json", "text", "latex"):
                assert render([found], format_name, Options())
            json.dumps(to_object(found))


PLACES = {
    "chains/coupled-pendulums": ("equilibria", "modes"),
    "classics/spherical-pendulum": ("steady_motions",),
}


@pytest.mark.parametrize("name", PLACES)
def test_places_frequencies_and_shapes_are_examined(name: str) -> None:
    problem, answers = derived(name, PLACES[name])
    assert verified(problem, answers) is answers
    for section in answers.sections:
        noticed = [
            not verified(problem, each).complete for _, each in each_spoiled(answers, section)
        ]
        assert sum(noticed) >= 0.3 * len(noticed), section


@pytest.mark.parametrize("name", ["chains/coupled-pendulums", "classics/spherical-pendulum"])
def test_a_verdict_of_stability_turned_round_is_withheld(name: str) -> None:
    problem, answers = derived(name, ("equilibria", "steady_motions"))
    for section in ("equilibria", "steady_motions"):
        listed = getattr(answers.sections[section], "equilibria", None) or getattr(
            answers.sections[section], "motions", ()
        )
        for each in listed:
            singular = getattr(each, "rates", each) is None or getattr(each, "indeterminate", ())
            if each.verdict.stable is None or singular:
                continue
            other = replace(each, verdict=Verdict(stable=not each.verdict.stable))
            key = "equilibria" if section == "equilibria" else "motions"
            wrong = replace(answers.sections[section], **{key: (other,)})
            found = verified(problem, replace(answers, sections={section: wrong}))
            [left] = getattr(found.sections[section], key)
            assert left.verdict.stable is None
            assert not found.complete
