"""The last steps: the energy function and the other charges, each with its reason."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.document import Block, Equations, Heading, Label, Row
from lagcli.expression import Diff, Name, Product
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import Part, says, shows
from lagcli.mechanics.noether import NoetherCharge


def energy(teller: Teller) -> Iterator[Block]:
    """What h is, whether it is the energy, whether it stays."""
    function, letters = teller.derivation.energy, teller.letters
    momentum = Diff(letters.L, letters.velocity)
    product = Product((letters.velocity, momentum))
    yield says(
        "The energy function is the sum of " if letters.several else "The energy function is ",
        product,
        " over all coordinates, less " if letters.several else ", less ",
        letters.L,
        ":",
    )
    yield shows(letters.h, teller.readable.by_terms(function.readable_function, as_given=True))
    yield says(*_total(teller))
    yield from _rate(teller)
    if not teller.dynamics.degenerate:
        yield says(
            "The Hamiltonian is ",
            letters.h,
            " with the velocities expressed by the momenta. What was said of ",
            letters.h,
            " is true of it as well.",
        )


def _total(teller: Teller) -> list[Part]:
    system, letters = teller.system, teller.letters
    function = teller.derivation.energy
    h, T, V = letters.h, letters.T, letters.V
    if system.T is None or system.V is None:
        return [
            "Only ",
            letters.L,
            " is given, so nothing is said of ",
            Label("T"),
            " + ",
            Label("V"),
            ".",
        ]
    plain = free_of(system.V, system.qdot)
    doubled = sympy.Add(*(v * system.T.diff(v) for v in system.qdot)) - 2 * system.T
    quadratic = is_zero(doubled) is True
    if function.is_total_energy:
        if is_zero(system.V) is True:
            return ["It is the kinetic energy, which is all the energy there is."]
        if not (plain and quadratic):
            return ["It is the total energy ", T, " plus ", V, "."]
        return [
            T, " is of second degree in the velocities and ", V, " contains none, so ", h,
            " is the total energy, ", T, " plus ", V, ".",
        ]  # fmt: skip
    reasons: list[Part] = []
    if not quadratic:
        reasons += [T, " is not purely of second degree in the velocities"]
    if not plain:
        reasons += [" and " if reasons else "", V, " contains velocities"]
    undecided = function.is_total_energy is None
    verdict = "whether it is the total energy was not decided" if undecided else (
        "so it is not the total energy" if reasons else "it is not the total energy"
    )  # fmt: skip
    return [*reasons, ", " if reasons else "", f"{verdict}."]


def _rate(teller: Teller) -> Iterator[Block]:
    function, letters = teller.derivation.energy, teller.letters
    h = letters.h
    if not function.powers:
        yield says(
            letters.L,
            " does not contain the time, no applied force does work and no constraint moves. So ",
            h,
            " is conserved.",
        )
        return
    changes: list[Part] = []
    for power in function.powers:
        changes += ["; "] if changes else []
        changes += [letters.L, " ", power.deed] if power.of_lagrangian else [power.deed]
    total = sympy.Add(*(power.value for power in function.powers))
    yield says("What changes it: ", changes, ". Its rate is")
    yield shows(Name(h.name, 1), teller.readable.by_terms(total))
    if function.conserved is None:
        yield says("Whether this vanishes on the motion was not decided.")
    elif function.conserved:
        yield says("On the motion this is 0, so ", h, " is conserved all the same.")
    else:
        rate = function.rate
        if rate is not None and not total.free_symbols.isdisjoint(teller.system.multipliers):
            yield says("With the multipliers put in it is")
            yield shows(Name(h.name, 1), teller.readable.on_surface(rate))
        yield says("This is not 0 on every motion: ", h, " is not conserved.")


def charges(teller: Teller) -> Iterator[Block]:
    """Momenta of cyclic coordinates, and the charges of the candidates."""
    for charge in teller.derivation.noether.charges:
        if charge.source == "cyclic":
            yield from _cyclic(teller, charge)
        elif charge.source == "candidate":
            yield from _candidate(teller, charge)


def _cyclic(teller: Teller, charge: NoetherCharge) -> Iterator[Block]:
    system, letters = teller.system, teller.letters
    index = list(charge.transformation.changes).index(sympy.S.One)
    name = system.names[index]
    q, v, p = Name(name), Name(name, 1), Name(f"p_{name}")
    right = sympy.Add(
        system.applied_forces[index],
        *(e.multiplier * e.row[index] for e in teller.dynamics.constraints.equations),
    )
    nothing = is_zero(right) is True
    yield Heading("The momentum of", 2, q)
    yield says(
        q,
        " does not occur in ",
        letters.L,
        ", so by Lagrange's equation for it the momentum ",
        Diff(letters.L, v),
        " changes only by what acts along ",
        q,
        ". Nothing does:" if nothing and charge.conserved else ". This is",
    )
    if not nothing:
        yield shows(Name(p.name, 1), teller.readable.by_terms(right))
    if charge.conserved is None:
        yield says("Whether that vanishes on the motion was not decided.")
        return
    if charge.conserved:
        if not nothing:
            yield says("which is 0 on the motion. So this is conserved:")
    else:
        rate = charge.rate
        if rate is not None and not right.free_symbols.isdisjoint(teller.system.multipliers):
            yield says("and with the multipliers put in")
            yield shows(Name(p.name, 1), teller.readable.on_surface(rate))
        yield says("so it is not conserved:")
    yield shows(p, teller.readable.by_terms(charge.charge), _stays(charge))


def _stays(charge: NoetherCharge) -> str:
    return "constant" if charge.conserved else "not conserved"


def _candidate(teller: Teller, charge: NoetherCharge) -> Iterator[Block]:
    letters, write = teller.letters, teller.readable.as_written
    change = charge.transformation
    yield Heading(charge.name, 2)
    yield says("The file asks about the transformation")
    named = [*zip(teller.system.names, change.changes, strict=True), ("t", change.time)]
    rows = [Row(Label(name, change=True), write(by)) for name, by in named if by != 0]
    yield Equations(tuple(rows))
    gauge = charge.gauge
    changed = teller.derivation.noether.change_of_action(change)
    boundary = sympy.S.Zero if gauge is None else gauge
    same = is_zero(changed - teller.system.total_derivative(boundary)) is True
    if gauge is None:
        yield says(
            "Under it the action changes, and no boundary term was found that accounts for the "
            "change."
        )
    elif is_zero(gauge) is True and same:
        yield says("Under it the action does not change: it is a symmetry of ", letters.L, ".")
    elif is_zero(gauge) is True and not same and not charge.conserved:
        yield says("Under it the action changes, and by no boundary term alone.")
    elif gauge is not None:
        on_motion = "" if same else " on the motion" if charge.conserved else " and something more"
        yield says(
            "Under it the action changes by more than the total time derivative of"
            if on_motion.startswith(" and")
            else f"Under it the action changes only by a boundary term,{on_motion} the total time "
            "derivative of"
        )
        yield shows(letters.G, write(gauge))
    yield says(*noether_words(teller, with_gauge=bool(boundary != 0), with_time=change.time != 0))
    yield shows(letters.Q, teller.readable.by_terms(charge.charge), _stays(charge)
                if charge.conserved is not None else "")  # fmt: skip
    if charge.conserved is None:
        yield says("Whether it is conserved was not decided.")
    elif charge.conserved:
        if teller.forced or teller.damped or teller.dynamics.constraints.equations:
            yield says("What acts beside ", letters.L, " does no work along this transformation.")
    else:
        yield says(f"It is not conserved, broken by {charge.broken_by}:")
        if charge.rate is not None:
            yield shows(Name(letters.Q.name, 1), teller.readable.on_surface(charge.rate))


def noether_words(teller: Teller, *, with_gauge: bool, with_time: bool) -> list[Part]:
    """What Q is made of."""
    letters = teller.letters
    momentum = Diff(letters.L, letters.velocity)
    change, delay = Label(letters.q.name, change=True), Label("t", change=True)
    several = letters.several
    parts: list[Part] = ["Noether's charge is ", "the sum of " if several else "", momentum]
    if with_time:
        parts += [" times (", change, " − ", letters.velocity, " ", delay, ")"]
    else:
        parts += [" times ", change]
    if several:
        parts.append(" over all coordinates")
    if with_time:
        parts += [", plus ", letters.L, " ", delay]
    if with_gauge:
        parts += [", less ", letters.G]
    return [*parts, ":"]
