"""What is expected of the reduction against what was derived."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import cast

from lagcli.answers import Answers, ReductionSection
from lagcli.check.comparison import Comparison
from lagcli.expression import Expression, Name, Number, Power, Sum
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.problem import Parameter, Problem
from lagcli.reader.expected_reduction import AMPLITUDE_NAMES, ENERGY_NAMES

#: The path of an expectation, the verdict, what was expected and what was found.
Judged = tuple[list[str], bool | None, str, str]


class Reductions:
    """Comparisons in which momenta and the constants of the answers are free quantities."""

    def __init__(self, derivation: Derivation, answers: Answers) -> None:
        self.derivation = derivation
        self.answers = answers

    @cached_property
    def comparison(self) -> Comparison:
        """The comparisons of a system of the same names whose motion is free."""
        old = self.derivation.problem
        declared = {*(q.name for q in (*old.coordinates, *old.parameters)), *old.functions}
        extra = [f"p_{q.name}" for q in old.coordinates]
        extra += [n for n in (*ENERGY_NAMES, *AMPLITUDE_NAMES) if n not in declared]
        two = Number(Fraction(2))
        squares = [Power(Name(q.name, 1), two) for q in old.coordinates]
        free = Problem(
            source=old.source,
            title=old.title,
            coordinates=old.coordinates,
            parameters=(*old.parameters, *(Parameter(name=n) for n in extra)),
            functions=old.functions,
            definitions=old.definitions,
            lagrangian=squares[0] if len(squares) == 1 else Sum(tuple(squares)),
        )
        return Comparison(Derivation(free))

    def findings(self) -> Iterator[Judged]:
        """Every expectation of these sections with its verdict."""
        yield from self._reduction()

    def _reduction(self) -> Iterator[Judged]:
        expect = self.derivation.problem.expect.reduction
        if expect is None:
            return
        section = cast(ReductionSection, self.answers.sections["reduction"])
        motion = section.one_freedom
        pairs: list[tuple[str, Expression | None, Expression | None]] = [
            ("routhian", section.routhian, expect.routhian),
            ("effective_potential", section.effective_potential, expect.effective_potential),
        ]
        for name, formula in expect.reconstruction.items():
            pairs.append(("reconstruction", section.reconstruction.get(name), formula))
        for name, found, expected in pairs:
            if expected is not None:
                verdict = None if found is None else self.comparison.equal(found, expected)
                yield ["reduction", name], verdict, to_grammar(expected), _shown(found)
        if expect.turning_points is not None:
            roots = None if motion is None else motion.turning_points
            verdict = (
                None if roots is None else self.comparison.same_set(roots, expect.turning_points)
            )
            path = ["reduction", "turning_points"]
            yield path, verdict, _listed(expect.turning_points), _listed(roots)
        if expect.period is not None:
            periods = [] if motion is None else [each.period for each in motion.periods]
            verdicts = [self.comparison.equal(each, expect.period) for each in periods]
            verdict = True if True in verdicts else None if None in verdicts else False
            yield ["reduction", "period"], verdict, to_grammar(expect.period), _listed(periods)


def _shown(found: Expression | None) -> str:
    return "nothing" if found is None else to_grammar(found)


def _listed(found: Sequence[Expression] | None) -> str:
    return ", ".join(map(to_grammar, found or ())) or "nothing"
