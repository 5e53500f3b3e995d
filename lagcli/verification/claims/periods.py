"""The period about a minimum of U_eff: its printed powers of the amplitude against the integral.

    T = 2 integral of dq/q' between the turning points q0 - a and q0 + a, with E(q, q') = E,

with q = q0 + a sin s the integral over s of an analytic function of period 2 pi, which the
trapezoidal rule gives to all digits (Trefethen, Weideman, SIAM Review 56 (2014) 385).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from random import Random

from flint import arb, ctx

from lagcli.statements.motions import OneFreedom, PeriodSeries
from lagcli.verification.claims.rest import BITS, conditions, has_sign
from lagcli.verification.examination import LOOKED_AT, Examination
from lagcli.verification.linear import size
from lagcli.verification.phase_points import Environment

#: Of the amplitude, where the powers of the series are told apart: a^5 is nothing beside a^4.
_AMPLITUDE = arb(2) ** -24
_NODES = 24
#: Parameters of other sizes for each state: R w > g for R w² > g is then seen in 99 of 100 cases.
_SPREAD = 6
_STEPS = 40
#: Powers of 2 with which a minimum that is not solved for is sought.
_STARTS = (0, -2, 2, -4, -6)
_ARRIVED = 1e-60
_SAME = 1e-9


def periods(x: Examination, one: OneFreedom, energy: int) -> bool:
    """Whether each is a minimum with its period, and none is left out; noted if not."""
    well = Well(x, one, energy)
    with ctx.workprec(BITS):
        if not all(well.is_right(each) for each in one.periods):
            return False
        other = well.other()
    if not other:
        return True
    what = "that the periods about all minima of the effective potential are listed"
    x.refute(what, f"there is one at {one.coordinate} = {other}")
    return False


class Well:
    """The energy E(q, q') = U + M q'^2/2 + … of one degree of freedom at random parameters."""

    def __init__(self, x: Examination, one: OneFreedom, energy: int) -> None:
        program, by = x.reference.program, x.reference.by
        self.x, self.one = x, one
        self.q, self.v = (program.symbol(one.coordinate, k) for k in (0, 1))
        self.momentum = by(energy, self.v)
        self.M = by(self.momentum, self.v)
        given = (c.assume for c in x.problem.coordinates if c.name == one.coordinate)
        self.assume = next(given, "real")
        self.U = energy  # where q' = 0
        self.slope = by(energy, self.q)
        self.curvature = by(self.slope, self.q)

    def scenes(self) -> Iterator[Environment]:
        """The parameters and momenta of random states."""
        for state in self.x.states(LOOKED_AT, BITS):
            yield {**state.environment, **state.following, (self.one.coordinate, 1): arb(0)}

    def _spread(self) -> Iterator[Environment]:
        """The same with parameters of other sizes and signs, and momenta of other sizes."""
        random = Random(7)
        parameters = [p for p in self.x.problem.parameters if not p.integer]
        signs = {p.name: (1, -1) if p.assume == "real" else (1,) for p in parameters}
        signs |= {f"p_{name}": (1,) for name in self.x.reference.names}
        for known in self.scenes():
            for _ in range(_SPREAD):
                scales = {
                    (n, 0): known[n, 0] * random.choice(s) * arb(2) ** random.randint(-3, 3)
                    for n, s in signs.items()
                    if (n, 0) in known
                }
                yield {**known, **scales}

    def _value(self, known: Environment, place: int, q: arb) -> arb:
        return self.x.reference.values({**known, (self.one.coordinate, 0): q})(place)

    # -- one series --------------------------------------------------------------------------

    def is_right(self, series: PeriodSeries) -> bool:
        """Whether it is the period about a minimum."""
        x, what = self.x, f"the period of {self.one.coordinate}"
        places = x.places(what, [series.period, *series.at.values()])
        root = x.places(what, [series.root_of] if series.root_of is not None else [])
        if places is None or root is None:
            return False
        above, tried = conditions(x, what, series.where), 0
        for known in chain(self.scenes(), self._spread()):
            at = x.reference.values(known)
            if not all(at(place) > 0 for place in above):
                continue
            q0 = self._minimum(known, root[0]) if root else at(places[-1])
            if q0 is None or not q0.is_finite():
                continue
            if self._value(known, self.M, q0) < 0:  # with which the motion is about a maximum
                continue
            tried += 1
            if not self._is_minimum(known, q0):
                x.refute(what, "there is no minimum of the effective potential")
                return False
            alike = self._is_constant if series.squared else self._is_harmonic
            if series.isochronous and not alike(known, q0.mid()):
                x.refute(what, "it depends on the amplitude")
                return False
            if not self._agrees(known, series, places[0], q0.mid()):
                x.refute(what, "it is not that of the motion near the minimum")
                return False
            if not self._is_by_energy(known, series, what, q0.mid()):
                x.refute(what, "it is not that function of the energy")
                return False
            if tried > 1:
                break
        if not tried:
            x.unchecked.append(what)
        why = "" if root or x.problem.contacts else self._why_not_where(above, places[-1])
        if why:
            x.refute(what, why)
        return not why

    def _why_not_where(self, above: Sequence[int], place: int) -> str:
        """Why the printed conditions are not those under which there is a minimum."""
        for known in self._spread():
            at = self.x.reference.values(known)
            q0, holds = at(place), [at(each) for each in above]
            if q0.is_finite() and self._value(known, self.M, q0) < 0:
                continue
            real = q0.is_finite() and has_sign(self.assume, q0)
            minimum = real and self._is_minimum(known, q0)
            if all(each > 0 for each in holds) and not minimum:
                return "its conditions hold where there is no minimum"
            if any(each < 0 for each in holds) and minimum:
                return "there is a minimum where its conditions do not hold"
        return ""

    def _minimum(self, known: Environment, place: int) -> arb | None:
        """A root of what vanishes at a minimum that is one, from starts of several sizes."""
        start = known[self.one.coordinate, 0]
        for power in _STARTS:
            q = self._root(known, place, start * arb(2) ** power)
            if q is not None and q.is_finite() and self._is_minimum(known, q):
                return q
        return None

    def _is_minimum(self, known: Environment, q: arb) -> bool:
        slope, curvature, M = (
            self._value(known, place, q) for place in (self.slope, self.curvature, self.M)
        )
        return size(slope) < 1e-30 * (1 + size(curvature)) and curvature > 0 and M > 0

    def _is_harmonic(self, known: Environment, q0: arb) -> bool:
        """Whether U'^2 M0 = 2 U0'' M (U - U0) beside the minimum."""
        M0, k, U0 = (self._value(known, p, q0) for p in (self.M, self.curvature, self.U))
        for q in (q0 + arb(5) / 16, q0 - arb(3) / 16):
            slope, M, U = (self._value(known, p, q) for p in (self.slope, self.M, self.U))
            terms = slope**2 * M0, 2 * k * M * (U - U0)
            if size(terms[0] - terms[1]) > 1e-30 * size(terms[0]):
                return False
        return True

    def _is_constant(self, known: Environment, q0: arb) -> bool:
        """Whether the period of small oscillations is that at an amplitude near |q0|/4."""
        M0, k = (self._value(known, p, q0) for p in (self.M, self.curvature))
        high = q0 + abs(q0) / 4
        energy = self._value(known, self.U, high)
        low = self._turning(known, q0 - abs(q0) / 5, energy)
        if low is None:
            return False
        a, middle = (high - low) / 2, (high + low) / 2
        true = self._integral(known, middle.mid(), a.mid(), energy)
        small = 2 * arb.pi() * (M0 / k).sqrt()
        return size(true - small) < _SAME * size(small)

    def _agrees(self, known: Environment, series: PeriodSeries, place: int, q0: arb) -> bool:
        """The printed period at a small amplitude; without one that of small oscillations."""
        if not series.amplitude:
            M, k = (self._value(known, p, q0) for p in (self.M, self.curvature))
            there = {**known, (self.one.coordinate, 0): q0}
            true = 2 * arb.pi() * (M / k).sqrt()
            return size(self.x.reference.values(there)(place) - true) < 1e-30 * size(true)
        far = self._error(known, series, place, q0, _AMPLITUDE)
        if far is None or far < 1e3 * size(_AMPLITUDE) ** (series.order + 1):
            return True
        # beyond the printed powers the error falls with a higher one, whatever its factor
        near = self._error(known, series, place, q0, _AMPLITUDE / 4)
        return near is None or 2 * near * 4**series.order < far

    def _is_by_energy(self, known: Environment, series: PeriodSeries, what: str, q0: arb) -> bool:
        """Whether the printed function of the energy is the integral, not only near the minimum."""
        if series.by_energy is None:
            return True
        printed = self.x.places(what, [series.by_energy])
        energies = conditions(self.x, what, series.energies)
        if printed is None:
            return False
        for step in (_AMPLITUDE, abs(q0) / 64 + arb(2) ** -9):
            energy = self._value(known, self.U, q0 + step)
            at = self.x.reference.values({**known, (self.one.constant, 0): energy})
            low = self._turning(known, q0 - step, energy)
            if low is None or not all(at(each) > 0 for each in energies):
                continue
            a, middle = (q0 + step - low) / 2, (q0 + step + low) / 2
            true = self._integral(known, middle.mid(), a.mid(), energy)
            if not size(at(printed[0]) - true) < _SAME * size(true):
                return False
        return True

    def _error(
        self, known: Environment, series: PeriodSeries, place: int, q0: arb, step: arb
    ) -> float | None:
        """Of the printed period, relative, where the motion turns at q0 + step."""
        energy = self._value(known, self.U, q0 + step)
        low = self._turning(known, q0 - step, energy)
        if low is None:
            return None
        a, middle = (q0 + step - low) / 2, (q0 + step + low) / 2
        true = self._integral(known, middle.mid(), a.mid(), energy)
        printed = self.x.reference.values({**known, (series.amplitude, 0): a})(place)
        return size(printed - true) / size(true) if printed.is_finite() else None

    def _turning(self, known: Environment, q: arb, energy: arb) -> arb | None:
        for _ in range(_STEPS):
            gap = self._value(known, self.U, q) - energy
            slope = self._value(known, self.slope, q)
            step = (gap / slope).mid()
            q = (q - step).mid()
            if size(step) < _ARRIVED:
                return q
        return None

    def _integral(self, known: Environment, middle: arb, a: arb, energy: arb) -> arb:
        total = arb(0)
        for k in range(_NODES):
            s = arb.pi() * (2 * k + 1) / (2 * _NODES)  # by symmetry half of a turn
            q = (middle - a * s.cos()).mid()
            total += a * s.sin() / self._speed(known, q, energy)
        return 2 * total * arb.pi() / _NODES

    def _speed(self, known: Environment, q: arb, energy: arb) -> arb:
        """The q' > 0 of E(q, q') = energy."""
        M, U = self._value(known, self.M, q), self._value(known, self.U, q)
        v = (2 * (energy - U) / M).sqrt()
        for _ in range(_STEPS):
            there = {**known, (self.one.coordinate, 1): v}
            excess = self._value(there, self.U, q) - energy
            step = (excess / self._value(there, self.momentum, q)).mid()
            if not size(step) > _ARRIVED * size(v):
                break
            v = (v - step).mid()
        return v

    # -- all of them -----------------------------------------------------------------------------

    def other(self) -> str:
        """A minimum about which no period is given; empty where none was found."""
        one = self.one
        if one.reason or not one.periods or any(each.root_of is not None for each in one.periods):
            return ""
        places = [self.x.places("", list(each.at.values())) or [] for each in one.periods]
        random = Random(9)
        for known in list(self.scenes())[:2]:
            at = self.x.reference.values(known)
            listed = [at(p[0]) for p in places if p]
            for _ in range(8):
                start = arb(random.randint(-3200, 3200)) / 1024
                q = self._root(known, self.slope, abs(start) if one.positive else start)
                if q is None or size(q) > 3.2 or not self._is_minimum(known, q):
                    continue
                if not has_sign(self.assume, q) or self._is_listed(known, q, listed):
                    continue
                if not self._value(known, self.U, q).is_finite():  # as log(cos(q)) beyond pi/2
                    continue
                return f"{float(q):.6g}"
        return ""

    def _is_listed(self, known: Environment, q: arb, listed: Sequence[arb]) -> bool:
        """Whether it is one of these, up to a period of U and M."""
        near = (q + arb(3) / 16, q - arb(5) / 16)
        return any(
            size(q - other) < _SAME
            or all(
                size(self._value(known, place, z) - self._value(known, place, z + other - q))
                < _SAME
                for place in (self.U, self.M)
                for z in near
            )
            for other in listed
            if other.is_finite()
        )

    def _root(self, known: Environment, place: int, q: arb | None = None) -> arb | None:
        slope = self.x.reference.by(place, self.q)
        q = known[self.one.coordinate, 0] if q is None else q
        for _ in range(_STEPS):
            step = (self._value(known, place, q) / self._value(known, slope, q)).mid()
            if not step.is_finite():
                return None
            longest = size(step)
            q = (q - (step if longest < 1 else step / arb(longest))).mid()
            if longest < _ARRIVED:
                return q
        return None
