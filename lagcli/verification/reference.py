"""Lagrangian mechanics in numbers: the definitions, differentiated automatically.

Nothing here is symbolic, and nothing is shared with what derives the printed formulas.

    d/dt(dL/dq_j') - dL/dq_j = Q_j - dD/dq_j' + sum_k lambda_k a_kj
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property

from flint import arb

from lagcli.expression import Expression
from lagcli.problem_data import Constraint, Problem
from lagcli.record import record
from lagcli.verification.functions import Instance
from lagcli.verification.linear import SolutionSpace, dot, solve
from lagcli.verification.program import VerificationProgram
from lagcli.verification.sweeps import Environment, StepValues, column

#: Unknowns q'' and lambda, beyond which solving for them (n^3) takes longer than all else.
MANY = 24


@record
class ConstraintSteps:
    """One constraint f = 0: the steps of f and of df/dt (or f again), and the order of its row."""

    constraint: Constraint
    value: int
    velocity: int
    holonomic: bool


class Reference:
    """The steps of L, of the forces and of the constraints of one problem."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.names = tuple(c.name for c in problem.coordinates)
        self.program = program = VerificationProgram(
            self.names, problem.functions, problem.definitions
        )
        self.instances = {name: Instance(name, len(a)) for name, a in problem.functions.items()}
        self.time = program.symbol("t")
        self.q, self.v, self.a = (
            [program.symbol(name, primes) for name in self.names] for primes in (0, 1, 2)
        )

    # -- energies ---------------------------------------------------------------------------

    @cached_property
    def kinetic(self) -> int | None:
        """T as given, or the sum over the points of m v^2/2; None where L is given."""
        if self.problem.lagrangian is not None or self.problem.hamiltonian is not None:
            return None
        if self.problem.kinetic is not None:
            return self.program.of(self.problem.kinetic)
        program, terms = self.program, []
        for point in self.problem.points:
            if point.mass is not None:
                half = program.product(program.number(Fraction(1, 2)), program.of(point.mass))
                for x in point.position:
                    v = program.rate(program.of(x))
                    terms.append(program.product(half, program.product(v, v)))
        return program.sum(*terms)

    @cached_property
    def potential(self) -> int:
        """V; 0 when absent."""
        given = self.problem.potential
        return self.program.zero if given is None else self.program.of(given)

    @cached_property
    def lagrangian(self) -> int:
        """L as given, or T - V."""
        if self.kinetic is None:
            assert self.problem.lagrangian is not None
            return self.program.of(self.problem.lagrangian)
        return self.program.sum(self.kinetic, self.program.negative(self.potential))

    @cached_property
    def momenta(self) -> list[int]:
        """dL/dq_j'."""
        return [self.by(self.lagrangian, v) for v in self.v]

    @cached_property
    def p(self) -> list[int]:
        """The symbols p_x."""
        return [self.program.symbol(f"p_{name}") for name in self.names]

    @cached_property
    def energy(self) -> int:
        """h = sum q' p - L."""
        program = self.program
        products = map(program.product, self.v, self.momenta)
        return program.sum(*products, program.negative(self.lagrangian))

    def by(self, place: int, symbol: int) -> int:
        """The partial derivative of a formula."""
        return self.program.derivative(place, {symbol: self.program.one})

    # -- forces -----------------------------------------------------------------------------

    @cached_property
    def forces(self) -> list[int]:
        """Q_j: forces as given, and those on points by virtual work F . dr/dq_j."""
        program, given = self.program, self.problem.forces
        total = [program.of(given[n]) if n in given else program.zero for n in self.names]
        for point in self.problem.points:
            for component, x in zip(point.force or (), point.position, strict=False):
                force, place = program.of(component), program.of(x)
                for j, q in enumerate(self.q):
                    arm = self.by(place, q)
                    total[j] = program.sum(total[j], program.product(force, arm))
        return total

    @property
    def timed(self) -> bool:
        """Whether the time occurs in L."""
        return ("t", 0) in self.program.symbols([self.lagrangian])

    @property
    def pushed(self) -> bool:
        """Whether more than L and the constraints acts."""
        given = self.problem
        return bool(given.forces or given.dissipation or any(p.force for p in given.points))

    @cached_property
    def dissipation(self) -> int | None:
        """D."""
        given = self.problem.dissipation
        return None if given is None else self.program.of(given)

    # -- constraints ------------------------------------------------------------------------

    @cached_property
    def rows(self) -> list[ConstraintSteps]:
        """The constraints."""
        return [self._row(constraint) for constraint in self.problem.constraints]

    def _row(self, constraint: Constraint) -> ConstraintSteps:
        program, equation = self.program, constraint.equation
        f = program.sum(program.of(equation.left), program.negative(program.of(equation.right)))
        moving = any((name, 1) in program.symbols([f]) for name in self.names)
        return ConstraintSteps(constraint, f, f if moving else program.rate(f), not moving)

    @cached_property
    def following(self) -> frozenset[tuple[str, int]]:
        """The symbols that the laws give values: momenta, accelerations, multipliers."""
        named = {(f"p_{name}", 0) for name in self.names} | {(name, 2) for name in self.names}
        return frozenset(named | {(c.multiplier, 0) for c in self.problem.constraints})

    @property
    def large(self) -> bool:
        """Whether q'' and the multipliers are not solved for at each state at once."""
        return len(self.names) + len(self.problem.constraints) > MANY

    @property
    def of_phase_space(self) -> bool:
        """Whether there is an H alone, from which no Lagrangian follows."""
        return self.problem.hamiltonian is not None and self.problem.lagrangian is None

    def values(self, environment: Environment) -> StepValues:
        """All formulas where the symbols have these values."""
        return StepValues(self.program, self.instances, environment)

    def place(self, node: Expression) -> int:
        """The step of a formula."""
        return self.program.of(node)


class DynamicsAtState:
    """What the laws say at one state: momenta, forces, accelerations, multipliers.

    Parameters
    ----------
    reference
        The problem.
    at
        Values at a state (parameters, t, q, q').
    """

    def __init__(self, reference: Reference, at: StepValues) -> None:
        self.reference = reference
        self.at = at
        self.size = len(reference.names)
        self.velocities = [at(place) for place in reference.v]

    # -- L and its derivatives ----------------------------------------------------------------

    @cached_property
    def _gradient(self) -> dict[int, arb]:
        return self.at.gradient(self.reference.lagrangian)

    @property
    def lagrangian(self) -> arb:
        """L."""
        return self.at(self.reference.lagrangian)

    @cached_property
    def momenta(self) -> list[arb]:
        """p_j = dL/dq_j'."""
        return column(self._gradient, self.reference.v)

    @cached_property
    def slopes(self) -> list[arb]:
        """dL/dq_j."""
        return column(self._gradient, self.reference.q)

    @property
    def energy(self) -> arb:
        """h = sum q' p - L."""
        return dot(self.velocities, self.momenta) - self.lagrangian

    def hessian(self, direction: Mapping[int, arb]) -> dict[int, arb]:
        """The second derivatives of L times a direction."""
        return self.at.gradient_rates(self.reference.lagrangian, self._gradient, direction)

    @cached_property
    def drift(self) -> list[arb]:
        """d/dt(dL/dq_j') - dL/dq_j where q'' = 0."""
        along = self.hessian(self._coasting)
        return [r - s for r, s in zip(column(along, self.reference.v), self.slopes, strict=True)]

    @cached_property
    def _coasting(self) -> dict[int, arb]:
        """The direction of time where q'' = 0."""
        moving = zip(self.reference.q, self.velocities, strict=True)
        return {**dict(moving), self.reference.time: arb(1)}

    @cached_property
    def mass_matrix(self) -> list[list[arb]]:
        """d^2 L/dq_i' dq_j'."""
        one = arb(1)
        return [column(self.hessian({v: one}), self.reference.v) for v in self.reference.v]

    def inertia(self, accelerations: Sequence[arb]) -> list[arb]:
        """d/dt(dL/dq_j') - dL/dq_j for any q''."""
        falling = self.hessian(dict(zip(self.reference.v, accelerations, strict=True)))
        pairs = zip(self.drift, column(falling, self.reference.v), strict=True)
        return [a + b for a, b in pairs]

    # -- forces and constraints -----------------------------------------------------------------

    @cached_property
    def applied(self) -> list[arb]:
        """Q_j - dD/dq_j'."""
        total = [self.at(force) for force in self.reference.forces]
        if self.reference.dissipation is None:
            return total
        drag = column(self.at.gradient(self.reference.dissipation), self.reference.v)
        return [force - d for force, d in zip(total, drag, strict=True)]

    @cached_property
    def jacobian(self) -> list[list[arb]]:
        """The rows a_kj."""
        return [
            column(self.at.gradient(row.velocity), self.reference.v) for row in self.reference.rows
        ]

    @cached_property
    def bias(self) -> list[arb]:
        """d/dt(A q' + b) where q'' = 0."""
        return [
            self.at.rates([row.velocity], self._coasting).get(row.velocity, arb(0))
            for row in self.reference.rows
        ]

    # -- the motion -------------------------------------------------------------------------------

    @cached_property
    def motion(self) -> SolutionSpace:
        """(q'', lambda) of M q'' - A^T lambda = F, A q'' = -bias."""
        size, jacobian = self.size, self.jacobian
        rows = [[*self.mass_matrix[j], *(-a[j] for a in jacobian)] for j in range(size)]
        rows += [[*a, *(arb(0) for _ in jacobian)] for a in jacobian]
        right = [f - e for f, e in zip(self.applied, self.drift, strict=True)]
        return solve(rows, [*right, *(-b for b in self.bias)], size + len(jacobian))

    @property
    def accelerations(self) -> tuple[arb, ...]:
        """q''."""
        return self.motion.x[: self.size]

    @property
    def multipliers(self) -> tuple[arb, ...]:
        """One choice of lambda, not unique where constraints are redundant."""
        return self.motion.x[self.size :]

    @cached_property
    def regular(self) -> bool:
        """Whether the equations determine q''."""
        motion = self.motion
        return motion.consistent and all(map(motion.determined, range(self.size)))

    def constraint_force(self, k: int) -> list[arb]:
        """lambda_k a_kj."""
        return [self.multipliers[k] * a for a in self.jacobian[k]]

    @cached_property
    def total_constraint_force(self) -> list[arb]:
        """sum_k lambda_k a_kj, unique where q'' is."""
        columns = zip(*self.jacobian, strict=True)
        forces = [dot(self.multipliers, column) for column in columns]
        return forces or [arb(0)] * self.size

    @cached_property
    def flow(self) -> dict[int, arb]:
        """The direction of time along the motion, of t, q and q'."""
        return {**self._coasting, **dict(zip(self.reference.v, self.accelerations, strict=True))}

    def rate(self, place: int) -> arb:
        """d/dt of a function of t, q, q' along the motion."""
        return self.at.rates([place], self.flow).get(place, arb(0))
