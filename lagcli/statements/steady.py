"""Sentences on steady motions that sections and explanations share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby

from lagcli.document import Block, Paragraph
from lagcli.expression import Name
from lagcli.statements.answers import EquilibriaSection, ModesSection, Section
from lagcli.statements.motions import SteadySection
from lagcli.statements.wording import Part


def other_motions(section: SteadySection) -> Iterator[Paragraph]:
    """That not all steady motions are listed, and where none was sought."""
    if section.where:
        yield Paragraph((f"They were sought only{section.where}.",))
    if section.complete:
        return
    parts: list[Part] = []
    for each in section.singular_where:
        parts += [" or " if parts else ", as where ", each, " = 0"]
    parts += [": the coordinates are singular there"] if parts else []
    yield Paragraph(("There may be others", *parts, "."))


def in_moving_frames(section: SteadySection) -> Iterator[Paragraph]:
    """That all move along at a common velocity, too."""
    lead = "The same at any constant "
    if len(section.motions or ()) > 1:
        lead = "All of these motions are possible at any constant "
    for rates in section.frames:
        parts: list[Part] = []
        for rate, pairs in groupby(rates.items(), key=lambda pair: pair[1]):
            parts += [", " if parts else lead]
            parts += [part for name, _ in pairs for part in (Name(name, 1), " = ")]
            parts += [rate]
        yield Paragraph(
            (*parts, ": the equations of motion hold in a frame with this velocity, too.")
        )


def in_polar_coordinates(section: SteadySection) -> Iterator[Paragraph]:
    """That steady rotations are found in other coordinates."""
    if section.plane:
        x, y = map(Name, section.plane)
        lead = "The system is symmetric under rotations of ("
        rest = "Steady rotations are found in polar coordinates, whose angle is cyclic."
        yield Paragraph((lead, x, ", ", y, f") about the origin. {rest}"))


def the_equilibria(section: SteadySection, stated: Mapping[str, Section]) -> Iterator[Block]:
    """One sentence where the steady motions stand above as equilibria, with their modes."""
    rest, motions = stated.get("equilibria"), section.motions or ()
    others = section.momenta, section.eliminated, section.frames, section.plane, section.resting
    modes = stated.get("modes")
    if not motions or any(others) or not (isinstance(modes, ModesSection) and modes.modes):
        return
    known = rest.equilibria if isinstance(rest, EquilibriaSection) else None
    regular = [each for each in known or () if not each.indeterminate]
    states, places = ([(x.at, x.on, x.free) for x in each] for each in (motions, regular))
    if all(x in places for x in states) and all(x in states for x in places):
        lead = "No coordinate can be eliminated by a constant momentum"
        yield Paragraph((f"{lead}: in these coordinates the steady motions are the equilibria.",))
