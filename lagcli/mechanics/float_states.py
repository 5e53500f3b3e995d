"""The rank of the constraints at a random state on them, in double precision.

Good for large systems, where the same at 50 digits takes minutes.  A rank is given only
where it is beyond doubt: what is left of a row after those before it is either a sizeable
part of it or nothing but rounding.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from operator import mul

from lagcli.graph.nodes import Node
from lagcli.graph.values import Concrete, Floats, Program
from lagcli.mechanics.rates import ConstraintRow
from lagcli.problem_data import Problem, Quantity
from lagcli.record import record

_ATTEMPTS = 12  # starts from other velocities
_NEWTON_STEPS = 60  # a double root gains a bit a step, and there are 53
#: So many of the attempts begin near the initial state, and so far from it.
_NEAR_START, _AWAY = 3, 0.2
#: What is left of a dependent row, and of an independent one, as a part of its length.
_ROUNDING, _SIZEABLE = 1e-10, 1e-6
_CLOSED = 1e-11

Row = list[float]


@record
class Independent:
    """Which rows are no combinations of those before them, and the shortest solution."""

    rows: tuple[int, ...]
    solution: Row


def least_norm(rows: Sequence[Row], right: Row) -> Independent | None:
    """The shortest x with row . x = right for the independent rows; None where in doubt.

    Modified Gram-Schmidt gives rows = L Q; then L y = right and x = Q^T y.
    """
    basis: list[Row] = []
    kept: list[int] = []
    solution = [0.0] * (len(rows[0]) if rows else 0)
    for index, row in enumerate(rows):
        length = math.hypot(*row)
        rest = row
        for _ in range(2):  # twice is enough (Kahan, Parlett)
            for unit in basis:
                along = sum(map(mul, rest, unit))
                if along:
                    rest = [x - along * y for x, y in zip(rest, unit, strict=True)]
        left = math.hypot(*rest)
        if left <= _ROUNDING * length:
            continue
        if left < _SIZEABLE * length:
            return None
        unit = [x / left for x in rest]
        y = (right[index] - sum(map(mul, row, solution))) / left
        solution = [x + y * e for x, e in zip(solution, unit, strict=True)]
        basis.append(unit)
        kept.append(index)
    return Independent(tuple(kept), solution)


class FloatStates:
    """Random states on the constraints of a problem.

    Parameters
    ----------
    problem
        Says which signs its quantities have.
    rows
        Its constraints as nodes.
    functions
        What stands for functions that are left unspecified.
    start
        Coordinates at t = 0: a mechanism may have other branches, of another rank.
    """

    def __init__(
        self,
        problem: Problem,
        rows: Sequence[ConstraintRow],
        functions: Mapping[str, Concrete],
        start: Mapping[str, Node],
    ) -> None:
        self.problem = problem
        self.rows = rows
        self._start = tuple(start)
        self._starts = Program(list(start.values()), Floats(), functions)
        positions = [row for row in rows if row.holonomic]
        self._count = len(positions)
        self._positions = Program(
            [*(row.f for row in positions), *(entry for row in positions for entry in row.row)],
            Floats(),
            functions,
        )
        self._velocities = Program(
            [*(row.drift for row in rows), *(entry for row in rows for entry in row.row)],
            Floats(),
            functions,
        )

    def independent_constraints(self) -> tuple[int, ...] | None:
        """Indices of the constraints that are not implied by earlier ones.

        None when no state was found, or the rank is in doubt at all that were.
        """
        if not self.rows:
            return ()
        source = random.Random("lagcli")
        for attempt in range(_ATTEMPTS):
            state = self._drawn(source)
            try:
                if attempt < _NEAR_START:
                    self._put_near_start(state, source)
                found = self._rank(state) if self._on_positions(state) else None
            except (ArithmeticError, ValueError):
                continue
            if found is not None:
                return found
        return None

    def _drawn(self, source: random.Random) -> dict[str, float]:
        problem = self.problem
        state = {"t": source.uniform(0.1, 0.9)}
        for parameter in problem.parameters:
            state[parameter.name] = (
                float(source.randint(2, 5))
                if parameter.integer
                else _signed(source, parameter, 0.6, 1.7)
            )
        for q in problem.coordinates:
            state[q.name] = _signed(source, q, 0.3, 1.3)
            state[q.name + "'"] = source.uniform(-0.9, 0.9)
        return state

    def _put_near_start(self, state: dict[str, float], source: random.Random) -> None:
        for name, value in zip(self._start, self._starts(state), strict=True):
            state[name] = value + _AWAY * source.uniform(-1.0, 1.0)

    def _on_positions(self, state: dict[str, float]) -> bool:
        """Newton steps of least norm onto f(q, t) = 0; whether they came there."""
        coordinates = self.problem.coordinates
        n, m = len(coordinates), self._count
        for _ in range(_NEWTON_STEPS if m else 0):
            values = self._positions(state)
            f, flat = values[:m], values[m:]
            rows = [flat[i * n : (i + 1) * n] for i in range(m)]
            size = max(1.0, *(math.hypot(*row) for row in rows))
            if max(map(abs, f)) <= _CLOSED * size:
                return all(_has_sign(q, state[q.name]) for q in coordinates)
            found = least_norm(rows, [-value for value in f])
            if found is None:
                return False
            longest = max(map(abs, found.solution))
            shrink = min(1.0, 2.0 / longest) if longest else 1.0
            for q, delta in zip(coordinates, found.solution, strict=True):
                moved = state[q.name] + shrink * delta
                # a coordinate that has a sign keeps it: half-way to zero instead
                state[q.name] = moved if _has_sign(q, moved) else state[q.name] / 2
        return m == 0

    def _rank(self, state: dict[str, float]) -> tuple[int, ...] | None:
        """The independent rows of A; None in doubt, or where A q' + b = 0 has no solution."""
        names = [q.name for q in self.problem.coordinates]
        n, m = len(names), len(self.rows)
        values = self._velocities(state)
        rows = [values[m + i * n : m + (i + 1) * n] for i in range(m)]
        right = [-drift for drift in values[:m]]
        found = least_norm(rows, right)
        if found is None:
            return None
        for row, b in zip(rows, right, strict=True):
            size = max(1.0, abs(b), math.hypot(*row))
            if abs(sum(map(mul, row, found.solution)) - b) > 1e-7 * size:
                return None
        return found.rows


def _signed(source: random.Random, quantity: Quantity, low: float, high: float) -> float:
    size = source.uniform(low, high)
    if quantity.assume == "negative":
        return -size
    if quantity.assume in {"positive", "nonnegative"} or source.random() < 0.7:
        return size
    return -size


def _has_sign(quantity: Quantity, value: float) -> bool:
    if quantity.assume in {"positive", "nonnegative"}:
        return value > 0
    return value < 0 if quantity.assume == "negative" else True
