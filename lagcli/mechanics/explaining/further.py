"""The steps of `--also`: equilibria, small oscillations, reduction, questions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import cast

from lagcli.answers import EquilibriaSection, Section
from lagcli.document import Block, Equations, Heading, Row
from lagcli.explanation import Step
from lagcli.expression import ZERO, Expression, Number
from lagcli.mechanics.explaining import phase_space, quantities, symmetries
from lagcli.mechanics.explaining.oscillations import oscillations
from lagcli.mechanics.explaining.questions import questions
from lagcli.mechanics.explaining.real_forces import real_forces
from lagcli.mechanics.explaining.reduction import reduction
from lagcli.mechanics.explaining.steady import steady
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.transformations import transformations
from lagcli.mechanics.explaining.words import names, says
from lagcli.mechanics.reduction.routh import ALL_CYCLIC
from lagcli.mechanics.statements import Statements
from lagcli.mechanics.stating import Stating
from lagcli.wording import conditions as inequalities
from lagcli.wording import holding, place_rows, stability

Others = Mapping[str, Callable[[Stating], Section]]

_SQUARE = Number(Fraction(2))


def further(teller: Teller, also: Sequence[str], others: Others) -> tuple[list[Step], list[str]]:
    """The steps of these sections, and what was not found on the way.

    `others` makes sections that do not belong to mechanics.
    """
    statements = Statements(teller.derivation)
    statements.others.update({name: partial(make, statements) for name, make in others.items()})
    steps = []
    for name in also:
        title, explain = _STEPS[name]
        section = statements.answers([name]).sections[name]
        steps.append(Step(title, tuple(explain(teller, section))))
    missing = [each for each in statements.warnings if not each.endswith(ALL_CYCLIC)]
    return steps, list(dict.fromkeys(missing))


# -- equilibria ------------------------------------------------------------------------------------


def _equilibria(teller: Teller, section: Section) -> Iterator[Block]:
    from lagcli.mechanics.oscillations.equilibria import RestPoints

    states = cast(EquilibriaSection, section)
    found = states.equilibria
    rest = RestPoints(teller.dynamics)
    constrained = bool(teller.dynamics.constraints.equations)
    sticking = any(each.sticking for each in found or ())
    yield says(
        "At an equilibrium all velocities and accelerations are 0. Lagrange's equations then "
        "require that the generalized forces vanish"
        + (" along every displacement that the constraints allow" if constrained else "")
        + ("." if sticking else ":")
    )
    if sticking:
        yield says(
            "Dry friction takes at rest whatever is needed to hold the body, up to its largest "
            "value, in either direction: what it acts on is at rest in a whole range of places."
        )
    else:
        conditions = [teller.readable.as_written(e) for e in rest.equations]
        yield Equations(tuple(Row(ZERO, condition) for condition in conditions))
    if teller.system.problem.contacts:
        yield says("Each contact is either closed, and pushes, or open, and there is no force.")
    if found is None:
        yield says(f"These were not solved: {states.reason}.")
        return
    if not found:
        yield says("These have no solution: there is no equilibrium.")
    for number, each in enumerate(found, 1):
        yield Heading(f"Equilibrium {number}", 2)
        yield _state(each.at, each.on)
        if each.free:
            yield says(names(each.free), " is free." if len(each.free) == 1 else " are free.")
        if each.indeterminate:
            plural = "has no value" if len(each.indeterminate) == 1 else "have no values"
            yield says(names(each.indeterminate), f" {plural} there.")
        if each.where:
            yield says("It exists for ", *inequalities(each.where), ".")
        firm = holding(each.touching, sticking=each.sticking)
        yield says(firm, *stability(each.verdict, each.free, each.on))
    if not states.complete:
        yield says("There may be others.")


def _state(
    at: Mapping[str, Expression], on: tuple[Expression, Expression] | None = None
) -> Equations:
    return Equations(place_rows(at, on))


_STEPS: Mapping[str, tuple[str, Callable[[Teller, Section], Iterator[Block]]]] = {
    "find": ("Questions", questions),
    "equilibria": ("Equilibria", _equilibria),
    "modes": ("Small oscillations", oscillations),
    "reduction": ("The reduction", reduction),
    "steady_motions": ("Steady motions", steady),
    "canonical_equations": ("Canonical equations", phase_space.canonical_equations),
    "brackets": ("Poisson brackets", phase_space.brackets),
    "canonical": ("Canonical transformations", transformations),
    "hamilton_jacobi": ("The Hamilton-Jacobi equation", phase_space.hamilton_jacobi),
    "discovered": ("Discovered symmetries", symmetries.discovered),
    "algebra": ("The algebra of the symmetries", symmetries.algebra),
    "forces": ("Forces", real_forces),
    "model": ("The model of a numerical run", quantities.model),
    "dimensions": ("Units", quantities.dimensions),
}
