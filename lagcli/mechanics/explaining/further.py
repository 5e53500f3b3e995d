"""The steps of `--also`: equilibria, small oscillations, reduction, questions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, cast

from sympy import S

from lagcli.algebra import is_zero
from lagcli.document import Block, Equations, Heading, Label, vanishing
from lagcli.expression import Expression
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.recurring import recurring
from lagcli.mechanics.explaining.reduction import averaged_potential
from lagcli.mechanics.explaining.words import (
    Part,
    constraints_allow,
    names,
    no_solution,
    says,
    shows,
)
from lagcli.mechanics.reduction.effective_potential import without_momenta
from lagcli.mechanics.reduction.routh import ALL_CYCLIC, NONE_LEFT
from lagcli.mechanics.statements import Statements
from lagcli.mechanics.stating import TOO_MUCH
from lagcli.mechanics.system import System
from lagcli.platform.effort import OutOfWork
from lagcli.platform.limited import limited_to
from lagcli.statements.answers import EquilibriaSection, Section
from lagcli.statements.explanation import ExplanationStep
from lagcli.statements.plus_minus import once, unlike
from lagcli.statements.registry import find_section
from lagcli.statements.stability import at_the_limit, holding, stability
from lagcli.statements.wording import (
    at_special_values,
    constraints_named,
    place_rows,
    repeating,
    unless,
)
from lagcli.statements.wording import conditions as inequalities

if TYPE_CHECKING:
    from lagcli.mechanics.rest.equilibria import RestPoints

_ABSENT = "This was not found: see the warnings."
_SHARE = 0.9  # of the work that is left: what one step takes too much of is left out alone


def further(explainer: Explainer, also: Sequence[str]) -> tuple[list[ExplanationStep], list[str]]:
    """The steps of these sections, and what was not found on the way."""
    statements = Statements(explainer.derivation)
    steps: list[ExplanationStep] = []
    missing: list[str] = []
    for name in also:
        explained = find_section(name).explained
        if explained is None:
            raise LookupError(f"the section '{name}' has no step in an explanation")
        work = partial(_blocks, explainer, statements, name, explained.blocks)
        try:
            blocks = limited_to(_SHARE, work)
        except OutOfWork:
            blocks = (says(_ABSENT),)
            missing.append(f"the section '{name}' was not explained: {TOO_MUCH}")
        steps.append(ExplanationStep(explained.title, blocks))
    missing += (w for w in statements.warnings if not w.endswith((ALL_CYCLIC, NONE_LEFT)))
    return steps, list(dict.fromkeys(missing))


def _blocks(
    explainer: Explainer,
    statements: Statements,
    name: str,
    explained: Callable[[Explainer, Section], Iterable[Block]],
) -> tuple[Block, ...]:
    section = statements.answers([name]).sections.get(name)
    if section is None:
        return (says(_ABSENT),)
    explainer.stated[name] = section
    return tuple(explained(explainer, section))


# -- equilibria ------------------------------------------------------------------------------------


def _drifting(system: System) -> bool:
    """Whether a momentum depends on t explicitly at rest."""
    still = dict.fromkeys(system.qdot, S.Zero)
    rates = (system.L.diff(v, system.t).xreplace(still) for v in system.qdot)
    return any(is_zero(rate) is not True for rate in rates)


def equilibria(explainer: Explainer, section: Section) -> Iterator[Block]:
    """The conditions of rest, then each equilibrium with its stability."""
    from lagcli.mechanics.rest.equilibria import RestPoints

    states = cast(EquilibriaSection, section)
    found = states.equilibria
    rest = RestPoints(explainer.dynamics)
    constraints = len(explainer.dynamics.constraints.equations)
    timed = rest.growth != 1
    sticking = any(each.sticking for each in found or ())
    solved = () if rest.has_no_value else rest.equations
    conditions = unlike(explainer.readable.as_written(e) for e in solved)
    one = len(conditions) == 1
    end = (
        "."
        if sticking or rest.has_no_value
        else ":"
        if conditions
        else ", which they do everywhere."
    )
    contacts = explainer.system.problem.contacts
    held = _constraints_hold(explainer)
    each_open = "where no contact is closed, " if contacts else ""
    lead = f"{held}{each_open}" if held else each_open.capitalize()
    yield says(
        "At an equilibrium all velocities and accelerations are 0. "
        f"{lead}Lagrange's equations then require that the generalized forces",
        ", less the explicit rates of the momenta," * _drifting(explainer.system),
        *((", divided by ", explainer.readable.as_written(rest.growth), ",") if timed else ()),
        " vanish"
        + f" along every displacement that {constraints_allow(constraints)}" * bool(constraints)
        + end,
    )
    if sticking:
        yield says(
            "Dry friction takes at rest whatever is needed to hold the body, up to its largest "
            "value, in either direction: what it acts on may be at rest in a whole range of places."
        )
    elif conditions:
        yield vanishing(conditions)
    yield from at_special_values("an equilibrium", states)
    if any(each.kinked for each in found or ()):
        yield says("Where a force jumps, it takes every value between those on the two sides.")
    if contacts:
        yield says("Where a contact is closed, it pushes, and this force is added to them.")
    elif any(each.open for each in found or ()):
        yield says("Each contact is either closed, and pushes, or open, and there is no force.")
    if states.at_all_times and found:
        hold = "it holds" if one else "they hold"
        yield says(f"An equilibrium is where {hold} at all times.")
        yield from averaged_potential(explainer)
    still = explainer.system.L.xreplace(dict.fromkeys(explainer.system.qdot, S.Zero))
    verdicts = [each.verdict for each in found or () if not each.verdict.neutral]
    named = any(each.potential == "V_eff" for each in verdicts)
    if named and still != 0 and not states.at_all_times:
        L = explainer.letters.L
        yield says(Label("V", ("eff",)), " stands for minus ", L, " where the velocities are 0:")
        yield shows(Label("V", ("eff",)), without_momenta(explainer.derivation))
    if states.everywhere:
        yield says(f"Here {states.reason}.")
        return
    if found is None:
        yield says(f"{'This was' if one else 'These were'} not solved: {states.reason}.")
        return
    if not found:
        yield says(*_none(rest, states, one=one))
    given = {constraint.name for constraint in explainer.system.problem.constraints}
    for number, each in enumerate(once(found), 1):
        yield Heading(f"Equilibrium {number}", 2)
        yield _state(each.at, each.on)
        if each.free:
            yield says(names(each.free), " is free." if len(each.free) == 1 else " are free.")
        if each.indeterminate:
            plural = "has no value" if len(each.indeterminate) == 1 else "have no values"
            yield says(names(each.indeterminate), f" {plural} there.")
        if lost := [name for name in each.open if name in given]:
            verb = "is" if len(lost) == 1 else "are"
            yield says(f"{constraints_named('The contact', lost)} {verb} open here.")
        if each.where:
            yield says("It exists for ", *inequalities(each.where), ".")
        firm = holding(each)
        limit = at_the_limit(each.where, sticking=each.sticking)
        kept = stability(each.verdict, each.free, each.on, each.at, each.touching)
        yield says(firm, *kept, limit)
    if _one_sided(explainer):
        yield from _where_a_contact_pulls(explainer)
    if states.periods:
        yield says(*repeating(states.periods))
    if found and states.where:
        yield says(f"They were sought only{states.where}.")
    if found and not states.complete:
        yield says("There may be others.")
    if found:
        yield from recurring(explainer, states.periods)


def _one_sided(explainer: Explainer) -> bool:
    """Whether constraints have conditions, and no contact may hold it instead."""
    problem = explainer.problem
    conditional = any(each.holds_while is not None for each in problem.constraints)
    return conditional and not problem.contacts


def _where_a_contact_pulls(explainer: Explainer) -> Iterator[Block]:
    """What solves the conditions and is no equilibrium."""
    from lagcli.mechanics.oscillations.small_oscillations import SmallOscillations

    lead = "The forces balance, but a one-sided constraint would not hold,"
    for at in SmallOscillations(explainer.dynamics).excluded:
        yield says(f"{lead} at")
        yield _state(at)
        lead = "and"


def _constraints_hold(explainer: Explainer) -> str:
    """That the constraints hold, where they are among the conditions of rest."""
    equations = explainer.dynamics.constraints.equations
    if all(not e.holonomic and is_zero(e.drift) is True for e in equations):
        return ""
    return f"The constraint{'s hold' if len(equations) > 1 else ' holds'}, and "


def _none(rest: RestPoints, states: EquilibriaSection, *, one: bool) -> list[Part]:
    """That there is no equilibrium, and why: the conditions, or the `one`, have no solution."""
    if not states.complete:
        return ["No solution was found."]
    assert rest.points is not None
    if rest.at_singular_coordinates:
        where = f"{'This holds' if one else 'These hold'} only where the coordinates are singular"
        lead = f"{where}, and in regular coordinates that is not an equilibrium: "
        none = unless("equilibrium", states.unless) if states.unless != () else ["there is none"]
        return [lead, *none, "."]
    lead = "this has no" if one else "these have no"
    lead = no_solution("neither case has a" if rest.system.problem.contacts else lead, states)
    lead += states.where + " that holds at all times" * states.at_all_times
    what = "equilibrium" + " there" * bool(states.where)
    return [f"{lead}: ", *unless(what, states.unless or (), states.edge), "."]


def _state(
    at: Mapping[str, Expression], on: tuple[Expression, Expression] | None = None
) -> Equations:
    return Equations(place_rows(at, on))
