"""The motion in closed form by elimination, every step of it an abbreviation.

The system of the accelerations and multipliers is symmetric,

    [ M  A^T ] [  q''    ]   [ forcing ]
    [ A   0  ] [ -lambda ] = [  -bias  ]        K x = r,

and is solved without a determinant by the elimination of Gauss, row i of which is

    u_ij = K_ij - sum_{k<i} u_ki u_kj / u_kk,      y_i = r_i - sum_{k<i} u_ki y_k / u_kk,
    x_i  = (y_i - sum_{j>i} u_ij x_j) / u_ii.

M is positive definite, so no u_ii vanishes where the constraints are independent.  Every u_ij
and y_i gets a name, and a chain of n links has some n² of them instead of the n! terms of a
determinant.  With z_i = p_i - dL/dq_i'(q' = 0) - sum u_ki z_k / u_kk for the momenta in place of
y_i, the kinetic energy is sum z_i² / (2 u_ii).

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., section 4.1.2 (the factorization L D L^T).
Featherstone, *Rigid Body Dynamics Algorithms*, chapter 6 (the same along a chain of bodies).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations_with_replacement

from lagcli.expression import Expression
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol, mask_of
from lagcli.graph.sharing import operations
from lagcli.graph.substitution import Substitution
from lagcli.mechanics.abbreviation import PartLabels, Written, abbreviated
from lagcli.mechanics.gathering import gathered
from lagcli.mechanics.identities import vanish
from lagcli.mechanics.matrix_form import MatrixForm, NotStructural
from lagcli.mechanics.symbolic_elimination import StepNames, SymbolicElimination
from lagcli.notation.given_formulas import order_of_parameters
from lagcli.record import record

_CLOSE = 30  # digits to which the residuals vanish
_UNIT = Fraction(1)


@record(kw_only=True)
class ClosedSolution:
    """Trees of the accelerations and multipliers, and the abbreviations that they use in order."""

    accelerations: tuple[Expression, ...]
    multipliers: tuple[Expression, ...]
    where: Mapping[str, Expression]


class ClosedForm:
    """Accelerations, multipliers and Hamiltonian of one system with abbreviations.

    Parameters
    ----------
    form
        The matrix form of the system.
    taken
        Names that the file gives a meaning.
    matrix, forcing
        Shorter trees for the entries of M and of the forcing, where they are known: the
        structure alone does not see that sin² + cos² is 1.
    """

    def __init__(
        self,
        form: MatrixForm,
        taken: Collection[str],
        matrix: Sequence[Sequence[Expression]] = (),
        forcing: Sequence[Expression] = (),
    ) -> None:
        self.form = form
        self._given_matrix, self._given_forcing = matrix, forcing
        self.graph = form.graph
        self.taken = frozenset(taken)
        coordinates = (coordinate.name for coordinate in form.problem.coordinates)
        self.order = (*order_of_parameters(form.problem), *coordinates)
        self._wide = len(form.q) + len(form.constraints) > 9
        self._labels: PartLabels | None = None

    @cached_property
    def motion(self) -> ClosedSolution | None:
        """The verified solution; None where it fills more than a page, or K has no such factors."""
        form = self.form
        try:
            if len(form.independent) < len(form.constraints):
                return None
        except NotStructural:
            return None
        found = next(filter(None, map(self._eliminated, self._elimination_orders)), None)
        if found is None:
            return None
        order, steps = found
        self._steps, n = steps, len(form.q)
        x = [steps.solution[order.index(i)] for i in range(len(order))]
        self._lambda = [self.graph.scaled(each, -1) for each in x[n:]]
        values = [*x[:n], *self._lambda]
        written = self._written(steps.named, values)
        if written is None:
            return None
        trees = written.values
        return ClosedSolution(accelerations=trees[:n], multipliers=trees[n:], where=written.where)

    def _eliminated(self, order: list[int]) -> tuple[list[int], SymbolicElimination] | None:
        names = StepNames(self.taken, wide=self._wide)
        system = self._system(self._mass_matrix, self._forcing, order)
        try:
            steps = SymbolicElimination(self.graph, *system, names)
        except ZeroDivisionError:
            return None
        given = self._system(self.form.mass_matrix, self.form.forcing, order)
        return (order, steps) if self._holds(steps, *given) else None

    @property
    def _elimination_orders(self) -> Iterator[list[int]]:
        """Coordinates without inertia after multipliers: their pivots are 0 before them.

        The pivot of a multiplier is 0 where the constraints before it leave nothing with inertia
        free; it then follows the coordinates without.
        """
        n, m = len(self.form.q), len(self.form.constraints)
        massless = [i for i in range(n) if self._mass_matrix[i][i] is self.graph.zero]
        others = [k for k in range(n + m) if k not in massless]
        for last in range(m + 1 if massless else 1):
            place = len(others) - last
            yield [*others[:place], *massless, *others[place:]]

    @cached_property
    def constraint_forces(self) -> Written | None:
        """lambda_k df_k/dq_j, constraint by constraint, then their total; None as the motion."""
        if self.motion is None:
            return None
        graph, rows = self.graph, self.form.constraints
        single = [
            [graph.product(entry, multiplier) for entry in row.row]
            for row, multiplier in zip(rows, self._lambda, strict=True)
        ]
        total = [graph.sum(along) for along in zip(*single, strict=True)]
        return self._written(self._steps.named, [*(f for row in single for f in row), *total])

    def _written(self, named: Mapping[Symbol, Node], values: Sequence[Node]) -> Written | None:
        """The trees, parts named as they were named before."""
        if self._labels is None:
            self._labels = PartLabels(self.taken)
        momenta = tuple(f"p_{q.name}" for q in self.form.q)
        varying = self.form.varying
        for symbol in (*named, *map(self.graph.symbol, momenta)):
            varying |= symbol.mask
        return abbreviated(named, values, (*self.order, *momenta), self._labels, varying)

    @cached_property
    def _mass_matrix(self) -> Sequence[Sequence[Node]]:
        if not self._given_matrix:
            return self.form.mass_matrix
        return [[self.form.read(entry) for entry in row] for row in self._given_matrix]

    def _system(
        self, mass_matrix: Sequence[Sequence[Node]], forcing: Sequence[Node], order: list[int]
    ) -> tuple[list[list[Node]], list[Node]]:
        """K and what stands beside K x, in the order of elimination."""
        zero, rows = self.graph.zero, self.form.constraints
        above = [[*line, *(row.row[i] for row in rows)] for i, line in enumerate(mass_matrix)]
        K = [*above, *([*row.row, *([zero] * len(rows))] for row in rows)]
        right = [*forcing, *(self.graph.scaled(row.bias, -1) for row in rows)]
        return [[K[i][j] for j in order] for i in order], [right[i] for i in order]

    @cached_property
    def _forcing(self) -> Sequence[Node]:
        """What stands beside M q'', the way that shows less.

        From the entries of M, which are short where angles are combined, with L_0 = L(q, 0, t)
        and no terms of first degree in the velocities:

            F_i = Q_i + dL_0/dq_i - sum_jk (dM_ij/dq_k - dM_jk/dq_i / 2) q_j' q_k'
                  - sum_j dM_ij/dt q_j'
        """
        form = self.form
        choices = [form.forcing]
        if self._given_forcing:
            choices.append(tuple(map(form.read, self._given_forcing)))
        if self._is_quadratic and all(b is self.graph.zero for b in self._first_degree):
            choices.append(tuple(self._force(i) for i in range(len(form.q))))
        return min(choices, key=operations)

    def _force(self, i: int) -> Node:
        form, graph, M = self.form, self.graph, self._mass_matrix
        by = [partial(graph, q) for q in form.q]
        pairs = list(combinations_with_replacement(range(len(form.q)), 2))
        terms = [form.applied_forces[i], gathered(graph, by[i](self._at_rest), form.varying)]
        for j, k in pairs:
            number = Fraction(1 if j == k else 2)
            slope = graph.combination(
                [
                    (by[k](M[i][j]), -number / 2),
                    (by[j](M[i][k]), -number / 2),
                    (by[i](M[j][k]), number / 2),
                ]
            )
            terms.append(graph.product(slope, form.qdot[j], form.qdot[k]))
        by_time = partial(graph, form.t)
        terms += [
            graph.scaled(graph.product(by_time(M[i][j]), v), -1) for j, v in enumerate(form.qdot)
        ]
        return graph.sum(terms)

    @cached_property
    def _is_quadratic(self) -> bool:
        velocities = mask_of(self.form.qdot)
        return not any(entry.mask & velocities for row in self.form.mass_matrix for entry in row)

    @cached_property
    def _resting(self) -> Substitution:
        return Substitution(self.graph, dict.fromkeys(self.form.qdot, self.graph.zero))

    @cached_property
    def _at_rest(self) -> Node:
        """L(q, 0, t)."""
        return self._resting(self.form.written_lagrangian)

    @cached_property
    def _first_degree(self) -> tuple[Node, ...]:
        """dL/dq_i' at q' = 0."""
        return tuple(map(self._resting, self.form.momenta))

    # -- the Hamiltonian ---------------------------------------------------------------------

    @cached_property
    def hamiltonian(self) -> Written | None:
        """H = sum z_i²/(2 u_ii) - L(q, 0, t) for L of second degree in the velocities."""
        form, graph = self.form, self.graph
        if not self._is_quadratic:
            return None
        momenta = [graph.symbol(f"p_{q.name}") for q in form.q]
        right = [graph.difference(p, b) for p, b in zip(momenta, self._first_degree, strict=True)]
        matrix = [list(row) for row in self._mass_matrix]
        steps = SymbolicElimination(
            graph, matrix, right, StepNames(self.taken, "z", wide=self._wide)
        )
        if not self._holds(steps, [list(row) for row in form.mass_matrix], right):
            return None
        square = [
            (graph.quotient(graph.monomial([(z, Fraction(2))]), u), Fraction(1, 2))
            for z, u in zip(steps.values, steps.pivots, strict=True)
            if z is not graph.zero
        ]
        whole = graph.combination([*square, (self._at_rest, -_UNIT)])
        return self._written(steps.forward, [whole])

    # -- the check ------------------------------------------------------------------------------

    def _holds(
        self, steps: SymbolicElimination, matrix: Sequence[Sequence[Node]], right: Sequence[Node]
    ) -> bool:
        """Whether K x = r at random states: the steps put in one after another."""
        graph, unknowns = self.graph, steps.unfolded
        residuals = [
            graph.difference(graph.sum(map(graph.product, row, unknowns)), r)
            for row, r in zip(matrix, right, strict=True)
        ]
        return vanish(residuals, self.form, _CLOSE) is True
