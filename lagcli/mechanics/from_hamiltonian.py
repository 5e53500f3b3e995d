"""The Lagrangian of a problem that gives H: q_j' = dH/dp_j solved for p, then

    L(q, q', t) = sum_j p_j q_j' - H.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 8.1: the transform of
Legendre is its own inverse.
"""

from __future__ import annotations

from sympy import Expr

from lagcli.algebra import dot, simplify, to_expression
from lagcli.algebra.signs import sign
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.mechanics.legendre import Inversion, at_rest_against_far, bending
from lagcli.mechanics.phase_states import PhaseStates
from lagcli.mechanics.system import System
from lagcli.problem_data import Problem
from lagcli.record import replace


class NoLagrangian(ProblemError):
    """H has no Lagrangian, or none in closed form; `reason` is a sentence without its end."""

    def __init__(self, problem: Problem, reason: str) -> None:
        assert problem.hamiltonian is not None
        message = f"this H gives no Lagrangian: {reason}"
        hint = "lagcli solve --show hamiltonian,canonical_equations needs none"
        super().__init__(problem.source, (Diagnostic(message, problem.hamiltonian.span, hint),))
        self.reason = reason


def with_lagrangian(problem: Problem) -> Problem:
    """The problem with the L of its H; one that gives L, or T and V, is left as it is.

    Raises
    ------
    NoLagrangian
        Where d2H/dp2 is singular, or q' = dH/dp was not solved for the momenta.
    """
    if problem.hamiltonian is None or problem.lagrangian is not None:
        return problem
    system = System(problem)
    return replace(problem, lagrangian=to_expression(_lagrangian(system), system.order))


def _lagrangian(system: System) -> Expr:
    assert system.H is not None
    H = simplify(system.H)  # its radicals are those of its derivatives
    velocities = [simplify(H.diff(p)) for p in system.momenta]
    hessian = [[v.diff(p) for p in system.momenta] for v in velocities]
    inversion = Inversion(
        H,
        velocities,
        hessian,
        system.momenta,
        system.qdot,
        PhaseStates(system, [H, *velocities]).take,
    )
    if inversion.is_singular:
        raise NoLagrangian(
            system.problem,
            "the matrix of its second derivatives in the momenta is singular: the velocities "
            "do not determine the momenta",
        )
    bends = bending(hessian, system.momenta)
    opposed = [] if bends is None else at_rest_against_far(bends, system.momenta)
    if -1 in map(sign, opposed) or inversion.folds:
        raise NoLagrangian(
            system.problem,
            "the determinant of its second derivatives in the momenta takes both signs, so "
            "the velocities do not determine the momenta",
        )
    if inversion.inverted is None:
        raise NoLagrangian(
            system.problem, "q' = dH/dp could not be solved for the momenta in closed form"
        )
    return inversion.put_into(dot(system.momenta, system.qdot) - H)
