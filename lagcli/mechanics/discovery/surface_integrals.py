"""First integrals that hold on the constraint surface.

With admissible displacements e_a(q), sum_j A_kj e_aj = 0, and J_a = sum_j e_aj p_j,

    Q = sum_a f_a(t, q) J_a + sum_{a<=b} g_ab(q) J_a J_b + c(t) h + S(t, q),

and, since the constraint forces do no work along e_a,

    dJ_a/dt = sum_j (De_aj p_j + e_aj (dL/dq_j + Q_j)),    D = d/dt + sum q' d/dq,
    dh/dt   = -dL/dt + sum_j Q_j q_j' - sum_k lambda_k b_k.

dQ/dt = 0 at points of the surface is linear in the coefficients of f, g, c and S.  What is
constant there takes no part.  Each Q is the charge of Dq = f_a e_a + g_ab (J_a e_b + J_b e_a)
and Dt = -c up to the boundary term S: a symmetry of the system with its constraints.

References
----------
Bloch, Krishnaprasad, Marsden, Murray, Arch. Rational Mech. Anal. 136 (1996) 21.
Fasso, Sansonetto, J. Nonlinear Sci. 26 (2016) 519 (moving energies).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import sympy
from flint import nmod_mat
from sympy import Expr, S

from lagcli.algebra import dot
from lagcli.mechanics.discovery.admissible import Vector
from lagcli.mechanics.discovery.chart import solved_in_chart
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import PRIME, NoPoint, kernel_modulo, pivot_columns
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.surface import FormulaSurface
from lagcli.mechanics.noether import Noether

_BAD_POINTS = 60  # as of the search: half of them for each square root
_MOST_OF_DIFFERENCES = 30  # coefficients that may be products of differences
_UNITS = 3  # of the coefficients that are put to 1 for that


@dataclass(frozen=True, slots=True)
class IntegralTerm:
    """T(t) g(q) times the J of the fields named, or the energy (-1,), or nothing ().

    With `velocities` times these too, by the numbers of their coordinates.
    """

    fields: tuple[int, ...]
    time: Expr
    space: Expr
    velocities: tuple[int, ...] = ()

    @property
    def function(self) -> Expr:
        """T g."""
        return self.time * self.space


Integral = list[tuple[IntegralTerm, Expr]]


class SurfaceIntegrals:
    """The search among given terms.

    Parameters
    ----------
    noether
        Of a system with constraints.
    fields
        Admissible displacements.
    terms
        The simplest first.
    known
        Integrals that are known already: nothing that is a combination of them is found.
    same
        Functions that are constant on each component of the surface.
    """

    def __init__(
        self,
        noether: Noether,
        fields: Sequence[Vector],
        terms: Sequence[IntegralTerm],
        known: Sequence[Expr],
        allowed: Allowance,
        same: Sequence[Expr] = (),
    ) -> None:
        self.noether = noether
        self.dynamics = noether.dynamics
        self.system = noether.system
        self.fields = list(fields)
        relations = noether.dynamics.constraints.relations
        assert relations is not None
        values = [relations.substitute(x.space) for x in terms]  # not 1/h on h = 0
        infinite = (S.ComplexInfinity, S.NaN)
        self.terms = [x for x, v in zip(terms, values, strict=True) if not v.has(*infinite)]
        self.allowed = allowed
        self.unsolved = 0
        self._same = same
        self._prepare(known)

    # -- formulas on the surface ------------------------------------------------------------

    def _prepare(self, known: Sequence[Expr]) -> None:
        dynamics, system = self.dynamics, self.system
        relations = dynamics.constraints.relations
        assert relations is not None
        on, lagrange = relations.substitute, dynamics.lagrange
        convected = SlotEquations(system.t, system.q, system.qdot, (), ()).convected

        def jet(*values: Expr) -> list[tuple[Expr, Expr]]:
            return [(on(x), on(convected(x))) for x in values]

        p = [on(x) for x in lagrange.momenta]
        forces = zip(lagrange.lagrangian_forces, system.applied_forces, strict=True)
        pushes = [on(a + b) for a, b in forces]
        self._J = []
        for field in self.fields:
            e, De = zip(*jet(*field), strict=True)
            self._J.append((dot(e, p), dot(De, p) + dot(e, pushes)))
        power = dot(system.applied_forces, system.qdot) - system.L.diff(system.t)
        self._energy = on(self.noether.energy.function), on(power)
        self._known = [on(Q) for Q in known]
        functions = dict.fromkeys(f for x in self.terms for f in (x.time, x.space))
        self._functions = dict(zip(functions, jet(*functions), strict=True))
        kept = [dynamics.constraints.equations[k] for k in dynamics.independent_constraints]
        moving = any(e.drift != 0 for e in kept) and any(-1 in x.fields for x in self.terms)
        moving = moving or any(x.velocities for x in self.terms)
        self._velocities = [on(v) for v in system.qdot]
        self._equations = (
            [[on(m) for m in row] for row in lagrange.mass_matrix],
            [[on(a) for a in e.row] for e in kept],
            [on(f) for f in lagrange.forcing],
            [on(e.bias) for e in kept],
            [on(e.drift) for e in kept],
        )
        if not moving:
            self._equations = ([], [], [], [], [])
        mass, rows, forcing, biases, drifts = self._equations
        pairs = (*self._J, self._energy, *self._functions.values())
        everything = [*self._velocities, *self._known, *(x for pair in pairs for x in pair)]
        everything += [x for row in (*mass, *rows) for x in row] + [*forcing, *biases, *drifts]
        self.surface = FormulaSurface(self.dynamics, everything, self.allowed, self._same)

    def _factors(self, term: IntegralTerm) -> list[tuple[Expr, Expr]]:
        """T, g and the J of a term with their rates."""
        fields = (self._energy if a < 0 else self._J[a] for a in term.fields)
        return [self._functions[term.time], self._functions[term.space], *fields]

    # -- values ---------------------------------------------------------------------------

    def _sample(self) -> tuple[list[int], list[int], list[int]]:
        """Values of the terms, their rates, and values of the known integrals."""
        point = self.surface.point()
        at = self.surface.tree.at(point)
        accelerations, work = self._motion(at)
        moving = list(zip(map(at, self._velocities), accelerations, strict=False))
        values, rates = [], []
        for term in self.terms:
            jets = [(at(x), at(y)) for x, y in self._factors(term)]
            if -1 in term.fields:
                jets[-1] = jets[-1][0], jets[-1][1] - work
            value, rate = 1, 0
            for x, y in [*jets, *(moving[i] for i in term.velocities)]:
                value, rate = value * x % PRIME, (rate * x + value * y) % PRIME
            values.append(value)
            rates.append(rate)
        return values, rates, [at(Q) for Q in self._known]

    def _motion(self, at: Callable[[Expr], int]) -> tuple[list[int], int]:
        """q'' and sum lambda_k b_k, from M q'' - A^T lambda = forcing, A q'' = -bias."""
        mass, rows, forcing, biases, drifts = self._equations
        if not rows:
            return [], 0
        n, m = len(mass), len(rows)
        A = [[at(x) for x in row] for row in rows]
        table = [
            [*(at(x) for x in row), *(-A[k][i] for k in range(m)), at(f)]
            for i, (row, f) in enumerate(zip(mass, forcing, strict=True))
        ]
        table += [[*row, *([0] * m), -at(b)] for row, b in zip(A, biases, strict=True)]
        reduced, rank = nmod_mat(table, PRIME).rref()
        if rank < n + m:
            raise NoPoint
        last = [int(row[n + m]) for row in reduced.table()]
        work = sum(x * at(b) for x, b in zip(last[n : n + m], drifts, strict=True)) % PRIME
        return last[:n], work

    def _samples(self, count: int) -> Iterator[tuple[list[int], list[int], list[int]]]:
        bad = 0
        while count:
            self.allowed.check()
            try:
                yield self._sample()
                count -= 1
            except NoPoint:
                bad += 1
                if bad > _BAD_POINTS:
                    raise

    # -- the search -------------------------------------------------------------------------

    def found(self) -> list[Integral]:
        """Integrals that are independent, linearly over the constants, of the known ones.

        Raises
        ------
        NoPoint
            Where no points of the surface were found.
        """
        samples = list(self._samples(len(self.terms) + len(self._known) + 12))
        # of terms that depend on each other on the surface the simplest stay
        chosen = [k - 1 for k in pivot_columns([[1, *values] for values, _, _ in samples]) if k]
        chosen.reverse()  # the simplest last: each solution has one that no other has
        rows = [[rates[k] for k in chosen] for _, rates, _ in samples]
        _, vectors = kernel_modulo(rows, len(chosen))
        vectors.reverse()
        start = 1 + len(self._known)
        table = [
            [1, *known, *(
                sum(values[chosen[i]] * x for i, x in vector.items()) % PRIME for vector in vectors
            )]
            for values, _, known in samples
        ]  # fmt: skip
        new = [vectors[k - start] for k in pivot_columns(table) if k >= start]
        return [i for vector in new if (i := self._exact(vector, chosen)) is not None]

    def _exact(self, vector: dict[int, int], chosen: Sequence[int]) -> Integral | None:
        exact = ExactSolver(self.surface.points)
        indices = sorted(vector)
        numbers = [vector[i] for i in indices]
        terms = [self.terms[chosen[i]] for i in indices]
        moved = self._equations[0] and any(-1 in x.fields for x in terms)
        linear = not self.surface.curved and not moved and not any(x.velocities for x in terms)
        units = list(reversed(numbers))
        tries = [(unit, False) for unit in units]
        if not linear and len(numbers) <= _MOST_OF_DIFFERENCES:
            tries += [(unit, True) for unit in units[:_UNITS]]
        for unit, differences in tries:
            inverse = pow(unit, -1, PRIME)
            values = exact.recognized(
                [x * inverse % PRIME for x in numbers], differences=differences
            )
            if values is not None:
                return list(zip(terms, values, strict=True))
        if linear:
            solved = exact.solved([[self._rate(term)] for term in terms])
            if solved is not None:
                return list(zip(terms, solved, strict=True))
        elif not moved:
            rates = [self._rate(term) for term in terms]
            dependent = self.surface.independent_velocities.keys()
            charted = solved_in_chart(rates, dependent, self.dynamics, self.allowed)
            if charted is not None:
                return list(zip(terms, charted, strict=True))
        self.unsolved += 1
        return None

    def _rate(self, term: IntegralTerm) -> Expr:
        """d/dt of a term as a formula in independent velocities."""
        factors = self._factors(term)
        if term.velocities:
            motion = self.dynamics.motion
            assert motion is not None
            factors += [(self._velocities[i], motion.accelerations[i]) for i in term.velocities]
        total = sympy.Add(
            *(
                sympy.Mul(*(dx if i == k else x for i, (x, dx) in enumerate(factors)))
                for k in range(len(factors))
            )
        )
        return total.xreplace(self.surface.independent_velocities)
