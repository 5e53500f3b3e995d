"""The Routhian, what follows from it, and the one degree of freedom that is left.

With the momenta p_c of the cyclic coordinates, R = L - sum p_c q_c' of the others, and
R = T_2 + sum g_j q_j' - U_eff where it is quadratic in them (Routh; Goldstein, Poole, Safko,
*Classical Mechanics*, 3rd ed., section 8.3).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from flint import arb

from lagcli.evaluation import bisected
from lagcli.expression import Expression
from lagcli.record import replace
from lagcli.statements.answers import ModelSection, ReductionSection
from lagcli.statements.motions import OneFreedom
from lagcli.verification.claims.eliminated import EliminatedFormula
from lagcli.verification.claims.periods import periods
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import Examination
from lagcli.verification.linear import dot, size
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues, column

_WHY = "what was derived does not hold at random states"
#: Of the terms of the rate of a momentum: rounding leaves some 1e-25, a force 1e-2.
_CHANGED = 1e-12
#: One turn, and lengths of other sizes beside it.
_POSITIVE = [k / 64 for k in (1, 2, 4, 8, 13, 18, *range(24, 205, 12), 256, 384, 640, 1024)]
_PLACES = [-q for q in reversed(_POSITIVE)] + _POSITIVE
#: Halvings of 3/16 to 1e-15; listed and found places are apart by 1e-13 then, or by some 1e-1.
_HALVINGS, _SAME_PLACE = 48, 1e-9


def reduction(x: Examination, section: ReductionSection) -> ReductionSection:
    """Every formula of the reduced system, at states of the whole one."""
    R = section.routhian
    if R is None:
        return section
    if section.eliminated and not section.constraints:
        x = EliminatedFormula(x, section.eliminated)
    holds = (
        _cyclic(x, section)
        and x.holds("the Routhian", R, lambda s: _routhian(x, s, section))
        and _equations(x, section)
        and _parts(x, section, R)
    )
    if not holds:
        return ReductionSection(momenta={}, routhian=None, reason=_WHY)
    one = section.one_freedom
    if one is None:
        _lacks_one_freedom(x, section, R)
    elif not _one_freedom(x, one, R):
        return replace(section, one_freedom=None)
    return section


def _cyclic(x: Examination, section: ReductionSection) -> bool:
    """The momenta of the cyclic coordinates and their velocities."""
    where = [x.reference.names.index(name) for name in section.momenta]
    rates = [x.reference.names.index(name) for name in section.reconstruction]
    return x.hold(
        "the momenta of the cyclic coordinates",
        list(section.momenta.values()),
        lambda s: [s.laws.momenta[j] for j in where],
    ) and x.hold(
        "the velocities of the cyclic coordinates",
        list(section.reconstruction.values()),
        lambda s: [s.laws.velocities[j] for j in rates],
    )


def _routhian(x: Examination, s: State, section: ReductionSection) -> arb:
    where = [x.reference.names.index(name) for name in section.momenta]
    p, v = s.laws.momenta, s.laws.velocities
    return s.laws.lagrangian - dot([p[j] for j in where], [v[j] for j in where])


def _equations(x: Examination, section: ReductionSection) -> bool:
    """Each holds on the motion, one for each coordinate that is left."""
    gone = section.momenta.keys() | set(section.eliminated)
    left = set(x.reference.names) - gone - {each.coordinate for each in section.equations}
    if left:
        x.refute("the reduced equations", f"none is that of {', '.join(sorted(left))}")
        return False
    if not x.regular:
        return True
    sides = [side for each in section.equations for side in (each.left, each.right)]
    places = x.places("the reduced equations", sides)
    if places is None:
        return False

    def both(s: State) -> tuple[list[arb], list[arb]]:
        values = [s.at(place) for place in places]
        return values[::2], values[1::2]

    return x.decide("the reduced equations", both)


def _at_rest(x: Examination, s: State) -> StepValues:
    """The state with the velocities 0, the momenta as they are."""
    still = {(name, 1): arb(0) for name in x.reference.names}
    return x.reference.values({**s.environment, **s.following, **still})


def _parts(x: Examination, section: ReductionSection, R: Expression) -> bool:
    """U_eff = -R, and g_j = dR/dq_j', where the velocities are 0."""
    place = x.place(R)
    U = section.effective_potential
    if U is None:
        return True
    what = "the effective potential"
    if not x.holds(what, U, lambda s: -_at_rest(x, s)(place), lambda s: _at_rest(x, s)):
        return False
    symbols = [x.reference.program.symbol(name, 1) for name in section.gyroscopic]
    return x.hold(
        "the gyroscopic terms",
        list(section.gyroscopic.values()),
        lambda s: column(_at_rest(x, s).gradient(place), symbols),
    )


def _lacks_one_freedom(x: Examination, section: ReductionSection, R: Expression) -> None:
    """Note that nothing is said of one coordinate that is left, with inertia and its energy."""
    left = [*{*x.reference.names} - {*section.momenta, *section.eliminated}]
    if len(left) != 1 or section.constraints or section.effective_potential is None:
        return
    program, reference, place = x.reference.program, x.reference, x.place(R)
    velocity = program.symbol(left[0], 1)
    slope = reference.by(place, velocity)
    inertia = reference.by(slope, velocity)
    energy = program.sum(program.product(velocity, slope), program.negative(place))
    if not x.states() or not x.regular:
        return
    at_each = [(s.at(inertia), s.laws.rate(energy)) for s in x.states()]
    if all(not is_zero(M) and is_zero(rate) for M, rate in at_each):
        x.refute("the motion of the one degree of freedom", "its energy is conserved")


def _one_freedom(x: Examination, one: OneFreedom, R: Expression) -> bool:
    """E = q' dR/dq' - R, dt = rate dq, and E = U_eff at the turning points."""
    place, velocity = x.place(R), x.reference.program.symbol(one.coordinate, 1)
    what = "the energy of the one degree of freedom"

    def energy(s: State) -> arb:
        slope = s.at.gradient(place).get(velocity, arb(0))
        return s.at(velocity) * slope - s.at(place)

    if not x.holds(what, one.energy, energy):
        return False
    places = x.places(what, [one.energy, one.rate, *(one.turning_points or ())])
    if places is None:
        return False
    h, rate, *turning = places

    def with_energy(s: State) -> StepValues:
        known = {**s.environment, **s.following, (one.constant, 0): s.at(h)}
        return x.reference.values(known)

    def paces(s: State) -> tuple[list[arb], list[arb]]:
        return [with_energy(s)(rate) * abs(s.at(velocity))], [arb(1)]

    def turns(s: State) -> tuple[list[arb], list[arb]] | None:
        known = {**s.environment, **s.following, (one.constant, 0): s.at(h)}
        found = [x.reference.values(known)(each) for each in turning]
        real = [q for q in found if q.is_finite()]
        there = [
            x.reference.values({**known, (one.coordinate, 0): q, (one.coordinate, 1): arb(0)})(h)
            for q in real
        ]
        kept = [e for e in there if e.is_finite()]
        return (kept, [s.at(h)] * len(kept)) if kept else None

    if not x.decide("the rate of the one degree of freedom", paces):
        return False
    if one.turning_points is not None and (q := _another_turning_point(x, one, h, turning)):
        x.refute("that these are all turning points", f"there is one at {one.coordinate} = {q}")
        return False
    before = len(x.unchecked)
    holds = not turning or x.decide("the turning points", turns)
    del x.unchecked[before:]  # for no random energy are they real
    return holds and _real_between(x, one, turning) and periods(x, one, h)


def _another_turning_point(
    x: Examination, one: OneFreedom, energy: int, turning: Sequence[int]
) -> str:
    """Where U_eff = E beside these and their turns by a period of U_eff; empty if nowhere seen."""
    if x.problem.contacts or any(each.holds_while for each in x.problem.constraints):
        return ""  # on one side only some of them are reached
    for state in x.states():
        E = state.at(energy).mid()
        known = {**state.environment, **state.following, (one.coordinate, 1): arb(0)}
        at = x.reference.values({**known, (one.constant, 0): E})
        listed = [q for q in map(at, turning) if q.is_finite()]

        def excess(place: arb | float, known: Environment = known, E: arb = E) -> arb:
            values = x.reference.values({**known, (one.coordinate, 0): arb(place)})
            return (values(energy) - E).mid()

        def is_listed(root: float, listed: list[arb] = listed) -> bool:
            places = [arb(3) / 8, arb(9) / 8]
            return any(
                size(gap) < _SAME_PLACE
                or all(size(excess(y + gap) - excess(y)) < _SAME_PLACE for y in places)
                for gap in (root - q for q in listed)
            )

        for root in _crossings(excess, _POSITIVE if one.positive else _PLACES):
            if not is_listed(root):
                return f"{root:.6g}"
    return ""


def _crossings(f: Callable[[float], arb], places: Sequence[float]) -> Iterator[float]:
    """Where a continuous function changes its sign between two of the places."""
    values = [f(place) for place in places]
    for (low, a), (high, b) in pairwise(zip(places, values, strict=True)):
        if not (a.is_finite() and b.is_finite() and a * b < 0):
            continue

        def before(place: float, a: arb = a) -> bool:
            return bool(f(place) * a > 0)

        root, _ = bisected(before, low, high, _HALVINGS)
        if size(f(root)) < _SAME_PLACE * (1 + size(a) + size(b)):  # no jump, no pole
            yield root


def _real_between(x: Examination, one: OneFreedom, turning: Sequence[int]) -> bool:
    """Whether all turning points are real for energies between the printed bounds."""
    what = "the energies at which the turning points are real"
    places = x.places(what, [bound for pair in one.turning_energies for bound in pair])
    if places is None:
        return False
    for state in x.states():
        known = {**state.environment, **state.following}
        at = x.reference.values(known)
        for low, high in zip(places[::2], places[1::2], strict=True):
            gap = at(high) - at(low)
            for part in (arb(1) / 64, arb(1) / 2, arb(63) / 64) if gap > 0 else ():
                energy = (at(low) + part * gap).mid()
                there = x.reference.values({**known, (one.constant, 0): energy})
                if not all(there(place).is_finite() for place in turning):
                    x.refute(what, f"at {float(energy):.6g} one is not")
                    return False
    return True


def model(x: Examination, section: ModelSection) -> ModelSection:
    """The eliminated coordinates follow from the others, and ignorable ones change nothing."""
    names = list(section.eliminated)
    where = [x.reference.q[x.reference.names.index(name)] for name in names]
    holds = x.hold(
        "the eliminated coordinates",
        [section.eliminated[name] for name in names],
        lambda s: [s.at(q) for q in where],
    )
    changing = (name for name in section.ignorable if _changes_the_momentum(x, section, name))
    return section if holds and next(changing, None) is None else ModelSection(kept=None)


def _changes_the_momentum(x: Examination, section: ModelSection, name: str) -> bool:
    """Whether sum_i p_i dq_i/dq changes, q_i the coordinate itself and those eliminated by it."""
    what, reference = f"that {name} is ignorable", x.reference
    places = x.places(what, list(section.eliminated.values())) or []
    along = dict(zip(map(reference.names.index, section.eliminated), places, strict=True))
    own = reference.names.index(name)
    for s in x.states():
        moving = {**dict(zip(reference.q, s.laws.velocities, strict=True)), reference.time: arb(1)}
        rate, scale = arb(0), 1.0
        for i in {own, *along}:
            slope, bend = (arb(1), arb(0)) if i == own else (arb(0), arb(0))
            if i in along:
                by = s.at.gradient(along[i])
                slope = by.get(reference.q[own], arb(0))
                bend = s.at.gradient_rates(along[i], by, moving).get(reference.q[own], arb(0))
            force = s.laws.slopes[i] + s.laws.applied[i]
            rate += force * slope + s.laws.momenta[i] * bend
            scale += size(force * slope) + size(s.laws.momenta[i] * bend)
        if size(rate) > _CHANGED * scale:
            x.refute(what, "its momentum changes at random states")
            return True
    return False
