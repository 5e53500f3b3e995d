"""Statements on real forces: what a constraint does to a point, as a vector."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.record import field, record


@record(kw_only=True)
class PointForce:
    """The force of one constraint on one point: `force` times the unit vector `direction`.

    `kind` is what the file calls it: normal, friction or tension.

    `force` is None where redundancy leaves the multiplier undetermined.  `towards` and
    `away_from` name a point on the line of the force (empty: the origin), where there is
    one.  `allowed` is the sign of `force` while the contact holds, None where it is held
    from both sides, or where which side `direction` points to depends on the state.  Along the
    `fixed` axes the point cannot move: a force along them does no work and is not part of it.
    """

    constraint: str
    point: str
    kind: str | None
    force: Expression | None
    direction: tuple[Expression, ...]
    towards: str | None = None
    away_from: str | None = None
    allowed: int | None = None
    fixed: tuple[str, ...] = ()


@record(kw_only=True)
class FrictionNeeded:
    """|friction| / |normal force| at one contact: the least coefficient of static friction.

    It is so written where each of `where` is > 0, as it is for the values of the file.
    `coefficient` is None with a `reason`.
    """

    frictions: tuple[str, ...]
    normal: str | None
    coefficient: Expression | None
    where: tuple[Expression, ...] = ()
    reason: str = ""


@record(kw_only=True)
class ForcesSection:
    """The force of each constraint on each point; None with a `reason` where not found.

    `torques` are, by constraint, the generalized forces along the coordinates on which no
    point depends: about the angle of a body, the torque about its point.
    """

    forces: tuple[PointForce, ...] | None
    torques: Mapping[str, Mapping[str, Expression]] = field(default_factory=dict)
    friction_needed: tuple[FrictionNeeded, ...] = ()
    reason: str = ""
