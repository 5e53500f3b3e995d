"""The matrix form from the structure of the problem: no Lagrangian is ever expanded.

The Lagrangian is taken as L(w, q, q', t) in which the rates w_a = r_a' of points and
definitions r_a(q, t) stand as quantities of their own.  With the Jacobians
J_ai = dr_a/dq_i and r_a'' = sum_i J_ai q_i'' + c_a the Euler-Lagrange expression is

    d/dt(dL/dq_i') - dL/dq_i
        = sum_a J_ai d/dt(L_w_a) + d/dt(L_q_i') - L_q_i       (w held in the last term)

because dw_a/dq_i' = J_ai and d/dt(J_ai) = dw_a/dq_i.  So

    M_ij = sum_ab J_ai L_ab J_bj
    forcing_i = Q_i - dD/dq_i' + L_q_i - sum_a J_ai (d(L_a)/dt with w, q' held + sum_b L_ab c_b)

where a, b run over the rates and the velocities q' themselves (J = 1, c = 0).

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 1.4 (the two identities).
Kane, Levinson, *Dynamics: Theory and Applications*, sections 2.14 and 6.1 (partial velocities).
"""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property

from lagcli.expression import Expression
from lagcli.graph.angles import AnglePairs, Pair
from lagcli.graph.derivative import Differentiation, partial
from lagcli.graph.nodes import Graph, Node, mask_of, split
from lagcli.graph.reading import GraphReader
from lagcli.graph.substitution import Substitution
from lagcli.graph.values import Concrete
from lagcli.mechanics.float_states import FloatStates
from lagcli.mechanics.gathering import gathered
from lagcli.mechanics.rates import ConstraintRow, VelocityRate
from lagcli.problem_data import Constraint, Problem

#: (u, v) -> the terms of the sum that stands before u * v
Weights = dict[tuple[Node, Node], list[tuple[Node, Fraction]]]


class NotStructural(Exception):
    """The problem needs the algebra: what is wrong with it, or what it means, is stated there."""


class MatrixForm:
    """M q'' = forcing + A^T lambda with A q'' + bias = 0, as nodes of one graph.

    Parameters
    ----------
    problem
        A checked problem.
    combine_angles
        Write products of cosines and sines as cos(a - b), as a textbook does; without it
        every entry is made of the Jacobians alone, which is cheaper in numbers.

    Raises
    ------
    NotStructural
        From any part, where the problem needs the algebra.
    """

    def __init__(self, problem: Problem, *, combine_angles: bool = True) -> None:
        self.problem = problem
        self.combine_angles = combine_angles
        self.graph = graph = Graph()
        for parameter in problem.parameters:
            graph.symbol(parameter.name)
        names = tuple(coordinate.name for coordinate in problem.coordinates)
        self.t = graph.symbol("t")
        self.q = tuple(graph.symbol(name) for name in names)
        self.qdot = tuple(graph.symbol(name, 1) for name in names)
        self.qddot = tuple(graph.symbol(name, 2) for name in names)
        self.acceleration_mask = mask_of(self.qddot)
        self._velocity_mask = mask_of(self.qdot)
        self.read = GraphReader(graph, names, problem.definitions)
        self._weights: dict[tuple[tuple[Node, Fraction], ...], Node] = {}
        self._by_coordinate = tuple(partial(graph, q) for q in self.q)
        #: d/dt with q' held: what is left of a rate where q'' = 0
        self.drift_of = Differentiation(
            graph, {self.t: graph.one, **dict(zip(self.q, self.qdot, strict=True))}
        )

    # -- the Lagrangian with its rates ------------------------------------------------------

    @cached_property
    def lagrangian(self) -> Node:
        """L = T - V with the rates of definitions and points as symbols."""
        if self.problem.lagrangian is not None:
            return self._with_rates(self.problem.lagrangian)
        assert self.kinetic is not None
        assert self.potential is not None
        return self.graph.difference(self.kinetic, self.potential)

    @cached_property
    def kinetic(self) -> Node | None:
        """T with rates as symbols; None when only L is given."""
        if self.problem.lagrangian is not None:
            return None
        if self.problem.kinetic is not None:
            return self._with_rates(self.problem.kinetic)
        return self._kinetic_of_points

    @cached_property
    def potential(self) -> Node | None:
        """V with rates as symbols; None when only L is given."""
        if self.problem.lagrangian is not None:
            return None
        formula = self.problem.potential
        return self.graph.zero if formula is None else self._with_rates(formula)

    @cached_property
    def written_lagrangian(self) -> Node:
        """L in coordinates and velocities."""
        return self.expand_rates(self.lagrangian)

    @cached_property
    def collected_lagrangian(self) -> tuple[Node, ...]:
        """q'ᵀ M q'/2 and −V, where T is a quadratic form; L as the file types it elsewhere."""
        graph, M = self.graph, self.mass_matrix
        if self.kinetic is None or self.potential is None:
            return (self.written_lagrangian,)
        rest = Substitution(graph, dict.fromkeys(self.qdot, graph.zero))
        still = (rest(self.expand_rates(self.kinetic)), *map(rest, self.momenta))
        fast = self.expand_rates(self.potential).mask | mask_of([x for row in M for x in row])
        if any(x is not graph.zero for x in still) or any(v.mask & fast for v in self.qdot):
            return (self.written_lagrangian,)
        terms = [
            (graph.product(M[i][j], v, w), Fraction(1, 1 + (i == j)))
            for i, v in enumerate(self.qdot)
            for j, w in enumerate(self.qdot[: i + 1])
        ]
        potential = graph.scaled(self.expand_rates(self.potential), -1)
        return (graph.combination(terms), *([potential] if potential is not graph.zero else []))

    @cached_property
    def momenta(self) -> tuple[Node, ...]:
        """p_i = L_q_i' + sum_a J_ai L_w_a."""
        along: list[list[tuple[Node, Node]]] = [[] for _ in self.q]
        for rate, (slope, _) in zip(self.rates, self._slopes, strict=True):
            for i, u in rate.jacobian.items():
                along[i].append((u, self.expand_rates(slope)))
        return tuple(map(self._along, along))

    def _with_rates(self, formula: Expression) -> Node:
        return self.read(formula, rates_as_symbols=True)

    @property
    def _kinetic_of_points(self) -> Node:
        """The sum of m w^2 / 2."""
        terms = []
        for point in self.problem.points:
            if point.mass is None:
                continue
            mass = self._with_rates(point.mass)
            for axis, component in enumerate(point.position):
                # no name of a file has brackets
                rate = self.read.rate_symbol(f"{point.name}[{axis}]", self.read(component))
                square = self.graph.monomial([(rate, Fraction(2))])
                terms.append((self.graph.product(mass, square), Fraction(1, 2)))
        return self.graph.combination(terms)

    @cached_property
    def _dissipation(self) -> Node:
        formula = self.problem.dissipation
        return self.graph.zero if formula is None else self._with_rates(formula)

    @cached_property
    def rates(self) -> tuple[VelocityRate, ...]:
        """The velocities that L and D are made of."""
        one, zero = self.graph.one, self.graph.zero
        present = self.lagrangian.mask | self._dissipation.mask
        rates = [
            VelocityRate(v, {i: one}, zero) for i, v in enumerate(self.qdot) if v.mask & present
        ]
        for symbol, position in self.read.rates.items():
            if symbol.mask & present:
                jacobian = self._gradient(position)
                bias = self.drift_of(self.drift_of(position))
                rates.append(VelocityRate(symbol, jacobian, bias))
        return tuple(rates)

    def _gradient(self, node: Node) -> dict[int, Node]:
        return {i: self._by_coordinate[i](node) for i, q in enumerate(self.q) if q.mask & node.mask}

    @cached_property
    def expand_rates(self) -> Substitution:
        """w_a -> r_a' written in q and q'."""
        # what makes the rates known must have been read
        formulas = self.lagrangian, self._dissipation
        assert all(formulas)
        flow = self.drift_of
        return Substitution(self.graph, {w: flow(r) for w, r in self.read.rates.items()})

    @cached_property
    def _slopes(self) -> tuple[tuple[Node, dict[int, Node]], ...]:
        """For each rate a: L_a, and L_ab by b."""
        by = [partial(self.graph, rate.symbol) for rate in self.rates]
        rows = []
        for derivative in by:
            slope = derivative(self.lagrangian)
            within = [b for b, rate in enumerate(self.rates) if rate.symbol.mask & slope.mask]
            second = {b: by[b](slope) for b in within}
            rows.append((slope, second))
        return tuple(rows)

    # -- M and forcing ------------------------------------------------------------------------

    @cached_property
    def mass_matrix(self) -> tuple[tuple[Node, ...], ...]:
        """M_ij = sum_ab J_ai L_ab J_bj, shape (n, n), symmetric."""
        n = len(self.q)
        weights: dict[tuple[int, int], Weights] = {}
        for a, (_, seconds) in enumerate(self._slopes):
            for b, second in seconds.items():
                right = [(j, *split(v)) for j, v in self.rates[b].jacobian.items()]
                for i, u in self.rates[a].jacobian.items():
                    number, left = split(u)
                    for j, other, v in right:
                        if i <= j:
                            key = (left, v) if left.index <= v.index else (v, left)
                            entry = weights.setdefault((i, j), {})
                            factor = other if number == 1 else number * other
                            entry.setdefault(key, []).append((second, factor))
        upper = {place: self._entry(entry) for place, entry in weights.items()}
        zero = self.graph.zero
        return tuple(
            tuple(upper.get((min(i, j), max(i, j)), zero) for j in range(n)) for i in range(n)
        )

    def _entry(self, weights: Weights) -> Node:
        """Sum of weight * u * v, the pairs of equal weight together."""
        graph = self.graph
        groups: dict[Node, list[Pair]] = {}
        for (u, v), terms in weights.items():
            number, weight = split(self._weight(tuple(terms)))
            if weight is not graph.zero:
                groups.setdefault(weight, []).append(Pair(number, u, v))
        return graph.sum(
            graph.product(weight, self._pairs(pairs)) for weight, pairs in groups.items()
        )

    def _weight(self, terms: tuple[tuple[Node, Fraction], ...]) -> Node:
        """The sum of L_ab; the links beyond a joint give the same for many entries."""
        known = self._weights.get(terms)
        if known is None:
            known = self._weights[terms] = self.expand_rates(self.graph.combination(terms))
        return known

    @cached_property
    def _angle_pairs(self) -> AnglePairs:
        return AnglePairs(self.graph)

    def _pairs(self, pairs: list[Pair]) -> Node:
        if self.combine_angles:
            return self._angle_pairs(pairs)
        graph = self.graph
        return graph.combination((graph.product(p.left, p.right), p.coefficient) for p in pairs)

    @cached_property
    def forcing(self) -> tuple[Node, ...]:
        """Applied forces, potential and velocity terms: what stands beside M q'', shape (n,)."""
        return tuple(
            self.graph.sum([applied, inertia])
            for applied, inertia in zip(self.applied_forces, self.inertial, strict=True)
        )

    @cached_property
    def inertial(self) -> tuple[Node, ...]:
        """L_q_i - sum_a J_ai (d(L_a)/dt with w, q' held + sum_b L_ab c_b)."""
        graph = self.graph
        along: list[list[tuple[Node, Node]]] = [[] for _ in self.q]
        for rate, (slope, seconds) in zip(self.rates, self._slopes, strict=True):
            change = graph.sum(
                [
                    self.drift_of(slope),
                    *(graph.product(second, self.rates[b].bias) for b, second in seconds.items()),
                ]
            )
            if change is not graph.zero:
                for i, u in rate.jacobian.items():
                    along[i].append((u, graph.scaled(self.expand_rates(change), -1)))
        gradient = self._gradient(self.lagrangian)
        return tuple(
            graph.sum(
                [
                    self.expand_rates(gathered(graph, gradient.get(i, graph.zero), self.varying)),
                    self._along(terms),
                ]
            )
            for i, terms in enumerate(along)
        )

    @property
    def varying(self) -> int:
        """The mask of everything that is no parameter."""
        return mask_of((self.t, *self.q, *self.qdot, *self.read.rates))

    def _along(self, terms: list[tuple[Node, Node]]) -> Node:
        """Sum of u * f, the f of equal u together."""
        graph = self.graph
        groups: dict[Node, list[tuple[Node, Fraction]]] = {}
        for u, f in terms:
            number, direction = split(u)
            groups.setdefault(direction, []).append((f, number))
        return graph.sum(
            graph.product(direction, graph.combination(forces))
            for direction, forces in groups.items()
        )

    @cached_property
    def applied_forces(self) -> tuple[Node, ...]:
        """Q_i - dD/dq_i': given forces, sum F . dr/dq_i over the points, friction."""
        graph, n = self.graph, len(self.q)
        given = self.problem.forces
        along: list[list[tuple[Node, Node]]] = [[] for _ in range(n)]
        for point in self.problem.points:
            for component, force in zip(point.position, point.force or (), strict=False):
                formula = self.read(force)
                for i, u in self._gradient(self.read(component)).items():
                    along[i].append((u, formula))
        for rate in self.rates:
            friction = partial(graph, rate.symbol)(self._dissipation)
            if friction is not graph.zero:
                for i, u in rate.jacobian.items():
                    along[i].append((u, graph.scaled(self.expand_rates(friction), -1)))
        return tuple(
            graph.sum(
                [self.read(given[q.name]) if q.name in given else graph.zero, self._along(along[i])]
            )
            for i, q in enumerate(self.q)
        )

    @cached_property
    def entries(self) -> tuple[Node, ...]:
        """Everything that the matrix form consists of: M, forcing, A, bias."""
        rows = self.constraints
        return (
            *(entry for row in self.mass_matrix for entry in row),
            *self.forcing,
            *(entry for each in rows for entry in each.row),
            *(each.bias for each in rows),
        )

    @cached_property
    def independent(self) -> tuple[int, ...]:
        """Indices of the constraints that earlier ones do not imply."""
        given = self.problem.initial.items()
        start = {name.name: self.read(value) for name, value in given if not name.primes}
        states = FloatStates(self.problem, self.constraints, self.functions, start)
        found = states.independent_constraints()
        if found is None:
            raise NotStructural("the rank of the constraints is in doubt in double precision")
        return found

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        return len(self.q) - len(self.independent)

    @cached_property
    def functions(self) -> dict[str, Concrete]:
        """Smooth functions for those that the file leaves unspecified."""
        if not self.problem.functions:
            return {}
        from lagcli.algebra.numeric import concrete_function

        return {
            name: concrete_function(name, len(arguments))
            for name, arguments in self.problem.functions.items()
        }

    # -- constraints ----------------------------------------------------------------------------

    @cached_property
    def constraints(self) -> tuple[ConstraintRow, ...]:
        """One row for each constraint of the file."""
        return tuple(map(self._constraint, self.problem.constraints))

    def _constraint(self, constraint: Constraint) -> ConstraintRow:
        graph, equation = self.graph, constraint.equation
        f = graph.difference(self.read(equation.left), self.read(equation.right))
        flow = self.drift_of
        if not f.mask & self._velocity_mask:
            gradient = self._gradient(f)
            row = tuple(gradient.get(i, graph.zero) for i in range(len(self.q)))
            by_time = partial(graph, self.t)(f)
            found = ConstraintRow(f, True, row, by_time, flow(flow(f)))
        else:
            row = tuple(partial(graph, v)(f) for v in self.qdot)
            if any(entry.mask & self._velocity_mask for entry in row):
                raise NotStructural(f"'{constraint.name}' is not seen to be linear in velocities")
            at_rest = Substitution(graph, dict.fromkeys(self.qdot, graph.zero))
            bias = graph.sum(
                [
                    *(
                        graph.product(flow(entry), v)
                        for entry, v in zip(row, self.qdot, strict=True)
                    ),
                    flow(at_rest(f)),
                ]
            )
            found = ConstraintRow(f, False, row, at_rest(f), bias)
        if all(entry is graph.zero for entry in row):
            raise NotStructural(f"'{constraint.name}' has no coordinate in it")
        return found
