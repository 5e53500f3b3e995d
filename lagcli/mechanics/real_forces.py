"""The force of each constraint on each point as a vector, and the friction that it needs.

For R = lambda c(q, t) on a point at r, the unit vector along c and the signed magnitude
lambda |c| are given apart.  The unit vector points

- where a one-sided contact pushes, by the sign that `holds_while` allows;
- where a tension pulls, or what holds from both sides: to a point d = r_k - r with c x d = 0;
- if there is no such point, to where left - right of the constraint grows.

Static friction F at a contact with the normal force N needs a coefficient |F|/|N|.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import sympy
from sympy import Expr, S

from lagcli.algebra import dot, is_zero
from lagcli.algebra.signs import sign
from lagcli.expression import Expression
from lagcli.mechanics.constraint_force import Vector, fixed_axes, on_points, turning_coordinates
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.parameter_values import exact_values
from lagcli.mechanics.readable import Readable
from lagcli.problem_data import Constraint, pushing_sign
from lagcli.record import record
from lagcli.statements.forces import ForcesSection, FrictionNeeded, PointForce

UNSOLVED = "the multipliers were not solved in closed form"
_NO_POINTS = "the file has no `points`, so where the forces act is not known"
_NOT_UNIQUE = (
    "the forces on the points are not unique: each coordinate that a point depends on needs "
    "one component of a position, and no more, and its inertia in T is that of the points"
)


@record
class Centre:
    """A point k on the line of a force, d = r_k - r = `factor` c; "" is the origin."""

    name: str
    factor: int  # its sign
    distance: Vector


class RealForces:
    """The forces of all constraints of one system on its points."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system
        self.readable = Readable(dynamics)
        self.shapes = dynamics.shapes
        self.warnings: list[str] = []
        self.missing: list[tuple[str, str]] = []
        equations = dynamics.constraints.equations
        self._gradients = on_points(dynamics, {e.name: e.row for e in equations})
        self._given = {c.name: c for c in self.system.problem.constraints}
        motion = dynamics.motion
        values = (None,) * len(equations) if motion is None else motion.multipliers
        self._multipliers = dict(zip((e.name for e in equations), values, strict=True))

    def section(self) -> ForcesSection:
        """The forces, or the reason why they were not found."""
        equations = self.dynamics.constraints.equations
        if not equations:
            return ForcesSection(forces=())
        reason = ""
        if self.dynamics.motion is None:
            reason = UNSOLVED
        elif not self._gradients:
            reason = _NOT_UNIQUE if self.system.particles else _NO_POINTS
        if reason:
            self.missing.append(("the forces", reason))
            return ForcesSection(forces=None, reason=reason)
        friction = tuple(self._friction())
        self.missing += [
            (f"the coefficient of friction for {' and '.join(each.frictions)}", each.reason)
            for each in friction
            if each.coefficient is None
        ]
        found = [force for e in equations for force in self._of_constraint(e)]
        return ForcesSection(
            forces=tuple(found),
            torques={e.name: turning for e in equations if (turning := self._torques(e))},
            friction_needed=friction,
        )

    def _torques(self, equation: ConstraintEquation) -> dict[str, Expression]:
        value = self._multipliers[equation.name]
        return {
            self.system.names[j]: self.readable.on_surface(value * equation.row[j])
            for j in turning_coordinates(self.dynamics)
            if value is not None and is_zero(equation.row[j]) is not True
        }

    # -- one force -------------------------------------------------------------------------

    def _of_constraint(self, equation: ConstraintEquation) -> Iterator[PointForce]:
        value, given = self._multipliers[equation.name], self._given[equation.name]
        for point, c in self._gradients[equation.name].items():
            centre = self._centre(equation.name, point, c)
            allowed = self._allowed(equation.name)
            orientation = self._orientation(given, centre, allowed)
            length = self._length(c)
            if centre is None and length.has(sympy.Abs):
                # either unit vector will do: the one that does not turn round where c vanishes
                signed = length.replace(sympy.Abs, lambda x: x)
                allowed = None if allowed is None else self._kept(allowed, length, signed)
                length = self.shapes.simplify(signed)
            along = None if centre is None else centre.factor * orientation
            yield PointForce(
                constraint=equation.name,
                point=point,
                kind=given.acts_as,
                force=None
                if value is None
                else self.readable.on_surface(orientation * value * length),
                direction=tuple(
                    self.readable.on_surface(orientation * component / length) for component in c
                ),
                towards=centre.name if centre is not None and along == 1 else None,
                away_from=centre.name if centre is not None and along == -1 else None,
                allowed=None if allowed is None else allowed * orientation,
                fixed=fixed_axes(self.dynamics, point),
            )

    def _kept(self, allowed: int, length: Expr, signed: Expr) -> int | None:
        """The sign that is allowed, where it is the same with the signed length."""
        turned = sign(self.shapes.simplify(signed / length))
        return None if turned is None else allowed * turned

    def _length(self, c: Vector) -> Expr:
        parts = [component for component in c if is_zero(component) is not True]
        if len(parts) == 1:
            return sympy.Abs(self.shapes.simplify(parts[0]))
        square = self.shapes.simplify(sympy.Add(*(component**2 for component in parts)))
        return self.shapes.simplify(sympy.sqrt(square))

    def _allowed(self, name: str) -> int | None:
        """The sign of the multiplier while a one-sided contact holds."""
        given = self._given[name]
        condition = given.holds_while
        return None if condition is None else pushing_sign(given.multiplier, condition)

    def _orientation(self, given: Constraint, centre: Centre | None, allowed: int | None) -> int:
        """1 where the unit vector points along c, -1 where against it."""
        if centre is not None and (allowed is None or given.acts_as == "tension"):
            if allowed is not None and allowed != centre.factor:
                where = f"'{centre.name}'" if centre.name else "the origin"
                self.warnings.append(
                    f"'{given.name}' acts as a tension, but its 'holds_while' lets it push away "
                    f"from {where} only: write the constraint or the condition the other way round"
                )
            return centre.factor
        return 1 if allowed is None else allowed

    # -- points on the line of a force -------------------------------------------------------

    def _centre(self, name: str, point: str, c: Vector) -> Centre | None:
        """The other point that the constraint acts on, else one at rest, else the origin."""
        positions = {p.name: p.position for p in self.system.particles}
        here = positions[point]
        origin: Vector = (S.Zero,) * len(here)
        others = [p for p in self._gradients[name] if p != point]
        resting = [p for p, r in positions.items() if not _moves(r, self.dynamics)]
        for tier in (others, resting, [""]):
            found = [
                centre
                for each in tier
                if (centre := self._on_line(each, positions.get(each, origin), here, c))
            ]
            if found and len({centre.factor for centre in found}) == 1:
                return found[0]
        return None

    def _on_line(self, name: str, there: Vector, here: Vector, c: Vector) -> Centre | None:
        if len(there) != len(here):
            return None
        d = tuple(self.shapes.simplify(b - a) for a, b in zip(here, there, strict=True))
        relations = self.dynamics.constraints.relations
        for i, j in combinations(range(len(c)), 2):
            if is_zero(c[i] * d[j] - c[j] * d[i], relations) is not True:
                return None
        inner = self.shapes.simplify(dot(c, d))
        factor = sign(inner)
        if factor is None and (inner.is_nonnegative or inner.is_nonpositive):
            factor = 1 if inner.is_nonnegative else -1  # 0 only where the force vanishes with c
        return Centre(name, factor, d) if factor else None

    # -- friction ------------------------------------------------------------------------------

    def _friction(self) -> Iterator[FrictionNeeded]:
        """By contact: all frictions with the one normal force at right angles to them."""
        by_contact: dict[str, list[str]] = {}
        for name, given in self._given.items():
            if given.acts_as != "friction":
                continue
            normals = self._normals(name)
            if len(normals) == 1:
                by_contact.setdefault(normals[0], []).append(name)
                continue
            reason = (
                f"several normal forces are at right angles to it: {', '.join(normals)}"
                if normals
                else "no normal force acts on the same points at right angles to it"
            )
            yield FrictionNeeded(frictions=(name,), normal=None, coefficient=None, reason=reason)
        for normal, frictions in by_contact.items():
            yield self._coefficient(normal, frictions)

    def _normals(self, friction: str) -> list[str]:
        relations = self.dynamics.constraints.relations
        tangential = self._gradients[friction]
        found = []
        for name, given in self._given.items():
            one_sided = given.acts_as is None and self._allowed(name) is not None
            acting = self._gradients.get(name, {})
            if not (one_sided or given.acts_as == "normal") or acting.keys() != tangential.keys():
                continue
            products = [dot(acting[p], tangential[p]) for p in acting]
            if all(is_zero(product, relations) is True for product in products):
                found.append(name)
        return found

    def _coefficient(self, normal: str, frictions: Sequence[str]) -> FrictionNeeded:
        """sqrt(sum_kl F_k . F_l)/|N| on the first point of the contact."""
        values = {name: self._multipliers[name] for name in (normal, *frictions)}
        unknown = [name for name, value in values.items() if value is None]
        reason, coefficient = "", None
        where: tuple[Expression, ...] = ()
        if unknown:
            reason = f"the multiplier of '{unknown[0]}' is not determined"
        elif is_zero(values[normal] or S.Zero, self.dynamics.constraints.relations) is True:
            reason = "the normal force is 0"
        else:
            point, c = next(iter(self._gradients[normal].items()))
            ratios = [
                sympy.Add(*(values[f] * self._gradients[f][point][axis] for f in frictions))
                / (values[normal] * self._length(c))
                for axis in range(len(c))
            ]
            size, positive = self._without_moduli(self.shapes.simplify(self._length(tuple(ratios))))
            coefficient = self.readable.on_surface(size)
            where = tuple(map(self.readable.on_surface, positive))
        return FrictionNeeded(
            frictions=tuple(frictions),
            normal=normal,
            coefficient=coefficient,
            where=where,
            reason=reason,
        )

    def _without_moduli(self, size: Expr) -> tuple[Expr, list[Expr]]:
        """|f(parameters)| as f or -f, by the values of the file, and what is positive there."""
        positive = []
        for modulus in sorted(size.atoms(sympy.Abs), key=str):
            inside = modulus.args[0].xreplace(exact_values(self.system))
            direction = None if inside.free_symbols else sign(inside)
            if direction:
                positive.append(direction * modulus.args[0])
                size = size.xreplace({modulus: positive[-1]})
        return size, positive


def _moves(position: Vector, dynamics: Dynamics) -> bool:
    variables = {*dynamics.system.q, dynamics.system.t}
    return any(component.free_symbols & variables for component in position)
