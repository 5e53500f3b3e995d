"""Forces of constraints on points: they do the work of the generalized force.

sum_i R_i . dr_i/dq_j = lambda_k a_kj   along every q_j on which a point depends.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import arb

from lagcli.expression import ZERO, Expression, Product
from lagcli.record import replace
from lagcli.statements.answers import ConstraintForcesSection
from lagcli.statements.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.verification.claims.rest import not_confirmed
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import Examination
from lagcli.verification.linear import dot, rank
from lagcli.verification.states import State
from lagcli.verification.sweeps import column

_THEY_DO = "they do"
_UNKNOWN = "its printed form was not confirmed at random states"

#: Point -> the printed components of a vector on it.
Vectors = Mapping[str, Sequence[Expression | None]]


def constraint_forces(x: Examination, section: ConstraintForcesSection) -> ConstraintForcesSection:
    """Lambda df/dq by constraint and coordinate, and their total."""
    found: dict[str, Mapping[str, Expression | None] | None] = dict(section.forces)
    for k, row in enumerate(x.reference.rows):
        name = row.constraint.name
        force = found.get(name)
        if force is not None:
            known = {q: f for q, f in force.items() if f is not None}
            where = [x.reference.names.index(q) for q in known]
            what = f"the generalized force of '{name}'"
            ok = x.determined(what, lambda s, k=k: _splits(s, k)) and x.hold(  # type: ignore[misc]
                what,
                list(known.values()),
                lambda s, k=k, where=where: [s.laws.constraint_force(k)[j] for j in where],  # type: ignore[misc]
            )
            found[name] = force if ok else None
    total = section.total
    if total is not None and not x.hold(
        "the total constraint force",
        [total[name] for name in x.reference.names],
        lambda s: s.laws.total_constraint_force,
    ):
        total = None
    return _on_points(x, replace(section, forces=found, total=total))


def _splits(s: State, k: int) -> bool:
    """Whether the force of one constraint is determined, and not only its sum with others."""
    alone = all(map(is_zero, s.laws.jacobian[k]))
    return alone or s.laws.motion.determined(len(s.laws.jacobian[k]) + k)


def _on_points(x: Examination, section: ConstraintForcesSection) -> ConstraintForcesSection:
    """The forces on points that stand beside the generalized forces."""
    if section.on_points is None:
        return section
    kept = {
        name: forces
        for name, forces in section.on_points.items()
        if _do_the_work(x, f"the force of '{name}' on points", name, forces)
    }
    known = {n for n, f in section.forces.items() if f is not None and None not in f.values()}
    left_out = known - section.on_points.keys()
    if left_out and (section.on_points or _points_determine(x)):
        x.refute("that the points do not determine the forces on them", _THEY_DO)
    return replace(section, on_points=kept)


def _points_determine(x: Examination) -> bool:
    """Whether the points determine the coordinates that they depend on, and have all of T."""
    state = next(iter(x.states()), None)
    if state is None or x.reference.large or any(p.mass is None for p in x.problem.points):
        return False
    arms = _arms(x, state)
    slots = [axis for axes in arms.values() for axis in axes if not all(map(is_zero, axis))]
    moving = _moving(slots, state.laws.size)
    own = [[row[j] for j in moving] for row in slots]
    if not slots or len(slots) != len(moving) or rank(own, len(moving)) < len(moving):
        return False
    masses = {p.name: state.at(x.reference.place(p.mass)) for p in x.problem.points if p.mass}
    weighted = [(masses[name], axis) for name, axes in arms.items() for axis in axes]
    return all(
        is_zero(entry - sum((m * axis[j] * axis[k] for m, axis in weighted), arb(0)))
        for j, row in enumerate(state.laws.mass_matrix)
        for k, entry in enumerate(row)
        if j in moving
    )


def _moving(rows: Sequence[Sequence[arb]], size: int) -> list[int]:
    """The coordinates on which a point depends."""
    return [j for j in range(size) if not all(is_zero(row[j]) for row in rows)]


def forces(x: Examination, section: ForcesSection) -> ForcesSection:
    """Signed magnitudes and directions, torques, and the friction that is needed."""
    if section.forces is None:
        return section
    names = [row.constraint.name for row in x.reference.rows]
    if not all(_hold(x, name, section) for name in names):
        return ForcesSection(forces=None, reason=not_confirmed("a force"))
    found = tuple(_as_it_acts(x, each) for each in section.forces)
    friction = tuple(_needed(x, each, section) for each in section.friction_needed)
    torques = {n: section.torques.get(n, {}) for n in names if _turn(x, n, section)}
    torques = {n: by for n, by in torques.items() if by}
    return replace(section, forces=found, friction_needed=friction, torques=torques)


def _hold(x: Examination, name: str, section: ForcesSection) -> bool:
    """Whether magnitude times direction does the work, the direction being a unit vector."""
    what = f"the force of '{name}' on points"
    assert section.forces is not None
    acting = [each for each in section.forces if each.constraint == name]
    if any(each.force is None for each in acting):
        return True
    axes = {point.name: len(point.position) for point in x.problem.points}
    if any(len(each.direction) != axes[each.point] for each in acting):
        x.refute(what, "a component is left out")
        return False
    vectors = {
        each.point: [Product((each.force or ZERO, axis)) for axis in each.direction]
        for each in acting
    }
    lengths = x.places(what, [axis for each in acting for axis in each.direction])
    widths = [len(each.direction) for each in acting]
    return (
        lengths is not None
        and _do_the_work(x, what, name, vectors)
        and x.decide(what, lambda s: _unit(s, lengths, widths))
    )


def _as_it_acts(x: Examination, each: PointForce) -> PointForce:
    """Without the sign that is allowed, or the point on its line, where that is not so."""
    what = f"how '{each.constraint}' acts on '{each.point}'"
    condition = next(c.holds_while for c in x.problem.constraints if c.name == each.constraint)
    places = x.places(what, [each.force or ZERO, *each.direction])
    if places is None:
        return replace(each, allowed=None, towards=None, away_from=None)
    if each.allowed is not None and each.force is not None and condition is not None:
        larger, smaller = map(x.reference.place, condition.larger_first)

        def signs(s: State) -> tuple[list[arb], list[arb]]:
            margin, force = s.at(larger) - s.at(smaller), s.at(places[0])
            return [margin.sgn()], [each.allowed * force.sgn()]

        if not x.decide(what, signs):
            each = replace(each, allowed=None)
    end = each.towards if each.away_from is None else each.away_from
    if end is None or each.fixed:
        return each
    side, position = 1 if each.away_from is None else -1, _positions(x)

    def along(s: State) -> tuple[list[arb], list[arb]]:
        """The direction, and the unit vector to the point (or the origin) or from it."""
        far = [s.at(place) for place in position[end]] if end else [arb(0)] * len(places)
        gap = [side * (b - s.at(a)) for a, b in zip(position[each.point], far, strict=False)]
        length = dot(gap, gap).sqrt()
        return [s.at(place) * length for place in places[1:]], gap

    return each if x.decide(what, along) else replace(each, towards=None, away_from=None)


def _unit(s: State, places: Sequence[int], widths: Sequence[int]) -> tuple[list[arb], list[arb]]:
    components = iter([s.at(place) for place in places])
    vectors = [[next(components) for _ in range(width)] for width in widths]
    return [dot(vector, vector) for vector in vectors], [arb(1)] * len(vectors)


def _turn(x: Examination, name: str, section: ForcesSection) -> bool:
    """The torque about the point is the generalized force, along each angle of a body alone."""
    k = [row.constraint.name for row in x.reference.rows].index(name)
    size, torques = len(x.reference.names), section.torques.get(name, {})
    printed = [torques.get(q, ZERO) for q in x.reference.names]
    what = f"the torque of '{name}'"
    places = x.places(what, printed)
    if places is None:
        return False
    if torques and not x.determined(what, lambda s: s.laws.motion.determined(size + k)):
        return False

    def sides(s: State) -> tuple[list[arb], list[arb]]:
        if not s.laws.motion.determined(size + k):
            return [], []
        moving = _moving([axis for axes in _arms(x, s).values() for axis in axes], size)
        turning = [j for j in range(size) if j not in moving]
        true = s.laws.constraint_force(k)
        return [s.at(places[j]) for j in turning], [true[j] for j in turning]

    return x.decide(what, sides)


def _needed(x: Examination, each: FrictionNeeded, section: ForcesSection) -> FrictionNeeded:
    """|friction|/|normal force| on the first point, where the conditions hold."""
    if each.coefficient is None or each.normal is None:
        return each
    names = (each.normal, *each.frictions)
    what = f"the coefficient of friction for {' and '.join(each.frictions)}"
    first = {f.constraint: f for f in reversed(section.forces or ())}
    vectors = [first[name] for name in names if name in first]
    known = all(f.force is not None for f in vectors)
    parts = [Product((f.force or ZERO, axis)) for f in vectors for axis in f.direction]
    places = x.places(what, [each.coefficient, *each.where, *parts])
    if not known or places is None or len(vectors) < len(names):
        return replace(each, coefficient=None, reason=_UNKNOWN)
    conditions = places[1 : 1 + len(each.where)]
    width = len(vectors[0].direction)

    def ratio(s: State) -> tuple[list[arb], list[arb]] | None:
        if not all(s.at(place) > 0 for place in conditions):
            return None  # it is so written for other values only
        components = [s.at(place) for place in places[1 + len(each.where) :]]
        normal, tangential = components[:width], components[width:]
        total = [sum(tangential[axis::width], arb(0)) for axis in range(width)]
        return [s.at(places[0])], [(dot(total, total) / dot(normal, normal)).sqrt()]

    if x.decide(what, ratio):
        return each
    return replace(each, coefficient=None, reason=_UNKNOWN)


def _positions(x: Examination) -> dict[str, tuple[int, ...]]:
    place = x.reference.place
    return {p.name: tuple(map(place, p.position)) for p in x.problem.points}


def _arms(x: Examination, s: State) -> dict[str, list[list[arb]]]:
    """Point -> axis -> dr/dq_j."""
    return {
        point: [column(s.at.gradient(place), x.reference.q) for place in places]
        for point, places in _positions(x).items()
    }


def _do_the_work(x: Examination, what: str, name: str, vectors: Vectors) -> bool:
    flat = [component or ZERO for vector in vectors.values() for component in vector]
    places = x.places(what, flat)
    if places is None:
        return False
    k = [row.constraint.name for row in x.reference.rows].index(name)

    def work(s: State) -> tuple[list[arb], list[arb]]:
        arms = _arms(x, s)
        acting = iter([s.at(place) for place in places])
        total = [arb(0)] * s.laws.size
        for point, vector in vectors.items():
            for axis in arms[point][: len(vector)]:
                force = next(acting)
                total = [w + force * arm for w, arm in zip(total, axis, strict=True)]
        moving = _moving([axis for axes in arms.values() for axis in axes], s.laws.size)
        true = s.laws.constraint_force(k)
        return [total[j] for j in moving], [true[j] for j in moving]

    return x.decide(what, work)
