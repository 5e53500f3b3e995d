"""The check, and what each multiplier means as a force."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import is_zero
from lagcli.document import Block, Label, equations_of
from lagcli.expression import Name
from lagcli.mechanics.constraint_force import fixed_axes, forces_on_points
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import SolvedMotion
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import names, says
from lagcli.statements.wording import only_along_its_path

#: What acts along a coordinate, by its unit.
_KINDS = {"m": "force", "cm": "force", "mm": "force", "km": "force", "rad": "torque",
          "deg": "torque"}  # fmt: skip


def check(explainer: Explainer, motion: SolvedMotion) -> Iterator[Block]:
    """How the solution was checked."""
    several = len(explainer.dynamics.constraints.equations) > 1
    equations = "Lagrange's equations" if explainer.letters.several else "Lagrange's equation"
    one = "accelerations" if explainer.letters.several else "acceleration"
    constraints = explainer.constraints
    multipliers = "multipliers" if several else "the multiplier"
    what = f"{one} and {multipliers}" if constraints else one
    where = f"into {equations}" + f" and into the differentiated {constraints}" * bool(constraints)
    verb = "were" if constraints or explainer.letters.several else "was"
    yield says(
        f"The {what} {verb} substituted {where}. The left side minus the right side is 0"
        + f" on the {constraints}" * bool(constraints)
        + (
            ": it simplifies to 0 exactly."
            if motion.verified == "exact"
            else ", evaluated at random states to 50 digits."
        )
    )


def meaning(explainer: Explainer, motion: SolvedMotion) -> Iterator[Block]:
    """Each constraint's force along the coordinates, its direction, and on the points."""
    dynamics = explainer.dynamics
    on_points = forces_on_points(dynamics)
    yield says(
        "The generalized force of a constraint is its multiplier times its gradient: a force along "
        "a length, a torque along an angle. For a positive multiplier it has the direction in "
        "which "
        "the left side of the constraint minus its right side grows, for a negative one the "
        "opposite."
    )
    for k, equation in enumerate(dynamics.constraints.equations):
        multiplier = Name(equation.multiplier.name)
        along = [
            name
            for name, entry in zip(explainer.system.names, equation.row, strict=True)
            if is_zero(entry) is not True
        ]
        yield says(
            f"'{equation.name}' acts along ",
            names(along),
            ":",
        )
        found = dynamics.constraint_forces[k]
        yield equations_of(
            (
                Label("Q", (name,)),
                explainer.readable.as_written(equation.multiplier * entry)
                if found is None
                else explainer.readable.on_surface(found[j]),
            )
            for j, (name, entry) in enumerate(
                zip(explainer.system.names, equation.row, strict=True)
            )
            if is_zero(entry) is not True
        )
        yield from _direction(explainer, equation, multiplier, along)
        yield from _on_points(explainer, on_points.get(equation.name, {}))
        if motion.multipliers[k] is not None and is_zero(motion.multipliers[k]) is True:
            yield says("It is 0: the motion satisfies the constraint without a force.")
    if dynamics.redundant and dynamics.total_constraint_force is not None:
        yield says("The sum of the constraint forces is")
        total = map(explainer.readable.on_surface, dynamics.total_constraint_force)
        labels = [Label("Q", (name,)) for name in explainer.system.names]
        yield equations_of(zip(labels, total, strict=True))


def _direction(
    explainer: Explainer, equation: ConstraintEquation, multiplier: Name, along: list[str]
) -> Iterator[Block]:
    """Where the multiplier is the force itself, and which way a positive one points."""
    if len(along) != 1:
        return
    units = {c.name: c.unit for c in explainer.problem.coordinates}
    kind = _KINDS.get(units[along[0]] or "", "generalized force")
    q, entry = Name(along[0]), sympy.Add(*equation.row)
    if is_zero(entry - 1) is True:
        yield says(multiplier, f" equals this {kind}: positive towards larger ", q, ".")
    elif is_zero(entry + 1) is True:
        yield says(multiplier, f" equals minus this {kind}: positive towards smaller ", q, ".")


def _on_points(explainer: Explainer, points: dict[str, tuple[sympy.Expr, ...]]) -> Iterator[Block]:
    if not points:
        return
    fixed = {point: fixed_axes(explainer.dynamics, point) for point in points}
    yield says("In Cartesian components its force on the " + ("points is" if len(points) > 1
               else "point is"))  # fmt: skip
    yield equations_of(
        (Label("F", (point, axis)), explainer.readable.on_surface(component))
        for point, components in points.items()
        for axis, component in zip("xyz", components, strict=False)
        if axis not in fixed[point]
    )
    for point, axes in fixed.items():
        yield from only_along_its_path(point, axes)
