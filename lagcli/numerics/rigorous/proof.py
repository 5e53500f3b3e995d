"""A motion proved: bits and order raised until the enclosures are as thin as requested."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.rigorous.accumulation import rest_after
from lagcli.numerics.rigorous.crossings import UndecidedCrossing, Watched, behind, when
from lagcli.numerics.rigorous.enclosure import NotEnclosed, ShortSteps, Singularity
from lagcli.numerics.rigorous.initial import initial_state, setup_of
from lagcli.numerics.rigorous.modes import ProofMode, ProofModes
from lagcli.numerics.rigorous.piece import Piece
from lagcli.numerics.rigorous.result import Proof
from lagcli.numerics.rigorous.rows import Rows
from lagcli.numerics.rigorous.sets import LohnerSet, around
from lagcli.problem_data import Problem

#: Bits of the first attempt and of the last; the order beside those of the remainder, from a scan.
_BITS, _MOST_BITS, _ORDER = 64, 640, 0.43
#: The remainder of a step lies _REMAINDER bits below those kept, and constants, states and the
#: coefficients that weigh have _GUARD more: the pendulum's radius at t = 20 is 0.0008 units of the
#: last bit kept.  With all in 12 bits more and a remainder 10 below it is 3, and a third slower.
#: Of the 88 bits of the state these are 5,153 units (13,890 of the velocity); one rounding of the
#: state to as many bits in each of the 141 steps, as the flow carries it on, makes 130 (457) alone.
_GUARD, _REMAINDER = 24, 20
#: Nodes of f and J that are evaluated to order 28, all attempts together: some 10 minutes.
_WORK = 2e6
#: With fewer bits than _PATIENT an attempt ends where the width of the set makes steps shorter
#: than _SHORT of what the Taylor series allows: Andrews' squeezer takes 10 times as many in 80.
_PATIENT, _SHORT, _MORE_BITS = 160, 0.1, 48
#: More bits help where the enclosures are wider than this part of the accuracy.
_NARROW = 1e-3
#: And where the last ones have brought the proof so much farther.
_GAIN = 1.02
#: An attempt ends where they are wider by this factor: what it lacks is known.
_LOST = 1e3
#: A loss of digits is taken to go on as it began, over at most this multiple of the time.
_FARTHEST = 8
#: Fewer bits than these are raised where impacts accumulate: on a slope each widens the set.
_ACCUMULATED = 240
#: Impacts that are over within this part of the span, or of the span and the accuracy, are bounded
#: together: much shorter flights are not enclosed one by one.
_REST, _REST_PART = 1e-11, 1e-2
#: Of a step whose end is at an event.
_SHORTER = 0.8
#: Where something may happen at the very end, steps go farther.
_BEYOND = 1.0625
#: Bits beyond those that are lost and those that are wanted.
_SPARE = 8

_WIDE = "the enclosures are wider than the accuracy {:g}"

#: Time, set, mode, and the orders of what is 0 there.
Following = tuple[Any, LohnerSet, ProofMode, Mapping[Watched, int]]


def prove(
    problem: Problem,
    request: RunRequest,
    progress: Progress = None,
    attempts: type[ProofAttempt] | None = None,
    work: float = _WORK,
) -> Proof:
    """Enclose a motion.

    Parameters
    ----------
    problem : Problem
        With values for its parameters and an initial state: exact numbers, as they are written.
    request : RunRequest
        Span, accuracy and columns.
    progress : function, optional
        Called with the part of the span that is enclosed.
    attempts : type, optional
        `ProofAttempt`, or `Shadowing`.
    work : float
        The most that is done, in the unit of _WORK.

    Returns
    -------
    Proof
        Its rows end where the enclosures are wider than the accuracy.

    Raises
    ------
    Refusal
        When the motion is of a kind that is not enclosed.
    """
    from flint import ctx

    setup, implied = setup_of(problem, request)
    best: Proof | None = None
    bits = _BITS
    last = 0.0
    while True:
        kind = attempts or ProofAttempt
        with ctx.workprec(bits + _GUARD):
            attempt = kind(setup, implied, bits, work, progress)
            found = attempt.proof()
        best = found if best is None or found.holds_until >= best.holds_until else best
        work -= attempt.work
        bits = attempt.bits_needed()
        if found.reached or not 0 < bits <= _MOST_BITS or work <= 0 or attempt.last < _GAIN * last:
            return best
        last = 0.0 if attempt.short or attempt.excess > 1 else attempt.last


class ProofAttempt:
    """One proof at a given precision, with the order that suits it."""

    def __init__(
        self,
        setup: Setup,
        implied: frozenset[int],
        bits: int,
        most: float,
        progress: Progress,
    ) -> None:
        self.setup, self.implied, self.bits, self.most = setup, implied, bits, most
        self.progress = progress
        self.order = int(_ORDER * (bits + _REMAINDER))
        self.arithmetic = Balls()
        self.steps, self.work = 0, 0.0
        self.refusal = ""
        self.within: float | None = None
        self.assumed = ["the file as it is written", "the interval arithmetic of python-flint"]
        #: radius beside the scale of a component, the largest, at the last time
        self.width = 0.0
        self.last = 0.0
        self.short, self.excess, self.singular = False, 0.0, False
        self.rows = Rows(setup, self.arithmetic)

    def proof(self) -> Proof:
        """The rows up to where they are proved."""
        try:
            self._go()
        except NotEnclosed as reason:
            self.refusal, self.short = str(reason), isinstance(reason, ShortSteps)
            self.singular = isinstance(reason, Singularity)
            if isinstance(reason, UndecidedCrossing) and self.rows.impacts_accumulate():
                self.refusal += ", where impacts accumulate: what follows them is not enclosed"
                self.short = self.bits < _ACCUMULATED
        except (ArithmeticError, ValueError, OverflowError) as reason:
            self.refusal = f"the equations are not defined on the enclosure: {reason}"
        request = self.setup.request
        rows = self.rows
        good, self.excess = rows.good()
        reached = good == len(rows.times)
        if good < len(rows.found):
            self.refusal = _WIDE.format(request.accuracy)
        last = rows.times[good - 1] if good else 0.0
        holds = float(last)
        return Proof(
            columns=tuple(column.name for column in request.columns),
            rows=tuple(rows.found[:good]),
            accuracy=request.accuracy,
            reached=reached,
            holds_until=holds,
            bits=self.bits + _GUARD,
            kept=self.bits,
            order=self.order,
            steps=self.steps,
            assumed=tuple(self.assumed),
            events=tuple(e for e in rows.events if not e.t > last),
            refusal="" if reached else f"proved until t = {holds:g}: {self.refusal}",
            within=self.within,
        )

    def bits_needed(self) -> int:
        """For the whole span, by what was lost so far; 0 where more do not help."""
        accuracy, until = self.setup.request.accuracy, self.setup.request.until
        if self.singular:
            return 0
        if self.short:
            return self.bits + _MORE_BITS
        if self.rows.complete and 1 < self.excess < math.inf:
            return self.bits + math.ceil(math.log2(self.excess)) + 2 * _SPARE
        if not (self.excess > 1 or self.width > _NARROW * accuracy):
            return 0
        finest = self.bits + _REMAINDER
        lost = max(1.0, finest + math.log2(max(self.width, 2.0**-finest)))
        share = until / max(self.last, until / _FARTHEST)
        wanted = lost * share - math.log2(accuracy) + _SPARE - _REMAINDER
        return max(self.bits + 32, 16 * math.ceil(wanted / 16))

    def _go(self) -> None:
        t, start, mode, leaving = self._begin()
        self.rows.take(mode, t, start.box)
        for k in mode.stuck:
            self.rows.happened(t, mode.equations.kink_name(k), "sticks", mode, start.box)
        following: Following | None = (t, start, mode, leaving)
        while following is not None and not self.rows.complete:
            following = self._through_mode(*following)

    def _begin(self) -> Following:
        """The initial state and its mode."""
        setup, ball = self.setup, self.arithmetic.ball
        constants = constants_of(setup.equations, setup.all_nodes, self.arithmetic)
        modes = ProofModes(
            setup,
            constants,
            self.arithmetic,
            self.implied,
            self.order,
            2.0 ** -(self.bits + _REMAINDER),
            _SHORT if self.bits < _PATIENT else 0.0,
        )
        first = modes(setup.given, [1] * len(setup.equations.kinks))
        state, assumed = initial_state(first.motion, setup.start)
        self.assumed += assumed
        self._name_implied()
        t, start = ball(0), around(state)
        if setup.stop is not None:
            modes.stop_sign = first.sign_of_stop(t, state)
            first.__dict__.pop("watched")
        found = modes.at_first(t, state)
        self.assumed += modes.assumed
        return t, start, *found

    def _name_implied(self) -> None:
        """Constraints that others imply at the beginning are taken to be implied all the way."""
        if self.implied:
            self.assumed.append(f"the other constraints imply {', '.join(self._implied_names)}")

    def _look_at_implied(self, piece: Piece, mode: ProofMode) -> None:
        """The end of the proof where what is taken to be implied is violated."""
        if not all(x.contains(0) for x in mode.implied(piece.end, *piece.at(piece.end))):
            names, t = ", ".join(self._implied_names), float(piece.end)
            raise NotEnclosed(f"near t = {t:.6g} the other constraints do not imply {names}")

    @property
    def _implied_names(self) -> list[str]:
        return [self.setup.whole.constraints[k].name for k in sorted(self.implied)]

    def _through_mode(
        self, t: Any, start: LohnerSet, mode: ProofMode, leaving: Mapping[Watched, int]
    ) -> Following | None:
        """Rows until the mode ends or the span does; what follows."""
        while not self.rows.complete:
            piece, crossed = self._step(mode, t, start, leaving)
            self.rows.over(piece, mode, None if crossed is None else crossed[1])
            self._count(piece, mode)
            if crossed is not None:
                return self._cross(piece, mode, *crossed)
            t, start, leaving = piece.end, piece.at_end(), {}
        return None

    def _step(
        self, mode: ProofMode, t: Any, start: LohnerSet, leaving: Mapping[Watched, int]
    ) -> tuple[Piece, tuple[Watched, Any] | None]:
        """A step and what ends it; a shorter one where its end is at an event."""
        last = self.rows.times[-1].upper()
        piece = mode.enclosures.step(t, start, last * _BEYOND if mode.watched else last)
        try:
            return piece, self._crossing(piece, mode, leaving)
        except UndecidedCrossing as reason:
            if not reason.t >= piece.end:
                raise
            piece = piece.first_part(_SHORTER)
            return piece, self._crossing(piece, mode, leaving)

    def _crossing(
        self, piece: Piece, mode: ProofMode, leaving: Mapping[Watched, int]
    ) -> tuple[Watched, Any] | None:
        """What becomes 0 first in a step, and when."""
        found = []
        for each in mode.watched:
            time = when(piece, mode.field, each, leaving.get(each, 0))
            if time is not None:
                found.append((each, time))
        found.sort(key=lambda pair: float(pair[1]))
        if len(found) > 1 and not found[0][1] < found[1][1]:
            at = float(found[0][1])
            raise NotEnclosed(f"two events come together near t = {at:.6g}: their order is open")
        return found[0] if found else None

    def _cross(self, piece: Piece, mode: ProofMode, watched: Watched, tau: Any) -> Following | None:
        """What follows an event; None where the motion stops there."""
        state, ends = piece.at(tau), mode.ends(watched)
        if ends:
            self.rows.happened(tau, watched.name, ends, mode, state)
            self.rows.end_at(tau)
            self.rows.take(mode, tau, state)
            return None
        after, restart, what = mode.through(watched, tau, state)
        if what != "switch":
            self.rows.happened(tau, watched.name, what, mode, state)
        for t in self.rows.times[len(self.rows.found) :]:
            tau = tau.union(t) if t.overlaps(tau) else tau
        start, times, box = behind(piece, tau, watched, (mode.field, after.field), restart)
        self.rows.within(times, (mode, piece.at(times)), (after, box))
        leaves = {each: order for each in after.watched if (order := _order(each, watched))}
        for each in after.watched:
            if not each.term(after.field, times, box, leaves.get(each, 0)) > 0:
                raise NotEnclosed(f"what {each.name} does at t = {float(tau):.6g} is not decided")
        if what == "impact" and after.held == mode.held:
            part = max(_REST, _REST_PART * self.setup.request.accuracy)
            most = part * float(self.rows.times[-1])
            rest = rest_after(watched, after, restart, times, box, most)
            if rest is not None:
                self.rows.happened(rest.times, watched.name, "comes to rest", after, rest.box)
                self.rows.within(rest.times, (after, rest.box), (rest.mode, rest.box))
                return rest.times.upper(), around(rest.end), rest.mode, {}
        return tau.mid(), start, after, leaves

    def _count(self, piece: Piece, mode: ProofMode) -> None:
        self.steps += 1
        self.last = float(piece.end)
        self.work += mode.field.system.cost * (self.order / 28) ** 2
        scales = mode.enclosures.scales
        self.width = max(
            float(x) / scale for x, scale in zip(piece.start.spread, scales, strict=True)
        )
        if self.progress is not None:
            self.progress(self.last / self.setup.request.until)
        if self.implied:
            self._look_at_implied(piece, mode)
        if self.width > self.setup.request.accuracy * _LOST:
            raise NotEnclosed(_WIDE.format(self.setup.request.accuracy))
        if self.work > self.most:
            raise NotEnclosed(f"the limit of work is reached, after {self.steps} steps")


def _order(each: Watched, crossed: Watched) -> int:
    """The order of its zero at an event.

    A contact is lost with gap, speed and force 0, what slips begins with speed and force 0.
    """
    if each.index != crossed.index or crossed.kind == "stop":
        return 0
    lost = {("force", "gap"): 3, ("slip", "kink"): 2}
    return lost.get((crossed.kind, each.kind), int(each.kind == crossed.kind))
