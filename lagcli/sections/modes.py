"""The normal modes about each equilibrium."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from lagcli.answers import Answers, Mode, ModesSection
from lagcli.document import Block, Equations, Label, Paragraph, Row
from lagcli.expression import Expression, Number, Power
from lagcli.formatters.json_values import Object, by_name, place, string, unless_none
from lagcli.letters import own
from lagcli.statements.declaration import Declaration, Told
from lagcli.wording import state_blocks

if TYPE_CHECKING:
    from lagcli.mechanics.explaining.teller import Teller
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> ModesSection:
    """From the linear equations about each equilibrium."""
    from lagcli.mechanics.oscillations.small_oscillations import modes

    section = modes(statements.dynamics)
    if section.modes is None:
        statements.lacks("the normal modes", section.reason)
    return section


def large(statements: LargeStatements) -> ModesSection:
    """They are not derived."""
    statements.lacks("the normal modes")
    return ModesSection(modes=None, reason=statements.why_missing)


def blocks(section: ModesSection, _: Answers) -> Iterator[Block]:
    """Say the modes about each equilibrium: angular frequency and shape."""
    if section.modes is None:
        yield Paragraph((f"Not found: {section.reason}.",))
    elif not section.modes:
        yield Paragraph((f"There is none: {section.reason}.",))
    about: object = None
    for mode in section.modes or ():
        if (mode.at, mode.on) != about:
            about = (mode.at, mode.on)
            place = "equilibrium" if mode.on is None else "equilibria"
            before = f"Angular frequencies and shapes about the {place} "
            yield from state_blocks(mode.at, before, mode.on)
        yield Equations(tuple(_mode(mode)))
        for other in mode.more_shapes:
            yield Paragraph(("Also of this frequency, as is every combination:",))
            yield Equations(tuple(_shape(other)))


def _mode(mode: Mode) -> Iterator[Row]:
    note = f"{mode.multiplicity} times" if mode.multiplicity > 1 else ""
    omega = own("omega")
    if mode.frequency is not None:
        yield Row(omega, mode.frequency, note)
    elif mode.frequency_squared is not None:
        squared = Power(omega, Number(Fraction(2)))
        yield Row(squared, mode.frequency_squared, note or "an oscillation where this is positive")
    yield from _shape(mode.shape or {})


def _shape(shape: Mapping[str, Expression]) -> Iterator[Row]:
    for name, part in shape.items():
        yield Row(Label("a", (name,)), part)


def json(section: ModesSection) -> Object:
    """The list; null where they were not found."""
    found = unless_none(section.modes, lambda each: [_mode_json(m) for m in each])
    return {"modes": found}


def _mode_json(mode: Mode) -> Object:
    result = place(mode.at, mode.on) | {"frequency": string(mode.frequency)}
    if mode.frequency is None:
        result["frequency_squared"] = string(mode.frequency_squared)
    result["shape"] = unless_none(mode.shape, by_name)
    if mode.more_shapes:
        result["more_shapes"] = [by_name(shape) for shape in mode.more_shapes]
    return result | {"multiplicity": mode.multiplicity}


def tell(teller: Teller, section: ModesSection) -> Iterator[Block]:
    """The linear equations and their solution."""
    from lagcli.mechanics.explaining.oscillations import oscillations

    return oscillations(teller, section)


SECTION = Declaration(
    name="modes",
    heading="Normal modes",
    order=190,
    derive=derive,
    blocks=blocks,
    json=json,
    large=large,
    told=Told(title="Small oscillations", blocks=tell, order=30),
)
