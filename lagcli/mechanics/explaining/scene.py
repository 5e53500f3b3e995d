"""The first step: coordinates, constraints and what kind they are, degrees of freedom."""

from __future__ import annotations

from collections.abc import Iterator

from lagcli.algebra import is_zero
from lagcli.document import Block, Equations, Items, Row, equations_of
from lagcli.expression import ZERO, Name, Negative
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, counted, names, quoted, says

_COMPARISONS = {"<": " < ", "<=": " ≤ ", ">": " > ", ">=": " ≥ "}


def scene(explainer: Explainer) -> Iterator[Block]:
    """What moves, and what restricts it."""
    problem, dynamics = explainer.problem, explainer.dynamics
    coordinates = explainer.system.names
    one = len(coordinates) == 1
    yield says(
        "The coordinate " if one else "The coordinates ",
        names(coordinates),
        " describes the configuration." if one else " describe the configuration.",
        *_constants([p.name for p in problem.parameters if p.name not in problem.named]),
    )
    equations = dynamics.constraints.equations
    if not equations:
        count = len(coordinates)
        yield says(
            f"No constraint is stated: the system has {counted(count, 'degree')} of freedom."
        )
        yield from _gaps(explainer)
        return
    what = counted(len(equations), "constraint").capitalize()
    verb = "restricts the motion, with this equal to 0:"
    if len(equations) > 1:
        verb = "restrict the motion, with these equal to 0:"
    yield says(f"{what} {verb}")
    yield equations_of(
        (explainer.letters.f(e.name), explainer.readable.as_written(e.f)) for e in equations
    )
    yield Items(tuple(tuple(_kind(explainer, equation)) for equation in equations))
    yield from _relations_of_several(explainer)
    yield from _contacts(explainer)
    yield from _freedom(explainer)
    yield from _gaps(explainer)


def _constants(parameters: list[str]) -> list[Part]:
    if not parameters:
        return []
    if len(parameters) == 1:
        return [" The parameter ", Name(parameters[0]), " is a constant."]
    return [" The parameters ", *names(parameters), " are constants."]


def _kind(explainer: Explainer, equation: ConstraintEquation) -> list[Part]:
    constraints = explainer.dynamics.constraints
    kind = constraints.kinds[equation.name]
    parts: list[Part] = [f"'{equation.name}' "]
    if kind == "holonomic":
        parts.append("contains no velocity, it is holonomic: it restricts the positions.")
    elif kind == "integrable":
        alone = constraints.is_integrable_alone(equation)
        together = "" if alone else "together with the others "
        t = explainer.system.t
        moving = any(e.drift != 0 or any(a.has(t) for a in e.row) for e in constraints.equations)
        timed = " and the time" if moving else ""
        parts.append(
            f"is written with velocities, yet {together}it can be integrated to a relation "
            f"between the coordinates{timed}: it restricts the positions as a holonomic "
            "constraint does."
        )
    else:
        parts.append(
            "relates velocities and cannot be integrated to a relation between the coordinates: "
            "it is nonholonomic. By itself it restricts the velocities, not the positions."
        )
    if is_zero(equation.drift) is not True:
        parts.append(
            " It depends on t explicitly, so the constraint itself moves and its force can do work."
            if equation.holonomic
            else " It has a term without velocities, so its force can do work."
        )
    return parts


def _relations_of_several(explainer: Explainer) -> Iterator[Block]:
    """What combinations of constraints that are nonholonomic one by one leave of the positions."""
    count = explainer.dynamics.constraints.relations_of_several
    if count:
        what = "one relation" if count == 1 else f"{count} relations"
        yield says(
            f"Combinations of the constraints can be integrated to {what} between the "
            "coordinates, so that together they do restrict the positions."
        )


def _contacts(explainer: Explainer) -> Iterator[Block]:
    contacts = [c for c in explainer.problem.constraints if c.holds_while is not None]
    hold = "they hold" if len(contacts) > 1 else "it holds"
    for contact in contacts:
        bound = contact.holds_while
        assert bound is not None
        yield says(
            f"'{contact.name}' is one-sided: it holds only while ",
            bound.left,
            _COMPARISONS[bound.comparison],
            bound.right,
            "." if contact is not contacts[-1] else f". What follows is valid as long as {hold}.",
        )


def _gaps(explainer: Explainer) -> Iterator[Block]:
    """The contacts of the file, which act only while they are closed."""
    contacts = explainer.problem.contacts
    if not contacts:
        return
    build, write = explainer.system.build, explainer.readable.as_written
    one = len(contacts) == 1
    what = counted(len(contacts), "contact").capitalize()
    verbs = "acts only while its gap is 0 and pushes" if one else (
        "act, each only while its gap is 0, and push")  # fmt: skip
    yield says(f"{what} {verbs} towards a larger gap:")
    rows = []
    for contact in contacts:
        gap = build(contact.equation.left) - build(contact.equation.right)
        rows.append(Row(explainer.letters.free(f"gap_{contact.name}"), write(gap)))
    yield Equations(tuple(rows))
    for contact in contacts:
        if contact.restitution is None:
            yield says(f"Where the gap '{contact.name}' closes, a run stops.")
        elif contact.restitution == ZERO:
            yield says(f"At an impact the rate of the gap '{contact.name}' becomes 0.")
        else:
            yield says(f"At an impact the rate of the gap '{contact.name}' is multiplied by ",
                       Negative(contact.restitution), ".")  # fmt: skip
    struck = any(contact.restitution is not None for contact in contacts)
    when = "between impacts, " if struck else ""
    yield says(f"What follows holds {when}while {'the gap is' if one else 'all gaps are'} open.")


def _freedom(explainer: Explainer) -> Iterator[Block]:
    dynamics = explainer.dynamics
    count, rank = len(explainer.system.names), len(dynamics.independent_constraints)
    if dynamics.redundant:
        verbs = ("follows", "restricts") if len(dynamics.redundant) == 1 else ("follow", "restrict")
        yield says(
            f"{quoted(dynamics.redundant)} {verbs[0]} from the others and {verbs[1]} nothing more."
        )
    left = counted(count - rank, "degree")
    yield says(
        f"{counted(count, 'velocity', 'velocities').capitalize()} minus "
        f"{counted(rank, 'independent condition')} on {'it' if count == 1 else 'them'}: "
        f"{count} − {rank} = {count - rank}, so the system has {left} of freedom."
    )
