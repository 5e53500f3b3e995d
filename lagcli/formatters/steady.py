"""The wording of steady motions and their stability."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from lagcli.document import (
    Block,
    Equations,
    Formula,
    Heading,
    Label,
    Matrix,
    Paragraph,
    Row,
)
from lagcli.expression import ZERO, Expression, Name, Number, Power
from lagcli.formatters.conditions import conditions
from lagcli.formatters.reductions import POTENTIAL
from lagcli.motions import SteadyMotion, SteadySection

_SQUARED = Power(Name("omega"), Number(Fraction(2)))


def steady_blocks(section: SteadySection) -> Iterator[Block]:
    """Say the conditions, then each steady motion."""
    if section.conditions:
        yield Paragraph(("A steady motion has",))
        yield Equations(tuple(Row(ZERO, value) for value in section.conditions.values()))
    if section.motions is None:
        yield Paragraph((f"Not found: {section.reason}.",))
        return
    if not section.motions:
        yield Paragraph(("There is none.",))
    for number, motion in enumerate(section.motions, 1):
        yield Heading(f"Steady motion {number}", 2)
        yield from _motion(motion)
    if not section.complete:
        yield Paragraph(("There may be others.",))


def _motion(motion: SteadyMotion) -> Iterator[Block]:
    rows = [Row(Name(name), value) for name, value in motion.at.items()]
    rates = motion.rates or {}
    rows += [Row(Name(name, 1), value) for name, value in rates.items() if value != Name(name, 1)]
    rows += [
        Row(Name(f"p_{name}"), value)
        for name, value in motion.momenta.items()
        if value != Name(f"p_{name}")
    ]
    if rows:
        yield Equations(tuple(rows))
    parts = [*_any_value(motion)]
    if motion.where:
        parts += ["where ", *conditions(motion.where), ". "]
    if motion.mirrored:
        parts += ["Also with the opposite rates and momenta."]
    if motion.rates is None:
        parts += ["The axes of the cyclic coordinates coincide here."]
    if parts:
        yield Paragraph(tuple(parts))
    yield Paragraph(_stability(motion))
    squares = dict.fromkeys(motion.frequencies_squared)
    if squares:
        yield Equations(tuple(Row(_SQUARED, square) for square in squares))
    if len(motion.mass) > 1:
        yield from _linearized(motion)


def _any_value(motion: SteadyMotion) -> list[str | Formula]:
    parts: list[str | Formula] = []
    for position, name in enumerate(motion.free):
        variable = name.rstrip("'")
        parts += [", " if position else "For any ", Name(variable, len(name) - len(variable))]
    return [*parts, "; " if motion.where else ". "] if parts else []


def _stability(motion: SteadyMotion) -> tuple[str | Formula, ...]:
    parts: list[str | Formula]
    if motion.stable:
        return ("Stable: ", POTENTIAL, " has a minimum (Lagrange and Dirichlet).")
    if motion.stable is False:
        return ("Unstable: a root of the characteristic equation has a positive real part.",)
    parts = []
    if motion.minimum:
        parts += ["Stable, with a minimum of ", POTENTIAL, ", where "]
        parts += [*conditions(motion.minimum), ". "]
    if motion.spectrum is not None:
        always = not motion.spectrum
        parts += ["Stable to first order by gyroscopic terms, without a minimum of ", POTENTIAL]
        parts += ["." if always else ", where ", *conditions(motion.spectrum)]
        parts += [] if always else ["; unstable where one of these is reversed."]
    elif len(motion.minimum or ()) == 1 and not motion.reason:
        parts += ["Unstable where this is reversed."]
    if motion.reason or not parts:
        parts += [f"Otherwise undecided: {motion.reason}." if parts else "Stability undecided"]
        if len(parts) == 1:
            parts += [f": {motion.reason}." if motion.reason else "."]
    return tuple(parts)


def _linearized(motion: SteadyMotion) -> Iterator[Block]:
    names = tuple(str(n) for n in range(1, len(motion.mass) + 1))
    yield Paragraph(
        ("To first order, M · accelerations + C · velocities + K · displacements = 0:",)
    )
    pairs: tuple[tuple[str, tuple[tuple[Expression, ...], ...]], ...] = (
        ("M", motion.mass),
        ("C", motion.velocity),
        ("K", motion.stiffness),
    )
    for letter, entries in pairs:
        yield Matrix(Label(letter, matrix=True), entries, names, names)
