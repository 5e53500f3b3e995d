"""The third step: Lagrange's equation of each coordinate, from its partial derivatives."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import is_zero
from lagcli.document import Block, Equations, Heading, Label, Row
from lagcli.expression import Diff, Expression, Name, Negative, Product, Rate, sum_of
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, difference, names, says, shows


def equations(explainer: Explainer) -> Iterator[Block]:
    """The law, then its terms for each coordinate."""
    yield from _law(explainer)
    for index in range(len(explainer.system.names)):
        yield from _one(explainer, index)


def _law(explainer: Explainer) -> Iterator[Block]:
    letters, constrained = explainer.letters, bool(explainer.dynamics.constraints.equations)
    kind = "first kind (with multipliers)" if constrained else "second kind"
    if letters.several:
        yield says(
            f"Lagrange's equations of the {kind} are, for each coordinate ",
            letters.q,
            ",",
        )
    else:
        yield says(f"Lagrange's equation of the {kind} is")
    L = letters.L
    left = difference(Rate(Diff(L, letters.velocity)), Diff(L, letters.q))
    right: list[Expression] = []
    if explainer.forced:
        right.append(letters.force)
    if explainer.damped:
        right.append(Negative(Diff(letters.D, letters.velocity)))
    for equation in explainer.dynamics.constraints.equations:
        gradient = Diff(letters.f(equation.name), _variable(letters.q, equation))
        right.append(Product((Name(equation.multiplier.name), gradient)))
    yield shows(left, sum_of(right))
    if constrained:
        yield says(*_multipliers(explainer))


def _variable(coordinate: Name, equation: ConstraintEquation) -> Name:
    """What f is differentiated by: q for a holonomic constraint, else q'."""
    return coordinate if equation.holonomic else Name(coordinate.name, 1)


def _multipliers(explainer: Explainer) -> list[Part]:
    found = explainer.dynamics.constraints.equations
    one = len(found) == 1
    words: list[Part] = [
        "The constraint adds its force: its gradient times the multiplier "
        if one
        else "Each constraint adds its force: its gradient times its multiplier. The multipliers ",
        *names(e.multiplier.name for e in found),
        ", which is not known yet." if one else " are not known yet.",
    ]
    if any(not e.holonomic for e in found):
        words.append(
            " The gradient of a constraint on velocities is taken with respect to the velocities: "
            "its coefficients, which determine the displacements that it allows."
        )
    return words


def _one(explainer: Explainer, index: int) -> Iterator[Block]:
    system, dynamics, readable = explainer.system, explainer.dynamics, explainer.readable
    letters, name = explainer.letters, system.names[index]
    q, v = Name(name), Name(name, 1)
    momentum = dynamics.lagrange.momenta[index]
    force = dynamics.lagrange.lagrangian_forces[index]
    if letters.several:
        yield Heading("The equation for", 2, q)
    else:
        yield says("Its terms are")
    rows = [
        Row(Diff(letters.L, q), readable.by_terms(force)),
        Row(Diff(letters.L, v), readable.by_terms(momentum)),
    ]
    if is_zero(momentum) is not True:
        rate = readable.by_terms(system.total_derivative(momentum))
        rows.append(Row(Rate(Diff(letters.L, v)), rate))
    if is_zero(system.forces[index]) is not True:
        rows.append(Row(Label("Q", (name,)), readable.as_written(system.forces[index])))
    if explainer.damped:
        drag = system.D.diff(system.qdot[index])
        rows.append(Row(Diff(letters.D, v), readable.by_terms(drag)))
    acting = [e for e in dynamics.constraints.equations if is_zero(e.row[index]) is not True]
    rows += [
        Row(Diff(letters.f(e.name), _variable(q, e)), readable.as_written(e.row[index]))
        for e in acting
    ]
    yield Equations(tuple(rows))
    if is_zero(force) is True:
        yield says(q, " does not occur in ", letters.L, " (it is cyclic). The equation is")
    else:
        yield says("The equation is")
    right = sympy.Add(system.applied_forces[index], *(e.multiplier * e.row[index] for e in acting))
    left = dynamics.lagrange.left_sides[index]
    yield shows(readable.by_terms(left), readable.by_terms(right))
