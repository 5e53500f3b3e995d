"""What every method gives: steps whose inside can be looked into, under one tolerance."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, Protocol

from lagcli.numerics.equations.motion import Motion

#: q, q' and the slope of q' at a time within the step
Inside = Callable[[float], tuple[list[Any], list[Any], list[Any]]]

#: One that is smaller than this part of the largest of its kind may be rounding.
SMALL = 1e-9
#: A component that is nothing but rounding beside the others is left alone.
_NOISE = 1e-10
_FAILURES = 20
_SAFETY, _SHRINK, _GROW = 0.9, 0.2, 6.0
#: A step may be as short as this part of the time that has passed (or of the span).
_SHORTEST = 4e-16
_LEAST_FLOOR, _ROUNDING = 1e-6, 1e-16


#: The change in a first step, beside the value, and its exponent of the tolerance: an order of 8.
_SMALL, _BY_TOLERANCE = 0.1, 0.125
#: Why steps become shorter and shorter where the coordinates fail.
SINGULAR_MASS = (
    "it comes to where the mass matrix is singular, as with Euler angles upright: "
    "take other coordinates there"
)
#: Why they do where a linkage is flat.
DEPENDENT = "it comes to where the constraints become dependent and branches of the motion may meet"


class Step(NamedTuple):
    """From `start` over h to `end`; q and v are the state at the end.

    `probe` is `inside` with a slope that is not that of the equations themselves.
    """

    start: float
    h: float
    end: float
    q: list[Any]
    v: list[Any]
    inside: Inside
    probe: Inside | None = None


class Stretch(NamedTuple):
    """From a state at `begin` to a time."""

    q: list[Any]
    v: list[Any]
    until: float
    begin: float = 0.0


class StepSize:
    """The length of the next step, by the error of the last in units of the tolerance.

    Parameters
    ----------
    h
        Of the first step.
    power
        Of the length, with which the error goes.
    until
        The end.

    References
    ----------
    Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.4.
    """

    def __init__(self, h: float, power: int, until: float) -> None:
        self.h, self._power, self._until = h, power, until
        self.is_shortened = False

    def from_time(self, t: float) -> tuple[float, bool]:
        """The length of a step from t, and whether it is the last."""
        last = t + 1.01 * self.h >= self._until
        self.h = self._until - t if last else self.h
        return self.h, last

    def is_nothing(self, error: float, t: float) -> bool:
        """Shorten it after an error that is too large; whether nothing is left of it."""
        self.h *= max(_SHRINK, self._factor(error))
        self.is_shortened = True
        return self.h <= _SHORTEST * max(t, 1e-3 * self._until)

    def grow(self, error: float, longest: float) -> None:
        """Change it after a step that was accepted."""
        most = 1.0 if self.is_shortened else _GROW
        self.h = min(self.h * min(most, max(_SHRINK, self._factor(error))), longest)
        self.is_shortened = False

    def _factor(self, error: float) -> float:
        return _SAFETY * error ** (-1 / self._power) if error else _GROW


class CannotGoOn(ArithmeticError):
    """No step is short enough: the solution ends, or what acts on it does, at t."""

    def __init__(self, t: float, q: Sequence[Any], v: Sequence[Any], reason: str) -> None:
        super().__init__(reason)
        self.t, self.q, self.v, self.reason = float(t), list(q), list(v), reason


class StopWithReason(CannotGoOn):
    """The reason says all: the accelerations have nothing to add."""


class Grazes(StopWithReason):
    """Whether a contact is struck is within the error."""


class NotPossible(Exception):
    """The method is not for this problem, which it finds out on the way; the sentence says why.

    Attributes
    ----------
    needs_digits
        Whether the same equations with more digits may go on.
    """

    needs_digits = False


class Tolerance:
    """How much a step may err in each component: a part of that component's peak.

    Parameters
    ----------
    value
        The part.
    n
        Coordinates; there are 2 n components.
    span
        Of time; a coordinate's peak over it is the least scale of its velocity.
    longest
        The longest step.
    peaks
        Of an earlier run; without them they are those seen so far.
    floor
        A component smaller than this part of the largest is taken for rounding.
    """

    def __init__(
        self,
        value: float,
        n: int,
        span: float,
        longest: float,
        peaks: Sequence[float] | None = None,
        floor: float = 0.0,
    ) -> None:
        self.value, self.n, self.span, self.longest = value, n, span, longest
        #: whether the run is that of a problem a rounding beside
        self.moved = False
        #: the rounding of the numbers, in that of doubles
        self.unit = 1.0
        self.known = peaks is not None
        self.peaks = list(peaks) if peaks is not None else [0.0] * (2 * n)
        self._floor = floor
        self._failures = 0
        self._earlier: list[float] | None = None
        self.scales = [1.0] * (2 * n)
        self._rescale()

    def see(self, q: Sequence[float], v: Sequence[float], change: Sequence[float]) -> None:
        """Note a state and the state after it."""
        self._earlier = None
        for j, (x, d) in enumerate(zip((*q, *v), change, strict=True)):
            size = max(abs(x), abs(x + d))
            if size > self.peaks[j]:
                self._earlier = self._earlier or self.peaks[:]
                self.peaks[j] = size
        if self._earlier:
            self._rescale()

    def forget(self) -> None:
        """Take back the last state after: its step was not taken."""
        if self._earlier:
            self.peaks[:] = self._earlier
            self._earlier = None
            self._rescale()

    def _rescale(self) -> None:
        """The peaks; a velocity's is at least its coordinate's over the span, and back."""
        n, peaks = self.n, self.peaks
        floor = self._floor * max(peaks) or 1e-300
        for j in range(n):
            self.scales[j] = max(peaks[j], floor, 1e-3 * self.longest * peaks[n + j])
            self.scales[n + j] = max(peaks[n + j], floor, peaks[j] / self.span)

    def first_step(self, stretch: Stretch, rate: Sequence[float], least: float) -> float:
        """A step in which the state changes by a small part of itself.

        Parameters
        ----------
        least
            Of the longest step, this part at least.
        """
        q, v, until, begin = stretch
        self.see(q, v, [0.0] * (2 * self.n))
        h = self.longest
        # were it the same at all tolerances, so would be the steps of two runs that grow from it
        small = _SMALL * self.value**_BY_TOLERANCE
        for x, dx in (*zip(q, v, strict=True), *zip(v, rate, strict=True)):
            if dx and x:
                h = min(h, small * abs(x / dx))
        return min(max(h, least * self.longest), until - begin)

    def rejected(self, errors: Sequence[float]) -> None:
        """Note which component a step failed by; one that is rounding fails again and again."""
        top = max(self.peaks)
        ratios = [abs(x) / scale for x, scale in zip(errors, self.scales, strict=True)]
        if self.peaks[ratios.index(max(ratios))] < _NOISE * top:
            self._failures += 2
            if self._failures >= _FAILURES:
                self._floor = max(_LEAST_FLOOR, min(1.0, _ROUNDING / self.value))
                self._failures = 0
                self._rescale()

    def accepted(self) -> None:
        """A step has succeeded: a component that is resolved fails now and then only."""
        self._earlier = None
        self._failures = max(0, self._failures - 1)


def moved(
    q: Sequence[float], v: Sequence[float], change: Sequence[float]
) -> tuple[list[float], list[float]]:
    """q and v after a change of both."""
    ends = [x + d for x, d in zip((*q, *v), change, strict=True)]
    return ends[: len(q)], ends[len(q) :]


def with_own_time(peaks: Sequence[Any], span: float) -> list[float]:
    """The peaks; that of a velocity is at least its coordinate's over the span."""
    sizes, n = [*map(float, peaks)], len(peaks) // 2
    return [*sizes[:n], *(max(x / span, v) for x, v in zip(sizes[:n], sizes[n:], strict=True))]


def component_tops(sizes: Sequence[float]) -> list[float]:
    """The largest of its kind beside each component."""
    n = len(sizes) // 2
    return [max(sizes[:n], default=0.0)] * n + [max(sizes[n:], default=0.0)] * n


def component_scales(peaks: Sequence[Any], span: float) -> list[float]:
    """What each component is known beside: that of its kind where it is rounding."""
    sizes = with_own_time(peaks, span)
    return [
        x if x > SMALL * top else top for x, top in zip(sizes, component_tops(sizes), strict=True)
    ]


class MotionOfMode(Protocol):
    """What a method needs of the mode that it integrates."""

    @property
    def motion(self) -> Motion:
        """The equations that act."""

    generated: Any  # what the method has made for them, once


class Method(Protocol):
    """An integrator."""

    name: str
    reached: int | None  # the kink at which friction has stopped the steps
    sees: bool  # whether its steps pass over nothing: see `compiled.unseen`
    even: bool  # whether its steps are of one length

    @property
    def evaluations(self) -> int:
        """Of the accelerations, so far."""

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Accepted steps."""
