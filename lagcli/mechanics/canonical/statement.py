"""The sections `brackets` and `canonical` in the shape in which they are read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, shape, simplify
from lagcli.algebra.build import Builder, free_of
from lagcli.expression import Expression, Name, walk
from lagcli.mechanics.canonical.poisson import poisson, rate
from lagcli.mechanics.canonical.transformation import CanonicalTest
from lagcli.mechanics.derivation import Derivation
from lagcli.problem_data import BracketQuestion, CanonicalKind, Problem
from lagcli.statements.answers import Verification
from lagcli.statements.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    FailingBracket,
    GeneratingFunction,
    PoissonBracket,
    TransformationsSection,
)

#: What could not be found, and why.
Missing = list[tuple[str, str]]

_HAMILTONIAN = "H"
_FORCED = "constraints, forces or dissipation act, so dA/dt is not {A, H} + the derivative by t"


def _kind(test: CanonicalTest) -> CanonicalKind | None:
    if not test.preserves:
        return None if test.preserves is None else "not canonical"
    return "canonical" if is_zero(test.valence - 1) is True else "extended canonical"


class PhaseSpace:
    """What the file says of phase space, as it is read; `missing` gathers what is not found."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.problem: Problem = derivation.given
        self.hamiltonian = derivation.hamiltonian
        self.system = self.hamiltonian.system
        self.missing: Missing = []

    def _written(self, expression: Expr, names: Sequence[str] = ()) -> Expression:
        return shape(expression, (*self.system.order, *names))

    # -- brackets -----------------------------------------------------------------------------

    def brackets(self) -> BracketsSection:
        """The brackets that the file asks for, or all of its observables or charges."""
        rates, reason = self._rates()
        return BracketsSection(
            observables={name: self._written(f) for name, f in self._observables.items()},
            brackets=tuple(map(self._bracket, self._questions())),
            rates=rates,
            reason=reason,
        )

    @cached_property
    def _observables(self) -> dict[str, Expr]:
        found: dict[str, Expr] = {}
        for name, formula in self.problem.observables.items():
            found[name] = self._builder(found)(formula)
        return found

    def _builder(self, names: Mapping[str, Expr]) -> Builder:
        return self.system.build.knowing(names)

    @cached_property
    def _charges(self) -> dict[str, Expr]:
        """The charges of the file's symmetries in phase space, by names that are free."""
        names = [s.name for s in self.problem.symmetries if s.name.isidentifier()]
        if not names or self.derivation.no_lagrangian or self.hamiltonian.velocities is None:
            return {}
        charges = {c.name: c.charge for c in self.derivation.noether.charges}
        return {
            name: self.hamiltonian.in_phase_space(charges[name])
            for name in names
            if name in charges and name not in self.system.build.names
        }

    def _questions(self) -> Iterator[BracketQuestion]:
        if self.problem.brackets:
            yield from self.problem.brackets
            return
        for one, other in combinations(self._observables or self._charges, 2):
            yield BracketQuestion(name=f"{one}, {other}", left=Name(one), right=Name(other))

    def _bracket(self, question: BracketQuestion) -> PoissonBracket:
        sides = question.left, question.right
        used = {node.name for side in sides for node in walk(side) if isinstance(node, Name)}
        names = dict(self._observables)
        if used - names.keys() - self.system.build.names.keys():
            names |= {name: f for name, f in self._charges.items() if name not in names}
            if self.hamiltonian.function is not None:
                names.setdefault(_HAMILTONIAN, self.hamiltonian.function)
        unknown = used - names.keys() - self.system.build.names.keys() - {"t", "pi"}
        if unknown:
            why = "the charges and H are not known as functions of the momenta"
            self.missing.append((f"the bracket '{question.name}'", why))
            return PoissonBracket(name=question.name, left=sides[0], right=sides[1], value=None)
        left, right = map(self._builder(names), sides)
        value = poisson(left, right, self.system)
        return PoissonBracket(
            name=question.name,
            left=sides[0],
            right=sides[1],
            value=self._written(value),
            named=self._named(value, names),
        )

    def _named(self, value: Expr, names: Mapping[str, Expr]) -> Expression | None:
        """The value as a constant times an observable or a charge, or times that and H."""
        moving = (*self.system.q, *self.system.momenta, self.system.t)
        if free_of(value, moving):
            return None
        factors: list[tuple[Expr, list[str]]] = [(sympy.S.One, [])]
        H = self.hamiltonian.function
        if H is not None and _HAMILTONIAN not in {*self.system.build.names, *self._observables}:
            factors.append((H, [_HAMILTONIAN]))
        for factor, more in factors:
            for name, f in names.items():
                if is_zero(f) is True or (more and name == _HAMILTONIAN):
                    continue
                ratio = simplify(value / (f * factor))
                if free_of(ratio, moving):
                    product = sympy.Mul(*(Symbol(n, real=True) for n in (*more, name)))
                    return self._written(ratio * product, [*more, name])
        return None

    def _rates(self) -> tuple[dict[str, Expression] | None, str]:
        """dA/dt of the observables, where the motion is that of H alone."""
        if not self._observables:
            return {}, ""
        problem, H = self.problem, self.hamiltonian.function
        if problem.constraints or any(force != 0 for force in self.system.applied_forces):
            return None, _FORCED
        if H is None:
            self.missing.append(("the rates of the observables", self.hamiltonian.reason))
            return None, self.hamiltonian.reason
        return {
            name: self._written(rate(f, H, self.system)) for name, f in self._observables.items()
        }, ""

    # -- transformations ----------------------------------------------------------------------

    def transformations(self) -> TransformationsSection:
        """Each transformation of the file, tested."""
        given = self.problem.canonical_transformations
        tests = (CanonicalTest(self.system, each) for each in given)
        return TransformationsSection(transformations=tuple(map(self._tested, tests)))

    def _tested(self, test: CanonicalTest) -> ExaminedTransformation:
        name, new = test.given.name, tuple(symbol.name for symbol in test.new)
        preserves = test.preserves
        if preserves is None:
            self.missing.append(
                (f"whether '{name}' is canonical", "the normal form does not decide its brackets")
            )
        generator = self._generator(test)
        nothing: tuple[Expr | None, Verification | None, str] = None, None, ""
        K, how, reason = self._new_hamiltonian(test) if preserves else nothing
        return ExaminedTransformation(
            name=name,
            variables={
                symbol: self._written(f) for symbol, f in zip(new, test.functions, strict=True)
            },
            kind=_kind(test),
            valence=self._written(test.valence) if preserves else None,
            verified=test.verified,
            failing=tuple(
                FailingBracket(
                    left=each.left,
                    right=each.right,
                    value=self._written(each.value),
                    expected=self._written(each.expected),
                )
                for each in test.failing
            ),
            in_general=test.in_general,
            generator=generator,
            hamiltonian=None if K is None else self._written(K, new),
            hamiltonian_verified=how,
            reason=reason,
        )

    def _generator(self, test: CanonicalTest) -> GeneratingFunction | None:
        new = tuple(symbol.name for symbol in test.new)
        if test.generating is not None:
            if test.generates is None:
                what = f"whether {test.given.kind} generates '{test.given.name}'"
                self.missing.append((what, "the normal form does not decide its derivatives"))
            return GeneratingFunction(
                kind=test.given.kind,
                function=self._written(test.generating, new),
                generates=test.generates,
                failing=tuple(
                    (self._written(each.left, new), self._written(each.right))
                    for each in test.relations
                    if each.holds is False
                ),
            )
        if not test.preserves or test.action_form is None:
            return None
        return GeneratingFunction(
            kind="F", function=self._written(test.action_form), generates=True
        )

    def _new_hamiltonian(self, test: CanonicalTest) -> tuple[Expr | None, Verification | None, str]:
        H, reason = self.hamiltonian.function, self.hamiltonian.reason
        if H is not None:
            found = test.new_hamiltonian(H)
            if found is not None:
                return *found, ""
            reason = "the transformation was not inverted in closed form"
            if test.explicit_part is None:
                reason = "the derivative of the generating function by t was not found"
        self.missing.append((f"the Hamiltonian in the variables of '{test.given.name}'", reason))
        return None, None, reason
