"""Normal modes: frequencies and shapes of the linear motion near equilibria, and their number."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from fractions import Fraction

from flint import arb, ctx

from lagcli.expression import Call, Expression, Number, Power, Product, Quotient
from lagcli.record import replace
from lagcli.statements.answers import ModesOfFrequency, ModesSection, Pole
from lagcli.verification.claims.near import NOTHING, LinearMotion, eigenvalues, occur
from lagcli.verification.claims.rest import (
    BITS,
    RestPlace,
    named,
    not_confirmed,
    with_closed_contacts,
    without_open,
)
from lagcli.verification.claims.unlisted import Balance, shown, unlisted
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, rank

#: Relative differences of eigenvalues: those of multiplicity 2 are right to 1e-19.
_AGREE = 1e-9
#: The same of exponents: where two are equal, each is right to the root of what its square is.
_EXPONENT = 1e-7
#: The distance from a pole at which the motion about it is looked at: M falls with its square and
#: has clear pivots above 2^-36; and the relative differences there, of the same square.
_BESIDE, _CURVED = arb(2) ** -16, 1e-7
#: The residual of a place that is an equilibrium for the values drawn; decimals leave 1e-15.
_STAYS = 1e-8


def modes(x: Examination, section: ModesSection) -> ModesSection:
    """Each frequency is one of the linear motion near its equilibrium, with its shapes.

    There is one for each degree of freedom, about every stable equilibrium.
    """
    if section.modes is None:
        return section
    with ctx.workprec(BITS):
        for each in section.modes:
            if not _is_mode(x, each):
                return replace(section, modes=None, reason=not_confirmed("a normal mode"))
        groups: dict[object, list[ModesOfFrequency]] = {}
        for each in section.modes:
            groups.setdefault(repr((each.at, each.on)), []).append(each)
        places = [_all_modes(x, about) for about in groups.values()]
        if None in places:
            return replace(section, modes=None, reason=not_confirmed("the number of normal modes"))
        complete = section.complete and _are_all(x, [place for place in places if place])
    return replace(section, complete=complete)


def _all_modes(x: Examination, about: Sequence[ModesOfFrequency]) -> RestPlace | None:
    """The equilibrium, if it has as many modes as it must have."""
    first = about[0]
    what = f"the number of normal modes about {named(first.at, first.on)}"
    x = without_open(x, first.open)
    place = RestPlace(x, what, first.at, {}, first.on, ())
    if first.kinked or with_closed_contacts(x, place) is not x:
        return place
    count = sum(mode.multiplicity for mode in about)
    free = len(x.reference.names) - len(x.reference.rows)
    if first.pole is not None and count != free:
        x.refute(what, f"it is {count} as derived, with {free} degrees of freedom")
        return None
    for near in place.states():
        if not (near.defined and near.regular and near.residual < _STAYS):
            continue
        values = near.eigenvalues
        zeros = sum(abs(z) < NOTHING**0.5 * max([1e-3, *map(abs, values)]) for z in values)
        if not (len(values) - zeros) // 2 <= count <= (len(values) + 1) // 2:
            x.refute(what, f"it is {count} as derived, with {len(values) // 2} degrees of freedom")
            return None
        if not occur(near, _squares(x, near, what, about)):
            x.refute(what, "a frequency is listed more often than it occurs")
            return None
        break
    return place


def _squares(
    x: Examination, near: LinearMotion, what: str, about: Sequence[ModesOfFrequency]
) -> list[arb]:
    """The printed omega^2 there of all modes without damping, each as often as it is said to be."""
    found = []
    for mode in about:
        if mode.damped or mode.pole is not None:
            continue
        if mode.frequency is not None:
            W = [near.at(p) ** 2 for p in x.places(what, [mode.frequency]) or ()]
        elif mode.frequency_squared is not None:
            W = [near.at(p) for p in x.places(what, [mode.frequency_squared]) or ()]
        else:  # roots that are not real
            continue
        found += W * mode.multiplicity
    return found


def _are_all(x: Examination, places: Sequence[RestPlace]) -> bool:
    """Whether no stable equilibrium is known about which no modes are listed."""
    if x.reference.large or x.problem.contacts:
        return True
    if any(not row.holonomic for row in x.reference.rows):
        return True
    if not places and any(c.holds_while for c in x.problem.constraints):
        return True  # they may open
    for near in unlisted(Balance(x), places):
        if near.eigenvalues and near.is_stable and _is_so_later(near):
            why = f"there is a stable equilibrium at {shown(near)}"
            x.refute("that the normal modes about all stable equilibria are listed", why)
            return False
    return True


def _is_so_later(near: LinearMotion) -> bool:
    """Whether it stays, with the same linear motion, at another time."""
    known = near.environment
    later = LinearMotion(near.x, {**known, ("t", 0): known.get(("t", 0), arb(0)) + arb(3) / 8})
    pairs = zip(sorted(near.eigenvalues, key=abs), sorted(later.eigenvalues, key=abs), strict=True)
    return later.residual < _STAYS and all(abs(abs(a) - abs(b)) < _STAYS for a, b in pairs)


def _is_mode(x: Examination, mode: ModesOfFrequency) -> bool:
    what = f"the normal modes about {named(mode.at, mode.on)}"
    x = without_open(x, mode.open)
    place = RestPlace(x, what, mode.at, {}, mode.on, ())
    if mode.kinked or with_closed_contacts(x, place) is not x:
        x.unchecked.append(what)  # on one side only the motion is that of the equations
        return True
    square = x.places(what, [f for f in (mode.frequency_squared,) if f is not None])
    frequency = x.places(what, [f for f in (mode.frequency,) if f is not None])
    if mode.pole is not None:
        return _turns_so(x, what, place, mode.pole, square or (), frequency or ())
    shapes = [s for s in (mode.shape, *mode.more_shapes) if s is not None]
    flat = x.places(what, [shape[n] for shape in shapes for n in x.reference.names])
    if not place.readable or square is None or frequency is None or flat is None:
        return False
    tried = [near for near in place.states() if near.defined and near.regular]
    resting = [near for near in tried if near.residual < _STAYS]
    if tried and not resting and not mode.at and mode.on is None:  # said of every place
        x.refute(what, "the equations of motion do not let it stay there")
        return False
    if mode.damped:
        return _decays_so(x, what, resting, mode)
    size = len(x.reference.names)
    real: list[bool] = []  # at each state
    for near in resting:
        W = [near.at(p) for p in square] + [near.at(p) ** 2 for p in frequency]
        real.append(all(w.is_finite() for w in W))
        if not real[-1]:
            continue
        if not all(occur(near, [w] * mode.multiplicity) for w in W):
            x.refute(what, "a frequency is not one of the linear motion near it")
            return False
        if any(near.at(p) < 0 for p in frequency):
            x.refute(what, "a frequency is negative")
            return False
        values = [near.at(p) for p in flat]
        rows = [values[k : k + size] for k in range(0, len(values), size)]
        if not all(_moves_so(near, W[0], row) for row in rows):
            x.refute(what, "a shape is not that of its frequency")
            return False
        if rows and _independent(rows, size) not in {_expected(near, W[0], mode), -1}:
            x.refute(what, "the shapes of a frequency are not as many as it has")
            return False
    if frequency and not mode.open_sign and real and not any(real):
        x.refute(what, "a frequency is nowhere real")
        return False
    return True


def _turns_so(
    x: Examination,
    what: str,
    place: RestPlace,
    pole: Pole,
    square: Sequence[int],
    frequency: Sequence[int],
) -> bool:
    """Whether circles about a pole are run through at these rates, or a meridian swings so.

    On a small circle with phi' = ±omega the distance r is not accelerated.
    """
    names = x.reference.names
    r, phi = names.index(pole.radius), names.index(next(iter(pole.turning)))
    others = [j for j in range(len(names)) if j != phi]
    turning = x.places(what, list(pole.turning.values())) or []
    for near in place.states():
        place_of_r = near.environment[pole.radius, 0]
        beside = {**near.environment, (pole.radius, 0): place_of_r + _BESIDE}
        by_q, _ = LinearMotion(x, beside).slopes
        if any(near.at(p) < 0 for p in frequency):
            x.refute(what, "a frequency is negative")
            return False
        swings = eigenvalues([[-by_q[i][j] for j in others] for i in others])
        for W in (*(near.at(p) for p in square), *(near.at(p) ** 2 for p in frequency)):
            if not W.is_finite():
                continue
            rates = [W.sqrt() * near.at(p) for p in turning]
            circles = (
                dict(zip([(n, 1) for n in pole.turning], [side * v for v in rates], strict=True))
                for side in (1, -1)
            )
            pulls = [near.laws_at({**beside, **each}).accelerations[r] for each in circles]
            gaps = [abs(float((a / _BESIDE).mid())) for a in pulls if a.is_finite()]
            gaps += [abs(z - float(W.mid())) for z in swings]
            if min(gaps) > _CURVED * max(1e-3, abs(float(W.mid()))):
                x.refute(what, "a frequency is not one of the linear motion near it")
                return False
    return True


def _decays_so(
    x: Examination, what: str, resting: Sequence[LinearMotion], mode: ModesOfFrequency
) -> bool:
    """Whether s = -decay ± sqrt(decay² - natural²), and the real s, are exponents."""
    pair = mode.decay, None if mode.frequency is None else _squared(mode.frequency)
    complex_ = x.places(what, [f for f in pair if f is not None])
    real = x.places(what, list(mode.exponents))
    shapes = [s for s in (mode.shape, *mode.more_shapes) if s is not None]
    flat = x.places(what, [shape[n] for shape in shapes for n in x.reference.names])
    if complex_ is None or real is None or flat is None:
        return False
    if resting and not x.reference.pushed and all(near.still for near in resting):
        x.refute(what, "it is called damped, and nothing acts on velocities")
        return False
    size = len(x.reference.names)
    for near in resting:
        values = [near.at(p) for p in (*complex_, *real)]
        if not all(value.is_finite() for value in values):
            continue
        numbers = [float(value.mid()) for value in values]
        wanted = [complex(s) for s in numbers[len(complex_) :]]
        if complex_:
            root = cmath.sqrt(-numbers[1])
            wanted += [side * root - numbers[0] for side in (1, -1)] * mode.multiplicity
            parts = [near.at(p) for p in flat]
            rows = [parts[k : k + size] for k in range(0, len(parts), size)]
            if not all(_fades_so(near, values[0], values[1], row) for row in rows):
                x.refute(what, "a shape is not that of its exponents")
                return False
            if rows and _independent(rows, size) not in {mode.multiplicity, -1}:
                x.refute(what, "the shapes of a frequency are not as many as it has")
                return False
        left = list(near.eigenvalues)
        scale = max([1e-6, *map(abs, left)])
        for s in wanted:
            nearest = min(left, key=lambda z: abs(z - s), default=None)
            if nearest is None or abs(nearest - s) > _EXPONENT * scale:
                x.refute(what, "an exponent is not one of the linear motion near it")
                return False
            left.remove(nearest)
    return True


def _squared(frequency: Expression) -> Expression:
    """W of sqrt(W), of 2 sqrt(W) and of 1/sqrt(W), which has a value where the motion creeps."""
    match frequency:
        case Call(function="sqrt", arguments=(inner,)):
            return inner
        case Product(factors=factors):
            return Product(tuple(map(_squared, factors)))
        case Quotient(numerator=above, denominator=below):
            return Quotient(_squared(above), _squared(below))
    return Power(frequency, Number(Fraction(2)))


def _expected(near: LinearMotion, W: arb, mode: ModesOfFrequency) -> int:
    """How many independent shapes a frequency has: the solutions of (dq''/dq + omega^2) a = 0."""
    if not near.still or mode.multiplicity == 1:  # it is known to be a root
        return mode.multiplicity
    by_q, _ = near.slopes
    sums = [[e + (W if i == j else 0) for j, e in enumerate(row)] for i, row in enumerate(by_q)]
    rows = [[e if abs(float(e.mid())) > NOTHING else arb(0) for e in row] for row in sums]
    try:
        return min(mode.multiplicity, near.size - rank([*rows, *near.laws.jacobian], near.size))
    except Unclear:
        return -1


def _independent(rows: Sequence[Sequence[arb]], size: int) -> int:
    """The number of independent shapes; -1 where it cannot be seen."""
    try:
        return rank(rows, size) if all(e.is_finite() for row in rows for e in row) else -1
    except Unclear:
        return -1


def _fades_so(near: LinearMotion, decay: arb, square: arb, shape: Sequence[arb]) -> bool:
    """Whether (dq''/dq) a = -(omega² + delta²) a and (dq''/dq') a = -2 delta a."""
    if not all(a.is_finite() for a in shape):
        return True
    pairs = zip(near.slopes, (square + decay**2, 2 * decay), strict=True)
    for slopes, value in pairs:
        forces = [sum((e * a for e, a in zip(row, shape, strict=True)), arb(0)) for row in slopes]
        scale = max([1.0, *(abs(float(f.mid())) for f in forces)])
        gaps = (abs(float((f + value * a).mid())) for f, a in zip(forces, shape, strict=True))
        if max(gaps) > _AGREE * scale:
            return False
    return True


def _moves_so(near: LinearMotion, W: arb, shape: Sequence[arb]) -> bool:
    """Whether (dq''/dq) a = -omega^2 a, where velocities play no part."""
    by_q, _ = near.slopes
    if not near.still or not all(a.is_finite() for a in shape):
        return True
    forces = [sum((e * a for e, a in zip(row, shape, strict=True)), arb(0)) for row in by_q]
    scale = max([1e-6, *(abs(float(f.mid())) for f in forces)])
    gaps = (abs(float((f + W * a).mid())) for f, a in zip(forces, shape, strict=True))
    return max(gaps) < _AGREE * max(scale, 1.0)
