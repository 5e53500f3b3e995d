"""Equilibria where the mass matrix is singular: of the coordinates, or of the body.

At a pole of a sphere only the coordinates fail.  There, with regular ones, the force is a
vector F, and a state is an equilibrium where its square F^T M^-1 F vanishes, a number that
no choice of coordinates changes: it must go to 0 with the distance to the place, from every side.
(With constraints, the square a^T M a of the acceleration from rest.)

What V is near such a place is seen along the displacements that M does not annihilate, at every
value of the coordinates that have none: the meridians through the pole.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from functools import cached_property

import mpmath
from mpmath import mpf
from sympy import Dummy, Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.place import at
from lagcli.algebra.signs import sign
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.parameter_values import admissible_values
from lagcli.mechanics.rest.linearization import Linearization, Matrix
from lagcli.mechanics.rest.rest_conditions import RestConditions, RestPoint

_NEAR, _NEARER = mpf(10) ** -3, mpf(10) ** -9
#: Between these distances a square that vanishes falls by 1e-12, one that does not by nothing.
_FALLS = mpf(10) ** -6
_DIRECTIONS = 3
_TRIES = 12


class OnMeridians(Linearization):
    """The linearised motion along the displacements that the mass matrix does not annihilate."""

    def __init__(self, whole: Linearization) -> None:
        super().__init__(whole.rest, whole.point)
        self.basis = complement(whole.basis, nullspace(whole.M))

    @property
    def damped(self) -> bool:
        """Not known: what turns about the pole may be undamped."""
        return False

    @cached_property
    def indeterminate(self) -> tuple[int, ...]:
        """The coordinates that have no value there: displaced alone, nothing moves."""
        return tuple(
            j
            for j, row in enumerate(self.dynamics.lagrange.mass_matrix_at_rest)
            if all(is_zero(at(entry, self.point.values)) is True for entry in row)
        )

    @cached_property
    def turns(self) -> bool:
        """Whether L has terms linear in the velocities: these may turn the meridians."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        momenta = (p.xreplace(still) for p in self.dynamics.lagrange.momenta)
        return any(is_zero(p) is not True for p in momenta)


class AtPole(Linearization):
    """The linear motion at a pole of polar coordinates, in x = r cos(phi) and y = r sin(phi).

    With q_i = q_i0 + r and T = A (r'^2 + r^2 phi'^2)/2 + ..., p_phi = ... + b r^2/2 at rest, the
    rows of x and y are A x'' - b y' + k x = 0 and A y'' + b x' + k y = 0; that of y comes last.
    For an upright top phi is what turns the precession forward and the spin back.

    Attributes
    ----------
    turning : list of Expr
        The rates of the coordinates at phi' = 1, which M annihilates at the pole.
    radius : int
        The place of q_i among the coordinates.
    """

    def __init__(self, whole: OnMeridians, turning: list[Expr], radius: int) -> None:
        super().__init__(whole.rest, whole.point)
        self.turning, self.radius = turning, radius
        self._row = next(k for k, column in enumerate(whole.basis) if column[radius] == 1)
        self.basis = [*whole.basis, whole.basis[self._row]]

    @property
    def around(self) -> int:
        """The place of phi, or of the first coordinate that turns with it."""
        return next(j for j, rate in enumerate(self.turning) if rate != 0)

    @cached_property
    def C(self) -> Matrix:
        """Damping and gyroscopic terms."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        momentum = dot(self.turning, self.dynamics.lagrange.momenta).xreplace(still)
        b = simplify(self._here(momentum.diff(self.system.q[self.radius], 2)))
        found = super().C
        found[self._row][-1], found[-1][self._row] = -b, b
        return found

    def _along(self, matrix: Sequence[Sequence[Expr]]) -> Matrix:
        found = super()._along(matrix)
        for row in found[:-1]:
            row[-1] = S.Zero
        found[-1][:-1] = [S.Zero] * (len(found) - 1)
        return found


def at_pole(linear: Linearization) -> AtPole | None:
    """The motion in regular coordinates; None where it is no pole of one angle that is cyclic."""
    whole, null = OnMeridians(linear), nullspace(linear.M)
    system, lagrange = linear.system, linear.dynamics.lagrange
    if len(null) != 1 or any(force != 0 for force in system.applied_forces):
        return None
    turning = [dot(null[0], components) for components in zip(*linear.basis, strict=True)]
    turned = [q for q, x in zip(system.q, turning, strict=True) if x != 0]
    fixed = _fixed(linear, turned)
    if fixed is None or any(is_zero(system.L.diff(q)) is not True for q in turned):
        return None

    def here(expression: Expr) -> Expr:
        return at(expression, linear.point.values)

    across = [dot(turning, row) for row in lagrange.mass_matrix_at_rest]
    around, still = dot(turning, across), dict.fromkeys(system.qdot, S.Zero)
    others = [q for q in system.q if q not in turned and q not in fixed]
    bends = {(a, b): here(around.diff(a, b)) / 2 for a in others for b in others}
    curved = [pair for pair, bend in bends.items() if is_zero(bend) is not True]
    if len(curved) != 1 or curved[0][0] != curved[0][1]:
        return None
    r = curved[0][0]
    radius = system.q.index(r)
    momentum = dot(turning, lagrange.momenta).xreplace(still)
    flat = [here(x.diff(r)) for x in (*across, momentum)]
    flat += [here(x.diff(q)) for x in (around, momentum) for q in fixed]  # q - q0 is as r²
    round_ = bends[r, r] - here(lagrange.mass_matrix_at_rest[radius][radius])
    if any(is_zero(x) is not True for x in (*flat, round_)):
        return None
    return AtPole(whole, turning, radius)


def _fixed(linear: Linearization, turned: Sequence[Symbol]) -> set[Symbol] | None:
    """The coordinates that constraints fix to first order; None where others turn or bend."""
    fixed: set[Symbol] = set()
    for equation in linear.dynamics.constraints.equations:
        row = [at(a, linear.point.values) for a in equation.row]
        given = [q for q, a in zip(linear.system.q, row, strict=True) if is_zero(a) is not True]
        constant = equation.holonomic and is_zero(equation.drift) is True
        if len(given) != 1 or not constant or not free_of(equation.f, turned):
            return None
        fixed |= {*given}
    return fixed


def complement(basis: Matrix, null: Matrix) -> Matrix:
    """The columns of the basis without those that the null vectors express by the others."""
    gone = set()
    for vector in null:
        places = [k for k, x in enumerate(vector) if x != 0 and k not in gone]
        gone.add(places[-1])
    return [column for k, column in enumerate(basis) if k not in gone]


def singular(dynamics: Dynamics) -> str:
    """What is singular: L in the velocities, where it is so at rest everywhere, or coordinates."""
    everywhere = singular_everywhere(dynamics)
    return "the Hessian of L in the velocities is" if everywhere else "the coordinates are"


def singular_everywhere(dynamics: Dynamics) -> bool:
    """Whether the mass matrix is singular at rest wherever it is: something has no inertia."""
    whole = determinant(dynamics.lagrange.mass_matrix_at_rest)
    return whole is not None and is_zero(whole) is True


def is_singular(linear: Linearization) -> bool:
    """Whether the mass matrix has null vectors there."""
    return bool(linear.M) and not linear.regular


def survives(rest: RestConditions, point: RestPoint) -> bool:
    """Whether it is an equilibrium in regular coordinates; True where M is regular."""
    if point.family is not None:
        return True
    try:
        if not is_singular(Linearization(rest, point)):
            return True
    except ZeroDivisionError:
        return True
    source = random.Random("meridians")
    squares = _Square(rest)
    for values in admissible_values(rest.system, _TRIES)[:_TRIES]:
        found = [squares.falls(point, values, source) for _ in range(_DIRECTIONS)]
        if None not in found:
            return all(found)
    return True


def is_pressed_to_an_edge(rest: RestConditions, point: RestPoint) -> bool:
    """Whether the coordinates fold there, as x = u^2 at u = 0, and no force leads away.

    With v the null vector of M, det M grows as s^2 along q0 + s v, where it stays 0 at a pole.
    The positions end there, and whether the body rests at that edge no equation of motion says.
    """
    if rest.dynamics.constraints.equations:
        return False
    s, mass = Dummy("s"), rest.dynamics.lagrange.mass_matrix_at_rest
    for v in nullspace(Linearization(rest, point).M):
        path = {q: point.values.get(q, q) + s * x for q, x in zip(rest.system.q, v, strict=True)}
        whole = determinant([[entry.xreplace(path) for entry in row] for row in mass])
        outward = dot(v, [f.xreplace(path) for f in rest.forces_at_rest]).diff(s).subs(s, 0)
        grows = whole is not None and is_zero(whole.diff(s, 2).subs(s, 0)) is False
        if grows and sign(simplify(outward)) != 1:
            return True
    return False


class _Square:
    """a^T M a of the acceleration from rest, near a place."""

    def __init__(self, rest: RestConditions) -> None:
        self.rest, lagrange = rest, rest.dynamics.lagrange
        self.system = rest.system
        kept = rest.dynamics.independent_constraints
        rows = [rest.dynamics.constraints.equations[k].row for k in kept]
        self.n, self.m = len(self.system.q), len(rows)
        mass = [x for row in lagrange.mass_matrix_at_rest for x in row]
        everything: list[Expr] = [*rest.forces_at_rest, *mass, *(x for row in rows for x in row)]
        self.evaluate = Evaluator(everything)

    def falls(
        self, point: RestPoint, values: Mapping[Symbol, mpf], source: random.Random
    ) -> bool | None:
        """Whether it goes to 0 on a straight line to the place; None where it has no value."""
        direction = [mpf(source.uniform(-1, 1)) for _ in self.system.q]
        given = dict(values)
        for q in self.system.q:
            given.setdefault(q, mpf(source.uniform(0.3, 1.2)))
        try:
            with mpmath.workdps(DIGITS):
                far, near = (self._at(point, given, direction, d) for d in (_NEAR, _NEARER))
                return bool(near <= _FALLS * far) or near == 0
        except (ArithmeticError, ValueError, KeyError, TypeError):
            return None

    def _at(
        self, point: RestPoint, given: Mapping[Symbol, mpf], direction: Sequence[mpf], distance: mpf
    ) -> mpf:
        places = Evaluator([point.values.get(q, q) for q in self.system.q])(given)
        pairs = zip(self.system.q, places, direction, strict=True)
        values = {**given, **{q: x + distance * d for q, x, d in pairs}}
        n, m = self.n, self.m
        flat = self.evaluate(values)
        F, M, A = flat[:n], flat[n : n + n * n], flat[n + n * n :]
        K = mpmath.zeros(n + m)
        for i in range(n):
            for j in range(n):
                K[i, j] = M[i * n + j]
            for k in range(m):
                K[i, n + k], K[n + k, i] = -A[k * n + i], A[k * n + i]
        a = mpmath.lu_solve(K, mpmath.matrix([*F, *([0] * m)]))
        return mpf(sum(a[i] * M[i * n + j] * a[j] for i in range(n) for j in range(n)))
