"""The second step: T, V and L, and the forces without a potential."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.document import Block, Equations, Label, Row, equations_of
from lagcli.expression import Diff, Name, Negative, Number, Power
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import difference, says, shows

_SQUARE = Number(Fraction(2))


def lagrangian(explainer: Explainer) -> Iterator[Block]:
    """How L comes about."""
    problem, system = explainer.problem, explainer.system
    letters, by_terms = explainer.letters, explainer.readable.by_terms
    if definitions := {**problem.named, **problem.definitions}:
        yield says("The definitions of the file are")
        yield equations_of((Name(n), formula) for n, formula in definitions.items())
    if system.H is not None:
        yield from _hamiltonian(explainer, system.H)
    elif system.T is None or system.V is None:
        yield says("The Lagrangian is given:")
        yield shows(letters.L, by_terms(system.L, as_given=True))
    else:
        if problem.kinetic is None:
            yield from _points(explainer)
        else:
            yield says("The kinetic energy is")
        yield shows(letters.T, by_terms(system.T, as_given=True))
        if is_zero(system.V) is True:
            yield says("There is no potential energy, so the Lagrangian is ", letters.T, ":")
            yield shows(letters.L, by_terms(system.L, as_given=True))
        else:
            yield from _potential(explainer)
            yield says("so that the Lagrangian ", difference(letters.T, letters.V), " is")
            yield shows(letters.L, by_terms(system.L, as_given=True))
    yield from _without_potential(explainer)


def _hamiltonian(explainer: Explainer, H: Expr) -> Iterator[Block]:
    """The transform of Legendre from H to L."""
    system, letters, readable = explainer.system, explainer.letters, explainer.readable
    yield says("The Hamiltonian is given:")
    yield shows(letters.free("H"), readable.as_written(H))
    yield says("Its derivatives with respect to the momenta are the velocities:")
    yield equations_of(
        (name, readable.as_written(simplify(H.diff(p))))
        for name, p in zip(explainer.velocities, system.momenta, strict=True)
    )
    yield says(
        "Solved for the momenta, and substituted into the sum of momentum times velocity over all "
        "coordinates, minus the Hamiltonian, this gives the Lagrangian"
    )
    yield shows(letters.L, readable.by_terms(system.L, as_given=True))


def _points(explainer: Explainer) -> Iterator[Block]:
    """Each particle where it is, and its speed."""
    system, letters = explainer.system, explainer.letters
    still = dict.fromkeys(system.qddot, sympy.S.Zero)
    rows = []
    for particle in system.particles:
        for axis, position in zip("xyz", particle.position, strict=False):
            place = letters.free(f"{axis}_{particle.name}")
            rows.append(Row(place, explainer.readable.as_written(position)))
        if particle.mass is None:
            continue
        speed = sympy.Add(*(system.total_derivative(x) ** 2 for x in particle.position))
        squared = Power(letters.free(f"v_{particle.name}"), _SQUARE)
        rows.append(Row(squared, explainer.readable.by_terms(speed.xreplace(still))))
    yield says("The points have these Cartesian coordinates and squared speeds:")
    yield Equations(tuple(rows))
    yield says("The kinetic energy is the sum of half of each mass times its squared speed:")


def _potential(explainer: Explainer) -> Iterator[Block]:
    V, letters = explainer.system.V, explainer.letters
    assert V is not None
    if free_of(V, explainer.system.qdot):
        yield says("and the potential energy")
    else:
        yield says("and the potential, which depends on the velocities,")
    yield shows(letters.V, explainer.readable.by_terms(V, as_given=True))


def _without_potential(explainer: Explainer) -> Iterator[Block]:
    """Forces without a potential, and dissipation."""
    system, letters = explainer.system, explainer.letters
    if explainer.forced:
        pushed = any(particle.force is not None for particle in system.particles)
        yield says(
            "The applied generalized forces are",
            " (those on points by their virtual work)" if pushed else "",
        )
        yield equations_of(
            (Label("Q", (name,)), explainer.readable.as_written(force))
            for name, force in zip(system.names, system.forces, strict=True)
            if is_zero(force) is not True
        )
    if explainer.damped:
        yield says("Rayleigh's dissipation function is")
        yield shows(letters.D, explainer.readable.by_terms(system.D, as_given=True))
        drag = Negative(Diff(letters.D, letters.velocity))
        along = " along " if len(system.q) == 1 else " along each coordinate "
        yield says("It adds the generalized force ", drag, along, letters.q, ".")
    if any(force.has(sympy.sign) for force in system.applied_forces):
        yield says(
            "Where a force jumps, it takes any value between those on its two sides, as static "
            "friction does: the equations below hold elsewhere."
        )
