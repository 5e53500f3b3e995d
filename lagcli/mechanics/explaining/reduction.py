"""The step on the reduction by cyclic coordinates and on one degree of freedom."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import cast

from sympy import Expr, S

from lagcli.document import Block, Equations, Label, equations_of, vanishing
from lagcli.expression import Expression, Name, Number, Power, Product, walk
from lagcli.mechanics.averaged import averaged
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, names, says, shows
from lagcli.mechanics.minimal import minimal, with_lagrangian
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.reduction.routh import ALL_CYCLIC, NONE_LEFT
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.record import replace
from lagcli.statements.answers import ReductionSection, Section
from lagcli.statements.motions import OneFreedom, PeriodSeries
from lagcli.statements.plus_minus import once
from lagcli.statements.stability import stability
from lagcli.statements.turning_points import turning_contacts, turning_points, while_contacts_last
from lagcli.statements.wording import (
    POTENTIALS,
    conditions,
    irreducible,
    none_cyclic,
    place_rows,
    used_to_eliminate,
)

_TWICE = "the period is twice the time between the turning points."


def reduction(explainer: Explainer, section: Section) -> Iterator[Block]:
    """Momenta, Routhian, effective potential, equations, and the motion in one coordinate."""
    reduced = cast(ReductionSection, section)
    yield from _cyclic(explainer, reduced)
    if reduced.routhian is None:
        if reduced.reason in (ALL_CYCLIC, NONE_LEFT):
            other = " other" if reduced.reason == ALL_CYCLIC else ""
            yield says(f"No{other} coordinate is left.")
        elif reduced.momenta:
            yield says(f"The reduction was not found: {reduced.reason}.")
        return
    if reduced.reconstruction:
        yield from _routhian(explainer, reduced, reduced.routhian)
    tied = bool(reduced.constraints) and not reduced.momenta
    if (
        reduced.effective_potential is not None
        and not tied
        and not _timed(reduced)
        and (reduced.potential != "V" or reduced.eliminated)
    ):
        whole = explainer.letters.free("R") if reduced.momenta else explainer.letters.L
        yield says("The effective potential is minus ", whole, " where its velocities are 0:")
        yield shows(POTENTIALS[reduced.potential], reduced.effective_potential)
    if reduced.equations and (reduced.momenta or reduced.eliminated):
        one = len(reduced.equations) == 1
        yield says(f"Lagrange's equation{' is' if one else 's are'} then")
        yield equations_of((each.left, each.right) for each in reduced.equations)
    if reduced.one_freedom is not None:
        yield from _one_freedom(reduced.one_freedom, POTENTIALS[reduced.potential])
    yield from averaged_potential(explainer)


def _timed(reduced: ReductionSection) -> bool:
    """Whether the terms linear in the velocities depend on t, so that they give more forces."""
    parts = (node for g in reduced.gyroscopic.values() for node in walk(g))
    return any(node == Name("t") for node in parts)


def _cyclic(explainer: Explainer, reduced: ReductionSection) -> Iterator[Block]:
    cyclic = list(reduced.momenta)
    if reduced.eliminated:
        yield says(*used_to_eliminate(reduced.eliminated), ".")
    if cyclic:
        one = len(cyclic) == 1
        yield says(names(cyclic), " is cyclic, with the constant momentum" if one
                   else " are cyclic, with the constant momenta")  # fmt: skip
        yield equations_of((Name(f"p_{name}"), value) for name, value in reduced.momenta.items())
    elif not reduced.irreducible and reduced.reason != NONE_LEFT:
        none = none_cyclic(reduced.eliminated)
        yield says(f"{none}, so the Routhian is ", explainer.letters.L, ".")
    for name, why in reduced.irreducible.items():
        yield says(*irreducible(name, why, explainer.letters.L))
    if reduced.irreducible and not cyclic:
        yield says("No momentum eliminates a coordinate, so the Routhian is ",
                   explainer.letters.L, ".")  # fmt: skip


def _routhian(
    explainer: Explainer, reduced: ReductionSection, routhian: Expression
) -> Iterator[Block]:
    L, R, cyclic = explainer.letters.L, explainer.letters.free("R"), list(reduced.momenta)
    one = len(cyclic) == 1
    yield says(f"Solved for the {'velocity' if one else 'velocities'} of the cyclic "
               f"coordinate{'s' * (not one)}:")  # fmt: skip
    yield equations_of((Name(name, 1), value) for name, value in reduced.reconstruction.items())
    products = [Product((Name(f"p_{name}"), Name(name, 1))) for name in cyclic]
    terms: list[Part] = [part for each in products for part in (" − ", each)]
    others = "s" * (len(reduced.equations or ()) != 1)
    yield says(f"With {'this' if one else 'these'}, the Routhian ", R, " = ", L, *terms,
               f" is the Lagrangian of the other coordinate{others}:")  # fmt: skip
    yield shows(R, routhian)


def averaged_potential(explainer: Explainer) -> Iterator[Block]:
    """V_eff of the motion averaged over a rapid drive, where there is one; once."""
    if explainer.averaged:
        return
    explainer.averaged = True
    derivation = minimal(explainer.derivation)
    found = averaged(derivation.dynamics)
    if found is None:
        return
    write = explainer.readable.as_written
    yield says(
        *(
            "For ",
            write(found.frequency),
            " large against the frequencies without the drive and a ",
        ),
        "small amplitude of the drive, the motion averaged over its period has the potential "
        "(Landau and Lifshitz, section 30)",
    )
    yield shows(Label("V", ("eff",)), write(found.potential))
    if len(derivation.system.q) == 1 and not RestPoints(derivation.dynamics).points:
        yield from _averaged_equilibria(derivation, found.potential)


def _averaged_equilibria(derivation: Derivation, potential: Expr) -> Iterator[Block]:
    """Where V_eff is stationary, of a drive that leaves no equilibrium."""
    [[mass]], [v] = derivation.dynamics.lagrange.mass_matrix, derivation.system.qdot
    L, parameters = mass * v**2 / 2 - potential, derivation.problem.parameters
    slow = equilibria(with_lagrangian(derivation, [0], L, [S.Zero], parameters).dynamics)
    for each in once(slow.equilibria or ()):
        yield says("The averaged motion has the equilibrium")
        yield Equations(place_rows(each.at, each.on))
        if each.where:
            yield says("It exists for ", *conditions(each.where), ".")
        yield says(
            *stability(replace(each.verdict, potential="V_eff"), each.free, each.on, each.at)
        )


def _one_freedom(motion: OneFreedom, potential: Part) -> Iterator[Block]:
    q, E = Name(motion.coordinate), Name(motion.constant)
    yield says("One coordinate is left, ", q, ". Its energy function is constant:")
    yield shows(E, motion.energy)
    if motion.turning_points is None:
        yield says("Its turning points are the roots of ", potential, " = ", E, ".")
    elif motion.turning_points:
        lead = ("Its turning points are the roots of ", potential, " = ", E, ", where they are ")
        yield from turning_points(motion, lead)
        if motion.turning_finite:
            yield says("for ", *conditions(motion.turning_finite), ".")
        for lower, upper in motion.turning_energies:
            yield says("They are real for ", lower, " ≤ ", E, " ≤ ", upper, ".")
            onwards: list[Part] = [" there is none"]
            if motion.regular:
                onwards = [", ", q, " does not turn back", *while_contacts_last(motion)]
            yield says("For larger ", E, *onwards, ".")
        yield from turning_contacts(motion)
    else:
        yield says("It has no turning point.")
    for each in once(motion.periods):
        yield from _period(each, potential)
        if each.by_energy is not None:
            yield says("As a function of the energy it is, at every amplitude,")
            yield shows(Label("T", ("period",)), each.by_energy)
            if each.energies:
                yield says("for ", *conditions(each.energies), ".")


def _period(each: PeriodSeries, potential: Part) -> Iterator[Block]:
    if each.at:
        yield says("About the minimum of ", potential, " at")
        yield Equations(place_rows(each.at, None))
    elif each.root_of is not None:
        yield says("About a minimum of ", potential, ", where this vanishes,")
        yield vanishing((each.root_of,))
    if each.amplitude:
        a, order = Name(each.amplitude), Number(Fraction(each.order))
        yield says(f"{_TWICE} In terms of ", a, ", half their distance, it is to the order ",
                   Power(a, order), ",")  # fmt: skip
    elif each.isochronous:
        why = "The motion is that of a harmonic oscillator" + " in the arc" * (not each.straight)
        if each.squared:
            length = "distance" if each.straight else "arc"
            why = f"The square of the {length} from a fixed point oscillates harmonically"
        yield says(f"{_TWICE} {why}, so the period is the same at every amplitude:")
    elif each.order:
        yield says(f"{_TWICE} To the order {each.order} in half their distance it is constant:")
    else:
        yield says("the period of small oscillations is")
    yield shows(Label("T", ("period",)), each.period)
    if each.where:
        yield says("for ", *conditions(each.where), ".")
