"""The answers against those that the file expects, one file section after another."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain
from typing import cast

from lagcli.answers import (
    AccelerationsSection,
    Answers,
    Charge,
    ChargesSection,
    ConstraintForcesSection,
    EnergySection,
    HamiltonianSection,
    Mode,
    ModesSection,
    MomentaSection,
    MultipliersSection,
)
from lagcli.check.algebra import expected_algebra
from lagcli.check.comparison import Comparison
from lagcli.check.findings import Finding, Outcome
from lagcli.check.following import follows
from lagcli.check.phase_space import PhaseSpace
from lagcli.check.ranges import in_words, same_ranges
from lagcli.check.real_forces import expected_forces
from lagcli.check.reductions import Reductions
from lagcli.diagnostics import NOWHERE, Span
from lagcli.expression import Expression
from lagcli.formatters.grammar import equation_to_grammar, to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.problem import NOT_CONSERVED, Expect, Inequality
from lagcli.questions import FindSection, Ranges, Rewritten, Solutions

#: What a comparison yields: nothing when it holds.
Found = Iterator[Finding | None]


class Expectations:
    """Every expectation of one problem compared with its answer.

    Yields a finding for each expectation that does not hold, None for each that does.
    """

    def __init__(self, derivation: Derivation, answers: Answers, comparison: Comparison) -> None:
        self.derivation = derivation
        self.expect = derivation.problem.expect
        self.answers = answers
        self.comparison = comparison

    def __iter__(self) -> Found:
        """The findings in the order of `Expect`."""
        yield from self._degrees_of_freedom()
        yield from self._equations()
        yield from self._accelerations()
        yield from self._multipliers()
        yield from self._constraint_forces()
        for path, found, expected in expected_forces(self.expect, self.answers):
            yield self._compare(path, found, expected)
        yield from self._momenta()
        yield from self._hamiltonian()
        yield from self._energy()
        yield from self._charges()
        yield from self._discovered()
        yield from self._modes()
        yield from self._find()
        phase_space = PhaseSpace(self.derivation, self.answers)
        yield from phase_space.of_brackets()
        yield from phase_space.of_transformations()
        judged = expected_algebra(self.expect, self.answers, self.comparison)
        for path, verdict, wanted, shown in chain(
            judged, Reductions(self.derivation, self.answers).findings()
        ):
            yield self._judge(path, verdict, wanted, shown)

    # -- one comparison --------------------------------------------------------------------

    def _span(self, path: Sequence[str]) -> Span:
        """The place of an expectation, or of the nearest thing around it."""
        for length in range(len(path), 0, -1):
            span = self.expect.spans.get(tuple(path[:length]))
            if span is not None:
                return span
        return NOWHERE

    def _finding(self, outcome: Outcome, path: Sequence[str], message: str) -> Finding:
        return Finding(outcome, ".".join(path), message, self._span(path))

    def _judge(
        self, path: Sequence[str], verdict: bool | None, expected: str, found: str
    ) -> Finding | None:
        if verdict is True:
            return None
        if verdict is None:
            message = f"nobody could decide whether {found} is the expected {expected}"
            return self._finding(Outcome.UNDECIDED, path, message)
        return self._finding(Outcome.WRONG, path, f"expected {expected}, derived {found}")

    def _compare(
        self, path: Sequence[str], found: Expression | None, expected: Expression
    ) -> Finding | None:
        if found is None:
            return self._finding(Outcome.UNDECIDED, path, "no answer was found")
        verdict = self.comparison.equal(found, expected)
        return self._judge(path, verdict, to_grammar(expected), to_grammar(found))

    def _compare_each(
        self,
        path: Sequence[str],
        found: Mapping[str, Expression] | Mapping[str, Expression | None] | None,
        expected: Mapping[str, Expression],
    ) -> Found:
        for name, formula in expected.items():
            answer = None if found is None else found.get(name)
            yield self._compare([*path, name], answer, formula)

    # -- the sections ------------------------------------------------------------------------

    def _degrees_of_freedom(self) -> Found:
        expected, found = self.expect.degrees_of_freedom, self.answers.degrees_of_freedom
        if expected is not None:
            path = ["degrees_of_freedom"]
            yield self._judge(path, expected == found, str(expected), str(found))

    def _equations(self) -> Found:
        for place, equation in enumerate(self.expect.equations):
            path = ["equations", str(place)]
            verdict = follows(self.derivation, equation, self.comparison)
            if verdict is True:
                yield None
                continue
            text = equation_to_grammar(equation)
            if verdict is None:
                message = f"nobody could decide whether {text} follows from the derived equations"
                yield self._finding(Outcome.UNDECIDED, path, message)
            else:
                message = f"{text} does not follow from the derived equations"
                yield self._finding(Outcome.WRONG, path, message)

    def _accelerations(self) -> Found:
        if self.expect.accelerations:
            section = cast(AccelerationsSection, self.answers.sections["accelerations"])
            found, expected = section.accelerations, self.expect.accelerations
            yield from self._compare_each(["accelerations"], found, expected)

    def _multipliers(self) -> Found:
        if self.expect.multipliers:
            section = cast(MultipliersSection, self.answers.sections["multipliers"])
            found = {name: each.value for name, each in section.multipliers.items()}
            yield from self._compare_each(["multipliers"], found, self.expect.multipliers)

    def _constraint_forces(self) -> Found:
        if self.expect.constraint_forces:
            section = cast(ConstraintForcesSection, self.answers.sections["constraint_forces"])
            for name, expected in self.expect.constraint_forces.items():
                found = section.forces.get(name)
                yield from self._compare_each(["constraint_forces", name], found, expected)

    def _momenta(self) -> Found:
        if self.expect.momenta:
            section = cast(MomentaSection, self.answers.sections["momenta"])
            yield from self._compare_each(["momenta"], section.momenta, self.expect.momenta)

    def _hamiltonian(self) -> Found:
        """H(q, p) = expected, both with p = dL/dq' put in."""
        expected = self.expect.hamiltonian
        if expected is None:
            return
        found = cast(HamiltonianSection, self.answers.sections["hamiltonian"]).hamiltonian
        if found is None:
            yield self._finding(Outcome.UNDECIDED, ["hamiltonian"], "no Hamiltonian was found")
            return
        system = self.derivation.system
        momenta = dict(zip(system.momenta, self.derivation.dynamics.lagrange.momenta, strict=True))
        difference = system.build(found) - system.build(expected)
        verdict = self.comparison.vanishes(difference.xreplace(momenta))
        yield self._judge(["hamiltonian"], verdict, to_grammar(expected), to_grammar(found))

    def _energy(self) -> Found:
        if self.expect.energy is not None:
            section = cast(EnergySection, self.answers.sections["energy"])
            yield self._compare(["energy"], section.function, self.expect.energy)

    def _charges(self) -> Found:
        if not self.expect.charges:
            return
        section = cast(ChargesSection, self.answers.sections["charges"])
        charges = {charge.name: charge for charge in section.charges}
        for name, expected in self.expect.charges.items():
            path = ["charges", name]
            if isinstance(expected, str):
                yield self._not_conserved(path, charges.get(name))
            else:
                yield self._conserved(path, charges, name, expected)

    def _discovered(self) -> Found:
        """Each charge is that of some discovered symmetry; names are compared where there are."""
        if not self.expect.discovered:
            return
        section = cast(ChargesSection, self.answers.sections["discovered"])
        charges = {charge.name: charge for charge in section.charges}
        for name, expected in self.expect.discovered.items():
            path = ["discovered", name]
            if isinstance(expected, str):
                yield self._not_conserved(path, charges.get(name))
            else:
                yield self._conserved(path, charges, name, expected)

    def _not_conserved(self, path: Sequence[str], charge: Charge | None) -> Finding | None:
        """A momentum that is not listed belongs to a coordinate that is not cyclic."""
        verdict = None if charge is None else charge.conserved
        if charge is None and path[-1].startswith("p_"):
            verdict = self._momentum_conserved(path[-1].removeprefix("p_"))
        negated = None if verdict is None else not verdict
        return self._judge(path, negated, f"'{NOT_CONSERVED}'", "a conserved charge")

    def _momentum_conserved(self, coordinate: str) -> bool | None:
        dynamics = self.derivation.dynamics
        place = self.derivation.system.names.index(coordinate)
        rate = self.derivation.system.total_derivative(dynamics.lagrange.momenta[place])
        on_motion = dynamics.on_motion(rate)
        return None if on_motion is None else self.comparison.vanishes(on_motion)

    def _conserved(
        self, path: Sequence[str], charges: Mapping[str, Charge], name: str, expected: Expression
    ) -> Finding | None:
        """The charge of that name, or (where a candidate gives it already) the same charge."""
        listed = [charges[name]] if name in charges else list(charges.values())
        conserved = [c for c in listed if c.conserved and c.charge is not None]
        if not conserved:
            if any(c.conserved is None for c in listed):
                return self._finding(Outcome.UNDECIDED, path, "nobody knows if it is conserved")
            return self._finding(Outcome.WRONG, path, "derived: not conserved")
        verdicts = [
            self.comparison.same_charge(cast(Expression, c.charge), expected) for c in conserved
        ]
        verdict = True if True in verdicts else None if None in verdicts else False
        found = to_grammar(cast(Expression, conserved[0].charge))
        return self._judge(path, verdict, to_grammar(expected), found)

    def _modes(self) -> Found:
        """The angular frequencies about one equilibrium, or those about all of them."""
        expected = self.expect.modes
        if expected is None:
            return
        modes = cast(ModesSection, self.answers.sections["modes"]).modes
        if modes is None:
            yield self._finding(Outcome.UNDECIDED, ["modes"], "no modes were found")
            return
        groups: dict[object, list[Expression]] = {}
        for mode in modes:
            groups.setdefault((*mode.at.items(), mode.on), []).extend(_frequencies(mode))
        every = [frequency for group in groups.values() for frequency in group]
        verdicts = [
            self.comparison.same_set(found, expected) for found in (every, *groups.values())
        ]
        verdict = True if True in verdicts else None if None in verdicts else False
        yield self._judge(["modes"], verdict, _listed(expected), _listed(every))

    def _find(self) -> Found:
        if not self.expect.find and not self.expect.ranges:
            return
        answers = cast(FindSection, self.answers.sections["find"]).answers
        for name, expected in self.expect.find.items():
            path, answer = ["find", name], answers.get(name)
            if isinstance(answer, Solutions):
                if answer.solutions is None:
                    yield self._finding(Outcome.UNDECIDED, path, answer.note or "no answer")
                    continue
                verdict = self.comparison.same_set(answer.solutions, expected)
                yield self._judge(path, verdict, _listed(expected), _listed(answer.solutions))
            elif isinstance(answer, Rewritten) and answer.values:
                verdict = self.comparison.same_set(answer.values, expected)
                yield self._judge(path, verdict, _listed(expected), _listed(answer.values))
            else:
                value = answer.value if isinstance(answer, Rewritten) else None
                yield self._compare(path, value, expected[0])
        for name, bounds in self.expect.ranges.items():
            yield self._ranges(["find", name], cast(Ranges, answers[name]), bounds)

    def _ranges(
        self, path: Sequence[str], answer: Ranges, expected: Sequence[Sequence[Inequality]]
    ) -> Finding | None:
        if answer.ranges is None:
            return self._finding(Outcome.UNDECIDED, path, answer.note)
        verdict = same_ranges(answer.ranges, expected, self.comparison.equal)
        wanted = [[(each.comparison, each.right) for each in bounds] for bounds in expected]
        found = [each.bounds for each in answer.ranges]
        return self._judge(path, verdict, in_words(wanted), in_words(found))


def _frequencies(mode: Mode) -> list[Expression]:
    return [] if mode.frequency is None else [mode.frequency] * mode.multiplicity


def _listed(formulas: Sequence[Expression]) -> str:
    return ", ".join(map(to_grammar, formulas)) or "none"


#: The section of `Answers` that an expectation is compared with.
_SECTIONS: Mapping[str, Callable[[Expect], object]] = {
    "accelerations": lambda expect: expect.accelerations,
    "multipliers": lambda expect: expect.multipliers,
    "constraint_forces": lambda expect: expect.constraint_forces,
    "forces": lambda expect: expect.forces or expect.friction_needed,
    "momenta": lambda expect: expect.momenta,
    "energy": lambda expect: expect.energy is not None,
    "hamiltonian": lambda expect: expect.hamiltonian is not None,
    "charges": lambda expect: expect.charges,
    "discovered": lambda expect: expect.discovered,
    "algebra": lambda expect: expect.algebra is not None,
    "find": lambda expect: expect.find or expect.ranges,
    "equilibria": lambda expect: expect.equilibria,
    "modes": lambda expect: expect.modes is not None,
    "reduction": lambda expect: expect.reduction is not None,
    "steady_motions": lambda expect: expect.steady_motions,
    "brackets": lambda expect: expect.brackets,
    "canonical": lambda expect: expect.canonical,
    "hamilton_jacobi": lambda expect: expect.hamilton_jacobi is not None,
}


def sections_expected(expect: Expect) -> list[str]:
    """The sections that have to be derived to compare with what is expected."""
    return [name for name, wanted in _SECTIONS.items() if wanted(expect)]
