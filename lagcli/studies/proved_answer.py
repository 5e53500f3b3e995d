"""`always` and `reaches` for the values of the file, decided by an enclosure of the motion."""

from __future__ import annotations

from lagcli.diagnostics import ProblemError
from lagcli.expression import Name
from lagcli.mechanics.explaining.words import difference
from lagcli.numerics.equations.parameter_formulas import numbers_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.rigorous import prove
from lagcli.numerics.rigorous.result import Proof
from lagcli.numerics.rigorous.writing import proved_digits
from lagcli.problem_data import Lasting, Problem, Reaching
from lagcli.reader.columns import Column
from lagcli.record import replace
from lagcli.statements.questions import Proved

#: Some ten seconds.
_WORK = 3e4
_ACCURACY = 1e-9


def proved_answer(problem: Problem, question: Lasting | Reaching) -> Proved | str:
    """What is proved over the span of the file, or why nothing is; "" where it asks for none."""
    end = problem.simulation.until
    if end is None or any(p.value is None for p in problem.parameters) or not problem.initial:
        return ""
    if isinstance(question, Lasting):
        margin = difference(*question.condition.larger_first)
        # the condition in question does not end the motion
        kept = [
            replace(c, holds_while=None) if c.holds_while == question.condition else c
            for c in problem.constraints
        ]
        problem = replace(problem, constraints=tuple(kept))
    else:
        margin = difference(question.coordinate, question.value)
    try:
        [(until,)] = numbers_of(problem, [end])
        request = RunRequest(
            until=until,
            end=end,
            accuracy=_ACCURACY,
            samples=2,
            columns=(Column("t", Name("t")), Column("margin", margin)),
            stop_when=margin,
            stop_name=question.name,
        )
        return _told(
            prove(problem, request, work=_WORK), until, lasts=isinstance(question, Lasting)
        )
    except (Refusal, ProblemError) as reason:
        return str(reason)


def _told(proof: Proof, until: float, *, lasts: bool) -> Proved | str:
    """The answer by the first crossing of 0, or by its absence."""
    begins = proof.rows[0][1] if proof.rows else None
    if begins is None or begins.contains(0):
        return proof.refusal or "it is not decided at the beginning"
    if lasts and begins < 0:
        return _proved("it does not hold at the beginning", until, holds=False)
    last = proof.events[-1] if proof.events else None
    if last is not None and last.what == "stopped":
        at = proved_digits(last.t)
        claim = (
            f"it holds until t = {at} and fails there" if lasts else f"it is reached at t = {at}"
        )
        return _proved(claim, until, holds=not lasts, at=at)
    if not proof.reached:
        return proof.refusal
    claim = "holds" if lasts else "is not reached"
    return _proved(f"it {claim} until t = {proof.holds_until:g}", proof.holds_until, holds=lasts)


def _proved(claim: str, until: float, *, holds: bool, at: str = "") -> Proved:
    sentence = f"For the values of the file {claim}: proved by an enclosure of the motion."
    return Proved(holds=holds, until=until, at=at, sentence=sentence)
