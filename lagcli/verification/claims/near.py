"""One state that stays, and the linear motion near it.

With x = (q, q') the motion near a state that stays is x' = J x, where J holds the derivatives of
the accelerations, here by differences in 320 bits.  Constraints add eigenvalues 0 of motions
that break them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

from flint import arb, arb_mat

from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, dot, rank, size, solve
from lagcli.verification.phase_points import Environment
from lagcli.verification.reference import DynamicsAtState

_STEP = arb(2) ** -150
_BESIDE = arb(2) ** -30
#: Real parts and differences below this are 0: an eigenvalue of multiplicity 4 is right to 1e-20.
NOTHING = 1e-12
#: Relative differences of eigenvalues: those of multiplicity 2 are right to 1e-19.
_AGREE = 1e-9
#: An eigenvalue of M that is 0: of a place that is right to 1e-12 a square leaves 1e-24.
_FLAT = 1e-9
#: A real part of an eigenvalue of multiplicity 2 is right to 1e-19.
_DECAYS = 1e-6


class LinearMotion:
    """One state that stays, and the linear motion near it."""

    def __init__(self, x: Examination, environment: Environment) -> None:
        self.x = x
        self.environment = environment
        self.laws = self.laws_at(environment)
        self.at = self.laws.at
        self.size = len(x.reference.names)

    def laws_at(self, environment: Environment) -> DynamicsAtState:
        """The laws at another state."""
        reference = self.x.reference
        return DynamicsAtState(reference, reference.values(environment))

    # -- that it stays --------------------------------------------------------------------------

    @cached_property
    def defined(self) -> bool:
        """Whether all forces have values there."""
        return all(value.is_finite() for value in (*self.laws.drift, *self.laws.applied))

    @cached_property
    def at_a_pole(self) -> bool:
        """Whether the mass matrix is singular there."""
        return not self.regular or any(abs(z) < _FLAT for z in eigenvalues(self.laws.mass_matrix))

    @cached_property
    def without_lagrangian(self) -> bool:
        """Whether L has no real value here and on all sides near it, as that of sqrt(-1)."""
        lagrangian, names = self.x.reference.lagrangian, self.x.reference.names
        if self.at(lagrangian).is_finite():
            return False
        for side in range(2 ** min(self.size, 3)):
            steps = (-_BESIDE if side >> k & 1 else _BESIDE for k in range(self.size))
            moved = {(n, 0): self.environment[n, 0] + d for n, d in zip(names, steps, strict=True)}
            if self.x.reference.values({**self.environment, **moved})(lagrangian).is_finite():
                return False
        return True

    @cached_property
    def pull(self) -> list[arb]:
        """d/dt(dL/dq') - dL/dq - Q where q'' = 0."""
        return [e - f for e, f in zip(self.laws.drift, self.laws.applied, strict=True)]

    @cached_property
    def residual(self) -> float:
        """How far the state is from staying: constraints, and forces that none of them bears."""
        at, laws = self.at, self.laws
        reference = self.x.reference
        gaps = [at(row.value) for row in reference.rows if row.holonomic]
        gaps += [at(row.velocity) for row in reference.rows]
        pull = self.pull
        carried = list(zip(*laws.jacobian, strict=True)) or [()] * self.size
        solution = solve([list(row) for row in carried], pull, len(laws.jacobian))
        for j, row in enumerate(carried):
            left = pull[j]
            for a, m in zip(row, solution.x, strict=True):
                left = left - a * m
            gaps.append(left)
        scale = max([1.0, *map(size, pull), *map(size, laws.slopes)])
        return max([0.0, *map(size, gaps)]) / scale

    # -- the linear motion near it ------------------------------------------------------------

    @cached_property
    def regular(self) -> bool:
        """Whether the accelerations are determined there."""
        try:
            return self.laws.regular and all(a.is_finite() for a in self.laws.motion.x)
        except Unclear:
            return False

    @cached_property
    def slopes(self) -> tuple[list[list[arb]], list[list[arb]]]:
        """dq''/dq and dq''/dq', rows by acceleration."""
        by_q, by_v = (self._slopes(lambda laws: laws.accelerations, k) for k in (0, 1))
        return by_q, by_v

    def _slopes(
        self, of: Callable[[DynamicsAtState], Sequence[arb]], primes: int = 0
    ) -> list[list[arb]]:
        """The derivatives of some values by the coordinates or velocities, rows by value."""
        here, columns = of(self.laws), []
        for name in self.x.reference.names:
            moved = {**self.environment, (name, primes): self.environment[name, primes] + _STEP}
            pairs = zip(here, of(self.laws_at(moved)), strict=True)
            columns.append([(b - a) / _STEP for a, b in pairs])
        return [list(row) for row in zip(*columns, strict=True)]

    @cached_property
    def sides(self) -> tuple[int, ...]:
        """Of one coordinate: 1 where it is pushed away on a side, -1 where it is pushed back.

        So near that the first term that is not 0 of its acceleration outweighs all others.
        """
        if self.size > 1:
            return ()
        [name] = self.x.reference.names
        place = self.environment[name, 0]
        moved = ({**self.environment, (name, 0): place + side * _BESIDE} for side in (1, -1))
        above, below = (self.laws_at(each).accelerations[0] for each in moved)
        return tuple(int(a > 0) - int(a < 0) for a in (above, -below))

    @property
    def still(self) -> bool:
        """Whether velocities play no part, so that each frequency has a real shape."""
        return all(size(e) < NOTHING for row in self.slopes[1] for e in row)

    @cached_property
    def eigenvalues(self) -> list[complex]:
        """Those of J that no constraint adds."""
        return sorted(eigenvalues_of_motion(*self.slopes), key=abs)[self._added :]

    @property
    def _added(self) -> int:
        rows = self.x.reference.rows
        pairs = list(zip(rows, self.laws.jacobian, strict=True))
        holonomic = [a for row, a in pairs if row.holonomic]
        return rank(self.laws.jacobian, self.size) + rank(holonomic, self.size)

    @cached_property
    def stiffness(self) -> list[float]:
        """Eigenvalues of the second derivatives of V - T_0 along the constraints, at rest."""
        jacobian = self.laws.jacobian
        tangent = solve(jacobian, [arb(0)] * len(jacobian), self.size).kernel
        K = self._slopes(self._static)
        along = [[dot(row, way) for row in K] for way in tangent]
        rows = [[dot(way, pull) for pull in along] for way in tangent]
        return [value.real for value in eigenvalues(rows)]

    @property
    def is_bowl(self) -> bool:
        """Whether V - T_0 surely has a minimum there, and nothing but L and constraints acts."""
        definite = all(z.real > NOTHING for z in eigenvalues(self.laws.mass_matrix))
        return not self.x.reference.pushed and definite and all(k > 1e-8 for k in self.stiffness)

    @property
    def is_stable(self) -> bool:
        """Whether it is a minimum, or every disturbance decays."""
        return self.is_bowl or all(z.real < -_DECAYS for z in self.eigenvalues)

    @cached_property
    def curvatures(self) -> list[float]:
        """Eigenvalues of the second derivatives of V - T_0 without constraints, at rest."""
        return [z.real for z in eigenvalues(self._slopes(lambda laws: laws.drift))]

    def _static(self, laws: DynamicsAtState) -> list[arb]:
        """d(V - T_0)/dq - Q - sum lambda a with the multipliers of the state of rest."""
        found = [e - f for e, f in zip(laws.drift, laws.applied, strict=True)]
        for m, row in zip(self.laws.multipliers, laws.jacobian, strict=True):
            found = [r - m * a for r, a in zip(found, row, strict=True)]
        return found


def eigenvalues_of_motion(
    by_q: Sequence[Sequence[arb]], by_v: Sequence[Sequence[arb]]
) -> list[complex]:
    """Those of x'' = by_q x + by_v x'."""
    n = len(by_q)
    rows = [[arb(0)] * n + [arb(int(i == j)) for j in range(n)] for i in range(n)]
    return eigenvalues([*rows, *([*a, *b] for a, b in zip(by_q, by_v, strict=True))])


def eigenvalues(rows: Sequence[Sequence[arb]]) -> list[complex]:
    """Approximate eigenvalues of a square matrix."""
    if not rows:
        return []
    middle = [[entry.mid() for entry in row] for row in rows]
    found = arb_mat(middle).eig(algorithm="approx", nonstop=True)
    return [complex(float(z.real.mid()), float(z.imag.mid())) for z in found]


def occur(near: LinearMotion, squares: Sequence[arb]) -> bool:
    """Whether each omega^2 is minus the square of an eigenvalue, as often as it is there."""
    left = [-(z**2) for z in near.eigenvalues]
    scale = max([1e-6, *map(abs, left)])
    for square in squares:
        if not square.is_finite():
            continue
        W = float(square.mid())
        equal = [z for z in left if abs(z - W) < _AGREE * scale]
        if len(equal) < 2:
            return False
        left = [z for z in left if z not in equal[:2]] + equal[2:]
    return True
