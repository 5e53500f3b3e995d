"""The section `hamilton_jacobi` in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, shape, terms
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.algebra.vanishing_factors import squares_divided_by
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    operation_count,
    sum_of,
    terms_of,
)
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.hamiltonian_form import hamiltonian_form
from lagcli.mechanics.readable import Readable
from lagcli.mechanics.reduction.driven import Driven
from lagcli.mechanics.reduction.quadrature import ElementaryAction, closed_forms
from lagcli.mechanics.reduction.root_integrals import ROOT
from lagcli.mechanics.reduction.separation import Separation
from lagcli.mechanics.reduction.statement import Missing
from lagcli.record import replace
from lagcli.rewriting import put_in
from lagcli.statements.motions import ActionPart, HamiltonJacobiSection


def hamilton_jacobi(derivation: Derivation) -> tuple[HamiltonJacobiSection, Missing]:
    """The separation in the coordinates of the file, and what was not found."""
    separation = Separation(derivation)
    if separation.driven is not None:
        return _by_forces_of_time(separation, separation.driven), []
    system, H = separation.system, separation.hamiltonian
    separated = separation.separated
    missing: Missing = []
    if separation.reason:
        missing.append(("the separation of the Hamilton-Jacobi equation", separation.reason))
    elif separation.separable is None:
        why = "Levi-Civita's test was not decided"
        missing.append(("whether the Hamilton-Jacobi equation separates", why))
    writer = _Writing(separation)
    obstacle = separation.obstacle
    closed = {
        name: tuple(
            ActionPart(writer.function(form), conditions(form.positive, writer.order))
            for form in forms
        )
        for name, forms in _functions(separation).items()
    }
    form = None if H is None else _hamiltonian(separation)
    return (
        HamiltonJacobiSection(
            hamiltonian=form,
            energy=separation.E.name,
            separable=separation.separable,
            obstacle=() if obstacle is None else tuple(system.names[j] for j in obstacle),
            in_general=separation.in_general,
            constants=()
            if separated is None
            else tuple(constant.name for constant in separated.constants),
            equations={}
            if separated is None
            else {
                system.names[j]: writer.equation(e, form, H)
                for j, e in sorted(separated.equations.items())
            },
            derivatives=None
            if separated is None
            else {
                system.names[j]: writer.derivative(e)
                for j, e in sorted(separated.derivatives.items())
            },
            functions={n: parts[0].function for n, parts in closed.items() if not parts[0].where},
            cases={n: parts for n, parts in closed.items() if parts[0].where},
            reason=separation.reason,
        ),
        missing,
    )


def _by_forces_of_time(separation: Separation, found: Driven) -> HamiltonJacobiSection:
    system = separation.system
    constants = tuple(constant.name for constant in found.constants)
    order = (*(n for n in system.order if n not in constants), *constants)
    order = (*order, *(i.name for i in found.integrals))

    def sum_(expression: Expr) -> Expression:
        return shape(expression, order)

    return HamiltonJacobiSection(
        hamiltonian=_hamiltonian(separation),
        energy=separation.E.name,
        separable=True,
        constants=constants,
        derivatives=dict(zip(system.names, map(sum_, found.momenta), strict=True)),
        time_rate=sum_(found.rate),
        of_time=None if found.of_time is None else terms(found.of_time, order, constants),
        integrals={i.name: sum_(force) for i, force in found.integrals.items()},
    )


def _hamiltonian(separation: Separation) -> Expression | None:
    found = separation.derivation
    return hamiltonian_form(found.hamiltonian, Readable(found.dynamics))


def _functions(separation: Separation) -> dict[str, tuple[ElementaryAction, ...]]:
    """W by coordinate, of those that are not cyclic, where it is elementary."""
    system, separated = separation.system, separation.separated
    if separated is None:
        return {}
    found = {
        j: closed_forms(separated.derivatives[j], system.q[j], separation.positive)
        for j in sorted(separated.equations)
    }
    return {
        system.names[j]: tuple(
            _where_finite(form, system.q[j], separation.positive) for form in forms
        )
        for j, forms in found.items()
        if forms
    }


def _where_finite(form: ElementaryAction, x: Symbol, positive: Sequence[Expr]) -> ElementaryAction:
    """Where no constant that it is divided by is 0, as p in p arctan(k x/(p sqrt(...)))."""
    below = [d for d in squares_divided_by(form.terms) if free_of(d, [x, ROOT])]
    known = [*positive, *form.positive]
    return replace(form, positive=(*form.positive, *(d for d in below if sign(d, known) is None)))


class _Writing:
    """Formulas as sums over the constants of the motion."""

    def __init__(self, separation: Separation) -> None:
        system, found = separation.system, separation.separated
        self.E = separation.E
        constants = () if found is None else tuple(c.name for c in found.constants)
        moving = {p.name for p in system.momenta}
        self.order = (*(n for n in system.order if n not in constants), *constants)
        self.leading = moving | set(constants)

    def equation(self, expression: Expr, form: Expression | None, H: Expr | None) -> Expression:
        """H = E itself where it is the equation of one coordinate."""
        if form is None or H is None or is_zero(expression - H + self.E) is not True:
            return self.sum(expression)
        return sum_of((*terms_of(form), Negative(Name(self.E.name))))

    def sum(self, expression: Expr) -> Expression:
        """The shorter of the terms by constants and the whole."""
        by_terms = terms(expression, self.order, self.leading, as_given=True)
        whole = shape(expression, self.order)
        return whole if operation_count(whole) < operation_count(by_terms) - 2 else by_terms

    def function(self, form: ElementaryAction) -> Expression:
        """W with its root written as a sum by the constants, the same in each term."""
        root = Call("sqrt", (self.sum(form.radicand),))
        shaped = [shape(term, self.order) for term in form.terms]
        return Writer(self.order).sum([put_in(term, {Name(ROOT.name): root}) for term in shaped])

    def derivative(self, expression: Expr) -> Expression:
        """A root with its radicand by terms."""
        parts: list[Expression] = []
        for part in sympy.Add.make_args(expression):
            if isinstance(part, sympy.Pow) and part.exp == sympy.S.Half:
                parts.append(Call("sqrt", (self.sum(part.base),)))
            else:
                parts.append(shape(part, self.order))
        return Writer(self.order).sum(parts) if len(parts) > 1 else parts[0]
