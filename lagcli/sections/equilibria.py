"""The equilibria, and whether each is stable."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from lagcli.document import Block, Formula, Paragraph, vanishing
from lagcli.expression import Expression, Name
from lagcli.formatters.json_values import Object, list_or_null, place, plain
from lagcli.problem_data import ExpectEquilibrium
from lagcli.reader.shapes import PLACE, STABILITY, by_coordinate, equation, list_of, record_of
from lagcli.record import replace
from lagcli.sections._expected import expected_of, judged
from lagcli.statements.answers import Answers, EquilibriaSection, Equilibrium
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.plus_minus import once
from lagcli.statements.stability import at_the_limit, holding, stability
from lagcli.statements.wording import (
    State,
    alike_blocks,
    at_special_values,
    capitalized,
    conditions,
    listed,
    none_found,
    repeating,
)

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> EquilibriaSection:
    """Where the generalized forces vanish along what the constraints allow."""
    from lagcli.mechanics.oscillations.small_oscillations import equilibria

    section = equilibria(statements.dynamics)
    if section.everywhere:
        return section
    if section.equilibria is None:
        statements.lacks("the equilibria", section.reason)
    elif not section.complete:
        others = ": other solutions of what is printed" if section.open else ""
        statements.warnings.append(f"there may be equilibria that are not listed{others}")
    return section


def large(statements: LargeStatements) -> EquilibriaSection:
    """They are not derived."""
    statements.lacks("the equilibria")
    return EquilibriaSection(equilibria=None, reason=statements.why_missing)


_NO_VALUE = " Without a value there: "


def blocks(section: EquilibriaSection, _: Answers) -> Iterator[Block]:
    """Word each equilibrium with its stability."""
    if section.everywhere:
        yield Paragraph((f"{capitalized(section.reason)}.",))
    elif section.equilibria is None:
        yield Paragraph((f"Not found: {section.reason}" + (":" if section.open else "."),))
    elif not section.equilibria:
        complete, edge, where = section.complete, section.edge, section.where
        yield none_found("equilibrium", section.unless, complete=complete, edge=edge, where=where)
    for equilibrium, alike in groupby(once(section.equilibria or ()), key=_without_place):
        states = [(each.at, each.on) for each in alike]
        yield from alike_blocks(states)
        yield Paragraph(_stability(equilibrium, states))
    if section.equilibria and section.where:
        yield Paragraph((f"They were sought only{section.where}.",))
    yield from at_special_values("an equilibrium", section)
    if section.periods:
        yield Paragraph(tuple(repeating(section.periods)))
    if section.equilibria and not section.complete:
        yield Paragraph(("There may be others" + (", which solve" if section.open else "."),))
    if section.open and section.equilibria != ():
        yield vanishing(section.open)


def _without_place(equilibrium: Equilibrium) -> Equilibrium:
    return replace(equilibrium, at={})


def _stability(equilibrium: Equilibrium, states: Sequence[State]) -> tuple[str | Formula, ...]:
    parts: list[str | Formula] = []
    if equilibrium.where:
        exist: list[str | Formula] = ["They exist" if len(states) > 1 else "It exists"]
        if states == [({}, None)]:
            exist = ["Any ", *listed(equilibrium.free), " is an equilibrium"]
        parts += [*exist, " where ", *conditions(equilibrium.where), ". "]
    parts += [holding(equilibrium)]
    at = states[0][0] if states else {}
    touching = equilibrium.touching
    parts += stability(equilibrium.verdict, equilibrium.free, equilibrium.on, at, touching)
    parts += [at_the_limit(equilibrium.where, sticking=equilibrium.sticking)]
    for lead, names in ((" Free: ", equilibrium.free), (_NO_VALUE, equilibrium.indeterminate)):
        for position, name in enumerate(names):
            parts += [", " if position else lead, Name(name)]
        parts += ["."] if names else []
    return tuple(parts)


def json(section: EquilibriaSection) -> Object:
    """The list; null where they were not found."""
    return {
        "equilibria": list_or_null(
            section.equilibria, lambda each: _equilibrium(each, section.periods)
        )
    }


def _equilibrium(equilibrium: Equilibrium, periods: Mapping[str, Expression]) -> Object:
    verdict = equilibrium.verdict
    result = place(equilibrium.at, equilibrium.on) | {"stable": verdict.stable}
    if repeated := {name: periods[name] for name in equilibrium.at if name in periods}:
        result["period"] = plain(repeated)
    if equilibrium.where:
        result["condition"] = " and ".join(plain(equilibrium.where))
    if verdict.asymptotic:
        result["asymptotic"] = True
    if verdict.rapid is not None:
        result["averaged"] = plain({"frequency": verdict.rapid, "minimum": verdict.minimum})
    for name in () if verdict.rapid else ("minimum", "hurwitz", "spectrum"):
        found = getattr(verdict, name)
        if found is not None and not (name == "minimum" and verdict.stable):
            result[name] = plain(found)
    if verdict.unstable and verdict.rapid is None:
        result["unstable"] = plain(verdict.unstable)
    for name in ("free", "touching", "indeterminate"):
        if names := getattr(equilibrium, name):
            result[name] = names
    for name in ("sticking", "kinked"):
        if getattr(equilibrium, name):
            result[name] = True
    return result


_EXPECTED = list_of(
    record_of(
        ExpectEquilibrium,
        "an equilibrium",
        at=by_coordinate("the expected place of '{}'", PLACE),
        on=equation("the equation of a family of equilibria", PLACE),
        stable=STABILITY,
    ),
    "a list of places, as in [{at: {x: 0}, stable: yes}]",
)
SECTION = declared(
    globals(),
    heading="Equilibria",
    order=180,
    explained=Explained(title="Equilibria", blocks=step("further:equilibria"), order=20),
    expected=(expected_of("equilibria", _EXPECTED, judged("reductions:equilibria")),),
)
