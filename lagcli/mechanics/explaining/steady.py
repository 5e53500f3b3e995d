"""The step on steady motions: the condition, each motion, and its small displacements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import cast

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.document import Block, Equations, Heading, Row, equations_of, vanishing
from lagcli.expression import ZERO, Expression, Name, Number, Power
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.given_momenta import two_rates
from lagcli.mechanics.explaining.recurring import recurring
from lagcli.mechanics.explaining.words import (
    Part,
    constraints_allow,
    displacements,
    listed,
    names,
    no_solution,
    says,
)
from lagcli.mechanics.reduction.routh import ALL_CYCLIC, NONE_LEFT
from lagcli.statements.answers import Section
from lagcli.statements.motions import SteadyMotion, SteadySection
from lagcli.statements.plus_minus import mirror_images, steady_in_pairs, unlike
from lagcli.statements.stability import steady_stability
from lagcli.statements.steady import (
    in_moving_frames,
    in_polar_coordinates,
    other_motions,
    the_equilibria,
)
from lagcli.statements.wording import (
    POTENTIALS,
    at_special_values,
    capitalized,
    conditions,
    constraints_give,
    linear_equations,
    other_places,
    place_rows,
    unless,
    while_open,
)

_BALANCED = {
    (): "vanish",
    ("forces",): "balance the other forces",
    ("constraints",): "vanish along every displacement that {allowed}",
    ("forces", "constraints"): "balance the other forces along every displacement that {allowed}",
}


_NO_MOMENTUM = "No coordinate can be eliminated by a constant momentum"
_AT_EQUALITY = " At equality it is a state of rest; what follows is for the inequality."


def steady(explainer: Explainer, section: Section) -> Iterator[Block]:
    """The relative equilibria: cyclic velocities constant, the other coordinates at rest."""
    found = cast(SteadySection, section)
    if "inertia" in found.acting:
        yield says(*_with_constant_velocities(explainer, found))
        yield from _steady_states(explainer, found)
        return
    if found.motions is None and found.reason == ALL_CYCLIC:
        formulas = (explainer.system.L, *(e.f for e in explainer.dynamics.constraints.equations))
        timed = any(not free_of(each, [explainer.system.t]) for each in formulas)
        constant = (
            "momenta are constant" if timed else "velocities are constant: every motion is steady"
        )
        between = while_open(explainer.derivation.problem.contacts)
        left = " that is left" if explainer.dynamics.constraints.equations else ""
        yield says(f"Every coordinate{left} is cyclic, so all {constant}{between}.")
        return
    if found.motions is None and found.reason == NONE_LEFT:
        yield says("The constraints leave no coordinate: they prescribe the motion.")
        return
    if found.motions is None and not found.conditions:
        yield says(f"They were not found: {found.reason}.")
        return
    if not found.momenta and (found.conditions or found.motions):
        if known := [*the_equilibria(found, explainer.stated)]:
            yield from known
            return
        lead = _steady_without_momenta(explainer, found)
        yield says(_NO_MOMENTUM, lead if _wanted(found) else f"{lead[:-1]}.")
        yield from _steady_states(explainer, found)
        return
    allowed = constraints_allow(len(explainer.dynamics.constraints.equations))
    yield says(
        "In a steady motion the coordinates that are not cyclic are constant, and the cyclic ones "
        "have constant velocities. All velocities and accelerations in the Routhian's "
        "equations are "
        "then 0, so the derivatives of ",
        POTENTIALS["U_eff"],
        f" {_BALANCED[found.acting].format(allowed=allowed)}, with the momenta of the cyclic "
        "coordinates as constants"
        f"{':' if _wanted(found) else ', which they do everywhere.'}",
    )
    yield from _steady_states(explainer, found)


def _with_constant_velocities(explainer: Explainer, found: SteadySection) -> list[Part]:
    """What vanishes where rates are sought that no constant momentum gives."""
    end = ":" if any(each != ZERO for each in found.conditions.values()) else "."
    rest: list[Part] = [
        *_that_rest(explainer, found),
        f" What is left of the equations of motion vanishes{end}",
    ]
    if not found.eliminated:
        return ["In a steady motion the velocities are constant.", *rest]
    given = [*names(found.eliminated, 1), " in terms of the other velocities, which are constant"]
    return [constraints_give(found.eliminated), *given, " in a steady motion.", *rest]


def _that_rest(explainer: Explainer, found: SteadySection) -> list[Part]:
    """The coordinates that the accelerations depend on: phi' = 0 of a sled that runs straight."""
    states, motion = found.motions or (), explainer.dynamics.motion
    resting = dict.fromkeys(
        name for each in states for name in (*each.at, *each.free) if not name.endswith("'")
    )
    if not states and motion is not None:
        moved = {x for f in motion.accelerations for x in f.free_symbols}
        resting = dict.fromkeys(q.name for q in explainer.system.q if q in moved)
    if not resting:
        return []
    kind = " So is the coordinate" if len(resting) == 1 else " So are the coordinates"
    return [f"{kind} that the accelerations depend on, ", *names(tuple(resting)), "."]


def _steady_without_momenta(explainer: Explainer, found: SteadySection) -> str:
    """What is steady: the equilibria, under velocity constraints other states perhaps, too."""
    equations = explainer.dynamics.constraints.equations
    if all(e.holonomic for e in equations):
        if any(is_zero(e.drift) is not True for e in equations):
            return ", so in a steady motion the coordinates that are left rest:"
        frames = ", at rest or in a frame of constant velocity" * bool(found.frames)
        return f", so in these coordinates the steady motions are the equilibria{frames}:"
    if found.motions:
        return ". The equilibria are steady motions:"
    return ". At rest these vanish:"


def _wanted(found: SteadySection) -> list[Expression]:
    """What vanishes in a steady motion and not everywhere, each once."""
    return unlike(found.conditions.values())


def _steady_states(explainer: Explainer, found: SteadySection) -> Iterator[Block]:
    if wanted := _wanted(found):
        yield vanishing(wanted)
    yield from at_special_values("one of a steady motion", found)
    if found.everywhere:
        yield says(f"Here {found.reason}.")
    elif found.motions is None:
        yield says(f"No steady motion was found: {found.reason}.")
    elif not found.motions:
        yield says(_none(found))
    for number, group in enumerate(mirror_images(steady_in_pairs(found.motions or ())), 1):
        yield Heading(f"Steady motion {number}", 2)
        yield from _motion(explainer, group[0], group[1:])
    yield from in_moving_frames(found)
    yield from in_polar_coordinates(found)
    if found.motions:
        yield from other_motions(found)
    if found.motions:
        yield from recurring(explainer)


def _none(found: SteadySection) -> list[Part]:
    """That no motion is steady, in what it was sought in."""
    if not found.complete:
        return ["No solution was found."]
    none = unless(f"steady motion{found.sought}", found.unless or ())
    lead = "this has no" if len(_wanted(found)) == 1 else "these have no"
    return [no_solution(lead, found), ": ", *none, "."]


def _motion(
    explainer: Explainer, motion: SteadyMotion, alike: Sequence[SteadyMotion] = ()
) -> Iterator[Block]:
    """One motion, or all of those `alike` at other places."""
    if motion.rolling:
        for each in (motion, *alike):
            yield from _rolling(explainer, each)
        return
    placed = bool(motion.at) or motion.on is not None
    rates = {n: rate for n, rate in (motion.rates or {}).items() if rate != Name(n, 1)}
    velocities = "velocities of the cyclic coordinates are"
    if len(motion.rates or ()) == 1:
        velocities = "velocity of the cyclic coordinate is"
    if motion.free and placed:
        yield says("For any value of ", _free(motion), ",")
    elif motion.free:
        kind = "steady motion" if motion.rates else "equilibrium"
        known = f" the {velocities}" if rates else f" it is in {kind}."
        yield says("For any value of ", _free(motion), known)
    if placed:
        yield Equations(place_rows(motion.at, motion.on))
    yield from other_places(motion, alike)
    if rates:
        if placed or not motion.free:
            yield says(f"The {velocities} then")
        yield equations_of((Name(name, 1), rate) for name, rate in rates.items())
    momenta = {n: p for n, p in motion.momenta.items() if p != Name(f"p_{n}")}
    if momenta:
        they = "the momentum is" if len(momenta) == 1 else "the momenta are"
        yield says(f"and {they}" if rates else capitalized(they))
        yield equations_of((Name(f"p_{name}"), p) for name, p in momenta.items())
        yield from two_rates(explainer, motion)
    if motion.mirrored:
        one = len(rates) == len(momenta) == 1
        these = "this velocity and momentum" if one else "these velocities and momenta"
        yield says(f"The same holds with the opposite signs of {these}.")
    if motion.where:
        yield says("It is possible for ", conditions(motion.where), ".",
                   _AT_EQUALITY if motion.rests else "")  # fmt: skip
    if motion.mass:
        yield from _displaced(explainer, motion)
    yield says(steady_stability(motion))


def _free(motion: SteadyMotion) -> list[Part]:
    return listed([Name(name.rstrip("'"), 1 if name.endswith("'") else 0) for name in motion.free])


def _rolling(explainer: Explainer, motion: SteadyMotion) -> Iterator[Block]:
    places = [Row(Name(name), value) for name, value in motion.at.items()]
    rates = {n: rate for n, rate in (motion.rates or {}).items() if rate != Name(n, 1)}
    rows = (*places, *(Row(Name(name, 1), rate) for name, rate in rates.items()))
    if motion.free:
        end = " with" if rows else "."
        yield says("This holds for any value of ", _free(motion), end)
    if rows:
        yield Equations(rows)
    if motion.where:
        yield says("It is possible for ", *conditions(motion.where), ".")
    if motion.frequencies_squared:
        family = (
            "The linearised equations have the root 0 once for each dimension of the set of "
            "steady motions near it; the other roots have the squared frequency below."
        )
        yield says(family if motion.free else "The roots of the linearised equations have the "
                   "squared frequency below.")  # fmt: skip
    yield says(steady_stability(motion))
    if motion.frequencies_squared:
        yield _squares(explainer, motion.frequencies_squared)


def _displaced(explainer: Explainer, motion: SteadyMotion) -> Iterator[Block]:
    """M x'' + C x' + K x = 0 and the squares of the frequencies."""
    unchanged = " at unchanged momenta" if motion.momenta else ""
    lead = f"Small displacements{unchanged} obey to first order "
    yield from linear_equations(lead, motion.mass, motion.velocity, motion.stiffness)
    constraints = len(explainer.dynamics.constraints.equations) if motion.displaced else 0
    yield from displacements(constraints, motion.displaced, motion.linear_where)
    squares = dict.fromkeys(motion.frequencies_squared)
    if squares:
        yield says("The squares of the frequencies are the roots of the determinant:")
        yield _squares(explainer, squares)
        if motion.may_be_complex:
            yield says("Where this is not real, displacements oscillate and grow.")


def _squares(explainer: Explainer, values: Iterable[Expression]) -> Equations:
    """omega^2 = ..., with a letter that the file does not use."""
    square = Power(explainer.letters.free("omega"), Number(Fraction(2)))
    return equations_of((square, value) for value in values)
