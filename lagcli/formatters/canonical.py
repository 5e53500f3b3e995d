"""The wording of Poisson brackets and of canonical transformations."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from lagcli.document import Block, Bracket, Equations, Formula, Heading, Label, Paragraph, Row
from lagcli.expression import Name, Number
from lagcli.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    GeneratingFunction,
    TransformationsSection,
)

_CHECKED = {"exact": "checked exactly", "50 digits": "checked at random states to 50 digits"}
_ONE = Number(Fraction(1))


def bracket_blocks(section: BracketsSection) -> Iterator[Block]:
    """Say the observables, their brackets and their rates."""
    if section.observables:
        yield Equations(tuple(Row(Name(name), f) for name, f in section.observables.items()))
    yield Paragraph(("Poisson brackets, with the sign of {q, p} = 1:",))
    rows = []
    for each in section.brackets:
        left = Bracket(each.left, each.right)
        if each.value is None:
            yield Paragraph((f"{each.name}: not found.",))
        elif each.named is None:
            rows.append(Row(left, each.value))
        else:
            rows.append(Row(left, each.named))
    if rows:
        yield Equations(tuple(rows))
    elif not section.brackets:
        yield Paragraph(("None: the file names no observables and no pairs.",))
    if section.rates:
        yield Paragraph(("Rates on the motion, from the brackets with H:",))
        yield Equations(tuple(Row(Name(name, 1), value) for name, value in section.rates.items()))
    elif section.reason:
        yield Paragraph((f"No rates: {section.reason}.",))


def transformation_blocks(section: TransformationsSection) -> Iterator[Block]:
    """Say of each transformation whether it is canonical, what generates it, and K."""
    if not section.transformations:
        yield Paragraph(("The file gives no transformation.",))
    for each in section.transformations:
        yield Heading(each.name, 2)
        yield Equations(tuple(Row(Name(name), f) for name, f in each.variables.items()))
        yield Paragraph(tuple(_verdict(each)))
        if each.failing:
            yield Equations(
                tuple(Row(Bracket(Name(f.left), Name(f.right)), f.value) for f in each.failing)
            )
        if each.generator is not None:
            yield from _generator(each.generator, each)
        if each.hamiltonian is not None:
            how = each.hamiltonian_verified
            checked = "" if how is None else f", {_CHECKED[how]}"
            yield Paragraph((f"The Hamiltonian in the new variables{checked}:",))
            yield Equations((Row(Label("K"), each.hamiltonian),))
        elif each.reason:
            yield Paragraph((f"The new Hamiltonian was not found: {each.reason}.",))


def _verdict(each: ExaminedTransformation) -> list[str | Formula]:
    checked = "" if each.verified is None else f", {_CHECKED[each.verified]}"
    match each.kind:
        case "canonical":
            return [f"Canonical: the fundamental brackets are preserved{checked}."]
        case "extended canonical":
            assert each.valence is not None
            return [
                "Not canonical, but extended canonical with the valence ",
                each.valence,
                f": each new bracket is that times the old one{checked}.",
            ]
        case "not canonical":
            values = {f.expected for f in each.failing}
            wanted: list[str | Formula] = ["what they should be"]
            if len(values) == 1 and all(isinstance(value, Number) for value in values):
                wanted = [values.pop()]
            plural = "this bracket is" if len(each.failing) == 1 else "these brackets are"
            return [f"Not canonical: {plural} not ", *wanted, "."]
        case None:
            return ["Whether it is canonical is undecided."]


def _generator(generator: GeneratingFunction, each: ExaminedTransformation) -> Iterator[Block]:
    if generator.kind == "F":
        scale: list[str | Formula] = []
        if each.valence is not None and each.valence != _ONE:
            scale = [each.valence, " times "]
        yield Paragraph(
            (
                "At constant time, ",
                *scale,
                "the sum of p dq minus the sum of P dQ is dF with",
            )
        )
        yield Equations((Row(Label("F"), generator.function),))
        return
    label = Label("F", (generator.kind[1],))
    yield Equations((Row(label, generator.function),))
    if generator.generates:
        yield Paragraph((label, " generates it: each of its derivatives was checked."))
    elif generator.generates is None:
        yield Paragraph(("Whether ", label, " generates it is undecided."))
    else:
        yield Paragraph(
            (
                label,
                " does not generate it: its derivatives would make equal",
            )
        )
        yield Equations(tuple(Row(left, right) for left, right in generator.failing))
