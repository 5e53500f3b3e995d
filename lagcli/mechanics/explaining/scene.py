"""The first step: coordinates, constraints and what kind they are, degrees of freedom."""

from __future__ import annotations

from collections.abc import Iterator

from lagcli.algebra import is_zero
from lagcli.document import Block, Equations, Items, Row
from lagcli.expression import Name
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import Part, counted, names, quoted, says

_COMPARISONS = {"<": " < ", "<=": " ≤ ", ">": " > ", ">=": " ≥ "}


def scene(teller: Teller) -> Iterator[Block]:
    """What moves, and what restricts it."""
    problem, dynamics = teller.problem, teller.dynamics
    coordinates = teller.system.names
    one = len(coordinates) == 1
    yield says(
        "The coordinate " if one else "The coordinates ",
        names(coordinates),
        " describes where everything is." if one else " describe where everything is.",
        *_constants([p.name for p in problem.parameters]),
    )
    equations = dynamics.constraints.equations
    if not equations:
        count = len(coordinates)
        yield says(
            f"Nothing restricts {'it' if one else 'them'}: "
            f"the system has {counted(count, 'degree')} of freedom."
        )
        return
    what = counted(len(equations), "constraint").capitalize()
    verb = "restricts the motion; this" if len(equations) == 1 else "restrict the motion; these"
    yield says(f"{what} {verb} must stay 0:")
    yield Equations(
        tuple(Row(teller.letters.f(e.name), teller.readable.as_written(e.f)) for e in equations)
    )
    yield Items(tuple(tuple(_kind(teller, equation)) for equation in equations))
    yield from _contacts(teller)
    yield from _freedom(teller)


def _constants(parameters: list[str]) -> list[Part]:
    if not parameters:
        return []
    if len(parameters) == 1:
        return [" The parameter ", Name(parameters[0]), " is a constant."]
    return [" The parameters ", *names(parameters), " are constants."]


def _kind(teller: Teller, equation: ConstraintEquation) -> list[Part]:
    constraints = teller.dynamics.constraints
    several = sum(not e.holonomic for e in constraints.equations) > 1
    kind = constraints.kinds[equation.name]
    parts: list[Part] = [f"'{equation.name}' "]
    if kind == "holonomic":
        parts.append("contains no velocity, it is holonomic: it restricts the positions.")
    elif kind == "integrable":
        together = "together with the other velocity constraints " if several else ""
        parts.append(
            f"is written with velocities, yet {together}it can be integrated to a relation "
            "between the coordinates (and the time): it restricts the positions as a holonomic "
            "constraint does."
        )
    else:
        parts.append(
            "relates velocities and cannot be integrated to a relation between the coordinates: "
            "it is nonholonomic. By itself it restricts the velocities, not the positions."
        )
    if is_zero(equation.drift) is not True:
        parts.append(
            " It contains the time, so the constraint itself moves and its force can do work."
            if equation.holonomic
            else " It has a term without velocities, so its force can do work."
        )
    return parts


def _contacts(teller: Teller) -> Iterator[Block]:
    contacts = [c for c in teller.problem.constraints if c.holds_while is not None]
    for contact in contacts:
        bound = contact.holds_while
        assert bound is not None
        yield says(
            f"'{contact.name}' is one-sided: it holds only while ",
            bound.left,
            _COMPARISONS[bound.comparison],
            bound.right,
            ". What follows is true as long as it does.",
        )


def _freedom(teller: Teller) -> Iterator[Block]:
    dynamics = teller.dynamics
    count, rank = len(teller.system.names), len(dynamics.independent_constraints)
    if dynamics.redundant:
        verbs = ("follows", "restricts") if len(dynamics.redundant) == 1 else ("follow", "restrict")
        yield says(
            f"{quoted(dynamics.redundant)} {verbs[0]} from the others and {verbs[1]} nothing more."
        )
    left = counted(count - rank, "degree")
    yield says(
        f"{counted(count, 'velocity', 'velocities').capitalize()} less "
        f"{counted(rank, 'independent condition')} on them: "
        f"{count} − {rank} = {count - rank}, so the system has {left} of freedom."
    )
