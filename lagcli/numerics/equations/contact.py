"""The one-sided contacts of a problem: which side is open, and what an impact does there.

A contact takes the place of a constraint f = left - right = 0 while it is closed.  The gap
is sign * f, positive where it is open, and sign * lambda >= 0 is the force that pushes the
sides apart: (gap, force) >= 0 with gap * force = 0, Signorini's conditions.
"""

from __future__ import annotations

from lagcli.expression import ZERO, Expression, Name
from lagcli.problem_data import Constraint, Inequality, Problem, pushing_sign
from lagcli.record import record, replace


@record(kw_only=True)
class OneSided:
    """A constraint that only pushes.

    Attributes
    ----------
    sign
        The gap is sign * f.
    stops
        Whether the run stops where the contact is lost.
    restitution
        Newton's coefficient; None: the run stops where the contact closes.
    constraint
        Whether the file has it among the constraints: it is closed at t = 0.
    """

    name: str
    sign: int
    stops: bool
    restitution: Expression | None
    constraint: bool


def with_contacts(problem: Problem) -> Problem:
    """The same problem with its contacts as further constraints."""
    added = tuple(
        Constraint(
            name=contact.name,
            equation=contact.equation,
            multiplier=contact.multiplier,
            holds_while=Inequality(
                left=Name(contact.multiplier), comparison=">=", right=ZERO, span=contact.span
            ),
            on_loss="release",
            restitution=contact.restitution,
            span=contact.span,
        )
        for contact in problem.contacts
    )
    return replace(problem, constraints=(*problem.constraints, *added), contacts=())


def one_sided(problem: Problem, count: int) -> dict[int, OneSided]:
    """The one-sided ones among the constraints, of which the first `count` are the file's."""
    found = {}
    for k, constraint in enumerate(problem.constraints):
        condition = constraint.holds_while
        if condition is None:
            continue
        sign = pushing_sign(constraint.multiplier, condition)
        if sign is not None:
            found[k] = OneSided(
                name=constraint.name,
                sign=sign,
                stops=constraint.on_loss == "stop",
                restitution=constraint.restitution,
                constraint=k < count,
            )
    return found
