"""Lagrangian mechanics in numbers: the definitions, differentiated automatically.

Nothing here is symbolic and nothing is shared with lagcli.mechanics or lagcli.algebra.
Every function takes a moment (t, q, q', q'', ...), whose entries may themselves be jets.

    d/dt(dL/dq_j') - dL/dq_j = Q_j - dD/dq_j' + sum_k lambda_k a_kj
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from mpmath import mpf

from lagcli.expression import Expression, Name, walk
from lagcli.problem_data import Constraint, Problem

from .evaluate import Moment, Setting, evaluate
from .functions import StandIn
from .jets import Number, coefficient, family, infinitesimal
from .legendre_inverse import Inverse

Scalar = Callable[[Moment], Number]
Vector = Callable[[Moment], list[Number]]


def rate(f: Scalar, moment: Moment) -> Number:
    """df/dt along the moment's own motion."""
    with family() as later:
        return coefficient(f(moment.after(infinitesimal(later))), later)


def rates(f: Vector, moment: Moment) -> list[Number]:
    """The same for several functions at once."""
    with family() as later:
        return [coefficient(x, later) for x in f(moment.after(infinitesimal(later)))]


def gradient(f: Scalar, moment: Moment, level: int) -> list[Number]:
    """df/dq (level 0), df/dq' (level 1), ... in the order of the coordinates."""
    size = len(moment.chain[0])
    with family() as nearby:
        value = f(moment.shifted(level, {i: infinitesimal(nearby, i) for i in range(size)}))
        return [coefficient(value, nearby, i) for i in range(size)]


def by_time(f: Scalar, moment: Moment) -> Number:
    """The explicit df/dt."""
    with family() as nearby:
        return coefficient(f(replace(moment, t=moment.t + infinitesimal(nearby))), nearby)


def dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    """sum_j a_j b_j."""
    total: Number = mpf(0)
    for x, y in zip(a, b, strict=True):
        total = total + x * y
    return total


class Reference:
    """A problem as numeric functions of a moment."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.names = tuple(c.name for c in problem.coordinates)
        self.size = len(self.names)
        self.setting = Setting(
            self.names,
            problem.definitions,
            {name: StandIn(name, len(args)) for name, args in problem.functions.items()},
        )
        self._inverse = Inverse(self.hamiltonian, self.names)

    def of(self, node: Expression) -> Scalar:
        """An expression as a function of the moment."""
        return lambda moment: evaluate(node, self.setting, moment)

    # -- energies and forces --------------------------------------------------------------

    def kinetic(self, moment: Moment) -> Number:
        """T as given, or the sum over the points of m v^2 / 2."""
        if self.problem.kinetic is not None:
            return evaluate(self.problem.kinetic, self.setting, moment)
        total: Number = mpf(0)
        for point in self.problem.points:
            if point.mass is not None:
                for x in point.position:
                    v = rate(self.of(x), moment)
                    total = total + evaluate(point.mass, self.setting, moment) * v * v / 2
        return total

    def potential(self, moment: Moment) -> Number:
        """V, which may depend on the velocities; 0 when absent."""
        potential = self.problem.potential
        return mpf(0) if potential is None else evaluate(potential, self.setting, moment)

    def lagrangian(self, moment: Moment) -> Number:
        """L as given, or T - V, or the transform of H."""
        if self.problem.lagrangian is not None:
            return evaluate(self.problem.lagrangian, self.setting, moment)
        if self.problem.hamiltonian is not None:
            return self._inverse.lagrangian(moment)
        return self.kinetic(moment) - self.potential(moment)

    def hamiltonian(self, moment: Moment) -> Number:
        """H as given, at a moment that names the momenta `p_x`."""
        assert self.problem.hamiltonian is not None
        return evaluate(self.problem.hamiltonian, self.setting, moment)

    def momenta(self, moment: Moment) -> list[Number]:
        """p_j = dL/dq_j'."""
        return gradient(self.lagrangian, moment, 1)

    def energy(self, moment: Moment) -> Number:
        """h = sum q' p - L."""
        return dot(moment.chain[1], self.momenta(moment)) - self.lagrangian(moment)

    def inertia(self, moment: Moment) -> list[Number]:
        """d/dt(dL/dq_j') - dL/dq_j."""
        slopes = gradient(self.lagrangian, moment, 0)
        return [a - b for a, b in zip(rates(self.momenta, moment), slopes, strict=True)]

    def mass_matrix(self, moment: Moment) -> list[list[Number]]:
        """d^2 L / dq_i' dq_j'."""
        with family() as nearby:
            steps = {j: infinitesimal(nearby, j) for j in range(self.size)}
            momenta = self.momenta(moment.shifted(1, steps))
            return [[coefficient(p, nearby, j) for j in range(self.size)] for p in momenta]

    def applied(self, moment: Moment) -> list[Number]:
        """Q_j - dD/dq_j': forces as given, on points by virtual work F . dr/dq_j, and friction."""
        given = self.problem.forces
        total: list[Number] = [
            evaluate(given[name], self.setting, moment) if name in given else mpf(0)
            for name in self.names
        ]
        for point in self.problem.points:
            for component, x in zip(point.force or (), point.position, strict=False):
                force = evaluate(component, self.setting, moment)
                lever = gradient(self.of(x), moment, 0)
                total = [f + force * arm for f, arm in zip(total, lever, strict=True)]
        if self.problem.dissipation is not None:
            drag = gradient(self.of(self.problem.dissipation), moment, 1)
            total = [f - d for f, d in zip(total, drag, strict=True)]
        return total

    # -- constraints ------------------------------------------------------------------------

    def holonomic(self, constraint: Constraint) -> bool:
        """Whether the constraint is written without velocities (also inside definitions)."""
        equation = constraint.equation
        return not (self.moves(equation.left) or self.moves(equation.right))

    def moves(self, node: Expression) -> bool:
        """Whether velocities occur, be it inside definitions."""
        for part in walk(node):
            if isinstance(part, Name):
                if part.primes:
                    return True
                definition = self.problem.definitions.get(part.name)
                if definition is not None and self.moves(definition):
                    return True
        return False

    def value(self, constraint: Constraint) -> Scalar:
        """f = left - right."""
        equation = constraint.equation
        return lambda m: self.of(equation.left)(m) - self.of(equation.right)(m)

    def row(self, constraint: Constraint, moment: Moment) -> list[Number]:
        """a_j: df/dq_j, or df/dq_j' of a velocity constraint."""
        level = 0 if self.holonomic(constraint) else 1
        return gradient(self.value(constraint), moment, level)

    def velocity_form(self, constraint: Constraint) -> Scalar:
        """A . q' + b, which vanishes on the motion: df/dt, or f itself."""
        f = self.value(constraint)
        return (lambda m: rate(f, m)) if self.holonomic(constraint) else f

    def bias(self, constraint: Constraint, moment: Moment) -> Number:
        """d/dt(A . q' + b) where q'' = 0."""
        still = tuple(mpf(0) for _ in self.names)
        coasting = replace(moment, chain=(*moment.chain[:2], still))
        return rate(self.velocity_form(constraint), coasting)

    # -- symmetry ---------------------------------------------------------------------------

    def charge(
        self, changes: Mapping[str, Expression], time: Expression | None, gauge: Expression | None
    ) -> Scalar:
        """Q = sum_j dL/dq_j' (Dq_j - q_j' Dt) + L Dt - G."""

        def noether(m: Moment) -> Number:
            stretch = self._optional(time, m)
            total = self.lagrangian(m) * stretch - self._optional(gauge, m)
            for name, p, v in zip(self.names, self.momenta(m), m.chain[1], strict=True):
                total = total + p * (self._optional(changes.get(name), m) - v * stretch)
            return total

        return noether

    def change_of_action(
        self, changes: Mapping[str, Expression], time: Expression | None
    ) -> Scalar:
        """K = Dq . dL/dq + dL/dq' . (d(Dq)/dt - q' d(Dt)/dt) + dL/dt Dt + L d(Dt)/dt."""

        def change(m: Moment) -> Number:
            stretch = rate(lambda n: self._optional(time, n), m)
            slopes = gradient(self.lagrangian, m, 0)
            total = by_time(self.lagrangian, m) * self._optional(time, m)
            total = total + self.lagrangian(m) * stretch
            for j, (name, p) in enumerate(zip(self.names, self.momenta(m), strict=True)):
                node = changes.get(name)
                growth = rate(lambda n, node=node: self._optional(node, n), m)  # type: ignore[misc]
                total = total + slopes[j] * self._optional(node, m)
                total = total + p * (growth - m.chain[1][j] * stretch)
            return total

        return change

    def _optional(self, node: Expression | None, moment: Moment) -> Number:
        return mpf(0) if node is None else evaluate(node, self.setting, moment)
