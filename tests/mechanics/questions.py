"""Answers to the questions of a problem that is given as text."""

from __future__ import annotations

from sympy import Expr

from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.finding.find import answer_questions
from lagcli.reader import read_problem
from lagcli.statements.questions import Rewritten, Solutions

from .formulas import normal

POSITIVE = "{assume: positive}"


def answers(text: str) -> dict[str, Solutions | Rewritten]:
    text = text.replace("POSITIVE", POSITIVE)
    problem = read_problem("test.yaml", text.encode()).checked()
    derivation = Derivation(problem)
    return dict(answer_questions(derivation.dynamics, derivation.noether).answers)


def roots(text: str, name: str = "asked") -> list[Expr | None] | None:
    answer = answers(text)[name]
    assert isinstance(answer, Solutions)
    return None if answer.solutions is None else [normal(s) for s in answer.solutions]


def value(text: str, name: str = "asked") -> Expr | None:
    answer = answers(text)[name]
    assert isinstance(answer, Rewritten)
    return normal(answer.value)
