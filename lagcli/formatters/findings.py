"""The wording of symmetries, answers to questions, equilibria and modes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from lagcli.answers import (
    Charge,
    ChargesSection,
    EquilibriaSection,
    Equilibrium,
    Mode,
    ModesSection,
)
from lagcli.document import (
    Block,
    Equations,
    Formula,
    Heading,
    Label,
    Paragraph,
    Row,
)
from lagcli.expression import ZERO, Expression, Name, Number, Power, operation_count
from lagcli.letters import own
from lagcli.questions import FindSection, Range, Ranges, Rewritten, Solutions
from lagcli.wording import conditions, holding, place_rows, stability

_SOURCES = {
    "candidate": "candidate",
    "cyclic": "cyclic coordinate",
    "time": "translation in time",
    "discovered": "discovered",
    "momentum equation": "momentum equation",
}

#: A value with so many operations stands within a sentence.
_SHORT = 3
_SHORT_RELATION = 12

_CHECKED = {
    "exact": ", checked exactly",
    "50 digits": ", checked at random states to 50 digits",
    None: "",
}


def charge_blocks(section: ChargesSection) -> Iterator[Block]:
    """Say what each symmetry changes, its gauge, its charge, and whether that is conserved."""
    if not section.charges:
        yield Paragraph(("None." if section.sought else "Not found.",))
    for charge in section.charges:
        yield Heading(f"{charge.name} ({_SOURCES[charge.source]})", 2)
        rows = [
            Row(Label(name, change=True), change) for name, change in charge.transformation.items()
        ]
        if charge.gauge is not None and charge.gauge != ZERO:
            rows.append(Row(Label("G"), charge.gauge, "gauge"))
        if charge.charge is not None:
            rows.append(Row(Label("Q"), charge.charge))
        if charge.rate is not None and not charge.conserved:
            rows.append(Row(own("Q", 1), charge.rate))
        if rows:
            yield Equations(tuple(rows))
        yield Paragraph((_verdict(charge),))
        if charge.where:
            rest = "; elsewhere its real and its imaginary part are conserved."
            yield Paragraph(("Real where ", *conditions(charge.where), rest))


def _verdict(charge: Charge) -> str:
    checked = _CHECKED[charge.verified]
    if charge.conserved:
        when = f" {charge.when}" if charge.when else ""
        return f"Conserved{when}: dQ/dt = 0 on the motion{checked}."
    if charge.conserved is None:
        words = "Whether it is conserved is undecided"
        return f"{words}: {charge.broken_by}." if charge.broken_by else f"{words}."
    if charge.source == "momentum equation":
        return f"Not conserved: its rate is the momentum equation{checked}."
    words = f"Not conserved{checked}"
    return f"{words}, because of {charge.broken_by}." if charge.broken_by else f"{words}."


def find_blocks(section: FindSection) -> Iterator[Block]:
    """Say each question of the file with its answer."""
    for name, answer in section.answers.items():
        yield Heading(name, 2)
        match answer:
            case Solutions(solutions=None) | Ranges(ranges=None):
                yield Paragraph(("Not found.",))
            case Rewritten(value=None, values=()):
                yield Paragraph(("Not found.",))
            case Rewritten(values=tuple(values), subject=subject) if values:
                left = Label(name) if subject is None else subject
                yield Equations(tuple(Row(left, value) for value in values))
            case Solutions(solutions=()):
                yield Paragraph(("There is no solution that the motion can reach.",))
            case Solutions(unknown=unknown, solutions=tuple(solutions)):
                variable = unknown.rstrip("'")
                left = Name(variable, len(unknown) - len(variable))
                yield Equations(tuple(Row(left, root) for root in solutions))
            case Rewritten(value=value, subject=subject) if value is not None:
                yield Equations((Row(Label(name) if subject is None else subject, value),))
            case Ranges(unknown=unknown, ranges=tuple(ranges)):
                yield Paragraph(_ranges(unknown, ranges))
        if answer.note:
            yield Paragraph((f"{answer.note[0].upper()}{answer.note[1:].rstrip('.')}.",))


def bounds_of(range_: Range) -> list[tuple[str, Expression]]:
    """The bounds of a range, each with how the unknown compares with it."""
    bounds = []
    if range_.lower is not None:
        bounds.append((">=" if range_.lower_included else ">", range_.lower))
    if range_.upper is not None:
        bounds.append(("<=" if range_.upper_included else "<", range_.upper))
    return bounds


_SIGNS = {">=": " ≥ ", ">": " > ", "<=": " ≤ ", "<": " < "}
_TURNED = {">=": " ≤ ", ">": " < "}


def _ranges(unknown: str, ranges: Sequence[Range]) -> tuple[str | Formula, ...]:
    """`a < v ≤ b, or v ≥ c`."""
    if not ranges:
        return ("For no value of ", Name(unknown), ".")
    parts: list[str | Formula] = []
    for range_ in ranges:
        bounds = bounds_of(range_)
        parts += [", or "] if parts else []
        if not bounds:
            return ("For every value of ", Name(unknown), ".")
        if range_.lower == range_.upper:
            bounds = [("=", bounds[0][1])]
        if len(bounds) == 2:
            parts += [bounds[0][1], _TURNED[bounds[0][0]]]
        how, bound = bounds[-1]
        parts += [Name(unknown), _SIGNS.get(how, " = "), bound]
    return (*parts, ".")


_NO_VALUE = " Without a value there: "


def equilibrium_blocks(section: EquilibriaSection) -> Iterator[Block]:
    """Word each equilibrium with its stability."""
    if section.equilibria is None:
        yield Paragraph((f"Not found: {section.reason}.",))
    elif not section.equilibria:
        yield Paragraph(("There is none.",))
    for equilibrium in section.equilibria or ():
        yield from state_blocks(equilibrium.at, on=equilibrium.on)
        yield Paragraph(_stability(equilibrium))
    if section.equilibria is not None and not section.complete:
        yield Paragraph(("There may be others.",))


def state_blocks(
    at: Mapping[str, Expression],
    before: str = "",
    on: tuple[Expression, Expression] | None = None,
) -> Iterator[Block]:
    """A state, or a family: on one line where its values are short, else as equations."""
    rows = place_rows(at, on)
    short = on is None or sum(map(operation_count, on)) <= _SHORT_RELATION
    if short and all(operation_count(value) <= _SHORT for value in at.values()):
        parts: list[str | Formula] = [before]
        for position, row in enumerate(rows):
            parts += [", " if position else "", row.left, " = ", row.right]
        if rows:
            yield Paragraph((*parts, ":"))
        return
    if before:
        yield Paragraph((before,))
    yield Equations(rows)


def _stability(equilibrium: Equilibrium) -> tuple[str | Formula, ...]:
    parts: list[str | Formula] = []
    if equilibrium.where:
        parts += ["It exists where ", *conditions(equilibrium.where), ". "]
    parts += [holding(equilibrium.touching, sticking=equilibrium.sticking)]
    parts += stability(equilibrium.verdict, equilibrium.free, equilibrium.on)
    for lead, names in ((" Free: ", equilibrium.free), (_NO_VALUE, equilibrium.indeterminate)):
        for position, name in enumerate(names):
            parts += [", " if position else lead, Name(name)]
        parts += ["."] if names else []
    return tuple(parts)


def mode_blocks(section: ModesSection) -> Iterator[Block]:
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
