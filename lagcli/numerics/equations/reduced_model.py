"""The model reduced to the request: fewer coordinates, fewer constraints, the same motion.

A holonomic constraint that is linear in a coordinate, with a factor that does not vary, is
solved for it: c = g(u, t).  With the others u and J = dc/du, b = d^2 c/dt^2 at u'' = 0,

    M u'' = F + A^T lambda   becomes   (K^T M K) u'' = K^T (F - M (0, b)) + (A K)^T lambda,
    K = (1, J)^T,

and its multiplier does no work along K, so it is gone.  Coordinates on whose motion no
column depends are left out together with their equations.  Nothing is cut that the result
needs, a multiplier for example, nor where it would take more operations than it saves.
Ignorable coordinates stay: to reduce by them (Routh) gains nothing in numbers, since their
velocities are needed to know the motion of the others.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 1.3 (holonomic constraints).
Lanczos, *The Variational Principles of Mechanics*, 4th ed., section I.6 (kinetic variables).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import compress
from typing import Any

from lagcli.graph.bounded import bounded
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol, ancestry, mask_of
from lagcli.graph.substitution import Substitution
from lagcli.mechanics.rates import ConstraintRow
from lagcli.numerics.equations.coupling import coupling, needed
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.record import record

#: More coordinates than these are held by their constraints as they are: eliminated, they
#: would couple all with all.
MOST = 24


@record
class Solved:
    """A coordinate that a constraint gives."""

    constraint: int
    coordinate: int
    formula: Node  # in the coordinates that are left, and t


class Reduction:
    """The constraints that are solved for a coordinate.

    Parameters
    ----------
    equations
        All of them.
    constants
        The values of the parameters.
    wanted
        Places of coordinates that are better kept: the file gives their initial state.
    most
        How many at most; all, without it.
    """

    def __init__(
        self,
        equations: EquationsOfMotion,
        constants: Mapping[Symbol, Any],
        wanted: frozenset[int],
        most: int | None = None,
    ) -> None:
        self.equations, self.constants = equations, constants
        self.graph = equations.graph
        self._varying = mask_of(equations.state)
        self.solved: list[Solved] = []
        for k in equations.holonomic[:most]:
            self._solve(k, wanted)
        gone = {each.coordinate for each in self.solved}
        self.kept = [j for j in range(len(equations.q)) if j not in gone]

    def _solve(self, k: int, wanted: frozenset[int]) -> None:
        """Solve one constraint, after those before it."""
        graph, e = self.graph, self.equations
        position = e.constraints[k].position
        assert position is not None
        f = Substitution(graph, self._positions)(position)
        gone = {each.coordinate for each in self.solved}
        candidates = []
        for j, symbol in enumerate(e.q):
            if j in gone or not f.mask & symbol.mask:
                continue
            factor = partial(graph, symbol)(f)
            if factor.mask & self._varying or not self._value(factor):
                continue
            plain = abs(self._value(factor)) != 1.0
            candidates.append(((j in wanted, plain, -j), j, factor))
        if not candidates:
            return
        _, j, factor = min(candidates, key=lambda each: each[0])
        symbol = e.q[j]
        rest = Substitution(graph, {symbol: graph.zero})(f)
        formula = graph.scaled(graph.quotient(rest, factor), -1)
        put = Substitution(graph, {symbol: formula})
        self.solved = [
            Solved(each.constraint, each.coordinate, put(each.formula)) for each in self.solved
        ]
        self.solved.append(Solved(k, j, formula))

    def _value(self, factor: Node) -> float:
        """A factor of parameters in numbers; 0 where it has none."""
        from lagcli.numerics.equations.arithmetic import Doubles, UndefinedFunction
        from lagcli.numerics.equations.straight_line import straight_line

        try:
            known = {s: float(x) for s, x in self.constants.items()}
            return float(straight_line((), [factor], known, Doubles())()[0])
        except (ArithmeticError, ValueError, KeyError, UndefinedFunction):
            return 0.0

    # -- formulas ----------------------------------------------------------------------------

    @property
    def _positions(self) -> dict[Symbol, Node]:
        return {self.equations.q[each.coordinate]: each.formula for each in self.solved}

    @cached_property
    def put(self) -> Substitution:
        """Coordinates, velocities and accelerations by those that are left."""
        e = self.equations
        formulas = self._positions
        for each in self.solved:
            [velocity] = bounded(self.graph, [self._velocity(each)])
            formulas[e.qdot[each.coordinate]] = velocity
            second = self.graph.symbol(e.q[each.coordinate].name, 2)
            formulas[second] = self.graph.sum(
                [
                    self._bias(each),
                    *(
                        self.graph.product(slope, self.graph.symbol(e.q[i].name, 2))
                        for i, slope in zip(self.kept, self._slopes(each), strict=True)
                    ),
                ]
            )
        return Substitution(self.graph, formulas)

    def _slopes(self, each: Solved) -> list[Node]:
        """J: dc/du."""
        slopes = [partial(self.graph, self.equations.q[i]) for i in self.kept]
        return bounded(self.graph, [slope(each.formula) for slope in slopes])

    def _velocity(self, each: Solved) -> Node:
        """c' = J u' + dc/dt."""
        return self.equations.form.drift_of(each.formula)

    def _bias(self, each: Solved) -> Node:
        """c'' at u'' = 0."""
        [bias] = bounded(self.graph, [self.equations.form.drift_of(self._velocity(each))])
        return bias

    # -- the equations of motion -------------------------------------------------------------

    def matrices(self) -> tuple[list[list[Node]], list[Node]]:
        """K^T M K and K^T (F - M (0, b))."""
        graph, e, put, kept = self.graph, self.equations, self.put, self.kept
        mass = [[put(entry) for entry in row] for row in e.mass]
        places = [each.coordinate for each in self.solved]
        slopes = [self._slopes(each) for each in self.solved]
        biases = [self._bias(each) for each in self.solved]
        # (M K), one column for each u
        columns = [
            [
                graph.sum(
                    [
                        row[i],
                        *(graph.product(row[c], s[a]) for c, s in zip(places, slopes, strict=True)),
                    ]
                )
                for row in mass
            ]
            for a, i in enumerate(kept)
        ]
        force = [
            graph.sum(
                [
                    put(f),
                    *(
                        graph.scaled(graph.product(row[c], b), -1)
                        for c, b in zip(places, biases, strict=True)
                    ),
                ]
            )
            for f, row in zip(e.forcing, mass, strict=True)
        ]

        def along(values: Sequence[Node], a: int) -> Node:
            return graph.sum(
                [
                    values[kept[a]],
                    *(graph.product(s[a], values[c]) for c, s in zip(places, slopes, strict=True)),
                ]
            )

        reduced = [[along(column, a) for column in columns] for a in range(len(kept))]
        return reduced, [along(force, a) for a in range(len(kept))]

    def rows(self) -> dict[int, ConstraintRow]:
        """The constraints that are left, by their places."""
        graph, put = self.graph, self.put
        done = {each.constraint for each in self.solved}
        found = {}
        for k, row in enumerate(self.equations.constraints):
            if k in done:
                continue
            entries = [put(entry) for entry in row.row]
            slopes = [(entries[each.coordinate], each) for each in self.solved]
            bias = [put(row.bias), *(graph.product(a, self._bias(each)) for a, each in slopes)]
            drift = [
                put(row.drift),
                *(
                    graph.product(a, partial(graph, self.equations.t)(each.formula))
                    for a, each in slopes
                ),
            ]
            reduced = tuple(
                graph.sum(
                    [entries[i], *(graph.product(a, self._slopes(each)[n]) for a, each in slopes)]
                )
                for n, i in enumerate(self.kept)
            )
            found[k] = ConstraintRow(
                put(row.f), row.holonomic, reduced, graph.sum(drift), graph.sum(bias)
            )
        return found

    def needed(
        self,
        mass: Sequence[Sequence[Node]],
        forcing: Sequence[Node],
        rows: Mapping[int, ConstraintRow],
        request: Sequence[Node],
    ) -> list[bool]:
        """Which of the coordinates left have a part in the request."""
        q = [self.equations.q[j] for j in self.kept]
        return needed(*coupling(self.graph, q, mass, forcing, rows.values()), request)


class CutEquations(EquationsOfMotion):
    """The equations of some of the coordinates.

    Parameters
    ----------
    reduction
        What was solved.
    needed
        For each coordinate that is left, whether its motion is wanted.
    """

    def __init__(
        self,
        reduction: Reduction,
        mass: Sequence[Sequence[Node]],
        forcing: Sequence[Node],
        rows: Mapping[int, ConstraintRow],
        needed: Sequence[bool],
    ) -> None:
        e = reduction.equations
        self.problem, self.whole, self.form, self.graph = e.problem, self, e.form, e.graph
        self.coordinates = list(compress(reduction.kept, needed))
        self.t = e.t
        self.q = tuple(e.q[j] for j in self.coordinates)
        self.qdot = tuple(e.qdot[j] for j in self.coordinates)
        self.state = (self.t, *self.q, *self.qdot)
        self.mass = tuple(tuple(compress(row, needed)) for row in compress(mass, needed))
        self.forcing = tuple(compress(forcing, needed))
        held = {
            k: ConstraintRow(r.f, r.holonomic, tuple(compress(r.row, needed)), r.drift, r.bias)
            for k, r in rows.items()
            if any(entry is not e.graph.zero for entry in compress(r.row, needed))
        }
        self.hold(held, e.declared)

    def holding(self, held: frozenset[int]) -> EquationsOfMotion:
        """The same: what is cut has no contacts."""
        del held
        return self


def cut(
    equations: EquationsOfMotion,
    constants: Mapping[Symbol, Any],
    request: Sequence[Node],
    given: frozenset[int],
) -> tuple[CutEquations, Reduction] | None:
    """The equations that the requested nodes need, or None where nothing can be spared.

    Parameters
    ----------
    equations
        With every constraint acting all the time.
    constants
        The values of the parameters.
    request
        In t, q, q' and q'', without multipliers of constraints that may go.
    given
        The coordinates whose initial state the file gives.
    """
    if len(equations.q) > MOST:
        return None
    reduction = Reduction(equations, constants, given)
    mass, forcing = reduction.matrices()
    rows = reduction.rows()
    wanted = reduction.needed(mass, forcing, rows, [reduction.put(node) for node in request])
    if not reduction.solved and all(wanted):
        return None
    reduced = CutEquations(reduction, mass, forcing, rows, wanted)
    if not reduced.q or operations(reduced) > operations(equations):
        return None
    return reduced, reduction


def operations(equations: EquationsOfMotion) -> int:
    """Of one evaluation of the accelerations; many, where they are left to loops."""
    eliminated = equations.eliminated
    if eliminated is None:
        return 10**9
    roots, _ = eliminated.motion(equations.forcing, equations.bias)
    return sum(len(node.parts) for node in ancestry(roots))
