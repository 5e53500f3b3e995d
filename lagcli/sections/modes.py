"""The small oscillations about each equilibrium."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import groupby
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Formula, Label, Paragraph, Row
from lagcli.expression import (
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PlusMinus,
    Power,
    Product,
    Sum,
)
from lagcli.formatters.json_values import Object, fields_of, list_or_null, place
from lagcli.notation.letters import own
from lagcli.problem_data import Expect
from lagcli.reader.scope import CONSTANTS
from lagcli.reader.shapes import formulas
from lagcli.record import replace
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, ModesOfFrequency, ModesSection
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.plus_minus import is_pair, modes_in_pairs, pairs
from lagcli.statements.wording import alike_blocks, conditions, in_any_direction, real_and_positive

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements) -> ModesSection:
    """From the linear equations about each equilibrium."""
    from lagcli.mechanics.oscillations.small_oscillations import modes

    section = modes(statements.dynamics)
    if section.modes is None:
        statements.lacks("the normal modes", section.reason)
    if section.unshaped:
        statements.lacks("the shapes of some normal modes")
    if open_ := [mode for mode in section.modes or () if mode.is_open]:
        roots = "exponents" if any(mode.damped for mode in open_) else "frequencies"
        statements.lacks(
            f"a closed form of all {roots}", "lagcli explain --also modes has their equation"
        )
    if section.modes and not section.complete:
        statements.warnings.append("there may be equilibria whose normal modes are not listed")
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
        yield Paragraph((f"There are none: {section.reason}.",))
    by_state = pairs(_by_state(section.modes or ()))
    for modes, states in groupby(by_state, key=lambda pair: pair[1]):
        several = [(at, modes[0].on) for at, _ in states]
        one = len(several) == 1 and modes[0].on is None and not is_pair(several[0][0])
        place = "equilibrium" if one else "equilibria"
        what = "Angular frequencies" + " and shapes" * any(mode.shape for mode in modes)
        lead: tuple[str | Formula, ...] = (what,)
        if modes[0].damped:
            s = own("s")
            shapes = " and shapes" * any(mode.shape for mode in modes)
            lead = ("Exponents ", s, " of ", Call("exp", (Product((s, Name("t"))),)), shapes)
        yield from alike_blocks(several, (*lead, f" about the {place} "))
        for mode in modes_in_pairs(modes):
            if rows := tuple(_mode(mode)):
                yield Equations(rows)
            if not rows or mode.is_open:
                yield Paragraph((_without_rows(mode),))
            yield from in_any_direction(mode)
            if mode.shaped_where:
                yield Paragraph(("where ", *conditions(mode.shaped_where), "."))
            for other in mode.more_shapes:
                yield Paragraph(("Also of this frequency, as is every combination:",))
                yield Equations(tuple(_shape(other)))
    if section.modes and not section.complete:
        yield Paragraph(("There may be other equilibria, with modes of their own.",))


def _by_state(
    modes: Sequence[ModesOfFrequency],
) -> Iterator[tuple[Mapping[str, Expression], list[ModesOfFrequency]]]:
    """The modes about each equilibrium, without its state."""
    for (at, _), group in groupby(modes, key=lambda mode: (mode.at, mode.on)):
        yield at, [replace(mode, at={}) for mode in group]


def _where_real(value: Expression) -> str:
    return f"an oscillation where this is {real_and_positive(value)}"


def _mode(mode: ModesOfFrequency) -> Iterator[Row]:
    note = f"{mode.multiplicity} times" if mode.multiplicity > 1 else ""
    omega, delta = own("omega"), own("delta")
    for exponent, count in Counter(mode.exponents).items():
        yield Row(own("s"), exponent, f"{count} times" if count > 1 else "")
    if mode.decay is not None:
        imaginary = PlusMinus(Product((own("i"), omega)))
        damped = mode.decay != ZERO
        yield Row(own("s"), Sum((Negative(delta), imaginary)) if damped else imaginary, note)
        yield from [Row(delta, mode.decay)] if damped else []
        note = ""
    if mode.frequency is not None:
        yield Row(omega, mode.frequency, _where_real(mode.frequency) if mode.open_sign else note)
    elif mode.frequency_squared is not None:
        squared = Power(omega, Number(Fraction(2)))
        sign = "negative: no oscillation" if mode.negative else _where_real(mode.frequency_squared)
        yield Row(squared, mode.frequency_squared, note or sign)
    yield from _shape(mode.shape or {})


def _without_rows(mode: ModesOfFrequency) -> str:
    """What is said of frequencies that are no formulas."""
    if mode.damped:
        others = "the others" if mode.exponents else "them"
        return f"No closed form was found for {others}: lagcli explain has their equation."
    if mode.negative:
        return "No other root ω² is real and positive: the amplitudes of some displacements grow."
    count = "one frequency" if mode.multiplicity == 1 else f"{mode.multiplicity} frequencies"
    return f"No closed form was found for {count}."


def _shape(shape: Mapping[str, Expression]) -> Iterator[Row]:
    for name, part in shape.items():
        yield Row(Label("a", (name,)), part)


def json(section: ModesSection) -> Object:
    """The list; null where they were not found."""
    return {"modes": list_or_null(section.modes, _mode_json)}


def _mode_json(mode: ModesOfFrequency) -> Object:
    result = place(mode.at, mode.on) | fields_of(mode, "frequency")
    if mode.damped:
        result |= fields_of(mode, "decay exponents")
    if mode.frequency is None:
        result |= fields_of(mode, "frequency_squared")
    names = "shape more_shapes multiplicity" if mode.more_shapes else "shape multiplicity"
    return result | fields_of(mode, names)


def compare(check: Expectations, section: ModesSection, expected: Sequence[Expression]) -> Found:
    """They are the angular frequencies about one equilibrium, or those about all of them."""
    if section.modes is None:
        yield check.undecided(["modes"], "no modes were found")
        return
    groups: dict[object, list[Expression]] = {}
    for mode in section.modes:
        frequencies = [] if mode.frequency is None else [mode.frequency] * mode.multiplicity
        groups.setdefault((*mode.at.items(), mode.on), []).extend(frequencies)
    every = [frequency for group in groups.values() for frequency in group]
    yield check.judge_any(
        ["modes"],
        [check.comparison.same_set(found, expected) for found in (every, *groups.values())],
        check.listed(expected),
        check.listed(every),
    )


def wanted(expect: Expect) -> bool:
    """Whether the file states the frequencies, or that none exists."""
    return expect.modes is not None


_EXPECTED = formulas("an expected frequency", CONSTANTS, "write [sqrt(g/l)]")
SECTION = declared(
    globals(),
    heading="Normal modes",
    order=190,
    explained=Explained(
        title="Small oscillations", blocks=step("oscillations:oscillations"), order=30
    ),
    abbreviated=True,
    expected=(expected_of("modes", _EXPECTED, compare, wanted),),
)
