"""Taylor series in machine code: as a method whose steps are looked into, or a whole run.

The order follows from the tolerance, the step from the last four coefficients, as for
`integrators.taylor`; but an order costs little more than the one before it, so it is higher here:
between 1 - log(tolerance)/2, which is the best for work that grows as its
square, and -log(tolerance), for work in proportion to it.  The sums of the steps are
compensated.  A whole run stays in machine code between the calls that tell how far it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from ctypes import addressof, c_double, c_int64, memmove, memset, sizeof
from functools import partial
from itertools import repeat
from typing import Any

from lagcli.numerics.compiled import layout as k
from lagcli.numerics.compiled.emission import LAST
from lagcli.numerics.compiled.machine import Machine, pointer
from lagcli.numerics.compiled.numbers import Extended
from lagcli.numerics.compiled.text import exact
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.leaps import Leaps
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.request import Progress
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.integrators.steps import CannotGoOn, NotPossible, Step, Stretch, Tolerance
from lagcli.numerics.integrators.switching import Kinks

_HIGHEST = LAST - 2
#: Steps of the first call, in quick code and in better code, and of any; operations of one run: a
#: minute or two.
_FIRST, _FIRST_OF_BETTER, _CALL = 50, 500, 20_000
#: Steps one by one between the looks whether better code pays.
_LOOK = 64
_LIMIT = 1_000_000_000
#: Of the order in the logarithm of the tolerance, by what was measured.
_ORDER, _LOWEST = 0.7, 8
#: Constraints are held to _HELD roundings, and one that the others imply to _IMPLIED.
_HELD, _IMPLIED = 3.6, 1e-12
#: A row from a tuple of all its fields: with a call of Python for each a sweep takes 3 % longer.
_mark: Callable[[tuple[Any, ...]], Mark] = partial(tuple.__new__, Mark)


class PivotVanishes(NotPossible):
    """An elimination divides by nothing at t: `null_space` goes on from here, or more digits."""

    def __init__(self, t: float, constraints: int) -> None:
        super().__init__("the constraints become dependent")
        # those that are dependent all the way stay so, and so does a singular mass matrix
        self.needs_digits = t > 0 and constraints > 0


class CompiledTaylor:
    """The steps of one run.

    Parameters
    ----------
    machine
        The equations.
    surface
        The constraints, or None; it is told the residuals of a whole run.  The machine may be
        one without those that the others imply.
    """

    sees, even = True, False

    def __init__(self, machine: Machine, surface: Surface | None) -> None:
        self.machine, self.surface = machine, surface
        self._held_surface = surface
        if surface is not None and machine.motion.m < surface.motion.m:
            self._held_surface = Surface(machine.motion, surface.rounding)
        self.name = machine.numbers.name
        self.n = machine.motion.n
        self.evaluations = 0
        self.reached: int | None = None
        self._array = machine.numbers.array
        both, motion = 2 * self.n, machine.motion
        self._rows, self._other = (self._zeros(machine.rows * k.STRIDE) for _ in range(2))
        beside = machine.beside
        self._small = (c_double * (beside.rows * k.STRIDE if beside else 1))()
        self._ahead = self._zeros(2 * both + 1 + 2 * (self.n + 2 * motion.m) + both + 1)
        self._lost = self._zeros(both)
        self._peaks, self._scales = self._zeros(both), self._array([1.0] * both)
        self._signs = self._zeros(max(1, len(motion.kinks)))
        self._held = self._zeros(max(1, 4 * motion.m))
        self._facts = self._zeros(k.FACTS)
        self._counts = (c_int64 * k.COUNTS)()
        self._leaps = Leaps(machine, self._scales, self._facts, self._counts)
        watch = machine.watch
        self._watch = (c_int64 * max(1, len(watch)))(*watch)
        self._other[both * k.STRIDE + 1] = machine.numbers.cell(1.0)

    def _zeros(self, count: int) -> Any:
        return (self.machine.numbers.c_type * count)()

    def _prepare(self, q: Sequence[Any], v: Sequence[Any], until: float, bound: Tolerance) -> Any:
        """The state in memory, and all that the loop wants to know."""
        self.machine.take()
        motion, facts, counts = self.machine.motion, self._facts, self._counts
        self.order = min(_order(bound.value), _HIGHEST)
        numbers = self.machine.numbers
        for place, fact in (
            (k.UNTIL, until),
            (k.TOLERANCE, bound.value),
            (k.LONGEST, bound.longest),
            (k.SPAN, bound.span),
            (k.SCALE, 0.0),
            (k.SHORTEST, 4 * numbers.rounding),
            (k.ROUNDING, _HELD * numbers.rounding),
            (k.KICK, numbers.rounding if bound.moved else 0.0),
            (k.NARROWEST, k.LARGE),
            (k.CLOCK, 1.0 if motion.equations.depends_on_time else 0.0),
        ):
            facts[place] = numbers.cell(fact)
        counts[k.N], counts[k.ORDER] = self.n, self.order
        counts[k.HOLONOMIC], counts[k.CONSTRAINTS] = len(motion.equations.holonomic), motion.m
        counts[k.WATCHED] = len(self.machine.watch) // k.WIDTH
        counts[k.EXACT] = 0 if self.machine.beside is None else self.order
        n, peaks = self.n, bound.peaks
        for i, peak in enumerate(peaks):
            least = peaks[i - n] / bound.span if i >= n else 0.0
            self._peaks[i] = numbers.cell(peak)
            self._scales[i] = numbers.cell(max(peak, 1e-300, least))
        if self._held_surface is not None:
            for i, scale in enumerate(self._held_surface.scales):
                self._held[i] = numbers.cell(float(scale))
        return self._array([*map(exact, q), *map(exact, v), 0.0])

    # -- step by step ----------------------------------------------------------------------------

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Accepted steps to the end, or to where friction sticks (`reached`).

        Raises
        ------
        CannotGoOn
            Where the series has no radius of convergence left.
        """
        q, v, until, t = stretch
        state, motion = self._prepare(q, v, until, tolerance), self.machine.motion
        numbers, both, size = self.machine.numbers, 2 * self.n, sizeof(self.machine.numbers.c_type)
        ahead, lost = addressof(self._ahead), addressof(self._ahead) + (both + 1) * size
        state[both] = numbers.cell(t)
        kinks, self.reached = Kinks(motion, tolerance), None
        if motion.kinks:
            kinks.begin(t, q, v)
        while t < until:
            for i, sign in enumerate(motion.signs):
                self._signs[i] = numbers.cell(sign)
            move = self._move
            more, h = self._expand(state) == k.MORE, float(self._facts[k.H])
            if more and t + h > t:  # a time is a double, whatever the state has
                inside = self._inside(t)
            else:
                h, move = self._leaps.length(t), self._leap
                if not h:
                    raise CannotGoOn(t, q, v, "")
                inside = self._leaps.straight(t, q, v)
            end = until if t + 1.01 * h >= until else t + h
            q_end, v_end = move(state, end, q, v)
            if motion.kinks:
                shorter = kinks.first(t, end - t, q_end, v_end, inside)
                if shorter is not None:
                    end = t + shorter
                    if kinks.stuck(end, until):
                        raise CannotGoOn(t, q, v, kinks.why())
                    q_end, v_end = move(state, end, q, v)
            tolerance.peaks[:] = [float(x) for x in self._peaks]
            tolerance.scales[:] = [float(x) for x in self._scales]
            memmove(state, ahead, both * size)
            memmove(self._lost, lost, both * size)
            state[both] = numbers.cell(end)
            q, v = q_end, v_end
            yield Step(t, end - t, end, q, v, inside)
            if kinks.reached is not None:
                if kinks.sticks(end, q, v):
                    self.reached = kinks.reached
                    return
                v = kinks.pass_through(end, q, v)
                memmove(state, self._array([*map(exact, (*q, *v))]), both * size)
            t = end
            if self.evaluations % (_LOOK * self.order) == 0:
                self.machine.improve(self.evaluations / self.order * until / t, self.order)

    def _expand(self, state: Any) -> int:
        self.evaluations += self.order
        given = (
            self._rows,
            self._small,
            self._signs,
            state,
            self._peaks,
            self._scales,
            self._watch,
            self._facts,
        )
        status = self.machine.kernel("expand")(*map(pointer, given), pointer(self._counts))
        if status == k.PIVOT:
            raise self._vanishes(state)
        return int(status)

    def _move(self, state: Any, end: float, q: Any, v: Any) -> tuple[list[Any], list[Any]]:
        given = map(pointer, (self._rows, state, self._lost, self._ahead))
        rest = map(pointer, (self._held, self._facts, self._counts))
        status = self.machine.kernel("move")(*given, end, *rest)
        if status == k.PIVOT:
            raise self._vanishes(state)
        if status != k.MORE:
            raise CannotGoOn(float(state[2 * self.n]), q, v, "")
        return self._halves(self._ahead)

    def _halves(self, cells: Any) -> tuple[list[Any], list[Any]]:
        """q and q' of a state in memory."""
        found = self._read(cells, 2 * self.n)
        return found[: self.n], found[self.n :]

    def _leap(self, state: Any, end: float, q: Any, v: Any) -> tuple[list[Any], list[Any]]:
        """As `_move`, over a place where the equations have values and no series."""
        places, speeds = self._leaps.over(float(state[2 * self.n]), end, q, v)
        zeros = [0] * (2 * self.n + 1)  # the time, and what rounding has taken
        found = self._array([*map(exact, (*places, *speeds)), *zeros])
        memmove(self._ahead, found, sizeof(found))
        return places, speeds

    def _goes_across(self, state: Any) -> bool:
        """Whether the state of a whole run could be carried over what blocks the way."""
        t = float(state[2 * self.n])
        h = self._leaps.length(t)
        if not h or t + h >= float(self._facts[k.UNTIL]):
            return False
        try:
            places, speeds = self._leaps.over(t, t + h, *self._halves(state))
        except (ArithmeticError, ValueError):
            return False
        found = self._array([*map(exact, (*places, *speeds)), t + h])
        memmove(state, found, sizeof(found))
        memset(self._lost, 0, sizeof(self._lost))
        return True

    def _vanishes(self, state: Any) -> PivotVanishes:
        return PivotVanishes(float(state[2 * self.n]), self.machine.motion.m)

    def _inside(self, start: float) -> Any:
        """Positions, velocities and accelerations anywhere in the step."""
        kept = self._zeros(len(self._rows))
        memmove(kept, self._rows, sizeof(kept))
        n, out, slopes = self.n, self._zeros(2 * self.n + 1), self._zeros(self.n)
        at, rate, order = self.machine.kernel("inside"), self.machine.kernel("slopes"), self.order

        def inside(t: float) -> tuple[list[Any], list[Any], list[Any]]:
            passed = self.machine.numbers.difference(t, start)
            at(pointer(kept), pointer(out), 2 * n, order, passed)
            rate(pointer(kept), pointer(slopes), n, order, passed)
            return *self._halves(out), self._read(slopes, n)

        return inside

    def lengths(self, groups: Sequence[Sequence[int]]) -> list[float]:
        """How long the last step would have been for the coordinates of each group alone."""
        tolerance = float(self._facts[k.TOLERANCE])
        scale, longest = float(self._facts[k.SCALE]), float(self._facts[k.LONGEST])
        found = []
        for group in groups:
            rows = [*group, *(self.n + j for j in group)]
            h = longest / scale
            for power in range(self.order - 3, self.order + 1):
                largest = max(
                    abs(float(self._rows[i * k.STRIDE + power])) / float(self._scales[i])
                    for i in rows
                )
                if largest > 0:
                    h = min(h, (tolerance / largest) ** (1 / power))
            found.append(scale * h)
        return found

    # -- the whole run ---------------------------------------------------------------------------

    def go(
        self,
        run: Run,
        q: list[Any],
        v: list[Any],
        times: Sequence[float],
        *,
        probes: int,
        progress: Progress,
        most: int | None = None,
        foreseen: Progress = None,
    ) -> Run:
        """A run without conditions and kinks; at least `probes` places are looked at.

        It takes at `most` this number of steps; `foreseen` gets the expected number.

        Raises
        ------
        PivotVanishes
            Where only the null-space way goes on.
        """
        counts, facts, both = self._counts, self._facts, 2 * self.n
        surface = self._held_surface
        if surface is not None:
            surface.measure(0.0, q, v)
        state = self._prepare(q, v, times[-1], run.tolerance)
        request, out = self._array(times), self._zeros((len(times) + 1) * (both + 1))
        memmove(out, state, sizeof(state))
        counts[k.PENDING], counts[k.TIMES], counts[k.PROBES] = 1, len(times), probes
        given = [self._rows, self._small, self._other, self._signs, state, self._lost]
        given += [self._ahead, self._peaks, self._scales, self._held, self._watch]
        given += [facts, counts, request, out]
        status, call = k.MORE, _FIRST if self.machine.is_quick else _FIRST_OF_BETTER
        limit = _LIMIT // (max(10, self.machine.ops) * self.machine.numbers.cost)
        limit = run.step_limit = limit if most is None else min(limit, most)
        while status == k.MORE and counts[k.STEPS] < limit:
            counts[k.LIMIT] = min(call, limit - counts[k.STEPS])
            status = self.machine.kernel("drive")(*map(pointer, given))
            call = min(2 * call, _CALL)
            if status == k.STOPPED and self._goes_across(state):
                status = k.MORE
            part = float(state[both]) / times[-1]
            if part > 0:
                self.machine.improve(counts[k.STEPS] / part, self.order)
                if foreseen is not None and counts[k.STEPS] > _CALL:
                    foreseen(counts[k.STEPS] / part)
            if progress is not None:
                progress(part)
        if status == k.PIVOT:
            raise self._vanishes(state)
        done = int(counts[k.PENDING])
        whole, n = self._read(out, len(out)), self.n
        rows = [whole[j :: both + 1] for j in range(both)]
        positions, velocities = zip(*rows[:n], strict=True), zip(*rows[n:], strict=True)
        made = map(float, times[:done]), map(list, positions), map(list, velocities)
        run.marks = [*map(_mark, zip(*made, repeat(0), range(done), repeat(False), strict=False))]
        if float(facts[k.NARROWEST]) < k.LARGE:
            *narrow, t = whole[-both - 1 :]
            run.narrowest = Mark(float(t), narrow[:n], narrow[n:], 0)
        run.method_name = self.name
        run.steps = int(counts[k.STEPS])
        self.machine.spent += self.machine.work(run.steps, self.order)
        run.shortened = int(counts[k.SHORTENED])
        run.defect = min(float(facts[k.DEFECT]), math.inf)
        run.evaluations = run.steps * self.order
        run.tolerance.peaks[:] = [float(x) for x in self._peaks]
        run.tolerance.scales[:] = [float(x) for x in self._scales]
        if status != k.DONE:
            last = [float(x) for x in state]
            reason = "" if status == k.STOPPED else f"it takes more than {limit:,} steps"
            run.stop = CannotGoOn(last[both], last[: self.n], last[self.n : both], reason)
        if surface is not None:
            count = len(surface.residuals)
            found = [float(x) for x in self._held[count : 2 * count]]
            surface.residuals = [*map(max, surface.residuals, found)]
            if surface is not self.surface:
                self._look_at_implied(run, surface)
        return run

    def _look_at_implied(self, run: Run, held: Surface) -> None:
        """The residuals of all constraints, those at the rows among them.

        Raises
        ------
        NotPossible
            Where one that followed from the others does not any more.
        """
        whole = self.surface
        assert whole is not None
        for look in (whole.measure, whole.note):
            for mark in run.marks:
                look(mark.t, mark.q, mark.v)
        if not max(whole.residuals) <= _IMPLIED:
            raise NotPossible("a constraint that the others imply at first is not implied later")
        whole.join(held, held.motion.equations.place)

    def _read(self, values: Any, count: int) -> list[Any]:
        numbers = self.machine.numbers
        if not isinstance(numbers, Extended):
            return values[:count]  # type: ignore[no-any-return]
        from flint import arb

        return [*map(arb, numbers.parts(values, count))]


def _order(tolerance: float) -> int:
    return max(_LOWEST, 1 + math.ceil(-_ORDER * math.log(tolerance)))
