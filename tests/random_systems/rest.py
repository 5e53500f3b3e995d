"""States of rest by brute force: forces there, the linear equations about them, a search."""

from __future__ import annotations

from mpmath import mp, mpf

from .comparison import short
from .grammar import Undefined, Unreadable, read
from .rest_linear import (
    CLEAR,
    KINK,
    NEAR,
    about,
    at_rest,
    bounds,
    forces_vanish,
    needs,
    symmetric,
)
from .rest_search import is_there, to_be_found


def equilibria(judge, printed):
    """Each place is one of rest, its stability true, and none is left out."""
    if printed is None:
        if judge.system.known.get("equilibria"):
            judge.say("missing", "equilibria", "there are some")
        return
    places = []
    for each in printed:
        if "on" in each:
            places.append(([], each))
        for q in _places(judge, each):
            places.append((q, each))
            _examine(judge, each, q)
    if any("other solutions of" in warning for warning in judge.sheet["warnings"]):
        return  # it says what those that have no closed form solve
    for q in to_be_found(judge):
        if not any(is_there(judge.motion, q, place, each) for place, each in places):
            told = any("not listed" in warning for warning in judge.sheet["warnings"])
            where = [float(x) for x in q]
            judge.say("missing" if told else "wrong", "equilibria", f"{where} is not listed")


def _condition(judge, each, names):
    """Whether the equilibrium exists for these numbers."""
    texts = each["condition"].split(" and ") if "condition" in each else []
    return _all_above(judge, texts, names)


def _all_above(judge, texts, names):
    for text in texts:
        left, _, right = text.partition(">")
        try:
            if read(f"({left}) - ({right})")(names) <= 0:
                return False
        except Undefined:
            return False
        except Unreadable as error:
            judge.say("wrong", "equilibria", str(error))
            return False
    return True


def _places(judge, each):
    motion = judge.motion
    names = dict(motion.constants)
    if "on" in each or not _condition(judge, each, names):
        return []  # the points of a line are found by the search
    free = list(each.get("free", []))
    for name in free:
        names[name] = mpf(motion.rng.randint(100, 900)) / 777
    q = []
    for name in motion.coordinates:
        if name in each["at"]:
            q.append(judge.value("equilibria", each["at"][name], names))
        else:
            q.append(names.get(name, mpf(0)))
    return [] if None in q else [q]


def _examine(judge, each, q):
    motion = judge.motion
    if each.get("kinked"):
        return  # the force jumps there, and takes every value between the two sides
    try:
        if not forces_vanish(motion, q):
            judge.say("wrong", "equilibria", f"{each['at']} is none: {needs(motion, q)}")
            return
        _stability(judge, each, about(motion, q), q)
    except (Undefined, ZeroDivisionError):
        return


def _stability(judge, each, linear_, q):
    if not linear_.regular or any(judge.motion.on_velocities.values()):
        return
    if max(abs(x) for row in linear_.K for x in row) > KINK:
        return
    s = linear_.spectrum
    growth = max(mp.re(root) for root in s)
    inertia, stiffness = bounds(linear_.M)[0], bounds(linear_.K)[0]
    skew = max(abs(x) for row in symmetric(linear_.K, -1) for x in row)
    friction = bounds(linear_.C)[0]
    minimum = inertia > CLEAR and skew < NEAR and friction > -NEAR
    unstable, safe = growth > CLEAR, (minimum and stiffness > CLEAR) or growth < -CLEAR
    where, said = f"{each['at']} stable {each['stable']}", each["stable"]
    if each.get("free") or "on" in each:
        safe = False
    if (said is True and unstable) or (said is False and safe):
        judge.say("wrong", "equilibria", f"{where}: roots {[mp.nstr(x, 5) for x in s]}")
    if said is not None and not unstable and not safe and minimum:
        _flat(judge, each, linear_, where)
    if said is None:
        _conditions(judge, each, linear_, s, q, where, unstable or safe)


def _flat(judge, each, linear_, where):
    """Where the second derivatives do not decide, V is compared around the place."""
    motion = judge.motion
    if motion.constraints or motion.forces or motion.D is not None or each.get("free"):
        return
    if "on" in each or max(abs(x) for row in linear_.C for x in row) > NEAR:
        return
    q = [read(each["at"][name])(motion.constants) for name in motion.coordinates]
    U0 = -motion.L(at_rest(motion, q))

    def beside(turn):
        angle = [mp.cos(turn + j * mp.pi / 2) for j in range(motion.n)]
        near = [x + a * mpf("1e-3") for x, a in zip(q, angle, strict=True)]
        return -motion.L(at_rest(motion, near)) - U0

    lowest = min((k * mp.pi / 30 for k in range(60)), key=beside)
    for width in (30, 300, 3000, 30000):  # a valley may be as narrow as y = 3 x²/2
        lowest = min((lowest + k * mp.pi / (10 * width) for k in range(-10, 11)), key=beside)
    low = beside(lowest)
    if (each["stable"] and low < -mpf("1e-20")) or (not each["stable"] and low > mpf("1e-16")):
        judge.say("wrong", "equilibria", f"{where}: around it U - U0 is at least {short(low)}")


def _conditions(judge, each, linear_, s, q, where, decided):
    names = judge.motion.constants | dict(zip(judge.motion.coordinates, q, strict=True))
    tests = {
        "minimum": (bounds(linear_.K)[0] > CLEAR, bounds(linear_.K)[0] < -CLEAR),
        "hurwitz": (
            all(mp.re(x) < -CLEAR for x in s),
            any(mp.re(x) > CLEAR for x in s),
        ),
        "spectrum": (False, any(abs(mp.re(x)) > CLEAR for x in s)),
    }
    for name, (certainly, certainly_not) in tests.items():
        if name not in each:
            continue
        holds = _all_above(judge, each[name], names)
        if (holds and certainly_not) or (not holds and certainly and name != "minimum"):
            judge.say("wrong", "equilibria", f"{where}, {name} {each[name]} is {holds}")
    grows = any(_all_above(judge, text.split(" and "), names) for text in each.get("unstable", ()))
    if grows and all(mp.re(x) < -CLEAR for x in s):
        judge.say("wrong", "equilibria", f"{where}, unstable where {each['unstable']}")
    if decided and not grows and not any(name in each for name in tests):
        judge.say("missing", "equilibria", f"{where}: decided by its linear equations")
