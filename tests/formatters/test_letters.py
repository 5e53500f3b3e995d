"""A letter of ours that the file uses for itself gets an index, in every format."""

from __future__ import annotations

import json

import pytest

from lagcli.formatters import Options
from lagcli.pipeline import Request, derive, explain, read, render, state

LETTERS = "L R omega T E H a S W U V M".split()
SECTIONS = (
    "lagrangian", "energy", "hamiltonian", "charges", "equilibria", "modes", "reduction",
    "steady_motions", "hamilton_jacobi",
)  # fmt: skip


def clashing(letter):
    """An oscillator and a free coordinate, one of whose parameters has the letter."""
    text = (
        f"title: t\ncoordinates: [x, y]\nparameters: {{m: {{assume: positive}}, "
        f"{letter}: {{assume: positive}}}}\nT: m*(x'^2 + y'^2)/2\nV: {letter}*x^2/2\n"
    )
    return read("t.yaml", text.encode()).problem


@pytest.mark.long
@pytest.mark.parametrize("letter", LETTERS)
def test_no_left_side_is_a_letter_of_the_file(letter):
    answers = state(derive(clashing(letter)), Request(sections=SECTIONS))
    text = render([answers], "text", Options(width=80, unicode=False))
    left = {line.split("=")[0].strip() for line in text.splitlines() if " = " in line}
    assert not {letter, f"{letter}^2", f"{letter}'"} & left


@pytest.mark.long
@pytest.mark.parametrize("letter", ["L", "T", "H", "V"])
def test_sentences_have_words_for_letters_of_the_file(letter):
    problem = clashing(letter)
    answers = state(derive(problem), Request(sections=SECTIONS))
    reason = json.loads(render([answers], "json", Options()))["energy"]["reason"]
    assert letter not in reason.replace(".", " ").replace(";", " ").split()


def test_a_length_called_L_does_not_name_the_lagrangian_in_an_explanation():
    told = explain(derive(clashing("L")))
    assert "&" not in repr(told.steps)


def test_letters_that_are_free_stay():
    answers = state(derive(clashing("k")), Request(sections=SECTIONS))
    text = render([answers], "text", Options(width=80, unicode=False))
    for left in ("L =", "h =", "H =", "omega ="):
        assert f"  {left}" in text.replace("omega     =", "omega =")
