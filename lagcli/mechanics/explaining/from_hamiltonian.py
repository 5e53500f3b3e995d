"""The account of an H that gives no Lagrangian: the canonical equations, and what H conserves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sympy import Expr

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.document import Block, Equations, Label, Row, equations_of
from lagcli.expression import Name
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.explaining.words import counted, explained, names, says, shows
from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
from lagcli.statements.explanation import Explanation, ExplanationStep
from lagcli.statements.registry import find_section

_H = Label("H")
#: What has a step of its own.
_STATED = ("hamiltonian", "canonical_equations")


def explanation_from_hamiltonian(derivation: Derivation, also: Sequence[str] = ()) -> Explanation:
    """The steps that need no velocities, and the requested further sections that need none.

    Raises
    ------
    ProblemError
        When there are constraints.
    """
    statements = PhaseSpaceStatements(derivation)
    steps = [
        ExplanationStep("The Hamiltonian", tuple(_hamiltonian(statements))),
        ExplanationStep("Canonical equations", tuple(_equations(statements))),
        ExplanationStep("Conserved quantities", tuple(_conserved(statements))),
    ]
    missing = []
    for name in also:
        section = find_section(name)
        if name in _STATED or section.explained is None:
            continue
        title = section.explained.title
        if statements.maker(section) is None:
            missing.append(f"'{title}' is derived here from a Lagrangian, and this H gives none")
            continue
        answers = statements.answers([name])
        steps.append(ExplanationStep(title, tuple(section.blocks(answers.sections[name], answers))))
    missing += [warning for warning in statements.warnings if warning not in missing]
    freedom = statements.degrees_of_freedom
    return explained(derivation.given, freedom, steps, tuple(dict.fromkeys(missing)))


def _hamiltonian(statements: PhaseSpaceStatements) -> Iterator[Block]:
    q = [each.name for each in statements.problem.coordinates]
    one, H = len(q) == 1, statements.hamiltonian.function
    yield says("The coordinate " if one else "The coordinates ", names(q),
               " describes the configuration." if one else " describe the configuration.",
               f" The system has {counted(len(q), 'degree')} of freedom. The Hamiltonian is "
               "given:")  # fmt: skip
    yield shows(_H, statements.as_written(H))
    yield says("It gives no Lagrangian: ", statements.why_missing, ".")
    p = statements.hamiltonian.system.momenta
    if is_zero(dot(p, [H.diff(x) for x in p]) - H) is True:
        yield says(_H, " is homogeneous of first degree in the momenta, so the sum of "
                   "momentum times velocity is ", _H, " itself (Euler), and what the "
                   "Legendre transform would give is 0.")  # fmt: skip


def _equations(statements: PhaseSpaceStatements) -> Iterator[Block]:
    q = [each.name for each in statements.problem.coordinates]
    found = statements.hamiltonian
    yield says("The velocities are the derivatives of ", _H, " with respect to the momenta,")
    yield equations_of(
        (Name(name, 1), statements.as_written(x))
        for name, x in zip(q, found.velocities, strict=True)
    )
    forces = ", plus the forces" if any(x != 0 for x in _forces(statements)) else ""
    yield says(f"and the rates of the momenta are minus those with respect to the "
               f"coordinates{forces}:")  # fmt: skip
    yield equations_of(
        (Name(f"p_{name}", 1), statements.as_written(x))
        for name, (x, _) in zip(q, found.growth, strict=True)
    )


def _conserved(statements: PhaseSpaceStatements) -> Iterator[Block]:
    found, system = statements.hamiltonian, statements.hamiltonian.system
    work = dot(_forces(statements), found.velocities)
    change = simplify(found.function.diff(system.t) + work)
    if change == 0:
        why = "does not depend on t explicitly" if work == 0 else "has the rate 0"
        yield says(_H, f" {why}. So it is conserved.")
    else:
        yield says(_H, " is not conserved. Its rate is")
        yield Equations((Row(Name("H", 1), statements.as_written(change)),))
    for name, q, (rate, _) in zip(
        (each.name for each in statements.problem.coordinates), system.q, found.growth, strict=True
    ):
        if free_of(found.function, [q]) and rate == 0:
            p = Name(f"p_{name}")
            yield says(Name(name), " does not occur in ", _H, ": its momentum ", p, " is constant.")


def _forces(statements: PhaseSpaceStatements) -> list[Expr]:
    """What the rates of the momenta have beside -dH/dq."""
    found = statements.hamiltonian
    pairs = zip(found.system.q, found.growth, strict=True)
    return [simplify(rate + found.function.diff(q)) for q, (rate, _) in pairs]
