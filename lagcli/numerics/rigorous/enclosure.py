r"""Steps of a validated Taylor method with Lohner's sets, computed with outward rounding.

The motion obeys x' = f(t, x), x = (q, v).  A step of length h starts from the set m + B r: m a
point, B a matrix of points, r a box.

1. p(s) = sum_{k<=K} c_k s^k is the Taylor polynomial of the solution from m, its coefficients
   enclosed.  Its defect p' - f(p) vanishes to the order s^(K-1), so

       |p' - f(p)| <= F s^K,    F = sum_{k=K}^{L-1} |F_k| h^(k-K) + |F_L| h^(L-K),

   F_k the Taylor coefficients of the defect at the beginning of the step, F_L at every s of it.
2. The error e = x - p of any solution from the set obeys e' = A(s) e - (p' - f(p)), where A(s) is a
   mean of J = df/dx on the segment from p to x.  With E the box in which e is supposed to stay,

       A(s) in sum_{k<Q} J_k s^k + J_Q s^Q,

   J_k from p + E at the beginning of the step, J_Q from p + E at every s of it.
3. With N >= |A| entry by entry, from J of p + E at every s of the step,
   |e(s)| <= exp(N h) (|B r| + h^(K+1)/(K+1) F).  Where that lies inside E, the solutions exist
   on the whole step and the supposition was right.
4. The flow of A is P(s) = sum_{k<=Q} P_k s^k up to h exp(N h) max |A P - P'|, so that

       x(h) in p(h) + (P(h) + D) B r + d,

   and B is turned by a QR decomposition, which keeps the wrapping of boxes small.

References
----------
R. Lohner, "Enclosing the solutions of ordinary initial and boundary value problems", in
Computerarithmetic (Teubner, 1987), 255.
N. Nedialkov, K. Jackson, G. Corliss, "Validated solutions of initial value problems for
ordinary differential equations", Appl. Math. Comput. 105 (1999) 21, sections 5 and 6.
F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE
Trans. Comput. 66 (2017) 1281.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from lagcli.numerics.integrators.taylor import log2_size
from lagcli.numerics.rigorous.field import VectorField
from lagcli.numerics.rigorous.piece import Piece, StepFlow
from lagcli.numerics.rigorous.sets import LohnerSet
from lagcli.numerics.rigorous.solution import around_zero, convolved, horner, sizes

#: Of the length at which the last coefficients say that the remainder is small enough.
_FIRST_TRY = 0.9
#: Bounds over a step are wide: they need no more bits.
_WIDE_BITS = 64
#: Q beside K.  The flow multiplies radii only: at the usual lengths its remainder is 1e-6 of it.
_FLOW_ORDER = 0.4
#: E beside the error at the beginning, at first, and then beside the growth in the last step.
_ROOM, _GROWN, _WIDEST, _TUBES = 1e3, 2.0, 1e9, 4
#: L - K beside K: what F_L overestimates weighs little then, and steps are nearly twice as long.
_AHEAD = 0.6
#: What D may be of P, on the errors at hand: 1000 steps widen them by a percent.
_LOST = 1e-5
#: Before a pulse a body at rest has moved by 1e-400: that is no scale.
_LEAST_SCALE, _AT_REST = 1e-6, 1e-24
_SHORTER, _LONGER, _LEAST_PART, _ATTEMPTS = 0.85, 1.02, 0.01, 120
#: Far from a narrow feature the last coefficients are 0 and say nothing of the length: a defect
#: that stays too large after _FEW attempts halves the step; the next begins at _FARTHER times it.
_FEW, _FARTHER = 4, 4.0
#: A step that is a smaller part of what the Taylor series allows comes to a set grown too wide, a
#: smaller part of the span to a singularity: a perihelion of 5e-8 needs 1e-13 of 14 units.
_SHORTEST, _SINGULAR = 1e-3, 1e-16
_LARGEST, _LONGEST = 1e15, 50.0  # the second is an exponent of 2
#: The bounds over a step hold a little longer: the ball of a time may lie across its end.
_BEYOND = 1 + 2.0**-20


class NotEnclosed(Exception):
    """Why no enclosure was found from here on."""


class ShortSteps(NotEnclosed):
    """The width of the set shortens the steps, which more bits may lengthen."""


class Singularity(NotEnclosed):
    """The Taylor series itself allows no step, which more bits do not change."""


class TriedStep:
    """A step that is tried.

    Attributes
    ----------
    begin, h : arb
    polynomials, along : sequences of sequences of arb
        Of q, v and the multipliers, about the beginning and about every time of the step.
    times : arb
        All those of the step.
    defect : sequence of arb
        F; empty until it is small enough.
    """

    def __init__(self, begin: Any, h: Any, polynomials: Sequence[Sequence[Any]]) -> None:
        self.begin, self.h, self.polynomials = begin, h, polynomials
        self.times: Any = None
        self.along: Sequence[Sequence[Any]] = ()
        self.defect: Sequence[Any] = ()


class Enclosures:
    """The steps of one proof.

    Parameters
    ----------
    field : VectorField
        f and J.
    order : int
        K.
    target : float
        What the remainder of a step may be beside the largest value of each component so far.
    peaks : list of float
        These values, which the proof goes on with.
    least : float
        Steps that are shorter, beside the length that the Taylor series allows, are not taken.
    """

    def __init__(
        self,
        field: VectorField,
        order: int,
        target: float,
        peaks: list[float],
        least: float = 0.0,
    ) -> None:
        from flint import arb, arb_mat, ctx

        self.field, self.order, self.target, self._least = field, order, target, least
        self._ball, self._matrix, self._context = arb, arb_mat, ctx
        self._peaks = peaks
        #: Q
        self.flow_order = round(_FLOW_ORDER * order)
        #: what the last steps were of the estimated length, and how long the last one was
        self._part, self._last = _FIRST_TRY, math.inf
        #: E of the next step beside the error at its beginning
        self._room: list[float] = []

    def step(self, t: Any, start: LohnerSet, until: Any) -> Piece:
        """A step from a set towards the end.

        Raises
        ------
        NotEnclosed
            Where no enclosure is found.
        """
        centre = self.field.coefficients(t, start.middle, self.order)
        if not all(c.is_finite() for each in centre for c in each):
            raise NotEnclosed("the equations are not defined at every point of the enclosure")
        self._peaks[:] = [
            max(peak, abs(float(each[0]))) for peak, each in zip(self._peaks, centre, strict=True)
        ]
        with self._context.workprec(_WIDE_BITS):
            end, flow = self._longest(t, start, until, centre)
        return Piece(t, end, centre, flow, start)

    def _longest(
        self, t: Any, start: LohnerSet, until: Any, centre: Sequence[Sequence[Any]]
    ) -> tuple[Any, StepFlow]:
        """The end of a step for which bounds are found, and these."""
        polynomials = [*centre, *self.field.forces(t, centre)]
        ahead = self.field.left([t, 1], polynomials, self.order, round((1 + _AHEAD) * self.order))
        allowed, wide = self._length(centre), False
        h = min(self._part * allowed, _FARTHER * self._last, float(until - t))
        for attempt in range(_ATTEMPTS):
            if h < max(wide * _SHORTEST * allowed, _SINGULAR * float(until)):
                break
            end = until if t + 1.05 * h >= until else self._ball(float(t + h))
            trial, flow = TriedStep(t, (end - t).abs_upper() * _BEYOND, polynomials), None
            with suppress(ZeroDivisionError, ValueError):
                if self._leaves_little(trial, ahead):
                    flow = self._flow(trial, start)
            if flow is not None:
                self._part = min(1.0, self._part * (_LONGER if attempt == 0 else 1.0))
                self._last = h
                if wide and self._part < self._least:
                    raise ShortSteps("the steps become too short")
                return end, flow
            if trial.defect:
                wide, self._room = True, []
            if wide or attempt < _FEW:
                h, self._part = _SHORTER * h, max(_LEAST_PART, _SHORTER * self._part)
            else:
                h /= 2
        if allowed < _SINGULAR / _SHORTEST * float(until):
            raise Singularity("the motion comes to a singularity")
        raise NotEnclosed("no enclosure was found over any step: the set has grown too wide")

    @property
    def scales(self) -> list[float]:
        """The largest value of each component so far, or a small part of the largest of all."""
        largest = max(self._peaks)
        least = _LEAST_SCALE * (largest if largest > _AT_REST else 1.0)
        return [max(peak, least) for peak in self._peaks]

    def _length(self, centre: Sequence[Sequence[Any]]) -> float:
        """A length at which the term after the last is about the target."""
        exponent = math.inf
        for each, scale in zip(centre, self.scales, strict=True):
            for k in (self.order, self.order - 1):
                allowed = math.log2(self.target) + math.log2(scale)
                exponent = min(exponent, (allowed - log2_size(each[k])) / k)
        return math.exp2(min(exponent, _LONGEST))

    def _leaves_little(self, trial: TriedStep, ahead: Sequence[Any]) -> bool:
        """Find its defect; whether that is about the target."""
        trial.times, trial.along = self.field.shifted(trial.begin, trial.h, trial.polynomials)
        defect = self.field.defect(trial.times, trial.along, ahead, trial.h)
        if all(d < 8 * self.target * x for d, x in zip(defect, self.scales, strict=True)):
            trial.defect = defect
        return bool(trial.defect)

    def _flow(self, trial: TriedStep, start: LohnerSet) -> StepFlow | None:
        """The flow, where a tube E is found in which the errors stay."""
        h, defect = trial.h, trial.defect
        whole = [x + d for x, d in zip(start.spread, defect, strict=True)]
        column = self._matrix(len(whole), 1, whole)
        room = self._room or [_ROOM] * len(whole)
        tube = [
            a * x + self.target * scale
            for a, x, scale in zip(room, whole, self.scales, strict=True)
        ]
        for _ in range(_TUBES):
            slopes, bound = self._slopes(trial, tube)
            if not all(x < _LARGEST for x in (bound * h).entries()):
                return None
            grown = (bound * h).exp()
            errors = (grown * column).entries()
            if all(x < e for x, e in zip(errors, tube, strict=True)):
                self._room = [
                    min(_GROWN * float(e / x), _WIDEST) if x > 0 else _ROOM
                    for e, x in zip(errors, whole, strict=True)
                ]
                return self._bounded(slopes, grown, h, defect, column)
            tube = [e.max(2 * x.abs_upper()) for x, e in zip(errors, tube, strict=True)]
            if not all(x < _LARGEST for x in tube):
                return None
        return None

    def _slopes(self, trial: TriedStep, tube: Sequence[Any]) -> tuple[list[Any], Any]:
        """da/dx as J_0 .. J_Q, and N."""
        room = [self._ball(0, e) for e in tube]
        order = self.flow_order
        at_start, anywhere = (
            [[c[0] + e, *c[1:length]] for c, e in zip(polynomials, room, strict=False)]
            for polynomials, length in ((trial.polynomials, order), (trial.along, order + 1))
        )
        slopes = self.field.system.slopes
        found = slopes([trial.begin, 1], at_start, order)
        first, *_, last = slopes([trial.times, 1], anywhere, order + 1)
        return [*found, last], sizes(self.field.with_velocities(first))

    def _bounded(
        self, slopes: Sequence[Any], grown: Any, h: Any, defect: Sequence[Any], whole: Any
    ) -> StepFlow | None:
        """P from the middles of J_k; D from the defect A P - P'; None where D is no small part."""
        n, size, order = self.field.n, len(defect), self.flow_order
        middles = [m.mid() for m in slopes]
        found = [self._matrix(size, size, 1)]
        for k in range(order):
            found.append((self._rate(middles, found, k) / (k + 1)).mid())
        rest = [
            self._rate(slopes, found, k) - (k + 1) * found[k + 1]
            if k < order
            else self._rate(slopes, found, k)
            for k in range(2 * order + 1)
        ]
        over = self._ball(0, h)
        error = grown * sizes(horner(rest, over)) * h
        lost, kept = (
            (error * whole).entries(),
            (sizes(horner(found, over)) * whole).entries(),
        )
        least = self.target * max(self.scales)
        kinds = (slice(0, n), slice(n, None))
        if not all(_largest(lost[k]) <= _LOST * _largest(kept[k]) + least for k in kinds):
            return None
        moved = grown * self._matrix(size, 1, list(defect))
        return StepFlow(found, around_zero(error), around_zero(moved))

    def _rate(self, slopes: Sequence[Any], flow: Sequence[Any], k: int) -> Any:
        """The k-th coefficient of A P: below what the velocities have, da/dx P."""
        size = flow[0].ncols()
        above = flow[k].entries()[size * size // 2 :] if k < len(flow) else [0] * (size * size // 2)
        return self._matrix(size, size, above + convolved(slopes, flow, k).entries())


def _largest(bounds: Sequence[Any]) -> Any:
    found = bounds[0]
    for x in bounds[1:]:
        found = found.max(x)
    return found
