"""What a problem demands of the dimensions of its quantities.

[L] is one dimension for all terms of T, V and L; with it

    [Q_q] = [L]/[q],  [p_q] = [L] s/[q],  [D] = [L]/s,
    [lambda] = [L]/[f] for f(q, t) = 0 and [L]/([f] s) for f(q, q', t) = 0,
    [Delta q] [epsilon] = [q],  [G] [epsilon] = [L] s,  [Q] = [L] s/[epsilon].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lagcli.dimensions.forms import ENERGY, NUMBER, TIME, Form, minus, plus, unknown, unknowns
from lagcli.dimensions.system import dimension_of
from lagcli.dimensions.terms import Group, Reader, Term, representative
from lagcli.expression import Equation, Expression, Name, Power, walk
from lagcli.problem_data import (
    Constraint,
    Contact,
    Lasting,
    Point,
    Problem,
    Quantity,
    Reaching,
    Symmetry,
    Where,
)
from lagcli.units import read_unit

LAGRANGIAN = unknown("lagrangian")
ACTION = plus(LAGRANGIAN, TIME)


class Demands:
    """The dimensions of a problem's names, and the groups of terms that must agree.

    Attributes
    ----------
    names : dict of str to Form
        Coordinates, parameters, definitions, multipliers, momenta, `t` and `pi`.
    energies : Group or None
        The terms of T and V, or of L.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.names: dict[str, Form] = {"t": TIME, "pi": NUMBER}
        self.energies: Group | None = None
        self._reader = Reader(self.names)
        for kind, quantities in (("coordinate", problem.coordinates),
                                 ("parameter", problem.parameters)):  # fmt: skip
            for quantity in quantities:
                self.names[quantity.name] = _given_or(quantity, unknown(kind, quantity.name))
        self._moving: set[str] = set()  # definitions that hold velocities
        for name, formula in problem.definitions.items():
            if self._holds_velocity(formula):
                self._moving.add(name)
            form = self._one(formula)
            self.names[name] = unknown("definition", name) if form is None else form
        self.names |= {f"p_{q}": minus(ACTION, self.names[q]) for q in self._coordinates}
        self._gather()

    @property
    def groups(self) -> list[Group]:
        """What must agree, the energies first."""
        first = [] if self.energies is None else [self.energies]
        return first + self._reader.groups

    @property
    def powers(self) -> Mapping[Power, Form]:
        """Powers whose exponent is no number, and the dimension of the base."""
        return self._reader.powers

    @property
    def _coordinates(self) -> list[str]:
        return [coordinate.name for coordinate in self.problem.coordinates]

    def _gather(self) -> None:
        problem = self.problem
        self._energies()
        for parameter in problem.parameters:
            if parameter.value is not None:
                self._value(parameter.value, self.names[parameter.name], parameter.name)
        for name, value in problem.initial.items():
            self._value(value, plus(self.names[name.name], TIME, -name.primes), str(name))
        for point in problem.points:
            self._point(point)
        for coordinate, force in problem.forces.items():
            along = minus(LAGRANGIAN, self.names[coordinate])
            self._whole(force, along, f"the force along '{coordinate}'", is_force=True)
        if problem.dissipation is not None:
            self._whole(problem.dissipation, minus(LAGRANGIAN, TIME), "the dissipation function")
        holding: tuple[Constraint | Contact, ...] = (*problem.constraints, *problem.contacts)
        for constraint in holding:
            self._constraint(constraint)
            if constraint.restitution is not None:
                what = f"the restitution of '{constraint.name}'"
                self._whole(constraint.restitution, NUMBER, what)
        for constraint in problem.constraints:
            if (holds := constraint.holds_while) is not None:
                self._agree(Equation(holds.left, holds.right, span=holds.span))
        for symmetry in problem.symmetries:
            self._symmetry(symmetry)
        for label, observable in problem.observables.items():
            form = self._one(observable)
            self.names[label] = unknown("observable", label) if form is None else form
        for question in problem.find:
            if isinstance(question, Where):
                self._agree(question.equation)
            elif isinstance(question, Lasting):
                condition = question.condition
                self._agree(Equation(condition.left, condition.right, span=condition.span))
            elif isinstance(question, Reaching):
                self._agree(Equation(question.coordinate, question.value, span=question.span))
            else:
                self._one(question.value)

    def _one(self, formula: Expression) -> Form | None:
        return self._reader.demand(self._reader.terms(formula))

    def _whole(
        self, formula: Expression, expected: Form, subject: str, *, is_force: bool = False
    ) -> None:
        terms = self._reader.terms(formula)
        self._reader.demand(terms, expected, subject, is_force=is_force)

    def _value(self, formula: Expression, expected: Form, name: str) -> None:
        terms = self._reader.terms(formula, given_number=True)
        self._reader.demand(terms, expected, f"the value of {name}")

    def _agree(self, equation: Equation) -> Form | None:
        left, right = (self._reader.terms(side) for side in (equation.left, equation.right))
        return self._reader.demand([*left, *right])

    def _energies(self) -> None:
        problem = self.problem
        parts = [problem.kinetic, problem.potential, problem.lagrangian]
        if problem.hamiltonian is not None:  # L is made from it
            parts = [problem.hamiltonian]
        terms = [t for part in parts if part is not None for t in self._reader.terms(part)]
        given = problem.kinetic, problem.lagrangian, problem.hamiltonian
        if all(formula is None for formula in given):
            terms += self._kinetic_energies()
        if not terms:
            return
        known = [term.form for term in terms if not unknowns(term.form)]
        usual = ENERGY if ENERGY in known else representative([term.form for term in terms])
        span = terms[0].node.span.to(terms[-1].node.span)
        self.energies = Group(terms=tuple(terms), span=span, usual=usual)

    def _kinetic_energies(self) -> Iterator[Term]:
        """m v^2 of each point, at the place of its mass."""
        for point in self.problem.points:
            mass = None if point.mass is None else self._reader.form(point.mass)
            for component in point.position:
                place = self._reader.form(component)
                if point.mass is not None and mass is not None and place is not None:
                    velocity = minus(place, TIME)
                    yield Term(point.mass, plus(mass, velocity, 2))
                    break

    def _point(self, point: Point) -> None:
        components = [term for part in point.position for term in self._reader.terms(part)]
        place = self._reader.demand(components)
        if place is None or point.force is None:
            return
        for component in point.force:
            along = minus(LAGRANGIAN, place)
            self._whole(component, along, f"the force on '{point.name}'", is_force=True)

    def _constraint(self, constraint: Constraint | Contact) -> None:
        form = self._agree(constraint.equation)
        sides = (constraint.equation.left, constraint.equation.right)
        velocities = any(self._holds_velocity(side) for side in sides)
        multiplier = unknown("multiplier", constraint.multiplier)
        if form is not None:
            multiplier = minus(minus(LAGRANGIAN, form), TIME if velocities else NUMBER)
        self.names[constraint.multiplier] = multiplier

    def _holds_velocity(self, formula: Expression) -> bool:
        names = (node for node in walk(formula) if isinstance(node, Name))
        return any(node.primes > 0 or node.name in self._moving for node in names)

    def _symmetry(self, symmetry: Symmetry) -> None:
        step = small_parameter(symmetry)
        for name, change in symmetry.changes.items():
            expected = minus(self.names[name], step)
            self._whole(change, expected, f"the change of '{name}'")
        if symmetry.time is not None:
            self._whole(symmetry.time, minus(TIME, step), "the change of t")
        if symmetry.gauge is not None:
            self._whole(symmetry.gauge, minus(ACTION, step), "the gauge")


def small_parameter(symmetry: Symmetry) -> Form:
    """The dimension of epsilon in q -> q + epsilon Delta q."""
    return unknown("parameter of", symmetry.name)


def _given_or(quantity: Quantity, other: Form) -> Form:
    form = given(quantity)
    return other if form is None else form


def given(quantity: Quantity) -> Form | None:
    """The dimension that the file gives."""
    return None if quantity.unit is None else dimension_of(read_unit(quantity.unit))
