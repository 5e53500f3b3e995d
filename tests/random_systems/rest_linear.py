"""The linear equations about a state of rest or of steady motion, and their roots."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mpmath import mp, mpf

from . import linear
from .motion import Motion, State

NEAR = mpf(10) ** -8
CLEAR = mpf(10) ** -6
KINK = mpf(10) ** 6  # a difference over a kink of V is no second derivative


def at_rest(motion, q):
    zero = [mpf(0)] * motion.n
    return State(list(q), zero, mpf(1) / 3, list(zero))


def needs(motion, q):
    """What the constraints must give so that it stays at rest: E(q, 0, 0) - Q."""
    state = at_rest(motion, q)
    pairs = zip(motion.euler_lagrange(state), motion.applied(state), strict=True)
    return [e - f for e, f in pairs]


def forces_vanish(motion, q):
    state = at_rest(motion, q)
    if any(abs(motion.value(name, state)) > NEAR for name in motion.constraints):
        return False
    wanted = needs(motion, q)
    if not motion.constraints:
        return all(abs(each) < NEAR for each in wanted)
    return linear.solve(linear.transposed(motion.rows(state)), wanted)[2]


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
    state = at_rest(motion, q)
    lam = []
    rows = motion.rows(state)
    if rows:
        lam, _, _ = linear.solve(linear.transposed(rows), needs(motion, q))

    def left(s):
        right = motion.applied(s)
        values = [e - f for e, f in zip(motion.euler_lagrange(s), right, strict=True)]
        for k, row in enumerate(motion.rows(s)):
            values = [value - lam[k] * a for value, a in zip(values, row, strict=True)]
        return values

    matrices = [jacobian(left, state, what) for what in "avq"]
    N = linear.solve(rows, [mpf(0)] * len(rows))[1] if rows else _unit(motion.n)
    if not N:
        return Linear([], [], [], [])
    reduced = [linear.product(linear.product(N, m), linear.transposed(N)) for m in matrices]
    return Linear(*reduced, N)


def _unit(n):
    return [[mpf(int(i == j)) for j in range(n)] for i in range(n)]


def jacobian(left, state, what):
    columns = []
    h = mpf(10) ** -10
    for i in range(len(state.q)):
        up, down = list(getattr(state, what)), list(getattr(state, what))
        up[i], down[i] = up[i] + h, down[i] - h
        above, below = left(replace(state, **{what: up})), left(replace(state, **{what: down}))
        columns.append([(a - b) / (2 * h) for a, b in zip(above, below, strict=True)])
    return linear.transposed(columns)


def symmetric(rows, sign=1):
    n = len(rows)
    return [[(rows[i][j] + sign * rows[j][i]) / 2 for j in range(n)] for i in range(n)]


def bounds(rows):
    values = mp.eigsy(mp.matrix(symmetric(rows)), eigvals_only=True) if rows else [mpf(0)]
    return min(values), max(values)
