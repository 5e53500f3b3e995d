"""From one mode to the next: what follows when a condition fails."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.numerics.hybrid.events import Event, Occurrence
from lagcli.numerics.hybrid.friction import StuckMotion, stopped
from lagcli.numerics.hybrid.impact import UNRESOLVED, Hinge, flight_of, rests
from lagcli.numerics.hybrid.modes import Mode, Modes
from lagcli.numerics.integrators.steps import Grazes, StopWithReason
from lagcli.record import field, record

Vector = list[Any]

#: Bounces are over when what is left of them is this part of the accuracy.
_REST = 0.02
#: A gap that begins within this multiple of the rounding is closed; below it, the state is refused.
_TOUCHING = 1e-12
#: A gap below this multiple of the rounding of the state is closed while others are.
_NEAR = 100.0
#: Two speeds that differ by less come to rest together, when they strike together.
_SAME = 4.0
_STANDS = 1e-12
#: So many roundings away.
_BESIDE = 8


@record(kw_only=True)
class Turn:
    """How the motion goes on.

    Attributes
    ----------
    mode
        None where the run ends.
    apex
        When the first of what bounces is highest, as its acceleration has it.
    due
        When a bounce that is too low to be seen closes again, and which.
    """

    q: Vector
    v: Vector
    mode: Mode | None
    events: tuple[Event, ...] = ()
    apex: float = math.inf
    due: tuple[float, int] | None = None
    touched: Occurrence | None = field(default=None)
    #: the state right after the event, which lies between two doubles of the time
    right_after: tuple[Vector, Vector] | None = field(default=None)


class Transitions:
    """The changes of mode along one run.

    Parameters
    ----------
    modes
        Of the problem.
    accuracy, until
        The request of the run.
    """

    def __init__(self, modes: Modes, accuracy: float, until: float) -> None:
        self.modes = modes
        self.accuracy, self.until = accuracy, until
        self.contacts = modes.setup.contacts
        #: of each component at a time; the run that this is for says it
        self.rounding: Callable[[float], Sequence[float]] = lambda _: ()
        #: impacts take place some such parts of a rounding of doubles away
        self.moved = 0.0
        self._fastest: dict[int, float] = {}

    # -- the beginning -----------------------------------------------------------------------

    def begin(self, q: Vector, v: Vector) -> Turn:
        """The mode at t = 0: contacts that are open, closed, or struck at once."""
        modes = self.modes
        first = modes.first
        opened = [k for k in modes.setup.gaps if k not in first.held]
        if not opened:
            return self._stand(0.0, q, v, first.held)
        gaps, sizes = self._gaps(0.0, q, v)
        for k in opened:
            if gaps[k] < -_TOUCHING * sizes[k]:
                raise self._apart(k)
        touching = frozenset(k for k in opened if gaps[k] <= _TOUCHING * sizes[k])
        if not touching:
            return self._stand(0.0, q, v, first.held)
        hinge = self._hinge(0.0, q, v)
        limit = {k: _STANDS * hinge.speeds[k] for k in touching}
        struck = frozenset(k for k in touching if hinge.rates[k] < -limit[k])
        still = frozenset(k for k in touching if abs(hinge.rates[k]) <= limit[k])
        return self._settled(0.0, q, v, first.held, struck, still)

    def _apart(self, k: int) -> Refusal:
        from lagcli.diagnostics import Diagnostic
        from lagcli.values import off_constraints

        constraint, problem = self.modes.setup.whole.constraints[k], self.modes.setup.problem
        message = f"the initial state is on the wrong side of the contact '{constraint.name}'"
        span, hint = constraint.equation.span, "a gap is never negative"
        for each in off_constraints(problem):
            if f"'{constraint.name}'" in each.message:
                span, hint = each.span, each.hint
        return Refusal((Diagnostic(message, span, hint),))

    # -- an event ------------------------------------------------------------------------------

    def after(self, mode: Mode, found: Occurrence, q: Vector, v: Vector) -> Turn:
        """What follows an occurrence.

        Raises
        ------
        Explained
            Where nobody can say.
        """
        t, condition = found.t, found.condition
        name, k = condition.name, condition.index
        if condition.kind == "stop":
            return Turn(q=q, v=v, mode=None, events=(Event(t, name, condition.what),))
        if found.touches:
            if condition.kind == "gap":
                reason = f"it grazes '{name}': whether it strikes is within the error"
                raise Grazes(t, q, v, reason)
            return Turn(q=q, v=v, mode=mode, events=(Event(t, name, "touches"),), touched=found)
        if condition.kind == "slip":
            return self._stand(t, q, v, mode.held, slips=k, before=mode)
        if condition.kind == "gap":
            return self.closes(mode, t, k, q, v)
        if self.modes.setup.whole.constraints[k].on_loss == "stop":
            return Turn(q=q, v=v, mode=None, events=(Event(t, name, "contact lost"),))
        return self._settled(t, q, v, mode.held, frozenset(), frozenset(), lost=k)

    def closes(self, mode: Mode, t: float, k: int, q: Vector, v: Vector) -> Turn:
        """An open contact closes."""
        if self.contacts[k].restitution is None:
            event = Event(t, self.contacts[k].name, "contact closes")
            return Turn(q=q, v=v, mode=None, events=(event,))
        return self._settled(t, q, v, mode.held, frozenset({k}), frozenset(), before=mode)

    def _settled(
        self,
        t: float,
        q: Vector,
        v: Vector,
        held: frozenset[int],
        struck: frozenset[int],
        still: frozenset[int],
        *,
        lost: int | None = None,
        before: Mode | None = None,
    ) -> Turn:
        """Impulses of what is struck, then who of the closed ones carries."""
        if struck:
            q = self._touching(t, q, v, held | struck)
        sided = frozenset(self.contacts)
        always = held - sided - {lost}
        closed = (held & sided) - {lost}
        hinge = self._hinge(t, self._beside(q) if struck else q, v)
        struck = struck | self._together(t, q, v, hinge, held | struck | still | {lost})
        unknown = [k for k in struck if self.contacts[k].restitution is None]
        if unknown:
            event = Event(t, self.contacts[min(unknown)].name, "contact closes")
            return Turn(q=q, v=v, mode=None, events=(event,))
        events: list[Event] = []
        candidates = closed | still
        due, apex = None, math.inf
        if struck:
            v, lost_by, resting, bounces, left = self._impact(
                t, q, v, hinge, always, closed | still, struck
            )
            if (gone := self._stopping(left & closed)) is not None:
                return Turn(q=q, v=v, mode=None, events=(Event(t, gone, "contact lost"),))
            events += [Event(t, self.contacts[k].name, "contact lost") for k in left & closed]
            for k in sorted(struck):
                ends = k in resting and self._restitution(k) > 0
                what = "comes to rest" if ends else "impact"
                error = resting[k] if ends else 0.0
                events.append(Event(t + error, self.contacts[k].name, what, error, lost_by[k]))
            candidates = (candidates - left) | frozenset(resting)
            apex = t + min((flight / 2 for flight, _, _ in bounces), default=math.inf)
            due = min(((t + flight, k) for flight, k, seen in bounces if not seen), default=None)
            hinge = self._hinge(t, q, v)
        carried = hinge.carried(always, candidates)
        if carried is None:
            raise StopWithReason(t, q, v, "a force that contacts share is not determined")
        if (gone := self._stopping((candidates & held) - carried)) is not None:
            return Turn(q=q, v=v, mode=None, events=(Event(t, gone, "contact lost"),))
        if lost is not None:
            events.append(Event(t, self.modes.setup.whole.constraints[lost].name, "contact lost"))
        events += [
            Event(t, self.contacts[k].name, "contact lost")
            for k in sorted((candidates & held) - carried)
        ]
        turn = self._stand(t, q, v, always | carried, before=before)
        assert turn.mode is not None
        surface = turn.mode.surface()
        q, v = turn.q, turn.v
        if surface is not None:
            surface.measure(t, q, v)
            q, v = surface.project(t, q, v)
        events += turn.events
        return Turn(q=q, v=v, mode=turn.mode, events=tuple(events), apex=apex, due=due)

    def _impact(
        self,
        t: float,
        q: Vector,
        v: Vector,
        hinge: Hinge,
        always: frozenset[int],
        closed: frozenset[int],
        struck: frozenset[int],
    ) -> tuple[
        Vector, dict[int, float], dict[int, float], list[tuple[float, int, bool]], frozenset[int]
    ]:
        """v+; energy lost; what comes to rest and within which time; bounces; what is left.

        A bounce is its time of flight, the contact, and whether it can be seen.
        """
        for k in struck:
            self._fastest[k] = max(self._fastest.get(k, 0.0), -float(hinge.rates[k]))
        ratio = {k: self._restitution(k) if k in struck else 0.0 for k in struck | closed}
        found = hinge.struck(v, always, ratio)
        if found is None:
            raise StopWithReason(t, q, v, "an impact of several contacts is not determined")
        after = self._hinge(t, q, found[0])
        limit = {k: _STANDS * max(after.speeds[k], hinge.speeds[k]) for k in ratio}
        resting: dict[int, float] = {}
        bounces = []
        pull = after.gap_accelerations(
            always | frozenset(k for k in closed if after.rates[k] <= limit[k])
        )
        time = _REST * self.accuracy * self.until
        rounding = self.rounding(t)
        slow = {k: max(_REST * self.accuracy * self._fastest[k], limit[k]) for k in struck}

        def rest(k: int, times: float) -> bool:
            speed, e = max(0.0, float(after.rates[k])), float(ratio[k])
            if not e:
                return speed <= limit[k]
            return rests(speed, float(pull[k]), e, times * time, times * slow[k])

        # what strikes together comes to rest together
        over = any(rest(k, 1.0) for k in struck)
        for k in struck:
            speed, e = max(0.0, float(after.rates[k])), float(ratio[k])
            if over and rest(k, _SAME):
                resting[k] = 2 * speed / (-float(pull[k]) * (1 - e)) if speed and e < 1 else 0.0
                continue
            flight, height = flight_of(speed, float(pull[k]))
            if t + flight <= self.until:
                bounces.append((flight, k, height > UNRESOLVED * hinge.along(k, rounding)))
        if resting:
            ratio |= dict.fromkeys(resting, 0.0)
            again = hinge.struck(v, always, ratio)
            found = again if again is not None else found
            after = self._hinge(t, q, found[0])
        left = frozenset(k for k in closed if after.rates[k] > limit[k])
        return *found, resting, bounces, left

    def _beside(self, q: Vector) -> Vector:
        """The place of an impact, which rounding moves along a surface, in a run that is moved."""
        if not self.moved:
            return q
        far = _BESIDE * self.moved
        return [x + (-1) ** j * far * math.ulp(float(x)) for j, x in enumerate(q)]

    def _touching(self, t: float, q: Vector, v: Vector, closed: frozenset[int]) -> Vector:
        """The positions with the gaps of what is struck at 0."""
        surface = self.modes.mode(closed).surface()
        assert surface is not None
        surface.measure(t, q, v)
        return surface.settle(t, q, v)

    def _together(
        self, t: float, q: Vector, v: Vector, hinge: Hinge, known: frozenset[int | None]
    ) -> frozenset[int]:
        """Other open contacts that close at the same time, within rounding."""
        opened = [k for k in self.modes.setup.gaps if k not in known]
        if not opened:
            return frozenset()
        gaps, _ = self._gaps(t, q, v)
        rounding = self.rounding(t)
        return frozenset(
            k
            for k in opened
            if hinge.rates[k] < -_STANDS * hinge.speeds[k]
            and gaps[k] <= _NEAR * hinge.along(k, rounding)
        )

    def _stopping(self, lost: frozenset[int]) -> str | None:
        """A contact among those lost at whose loss the run stops."""
        return next((self.contacts[k].name for k in sorted(lost) if self.contacts[k].stops), None)

    # -- friction --------------------------------------------------------------------------------

    def sticks(self, mode: Mode, t: float, kink: int, q: Vector, v: Vector) -> Turn:
        """A sign has come to a kink from which neither branch leads away."""
        return self._stand(t, q, v, mode.held, reached=kink, before=mode)

    def _stand(
        self,
        t: float,
        q: Vector,
        v: Vector,
        held: frozenset[int],
        *,
        reached: int | None = None,
        slips: int | None = None,
        before: Mode | None = None,
    ) -> Turn:
        """The mode with these constraints and what friction holds."""
        modes = self.modes
        mode = modes.mode(held)
        was = before.stuck if before is not None else frozenset()
        side = modes.signs[slips] if slips is not None else 0.0
        moving = mode.motion.moving_kinks
        if not moving:
            if mode.motion.kinks:
                mode.motion.set_signs(t, q, v)
            return Turn(q=q, v=v, mode=mode)
        at_rest = frozenset(was) | ({reached} if reached is not None else frozenset())
        if at_rest:
            v = stopped(mode.motion, sorted(at_rest), t, q, v)
        mode.motion.set_signs(t, q, v)
        arguments = mode.motion.kink_arguments(t, *q, *v)
        noise = mode.motion.kink_noise(t, q, v)
        stuck = {
            k for k in moving if k in at_rest or abs(arguments[k]) <= noise[k]
        } - {slips}  # fmt: skip
        if slips is not None:
            modes.signs[slips] = 1.0 if side > 0 else -1.0
        while stuck:
            trial = modes.mode(held, frozenset(stuck)).motion
            assert isinstance(trial, StuckMotion)
            sigma = dict(zip(trial.stuck, trial.friction(t, *q, *v), strict=True))
            k, value = max(sigma.items(), key=lambda each: abs(each[1]))
            if abs(value) <= 1:
                break
            stuck.discard(k)
            modes.signs[k] = 1.0 if value > 0 else -1.0
        name = modes.setup.equations.kink_name
        events = [Event(t, name(k), "sticks") for k in sorted(stuck - was)]
        events += [Event(t, name(k), "slips") for k in sorted(was - stuck)]
        return Turn(q=q, v=v, mode=modes.mode(held, frozenset(stuck)), events=tuple(events))

    # -- numbers ---------------------------------------------------------------------------------

    def _hinge(self, t: float, q: Sequence[Any], v: Sequence[Any]) -> Hinge:
        return Hinge(self.modes.whole, self.contacts, t, q, v)

    def _gaps(
        self, t: float, q: Sequence[Any], v: Sequence[Any]
    ) -> tuple[dict[int, float], dict[int, float]]:
        """The gaps of the contacts, and the sums of the magnitudes of their terms."""
        whole = self.modes.whole
        holonomic = whole.equations.holonomic
        found = whole.positions(t, *q, *v)
        sizes = whole.sizes(t, *q, *v)
        place = {k: i for i, k in enumerate(holonomic)}
        gaps = {
            k: contact.sign * float(found[place[k]])
            for k, contact in self.contacts.items()
            if k in place
        }
        return gaps, {k: abs(float(sizes[place[k]])) + abs(gaps[k]) for k in gaps}

    def _restitution(self, k: int) -> Any:
        """Newton's coefficient of a contact."""
        modes = self.modes
        formula = self.contacts[k].restitution
        assert formula is not None
        node = modes.setup.equations.form.read(formula)
        [value] = straight_line((), [node], modes.constants, modes.arithmetic)()
        if not 0 <= value <= 1:
            from lagcli.diagnostics import Diagnostic

            name = self.contacts[k].name
            message = f"the restitution of '{name}' lies between 0 and 1, and is {float(value):g}"
            raise Refusal((Diagnostic(message, formula.span),))
        return value
