"""What is expected of functions on phase space against what was derived.

Coordinates, momenta and t are free here: two functions agree when they agree everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import cast

from lagcli.answers import Answers, HamiltonianSection
from lagcli.check.comparison import Comparison
from lagcli.check.findings import Finding, Outcome
from lagcli.diagnostics import NOWHERE
from lagcli.expression import Expression, Name, Number, Power, Sum
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.problem import Parameter, Problem

#: The sections that need no Lagrangian.
PHASE_SPACE = ("hamiltonian",)


def free_comparison(problem: Problem, names: Iterable[str]) -> Comparison:
    """The comparisons of a system of the same names, and more, whose motion is free."""
    two = Number(Fraction(2))
    squares = [Power(Name(q.name, 1), two) for q in problem.coordinates]
    return Comparison(
        Derivation(
            Problem(
                source=problem.source,
                title=problem.title,
                coordinates=problem.coordinates,
                parameters=(*problem.parameters, *(Parameter(name=n) for n in names)),
                functions=problem.functions,
                definitions=problem.definitions,
                lagrangian=squares[0] if len(squares) == 1 else Sum(tuple(squares)),
            )
        )
    )


class PhaseSpace:
    """The expectations of the sections of phase space.

    Yields a finding for each expectation that does not hold, None for each that does.
    """

    def __init__(self, derivation: Derivation, answers: Answers) -> None:
        problem = derivation.given
        self.expect = problem.expect
        self.answers = answers
        momenta = [f"p_{q.name}" for q in problem.coordinates]
        self.comparison = free_comparison(problem, momenta)

    def __iter__(self) -> Iterator[Finding | None]:
        """The findings."""
        if self.expect.hamiltonian is not None:
            section = cast(HamiltonianSection, self.answers.sections["hamiltonian"])
            yield self._compare(("hamiltonian",), section.hamiltonian, self.expect.hamiltonian)

    def _compare(
        self, path: tuple[str, ...], found: Expression | None, expected: Expression
    ) -> Finding | None:
        span = self.expect.spans.get(path, NOWHERE)
        if found is None:
            return Finding(Outcome.UNDECIDED, ".".join(path), "no answer was found", span)
        verdict = self.comparison.equal(found, expected)
        if verdict is True:
            return None
        message = f"expected {to_grammar(expected)}, derived {to_grammar(found)}"
        outcome = Outcome.WRONG if verdict is False else Outcome.UNDECIDED
        return Finding(outcome, ".".join(path), message, span)
