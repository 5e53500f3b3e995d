"""Equilibria and steady motions, with their stability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain, islice
from math import isqrt
from typing import TypeVar

from flint import arb, arb_mat, ctx

from lagcli.expression import Call, Expression, Name, Negative, walk
from lagcli.record import replace
from lagcli.statements.answers import EquilibriaSection, Equilibrium
from lagcli.statements.motions import Above, SteadyMotion, SteadySection, Verdict
from lagcli.verification.claims.eliminated import reduced_momenta
from lagcli.verification.claims.held import stays_held
from lagcli.verification.claims.near import NOTHING, LinearMotion, eigenvalues_of_motion, occur
from lagcli.verification.claims.poles import refuted_at_a_pole
from lagcli.verification.claims.rest import (
    BITS,
    RestPlace,
    conditions,
    may_lose_contact,
    named,
    not_confirmed,
    with_closed_contacts,
    without_open,
)
from lagcli.verification.claims.stability import refutes
from lagcli.verification.claims.unlisted import (
    Balance,
    at_special_values,
    repeated,
    shown,
    unlisted,
    without_sign,
)
from lagcli.verification.examination import Examination
from lagcli.verification.linear import size
from lagcli.verification.reference import DynamicsAtState
from lagcli.verification.states import State

#: Relative differences of eigenvalues: those of multiplicity 2 are right to 1e-19.
_AGREE = 1e-9

#: States with parameters of other sizes at which several conditions are tried.
_SPREAD = 12
_Place = TypeVar("_Place", Equilibrium, SteadyMotion)
_WHY = "the verdict was not confirmed at random states"
#: Of a place whose conditions no parameters satisfy: it is left out, the others stay.
_NOWHERE = Verdict(stable=None, reason="no parameters were found that satisfy its conditions")


def equilibria(x: Examination, section: EquilibriaSection) -> EquilibriaSection:
    """Each is a state of rest, and its stability that of the linear motion near it."""
    if section.equilibria is None:
        return section
    listed, found = section.equilibria, []
    if not _repeat(x, section.periods):
        section = replace(section, periods={})
    with ctx.workprec(BITS):
        for each in listed:
            what = f"the equilibrium {named(each.at, each.on)}"
            if {*each.free, *each.indeterminate} & {*each.at}:
                x.refute(what, "a coordinate with a value is called free")
                return replace(section, equilibria=None, reason=not_confirmed("an equilibrium"))
            if each.sticking or each.kinked:
                place = RestPlace(x, what, each.at, {}, each.on, each.where)
                if not stays_held(x, what, place, each):
                    return replace(section, equilibria=None, reason=not_confirmed("an equilibrium"))
                found.append(each)
                continue
            y = without_open(x, each.open)
            y = with_closed_contacts(y, RestPlace(y, what, each.at, {}, each.on, each.where))
            place = RestPlace(y, what, each.at, {}, each.on, each.where)
            judged = Verdict(stable=None) if section.at_all_times else each.verdict
            zeros = 2 * _cyclic(x) if judged.potential == "U_eff" else 0
            others = [RestPlace(y, what, o.at, {}, o.on, o.where) for o in listed if o is not each]
            verdict = _stays(x, what, place, judged, zeros=zeros, others=others)
            if verdict is None:
                return replace(section, equilibria=None, reason=not_confirmed("an equilibrium"))
            if verdict is _NOWHERE:
                section = replace(section, complete=False)
                continue
            found.append(each if verdict is judged else replace(each, verdict=verdict))
        found = _once(x, "the equilibrium", found)
        searched = section.complete and not section.at_all_times
        other = _another(x, found) if searched else ""
        if searched and not (other or found or section.where):
            other = _special(x, "the equilibria", section.unless)
    if other:
        x.refute("completeness of the equilibria", f"there is one at {other}")
        section = replace(section, complete=False)
    return replace(section, equilibria=tuple(found))


def _repeat(x: Examination, periods: Mapping[str, Expression]) -> bool:
    """Whether the laws at places a period apart are the same."""
    what = "a period of the equilibria"
    places = x.places(what, [*periods.values()])
    if places is None:
        return False

    def both(s: State) -> tuple[list[arb], list[arb]]:
        here: list[arb] = []
        there: list[arb] = []
        for name, place in zip(periods, places, strict=True):
            shifted = {(name, 0): s.environment[name, 0] + s.at(place)}
            moved = DynamicsAtState(x.reference, x.reference.values({**s.environment, **shifted}))
            for laws, values in ((s.laws, here), (moved, there)):
                values += [*laws.momenta, *laws.drift, *laws.applied]
        return here, there

    return not periods or x.decide(what, both)


def _once(
    x: Examination, what: str, found: list[_Place], turning: Sequence[str] = ()
) -> list[_Place]:
    """The list without those that are an earlier one, which are noted; at a pole none is."""
    tried = [k for k, each in enumerate(found) if getattr(each, "rates", {}) is not None]
    if x.reference.large or x.problem.contacts or len(tried) < 2:
        return found
    some = [found[k] for k in tried]
    places = [RestPlace(x, what, m.at, getattr(m, "rates", {}), m.on, m.where) for m in some]
    mirrored = [getattr(m, "mirrored", False) for m in some]
    again = {tried[k] for k in repeated(Balance(x, turning), places, mirrored)}
    for k in sorted(again):
        x.refute(f"{what} {named(found[k].at, found[k].on)}", "it is listed twice")
    return [each for k, each in enumerate(found) if k not in again]


def _cyclic(x: Examination) -> int:
    """How many coordinates do not occur in L."""
    slopes = (x.reference.by(x.reference.lagrangian, q) for q in x.reference.q)
    return sum(slope == x.reference.program.zero for slope in slopes)


def _another(x: Examination, found: list[Equilibrium]) -> str:
    """An equilibrium that none of these is; empty where none was found."""
    if (
        x.reference.large
        or x.problem.contacts
        or any(each.sticking or each.kinked for each in found)
    ):
        return ""
    places = [RestPlace(x, "the equilibria", each.at, {}, each.on, each.where) for each in found]
    near = next(unlisted(Balance(x), places), None)
    return "" if near is None else shown(near)


def _special(
    x: Examination,
    what: str,
    unless: Sequence[Expression] | None,
    turning: Sequence[str] = (),
) -> str:
    """A place where there is said to be none but where each of `unless` vanishes."""
    places = None if unless is None else x.places(what, unless)
    if places is None or x.reference.large or x.problem.contacts or x.problem.functions:
        return ""
    near = at_special_values(x, places, turning)
    if near is None:
        return ""
    return shown(near, turning, [p.name for p in without_sign(x)])


def steady_motions(x: Examination, section: SteadySection) -> SteadySection:
    """Each stays as it is, and its stability is that of the linear motion near it."""
    if section.motions is None:
        return section
    found = []
    with ctx.workprec(BITS):
        for each in section.motions:
            what = f"the steady motion {named(each.at, each.on)}"
            if {*each.free} & {*each.at}:
                x.refute(what, "a coordinate with a value is called free")
                return replace(section, motions=None, reason=not_confirmed("a steady motion"))
            if each.rates is None:
                if why := refuted_at_a_pole(x, what, each):
                    x.refute(what, why)
                    return replace(section, motions=None, reason=not_confirmed("a steady motion"))
                found.append(each)
                continue
            if each.mirrored and not _mirrored(x, what, each):
                return replace(section, motions=None, reason=not_confirmed("a steady motion"))
            place = RestPlace(x, what, each.at, each.rates, each.on, each.where, section.eliminated)
            zeros = len(each.rates) * (1 if each.rolling else 2)
            verdict = _stays(x, what, place, each.verdict, zeros=zeros)
            if verdict is _NOWHERE:
                section = replace(section, complete=False)
                continue
            if verdict is None or not _with_momenta(x, what, place, each):
                return replace(section, motions=None, reason=not_confirmed("a steady motion"))
            found.append(each if verdict is each.verdict else replace(each, verdict=verdict))
        turning = [name for each in found if each.rolling for name in each.rates or ()]
        found = _once(x, "the steady motion", found, [*section.momenta, *dict.fromkeys(turning)])
        other = _another_motion(x, section, found) if section.complete else ""
    if other:
        x.refute("that there is no other steady motion", f"there is one with {other}")
        section = replace(section, complete=False)
    with ctx.workprec(BITS):
        if not all(_meets(x, section, each) for each in found if each.rates is not None):
            section = replace(section, conditions={})
    return replace(section, motions=tuple(found))


def _meets(x: Examination, section: SteadySection, motion: SteadyMotion) -> bool:
    """Whether what is printed to vanish for a steady motion vanishes for this one."""
    what = "the conditions of a steady motion"
    places = x.places(what, list(section.conditions.values()))
    momenta = x.places(what, list(motion.momenta.values()))
    if places is None or momenta is None:
        return False
    known = section.eliminated
    place = RestPlace(x, what, motion.at, motion.rates or {}, motion.on, motion.where, known)
    for near in place.states():
        p = {
            (f"p_{name}", 0): near.at(at) for name, at in zip(motion.momenta, momenta, strict=True)
        }
        at = x.reference.values({**near.environment, **p})
        for each in places:
            scale = 1 + max(map(size, at.gradient(each).values()), default=0.0)
            if at(each).is_finite() and size(at(each)) > NOTHING * scale:
                x.refute(what, f"they do not hold for that with {shown(near)}")
                return False
    return True


def _mirrored(x: Examination, what: str, motion: SteadyMotion) -> bool:
    """Whether it stays with opposite rates, too."""
    rates = {name: Negative(rate) for name, rate in (motion.rates or {}).items()}
    what = f"{what} with opposite rates"
    place = RestPlace(x, what, motion.at, rates, motion.on, motion.where)
    return _stays(x, what, place, Verdict(stable=None), zeros=2 * len(rates)) is not None


def _another_motion(x: Examination, section: SteadySection, found: list[SteadyMotion]) -> str:
    """A steady motion that none of these is; empty where none was found."""
    if x.reference.large or x.reference.rows or section.eliminated or section.acting:
        return ""
    if x.problem.contacts or any(each.rolling for each in found):
        return ""
    turning = section.momenta
    places = [
        RestPlace(x, "the steady motions", each.at, each.rates or {}, each.on, each.where)
        for each in found
    ]
    mirrored = [each.mirrored for each in found]
    near = next(unlisted(Balance(x, turning), places, mirrored=mirrored), None)
    if near is not None:
        return shown(near, turning)
    if not (found or section.where or section.resting):
        return _special(x, "the steady motions", section.unless, turning)
    poles = [place for place, each in zip(places, found, strict=True) if each.rates is None]
    resting = unlisted(Balance(x), poles)
    near = next((each for each in resting if each.at_a_pole), None)
    return "" if near is None else shown(near)


def _stays(
    x: Examination,
    what: str,
    place: RestPlace,
    verdict: Verdict,
    *,
    zeros: int,
    others: Sequence[RestPlace] = (),
) -> Verdict | None:
    """The verdict, an undecided one where it is refuted; None where the state does not stay.

    At a state of one of the `others` its conditions need not hold.  The linear motion near it has
    at least as many roots 0 as `zeros`.
    """
    tried = 0
    for near in place.states() if place.readable else ():
        if near.without_lagrangian:
            x.refute(
                what, "L has no value there for some parameters with which it is said to exist"
            )
            return None
        if not near.defined:
            continue
        tried += 1
        if not _is_at_rest(near, place, zeros):
            x.refute(what, "the equations of motion do not let it stay there")
            return None
        why = (
            ""
            if place.eliminated
            else refutes(x, what, near, verdict, zeros, place.dimension(near))
        )
        if why:
            x.refute(f"the stability of {what}", why)
            return Verdict(stable=None, reason=_WHY)
    if not place.readable:
        return None
    unknown = x.problem.functions or x.reference.rows or x.problem.contacts
    if not tried and place.where and not unknown:
        x.refute(what, _NOWHERE.reason)
        return _NOWHERE
    if not unknown and place.unreal():
        x.refute(what, "it is not real for some parameters with which it is said to exist")
        return None
    if not tried:
        x.unchecked.append(what)
    if not (unknown or x.reference.large) and _exists_beyond(place, zeros, others):
        x.refute(what, "it exists for parameters with which its conditions do not hold, too")
        return None
    why = "" if place.eliminated else _refuted_beside_bounds(x, what, place, verdict, zeros)
    if why:
        x.refute(f"the stability of {what}", why)
        return Verdict(stable=None, reason=_WHY)
    return verdict


def _is_at_rest(near: LinearMotion, place: RestPlace, zeros: int) -> bool:
    return near.residual < NOTHING if not zeros else _constant(near, place.eliminated)


def _exists_beyond(place: RestPlace, zeros: int, others: Sequence[RestPlace]) -> bool:
    """Whether it stays there with parameters for which a printed condition fails."""
    return any(
        near.defined and near.regular and not near.without_lagrangian
        and _is_at_rest(near, place, zeros) and not any(o.contains(near) for o in others)
        for near in place.beyond()
    )  # fmt: skip


def _refuted_beside_bounds(
    x: Examination, what: str, place: RestPlace, verdict: Verdict, zeros: int
) -> str:
    """Why a verdict cannot be right near where its conditions begin to hold, or always."""
    given = (verdict.minimum or (), verdict.hurwitz or (), verdict.spectrum or (), verdict.unstable)
    if any(_is_void(each) for group in given for each in group):
        return "one of its conditions says nothing"
    bounds = conditions(x, what, [each for group in given for each in group])
    always = () in (verdict.hurwitz, verdict.spectrum)
    beside = () if always else place.beside(bounds)
    # of two conditions one may hide where the other is wrong
    spread = islice(place.spread(), None if always else _SPREAD if len(bounds) > 2 else 0)
    found = (
        refutes(x, what, near, verdict, zeros, place.dimension(near))
        for near in chain(beside, spread)
        if near.defined and (zeros or near.residual < NOTHING)
    )
    return next(filter(None, found), "")


def _is_void(condition: Above) -> bool:
    """Whether no quantity occurs in it, as in 0 > 0."""
    parts = (part for side in (condition.left, condition.right) for part in walk(side))
    return not any(isinstance(part, (Name, Call)) for part in parts)


def _constant(near: LinearMotion, eliminated: Sequence[str]) -> bool:
    """Whether q'' is 0 but for what the constraints eliminate: velocities are constant."""
    if not near.regular:
        return True
    scale = 1 + max(float(abs(v).mid()) for v in near.laws.velocities) ** 2
    pairs = zip(near.x.reference.names, near.laws.accelerations, strict=True)
    kept = [a for name, a in pairs if name not in eliminated]
    return all(float(abs(a).mid()) < NOTHING * scale for a in kept)


def _with_momenta(x: Examination, what: str, place: RestPlace, motion: SteadyMotion) -> bool:
    """The momenta, and the squared frequencies, are those of the motion."""
    names = x.reference.names
    momenta = x.places(what, list(motion.momenta.values()))
    squares = x.places(what, list(motion.frequencies_squared))
    matrices = [x.places(what, [e for row in m for e in row]) for m in _matrices(motion)]
    if momenta is None or squares is None or None in matrices:
        return False
    given = {*motion.at, *(motion.rates or ())}
    gone = [j for j, name in enumerate(names) if x.reference.rows and name not in given]
    for near in place.states():
        p = reduced_momenta(near.laws, gone)
        true = [p[names.index(name)] for name in motion.momenta]
        printed = [near.at(p) for p in momenta]
        if not all(_close(a, b) for a, b in zip(printed, true, strict=True) if a.is_finite()):
            x.refute(what, "the momenta are not those of its rates")
            return False
        known = near.regular and not place.eliminated
        if known and not occur(near, [near.at(square) for square in squares]):
            x.refute(what, "a frequency is not one of the linear motion near it")
            return False
        mass, velocity, stiffness = ([near.at(e) for e in m or ()] for m in matrices)
        if known and not _same_motion(near, [mass, velocity, stiffness]):
            x.refute(what, "the matrices are not those of the linear motion near it")
            return False
        swings = len(mass) == 1 and size(velocity[0]) < NOTHING * size(mass[0])
        shape = {*names} - {*(motion.rates or ())}
        missing = shape and not squares and (swings or not (mass or x.has_kinks))
        if known and missing and not may_lose_contact(x):
            x.refute(what, "its frequency is left out")
            return False
    return True


def _matrices(motion: SteadyMotion) -> tuple[tuple[tuple[Expression, ...], ...], ...]:
    return motion.mass, motion.velocity, motion.stiffness


def _same_motion(near: LinearMotion, flat: Sequence[Sequence[arb]]) -> bool:
    """Whether M a'' + C a' + K a = 0 has eigenvalues of the motion near it only."""
    size = isqrt(len(flat[0]))
    if not size or any(len(m) != size * size for m in flat):
        return True
    M, C, K = (arb_mat(size, size, list(m)) for m in flat)
    if not all(e.is_finite() for m in flat for e in m) or M.det().contains(0):
        return True
    by_v, by_q = ((-M.solve(each)).tolist() for each in (C, K))
    left = list(near.eigenvalues)
    scale = max([1e-3, *map(abs, left)])
    for value in eigenvalues_of_motion(by_q, by_v):
        nearest = min(left, key=lambda z: abs(z - value), default=None)
        if nearest is None or abs(nearest - value) > 1e-7 * scale:
            return False
        left.remove(nearest)
    return True


def _close(a: arb, b: arb) -> bool:
    return abs(float((a - b).mid())) <= _AGREE * (abs(float(a.mid())) + abs(float(b.mid())) + 1e-6)
