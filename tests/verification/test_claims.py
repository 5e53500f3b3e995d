"""Each formula that is printed, made wrong: it is not printed, and a warning says so."""

from __future__ import annotations

import json

import pytest

from lagcli.formatters.json import to_object
from lagcli.formatters.options import Options
from lagcli.pipeline import render
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
