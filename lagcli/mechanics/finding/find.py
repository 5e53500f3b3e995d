"""Answers to the questions of a file: `where ... for ...` and `value ... in_terms_of ...`."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Symbol, sqrt

from lagcli.algebra import simplify
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.finding.along_the_motion import UNITS, AlongTheMotion
from lagcli.mechanics.finding.passings import Passings
from lagcli.mechanics.noether import Noether
from lagcli.platform.effort import Work
from lagcli.problem_data import Lasting, Reaching, Rewrite
from lagcli.statements.questions import Answer, FindSection, Rewritten


def answer_questions(dynamics: Dynamics, noether: Noether) -> FindSection:
    """The answers to all questions of the file, by name.

    Raises
    ------
    ProblemError
        When no state with the given initial values satisfies the constraints.
    """
    along = AlongTheMotion(dynamics, noether)
    passings = Passings(along)
    answers: dict[str, Answer] = {}
    for question in dynamics.system.problem.find:
        along.work = Work(UNITS)
        if isinstance(question, Rewrite):
            answers[question.name] = _rewritten(along, question)
        elif isinstance(question, Lasting | Reaching):
            from lagcli.mechanics.finding.lasting import LastingAnswer

            answers[question.name] = LastingAnswer(passings, question).answer()
        else:
            from lagcli.mechanics.finding.where import WhereSearch

            answers[question.name] = WhereSearch(passings, question).solutions()
    return FindSection(answers=answers)


def _rewritten(along: AlongTheMotion, question: Rewrite) -> Rewritten:
    system = along.system
    subject = system.build(question.value)
    keep = [system.symbol_of(str(name)) for name in question.in_terms_of]
    value = along.rewritten(subject, keep)
    if value is None:
        return _up_to_sign(along, subject, keep)
    tree, shown = along.tree(value), along.tree(subject)
    return Rewritten(value=tree, subject=shown, note="; ".join(along.notes))


def _up_to_sign(along: AlongTheMotion, subject: Expr, keep: Sequence[Symbol]) -> Rewritten:
    """Both roots of its square, where that is determined; not found otherwise."""
    why_not, shown = along.why_not, along.tree(subject)
    square = along.rewritten(subject**2, keep)
    if square is None:
        return Rewritten(value=None, subject=shown, note=why_not)
    root = simplify(sqrt(square))
    note = "; ".join(["determined up to its sign", *along.notes])
    return Rewritten(
        value=None, values=(along.tree(root), along.tree(-root)), subject=shown, note=note
    )
