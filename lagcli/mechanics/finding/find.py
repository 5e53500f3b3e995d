"""Answers to the questions of a file: `where ... for ...` and `value ... in_terms_of ...`."""

from __future__ import annotations

from sympy import Symbol

from lagcli.algebra.effort import Work
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.finding.along_the_motion import UNITS, AlongTheMotion
from lagcli.mechanics.finding.lasting import LastingAnswer
from lagcli.mechanics.finding.passing import Passing
from lagcli.mechanics.finding.where import Where
from lagcli.mechanics.noether import Noether
from lagcli.problem import Lasting, Reaching, Rewrite
from lagcli.questions import Answer, FindSection, Rewritten


def answer_questions(dynamics: Dynamics, noether: Noether) -> FindSection:
    """The answers to all questions of the file, by name.

    Raises
    ------
    ProblemError
        When no state with the given initial values satisfies the constraints.
    """
    along = AlongTheMotion(dynamics, noether)
    known: dict[Symbol, Passing] = {}
    answers: dict[str, Answer] = {}
    for question in dynamics.system.problem.find:
        along.work = Work(UNITS)
        if isinstance(question, Rewrite):
            answers[question.name] = _rewritten(along, question)
        elif isinstance(question, Lasting | Reaching):
            answers[question.name] = LastingAnswer(along, question, known).answer()
        else:
            answers[question.name] = Where(along, question, known).solutions()
    return FindSection(answers=answers)


def _rewritten(along: AlongTheMotion, question: Rewrite) -> Rewritten:
    system = along.system
    subject = system.build(question.value)
    keep = [system.symbol_of(str(name)) for name in question.in_terms_of]
    value = along.rewritten(subject, keep, with_time=True)
    return Rewritten(
        value=None if value is None else along.tree(value),
        subject=along.tree(subject),
        note=along.why_not if value is None else "; ".join(along.notes),
    )
