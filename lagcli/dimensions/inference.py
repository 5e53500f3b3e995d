"""The dimensions of a problem, where its units and its formulas determine them."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property

from lagcli.diagnostics import Span
from lagcli.dimensions.demands import LAGRANGIAN, Demands
from lagcli.dimensions.forms import ENERGY, NUMBER, Form, minus, unknown, unknowns
from lagcli.dimensions.relations import FormRelations
from lagcli.dimensions.system import UnitSystem
from lagcli.problem_data import Problem, Quantity
from lagcli.units import Unit


def quantities(problem: Problem) -> tuple[Quantity, ...]:
    """Coordinates and parameters, which may have units."""
    return (*problem.coordinates, *problem.parameters)


def gives_units(problem: Problem) -> bool:
    """Whether a file gives any unit."""
    return any(quantity.unit is not None for quantity in quantities(problem))


class Inference:
    """What follows for each quantity; where the file contradicts itself, from the rest."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.demands = Demands(problem)
        self.relations = FormRelations()
        self._solve()

    @cached_property
    def system(self) -> UnitSystem:
        """The file's system of units."""
        return UnitSystem(
            (quantity.unit, quantity.unit_span)
            for quantity in quantities(self.problem)
            if quantity.unit is not None
        )

    def form(self, form: Form) -> Form:
        """A dimension with what is known put in."""
        return self.relations.reduced(form)

    def unit(self, form: Form) -> Unit | None:
        """The unit of a dimension in the file's system; None where it is undetermined."""
        found = self.form(form)
        return None if unknowns(found) else self.system.unit(found)

    def _solve(self) -> None:
        relations, energies = self.relations, self.demands.energies
        if energies is not None:
            relations.add(LAGRANGIAN, energies.representative, energies.span)
        for left, right, span in sorted(self._equations(), key=_unknown_count):
            relations.add(left, right, span)
        self._powers_of_numbers()
        if not relations.is_known(LAGRANGIAN) and energies is not None and self._dimensional:
            self._take_for_energy(energies.span)

    def _take_for_energy(self, origin: Span) -> None:
        """L, unless a quantity is in kg^(1/2) or the like then, as where L is by mass."""
        known, before = self.relations, self._with_roots_of_mass()
        self.relations = known.copied()
        self.relations.add(LAGRANGIAN, ENERGY, origin)
        self._powers_of_numbers()
        if not self._with_roots_of_mass() <= before:
            self.relations = known

    def _with_roots_of_mass(self) -> set[str]:
        forms = {name: self.form(form) for name, form in self.demands.names.items()}
        forms |= {name: self.form(unknown("function", name)) for name in self.problem.functions}
        return {
            name
            for name, form in forms.items()
            if not unknowns(form) and form.get("kg", Fraction(0)).denominator != 1
        }

    @property
    def _dimensional(self) -> bool:
        """Whether a unit of the file has a dimension; angles in rad are as good as numbers."""
        given = (q for q in quantities(self.problem) if q.unit is not None)
        return any(self.demands.names[quantity.name] for quantity in given)

    def _equations(self) -> Iterator[tuple[Form, Form, Span]]:
        for group in self.demands.groups:
            is_energies = group is self.demands.energies
            reference = LAGRANGIAN if is_energies else group.representative
            for term in group.terms:
                yield term.form, reference, term.node.span

    def _powers_of_numbers(self) -> None:
        """x^n is a number where x is one, whatever n."""
        open_powers = dict(self.demands.powers)
        found = True
        while found:
            found = False
            for node, base in list(open_powers.items()):
                if not self.form(base):
                    del open_powers[node]
                    found = self.relations.add(unknown("power", node), NUMBER, node.span) or found


def _unknown_count(equation: tuple[Form, Form, Span]) -> int:
    return len(unknowns(minus(equation[0], equation[1])))
