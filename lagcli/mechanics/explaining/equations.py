"""The third step: Lagrange's equation of each coordinate, from its partial derivatives."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import is_zero
from lagcli.document import Block, Equations, Heading, Label, Row
from lagcli.expression import Diff, Expression, Name, Negative, Product, Rate, sum_of
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import Part, difference, names, says, shows


def equations(teller: Teller) -> Iterator[Block]:
    """The law, then its terms for each coordinate."""
    yield from _law(teller)
    for index in range(len(teller.system.names)):
        yield from _one(teller, index)


def _law(teller: Teller) -> Iterator[Block]:
    letters, constrained = teller.letters, bool(teller.dynamics.constraints.equations)
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
    if teller.forced:
        right.append(letters.force)
    if teller.damped:
        right.append(Negative(Diff(letters.D, letters.velocity)))
    for equation in teller.dynamics.constraints.equations:
        gradient = Diff(letters.f(equation.name), _variable(letters.q, equation))
        right.append(Product((Name(equation.multiplier.name), gradient)))
    yield shows(left, sum_of(right))
    if constrained:
        yield says(*_multipliers(teller))


def _variable(coordinate: Name, equation: ConstraintEquation) -> Name:
    """What f is differentiated by: q for a holonomic constraint, else q'."""
    return coordinate if equation.holonomic else Name(coordinate.name, 1)


def _multipliers(teller: Teller) -> list[Part]:
    found = teller.dynamics.constraints.equations
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


def _one(teller: Teller, index: int) -> Iterator[Block]:
    system, dynamics, readable = teller.system, teller.dynamics, teller.readable
    letters, name = teller.letters, system.names[index]
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
    if teller.damped:
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
