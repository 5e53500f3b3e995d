"""Where abs and sign change their branch: the step ends there and the next one begins anew.

Within a step the sign is kept as it was at the beginning, so what is integrated is smooth
and keeps its order; the place where the argument passes 0 is found on the dense output.

References
----------
Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.6
(event location and discontinuous equations).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.evaluation import bisected
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.integrators.steps import Inside, Tolerance

_PLACES = (0.25, 0.5, 0.75)
_HALVINGS = 60
#: Branches that change again and again within this part of the span: something sticks.
_AT_ONCE = 1e-9
_AGAIN = 8
#: Roundings of the time within which a crossing is found; near a touch it is farther away.
_ULPS = 1e5
#: In a run that is moved an event is _AWAY roundings of the time and the state away, and _NEARER
#: at tolerances up to _FINE, whose differences are taken many times.
_AWAY, _NEARER, _FINE = 8, 1, 1e-13
_GOLDEN = 0.6180339887498949


def lateness(t: float, u: float, rate: float) -> float:
    """How long ago u was 0; 0 near a touch."""
    return u / rate if rate and abs(u) <= _ULPS * math.ulp(t) * abs(rate) else 0.0


def displaced(bound: Tolerance, t: float, count: int, noise: float, rate: float) -> float:
    """What rounding of the state makes of a time in a run that is moved: 0 in others.

    Some events are earlier and some later, so that this adds up as rounding does.
    """
    if not bound.moved or not rate or not noise <= _ULPS * math.ulp(t) * abs(rate):
        return 0.0
    far = _roundings(bound) * bound.unit * float(noise) / rate
    return math.copysign(far, count * _GOLDEN % 1.0 - 0.5)


def later(bound: Tolerance, t: float, most: float) -> float:
    """Some roundings after a time, at which the same event is met in a run that is moved."""
    return min(t + _roundings(bound) * math.ulp(t), most) if bound.moved else t


def _roundings(bound: Tolerance) -> int:
    return _AWAY if bound.value > _FINE else _NEARER


class Kinks:
    """The arguments of abs and sign along one run."""

    def __init__(self, motion: Motion, tolerance: Tolerance) -> None:
        self.motion, self._tolerance = motion, tolerance
        self.reached: int | None = None  # the one at which the next step ends
        self._slack = [0.0] * len(motion.kinks)
        self._times: list[float] = []

    def first(
        self, t: float, h: float, q: Sequence[float], v: Sequence[float], inside: Inside
    ) -> float | None:
        """How far to the first change of branch within a step; None without one."""
        if self.reached is not None:  # this step was made to end at it
            return None

        def wrong(x: float) -> list[int]:
            state = (q, v) if x == 1 else inside(t + x * h)[:2]
            found = self.motion.kink_arguments(t + x * h, *state[0], *state[1])
            return [
                k
                for k, s in enumerate(self.motion.signs)
                if found[k] * s < -self._slack[k] and k not in self.motion.stuck
            ]

        before = 0.0
        for x in (*_PLACES, 1.0):
            if wrong(x):
                break
            before = x
        else:
            return None
        _, bad = bisected(lambda place: not wrong(place), before, x, _HALVINGS)
        self.reached = wrong(bad)[0]
        return later(self._tolerance, t + bad * h, t + h) - t

    def begin(self, t: float, q: Sequence[float], v: Sequence[float]) -> None:
        """Begin at a state; what is at a kink there may be on either side by rounding."""
        found = self.motion.kink_arguments(t, *q, *v)
        noise = self.motion.kink_noise(t, q, v)
        self._slack = [
            limit if abs(x) <= limit else 0.0 for x, limit in zip(found, noise, strict=True)
        ]

    def sticks(self, t: float, q: Sequence[float], v: Sequence[float]) -> bool:
        """Whether both branches lead back to the kink that has been reached."""
        motion, k = self.motion, self.reached
        if k is None or k not in motion.moving_kinks:
            return False
        usual = motion.signs[k]
        away: list[float] = []
        for sign in (1.0, -1.0):
            motion.signs[k] = sign
            rates = motion.kink_rates(t, *q, *v, *motion.accelerations(t, *q, *v))
            away.append(sign * float(rates[k]))
        motion.signs[k] = usual
        return max(away) <= 0

    def stuck(self, t: float, span: float) -> bool:
        """Whether branches have changed again and again at one time."""
        self._times.append(t)
        recent = self._times[-_AGAIN:]
        return len(recent) == _AGAIN and recent[-1] - recent[0] < _AT_ONCE * span

    def pass_through(self, t: float, q: Sequence[float], v: Sequence[float]) -> list[float]:
        """Change the branch that has been reached; v as if it had been changed in time.

        The step ends where doubles see the argument u on the other side, u/u' late: there
        v errs by that time the jump of q''.  A run that is moved ends the step later, and what
        the rounding of the state makes of that time is in its v.
        """
        assert self.reached is not None
        motion, k, self.reached = self.motion, self.reached, None
        try:
            before = motion.accelerations(t, *q, *v)
        except (ArithmeticError, ValueError):
            before = (math.nan,)
        if any(math.isnan(float(a)) for a in before):  # a root of what is |u| on this side
            motion.signs[k] *= -1
            return list(v)
        u = motion.exact_kink_arguments(t, *q, *v)[k]
        rate = float(motion.kink_rates(t, *q, *v, *before)[k])
        motion.signs[k] *= -1
        noise = motion.kink_change(k, t, (*q, *v), self._tolerance.peaks)
        late = lateness(t, u, rate) + displaced(self._tolerance, t, len(self._times), noise, rate)
        after = motion.accelerations(t, *q, *v)
        return [x + late * (b - a) for x, a, b in zip(v, before, after, strict=True)]

    def why(self) -> str:
        """What holds the motion at a kink."""
        return "a force that jumps holds it there, which is not modelled"
