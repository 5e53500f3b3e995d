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

import random
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations_with_replacement

from lagcli.expression import Expression, operation_count
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Call, Graph, Node, Sum, Symbol
from lagcli.graph.sharing import GraphWriter, in_order_of_use, operations, repeated
from lagcli.graph.substitution import Substitution
from lagcli.graph.values import Digits, Program
from lagcli.mechanics.gathering import gathered
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.problem import Problem
from lagcli.record import record

#: More abbreviations than this fill more than a page; a chain of six links on a cart has 74.
MOST_NAMES = 100
#: Operations of all of them; the same chain has 900.
MOST_OPERATIONS = 2_000
_DIGITS = 50
_CLOSE = 30  # digits to which the residuals vanish
_ATTEMPTS = 20
_UNIT = Fraction(1)


@record(kw_only=True)
class ClosedSolution:
    """Trees of the accelerations and multipliers, and the abbreviations that they use in order."""

    accelerations: tuple[Expression, ...]
    multipliers: tuple[Expression, ...]
    where: Mapping[str, Expression]


@record(kw_only=True)
class Written:
    """Trees, and the abbreviations that they use in order."""

    values: tuple[Expression, ...]
    where: Mapping[str, Expression]


def names_of(problem: Problem) -> set[str]:
    """Every name that the file gives a meaning."""
    return {
        *(q.name for q in (*problem.parameters, *problem.coordinates)),
        *(f"p_{q.name}" for q in problem.coordinates),
        *problem.definitions,
        *problem.functions,
        *(c.multiplier for c in problem.constraints),
        *(point.name for point in problem.points),
        "t",
        "pi",
    }


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
        names = (*form.problem.parameters, *form.problem.coordinates)
        self.order = tuple(quantity.name for quantity in names)
        self._wide = len(form.q) + len(form.constraints) > 9
        self._labels: _Labels | None = None

    @cached_property
    def motion(self) -> ClosedSolution | None:
        """The verified solution; None where it fills more than a page, or K has no such factors."""
        form = self.form
        if len(form.independent) < len(form.constraints):
            return None
        matrix = self._bordered(self._mass_matrix)
        bias = [self.graph.scaled(row.bias, -1) for row in form.constraints]
        names = _Names(self.taken, wide=self._wide)
        steps = _ClosedElimination(self.graph, matrix, [*self._forcing, *bias], names)
        if not self._holds(steps, self._bordered(form.mass_matrix), [*form.forcing, *bias]):
            return None
        self._steps = steps
        n = len(form.q)
        values = [*steps.solution[:n], *self._multipliers(steps)]
        written = self._written(steps.named, values)
        if written is None:
            return None
        trees = written.values
        return ClosedSolution(accelerations=trees[:n], multipliers=trees[n:], where=written.where)

    def _multipliers(self, steps: _ClosedElimination) -> list[Node]:
        return [self.graph.scaled(x, -1) for x in steps.solution[len(self.form.q) :]]

    @cached_property
    def constraint_forces(self) -> Written | None:
        """lambda_k df_k/dq_j, constraint by constraint, then their total; None as the motion."""
        if self.motion is None:
            return None
        graph, rows = self.graph, self.form.constraints
        single = [
            [graph.product(entry, multiplier) for entry in row.row]
            for row, multiplier in zip(rows, self._multipliers(self._steps), strict=True)
        ]
        total = [graph.sum(along) for along in zip(*single, strict=True)]
        return self._written(self._steps.named, [*(f for row in single for f in row), *total])

    def _written(self, named: Mapping[Symbol, Node], values: Sequence[Node]) -> Written | None:
        """The trees, parts named as they were named before."""
        if self._labels is None:
            self._labels = _Labels(self.taken)
        momenta = tuple(f"p_{q.name}" for q in self.form.q)
        varying = self.form.varying
        for symbol in (*named, *map(self.graph.symbol, momenta)):
            varying |= symbol.mask
        return _written(named, values, (*self.order, *momenta), self._labels, varying)

    @cached_property
    def _mass_matrix(self) -> Sequence[Sequence[Node]]:
        if not self._given_matrix:
            return self.form.mass_matrix
        return [[self.form.read(entry) for entry in row] for row in self._given_matrix]

    def _bordered(self, mass_matrix: Sequence[Sequence[Node]]) -> list[list[Node]]:
        """K."""
        zero, rows = self.graph.zero, self.form.constraints
        above = [[*line, *(row.row[i] for row in rows)] for i, line in enumerate(mass_matrix)]
        return [*above, *([*row.row, *([zero] * len(rows))] for row in rows)]

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
        velocities = 0
        for v in self.form.qdot:
            velocities |= v.mask
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
        steps = _ClosedElimination(graph, matrix, right, _Names(self.taken, "z", wide=self._wide))
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
        self, steps: _ClosedElimination, matrix: Sequence[Sequence[Node]], right: Sequence[Node]
    ) -> bool:
        """Whether K x = r at a random state, to 50 digits: the steps put in one after another."""
        import mpmath

        graph, source = self.graph, random.Random("lagcli")
        unknowns = steps.unfolded
        residuals = [
            graph.sum(
                [
                    *(graph.product(k, x) for k, x in zip(row, unknowns, strict=True)),
                    graph.scaled(r, -1),
                ]
            )
            for row, r in zip(matrix, right, strict=True)
        ]
        with mpmath.workdps(_DIGITS):
            program = Program(residuals, Digits(), self.form.functions)
            for _ in range(_ATTEMPTS):
                state = _State(source, self.form)
                try:
                    found = program(state)
                except (ArithmeticError, ValueError):
                    continue
                return all(abs(x) < mpmath.mpf(10) ** -_CLOSE for x in found)
        return False


class _State(dict[str, object]):
    """A random value for every symbol, drawn when it is first asked for."""

    def __init__(self, source: random.Random, form: MatrixForm) -> None:
        super().__init__()
        self._source = source
        self._negative = {
            q.name
            for q in (*form.problem.parameters, *form.problem.coordinates)
            if q.assume == "negative"
        }

    def __missing__(self, name: str) -> object:
        import mpmath

        size = mpmath.mpf(self._source.randint(6000, 17000)) / 10007
        value = self[name] = -size if name in self._negative else size
        return value


class _Names:
    """Letters for the steps that no name of the file has."""

    def __init__(self, taken: Collection[str], values: str = "y", *, wide: bool) -> None:
        self.between = "_" if wide else ""
        self.matrix = free_stem(("u", "U", "w"), taken)
        self.right = free_stem((values, "Y", "v"), taken)
        self.solution = free_stem(("a", "x", "b"), taken)


def free_stem(stems: Sequence[str], taken: Collection[str]) -> str:
    """The first stem with which no name of the file begins before its digits."""
    used = {name.rstrip("0123456789_") for name in taken}
    for stem in stems:
        if stem not in used:
            return stem
    stem = stems[0]
    while stem in used:
        stem += stems[0]
    return stem


class _ClosedElimination:
    """The steps: what each name stands for, as nodes of one graph."""

    def __init__(
        self,
        graph: Graph,
        matrix: Sequence[Sequence[Node]],
        right: Sequence[Node],
        names: _Names,
    ) -> None:
        self.graph = graph
        self.named: dict[Symbol, Node] = {}
        self._names = names
        size = len(right)
        self._rows: list[list[Node]] = []
        self.values: list[Node] = []
        for i in range(size):
            self._rows.append([self._entry(matrix, i, j) for j in range(size)])
            parts = ((row[i], y, row[k]) for k, (row, y) in enumerate(self._before(i)))
            self.values.append(self._name(f"{names.right}{i + 1}", self._less(right[i], parts)))
        self.pivots = [row[i] for i, row in enumerate(self._rows)]
        self.forward = dict(self.named)
        self.solution = self._backward()

    def _before(self, i: int) -> Iterator[tuple[list[Node], Node]]:
        return zip(self._rows[:i], self.values, strict=False)

    def _entry(self, matrix: Sequence[Sequence[Node]], i: int, j: int) -> Node:
        """u_ij, 0 below the diagonal."""
        if j < i:
            return self.graph.zero
        parts = ((row[i], row[j], row[k]) for k, row in enumerate(self._rows))
        name = f"{self._names.matrix}{i + 1}{self._names.between}{j + 1}"
        return self._name(name, self._less(matrix[i][j], parts))

    def _less(self, start: Node, parts: Iterable[tuple[Node, Node, Node]]) -> Node:
        """start - sum u v / d."""
        graph = self.graph
        terms = [
            graph.scaled(graph.quotient(graph.product(u, v), d), -1)
            for u, v, d in parts
            if graph.zero not in (u, v)
        ]
        return graph.sum([start, *terms])

    def _name(self, name: str, node: Node) -> Node:
        """A symbol for what shows more than one operation."""
        if operations([node]) < 2:
            return node
        symbol = self.graph.symbol(name)
        self.named[symbol] = node
        return symbol

    def _backward(self) -> list[Node]:
        graph, size = self.graph, len(self.values)
        found = [graph.zero] * size
        for i in reversed(range(size)):
            row = self._rows[i]
            known = [graph.product(row[j], found[j]) for j in range(i + 1, size)]
            rest = graph.sum([self.values[i], *(graph.scaled(each, -1) for each in known)])
            whole = graph.quotient(rest, self.pivots[i])
            # the first is used by no other
            found[i] = self._name(f"{self._names.solution}{i + 1}", whole) if i else whole
        return found

    @property
    def unfolded(self) -> list[Node]:
        """The solution with every step put in."""
        whole: dict[Symbol, Node] = {}
        for symbol, node in self.named.items():
            whole[symbol] = Substitution(self.graph, whole)(node)
        return [Substitution(self.graph, whole)(x) for x in self.solution]


# -- the page ----------------------------------------------------------------------------------


def _written(
    named: Mapping[Symbol, Node],
    values: Sequence[Node],
    order: Sequence[str],
    labels: _Labels,
    varying: int,
) -> Written | None:
    """The values and the abbreviations that they use, in order; None for more than a page."""
    needed = _needed(named, values)
    roots = [*needed.values(), *values]
    where: dict[str, Expression] = {}
    writer, shared = GraphWriter(order), repeated(roots) | labels.known
    labels.take(symbol.name for symbol in named)
    definitions = [(symbol.name, node) for symbol, node in needed.items()]
    for name, root in [*definitions, *(("", value) for value in values)]:
        for node in in_order_of_use([root]):
            if node in shared and node not in writer.names and not (name and node is root):
                label = labels(node)
                where[label] = writer.tree(node)
                writer.name(node, label, leading=not node.mask & varying)
        if name:
            where[name] = writer.tree(root)
    trees = tuple(map(writer.tree, values))
    count = sum(map(operation_count, (*where.values(), *trees)))
    if len(where) > MOST_NAMES or count > MOST_OPERATIONS:
        return None
    return Written(values=trees, where=where)


def _needed(named: Mapping[Symbol, Node], values: Sequence[Node]) -> dict[Symbol, Node]:
    """The names that the values use, directly or through others."""
    mask = 0
    for value in values:
        mask |= value.mask
    kept: list[Symbol] = []
    for symbol in reversed(list(named)):
        if symbol.mask & mask:
            mask |= named[symbol].mask
            kept.append(symbol)
    return {symbol: named[symbol] for symbol in reversed(kept)}


class _Labels:
    """Names by what is named: s12 = sin(θ1 − θ2), m23 = m2 + m3, else k1, k2, …

    A part that was named keeps its name.
    """

    def __init__(self, taken: Collection[str]) -> None:
        self._taken = set(taken)
        self._stem = free_stem(("k", "h", "shared"), taken)
        self._of: dict[Node, str] = {}
        self._count = 0

    @property
    def known(self) -> set[Node]:
        """What has a name."""
        return set(self._of)

    def take(self, names: Iterable[str]) -> None:
        """Give no part one of these names."""
        self._taken.update(names)

    def __call__(self, node: Node) -> str:
        known = self._of.get(node)
        if known is None:
            known = self._of[node] = self._new(_label(node))
        return known

    def _new(self, wanted: str) -> str:
        if not wanted or wanted in self._taken:
            self._count += 1
            wanted = f"{self._stem}{self._count}"
        self._taken.add(wanted)
        return wanted


def _label(node: Node) -> str:
    match node:
        case Call(function="sin" | "cos" as function, arguments=(angle,)):
            indices = _indices(angle)
            return function[0] + indices if indices else ""
        case Sum(constant=constant, terms=terms) if not constant:
            parts = [_stem(term) for term, number in terms if number == 1]
            stems = {stem for stem, _ in parts}
            if len(stems) == 1 and len(parts) == len(terms) and all(i for _, i in parts):
                return stems.pop() + "".join(index for _, index in parts)
    return ""


def _indices(angle: Node) -> str:
    """12 of θ1 - θ2, 1 of θ1."""
    if isinstance(angle, Symbol):
        return _stem(angle)[1]
    if not isinstance(angle, Sum) or angle.constant or len(angle.terms) != 2:
        return ""
    (a, one), (b, other) = angle.terms
    first, second = _stem(a), _stem(b)
    alike = first[0] == second[0] and first[0] and one == 1 and other == -1
    return first[1] + second[1] if alike and first[1] and second[1] else ""


def _stem(node: Node) -> tuple[str, str]:
    """(theta, 1) of theta1 and of theta_1."""
    if not isinstance(node, Symbol) or node.primes:
        return "", ""
    stem = node.name.rstrip("0123456789")
    return stem.rstrip("_"), node.name[len(stem) :]
