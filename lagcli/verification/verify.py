"""The sections of one problem, each claim examined; what a state refutes is left out."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from flint import ctx

from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.answers import (
    AccelerationsSection,
    AlgebraSection,
    Answers,
    CanonicalSection,
    ChargesSection,
    ConstraintForcesSection,
    DimensionsSection,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    HamiltonianSection,
    LagrangianSection,
    MatrixFormSection,
    ModelSection,
    ModesSection,
    MomentaSection,
    MultipliersSection,
    ReductionSection,
    Section,
)
from lagcli.statements.forces import ForcesSection
from lagcli.statements.motions import HamiltonJacobiSection, SteadySection
from lagcli.statements.phase_space import BracketsSection, TransformationsSection
from lagcli.statements.questions import FindSection
from lagcli.verification.claims.complete import is_complete, lists_once
from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import Unclear
from lagcli.verification.sweeps import Unknown

Examine = Callable[[Examination, Any], Section | None]

#: The module of `claims` and its function that examine each kind of section; a kind that is
#: not here is not verified in numbers.
_CLAIMS: dict[type, str] = {
    LagrangianSection: "motion.lagrangian",
    EquationsSection: "motion.equations",
    MatrixFormSection: "motion.matrix_form",
    AccelerationsSection: "motion.accelerations",
    MultipliersSection: "motion.multipliers",
    ConstraintForcesSection: "forces.constraint_forces",
    ForcesSection: "forces.forces",
    MomentaSection: "energies.momenta",
    EnergySection: "energies.energy",
    HamiltonianSection: "energies.hamiltonian",
    CanonicalSection: "energies.canonical_equations",
    BracketsSection: "phase_space.brackets",
    TransformationsSection: "phase_space.transformations",
    ChargesSection: "charges.charges",
    EquilibriaSection: "equilibria.equilibria",
    ModesSection: "modes.modes",
    ReductionSection: "reduction.reduction",
    ModelSection: "reduction.model",
    SteadySection: "equilibria.steady_motions",
    HamiltonJacobiSection: "separation.hamilton_jacobi",
    DimensionsSection: "units.dimensions",
}


def verified(problem: Problem, answers: Answers) -> Answers:
    """The answers without what random states refute, and a warning for each of that.

    Parameters
    ----------
    problem
        The problem as it was read, with L, or T and V.
    answers
        What was derived from it.
    """
    freedom = answers.degrees_of_freedom
    rank = None if freedom is None else len(problem.coordinates) - freedom
    examination = Examination(problem, rank=rank)
    with ctx.workprec(PRECISIONS[0]):
        if not examination.rank_is_possible():
            examination.refute("the number of degrees of freedom", f"{freedom} as derived")
            freedom = None
        examination.define("the abbreviations", answers.where)
        given = answers.sections
        if problem.lagrangian is not None and problem.hamiltonian is not None:
            from lagcli.verification.claims.given_hamiltonian import legendre_transform

            if not legendre_transform(examination):
                given = {}  # nothing of it describes the motion of H
        sections = {name: _examined(examination, name, each) for name, each in given.items()}
        if isinstance(asked := sections.get("find"), FindSection):
            from lagcli.verification.claims import find

            known = find.printed_charges(sections.get("charges"))
            sections["find"] = _tried(
                examination, "find", asked, lambda x, s: find.find(x, s, known)
            )
        if isinstance(listed := sections.get("discovered"), ChargesSection):
            from lagcli.verification.claims.unlisted_symmetries import symmetries_are_listed

            every = not listed.sought or symmetries_are_listed(examination, listed)
            if isinstance(counted := sections.get("algebra"), AlgebraSection):
                from lagcli.verification.claims.algebra import Counted, algebra
                from lagcli.verification.claims.algebra_on_surface import OnSurface

                counts = OnSurface if examination.reference.rows else Counted
                sections["algebra"] = every and _tried(
                    examination, "algebra", counted, lambda x, s: algebra(x, s, listed, counts)
                )
    warnings = examination.warnings()
    if not warnings:
        return answers
    return replace(
        answers,
        degrees_of_freedom=freedom,
        sections={name: each for name, each in sections.items() if each},
        absent=(*answers.absent, *(name for name, each in sections.items() if not each)),
        warnings=(*answers.warnings, *warnings),
        complete=answers.complete and not examination.retracted,
    )


def _examined(examination: Examination, name: str, section: Section) -> Section | None:
    claim = _CLAIMS.get(type(section))
    if not is_complete(examination, name, section):
        return None
    found: Section | None = section
    if claim is not None:
        module, _, function = claim.partition(".")
        examine = getattr(import_module(f"lagcli.verification.claims.{module}"), function)
        found = _tried(examination, name, section, examine)
    return found if found is None or lists_once(examination, name, found) else None


def _tried(
    examination: Examination, name: str, section: Section, examine: Examine
) -> Section | None:
    try:
        return examine(examination, section)
    except Unknown as error:
        examination.refute_name(f"the section '{name}'", error)
        return None
    except (ArithmeticError, ValueError, Unclear):
        examination.unchecked.append(f"the section '{name}'")
        return section
