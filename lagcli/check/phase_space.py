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
from lagcli.phase_space import (
    BracketsSection,
    TransformationsSection,
)
from lagcli.problem import Parameter, Problem
from lagcli.values import substituted

#: The sections that need no Lagrangian.
PHASE_SPACE = ("hamiltonian", "canonical_equations", "brackets", "canonical")


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
        old = [q.name for q in problem.coordinates]
        taken = {*old, *(p.name for p in problem.parameters), *problem.functions}
        names = dict.fromkeys(f"p_{name}" for name in old)
        for each in problem.canonical_transformations:
            for name in each.coordinates:
                names.update({name: None, f"p_{name}": None})
        free = [name for name in names if name not in taken]
        self.observables = problem.observables
        self.comparison = free_comparison(problem, free)

    def __iter__(self) -> Iterator[Finding | None]:
        """The findings."""
        if self.expect.hamiltonian is not None:
            section = cast(HamiltonianSection, self.answers.sections["hamiltonian"])
            yield self._compare(("hamiltonian",), section.hamiltonian, self.expect.hamiltonian)
        yield from self.of_brackets()
        yield from self.of_transformations()

    def of_brackets(self) -> Iterator[Finding | None]:
        """The values of the brackets."""
        if not self.expect.brackets:
            return
        section = cast(BracketsSection, self.answers.sections["brackets"])
        found = {each.name: each.value for each in section.brackets}
        known: dict[str, Expression] = {}
        for name, formula in self.observables.items():
            known[name] = substituted(formula, known)
        for name, expected in self.expect.brackets.items():
            yield self._compare(("brackets", name), found[name], substituted(expected, known))

    def of_transformations(self) -> Iterator[Finding | None]:
        """What kind each is, its valence, its generating function, its new Hamiltonian."""
        if not self.expect.canonical:
            return
        section = cast(TransformationsSection, self.answers.sections["canonical"])
        found = {each.name: each for each in section.transformations}
        for name, expected in self.expect.canonical.items():
            each, path = found[name], ("canonical", name)
            if expected.kind is not None:
                yield self._same((*path, "kind"), each.kind, expected.kind)
            if expected.generates is not None:
                generates = None if each.generator is None else each.generator.generates
                yield self._same((*path, "generates"), generates, expected.generates)
            if expected.valence is not None:
                yield self._compare((*path, "valence"), each.valence, expected.valence)
            if expected.hamiltonian is not None:
                yield self._compare((*path, "hamiltonian"), each.hamiltonian, expected.hamiltonian)

    def _same(self, path: tuple[str, ...], found: object, expected: object) -> Finding | None:
        if found == expected:
            return None
        outcome = Outcome.UNDECIDED if found is None else Outcome.WRONG
        span = self.expect.spans.get(path, NOWHERE)
        return Finding(outcome, ".".join(path), f"expected {expected}, derived {found}", span)

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
