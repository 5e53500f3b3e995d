"""The columns of the result: any expression of the grammar along the motion.

Momenta stand for dL/dq', `energy` for q' dL/dq' - L; accelerations and multipliers are
solved for only where a column needs them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from itertools import chain
from typing import Any

from lagcli.expression import Expression, Name
from lagcli.graph.nodes import Node, Symbol, mask_of
from lagcli.graph.substitution import Substitution
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Function, Motion
from lagcli.problem_data import JACOBI_FUNCTION

#: t, q, q'
State = tuple[Any, Sequence[Any], Sequence[Any]]


#: What `energy` stands for where the file has no such name.
ENERGY = Name("energy")


class Reading:
    """Turns expressions of the grammar into nodes of the equations' graph."""

    def __init__(self, equations: EquationsOfMotion) -> None:
        self.equations = equations
        graph = equations.graph
        self.accelerations = tuple(graph.symbol(q.name, 2) for q in equations.q)
        self.multipliers = tuple(graph.symbol(c.multiplier) for c in equations.problem.constraints)
        problem = equations.problem
        declared = {
            *(c.name for c in problem.coordinates),
            *(p.name for p in problem.parameters),
            *problem.definitions,
            *(c.multiplier for c in problem.constraints),
        }
        self._momenta = {f"p_{q.name}": j for j, q in enumerate(equations.q)}
        free = [ENERGY] if ENERGY.name not in declared else []
        self._energies = [graph.symbol(name.name) for name in (*free, JACOBI_FUNCTION)]

    def __call__(self, expression: Expression) -> Node:
        """The node, in t, q, q', q'' and the multipliers."""
        graph, equations = self.equations.graph, self.equations
        node = equations.form.read(expression)
        formulas: dict[Symbol, Node] = {}
        for name, j in self._momenta.items():
            symbol = graph.symbol(name)
            if symbol.mask & node.mask:
                formulas[symbol] = equations.momenta[j]
        for energy in self._energies:
            if energy.mask & node.mask:
                formulas[energy] = equations.energy
        return Substitution(graph, formulas)(node) if formulas else node


class Values:
    """Nodes in q'' and the multipliers too, at a state.

    Parameters
    ----------
    motion
        What solves for them.
    reading
        Its symbols of the accelerations and multipliers.
    nodes
        What is wanted.
    """

    def __init__(self, motion: Motion, reading: Reading, nodes: Sequence[Node]) -> None:
        solved = (*reading.accelerations, *reading.multipliers)
        mask = mask_of(solved)
        self._motion = motion
        #: for each multiplier of the problem, its place among those that are solved for
        self._places = [motion.equations.place.get(k) for k in range(len(reading.multipliers))]
        nodes = list(map(motion.equations.stable, nodes))
        self._plain = [node for node in nodes if not node.mask & mask]
        self._deep = [node for node in nodes if node.mask & mask]
        self._order = _order([bool(node.mask & mask) for node in nodes])
        self._of_state: Function = motion.function(self._plain)
        self._of_all: Function | None = None
        self._single: list[Function] = []
        if self._deep:
            self._of_all = motion.function(self._deep, solved)
            self._single = [motion.function([node], solved) for node in self._deep]

    def __call__(self, t: Any, q: Sequence[Any], v: Sequence[Any]) -> list[Any]:
        """The values in order; None where a multiplier is not determined.

        Raises
        ------
        ArithmeticError, ValueError
            Where one is not defined.
        """
        found = list(self._of_state(t, *q, *v))
        if self._of_all is None:
            return found
        solved = self._solved(t, q, v)
        if None not in solved:
            found += self._of_all(t, *q, *v, *solved)
        else:
            found += [self._one(function, (t, *q, *v, *solved)) for function in self._single]
        return [found[place] for place in self._order]

    def along(self, states: Sequence[State]) -> list[list[Any]]:
        """The same at many states."""
        if self._of_all is not None:
            return [self(*state) for state in states]
        function = self._of_state
        return [list(function(t, *q, *v)) for t, q, v in states]

    def _solved(self, t: Any, q: Sequence[Any], v: Sequence[Any]) -> Sequence[Any]:
        """q'' and every multiplier: 0 where a contact is open."""
        motion = self._motion
        solved = motion.accelerations_and_multipliers(t, *q, *v)
        if len(self._places) == motion.m:
            return solved
        held = solved[motion.n :]
        zero = motion.arithmetic.number(Fraction(0))
        forces = [zero if place is None else held[place] for place in self._places]
        return [*solved[: motion.n], *forces]

    @staticmethod
    def _one(function: Function, arguments: Sequence[Any]) -> Any:
        """A column that may do without the multipliers that are not determined."""
        try:
            return function(*arguments)[0]
        except TypeError:  # arithmetic with None
            return None


class ColumnRows:
    """Nodes in order, each None where it is not defined.

    Parameters
    ----------
    motion, reading, nodes
        As for `Values`.
    """

    def __init__(self, motion: Motion, reading: Reading, nodes: Sequence[Node]) -> None:
        self._values = Values(motion, reading, nodes)
        self._arguments = motion, reading, nodes

    def __call__(self, t: Any, q: Sequence[Any], v: Sequence[Any]) -> list[Any]:
        """The row at a state."""
        return self.along([(t, q, v)])[0]

    def along(self, states: Sequence[State]) -> list[list[Any]]:
        """The rows at many states: together where all is defined, else one by one."""
        try:
            found = self._values.along(states)
            if _are_finite(found):
                return found
        except (ArithmeticError, ValueError):
            pass
        if len(states) > 1:
            return [self(*state) for state in states]
        return [[_one(each, state) for each in self._single] for state in states]

    @cached_property
    def _single(self) -> list[Values]:
        motion, reading, nodes = self._arguments
        return [Values(motion, reading, [node]) for node in nodes]


def _are_finite(rows: Sequence[Sequence[Any]]) -> bool:
    values = [*chain.from_iterable(rows)]
    return all(map(math.isfinite, given(values)))


def given(column: Sequence[Any]) -> Sequence[Any]:
    """The values of a column where it has one."""
    return [x for x in column if x is not None] if None in column else column


def _one(values: Values, state: State) -> Any:
    """A column where it is defined, else None."""
    try:
        [value] = values(*state)
    except (ArithmeticError, ValueError):
        return None
    return value if value is None or math.isfinite(float(value)) else None


def _order(deep: Sequence[bool]) -> list[int]:
    """Where each node stands in: those of the state, then the others."""
    plain = [place for place, is_deep in enumerate(deep) if not is_deep]
    others = [place for place, is_deep in enumerate(deep) if is_deep]
    place_of = {node: place for place, node in enumerate([*plain, *others])}
    return [place_of[node] for node in range(len(deep))]
