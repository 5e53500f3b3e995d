"""The answers against those that the file expects, as each section compares them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.verify import disjunction
from lagcli.problem_data import Expect
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import built_in, find_expected
from lagcli.studies.check.comparison import Comparison
from lagcli.studies.check.findings import CheckOutcome, Finding
from lagcli.studies.check.free import of_phase_space, of_reductions

#: What a comparison yields: nothing when it holds.
Found = Iterator[Finding | None]


class Expectations:
    """Every expectation of one problem compared with its answer.

    Yields a finding for each expectation that does not hold, None for each that does.
    """

    def __init__(self, derivation: Derivation, answers: Answers) -> None:
        self.derivation = derivation
        self.expect = derivation.given.expect
        self.answers = answers

    @cached_property
    def comparison(self) -> Comparison:
        """Comparisons on the constraints."""
        return Comparison(self.derivation)

    @cached_property
    def free(self) -> Comparison:
        """Comparisons of functions on phase space, old and new variables free."""
        return of_phase_space(self.derivation.given)

    @cached_property
    def reduced(self) -> Comparison:
        """Comparisons in which momenta and the constants of the answers are free."""
        return of_reductions(self.derivation.problem)

    def __iter__(self) -> Found:
        """The findings, section by section."""
        if not self.derivation.no_lagrangian:
            yield from self._degrees_of_freedom()
        for declared in sections_expected(self.expect):
            if declared.name in self.answers.sections:
                section = self.answers.sections[declared.name]
                for each in declared.expected:
                    if each.is_in(self.expect):
                        yield from each.compare(self, section, self.expect.of(each.key))

    def _degrees_of_freedom(self) -> Found:
        expected, found = self.expect.degrees_of_freedom, self.answers.degrees_of_freedom
        if expected is not None:
            path = ["degrees_of_freedom"]
            yield self.judge(path, expected == found, str(expected), str(found))

    # -- one comparison --------------------------------------------------------------------

    def _finding(self, outcome: CheckOutcome, path: Sequence[str], message: str) -> Finding:
        return Finding(outcome, ".".join(path), message, self.expect.span(path))

    def undecided(self, path: Sequence[str], message: str) -> Finding:
        """Nobody knows whether it is right."""
        return self._finding(CheckOutcome.UNDECIDED, path, message)

    def wrong(self, path: Sequence[str], message: str) -> Finding:
        """It is wrong."""
        return self._finding(CheckOutcome.WRONG, path, message)

    def judge(
        self, path: Sequence[str], verdict: bool | None, expected: str, found: str
    ) -> Finding | None:
        """The finding of a verdict."""
        if verdict is True:
            return None
        if verdict is None:
            return self.undecided(
                path, f"nobody could decide whether {found} is the expected {expected}"
            )
        return self.wrong(path, f"expected {expected}, derived {found}")

    def judge_any(
        self, path: Sequence[str], verdicts: Sequence[bool | None], expected: str, found: str
    ) -> Finding | None:
        """The finding of several verdicts of which one is enough."""
        return self.judge(path, disjunction(verdicts), expected, found)

    def same(self, path: Sequence[str], found: object, expected: object) -> Finding | None:
        """The finding of two values that should be equal; None is one that was not found."""
        verdict = None if found is None else found == expected
        return self.judge(path, verdict, str(expected), str(found))

    def compare(
        self,
        path: Sequence[str],
        found: Expression | None,
        expected: Expression,
        comparison: Comparison | None = None,
    ) -> Finding | None:
        """The finding of two formulas that should be the same."""
        if found is None:
            return self.undecided(path, "no answer was found")
        verdict = (comparison or self.comparison).equal(found, expected)
        return self.judge(path, verdict, to_grammar(expected), to_grammar(found))

    def compare_each(
        self,
        path: Sequence[str],
        found: Mapping[str, Expression] | Mapping[str, Expression | None] | None,
        expected: Mapping[str, Expression],
    ) -> Found:
        """The findings of formulas by name."""
        for name, formula in expected.items():
            answer = None if found is None else found.get(name)
            yield self.compare([*path, name], answer, formula)

    def listed(self, formulas: Sequence[Expression]) -> str:
        """Formulas in a message."""
        return ", ".join(map(to_grammar, formulas)) or "none"


def sections_expected(expect: Expect) -> list[Declaration]:
    """The sections that have to be derived to compare with what is expected."""
    others = {declared.name: declared for declared, _ in map(find_expected, expect.others)}
    return [
        declared
        for declared in (*built_in(), *others.values())
        if any(each.is_in(expect) for each in declared.expected)
    ]
