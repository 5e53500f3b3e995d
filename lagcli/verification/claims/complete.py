"""What a section promises to have: one entry for each coordinate, constraint, question of the file.

That is known from the file alone; a section without one of them is not printed.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields, is_dataclass
from itertools import combinations

from lagcli.expression import Expression, Name, walk
from lagcli.problem_data import Problem
from lagcli.statements.answers import (
    AccelerationsSection,
    CanonicalSection,
    ChargesSection,
    ConstraintForcesSection,
    DimensionsSection,
    EquationsSection,
    EquilibriaSection,
    MomentaSection,
    MultipliersSection,
    Section,
)
from lagcli.statements.forces import ForcesSection
from lagcli.statements.motions import SteadySection
from lagcli.statements.phase_space import BracketsSection, TransformationsSection
from lagcli.statements.questions import FindSection
from lagcli.verification.examination import Examination

#: Names that are given, and those that there must be.
Compared = tuple[Collection[str], Collection[str]]


def is_complete(x: Examination, name: str, section: Section) -> bool:
    """Whether nothing that is promised is left out; noted if something is."""
    for given, promised in _compared(x.problem, section):
        missing = [each for each in promised if each not in given]
        if missing:
            x.refute(f"the section '{name}'", f"it leaves out {', '.join(missing)}")
            return False
    return True


def lists_once(x: Examination, name: str, section: Section) -> bool:
    """Whether no list of it has the same entry twice; noted if one has."""
    twice = _has_twice(section)
    if twice:
        x.refute(f"the section '{name}'", "something is listed twice")
    return not twice


def _has_twice(part: object) -> bool:
    """Entries of matrices and other formulas may be the same."""
    if isinstance(part, Expression):
        return False
    if isinstance(part, tuple):
        entries = [each for each in part if is_dataclass(each) and not isinstance(each, Expression)]
        return any(a == b for a, b in combinations(entries, 2)) or any(map(_has_twice, part))
    if is_dataclass(part):
        return any(_has_twice(getattr(part, each.name)) for each in fields(part))
    return isinstance(part, Mapping) and any(map(_has_twice, part.values()))


def _compared(problem: Problem, section: Section) -> Iterator[Compared]:
    """None stands for an answer that was not found, which has its own sentence."""
    coordinates = [each.name for each in problem.coordinates]
    constraints = [each.name for each in problem.constraints]
    match section:
        case EquationsSection(equations=tuple(equations)):
            yield [each.coordinate for each in equations], coordinates
            yield section.constraints, constraints
        case AccelerationsSection(accelerations=dict(found)) | MomentaSection(momenta=dict(found)):
            yield found, coordinates
        case CanonicalSection(equations=dict(found)):
            yield found, coordinates
        case MultipliersSection():
            yield section.multipliers, constraints
        case ConstraintForcesSection():
            yield section.forces, constraints
            for force in (*section.forces.values(), section.total):
                yield coordinates if force is None else force, coordinates
        case ForcesSection(forces=tuple()):
            friction = [each.name for each in problem.constraints if each.acts_as == "friction"]
            yield [name for each in section.friction_needed for name in each.frictions], friction
        case ChargesSection(discovered=False):
            yield [each.name for each in section.charges], [s.name for s in problem.symmetries]
        case EquilibriaSection(equilibria=tuple(places)):
            for place in places:
                tied = [
                    e.name for side in place.on or () for e in walk(side) if isinstance(e, Name)
                ]
                yield (*place.at, *place.free, *place.indeterminate, *tied), coordinates
        case SteadySection(motions=tuple(motions)):
            for motion in motions:
                yield motion.momenta, () if motion.rolling else section.momenta
        case FindSection():
            yield section.answers, [each.name for each in problem.find]
        case DimensionsSection(units_given=True):
            yield section.coordinates, coordinates
            yield section.parameters, [each.name for each in problem.parameters]
            yield section.functions, problem.functions
            yield section.definitions, problem.definitions
            yield section.momenta, coordinates
            yield section.forces, coordinates
            yield section.multipliers, [each.multiplier for each in problem.constraints]
            yield section.charges, [each.name for each in problem.symmetries]
        case BracketsSection():
            yield section.observables, problem.observables
            yield [each.name for each in section.brackets], _asked(problem)
        case TransformationsSection():
            given = problem.canonical_transformations
            yield [each.name for each in section.transformations], [each.name for each in given]
            for each in section.transformations:
                variables = next(g.coordinates for g in given if g.name == each.name)
                yield each.variables, [*variables, *(f"p_{name}" for name in variables)]
        case _:
            return


def _asked(problem: Problem) -> list[str]:
    """The brackets of the file, or those of all pairs of its observables."""
    pairs = combinations(problem.observables, 2)
    return [each.name for each in problem.brackets] or [f"{a}, {b}" for a, b in pairs]
