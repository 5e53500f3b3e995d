"""Hamilton's principal function S = sum p_i(t) q_i + f(t) of forces of the time alone."""

from __future__ import annotations

from collections.abc import Mapping

from flint import arb

from lagcli.verification.claims.action import Action
from lagcli.verification.linear import dot
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues


def solves_in_time(action: Action) -> bool:
    """sum p_i' q_i + f' + H(q, p, t) = 0, with d/dt of the integrals as printed."""
    x, section, what = action.x, action.section, "Hamilton's principal function"
    integrals = x.places(what, list(section.integrals.values()))
    rates = [e for e in (section.time_rate, section.of_time) if e is not None]
    of_time = x.places(what, rates)
    if integrals is None or of_time is None:
        return False
    program = x.reference.program
    named = [program.symbol(name) for name in section.integrals]

    def rate(at: StepValues, place: int) -> arb:
        by = at.gradient(place)
        inner = [by.get(symbol, arb(0)) * at(f) for symbol, f in zip(named, integrals, strict=True)]
        return sum(inner, by.get(x.reference.time, arb(0)))

    def sides(s: State) -> tuple[list[arb], list[arb]] | None:
        known = {**s.phase.environment, **_chosen(action)}
        at = x.reference.values(known)
        p = [at(place) for place in action.slopes]
        moving = {(f"p_{n}", 0): value for n, value in zip(action.names, p, strict=True)}
        H = x.reference.values({**known, **moving})(action.H)
        pushed = dot([rate(at, place) for place in action.slopes], [at(q) for q in action.q])
        left, right = [pushed + at(of_time[0])], [-H]
        if len(of_time) > 1:
            left, right = [*left, rate(at, of_time[1])], [*right, at(of_time[0])]
        return left, right

    return x.decide(what, sides)


def _chosen(action: Action) -> Mapping[tuple[str, int], arb]:
    """Values of the constants and integrals."""
    keys = [*action.constants, *((name, 0) for name in action.section.integrals)]
    return {key: arb(5 + 3 * k) / 8 for k, key in enumerate(keys)}
