"""The equations of motion as nodes: what is integrated, held and shown.

Made of the matrix form, which needs no algebra; what it cannot say without the algebra is
a refusal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from functools import cached_property
from itertools import chain

from lagcli.graph.bounded import bounded
from lagcli.graph.corners import with_corners
from lagcli.graph.derivative import partial
from lagcli.graph.expansion import TooLong
from lagcli.graph.nodes import Call, Graph, Node, Symbol, ancestry, mask_of
from lagcli.graph.rewriting import rewritten
from lagcli.graph.stable import Stable, stable_dynamics
from lagcli.mechanics.matrix_form import MatrixForm, NotStructural
from lagcli.mechanics.rates import ConstraintRow
from lagcli.numerics.equations.elimination import Eliminated, Factored
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import Generated
from lagcli.problem_data import Constraint, Problem
from lagcli.record import replace

#: What is worked out of the constraints.
_OF_ROWS = (
    "generated", "positions", "rates", "sizes", "eliminated", "eliminated_positions",
    "evident_charges",
)  # fmt: skip


class EquationsOfMotion:
    """M, forcing, A and what is eliminated from them.

    Parameters
    ----------
    problem
        With its one-sided contacts among the constraints: see `contact`.
    whole, held
        Other equations of the same problem, and which constraints act; all, without them.

    Attributes
    ----------
    constraints : tuple of ConstraintRow
        Those that act.
    declared : tuple of Constraint
        The same as the file has them.
    t, q, qdot : Symbol and tuples of Symbol
        In the order of the file; also the arguments of every function made of them.
    holonomic : tuple of int
        The constraints that have a position f(q, t).

    Raises
    ------
    Refusal
        Where the problem needs the algebra, or is not defined anywhere.
    """

    def __init__(
        self,
        problem: Problem,
        whole: EquationsOfMotion | None = None,
        held: frozenset[int] | None = None,
    ) -> None:
        self.problem = problem
        self.whole = whole or self
        try:
            form = MatrixForm(problem, combine_angles=False) if whole is None else whole.form
            self.form: MatrixForm = form
            self.mass: tuple[tuple[Node, ...], ...]
            self.forcing: tuple[Node, ...]
            self.mass, self.forcing = (
                _stable(form) if whole is None else (whole.mass, whole.forcing)
            )
            every = [_bounded(form.graph, row) for row in form.constraints]
        except NotStructural as reason:
            raise Refusal(f"no numbers for this problem: {reason}") from None
        except ArithmeticError as error:
            raise Refusal(f"the equations are not defined: {error}") from None
        acting = [k for k in range(len(every)) if held is None or k in held]
        self.graph = form.graph
        self.t, self.q, self.qdot = form.t, form.q, form.qdot
        self.state: tuple[Symbol, ...] = (self.t, *self.q, *self.qdot)
        self.hold({k: every[k] for k in acting}, problem.constraints)

    def hold(self, acting: Mapping[int, ConstraintRow], declared: Sequence[Constraint]) -> None:
        """Let these of the declared constraints act, each by its place among them."""
        #: for each constraint of the file, its place among those that act
        self.place = {k: i for i, k in enumerate(acting)}
        self.constraints = tuple(acting.values())
        self.declared = tuple(declared[k] for k in acting)
        self.rows = tuple(row.row for row in self.constraints)
        self.bias = tuple(row.bias for row in self.constraints)
        self.holonomic = tuple(
            k for k, row in enumerate(self.constraints) if row.position is not None
        )

    def holding(self, held: frozenset[int]) -> EquationsOfMotion:
        """The equations while only these constraints act."""
        return EquationsOfMotion(self.problem, self.whole, held)

    def without_implied(self, independent: Sequence[int]) -> EquationsOfMotion:
        """The equations with these rows, which imply all others."""
        fewer = self._without_rows()
        fewer.hold({k: self.constraints[k] for k in independent}, self.declared)
        return fewer

    def _without_rows(self) -> EquationsOfMotion:
        """A copy for which nothing is worked out of the constraints yet."""
        other = copy(self)
        for name in _OF_ROWS:
            other.__dict__.pop(name, None)
        return other

    def sticking(self, k: int) -> EquationsOfMotion:
        """The equations while a switching function s(t, q, q') stays at 0, as a constraint."""
        graph, s = self.graph, self.kinks[k]
        row = tuple(partial(graph, v)(s) for v in self.qdot)
        speed = graph.sum([graph.product(a, v) for a, v in zip(row, self.qdot, strict=True)])
        rest, bias = graph.difference(s, speed), self.form.drift_of(s)
        held = self._without_rows()
        held.constraints += (ConstraintRow(s, False, row, rest, bias),)
        held.rows, held.bias = (*self.rows, row), (*self.bias, bias)
        return held

    def friction(self, k: int) -> Node | None:
        """c of a force -c sign(s) ds/dq'; None where what jumps with s is not of this form."""
        graph, s = self.graph, self.kinks[k]
        jumps, sign = graph.call("sign", (s,)), graph.symbol("sign of s")  # no file can name it
        forces = rewritten(graph, self.forcing, lambda _, node: sign if node is jumps else node)
        found = [graph.scaled(partial(graph, sign)(force), -1) for force in forces]
        slopes = [partial(graph, v)(s) for v in self.qdot]
        j = next((j for j, slope in enumerate(slopes) if slope is not graph.zero), None)
        if j is None or mask_of(found) & sign.mask:
            return None
        limit = graph.quotient(found[j], slopes[j])
        return limit if [graph.product(limit, slope) for slope in slopes] == found else None

    def kink_name(self, k: int) -> str:
        """The velocities on which a force that jumps depends."""
        return ", ".join(f"{v.name}'" for v in self.qdot if v.mask & self.kinks[k].mask)

    @cached_property
    def generated(self) -> Generated:
        """The functions made of them, which numbers of all kinds share."""
        return {}

    @cached_property
    def stable(self) -> Stable:
        """Writes columns so that they keep their digits."""
        return Stable(self.graph)

    @property
    def dynamics(self) -> list[Node]:
        """M, forcing, A and the bias c, row by row: what the accelerations follow from."""
        return [*chain(*self.mass), *self.forcing, *chain(*self.rows), *self.bias]

    @cached_property
    def depends_on_time(self) -> bool:
        """Whether the time is in the equations."""
        return bool(mask_of(self.dynamics) & self.t.mask)

    @property
    def parameter_values(self) -> dict[Symbol, Node]:
        """The values of the parameters that have one, as formulas."""
        return {
            self.graph.symbol(p.name): self.form.read(p.value)
            for p in self.problem.parameters
            if p.value is not None
        }

    @cached_property
    def positions(self) -> list[Node]:
        """f(q, t) of the holonomic constraints."""
        return [row.position for row in self.constraints if row.position is not None]

    @cached_property
    def rates(self) -> list[Node]:
        """A q' + b of all constraints."""
        graph = self.graph
        return [
            graph.sum(
                [row.drift, *(graph.product(a, v) for a, v in zip(row.row, self.qdot, strict=True))]
            )
            for row in self.constraints
        ]

    @cached_property
    def sizes(self) -> list[Node]:
        """Sum over j of |a_kj q_j| and of |a_kj q_j'|, what residuals are compared with."""
        graph = self.graph
        return [
            graph.sum(
                graph.call("abs", (graph.product(a, x),))
                for a, x in zip(row, variables, strict=True)
            )
            for variables, rows in (
                (self.q, [self.rows[k] for k in self.holonomic]),
                (self.qdot, self.rows),
            )
            for row in rows
        ]

    @cached_property
    def kinks(self) -> list[Node]:
        """What stands in abs and sign: where it passes 0 the equations are not smooth.

        The same list, whichever constraints act.
        """
        if self.whole is not self:
            return self.whole.kinks
        mask = mask_of(self.state)
        found: dict[Node, None] = {}
        for node in ancestry(self.dynamics):
            if isinstance(node, Call) and node.function in {"abs", "sign"} and node.mask & mask:
                found[node.arguments[0]] = None
        return list(found)

    # -- elimination -------------------------------------------------------------------------

    @cached_property
    def eliminated(self) -> Eliminated | None:
        """With all constraints; None where it is left to numbers."""
        return self._eliminated(self.rows)

    @cached_property
    def eliminated_positions(self) -> Eliminated | None:
        """With the holonomic constraints."""
        if len(self.holonomic) == len(self.rows):
            return self.eliminated
        return self._eliminated([self.rows[k] for k in self.holonomic])

    def _eliminated(self, rows: object) -> Eliminated | None:
        if self.factored is None:
            return None
        try:
            return Eliminated(self.graph, self.factored, rows)  # type: ignore[arg-type]
        except (ZeroDivisionError, TooLong):
            return None

    @cached_property
    def factored(self) -> Factored | None:
        """The mass matrix as L D L^T; None where a pivot is 0 whatever the state.

        None, too, where a loop does it: a full one writes some n^3/6 products out.
        """
        try:
            return Factored(self.graph, self.mass)
        except (ZeroDivisionError, TooLong):
            return None

    # -- what is conserved -----------------------------------------------------------------------

    @property
    def lagrangian(self) -> Node:
        """L in q, q' and t."""
        return self.form.written_lagrangian

    @cached_property
    def momenta(self) -> list[Node]:
        """p = dL/dq'."""
        return [partial(self.graph, v)(self.lagrangian) for v in self.qdot]

    @cached_property
    def energy(self) -> Node:
        """h = q' p - L, the Jacobi function."""
        graph = self.graph
        work = [graph.product(v, p) for v, p in zip(self.qdot, self.momenta, strict=True)]
        return graph.sum([*work, graph.scaled(self.lagrangian, -1)])

    @cached_property
    def evident_charges(self) -> dict[str, Node]:
        """The energy and the momenta of ignorable coordinates, where they are conserved.

        Only what is seen in the structure: L, the forces and the constraints do not name t,
        or q_j.
        """
        graph = self.graph
        zero = graph.zero
        found: dict[str, Node] = {}
        forces = self.form.applied_forces
        steady = not self.lagrangian.mask & self.t.mask and all(f is zero for f in forces)
        if steady and all(row.drift is zero for row in self.constraints):
            found["energy"] = self.energy
        for j, q in enumerate(self.q):
            ignorable = not self.lagrangian.mask & q.mask and forces[j] is zero
            if ignorable and all(row[j] is zero for row in self.rows):
                found[f"p_{q.name}"] = self.momenta[j]
        return found


def _bounded(graph: Graph, row: ConstraintRow) -> ConstraintRow:
    """The same constraint without quotients of functions that are no doubles."""
    f, drift, bias, *entries = bounded(graph, [row.f, row.drift, row.bias, *row.row])
    return replace(row, f=f, drift=drift, bias=bias, row=tuple(entries))


def _stable(form: MatrixForm) -> tuple[tuple[tuple[Node, ...], ...], tuple[Node, ...]]:
    """M and the forcing, so written that they keep their digits."""
    mass, forcing = form.mass_matrix, form.forcing
    n = len(forcing)
    entries = [*(entry for row in mass for entry in row), *forcing]
    nodes = stable_dynamics(form.graph, with_corners(form.graph, entries))
    rows = tuple(tuple(nodes[i * n : (i + 1) * n]) for i in range(n))
    return rows, tuple(nodes[n * n :])
