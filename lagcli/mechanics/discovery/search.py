"""The unknown functions f as combinations of given ones, and the linear system for them.

The system is sampled modulo a prime at random points, random values of the parameters
among them, until its rank stays.  The reduced echelon form gives a basis of the solutions
in which each has the fewest unknowns; only these few are then solved for exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr

from lagcli.algebra import derivative
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import PRIME, NoPoint, kernel_modulo
from lagcli.mechanics.discovery.slots import Condition, Slot, SlotEquations
from lagcli.mechanics.discovery.tree import Tree
from lagcli.platform.effort import EFFORT

_BAD_POINTS = 50  # points modulo p without a root: half of them for each square root
_OF_NODE = 150  # units of work: SymPy's second derivatives, by the nodes of M and of the forcing


@dataclass(frozen=True, slots=True)
class SlotUnknown:
    """The coefficient of T(t) g(q) in the function f of a slot."""

    slot: int
    time: Expr
    space: Expr

    @property
    def function(self) -> Expr:
        """T g."""
        return self.time * self.space


@dataclass(frozen=True, slots=True)
class SlotSolution:
    """Nonzero coefficients by unknown."""

    terms: tuple[tuple[SlotUnknown, Expr], ...]


class Search:
    """One linear system: slots, unknowns (those that may be left out first), conditions.

    Parameters
    ----------
    equations, slots
        What is searched.
    unknowns
        In the order of elimination: each solution has exactly one unknown that no other
        has, as late in this order as possible.
    allowed
        Raises TooMuchWork.
    """

    def __init__(
        self,
        equations: SlotEquations,
        slots: Sequence[Slot],
        unknowns: Sequence[SlotUnknown],
        allowed: Allowance,
        more: Sequence[Expr] = (),
    ) -> None:
        self.equations = equations
        self.slots = list(slots)
        self.unknowns = list(unknowns)
        self.allowed = allowed
        self._bad = 0
        self.unsolved = 0  # solutions that are there, without exact coefficients
        self._reduced: list[list[int]] = []
        self.conditions: list[list[Condition]] = []
        nodes = sum(1 for e in _formulas(equations) for _ in sympy.preorder_traversal(e))
        for slot in self.slots:
            allowed.spend(_OF_NODE * nodes * len(equations.q))
            self.conditions.append(slot.conditions(equations))
        t = equations.t
        self._time_jets = {
            T: (T, T.diff(t), T.diff(t, 2)) for T in dict.fromkeys(u.time for u in self.unknowns)
        }
        spaces = dict.fromkeys(u.space for u in self.unknowns)
        self._space_jets = {g: _jets(g, equations) for g in spaces}
        expressions = [e for c in self.conditions for condition in c for _, e in condition]
        jets = [e for jet in self._time_jets.values() for e in jet]
        jets += [e for jet in self._space_jets.values() for e in jet]
        jets += self.equations.v
        variables = [self.equations.t, *self.equations.q, *self.equations.v]
        self.tree = Tree([*expressions, *jets, *more], variables, self.allowed)
        self.points = self.tree.points
        self._exact = ExactSolver(self.points)

    # -- modulo a prime -----------------------------------------------------------------

    def rows(self, point: Sequence[int]) -> list[list[int]]:
        """One row for each condition at a point; columns are the unknowns."""
        at = self.tree.at(point)
        tables = [
            [[(jet, at(e)) for jet, e in condition if e != 0] for condition in conditions]
            for conditions in self.conditions
        ]
        times = {T: [at(e) for e in jet] for T, jet in self._time_jets.items()}
        spaces = {g: [at(e) for e in jet] for g, jet in self._space_jets.items()}
        columns = []
        entries = [sum(len(condition) for condition in table) for table in tables]
        EFFORT.done += sum(entries[unknown.slot] for unknown in self.unknowns)
        for unknown in self.unknowns:
            T, Tt, Ttt = times[unknown.time]
            space = spaces[unknown.space]
            g, Dg, DDg = space[0], space[-2], space[-1]
            jets = [T * x % PRIME for x in space[:-2]]
            jets += [(Tt * g + T * Dg) % PRIME, (Ttt * g + 2 * Tt * Dg + T * DDg) % PRIME]
            columns.append([sum(jets[j] * x for j, x in c) % PRIME for c in tables[unknown.slot]])
        return [list(row) for row in zip(*columns, strict=True) if any(row)]

    def _batch(self, wanted: int) -> list[list[int]]:
        """Rows from new points, about as many as wanted (fewer where most are 0)."""
        batch: list[list[int]] = []
        for _ in range(wanted + 8):
            self.allowed.check()
            try:
                batch += self.rows(self.points.point())
            except NoPoint:
                self._bad += 1
                if self._bad > _BAD_POINTS:
                    raise
            if len(batch) >= wanted:
                break
        return batch

    def kernel(self) -> list[dict[int, int]]:
        """A basis of the solutions modulo p, sparse, which more points do not break."""
        width = len(self.unknowns)
        rows = self._batch(width + 10)
        while True:
            self.allowed.check()
            self._reduced, vectors = kernel_modulo(rows, width)
            fresh = self._batch(12)
            broken = [
                row for row in fresh
                if any(sum(row[i] * x for i, x in y.items()) % PRIME for y in vectors)
            ]  # fmt: skip
            if not broken:
                return vectors
            rows = [*self._reduced, *broken, *self._batch(width // 2)]

    # -- exactly -------------------------------------------------------------------------

    def solutions(self, vectors: Sequence[dict[int, int]] | None = None) -> list[SlotSolution]:
        """The solutions with exact coefficients, simplest last as the unknowns are."""
        found = []
        for vector in self.kernel() if vectors is None else vectors:
            self.allowed.check()
            known = self._exact.of(vector, self.formulas)
            if known is None:
                self.unsolved += 1
                continue
            terms = ((self.unknowns[i], value) for i, value in known.items() if value != 0)
            found.append(SlotSolution(tuple(terms)))
        return found

    def formulas(self, index: int) -> list[Expr]:
        """The conditions for one unknown as formulas."""
        unknown = self.unknowns[index]
        jets = _jets(unknown.function, self.equations)
        return [
            sympy.Add(*(jets[j] * e for j, e in condition))
            for condition in self.conditions[unknown.slot]
        ]

    def combination(self, solution: SlotSolution) -> list[tuple[Slot, Expr]]:
        """The functions f of a solution, by slot."""
        functions: dict[int, list[Expr]] = {}
        for unknown, value in solution.terms:
            functions.setdefault(unknown.slot, []).append(value * unknown.function)
        return [(self.slots[s], sympy.Add(*parts)) for s, parts in sorted(functions.items())]


def _formulas(equations: SlotEquations) -> list[Expr]:
    return [*(m for row in equations.mass for m in row), *equations.forcing]


def _jets(g: Expr, equations: SlotEquations) -> list[Expr]:
    """g, its gradient, Dg and D^2 g."""
    rate = equations.convected(g)
    return [g, *(derivative(g, x) for x in equations.q), rate, equations.convected(rate)]
