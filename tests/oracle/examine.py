"""The examination of one answer sheet: every printed claim against the reference.

`examine` gives a list of findings; none means that every claim held at every state.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from mpmath import mp, mpf

from lagcli.diagnostics import ProblemError
from lagcli.expression import Expression
from lagcli.problem_data import Problem
from lagcli.reader import parse_text

from .evaluate import Moment, OutsideDomain, evaluate
from .jets import Number, real_part
from .reference import Reference
from .states import State, random_states, reals

Kind = Literal["wrong", "missing"]
Sheet = Mapping[str, Any]

#: Digits of the arithmetic, and those to which two values must agree.
DIGITS = 40
AGREEMENT = mpf(10) ** -14


@dataclass(frozen=True)
class Finding:
    """One claim that does not hold (`wrong`), or an answer that is not there (`missing`)."""

    kind: Kind
    where: str
    message: str

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.message}"


@dataclass
class Examination:
    """What the checks share: the reference, the states, the sheet, and the findings."""

    problem: Problem
    sheet: Sheet
    reference: Reference
    states: list[State]
    findings: list[Finding] = field(default_factory=list)

    def wrong(self, where: str, message: str) -> None:
        """A claim that does not hold."""
        self._note("wrong", where, message)

    def missing(self, where: str, message: str = "null, though it exists") -> None:
        """An answer that is not there."""
        self._note("missing", where, message)

    def _note(self, kind: Kind, where: str, message: str) -> None:
        if not any(f.where == where for f in self.findings):
            self.findings.append(Finding(kind, where, message))

    def read(self, where: str, text: object) -> Expression | None:
        """The expression that a string of the sheet writes."""
        if not isinstance(text, str):
            self.wrong(where, f"{text!r} is no string")
            return None
        try:
            return parse_text(text)
        except ProblemError as error:
            self.wrong(where, f"cannot be read back: {text!r}: {error.diagnostics[0].message}")
            return None

    def number(self, where: str, node: Expression, moment: Moment) -> mpf | None:
        """The value of a printed expression; a finding where it has none."""
        try:
            return real_part(evaluate(node, self.reference.setting, moment))
        except OutsideDomain as error:
            self.wrong(where, f"not real at an allowed state: {error}")
        except KeyError as error:
            self.wrong(where, f"uses {error}, which is not declared")
        except ZeroDivisionError:
            self.wrong(where, "divides by zero at an allowed state")
        return None

    def compare(
        self,
        where: str,
        text: object,
        truth: Callable[[State], Number],
        moment: Callable[[State], Moment] = lambda state: state.moment,
    ) -> bool:
        """Whether the printed expression has the true value at every state."""
        node = self.read(where, text)
        if node is None:
            return False
        for state in self.states:
            value = self.number(where, node, moment(state))
            if value is None:
                return False
            true = real_part(truth(state))
            if not agree(value, true):
                self.wrong(where, f"{text} is {mp.nstr(value, 8)}, true is {mp.nstr(true, 8)}")
                return False
        return True


def agree(a: mpf, b: mpf, near: mpf = AGREEMENT) -> bool:
    """Whether two numbers are equal, but for rounding."""
    return bool(abs(a - b) <= near * (1 + abs(a) + abs(b)))


def vanishes(values: Sequence[mpf]) -> bool:
    """Whether all numbers are 0, but for rounding."""
    return all(agree(value, mpf(0)) for value in values)


def with_momenta(reference: Reference, state: State) -> Moment:
    """The moment in which p_x is dL/dx', and the multipliers have their values."""
    momenta = reals(reference.momenta(state.moment))
    named = {f"p_{name}": p for name, p in zip(reference.names, momenta, strict=True)}
    return named_multipliers(
        reference, replace(state.moment, extra=state.moment.extra | named), state.multipliers
    )


def named_multipliers(reference: Reference, moment: Moment, values: Sequence[mpf]) -> Moment:
    """The moment in which the multipliers' names have these values."""
    names = [c.multiplier for c in reference.problem.constraints]
    return replace(moment, extra={**moment.extra, **dict(zip(names, values, strict=True))})


def examine(problem: Problem, sheet: Sheet, count: int = 3, seed: int = 1) -> list[Finding]:
    """Check every claim of a sheet (the JSON of `lagcli solve`) at random states."""
    from . import dynamics_checks, find_checks, legendre_checks, noether_checks, phase_checks

    with mp.workdps(DIGITS):
        reference = Reference(problem)
        if problem.hamiltonian is not None and phase_checks.is_singular(reference):
            examination = Examination(problem, sheet, reference, [])
            phase_checks.check_without_lagrangian(examination)
            return examination.findings
        states = random_states(reference, count, seed)
        examination = Examination(problem, sheet, reference, states)
        for module in (dynamics_checks, legendre_checks, noether_checks, find_checks):
            module.check(examination)
        if problem.hamiltonian is not None and "hamiltonian" in sheet:
            phase_checks.check(examination)
        return examination.findings
