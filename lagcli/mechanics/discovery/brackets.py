"""Poisson brackets of charges at random states, and what follows from them by linear algebra.

With p = dL/dq' the derivatives at constant q and p are, for Q(q, q', t),

    dQ/dp = M^-1 dQ/dq',    dQ/dq|_p = dQ/dq|_q' - (dp/dq)^T dQ/dp,

so no Legendre transform has to be solved.  The structure constants of
{Q_a, Q_b} = sum_c C_ab^c Q_c + const are found from as many states as there are charges and
confirmed at others, at 40 digits.  Under holonomic constraints they are Dirac's brackets.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 9.5.
Dirac, *Lectures on Quantum Mechanics* (1964), lecture 2.
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 49 (Liouville).
Nekhoroshev, Trans. Moscow Math. Soc. 26 (1972) 180 (k - r/2 = n).
Mishchenko, Fomenko, Funct. Anal. Appl. 12 (1978) 113 (the same for a Lie algebra of integrals).
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, combinations

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import derivative
from lagcli.algebra.numeric import DIGITS, Evaluator, with_assumed_sign
from lagcli.algebra.row_rank import nullspace, rank, rows_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.dynamics import Dynamics

_SMALL = mpf(10) ** -20  # measured: zeros are below 5e-37, others above 8e-3
_CHECKS = 2
_STEP = mpf(10) ** -16  # the central difference has errors of its square
_TRIES = 60  # measured: at most 6
_PATIENCE = 6  # states that fail before other parameters are tried

Vector = list[mpf]
State = dict[Symbol, mpf]


class NoState(Exception):
    """No state was found at which all charges have real values."""


@dataclass(frozen=True, slots=True)
class Sample:
    """At one state: values of the charges, gradients by q and p, by q and q', brackets."""

    state: State
    values: Vector
    by_q: list[Vector]
    by_p: list[Vector]
    slopes: list[Vector]
    surface: list[Vector]  # slopes of what the constraints keep at 0

    def bracket(self, a: int, b: int) -> mpf:
        """{Q_a, Q_b}."""
        one = mpmath.fdot(self.by_q[a], self.by_p[b])
        return one - mpmath.fdot(self.by_p[a], self.by_q[b])

    def joined(self, chosen: Sequence[int], combinations: Sequence[Vector]) -> Sample:
        """The sample with combinations of the chosen charges as further ones."""

        def gradients(rows: list[Vector]) -> list[Vector]:
            parts = list(zip(*(rows[a] for a in chosen), strict=True))
            return [*rows, *([mpmath.fdot(c, part) for part in parts] for c in combinations)]

        values = [mpmath.fdot(c, [self.values[a] for a in chosen]) for c in combinations]
        by_q, by_p, slopes = map(gradients, (self.by_q, self.by_p, self.slopes))
        return Sample(self.state, [*self.values, *values], by_q, by_p, slopes, self.surface)


@dataclass(frozen=True, slots=True)
class Structure:
    """C[a][b][c], and the constants K[a][b]; `scale` holds the part that has the energy."""

    constants: list[list[Vector]]
    central: list[Vector]
    by_energy: list[list[Vector]] | None = None


class ChargeBrackets:
    """Charges as functions on phase space, or on the surface of holonomic constraints there."""

    def __init__(self, charges: Sequence[Expr], dynamics: Dynamics, allowed: Allowance) -> None:
        system, equations = dynamics.system, dynamics.constraints.equations
        kept = dynamics.independent_constraints
        surface = [dynamics.constraints.velocity_forms[k] for k in kept]
        surface += [equations[k].f for k in kept if equations[k].holonomic]
        self._constraints = len(surface)
        q, v = system.q, system.qdot
        slopes = [[derivative(Q, x) for x in (*q, *v)] for Q in (*charges, *surface)]
        self.charges = (*charges, *surface)
        self.dynamics, self.allowed = dynamics, allowed
        expressions: list[Expr] = [*self.charges, *chain.from_iterable(slopes)]
        expressions += [m for row in dynamics.lagrange.mass_matrix for m in row]
        expressions += [derivative(p, x) for p in dynamics.lagrange.momenta for x in q]
        self._evaluate = Evaluator(expressions)
        self._samples: list[Sample] = []
        self._source = self._states(0)
        self._joined: list[tuple[Sequence[int], list[Vector]]] = []

    @property
    def has_parameters(self) -> bool:
        """Whether the charges or L contain parameters."""
        system = self.dynamics.system
        variables = {system.t, *system.q, *system.qdot}
        return any(e.free_symbols - variables for e in (system.L, *self.charges))

    # -- states -------------------------------------------------------------------------------

    def _states(self, first: int) -> Iterator[Sample]:
        system = self.dynamics.system
        source = random.Random("lagcli brackets")
        bad = 0
        place: State = {}
        while bad < _TRIES:
            self.allowed.check()
            with mpmath.workdps(DIGITS):
                # the same parameters for all states; others where charges are not real
                turn = bad // _PATIENCE
                base = self._of_order(self.dynamics.states.take(1 + first + turn)[-1], turn)
                width = turn if turn % 2 else 1  # beyond a horizon r^2 > m as well
                state = dict(base)
                for x in (*system.q, *system.qdot):
                    scale = mpf(1) / 3 if x in system.qdot else mpf(width)
                    size = scale * source.randint(2000, 13000) / 10007
                    state[x] = with_assumed_sign(source, x, size, 0.6)
                near = place or (base if bad % 2 else {})  # where roots and logarithms are real
                for x in (*system.q, *system.qdot) if bad and near else ():
                    state[x] = (state[x] + 15 * near[x]) / 16
                state[system.t] = mpf(source.randint(1000, 9000)) / 10007
                sample = self._sample(state) if self.dynamics.states.placed(state) else None
            if sample is not None:
                place = place or state
                yield sample
                continue
            bad += 1
            if bad % _PATIENCE == 0:
                self._samples.clear()
                place = {}

    def _of_order(self, state: State, turn: int) -> State:
        """With parameters of other orders where no value was real: (m W - B)^2 > 8 m k is rare."""
        source = random.Random(turn)
        scaled = {
            p: state[p] * mpf(2) ** source.randint(-3, 3)
            for p in (self.dynamics.system.parameters if turn > 2 else ())
            if p in state and not p.is_integer
        }
        return {**state, **scaled}

    def _sample(self, state: State) -> Sample | None:
        """None where there are no real values."""
        try:
            values = self._evaluate(state)
            real = all(isinstance(x, mpf) and mpmath.isfinite(x) for x in values)
            return self._with_brackets(state, values) if real else None
        except (ArithmeticError, ValueError):
            return None

    def _with_brackets(self, state: State, values: Vector) -> Sample:
        n, count = len(self.dynamics.system.q), len(self.charges)
        start = count + 2 * n * count
        mass = mpmath.matrix(rows_of(values[start : start + n * n], n))
        cross = mpmath.matrix(rows_of(values[start + n * n :], n))  # dp_k/dq_i
        inverse = mass**-1
        slopes = [list(row) for row in rows_of(values[count:start], 2 * n)]
        by_p = [list(inverse * mpmath.matrix(row[n:])) for row in slopes]
        by_q = [
            list(mpmath.matrix(row[:n]) - cross.T * mpmath.matrix(p))
            for row, p in zip(slopes, by_p, strict=True)
        ]
        sample = Sample(state, values[:count], by_q, by_p, slopes, [])
        if self._constraints:
            sample = _on_surface(sample, self._constraints)
        for chosen, combined in self._joined:
            sample = sample.joined(chosen, combined)
        return sample

    def samples(self, count: int) -> list[Sample]:
        """That many states.

        Raises
        ------
        NoState
            Where the formulas have no real values.
        """
        while len(self._samples) < count:
            sample = next(self._source, None)
            if sample is None:
                raise NoState
            self._samples.append(sample)
        return self._samples[:count]

    # -- counting ---------------------------------------------------------------------------

    def commute(self, a: int, b: int) -> bool:
        """Whether the bracket vanishes."""
        with mpmath.workdps(DIGITS):
            return all(abs(s.bracket(a, b)) < _SMALL for s in self.samples(3))

    def independent(self, chosen: Sequence[int]) -> int:
        """The number of functionally independent ones: the rank of their gradients."""
        with mpmath.workdps(DIGITS):
            sample = self.samples(1)[0]
            return rank([[*sample.by_q[a], *sample.by_p[a]] for a in chosen])

    def in_involution(self, chosen: Sequence[int]) -> int:
        """The largest number of independent ones among the chosen that all commute."""
        friends = {a: {b for b in chosen if b != a and self.commute(a, b)} for a in chosen}
        n = len(self.dynamics.system.q)
        best = 0

        def grow(kept: list[int], left: list[int]) -> None:
            nonlocal best
            self.allowed.check()
            best = max(best, len(kept))
            for k, a in enumerate(left):
                if best == n or len(kept) + len(left) - k <= best:
                    return
                if self.independent([*kept, a]) == len(kept) + 1:
                    grow([*kept, a], [b for b in left[k + 1 :] if b in friends[a]])

        grow([], list(chosen))
        return best

    def functions_in_involution(self, chosen: Sequence[int]) -> int | None:
        """The largest number of independent functions of the chosen that all commute.

        It is k - r/2 for k independent ones with brackets of rank r at a general state, where the
        brackets are functions of them: they do not change where the chosen stay the same.  None
        where they do.
        """
        numbers = [0] if not chosen else []
        with mpmath.workdps(DIGITS):
            for sample in self.samples(_CHECKS) if chosen else ():
                if not self._closed(sample, chosen):
                    return None
                brackets = [[sample.bracket(a, b) for b in chosen] for a in chosen]
                some = any(abs(x) > _SMALL for row in brackets for x in row)
                numbers.append(self.independent(chosen) - (rank(brackets) // 2 if some else 0))
        return min(numbers)

    def _closed(self, sample: Sample, chosen: Sequence[int]) -> bool:
        """Whether the brackets stay the same one step along a surface of constant charges."""
        self.allowed.check()
        system = self.dynamics.system
        ways = nullspace([*(sample.slopes[a] for a in chosen), *sample.surface])
        if not ways:
            return True
        way = [mpmath.fsum(x / (1 + k) for k, x in enumerate(c)) for c in zip(*ways, strict=True)]
        moving = list(zip((*system.q, *system.qdot), way, strict=True))
        one, other = (
            self._sample({**sample.state, **{x: sample.state[x] + h * w for x, w in moving}})
            for h in (_STEP, -_STEP)
        )
        return (
            one is not None
            and other is not None
            and all(
                abs(one.bracket(a, b) - other.bracket(a, b))
                < 2 * _STEP * _SMALL * (1 + abs(sample.bracket(a, b)))
                for a, b in combinations(chosen, 2)
            )
        )

    def still(self, chosen: Sequence[int], other: int) -> list[int]:
        """The numbers of new charges: combinations of the chosen that commute with another.

        Where that is the energy they do not contain the time, though the chosen may.
        """
        with mpmath.workdps(DIGITS):
            samples = self.samples(len(self.charges) + _CHECKS)
            found = nullspace([[s.bracket(a, other) for a in chosen] for s in samples])
            self._joined.append((chosen, found))
            self._samples = [s.joined(chosen, found) for s in samples]
            count = len(samples[0].values)
            return list(range(count, count + len(found)))

    # -- structure constants ------------------------------------------------------------------

    def structure(
        self, chosen: Sequence[int], energy: int | None = None, turn: int = 0
    ) -> Structure | None:
        """The structure constants, None where the brackets do not close linearly.

        With `energy`, coefficients may be linear in that charge; with `turn`, for others of the
        parameters.
        """
        kept = self._samples, self._source
        try:
            if turn:
                self._samples, self._source = [], self._states(turn)
            with mpmath.workdps(DIGITS):
                return self._structure(list(chosen), energy)
        finally:
            if turn:
                self._samples, self._source = kept

    def _structure(self, chosen: list[int], energy: int | None) -> Structure | None:
        count = len(chosen)
        width = count + 1 if energy is None else 2 * count + 2
        samples = self.samples(width + _CHECKS)

        def row(sample: Sample) -> Vector:
            values = [*(sample.values[a] for a in chosen), mpf(1)]
            more = [] if energy is None else [sample.values[energy] * x for x in values]
            return [*values, *more]

        try:
            inverse = mpmath.matrix([row(s) for s in samples[:width]]) ** -1
        except (ZeroDivisionError, TypeError):  # no pivot: mpmath has one exception or the other
            return None
        constants = [[[mpf(0)] * count for _ in chosen] for _ in chosen]
        second = [[[mpf(0)] * count for _ in chosen] for _ in chosen]
        central = [[mpf(0)] * count for _ in chosen]
        shifts: list[Vector] = []  # rows of C s = K, where the energy has coefficients
        for i in range(count):
            for j in range(i):
                self.allowed.check()
                brackets = [s.bracket(chosen[i], chosen[j]) for s in samples]
                c = list(inverse * mpmath.matrix(brackets[:width]))
                c = [x if abs(x) > _SMALL else mpf(0) for x in c]
                for sample, value in zip(samples[width:], brackets[width:], strict=True):
                    if abs(mpmath.fdot(row(sample), c) - value) > _SMALL * (1 + abs(value)):
                        return None
                for sign, a, b in ((1, i, j), (-1, j, i)):
                    constants[a][b] = [sign * x for x in c[:count]]
                    central[a][b] = sign * c[count]
                    if energy is not None:
                        second[a][b] = [sign * x for x in c[count + 1 : -1]]
                shifts += [c[: count + 1], c[count + 1 :]]
        if energy is None:
            return Structure(constants, central)
        # without the s of p_phi + s: {A_x, A_y} = -2 E p_phi has no E s
        if rank([row[:-1] for row in shifts]) < rank(shifts):
            return None
        return Structure(constants, [[mpf(0)] * count for _ in chosen], second)


def _on_surface(sample: Sample, count: int) -> Sample:
    """The sample with Dirac's brackets: f - phi_a (C^-1)_ab {phi_b, f}, C_ab = {phi_a, phi_b}."""
    first = len(sample.values) - count
    surface = range(first, len(sample.values))
    C = mpmath.matrix([[sample.bracket(a, b) for b in surface] for a in surface])
    inverse = C**-1
    by_q, by_p = [], []
    for f in range(first):
        along = inverse * mpmath.matrix([sample.bracket(b, f) for b in surface])
        by_q.append(_less(sample.by_q, f, along, surface))
        by_p.append(_less(sample.by_p, f, along, surface))
    slopes = sample.slopes
    return Sample(sample.state, sample.values[:first], by_q, by_p, slopes[:first], slopes[first:])


def _less(rows: list[Vector], f: int, along: mpmath.matrix, surface: range) -> Vector:
    return [
        x - mpmath.fsum(along[k] * rows[a][j] for k, a in enumerate(surface))
        for j, x in enumerate(rows[f])
    ]
