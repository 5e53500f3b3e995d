"""What happens where contacts close or are lost: impulses, and who carries afterwards.

An impact changes the velocities at once, by impulses along the constraints,

    M (v+ - v-) = A^T Lambda,     g'+ >= -e g'-,  Lambda >= 0,  Lambda (g'+ + e g'-) = 0

with Newton's coefficient e for each contact that strikes, e = 0 for one that is closed and
g' = 0 for what is no one-sided contact.  Which of the closed contacts carry from then on
follows from the accelerations in the same way.  Friction gives no impulse.

A ball that bounces with e < 1 comes to rest after infinitely many impacts in a finite
time.  With the speed u after an impact and the gap's acceleration -a, the rest of them take
2 u / (a (1 - e)); where that, and u, are nothing beside the accuracy, the contact is closed.

References
----------
Glocker, *Set-Valued Force Laws* (2001), chapter 9; Newton, *Principia*, scholium to the laws.
Pfeiffer, Glocker, *Multibody Dynamics with Unilateral Contacts* (1996), chapter 8.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from lagcli.numerics.equations.contact import OneSided
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.null_space import dot, held_motion
from lagcli.numerics.hybrid.complementarity import carrying

Vector = list[float]

#: Beside the largest of its kind, this is 0.
_ROUNDING = 1e-12
#: A bounce whose height is below this multiple of the rounding of the gap is timed by its speed.
UNRESOLVED = 1e3


class Hinge:
    """M, forces and all constraints at one state.

    Parameters
    ----------
    motion
        With every constraint, those of open contacts too.
    contacts
        The one-sided ones.
    t, q, v
        The state.
    """

    def __init__(
        self,
        motion: Motion,
        contacts: Mapping[int, OneSided],
        t: float,
        q: Sequence[float],
        v: Sequence[float],
    ) -> None:
        self.contacts = contacts
        state = (t, *q, *v)
        self.mass, self.forcing, rows, bias = motion.system(*state)
        signs = [contacts[k].sign if k in contacts else 1 for k in range(motion.m)]
        self.rows = [[s * x for x in row] for s, row in zip(signs, rows, strict=True)]
        self.bias = [s * x for s, x in zip(signs, bias, strict=True)]
        found = motion.rates(*state)
        self.rates = [s * x for s, x in zip(signs, found, strict=True)]
        sizes = motion.sizes(*state)[len(motion.equations.holonomic) :]
        self.speeds = [abs(float(x)) for x in sizes]

    def gap_accelerations(self, held: frozenset[int]) -> dict[int, float]:
        """g'' of every contact while some constraints act."""
        order = sorted(held)
        found = held_motion(
            self.mass, self.forcing, [self.rows[k] for k in order], [self.bias[k] for k in order]
        )
        return {k: dot(self.rows[k], found.accelerations) + self.bias[k] for k in self.contacts}

    def carried(self, always: frozenset[int], closed: frozenset[int]) -> frozenset[int] | None:
        """Which of the closed contacts carry: forces and gap accelerations are not negative."""
        heaviest = max((abs(x) for x in self.forcing), default=0.0) or 1.0
        quickest = 0.0

        def trial(chosen: frozenset[int]) -> tuple[dict[int, float], dict[int, float]]:
            nonlocal quickest
            order = sorted(always | chosen)
            found = held_motion(
                self.mass,
                self.forcing,
                [self.rows[k] for k in order],
                [self.bias[k] for k in order],
            )
            force = dict(zip(order, found.multipliers, strict=True))
            away = {
                k: dot(self.rows[k], found.accelerations) + self.bias[k] for k in closed - chosen
            }
            quickest = max(
                [quickest, *(abs(self.rows[k][j] * x) for k in closed
                             for j, x in enumerate(found.accelerations))]
            )  # fmt: skip
            return (
                {k: force[k] / heaviest for k in chosen},
                {k: x / (quickest or 1.0) for k, x in away.items()},
            )

        return carrying(closed, trial, _ROUNDING)

    def struck(
        self, v: Sequence[float], always: frozenset[int], closed: Mapping[int, float]
    ) -> tuple[Vector, dict[int, float]] | None:
        """v+ and the energy lost at each contact; `closed` gives e of each with an impulse.

        A contact takes -Lambda (g'+ + g'-)/2.
        """
        fastest = max(self.speeds, default=0.0) or 1.0
        heaviest = 0.0
        found: dict[frozenset[int], tuple[Vector, dict[int, float]]] = {}

        def trial(chosen: frozenset[int]) -> tuple[dict[int, float], dict[int, float]]:
            nonlocal heaviest
            order = sorted(always | chosen)
            lacking = [(1 + closed.get(k, 0.0)) * self.rates[k] for k in order]
            jump = held_motion(self.mass, [0.0] * len(v), [self.rows[k] for k in order], lacking)
            impulse = dict(zip(order, jump.multipliers, strict=True))
            found[chosen] = (jump.accelerations, impulse)
            heaviest = max([heaviest, *map(abs, map(float, jump.multipliers))])
            away = {
                k: (self.rates[k] * (1 + e) + dot(self.rows[k], jump.accelerations)) / fastest
                for k, e in closed.items()
                if k not in chosen
            }
            return {k: impulse[k] / (heaviest or 1.0) for k in chosen}, away

        chosen = carrying(frozenset(closed), trial, _ROUNDING)
        if chosen is None:
            return None
        jump, impulse = found[chosen]
        lost = {
            k: -float(impulse.get(k, 0.0) * (self.rates[k] + dot(self.rows[k], jump) / 2))
            for k in closed
        }
        return [x + d for x, d in zip(v, jump, strict=True)], lost

    def along(self, k: int, errors: Sequence[float]) -> float:
        """How much errors of the coordinates change a gap."""
        return math.fsum(abs(a) * b for a, b in zip(self.rows[k], errors, strict=False))


def rests(speed: float, acceleration: float, restitution: float, time: float, least: float) -> bool:
    """Whether the impacts still to come are over within `time`, none faster than `least`."""
    if speed > least or not acceleration < 0:
        return False
    return 2 * speed <= time * -acceleration * (1 - restitution) or speed == 0


def flight_of(speed: float, acceleration: float) -> tuple[float, float]:
    """How long a bounce takes and how high it is, under a constant acceleration."""
    if not acceleration < 0:
        return math.inf, math.inf
    return 2 * speed / -acceleration, speed * speed / (-2 * acceleration)
