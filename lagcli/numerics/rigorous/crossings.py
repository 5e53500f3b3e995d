r"""Where a function of the state changes its sign, proved; and the set behind it.

A function g(t, x) is watched over a step in intervals of time: where its enclosure keeps its sign,
nothing happens; where its rate along the motion keeps its sign, it has one zero or none, by the
sign at the end; else the interval is halved.  The time tau of a zero is enclosed by Newton's
method for intervals.

Behind a crossing the motion goes on with other equations f+, from the state x+ = R(t, x).  All is
referred to one time s near tau: the map psi from the state that the old equations have at s to the
one that the new equations have at s is, up to the flows over |tau - s|,

    psi(x) = R(tau, x + (tau - s) f-) - (tau - s) f+,
    Dpsi = dR/dt dtau + DR (1 + f- dtau) - f+ dtau,    dtau = -grad g / (dg/dt + grad g . f-),

the saltation matrix.

References
----------
R. Leine, H. Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical Systems* (2004),
section 7.
R. Moore, R. Kearfott, M. Cloud, *Introduction to Interval Analysis* (2009), section 8.1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.rigorous.enclosure import NotEnclosed
from lagcli.numerics.rigorous.field import VectorField
from lagcli.numerics.rigorous.piece import Piece
from lagcli.numerics.rigorous.sets import LohnerSet
from lagcli.numerics.rigorous.solution import around_zero, sizes
from lagcli.record import record

#: Intervals of a step that are a smaller part of its length are not halved.
_SHORTEST = 1e-12
#: They are divided where no simple fraction of a step is: events are often there.
_PART = 0.4656
_NEWTON = 30
#: A trial box is wider by _ROOM, and found in _WIDENED rounds.
_ROOM, _WIDENED = 4, 3


@record
class Watched:
    """A function that is positive while a mode lasts.

    Attributes
    ----------
    kind, index
        "kink", "slip", "gap", "force" or "stop", and of which.
    name : str
        As the events have it.
    sign : int
        Of g in this mode.
    value : function
        Of t and the state: g, dg/dt, then the gradient.
    """

    kind: str
    index: int
    name: str
    sign: int
    value: Callable[..., Sequence[Any]]

    def at(self, t: Any, x: Sequence[Any]) -> Any:
        """sign * g."""
        return self.sign * self.value(t, *x)[0]

    def rate(self, field: VectorField, t: Any, x: Sequence[Any]) -> Any:
        """The rate of sign * g along the motion."""
        _, explicit, *gradient = self.value(t, *x)
        along = sum((a * b for a, b in zip(gradient, field.rate(t, x), strict=True)), explicit)
        return self.sign * along

    def term(self, field: VectorField, t: Any, x: Sequence[Any], order: int) -> Any:
        """The Taylor coefficient of sign * g along the motion."""
        if order < 2:
            return self.rate(field, t, x) if order else self.at(t, x)
        series = field.coefficients(t, x, order)
        return self.sign * field.system.evaluated(self.value, [t, 1], series, order + 1)[0][order]


#: What a watched function does where it becomes 0.
_WHAT = {
    "kink": "passes 0", "slip": "slips", "gap": "closes", "force": "is lost", "stop": "holds",
}  # fmt: skip


class UndecidedCrossing(NotEnclosed):
    """Whether something becomes 0 at a time is not decided."""

    def __init__(self, watched: Watched, t: Any) -> None:
        what = _WHAT[watched.kind]
        super().__init__(f"whether {watched.name} {what} near t = {float(t):.6g} is not decided")
        self.t = t


@record
class Restart:
    """What follows a crossing at once: R and (dR/dt, DR), as functions of t and the state."""

    state: Callable[[Any, Sequence[Any]], list[Any]]
    jacobian: Callable[[Any, Sequence[Any]], Any]


def when(piece: Piece, field: VectorField, watched: Watched, begun: int = 0) -> Any:
    """The time of the first zero within a step, enclosed; None where there is none.

    Parameters
    ----------
    begun : int
        The order of the zero of g at the beginning of the step, which the motion leaves.

    Raises
    ------
    UndecidedCrossing
        Where it is open whether there is one.
    """
    pending = [(piece.begin, piece.end, begun)]
    shortest = _SHORTEST * (piece.end - piece.begin)
    while pending:
        a, b, leaves = pending.pop()
        whole = a.union(b)
        state = piece.at(whole)
        if watched.at(whole, state) > 0:
            continue
        rate = watched.rate(field, whole, state)
        # the mean value form: on a slope the terms of a gap change far more than their sum
        if watched.at(whole.mid(), piece.at(whole.mid())) + rate * (whole - whole.mid()) > 0:
            continue
        last = watched.at(b, piece.at(b))
        if last > 0 and watched.term(field, whole, state, max(leaves, 1)) > 0:
            continue
        if rate < 0 and not leaves:
            if last > 0:
                continue
            if last < 0:
                return _newton(piece, field, watched, whole)
        if not b - a > shortest:
            raise UndecidedCrossing(watched, b)
        middle = (a + _PART * (b - a)).mid()
        pending += [(middle, b, 0), (a, middle, leaves)]
    return None


def _newton(piece: Piece, field: VectorField, watched: Watched, bracket: Any) -> Any:
    """The only zero within a bracket."""
    for _ in range(_NEWTON):
        t = bracket.mid()
        slope = watched.rate(field, bracket, piece.at(bracket))
        if not slope < 0:
            return bracket
        found = bracket.intersection(t - watched.at(t, piece.at(t)) / slope)
        if not found.rad() < bracket.rad() / 2:
            return found
        bracket = found
    return bracket


def behind(
    piece: Piece,
    tau: Any,
    watched: Watched,
    fields: tuple[VectorField, VectorField],
    restart: Restart,
) -> tuple[LohnerSet, Any, list[Any]]:
    """What follows a crossing at tau.

    Returns
    -------
    LohnerSet
        From which the new equations go on at s, the middle of tau.
    arb
        Times about s in which the crossings of all solutions near the set lie.
    list of arb
        Where solutions of the new equations are at these times.
    """
    old, new = fields
    s = tau.mid()
    before = piece.start.moved(piece.middle(s), piece.derivative(s))
    late, matrix, n = tau - s, type(before.frame), len(before.middle)
    for _ in range(_WIDENED):
        times = s + late
        box, flow = _moved(old, times, before.box, late)
        _, explicit, *gradient = watched.value(times, *box)
        row, column = matrix(1, n, gradient), matrix(n, 1, old.rate(times, box))
        rate = (row * column)[0, 0] + explicit
        delays = -watched.value(s, *before.box)[0] / rate
        if late.contains(delays):
            break
        late = late.union(2 * delays)
    else:
        raise NotEnclosed(f"the time of the event near t = {float(tau):.6g} is not enclosed")
    struck = restart.state(times, box)
    after, back = _moved(new, times, struck, late)
    f = matrix(n, 1, new.rate(times, after))
    delayed = row / -rate  # dtau/dx
    places = column * delayed + matrix(n, n, 1)
    along = matrix(n + 1, n, [*delayed.entries(), *places.entries()])
    derivative = back * (restart.jacobian(times, box) * along - f * delayed) * flow
    delay = -watched.value(s, *before.middle)[0] / rate
    middle = matrix(n, 1, before.middle) + column * delay
    ends = matrix(n, 1, restart.state(s + delay, middle.entries())) - f * delay
    return before.moved(ends.entries(), derivative), times, after


def _moved(field: VectorField, times: Any, box: Sequence[Any], late: Any) -> tuple[list[Any], Any]:
    """Where solutions from a box are over a short time, and the derivative of their flow."""
    room = list(box)
    for _ in range(_WIDENED):
        change = field.rate(times, room)
        room = [x + _ROOM * late * f for x, f in zip(box, change, strict=True)]
    found = [x + late * f for x, f in zip(box, field.rate(times, room), strict=True)]
    if not all(y.contains(x) for x, y in zip(found, room, strict=True)):
        raise NotEnclosed(f"no enclosure was found at the event near t = {float(times):.6g}")
    jacobian = field.jacobian(times, room)
    identity = type(jacobian)(len(box), len(box), 1)
    grown = (sizes(jacobian) * late.abs_upper()).exp()
    return room, identity + around_zero(grown - identity)
