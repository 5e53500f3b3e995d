"""Places of rest that a list must have: known by construction, or found by Newton's method."""

from __future__ import annotations

from mpmath import mp, mpf

from . import linear
from .grammar import Undefined, read
from .rest_linear import CLEAR, NEAR, at_rest, forces_vanish, needs


def to_be_found(judge):
    known = judge.system.known.get("equilibria")
    motion = judge.motion
    if known is not None:
        found = []
        for place in known:
            q = [read(place[name])(motion.constants) for name in motion.coordinates]
            if forces_vanish(motion, q):
                found.append(q)
            else:
                judge.say("judge", "equilibria", f"{place} was to be one")
        return found
    return _search(motion) if judge.system.known.get("search") else []


def _search(motion, starts=14):
    found = []
    for _ in range(starts):
        try:
            q = _newton(motion)
        except (Undefined, ZeroDivisionError):
            continue
        if q is None or any(_apart(q, other) < CLEAR for other in found):
            continue
        if forces_vanish(motion, q):
            found.append(q)
    return found


def _newton(motion):
    m = len(motion.constraints)
    q = [
        mpf(motion.rng.randint(-3000 if assume is None else 50, 3000)) / 1009
        for assume in motion.system.coordinates.values()
    ]
    x = [*q, *(mpf(motion.rng.randint(-1000, 1000)) / 503 for _ in range(m))]

    def left(x):
        q, lam = x[: motion.n], x[motion.n :]
        values, state = needs(motion, q), at_rest(motion, q)
        for k, row in enumerate(motion.rows(state)):
            values = [value - lam[k] * a for value, a in zip(values, row, strict=True)]
        return values + [motion.value(name, state) for name in motion.constraints]

    h = mpf(10) ** -10
    for _ in range(25):
        values = left(x)
        if max(map(abs, values)) < mpf(10) ** -20:
            break
        columns = []
        for i in range(len(x)):
            up = list(x)
            up[i] += h
            columns.append([(a - b) / h for a, b in zip(left(up), values, strict=True)])
        step, _, _ = linear.solve(linear.transposed(columns), values)
        size = max(map(abs, step))
        x = [a - b * min(1, 1 / size if size else 1) for a, b in zip(x, step, strict=True)]
    else:
        return None
    q = x[: motion.n]
    assumed = zip(q, motion.system.coordinates.values(), strict=True)
    if max(map(abs, q)) > 10 or any(a == "positive" and each <= CLEAR for each, a in assumed):
        return None
    return q


def _apart(a, b):
    return max(abs(x - y) for x, y in zip(a, b, strict=True))


def is_there(motion, q, place, each):
    """Whether a place is that of the list: up to free coordinates and whole turns."""
    names = dict(motion.constants)
    names |= dict(zip(motion.coordinates, q, strict=True))
    if "on" in each:
        return abs(read(each["on"])(names)) < CLEAR
    for i, name in enumerate(motion.coordinates):
        if name in each.get("free", []):
            continue
        try:
            expected = read(each["at"][name])(names) if each.get("free") else place[i]
        except Undefined:
            return False
        off = q[i] - expected
        if _turns(motion, q, i):
            off = mp.fmod(off + 7 * mp.pi, 2 * mp.pi) - mp.pi
        if abs(off) > CLEAR:
            return False
    return True


def _turns(motion, q, i):
    """Whether a whole turn of a coordinate changes no force."""
    other = [x + 2 * mp.pi * (j == i) for j, x in enumerate(q)]
    try:
        pairs = zip(needs(motion, q), needs(motion, other), strict=True)
        return all(abs(a - b) < NEAR for a, b in pairs) and all(
            abs(motion.value(c, at_rest(motion, q)) - motion.value(c, at_rest(motion, other)))
            < NEAR
            for c in motion.constraints
        )
    except Undefined:
        return False
