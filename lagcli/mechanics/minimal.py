"""The same motion in fewer coordinates: the derivation of the problem without those solved."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.fewer_coordinates import (
    problem_of,
    unconstrained,
    without_holonomic,
    without_integrated,
)
from lagcli.mechanics.system import System
from lagcli.problem_data import Constraint, Parameter, Problem


def minimal(derivation: Derivation, *, rolling: bool = False) -> Derivation:
    """The derivation itself, or that of the problem without the coordinates that are solved.

    Velocity constraints that are `integrated` are put in, too; under others it is left alone, or
    with `rolling` all of them are kept.
    """
    fewer = without_holonomic if rolling else unconstrained
    problem = fewer(derivation.dynamics)
    return derivation if problem is None else _ordered(problem, derivation.system)


def integrated(derivation: Derivation) -> Derivation | None:
    """The same without velocity constraints on coordinates that L does not contain."""
    problem = without_integrated(derivation.dynamics)
    return None if problem is None else _ordered(problem, derivation.system)


def with_lagrangian(
    derivation: Derivation,
    kept: Sequence[int],
    lagrangian: Expr,
    forces: Sequence[Expr],
    parameters: tuple[Parameter, ...],
    constraints: tuple[Constraint, ...] = (),
) -> Derivation:
    """The derivation of another Lagrangian for some of the coordinates."""
    system = derivation.system
    problem = problem_of(system, kept, lagrangian, forces, parameters, constraints)
    return _ordered(problem, system)


def _ordered(problem: Problem, old: System) -> Derivation:
    """Its derivation, in which the parameters keep their order."""
    made = Derivation(problem)
    parameters = {p.name for p in problem.parameters}
    before = [name for name in old.order if name in parameters]
    made.system.order = (*before, *(name for name in made.system.order if name not in before))
    return made
