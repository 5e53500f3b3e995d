"""The loop over the steps of a Taylor series, in the language of `language`.

Memory, as places from `Reals` on:

- `rows`: the coefficients, each row `STRIDE` long, of q, q' and t, then what the problem
  needs, in powers of t / s: s, the coefficient 1 of t, is a power of 2 near the step, so
  that none leaves the range of the numbers;
- a state: q, q', t;
- `peaks`, `scales`: as in `steps.Tolerance`; `held`: as in `surface.Surface`, the scales
  of all constraints and then their residuals;
- `watch`: what may be passed over unseen, `WIDTH` numbers each;
- `facts`, `counts`: single numbers, by the names of `layout`;
- `small`: rows as the first ones, in doubles: see `expansion`.

References
----------
Jorba, Zou, "A software package for the numerical integration of ODEs by means of
high-order Taylor methods", Experimental Mathematics 14 (2005), section 3.
Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", ZAMM
54 (1974).
"""

from __future__ import annotations

from lagcli.numerics.compiled.expansion import expand
from lagcli.numerics.compiled.intrinsics import (
    DoubleCells,
    Ints,
    Reals,
    at,
    fma,
    positions,
    series,
    sizes,
    velocities,
)
from lagcli.numerics.compiled.layout import (
    CLOCK,
    CONSTRAINTS,
    DEFECT,
    DONE,
    HOLONOMIC,
    KICK,
    LARGE,
    LIMIT,
    MORE,
    NARROWEST,
    NEAR,
    ORDER,
    PENDING,
    PIVOT,
    PROBED,
    PROBES,
    ROUNDING,
    STEPS,
    STOPPED,
    STRIDE,
    TIMES,
    UNTIL,
    H,
    N,
)
from lagcli.numerics.compiled.unseen import bend, reach

PART = 0.999
#: The first steps are short because nothing is known yet.
STARTED = 8
#: A velocity that is this part of the largest may be rounding.
NOISE = 1e-9
GOLDEN = 0.6180339887498949


def inside(rows: Reals, out: Reals, both: int, order: int, h: float) -> None:
    """The state a time h after the beginning of the step."""
    part = h / rows[both * STRIDE + 1]
    for i in range(both):
        c = at(rows, i * STRIDE)
        x = c[order]
        for k in range(order - 1, -1, -1):
            x = fma(x, part, c[k])
        out[i] = x
    out[both] = rows[both * STRIDE] + h


def slopes(rows: Reals, out: Reals, n: int, order: int, h: float) -> None:
    """q'' of the series a time h after the beginning of the step."""
    scale = rows[2 * n * STRIDE + 1]
    part = h / scale
    for j in range(n):
        c = at(rows, (n + j) * STRIDE)
        x = order * c[order]
        for k in range(order - 1, 0, -1):
            x = fma(x, part, k * c[k])
        out[j] = x / scale


def move(
    rows: Reals,
    state: Reals,
    lost: Reals,
    ahead: Reals,
    end: float,
    held: Reals,
    facts: Reals,
    counts: Ints,
) -> int:
    """The state at the end of a step and what rounding takes from it, into `ahead`.

    `ahead` has the state, then the 2 n losses, then room for corrections.
    """
    n = counts[N]
    both = 2 * n
    h = (end - state[both]) / rows[both * STRIDE + 1]
    left = at(ahead, both + 1)
    total = 0.0
    for i in range(both):
        c = at(rows, i * STRIDE)
        d = c[counts[ORDER]]
        for k in range(counts[ORDER] - 1, 0, -1):
            d = fma(d, h, c[k])
        d = fma(d, h, lost[i])
        x = state[i]
        s = x + d
        if abs(x) >= abs(d):
            left[i] = d - (s - x)
        else:
            left[i] = x - (s - d)
        ahead[i] = s
        total += s - s
    ahead[both] = end
    if counts[NEAR] > 0:
        kick(rows, ahead, facts, counts, h)
    if total != 0:  # nan: something is not finite
        return STOPPED
    if counts[CONSTRAINTS] > 0:
        return hold(ahead, at(ahead, 2 * both + 1), held, facts, counts)
    return MORE


def kick(rows: Reals, ahead: Reals, facts: Reals, counts: Ints, part: float) -> None:
    """Change the velocities by what the rounding of place and time changes a narrow force.

    In one of two runs: |dF| h |q| eps / |dq| of a step in which q changes by dq and F by dF,
    and likewise for t where it acts.
    """
    n = counts[N]
    size = 0.0
    way = 0.0
    for j in range(n):
        size = max(size, abs(ahead[j]))
        way = max(way, reach(at(rows, j * STRIDE), 1, counts[ORDER], part))
    if facts[KICK] > 0 and way > 0:
        apart = max(size / way, facts[CLOCK] * rows[2 * n * STRIDE] / facts[H])
        for j in range(n, 2 * n):
            change = facts[KICK] * apart * bend(at(rows, j * STRIDE), counts[ORDER], part)
            if ahead[j] < 0:
                change = -change
            ahead[j] = ahead[j] + change


def hold(state: Reals, work: Reals, held: Reals, facts: Reals, counts: Ints) -> int:
    """Back onto the constraints, as `Surface.project`."""
    n = counts[N]
    if counts[HOLONOMIC] > 0:
        before = LARGE
        for _ in range(6):
            if positions(state, work) == 0:
                return PIVOT
            worst = worst_of(at(work, n), held, counts[HOLONOMIC])
            if not (worst > facts[ROUNDING] and worst < before):
                break
            before = worst
            for j in range(n):
                state[j] = state[j] - work[j]
    before = LARGE
    for _ in range(3):
        if velocities(state, work) == 0:
            return PIVOT
        worst = worst_of(at(work, n), at(held, counts[HOLONOMIC]), counts[CONSTRAINTS])
        if not (worst > facts[ROUNDING] and worst < before):
            break
        before = worst
        for j in range(n):
            state[n + j] = state[n + j] - work[j]
    return MORE


def worst_of(residuals: Reals, scales: Reals, count: int) -> float:
    """The largest residual in terms of its constraint's size."""
    worst = 0.0
    for k in range(count):
        size = abs(residuals[k])
        if scales[k] > 0:
            size = size / scales[k]
        if not size <= worst:
            worst = size
    return worst


def note(state: Reals, work: Reals, held: Reals, counts: Ints) -> None:
    """How large the terms of the constraints are at a state, and what residuals are left."""
    n = counts[N]
    first = counts[HOLONOMIC]
    count = first + counts[CONSTRAINTS]
    sizes(state, work)
    for k in range(count):
        held[k] = max(held[k], abs(work[k]))
    if first > 0:
        positions(state, work)
        keep(at(work, n), held, at(held, count), first)
    velocities(state, work)
    keep(at(work, n), at(held, first), at(held, count + first), counts[CONSTRAINTS])


def keep(residuals: Reals, scales: Reals, largest: Reals, count: int) -> None:
    """The largest residuals seen."""
    for k in range(count):
        size = abs(residuals[k])
        if scales[k] > 0:
            size = size / scales[k]
        if not size <= largest[k]:
            largest[k] = size


def probe(
    rows: Reals,
    signs: Reals,
    scales: Reals,
    other: Reals,
    work: Reals,
    facts: Reals,
    counts: Ints,
    h: float,
) -> None:
    """The defect q'' - f(t, q, q') of the series at places that no coefficient knows."""
    n = counts[N]
    both = 2 * n
    least = 0.0
    for j in range(n, both):
        least = max(least, NOISE * scales[j])
    for _ in range(int(counts[PROBES] * h / facts[UNTIL] + PART)):
        counts[PROBED] += 1
        place = counts[PROBED] * GOLDEN
        x = (place - int(place)) * h
        inside(rows, work, both, counts[ORDER], x)
        for i in range(both + 1):
            other[i * STRIDE] = work[i]
        found = series(other, signs, 1)
        slopes(rows, work, n, counts[ORDER], x)
        for j in range(n):
            defect = h * abs(other[(n + j) * STRIDE + 1] - work[j])
            defect = defect / max(least, scales[n + j])
            if not defect <= facts[DEFECT]:
                facts[DEFECT] = defect
        if found == 0 or facts[DEFECT] != facts[DEFECT]:
            facts[DEFECT] = LARGE


def drive(
    rows: Reals,
    small: DoubleCells,
    other: Reals,
    signs: Reals,
    state: Reals,
    lost: Reals,
    ahead: Reals,
    peaks: Reals,
    scales: Reals,
    held: Reals,
    watch: Ints,
    facts: Reals,
    counts: Ints,
    times: Reals,
    out: Reals,
) -> int:
    """Steps until the end, or until there are counts[LIMIT] of them; the requested rows into `out`.

    The state before the shortest step stands behind them.
    """
    both = 2 * counts[N]
    work = at(ahead, 2 * both + 1)
    limit = counts[STEPS] + counts[LIMIT]
    while counts[STEPS] < limit:
        status = expand(rows, small, signs, state, peaks, scales, watch, facts, counts)
        if status != MORE:
            return status
        if counts[STEPS] >= STARTED and facts[H] < facts[NARROWEST]:
            facts[NARROWEST] = facts[H]
            for i in range(both + 1):
                out[counts[TIMES] * (both + 1) + i] = state[i]
        end = state[both] + facts[H]
        if state[both] + 1.01 * facts[H] >= facts[UNTIL]:
            end = facts[UNTIL]
        h = end - state[both]
        status = move(rows, state, lost, ahead, end, held, facts, counts)
        if status != MORE:
            return status
        if counts[CONSTRAINTS] > 0:
            note(ahead, work, held, counts)
        while counts[PENDING] < counts[TIMES] and times[counts[PENDING]] < end:
            row = at(out, counts[PENDING] * (both + 1))
            inside(rows, row, both, counts[ORDER], times[counts[PENDING]] - state[both])
            row[both] = times[counts[PENDING]]
            if counts[CONSTRAINTS] > 0:
                status = hold(row, work, held, facts, counts)
                if status != MORE:
                    return status
            counts[PENDING] += 1
        while counts[PENDING] < counts[TIMES] and times[counts[PENDING]] <= end:
            row = at(out, counts[PENDING] * (both + 1))
            for i in range(both + 1):
                row[i] = ahead[i]
            counts[PENDING] += 1
        probe(rows, signs, scales, other, work, facts, counts, h)
        counts[STEPS] += 1
        for i in range(both):
            state[i] = ahead[i]
            lost[i] = ahead[both + 1 + i]
        state[both] = end
        if end >= facts[UNTIL]:
            return DONE
    return MORE
