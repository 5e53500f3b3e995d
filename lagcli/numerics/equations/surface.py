"""Back onto the constraints after each step: positions first, then velocities.

    q <- q - M^-1 A^T (A M^-1 A^T)^-1 f(q, t)        until f is nothing but rounding
    q' <- q' - M^-1 A^T (A M^-1 A^T)^-1 (A q' + b)

References
----------
Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., sections IV.4 and VII.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from lagcli.numerics.equations.motion import Motion

Vector = list[Any]

#: Residuals relative to the sum of |a_kj q_j| that are as good as 0 in doubles.
ROUNDING = 4e-16
_STEPS = 6


class Surface:
    """The constraints of a motion, with the largest residuals seen.

    Parameters
    ----------
    motion
        With at least one constraint.
    rounding
        The relative residual at which a projection is done.
    """

    def __init__(self, motion: Motion, rounding: float = ROUNDING) -> None:
        self.motion = motion
        self.rounding = rounding
        self.n = motion.n
        self.count = len(motion.equations.holonomic)
        self.scales = [0.0] * (self.count + motion.m)
        self.residuals = [0.0] * (self.count + motion.m)

    def measure(self, t: float, q: Vector, v: Vector) -> None:
        """Note how large the terms of the constraints are here."""
        found = self.motion.sizes(t, *q, *v)
        self.scales = [max(a, abs(float(b))) for a, b in zip(self.scales, found, strict=True)]

    def relative(self, index: int, value: Any) -> float:
        """A residual in terms of its constraint's size."""
        return abs(float(value)) / (self.scales[index] or 1.0)

    def project(self, t: float, q: Vector, v: Vector) -> tuple[Vector, Vector]:
        """The state on the constraints.

        Raises
        ------
        ArithmeticError, ValueError
            Where the constraints cannot be solved.
        """
        q = self.settle(t, q, v) if self.count else q
        return q, self._tangent(t, q, v)

    def settle(self, t: float, q: Vector, v: Vector) -> Vector:
        """The nearest positions on the holonomic constraints."""
        return self._corrected(q, lambda q: self.motion.position_correction(t, *q, *v), 0, _STEPS)

    def _tangent(self, t: float, q: Vector, v: Vector) -> Vector:
        correction = self.motion.velocity_correction
        return self._corrected(v, lambda v: correction(t, *q, *v), self.count, 3)

    def _corrected(
        self, x: Vector, correction: Callable[[Vector], Sequence[float]], first: int, steps: int
    ) -> Vector:
        """By Newton's steps, as long as the residuals, from the `first` on, become smaller."""
        n, before = self.n, float("inf")
        for _ in range(steps):
            found = correction(x)
            worst = max(self.relative(first + k, r) for k, r in enumerate(found[n:]))
            if worst <= self.rounding or worst >= before:
                break
            before = worst
            x = [each - d for each, d in zip(x, found[:n], strict=True)]
        return x

    def nearest(
        self, t: float, q: Vector, v: Vector, rounds: int, near: float
    ) -> tuple[Vector, Vector] | None:
        """The state on the constraints after some projections; None where they do not lead there.

        Parameters
        ----------
        near
            The largest residual that is left.
        """
        try:
            for _ in range(rounds):
                self.measure(t, q, v)
                q, v = self.project(t, q, v)
            self.note(t, q, v)
        except (ArithmeticError, ValueError):
            return None
        return (q, v) if max(self.residuals) <= near else None

    def join(self, part: Surface, place: Mapping[int, int]) -> None:
        """Take over the residuals of some of the constraints.

        Parameters
        ----------
        part
            The surface that these make.
        place
            For each of them here, its place there.
        """
        ours, theirs = self.motion.equations.holonomic, part.motion.equations.holonomic
        for k, i in place.items():
            pairs = [(self.count + k, part.count + i)]
            if i in theirs:
                pairs.append((ours.index(k), theirs.index(i)))
            for here, there in pairs:
                self.residuals[here] = max(self.residuals[here], part.residuals[there])

    def note(self, t: float, q: Vector, v: Vector) -> None:
        """Measure the residuals that are left at a state."""
        for k, value in enumerate(self.motion.residuals(t, *q, *v)):
            self.residuals[k] = max(self.residuals[k], self.relative(k, value))
