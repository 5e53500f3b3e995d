"""Hamilton's principal function: what is printed solves the Hamilton-Jacobi equation.

The constants of a random state follow from the separated equations by Newton's method, E must
be its energy, and at places nearby H(q, W') = E holds for the same constants; the W' depend on
each constant, so that the integral is complete.

Levi-Civita, Math. Ann. 59 (1904) 383; Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed.,
sections 10.1 and 10.4.
"""

from __future__ import annotations

from lagcli.statements.motions import HamiltonJacobiSection
from lagcli.verification.claims.action import Action
from lagcli.verification.claims.driven import solves_in_time
from lagcli.verification.examination import Examination

_WHY = "what was derived does not hold at random states"


def hamilton_jacobi(x: Examination, section: HamiltonJacobiSection) -> HamiltonJacobiSection:
    """H, whether it separates, and the parts of S."""
    if section.hamiltonian is None:
        return section
    action = Action(x, section)
    what = "the Hamiltonian of the Hamilton-Jacobi equation"
    if not action.readable or not x.decide(what, action.energies):
        return _nothing(section)
    if section.time_rate is not None:
        return section if solves_in_time(action) else _nothing(section)
    if section.separable is not None and not action.levi_civita():
        return _nothing(section)
    if section.derivatives is None:
        return section
    if action.lacks_a_coordinate:
        x.refute("Hamilton's principal function", "a coordinate of H has no part in it")
        return _nothing(section)
    if not action.independent():
        x.refute("the separated equations", "their constants are not independent")
        return _nothing(section)
    if not action.solves():
        return _nothing(section)
    return action.with_functions()


def _nothing(section: HamiltonJacobiSection) -> HamiltonJacobiSection:
    return HamiltonJacobiSection(
        hamiltonian=None, energy=section.energy, separable=None, reason=_WHY
    )
