"""The mechanical system of a problem: coordinates, L, forces and constraints as formulas.

This is where the file's words become the field's quantities.  Nothing is derived yet.
"""

from __future__ import annotations

from functools import cached_property

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import TIME, Builder, symbol, without_jumps
from lagcli.algebra.jumps import is_continuous
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.expression import Call, Expression
from lagcli.notation.given_formulas import order_of_names
from lagcli.problem_data import Point, Problem
from lagcli.record import record


@record
class Particle:
    """A point of the file as formulas: position r(q, t), mass, applied force."""

    name: str
    position: tuple[Expr, ...]
    mass: Expr | None
    force: tuple[Expr, ...] | None


class System:
    """Coordinates q, velocities, L and everything that acts, as SymPy expressions.

    Attributes
    ----------
    q, qdot, qddot : tuple of Symbol
        Coordinates, velocities, accelerations, in the order of the file.
    L : Expr
        The Lagrangian L(q, q', t) = T - V, or as given.
    T, V : Expr or None
        Kinetic and potential energy; None when only L or H is given.
    D : Expr
        Rayleigh's dissipation function (0 without).
    forces : tuple of Expr
        Q_j, the generalized forces of `forces` and, by virtual work, of the points;
        without the dissipation -dD/dq'.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.t = TIME
        self.q = tuple(symbol(c.name, c.assume) for c in problem.coordinates)
        self.qdot = tuple(symbol(c.name + "'") for c in problem.coordinates)
        self.qddot = tuple(symbol(c.name + "''") for c in problem.coordinates)
        self.names = tuple(c.name for c in problem.coordinates)
        self.parameters = tuple(
            symbol(p.name, p.assume, integer=p.integer) for p in problem.parameters
        )
        self.momenta = tuple(symbol("p_" + name) for name in self.names)
        self.multipliers = tuple(symbol(c.multiplier) for c in problem.constraints)
        self._flow = {
            **dict(zip(self.q, self.qdot, strict=True)),
            **dict(zip(self.qdot, self.qddot, strict=True)),
        }
        names: dict[str, Expr] = {
            s.name: s for s in (*self.q, *self.parameters, *self.momenta, *self.multipliers)
        }
        arities = {name: len(args) for name, args in problem.functions.items()}
        self.build = Builder(names, arities, self.total_derivative, self._unreal)
        for name, formula in problem.definitions.items():
            self.build.names[name] = self.build(formula)

    def total_derivative(self, expression: Expr) -> Expr:
        """d/dt along any motion: d/dt + q' d/dq + q'' d/dq'."""
        present = expression.free_symbols
        terms = [expression.diff(self.t)] if self.t in present else []
        terms += [
            rate * expression.diff(variable)
            for variable, rate in self._flow.items()
            if variable in present
        ]
        return without_jumps(sympy.Add(*terms))

    def _unreal(self, node: Expression) -> ProblemError:
        message = "this has no real value"
        if isinstance(node, Call):
            message = f"'{node.function}' has no real value here"
        return ProblemError(self.problem.source, (Diagnostic(message, node.span),))

    def symbol_of(self, name: str) -> Symbol:
        """The symbol printed as `name`: a coordinate, velocity, acceleration, parameter, …"""
        return self._by_name[name]

    @cached_property
    def _by_name(self) -> dict[str, Symbol]:
        groups = (self.q, self.qdot, self.qddot, self.parameters, self.momenta, self.multipliers)
        return {s.name: s for group in groups for s in group} | {"t": self.t}

    @cached_property
    def order(self) -> tuple[str, ...]:
        """The names in the order in which a product shows them."""
        return order_of_names(self.problem)

    # -- what the file gives --------------------------------------------------------

    def _optional(self, node: Expression | None) -> Expr:
        return sympy.S.Zero if node is None else self.build(node)

    @cached_property
    def particles(self) -> tuple[Particle, ...]:
        """The points of the file."""
        return tuple(self._particle(point) for point in self.problem.points)

    def _particle(self, point: Point) -> Particle:
        return Particle(
            point.name,
            tuple(map(self.build, point.position)),
            None if point.mass is None else self.build(point.mass),
            None if point.force is None else tuple(map(self.build, point.force)),
        )

    @property
    def _is_whole(self) -> bool:
        """L or H is given, and not its parts."""
        return self.problem.lagrangian is not None or self.problem.hamiltonian is not None

    @cached_property
    def T(self) -> Expr | None:
        """The kinetic energy as given, or the sum of m v^2 / 2 over the points."""
        if self._is_whole:
            return None
        if self.problem.kinetic is not None:
            return self.build(self.problem.kinetic)
        return self.points_energy

    @cached_property
    def points_energy(self) -> Expr:
        """The sum of m v^2 / 2 over the points that have a mass."""
        return sympy.Add(
            *(
                particle.mass
                * sympy.Add(*(self.total_derivative(x) ** 2 for x in particle.position))
                / 2
                for particle in self.particles
                if particle.mass is not None
            )
        )

    @cached_property
    def V(self) -> Expr | None:
        """The potential energy, which may depend on velocities and t; 0 when absent."""
        return None if self._is_whole else self._optional(self.problem.potential)

    @cached_property
    def L(self) -> Expr:
        """The Lagrangian."""
        if self.problem.lagrangian is not None:
            return self.build(self.problem.lagrangian)
        assert self.T is not None
        assert self.V is not None
        return self.T - self.V

    @cached_property
    def H(self) -> Expr | None:
        """The Hamiltonian as given; None where the file gives something else."""
        given = self.problem.hamiltonian
        return None if given is None else self.build(given)

    @cached_property
    def D(self) -> Expr:
        """Rayleigh's dissipation function."""
        return self._optional(self.problem.dissipation)

    @cached_property
    def forces(self) -> tuple[Expr, ...]:
        """Q_j = (given force) + sum over points of F . dr/dq_j (d'Alembert's virtual work)."""
        return tuple(
            self._optional(self.problem.forces.get(name))
            + sympy.Add(
                *(
                    component * without_jumps(x.diff(q))
                    for particle in self.particles
                    if particle.force is not None
                    for component, x in zip(particle.force, particle.position, strict=True)
                )
            )
            for name, q in zip(self.names, self.q, strict=True)
        )

    @cached_property
    def is_continuous(self) -> bool:
        """Whether L has no jump: there the equations of motion lack an impulse."""
        return is_continuous(self.L)

    @cached_property
    def applied_forces(self) -> tuple[Expr, ...]:
        """Everything that no potential gives: Q_j - dD/dq_j'."""
        return tuple(
            force - without_jumps(self.D.diff(v))
            for force, v in zip(self.forces, self.qdot, strict=True)
        )
