"""A letter of ours that the file uses for itself gets an index, in every format."""

from __future__ import annotations

import json
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest
import yaml

from lagcli.document import Label
from lagcli.expression import Expression, Name, walk
from lagcli.formatters import Options
from lagcli.formatters.explaining import to_document as told_document
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.page import to_document
from lagcli.notation.naming import Names, free
from lagcli.pipeline import Request, derive, explain, read, render, state
from lagcli.statements.registry import explained_in_order

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


@pytest.mark.long
def test_letters_that_are_free_stay():
    answers = state(derive(clashing("k")), Request(sections=SECTIONS))
    text = render([answers], "text", Options(width=80, unicode=False))
    for left in ("L =", "h =", "H =", "omega ="):
        assert f"  {left}" in text.replace("omega     =", "omega =")


def every_part(value):
    """The parts of a document, and those of its formulas."""
    yield value
    if isinstance(value, Expression):
        yield from list(walk(value))[1:]
    elif isinstance(value, (tuple, list)):
        yield from (part for each in value for part in every_part(each))
    elif is_dataclass(value):
        yield from (p for f in fields(value) for p in every_part(getattr(value, f.name)))


def letters_of_ours(document, declared):
    """The letters that a page has and its file does not declare, as LaTeX."""
    setting = LatexNames(document.coordinates, document.symbols)
    for part in every_part([b for b in document.blocks if "mean" not in repr(b)]):
        if isinstance(part, Label):
            if not (part.unit or part.change or part.matrix or part.letter in declared):
                yield setting.label(part)[0]
        elif isinstance(part, Name) and part.name not in declared:
            yield setting.name(part.name)


SPOKEN = "model", "dimensions"  # they list the parameters themselves


def letters_beside(path, further):
    """The letters of ours on the pages of a problem of the library with further parameters."""
    data = yaml.safe_load(path.read_text("utf-8"))
    data = {k: v for k, v in data.items() if k not in ("expect", "simulation", "picture")}
    data["parameters"] = {**(data.get("parameters") or {}), **further}
    problem = read("t.yaml", yaml.safe_dump(data, sort_keys=False).encode()).problem
    declared = {"t", "pi", *problem.definitions, *problem.functions, *further}
    for quantity in (*problem.coordinates, *problem.parameters):
        declared |= {quantity.name, f"p_{quantity.name}"}
    declared |= {c.multiplier for c in problem.constraints} | {s.name for s in problem.symmetries}
    answers = state(derive(problem), Request(sections=SECTIONS, abbreviate=True))
    sections = [s.name for s in explained_in_order() if s.name not in (*SPOKEN, "find")]
    told = explain(derive(problem), sections)
    pages = to_document(answers), told_document(told)
    return {letter for page in pages for letter in letters_of_ours(page, declared)}


@pytest.mark.long
@pytest.mark.parametrize(
    "path", ["hoop", "central/kepler", "pendulums/double-pendulum", "rolling/chaplygin-sled"]
)
def test_no_letter_of_ours_is_typeset_as_one_of_the_file(path):
    path = Path(__file__).parents[2] / "problems" / f"{path}.yaml"
    ours = {letter for letter in letters_beside(path, {}) if "dot" not in letter}
    assert len(ours) > 10
    symbols = {f"zz_{chr(97 + n)}": {"symbol": s} for n, s in enumerate(sorted(ours))}
    assert sorted(ours & letters_beside(path, symbols)) == []


@pytest.mark.parametrize(
    ("given", "ours"),
    [("ω", "omega"), (r"\omega", "omega"), ("alpha1", "alpha_1"), (r"U_{\mathrm{eff}}", "U_eff"),
     ("s_12", "s12"), (r"{L}", "L"), (r"a_{\theta_{1}}", "a_theta1")],
)  # fmt: skip
def test_names_that_are_typeset_alike_are_one(given, ours):
    assert ours in Names([given])
    assert "other" not in Names([given])
    assert free(Names([given]), ours, "h") == "h"
    assert free(Names([given]), ours) == f"{ours}_sys"
