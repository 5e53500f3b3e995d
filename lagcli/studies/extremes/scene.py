"""A problem in which everything has a number, and its state at t = 0."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from lagcli.expression import Expression, Name, signed
from lagcli.graph.nodes import Node, Symbol, mask_of, with_values
from lagcli.numerics.equations.arithmetic import Balls, Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.null_space import held_motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.equations.surface import Surface
from lagcli.problem_data import Parameter, Problem

Vector = list[float]

_ROUNDS = 40
_GOLDEN = 371  # of 600
_ON_SURFACE = 1e-12
#: A step of a coordinate that shows whether anything depends on it.
_ELSEWHERE, _SAME = 0.37, 1e-12


def number(value: float | Fraction) -> Expression:
    """A number as a tree, decimal where it is one."""
    return signed(value, decimal=Fraction(value).denominator != 1)


def with_all_values(problem: Problem) -> tuple[Problem, dict[str, Fraction]]:
    """The problem with a value for each parameter that has none, and these values.

    They are near 1 and in no simple ratio: with 1 for each, a hoop would turn with just the
    speed at which its bead becomes unstable.
    """
    missing = [p for p in problem.parameters if p.value is None]
    taken = {p.name: _ordinary(p, place) for place, p in enumerate(missing, 1)}
    return problem.with_values({name: number(value) for name, value in taken.items()}), taken


def _ordinary(parameter: Parameter, place: int) -> Fraction:
    """The place-th of numbers from 0.7 to 1.3, spread by the golden ratio; an integer is 2, 3, …"""
    thousandths = Fraction(700 + place * _GOLDEN % 600, 1000)
    size = Fraction(1 + place) if parameter.integer else thousandths
    return -size if parameter.assume == "negative" else size


class ExtremeScene:
    """Equations, values and a state.

    Parameters
    ----------
    problem
        With values for all parameters.
    state
        A state to begin from where the file's `initial` is empty or does not do; the
        constraints are solved from there.

    Raises
    ------
    Refusal
        When there are no numbers for it.
    """

    def __init__(self, problem: Problem, state: tuple[Vector, Vector] | None = None) -> None:
        self.problem = problem
        given = frozenset(range(len(problem.constraints)))
        whole = EquationsOfMotion(with_contacts(problem))
        self.equations = e = whole if not problem.contacts else whole.holding(given)
        parameters: list[Node] = [e.graph.symbol(p.name) for p in problem.parameters]
        self.constants: Mapping[Symbol, float] = constants_of(e, parameters, Doubles())
        self.motion = Motion(e, self.constants, Doubles())
        self.n = len(e.q)
        self.q, self.v = self._state(state)

    def _state(self, state: tuple[Vector, Vector] | None) -> tuple[Vector, Vector]:
        if self.problem.initial:
            try:
                return initial_state(self.motion, self.problem.initial, project=True)
            except Refusal:
                if state is None:
                    raise
        q, v = state or self._anywhere()
        found = self.settled(q, v)
        if found is None:
            raise Refusal("no state that the constraints allow was found", mistake=False)
        return found

    def _anywhere(self) -> tuple[Vector, Vector]:
        """A state in which nothing is special."""
        q, v = [], []
        for j, coordinate in enumerate(self.problem.coordinates):
            size = 0.7 + 0.4 * j / self.n
            q.append(-size if coordinate.assume == "negative" else size)
            v.append(0.2 + 0.1 * j / self.n)
        return q, v

    def value(self, name: str) -> float:
        """The value of a parameter."""
        return self.constants[self.equations.graph.symbol(name)]

    def settled(
        self, q: Sequence[float], v: Sequence[float], fixed: Collection[int] = ()
    ) -> tuple[Vector, Vector] | None:
        """The state on the constraints by the shortest way, some coordinates and rates kept.

        None where Newton's steps lead nowhere.
        """
        q, v = list(q), list(v)
        if not self.equations.rows:
            return q, v
        try:
            for _ in range(_ROUNDS):
                residuals = self.motion.positions(0.0, *q, *v)
                step = self._shortest(q, v, self.equations.holonomic, residuals, fixed)
                q = [x + d for x, d in zip(q, step, strict=True)]
                if max(map(abs, step)) <= 1e-16 * max(map(abs, q)):
                    break
            for _ in range(3):
                every = range(len(self.equations.rows))
                step = self._shortest(q, v, every, self.motion.rates(0.0, *q, *v), fixed)
                v = [x + d for x, d in zip(v, step, strict=True)]
            surface = Surface(self.motion)
            surface.measure(0.0, q, v)
            residuals = (*self.motion.positions(0.0, *q, *v), *self.motion.rates(0.0, *q, *v))
        except (ArithmeticError, ValueError):
            return None
        off = max(surface.relative(k, x) for k, x in enumerate(residuals))
        return (q, v) if off <= _ON_SURFACE else None

    def _shortest(
        self,
        q: Vector,
        v: Vector,
        which: Sequence[int],
        residuals: Sequence[float],
        fixed: Collection[int],
    ) -> Vector:
        """The shortest d with A d = -residuals, 0 where a coordinate is fixed."""
        free = [j for j in range(self.n) if j not in fixed]
        held = self.motion.system(0.0, *q, *v)[2]
        rows = [[held[k][j] for j in free] for k in which]
        unit = [[float(i == j) for j in free] for i in free]
        found = held_motion(unit, [0.0] * len(free), rows, list(residuals)).accelerations
        step = [0.0] * self.n
        for j, d in zip(free, found, strict=True):
            step[j] = d
        return step

    def in_balls(self) -> tuple[Motion, list[Any]]:
        """The motion and the state in balls of the digits that are set."""
        arithmetic = Balls()
        constants = {symbol: arithmetic.ball(x) for symbol, x in self.constants.items()}
        state = [arithmetic.ball(x) for x in (0.0, *self.q, *self.v)]
        return Motion(self.equations, constants, arithmetic), state

    def at(
        self, q: Sequence[float], v: Sequence[float], exact: Mapping[Name, Expression] | None = None
    ) -> dict[Name, Expression]:
        """A state as `initial` of the format; `exact` are values that are no doubles."""
        names = [c.name for c in self.problem.coordinates]
        state = {Name(x): number(value) for x, value in zip(names, q, strict=True)}
        state |= {Name(x, 1): number(value) for x, value in zip(names, v, strict=True)}
        return state | dict(exact or {})

    # -- what stands where -------------------------------------------------------------------

    @cached_property
    def dynamics(self) -> list[Node]:
        """All that the motion follows from."""
        return [*self.equations.dynamics, *self.equations.positions]

    @cached_property
    def ignorable(self) -> tuple[Symbol, ...]:
        """The coordinates that the equations do not depend on, though they may name them."""
        found = []
        for j, symbol in enumerate(self.equations.q):
            moved = [*self.q[:j], self.q[j] + _ELSEWHERE, *self.q[j + 1 :]]
            try:
                here = [self.motion.matrices(0.0, *q, *self.v) for q in (self.q, moved)]
                places = [self.motion.positions(0.0, *q, *self.v) for q in (self.q, moved)]
            except (ArithmeticError, ValueError):
                continue
            size = max(map(abs, here[0]))
            pairs = [*zip(*here, strict=True), *zip(*places, strict=True)]
            if all(abs(a - b) <= _SAME * size for a, b in pairs):
                found.append(symbol)
        return tuple(found)

    def is_in(self, name: str, nodes: Sequence[Node]) -> bool:
        """Whether a parameter, or one that it is the value of, occurs."""
        e = self.equations
        return bool(e.graph.symbol(name).mask & with_values(mask_of(nodes), e.parameter_values))
