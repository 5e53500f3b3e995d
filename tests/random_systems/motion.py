"""The mechanics of a system by brute force: differences of L at 90 digits, and linear algebra.

d/dt(dL/dq') - dL/dq = Q - dD/dq' + A^T lam with the constraints f = 0 differentiated until
they are linear in q'': A q'' + b = 0.  Along q(t + h) = q + q' h + q'' h^2/2 every total
derivative is a difference in h.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field, replace
from functools import cached_property

from mpmath import mp, mpf

from . import linear
from .grammar import Undefined, Unspecified, read
from .legendre import Legendre
from .system import System

mp.dps = 90
H = mpf(10) ** -18  # exp(40) in a potential has a third derivative of 1e19
FREE = (None, "nonzero")


@dataclass
class State:
    """Where the system is: q, q', q'' by order of the coordinates, and t."""

    q: list
    v: list
    t: object
    a: list
    lam: list = field(default_factory=list)


def ahead(state: State, h) -> State:
    """The state at t + h along the motion."""
    q = [q + v * h + a * h * h / 2 for q, v, a in zip(state.q, state.v, state.a, strict=True)]
    v = [v + a * h for v, a in zip(state.v, state.a, strict=True)]
    return replace(state, q=q, v=v, t=state.t + h)


def rate(function, state: State):
    """d/dt of a function along the motion."""
    return (function(ahead(state, H)) - function(ahead(state, -H))) / (2 * H)


class Motion:
    """A system with numbers for its parameters."""

    def __init__(self, system: System, seed: int) -> None:
        self.system, self.rng = system, random.Random(seed)
        self.shared = {}  # names that an answer gives to its own subexpressions
        self.coordinates = list(system.coordinates)
        self.n = len(self.coordinates)
        self.constants = self._constants()
        self.constraints = {name: read(text) for name, text in system.constraints.items()}
        self.on_velocities = {name: _has_velocity(t) for name, t in system.constraints.items()}
        self._energies()
        self.forces = {q: read(text) for q, text in system.forces.items()}
        self.D = read(system.dissipation) if system.dissipation else None

    # -- numbers ------------------------------------------------------------------

    def _constants(self):
        names = {}
        for name, assume in self.system.parameters.items():
            value = self.system.values.get(name)
            names[name] = read(value)(names) if value else self._number(assume)
        for name, of in self.system.functions.items():
            names[name] = Unspecified(self.rng, len(of))
        return names

    def _number(self, assume):
        size = mpf(self.rng.randint(300, 2500)) / 1009
        negative = assume == "negative" or (assume in FREE and self.rng.random() < 0.5)
        return -size if negative else size

    def names(self, state: State):
        """Name -> number, for a formula of the file or of an answer."""
        table = dict(self.constants)
        table["t"] = state.t
        for name, q, v, a in zip(self.coordinates, state.q, state.v, state.a, strict=True):
            table[name], table[name + "'"], table[name + "''"] = q, v, a
        for i, (name, text) in enumerate(self.definitions.items()):
            table["#definitions"] = dict(list(self.definitions.items())[:i])
            table[name] = text(table)
            table[name + "'"] = _total_derivative(self, name, state)
        table["#definitions"] = self.definitions
        return table | self.shared

    @cached_property
    def kinked(self):
        """Whether a constraint may have a kink where a coordinate is 0."""
        texts = " ".join(self.system.constraints.values())
        return any(name in texts for name in ("abs", "sign", "sqrt", "log", "atan"))

    @cached_property
    def definitions(self):
        return {name: read(text) for name, text in self.system.definitions.items()}

    # -- L, its slopes, the constraints ---------------------------------------------

    def _energies(self):
        self.T = read(self.system.T) if self.system.T else None
        self.V = read(self.system.V) if self.system.V else None
        self._L = read(self.system.L) if self.system.L else None
        if self.system.H:
            self._L = Legendre(self.system.H, self.coordinates)
        self.positions = {
            name: ([read(each) for each in position], read(mass))
            for name, (position, mass) in self.system.points.items()
        }

    def kinetic(self, state):
        if self.T is not None:
            return self.T(self.names(state))
        still = replace(state, a=[mpf(0)] * self.n)
        return sum(
            mass(self.names(state)) * rate(lambda s, x=x: x(self.names(s)), still) ** 2 / 2
            for position, mass in self.positions.values()
            for x in position
        )

    def potential(self, state):
        return self.V(self.names(state)) if self.V is not None else mpf(0)

    def L(self, state):
        if self._L is not None:
            return self._L(self.names(state))
        return self.kinetic(state) - self.potential(state)

    def p(self, state):
        """p = dL/dq'."""
        return [slope(self.L, state, "v", i) for i in range(self.n)]

    def euler_lagrange(self, state):
        """d/dt(dL/dq') - dL/dq at any q, q', q''."""
        return [
            rate(lambda s, i=i: slope(self.L, s, "v", i), state) - slope(self.L, state, "q", i)
            for i in range(self.n)
        ]

    def applied(self, state):
        """Q - dD/dq'."""
        found = []
        for i, name in enumerate(self.coordinates):
            force = self.forces[name](self.names(state)) if name in self.forces else mpf(0)
            if self.D is not None:
                force -= slope(lambda s: self.D(self.names(s)), state, "v", i)
            found.append(force)
        return found

    def value(self, constraint, state):
        return self.constraints[constraint](self.names(state))

    def row(self, constraint, state):
        """df/dq, or df/dq' of a constraint on the velocities."""
        what = "v" if self.on_velocities[constraint] else "q"
        f = lambda s: self.value(constraint, s)  # noqa: E731
        return [slope(f, state, what, i) for i in range(self.n)]

    def rows(self, state):
        return [self.row(name, state) for name in self.constraints]

    def bias(self, constraint, state):
        """b in A q'' + b = 0."""
        still = replace(state, a=[mpf(0)] * self.n)
        f = lambda s: self.value(constraint, s)  # noqa: E731
        if self.on_velocities[constraint]:
            return rate(f, still)
        return (f(ahead(still, H)) - 2 * f(still) + f(ahead(still, -H))) / H**2

    # -- states ------------------------------------------------------------------------

    def draw(self, tries=60, wide=1):
        """A random state on the constraints with its motion, or None.

        Every fourth attempt has damped steps: those of Newton leave a surface on which the
        gradients of redundant constraints are parallel.
        """
        for attempt in range(tries):
            try:
                state = self._on_constraints(self._anywhere(wide), damped=attempt % 4 == 3)
                if state is not None:
                    self.L(state)
                    return state
            except (Undefined, ZeroDivisionError):
                continue
        return None

    def _anywhere(self, wide):
        q = [
            mpf(self.rng.randint(100, 1900)) / 1013 * wide
            * (-1 if assume == "negative" or (assume in FREE and self.rng.random() < 0.5) else 1)
            for assume in self.system.coordinates.values()
        ]  # fmt: skip
        slow = mpf(self.system.known.get("slow", 1))
        v = [mpf(self.rng.randint(-1500, 1500)) / 1021 * slow for _ in q]
        state = State(q, v, mpf(self.rng.randint(100, 1500)) / 1019, [mpf(0)] * self.n)
        if self.system.H:
            state.v = self._L.begin(self.names(state), v)
        return state

    def _on_constraints(self, state, damped):
        holonomic = [name for name in self.constraints if not self.on_velocities[name]]
        for _ in range(60 if holonomic else 0):
            values = [self.value(name, state) for name in holonomic]
            rows = [self.row(name, state) for name in holonomic]
            if all(abs(each) < mpf(10) ** -40 for each in values):
                break
            weight = min(linear.dot(values, values), mpf(1) / 4) if damped else 0
            step = linear.least(rows, values, weight)
            state = replace(state, q=[q - d for q, d in zip(state.q, step, strict=True)])
            if max(map(abs, state.q)) > 50:
                return None
        else:
            if holonomic:
                return None
        for q, assume in zip(state.q, self.system.coordinates.values(), strict=True):
            if abs(q) < mpf("0.001") and (assume is not None or self.kinked):
                return None
            if q * {"positive": 1, "negative": -1}.get(assume, 0) < 0:
                return None
        if max(map(abs, state.q)) > 50:
            return None
        if self.constraints:
            state = self._with_velocities(state)
        return state

    def _with_velocities(self, state):
        rows = self.rows(state)
        if any(max(map(abs, row)) < mpf(10) ** -8 for row in rows):
            return None  # a constraint without a gradient: a corner of its surface
        off = []
        for name in self.constraints:
            f = lambda s, name=name: self.value(name, s)  # noqa: E731
            off.append(f(state) if self.on_velocities[name] else rate(f, state))
        step = linear.least(rows, off)
        moved = replace(state, v=[v - d for v, d in zip(state.v, step, strict=True)])
        left = linear.times(rows, step)
        fits = all(abs(x - y) < mpf(10) ** -20 for x, y in zip(left, off, strict=True))
        return moved if fits else None

    @cached_property
    def names_of_multipliers(self):
        return {name: f"lambda_{name}" for name in self.constraints}

    def solve(self, state):
        """q'' and lam put into the state; the kernel; whether there is a solution."""
        flat = replace(state, a=[mpf(0)] * self.n)
        base = self.euler_lagrange(flat)
        M = linear.transposed(
            [
                [x - y for x, y in zip(self.euler_lagrange(_with_unit(flat, j)), base, strict=True)]
                for j in range(self.n)
            ]
        )
        A, Q = self.rows(state), self.applied(state)
        m = len(A)
        table = [[*M[i], *(-A[k][i] for k in range(m))] for i in range(self.n)]
        table += [[*A[k], *[mpf(0)] * m] for k in range(m)]
        right = [q - e for q, e in zip(Q, base, strict=True)]
        right += [-self.bias(name, state) for name in self.constraints]
        x, kernel, consistent = linear.solve(table, right)
        return replace(state, a=x[: self.n], lam=x[self.n :]), kernel, consistent, M


def _total_derivative(motion, name, state):
    """The prime on a definition, worked out where it stands in a formula."""

    def value(_):
        bare = replace(state, a=[mpf(0)] * motion.n)
        return rate(lambda s: motion.names(s)[name], bare)

    return value


def slope(function, state, what, i):
    """The partial derivative by q_i or q'_i."""
    up, down = list(getattr(state, what)), list(getattr(state, what))
    up[i], down[i] = up[i] + H, down[i] - H
    above, below = function(replace(state, **{what: up})), function(replace(state, **{what: down}))
    return (above - below) / (2 * H)


def _with_unit(state, j):
    return replace(state, a=[mpf(int(i == j)) for i in range(len(state.a))])


def _has_velocity(text):
    return "'" in text


__all__ = ["H", "Motion", "State", "ahead", "rate", "slope"]
