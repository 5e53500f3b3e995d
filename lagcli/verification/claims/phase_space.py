"""Poisson brackets and canonical transformations, by gradients at random points of phase space.

A transformation with the valence c is that of dQ/dt = dK/dP, dP/dt = -dK/dQ; a generating
function obeys c sum p dq - sum P dQ = dF at constant t.

Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 9.1 (table 9.1), 9.4, 9.5.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from flint import arb

from lagcli.expression import Expression, Name, walk
from lagcli.problem_data import CanonicalTransformation, Symmetry
from lagcli.record import replace
from lagcli.statements.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    FailingBracket,
    GeneratingFunction,
    PoissonBracket,
    TransformationsSection,
)
from lagcli.verification.claims.charges_in_phase_space import ChargeOfSymmetry
from lagcli.verification.examination import Examination
from lagcli.verification.linear import dot, size
from lagcli.verification.phase_points import PhasePoint
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues, column

#: Two lists of values at a state.
Sides = Callable[[State], tuple[list[arb], list[arb]]]

_WHY = "its printed form was not confirmed at random states"


# -- brackets ---------------------------------------------------------------------------------


def brackets(x: Examination, section: BracketsSection) -> BracketsSection:
    """Each {left, right} with its value, and the rates of the observables."""
    given = {}
    for name, each in x.problem.observables.items():  # each may use earlier ones
        given[name] = x.reference.place(each)
        x.reference.program.define(name, given[name])
    printed = list(section.observables.values())
    places = [given[name] for name in section.observables]
    if not x.hold("the observables", printed, lambda s: [s.at(place) for place in places]):
        section = replace(section, observables={})
    charges = {s.name: ChargeOfSymmetry(x, s) for s in _named_symmetries(x, section)}
    found = tuple(_bracket(x, each, charges) for each in section.brackets)
    rates, what = section.rates, "the rates of the observables"
    if rates is not None and rates.keys() != given.keys():
        x.refute(what, "some are left out")
        rates = None
    if rates and not x.hold(
        what, list(rates.values()), lambda s: [s.phase.rate(given[name]) for name in rates or ()]
    ):
        rates = None
    reason = section.reason if rates is section.rates else _WHY
    return replace(section, brackets=found, rates=rates, reason=reason)


def _bracket(
    x: Examination, each: PoissonBracket, charges: Mapping[str, ChargeOfSymmetry]
) -> PoissonBracket:
    what = f"the bracket '{each.name}'"
    if each.value is None:
        return each
    asked = next((b for b in x.problem.brackets if b.name == each.name), each)
    used = {n for side in (asked.left, asked.right, each.named) for n in _names(side)}
    charges = {name: charge for name, charge in charges.items() if name in used}
    if not all(charge.known for charge in charges.values()):
        x.unchecked.append(what)
        return each
    left, right = map(x.reference.place, (asked.left, asked.right))

    def point(s: State) -> PhasePoint:
        return s.phase.knowing({name: charge.at(s) for name, charge in charges.items()})

    places = x.places(what, [each.value])
    if places is None:
        return replace(each, value=None, named=None)

    def bracket(s: State) -> tuple[list[arb], list[arb]] | None:
        value = point(s).bracket(left, right)
        return None if charges and value.is_nan() else ([s.at(places[0])], [value])

    if not x.decide(what, bracket):
        return replace(each, value=None, named=None)
    if each.named is None:
        return each
    named = x.reference.place(each.named)

    def by_names(s: State) -> tuple[list[arb], list[arb]] | None:
        """The values, and the derivatives: these alone where a boundary term is not given."""
        sides = []
        for here, place in ((point(s), named), (s.phase, places[0])):
            by_q, by_p = here.slopes(place)
            sides.append([here.at(place), *by_q, *by_p])
        if charges and sides[0][0].is_nan():
            sides = [side[1:] for side in sides]
        unknown = charges and any(value.is_nan() for value in sides[0])
        return None if unknown else (sides[0], sides[1])

    return each if x.decide(f"{what} by names", by_names) else replace(each, named=None)


def _named_symmetries(x: Examination, section: BracketsSection) -> Iterator[Symmetry]:
    """Those whose conserved quantities are named in brackets or in their values."""
    problem = x.problem
    if x.reference.of_phase_space:
        return iter(())  # no Lagrangian, so no conserved quantity of Noether's
    quantities = (*problem.parameters, *problem.coordinates)
    known = {*problem.observables, *problem.definitions, *(each.name for each in quantities)}
    sides = [side for each in problem.brackets for side in (each.left, each.right)]
    sides += [each for b in section.brackets for each in (b.left, b.right, b.named) if each]
    used = {name for side in sides for name in _names(side)}
    return (each for each in problem.symmetries if each.name in used - known)


def _names(formula: Expression | None) -> set[str]:
    nodes = () if formula is None else walk(formula)
    return {node.name for node in nodes if isinstance(node, Name)}


# -- transformations ----------------------------------------------------------------------------


def transformations(x: Examination, section: TransformationsSection) -> TransformationsSection:
    """Each transformation, by what the file defines as the new variables."""
    given = {each.name: each for each in x.problem.canonical_transformations}
    found = tuple(Tested(x, given[e.name], e).examined() for e in section.transformations)
    return replace(section, transformations=found)


class Tested:
    """One transformation and what is printed of it."""

    def __init__(
        self, x: Examination, given: CanonicalTransformation, each: ExaminedTransformation
    ) -> None:
        self.x, self.each = x, each
        self.name = f"the transformation '{each.name}'"
        names = list(given.coordinates)
        functions = {**given.coordinates, **{f"p_{n}": given.momenta[n] for n in names}}
        self.given = given
        self.places = {name: x.reference.place(f) for name, f in functions.items()}
        self.Q, self.P = names, [f"p_{n}" for n in names]
        self.symbols = {name: x.reference.program.symbol(name) for name in self.places}

    def examined(self) -> ExaminedTransformation:
        """What of it is confirmed."""
        each, x = self.each, self.x
        places = [self.places[name] for name in each.variables]
        written = list(each.variables.values())
        if not x.hold(self.name, written, lambda s: [s.at(place) for place in places]):
            each = replace(each, variables={})
        if each.kind is not None and not self._is_of_kind(each):
            return replace(
                each, kind=None, valence=None, failing=(), generator=None, hamiltonian=None,
                verified=None, hamiltonian_verified=None, reason=_WHY,
            )  # fmt: skip
        generator = each.generator
        if generator is not None and not self._generates(generator):
            each = replace(each, generator=None)
        K = each.hamiltonian
        if K is not None and not self._moves(K):
            each = replace(each, hamiltonian=None, hamiltonian_verified=None, reason=_WHY)
        return each

    # -- brackets ---------------------------------------------------------------------------

    def _pairs(self) -> Iterator[tuple[str, str, bool]]:
        """Two new variables, and whether they are conjugate."""
        names = [*self.Q, *self.P]
        for k, one in enumerate(names):
            for other in names[k + 1 :]:
                yield one, other, other == f"p_{one}" and one in self.Q

    def _brackets(self, s: State) -> list[arb]:
        return [s.phase.bracket(self.places[a], self.places[b]) for a, b, _ in self._pairs()]

    def _is_of_kind(self, each: ExaminedTransformation) -> bool:
        x, pairs = self.x, list(self._pairs())
        what = f"that '{each.name}' is {each.kind}"
        if each.kind == "not canonical":
            return self._fails(what, each.failing)
        valence = each.valence
        places = x.places(what, [valence] if valence is not None else [])
        if not places:
            return False
        if each.kind == "canonical" and not x.vanishes(what, lambda s: s.at(places[0]) - 1):
            return False
        if each.kind != "canonical" and not x.constant(
            what, claim=False, value=lambda s: s.at(places[0]) - 1
        ):
            return False
        return x.decide(
            what,
            lambda s: (
                self._brackets(s),
                [s.at(places[0]) if conjugate else arb(0) for _, _, conjugate in pairs],
            ),
        )

    def _fails(self, what: str, failing: Sequence[FailingBracket]) -> bool:
        """Each listed bracket has its value, which is not the expected one; there is one."""
        x = self.x
        sides = x.places(what, [e for f in failing for e in (f.value, f.expected)])
        if not failing or sides is None:
            x.refute(what, "no bracket is listed that fails")
            return False
        named = [(self.places[f.left], self.places[f.right]) for f in failing]
        first = self.places[self.Q[0]], self.places[self.P[0]]
        paired = [f.right == f"p_{f.left}" for f in failing]
        values, expected = sides[::2], sides[1::2]

        def right(s: State) -> list[arb]:
            """0, or for a pair the valence: the first bracket of a pair, or 1."""
            valence = [s.phase.bracket(*first), arb(1)]
            found = []
            for place, conjugate in zip(expected, paired, strict=True):
                value = s.at(place)
                known = valence if conjugate else [arb(0)]
                found.append(min(known, key=lambda v, value=value: size(v - value)))  # type: ignore[misc]
            return [*(s.phase.bracket(*pair) for pair in named), *found]

        return x.hold(
            what, [e for f in failing for e in (f.value,)] + [f.expected for f in failing], right
        ) and all(
            x.constant(what, claim=False, value=lambda s, v=v, e=e: s.at(v) - s.at(e))  # type: ignore[misc]
            for v, e in zip(values, expected, strict=True)
        )

    # -- generating functions -------------------------------------------------------------------

    def _new(self, point: PhasePoint) -> StepValues:
        """Formulas of the old and the new variables."""
        return point.with_values({(n, 0): point.at(place) for n, place in self.places.items()})

    def _generates(self, printed: GeneratingFunction) -> bool:
        x, what = self.x, f"the generating function of '{self.each.name}'"
        places = x.places(what, [printed.function])
        valence = x.places(what, [v for v in (self.each.valence,) if v is not None])
        if not places or valence is None:
            return False
        given = self.given.generating
        if printed.kind != "F" and given is not None:
            known = x.reference.place(given)

            def new(s: State) -> StepValues:
                return self._new(s.phase)

            if not x.holds(what, printed.function, lambda s: new(s)(known), new):
                return False
        if printed.generates is None:
            return True
        sides = self._relations(printed.kind, places[0], valence)
        if printed.generates:
            return x.decide(what, sides)
        failing = x.places(what, [side for pair in printed.failing for side in pair])
        if not failing:
            x.refute(what, "no relation is listed that fails")
            return False
        pairs = list(zip(failing[::2], failing[1::2], strict=True))
        return x.constant(
            f"that {what} does not generate it",
            claim=False,
            value=lambda s: sum((abs(a - b) for a, b in zip(*sides(s), strict=True)), arb(0)),
        ) and x.decide(what, lambda s: self._relations_listed(s, pairs, sides))

    def _relations_listed(
        self, s: State, pairs: Sequence[tuple[int, int]], sides: Sides
    ) -> tuple[list[arb], list[arb]]:
        """Each listed relation beside that derivative of F which it is, but for both signs."""
        at = self._new(s.phase)
        printed = [(at(left), at(right)) for left, right in pairs]
        known = [(sign * b, sign * a) for a, b in zip(*sides(s), strict=True) for sign in (1, -1)]

        def apart(one: tuple[arb, arb], other: tuple[arb, arb]) -> float:
            return sum(size(a - b) for a, b in zip(one, other, strict=True))

        nearest = [min(known, key=lambda k, p=p: apart(k, p)) for p in printed]  # type: ignore[misc]
        return [v for p in printed for v in p], [v for n in nearest for v in n]

    def _relations(self, kind: str, F: int, valence: Sequence[int]) -> Sides:
        """What the derivatives of F are, and what they must be."""
        q, p = self.x.reference.q, self.x.reference.p

        def sides(s: State) -> tuple[list[arb], list[arb]]:
            at = self._new(s.phase)
            c = at(valence[0]) if valence else arb(1)
            by = at.gradient(F)
            Q, P = ([at(self.places[n]) for n in names] for names in (self.Q, self.P))
            if kind == "F":
                return column(by, [*q, *p]), self._action_form(s.phase, c, P)
            old, kept = ((q, [c * at(x) for x in p]), (p, [-c * at(x) for x in q]))[
                kind in {"F3", "F4"}
            ]
            new, made = ((self.Q, [-x for x in P]), (self.P, Q))[kind in {"F2", "F4"}]
            return column(by, [*old, *(self.symbols[n] for n in new)]), [*kept, *made]

        return sides

    def _action_form(self, point: PhasePoint, c: arb, P: Sequence[arb]) -> list[arb]:
        """c p - sum P dQ/dq, and -sum P dQ/dp."""
        slopes = [point.slopes(self.places[n]) for n in self.Q]
        momenta = [point.at(x) for x in self.x.reference.p]
        by_q = [c * m - dot(P, [d[0][j] for d in slopes]) for j, m in enumerate(momenta)]
        return by_q + [-dot(P, [d[1][j] for d in slopes]) for j in range(len(momenta))]

    # -- the new Hamiltonian ----------------------------------------------------------------------

    def _moves(self, K: Expression) -> bool:
        """Whether dQ/dt = dK/dP and dP/dt = -dK/dQ."""
        what = f"the Hamiltonian in the variables of '{self.each.name}'"
        places = self.x.places(what, [K])
        if not places:
            return False

        def sides(s: State) -> tuple[list[arb], list[arb]]:
            by = self._new(s.phase).gradient(places[0])
            slopes = column(by, [self.symbols[n] for n in self.P])
            slopes += [-d for d in column(by, [self.symbols[n] for n in self.Q])]
            return slopes, [s.phase.rate(self.places[n]) for n in (*self.Q, *self.P)]

        return self.x.decide(what, sides)
