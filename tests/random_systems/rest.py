"""States of rest by brute force: forces there, the linear equations about them, a search."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mpmath import mp, mpf

from . import linear
from .grammar import Undefined, Unreadable, read
from .motion import Motion, State, slope

NEAR = mpf(10) ** -8
CLEAR = mpf(10) ** -6


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
    for q in _to_be_found(judge):
        if not any(_is_there(judge.motion, q, place, each) for place, each in places):
            told = any("other" in warning for warning in judge.sheet["warnings"])
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
    if not _condition(judge, each, names):
        return []
    free = list(each.get("free", []))
    for name in free:
        names[name] = mpf(motion.rng.randint(100, 900)) / 777
    if "on" in each:
        return []  # a line: its points are found by the search
    q = []
    for name in motion.coordinates:
        if name in each["at"]:
            q.append(judge.value("equilibria", each["at"][name], names))
        else:
            q.append(names.get(name, mpf(0)))
    return [] if None in q else [q]


def _rest(motion, q):
    zero = [mpf(0)] * motion.n
    return State(list(q), zero, mpf(1) / 3, list(zero))


def _needs(motion, q):
    """What the constraints must give so that it stays at rest: E(q, 0, 0) - Q."""
    state = _rest(motion, q)
    pairs = zip(motion.euler_lagrange(state), motion.applied(state), strict=True)
    return [e - f for e, f in pairs]


def _forces_vanish(motion, q):
    state = _rest(motion, q)
    if any(abs(motion.value(name, state)) > NEAR for name in motion.constraints):
        return False
    needs = _needs(motion, q)
    if not motion.constraints:
        return all(abs(each) < NEAR for each in needs)
    lam, _, consistent = linear.solve(linear.transposed(motion.rows(state)), needs)
    del lam
    return consistent


def _examine(judge, each, q):
    motion = judge.motion
    try:
        if not _forces_vanish(motion, q):
            judge.say("wrong", "equilibria", f"{each['at']} is none: {_needs(motion, q)}")
            return
        _stability(judge, each, about(motion, q))
    except (Undefined, ZeroDivisionError):
        return


@dataclass
class Linear:
    """M x'' + C x' + K x = 0 on the directions that the constraints leave."""

    M: list
    C: list
    K: list
    directions: list

    @property
    def spectrum(self):
        """The roots s of exp(s t)."""
        n = len(self.M)
        rows = [[mpf(0)] * n + [mpf(int(i == j)) for j in range(n)] for i in range(n)]
        columns = [_column(self.M, [-row[j] for row in self.K]) for j in range(n)]
        columns += [_column(self.M, [-row[j] for row in self.C]) for j in range(n)]
        return linear.eigenvalues(rows + linear.transposed(columns))

    @property
    def regular(self):
        return bool(self.M) and linear.rank(self.M) == len(self.M)


def _column(M, right):
    return linear.solve(M, right)[0]


def about(motion: Motion, q):
    """The linear equations about a place of rest."""
    state = _rest(motion, q)
    lam = []
    rows = motion.rows(state)
    if rows:
        lam, _, _ = linear.solve(linear.transposed(rows), _needs(motion, q))

    def left(s):
        right = motion.applied(s)
        values = [e - f for e, f in zip(motion.euler_lagrange(s), right, strict=True)]
        for k, row in enumerate(motion.rows(s)):
            values = [value - lam[k] * a for value, a in zip(values, row, strict=True)]
        return values

    matrices = [_jacobian(left, state, what) for what in "avq"]
    N = linear.solve(rows, [mpf(0)] * len(rows))[1] if rows else _unit(motion.n)
    if not N:
        return Linear([], [], [], [])
    reduced = [linear.product(linear.product(N, m), linear.transposed(N)) for m in matrices]
    return Linear(*reduced, N)


def _unit(n):
    return [[mpf(int(i == j)) for j in range(n)] for i in range(n)]


def _jacobian(left, state, what):
    columns = []
    h = mpf(10) ** -10
    for i in range(len(state.q)):
        up, down = list(getattr(state, what)), list(getattr(state, what))
        up[i], down[i] = up[i] + h, down[i] - h
        above, below = left(replace(state, **{what: up})), left(replace(state, **{what: down}))
        columns.append([(a - b) / (2 * h) for a, b in zip(above, below, strict=True)])
    return linear.transposed(columns)


def _symmetric(rows, sign=1):
    n = len(rows)
    return [[(rows[i][j] + sign * rows[j][i]) / 2 for j in range(n)] for i in range(n)]


def _bounds(rows):
    values = mp.eigsy(mp.matrix(_symmetric(rows)), eigvals_only=True) if rows else [mpf(0)]
    return min(values), max(values)


def _stability(judge, each, linear_):
    if not linear_.regular or any(judge.motion.on_velocities.values()):
        return
    s = linear_.spectrum
    growth = max(mp.re(root) for root in s)
    inertia, stiffness = _bounds(linear_.M)[0], _bounds(linear_.K)[0]
    skew = max(abs(x) for row in _symmetric(linear_.K, -1) for x in row)
    friction = _bounds(linear_.C)[0]
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
        _conditions(judge, each, linear_, s, where, unstable or safe)


def _flat(judge, each, linear_, where):
    """Where the second derivatives do not decide, V is compared around the place."""
    motion = judge.motion
    if motion.constraints or motion.forces or motion.D is not None or each.get("free"):
        return
    if "on" in each or max(abs(x) for row in linear_.C for x in row) > NEAR:
        return
    q = [read(each["at"][name])(motion.constants) for name in motion.coordinates]
    U0, around = -motion.L(_rest(motion, q)), []
    for k in range(60):
        angle = [mp.cos(k * mp.pi / 30 + j * mp.pi / 2) for j in range(motion.n)]
        near = [x + a * mpf("1e-3") for x, a in zip(q, angle, strict=True)]
        around.append(-motion.L(_rest(motion, near)) - U0)
    low = min(around)
    if (each["stable"] and low < -mpf("1e-20")) or (not each["stable"] and low > mpf("1e-16")):
        judge.say("wrong", "equilibria", f"{where}: around it U - U0 is at least {short(low)}")


def short(value):
    return mp.nstr(value, 5)


def _conditions(judge, each, linear_, s, where, decided):
    names = dict(judge.motion.constants)
    tests = {
        "minimum": (_bounds(linear_.K)[0] > CLEAR, _bounds(linear_.K)[0] < -CLEAR),
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
    if decided and not any(name in each for name in tests):
        judge.say("missing", "equilibria", f"{where}: decided by its linear equations")


# -- completeness -----------------------------------------------------------------------


def _to_be_found(judge):
    known = judge.system.known.get("equilibria")
    motion = judge.motion
    if known is not None:
        found = []
        for place in known:
            q = [read(place[name])(motion.constants) for name in motion.coordinates]
            if _forces_vanish(motion, q):
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
        if _forces_vanish(motion, q):
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
        values, state = _needs(motion, q), _rest(motion, q)
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


def _is_there(motion, q, place, each):
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
        pairs = zip(_needs(motion, q), _needs(motion, other), strict=True)
        return all(abs(a - b) < NEAR for a, b in pairs) and all(
            abs(motion.value(c, _rest(motion, q)) - motion.value(c, _rest(motion, other))) < NEAR
            for c in motion.constraints
        )
    except Undefined:
        return False


# -- modes ------------------------------------------------------------------------------


def modes(judge, printed):
    """The frequencies at each place are all there are, each shape one of them."""
    motion = judge.motion
    if printed is None:
        if "frequencies_squared" in judge.system.known:
            judge.say("missing", "modes", "there are some")
        return
    by_place = {}
    for mode in printed:
        if "on" in mode or set(mode["at"]) != set(motion.coordinates):
            continue
        by_place.setdefault(str(mode["at"]), []).append(mode)
    for some in by_place.values():
        try:
            q = [read(some[0]["at"][name])(motion.constants) for name in motion.coordinates]
            _frequencies(judge, some, about(motion, q))
        except (Undefined, ZeroDivisionError):
            continue
    expected = judge.system.known.get("frequencies_squared")
    if expected is not None:
        _known(judge, printed, expected)


def _squares(judge, some):
    found = []
    for mode in some:
        text = mode["frequency"] or mode.get("frequency_squared")
        if text is None:
            return None
        value = read(text)(judge.motion.constants)
        found += [value**2 if mode["frequency"] else value] * mode["multiplicity"]
    return sorted(found)


def _frequencies(judge, some, linear_):
    if not linear_.regular or any(judge.motion.on_velocities.values()):
        return
    if max(abs(x) for row in _symmetric(linear_.C) for x in row) > NEAR:
        return
    squares = _squares(judge, some)
    roots = sorted(mp.re(-s * s) for s in linear_.spectrum)[::2]
    if squares is not None and (
        len(squares) != len(roots)
        or any(abs(a - b) > CLEAR * max(1, abs(b)) for a, b in zip(squares, roots, strict=True))
    ):
        texts = [mode["frequency"] for mode in some]
        judge.say("wrong", "modes", f"{texts}: {_floats(squares)}, not {_floats(roots)}")
        return
    for mode in some:
        _shapes(judge, mode, linear_)


def _shapes(judge, mode, linear_):
    """(K - w^2 M + i w C) x = 0; with C = 0 only."""
    if mode["shape"] is None or max(abs(x) for row in linear_.C for x in row) > NEAR:
        return
    w = read(mode["frequency"] or mode["frequency_squared"])(judge.motion.constants)
    w2 = w**2 if mode["frequency"] else w
    for shape in (mode["shape"], *mode.get("more_shapes", [])):
        x = [read(shape.get(n, "0"))(judge.motion.constants) for n in judge.motion.coordinates]
        N = linear_.directions
        along, _, consistent = linear.solve(linear.transposed(N), x)
        pairs = zip(linear.times(linear_.K, along), linear.times(linear_.M, along), strict=True)
        off = max(abs(k - w2 * m) for k, m in pairs)
        if not consistent or off > CLEAR * max(1, *map(abs, x)) or max(map(abs, x)) < NEAR:
            judge.say("wrong", "modes", f"shape {shape} of {mode['frequency']}")


def _known(judge, printed, expected):
    wanted = sorted(read(text)(judge.motion.constants) for text in expected)
    place = judge.system.known["at"]
    constants = judge.motion.constants
    some = []
    for mode in printed:
        pairs = [(mode["at"].get(name, "0"), place[name]) for name in judge.motion.coordinates]
        if all(abs(read(a)(constants) - read(b)(constants)) < CLEAR for a, b in pairs):
            some.append(mode)
    squares = _squares(judge, some)
    if squares is None or len(squares) != len(wanted):
        judge.say("missing", "modes", f"{_floats(squares)}, not {_floats(wanted)}")
    elif any(abs(a - b) > CLEAR * max(1, b) for a, b in zip(squares, wanted, strict=True)):
        judge.say("wrong", "modes", f"{_floats(squares)}, not {_floats(wanted)}")


def _floats(values):
    return None if values is None else [float(f"{float(x):.6g}") for x in values]


__all__ = ["equilibria", "modes", "slope"]
