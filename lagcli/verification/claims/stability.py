"""What the linear motion near a state that stays says of a printed verdict on its stability."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from lagcli.statements.motions import Above, Verdict
from lagcli.verification.claims.near import NOTHING, LinearMotion, eigenvalues
from lagcli.verification.claims.rest import conditions, held_at
from lagcli.verification.comparison import ComparisonVerdict, compare
from lagcli.verification.examination import Examination
from lagcli.verification.linear import size
from lagcli.verification.states import State


class Judged:
    """What the linear motion says of a printed verdict at one state."""

    def __init__(self, near: LinearMotion, zeros: int) -> None:
        everything = near.eigenvalues
        self.scale = max([1e-3, *map(abs, everything)])
        self.values = everything[zeros:]  # two are 0 for the momentum of a cyclic coordinate

    @property
    def growing(self) -> bool:
        """Some motion surely grows."""
        return any(z.real > 1e-8 * self.scale for z in self.values)

    @property
    def oscillating(self) -> bool:
        """No motion grows, not even in proportion to t, and higher orders do not decide."""
        return not self.growing and self.distinct

    @property
    def damped(self) -> bool:
        """Every motion surely dies out."""
        return all(z.real < -1e-8 * self.scale for z in self.values)

    @property
    def imaginary(self) -> bool:
        """All frequencies are real, distinct and not 0."""
        return not self.growing and not any(z.real < -1e-8 * self.scale for z in self.values)

    @property
    def distinct(self) -> bool:
        """No two eigenvalues are equal, none is 0."""
        pairs = ((a, b) for k, a in enumerate(self.values) for b in self.values[:k])
        apart = all(abs(a - b) > 1e-7 * self.scale for a, b in pairs)
        return apart and all(abs(z) > 1e-7 * self.scale for z in self.values)


def refutes(
    x: Examination, what: str, near: LinearMotion, verdict: Verdict, zeros: int, family: int = 0
) -> str:
    """Why a verdict cannot be right at this state; empty where it can.

    It belongs to a family of states of rest of the dimension `family`, along which V is constant.
    """
    if not near.regular:
        return _at_a_pole(near, verdict)
    judged = Judged(near, zeros)
    sides = () if zeros else near.sides  # nothing pushes along a coordinate that turns
    leaves, returns = 1 in sides, sides == (-1, -1)
    if verdict.stable and (judged.growing or leaves):
        return "a disturbance grows"
    damping = sum((row[i] for i, row in enumerate(near.slopes[1])), arb(0))
    conservative = (
        not (x.reference.pushed or zeros) and size(damping) < NOTHING
    )  # masses may grow with t
    free = not any(not row.holonomic for row in x.reference.rows)
    if verdict.asymptotic and free and not x.reference.pushed and size(damping) < NOTHING:
        return "nothing takes energy from a disturbance"
    definite = all(_positive(value) for value in eigenvalues(near.laws.mass_matrix))
    rising, falling = (sum(s * k > 1e-8 for k in near.stiffness) for s in (1, -1))
    across = len(near.stiffness) - family
    bowl = conservative and definite and free and rising == across and not falling
    restored = bowl or judged.oscillating or (conservative and definite and returns)
    if verdict.stable is False and restored and not leaves:
        return "no disturbance grows"
    minimum = _all_hold(x, what, near, verdict.minimum)
    saddle = conservative and definite and free and falling
    if minimum and (judged.growing or saddle):
        return "the potential has no minimum where it is said to have one"
    alone = len(judged.values) == 2 and judged.oscillating and not x.reference.pushed
    if minimum is False and (bowl or alone):
        return "the potential has a minimum where it is said to have none"
    hurwitz = _all_hold(x, what, near, verdict.hurwitz)
    if hurwitz and judged.growing:
        return "a disturbance grows where all roots are said to have negative real parts"
    if hurwitz is False and judged.damped:
        return "all roots have negative real parts where they are said not to"
    spectrum = _all_hold(x, what, near, verdict.spectrum)
    if spectrum and judged.growing:
        return "a frequency is not real where all are said to be"
    first_order = spectrum and not verdict.exact and verdict.minimum is None
    if first_order and bowl and rising and not x.reference.timed:
        return "the potential has a minimum there, and it is said to be stable to first order"
    if spectrum is False and judged.imaginary and judged.distinct:
        return "all frequencies are real where they are said not to be"
    unstable = held_at(x, what, near, verdict.unstable)
    if any(unstable) and (bowl or judged.oscillating):
        return "no disturbance grows where one is said to"
    return ""


def _at_a_pole(near: LinearMotion, verdict: Verdict) -> str:
    """The same where the inertia of a coordinate is 0, as that of the azimuth: by the potential.

    Only where L is even in the velocities and nothing but L acts.
    """
    x = near.x
    if x.reference.pushed or x.reference.rows or not all(map(_is_even, x.states())):
        return ""
    values = [k for k in near.curvatures if abs(k) > 1e-8]
    if verdict.stable and any(k < 0 for k in values):
        return "the potential has no minimum where it is said to be stable"
    if verdict.stable is False and values and all(k > 0 for k in values):
        return "the potential has a minimum where it is said to be unstable"
    return ""


def _is_even(state: State) -> bool:
    """Whether L is the same for opposite velocities."""
    names = state.reference.names
    back = {(n, 1): -state.environment[n, 1] for n in names}
    other = state.reference.values({**state.environment, **back})(state.reference.lagrangian)
    return compare(state.laws.lagrangian, other) is ComparisonVerdict.EQUAL


def _positive(z: complex) -> bool:
    return z.real > 1e-12


def _all_hold(
    x: Examination, what: str, near: LinearMotion, where: Sequence[Above] | None
) -> bool | None:
    """Whether all inequalities hold; None where nothing is claimed, or one is not decided."""
    if where is None:
        return None
    values = [near.at(place) for place in conditions(x, what, where)]
    if any(v < 0 for v in values):
        return False
    return True if all(v > 0 for v in values) else None
