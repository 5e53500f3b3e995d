"""Motions with the cyclic coordinates at constant rates, and their stability."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from lagcli.document import (
    Block,
    Equations,
    Formula,
    Heading,
    Paragraph,
    Row,
    equations_of,
    vanishing,
)
from lagcli.expression import Name, Number, Power
from lagcli.formatters.json_values import Object, fields_of, list_or_null, place
from lagcli.notation.letters import own
from lagcli.problem_data import ExpectSteady
from lagcli.reader.shapes import (
    STABILITY,
    by_coordinate,
    formulas,
    list_of,
    record_of,
    with_constants,
)
from lagcli.sections._expected import expected_of, judged
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.motions import SteadyMotion, SteadySection
from lagcli.statements.plus_minus import mirror_images, single, steady_in_pairs, unlike
from lagcli.statements.stability import steady_stability
from lagcli.statements.steady import (
    in_moving_frames,
    in_polar_coordinates,
    other_motions,
    the_equilibria,
)
from lagcli.statements.wording import (
    at_special_values,
    capitalized,
    conditions,
    constraints_give,
    linear_equations,
    listed,
    none_found,
    other_places,
    place_rows,
)

if TYPE_CHECKING:
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> SteadySection:
    """The motions of constant cyclic velocities, with their stability."""
    from lagcli.mechanics.steady.statement import steady_motions

    section = statements.noted(steady_motions(statements.derivation))
    if section.motions and not section.complete:
        statements.warnings.append("there may be steady motions that are not listed")
    if section.motions and section.where:
        statements.warnings.append(f"steady motions were sought only{section.where}")
    return section


def blocks(section: SteadySection, answers: Answers) -> Iterator[Block]:
    """Say the conditions, then each steady motion; equilibria that stand above are not repeated."""
    if found := [*the_equilibria(section, answers.sections)]:
        yield from found
        return
    if section.eliminated:
        yield Paragraph(
            (
                constraints_give(section.eliminated),
                *listed(section.eliminated, 1),
                " in terms of the other velocities.",
            )
        )
    if section.conditions:
        wanted = unlike(section.conditions.values())
        held = "The conditions of a steady motion hold everywhere."
        here = " in these coordinates" * bool(section.plane)
        lead = "A state of rest" if section.resting else f"A steady motion{here}"
        yield Paragraph((f"{lead} has" if wanted else held,))
        if wanted:
            yield vanishing(wanted)
    yield from in_polar_coordinates(section)
    if section.everywhere:
        yield Paragraph((f"{capitalized(section.reason)}.",))
        yield from in_moving_frames(section)
        return
    if section.motions is None:
        yield Paragraph((f"Not found: {section.reason}.",))
        return
    if not section.motions:
        complete, where = section.complete, section.sought
        yield none_found("steady motion", section.unless, complete=complete, where=where)
    for number, group in enumerate(mirror_images(steady_in_pairs(section.motions)), 1):
        yield Heading(f"Steady motion {number}", 2)
        yield from _motion(group[0], group[1:])
    yield from in_moving_frames(section)
    if section.motions:
        yield from other_motions(section)
        yield from at_special_values("one of a steady motion", section)


def _motion(motion: SteadyMotion, alike: Sequence[SteadyMotion] = ()) -> Iterator[Block]:
    rows = [*place_rows(motion.at, motion.on)]
    rates = motion.rates or {}
    rows += [Row(Name(name, 1), value) for name, value in rates.items() if value != Name(name, 1)]
    rows += [
        Row(Name(f"p_{name}"), value)
        for name, value in motion.momenta.items()
        if value != Name(f"p_{name}")
    ]
    if rows:
        yield Equations(tuple(rows))
    yield from other_places(motion, alike)
    parts = [*_any_value(motion)]
    if motion.where:
        at_rest = "; at equality at rest" if motion.rests else ""
        parts += ["where ", *conditions(motion.where), f"{at_rest}. "]
    if motion.mirrored:
        parts += ["Also with the opposite rates and momenta."]
    if motion.rates is None:
        parts += ["The axes of the cyclic coordinates coincide here."]
    if parts:
        yield Paragraph(tuple(parts))
    yield Paragraph(tuple(steady_stability(motion)))
    squares = single(dict.fromkeys(motion.frequencies_squared))
    if squares:
        squared = Power(own("omega"), Number(Fraction(2)))
        yield equations_of((squared, square) for square in squares)
        if motion.may_be_complex:
            yield Paragraph(("Where this is not real, displacements oscillate and grow.",))
    if len(motion.mass) > 1:
        matrices = (motion.mass, motion.velocity, motion.stiffness)
        yield from linear_equations("To first order, ", *matrices, end=":")


def _any_value(motion: SteadyMotion) -> list[str | Formula]:
    parts: list[str | Formula] = []
    for position, name in enumerate(motion.free):
        variable = name.rstrip("'")
        parts += [", " if position else "For any ", Name(variable, len(name) - len(variable))]
    return [*parts, "; " if motion.where else ". "] if parts else []


def json(section: SteadySection) -> Object:
    """The motions; null where they were not found."""
    return {"steady_motions": list_or_null(section.motions, _motion_json)}


def _motion_json(motion: SteadyMotion) -> Object:
    verdict = motion.verdict
    return (
        place(motion.at, motion.on)
        | fields_of(motion, "free rates momenta where mirrored")
        | fields_of(verdict, "stable asymptotic minimum hurwitz spectrum unstable")
        | fields_of(motion, "frequencies_squared mass velocity stiffness")
        | {"reason": verdict.reason.replace("{V}", verdict.potential)}
    )


_EXPECTED = with_constants(
    list_of(
        record_of(
            ExpectSteady,
            "a steady motion",
            at=by_coordinate("the expected at of '{}'"),
            rates=by_coordinate("the expected rates of '{}'"),
            momenta=by_coordinate("the expected momenta of '{}'"),
            frequencies_squared=formulas("an expected square of a frequency"),
            stable=STABILITY,
        )
    )
)
SECTION = declared(
    globals(),
    heading="Steady motions",
    order=210,
    explained=Explained(title="Steady motions", blocks=step("steady:steady"), order=50),
    content="motions",
    abbreviated=True,
    expected=(expected_of("steady_motions", _EXPECTED, judged("reductions:steady_motions")),),
)
