"""Momenta, the energy function, the Hamiltonian, the canonical equations."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from lagcli.record import replace
from lagcli.statements.answers import (
    CanonicalSection,
    EnergySection,
    HamiltonianSection,
    MomentaSection,
)
from lagcli.verification.examination import Examination
from lagcli.verification.states import State

_DISAGREES = "its printed form does not hold at random states"


def momenta(x: Examination, section: MomentaSection) -> MomentaSection:
    """p_j = dL/dq_j', and which dL/dq_j are 0."""
    names = x.reference.names
    if section.momenta is not None:
        for j, name in enumerate(names):
            p = section.momenta[name]
            if not x.holds(f"the momentum p_{name}", p, lambda s, j=j: s.laws.momenta[j]):  # type: ignore[misc]
                section = replace(section, momenta=None)
                break
    cyclic = tuple(
        name
        for name in section.cyclic
        if x.vanishes(f"that {name} is cyclic", lambda s, n=name: s.laws.slopes[names.index(n)])  # type: ignore[misc]
    )
    if section.momenta is not None and not x.reference.large:
        _all_cyclic(x, cyclic)
    return section if cyclic == section.cyclic else replace(section, cyclic=cyclic)


def _all_cyclic(x: Examination, listed: Sequence[str]) -> None:
    """Note a coordinate that L does not contain and that is not called cyclic."""
    reference = x.reference
    for name, q in zip(reference.names, reference.q, strict=True):
        if name not in listed and x.states():
            slope = reference.by(reference.lagrangian, q)
            values = [s.loose.at(slope) for s in x.states()]
            if all(value == 0 for value in values):
                x.refute("which coordinates are cyclic", f"L does not depend on {name}")


def energy(x: Examination, section: EnergySection) -> EnergySection:
    """h = sum q' p - L, dh/dt on the motion, and h = T + V."""
    h = section.function
    if h is None:
        return section
    what = "the energy function"
    if not x.holds(what, h, lambda s: s.laws.energy):
        return replace(section, function=None, conserved=None, is_total_energy=None, reason="")
    if section.conserved is not None and x.regular:
        place = x.place(h)
        claimed = "that the energy function is " + ("" if section.conserved else "not ")
        if not x.constant(f"{claimed}conserved", section.conserved, lambda s: s.laws.rate(place)):
            section = replace(section, conserved=None, reason="")
    if not _total(x, section.is_total_energy):
        section = replace(section, is_total_energy=None, reason="")
    return section


def _total(x: Examination, claim: bool | None) -> bool:
    kinetic = x.reference.kinetic
    if claim is None or kinetic is None:
        return True
    potential = x.reference.potential
    claimed = f"that the energy function is {'' if claim else 'not '}the total energy"
    return x.constant(claimed, claim, lambda s: s.laws.energy - s.at(kinetic) - s.at(potential))


def hamiltonian(x: Examination, section: HamiltonianSection) -> HamiltonianSection:
    """H(q, dL/dq', t) = h."""
    H = section.hamiltonian
    if H is None or x.holds("the Hamiltonian", H, lambda s: s.phase.energy):
        return section
    return replace(section, hamiltonian=None, reason=_DISAGREES)


def canonical_equations(x: Examination, section: CanonicalSection) -> CanonicalSection:
    """q' = dH/dp, and p' = dL/dq + Q - dD/dq' + sum lambda a."""
    if section.equations is None:
        return section
    pairs = [section.equations[name] for name in x.reference.names]

    def growth(s: State) -> list[arb]:
        if x.reference.of_phase_space:
            return _of_forces(x, s)
        laws = s.laws
        parts = (laws.slopes, laws.applied, laws.total_constraint_force)
        return [a + b + c for a, b, c in zip(*parts, strict=True)]

    holds = x.hold(
        "the canonical equations of the coordinates",
        [pair.q for pair in pairs],
        lambda s: s.phase.by_p,
    ) and x.hold("the canonical equations of the momenta", [pair.p for pair in pairs], growth)
    return section if holds else replace(section, equations=None, reason=_DISAGREES)


def _of_forces(x: Examination, s: State) -> list[arb]:
    """-dH/dq + Q, where no Lagrangian follows from H."""
    forces = [s.at(force) for force in x.reference.forces]
    return [force - slope for force, slope in zip(forces, s.phase.by_q, strict=True)]
