"""The loop over the steps of a Taylor series, in the language of `language`.

Memory, as places from `Reals` on:

- `rows`: the coefficients, each row `STRIDE` long, of q, q' and t, then what the problem
  needs, in powers of t / s: s, the coefficient 1 of t, is a power of 2 near the step, so
  that none leaves the range of the numbers;
- a state: q, q', t;
- `peaks`, `scales`: as in `steps.Tolerance`; `held`: as in `surface.Surface`, the scales
  of all constraints and then their residuals;
- `facts`, `counts`: single numbers, by the names in capitals below.

References
----------
Jorba, Zou, "A software package for the numerical integration of ODEs by means of
high-order Taylor methods", Experimental Mathematics 14 (2005), section 3.
Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", ZAMM
54 (1974).
"""

from __future__ import annotations

from lagcli.numerics.compiled.intrinsics import (
    Ints,
    Reals,
    at,
    exp,
    fma,
    log,
    positions,
    series,
    sizes,
    sqrt,
    velocities,
)

STRIDE = 44

# facts
UNTIL = 0
TOLERANCE = 1
LONGEST = 2
SPAN = 3
FLOOR = 4
H = 5
DEFECT = 6
SHORTEST = 7
ROUNDING = 8
SCALE = 9

# counts
N = 0
ORDER = 1
PENDING = 2
TIMES = 3
STEPS = 4
LIMIT = 5
PROBES = 6
PROBED = 7
HOLONOMIC = 8
CONSTRAINTS = 9

# what a call comes back with
MORE = 0
DONE = 1
STOPPED = 2
PIVOT = 3

PART = 0.999
GOLDEN = 0.6180339887498949
SAFETY = 0.9
FIRST = 1e-3
LARGE = 1e300
WIDEST = 256.0
STARTING = 4


def see(rows: Reals, peaks: Reals, scales: Reals, facts: Reals, counts: Ints, order: int) -> None:
    """Note where the motion is and, for what has been at 0 so far, where it goes at first."""
    n = counts[N]
    higher = False
    top = 0.0
    for i in range(2 * n):
        size = abs(rows[i * STRIDE])
        if size == 0 and peaks[i] == 0:
            h = sudden(rows, facts, n) / facts[SCALE]
            size = leading(at(rows, i * STRIDE), order, h)
        if size > peaks[i]:
            peaks[i] = size
            higher = True
        top = max(top, peaks[i])
    if higher:
        rescale(peaks, scales, facts, n, top)


def leading(c: Reals, order: int, h: float) -> float:
    """The first term of a series that is not 0, after a time h."""
    power = 1.0
    for k in range(1, order + 1):
        power = power * h
        if c[k] != 0:
            return abs(c[k]) * power
    return 0.0


def sudden(rows: Reals, facts: Reals, n: int) -> float:
    """A time in which nothing that is not 0 changes by more than itself."""
    h = FIRST * facts[LONGEST] / facts[SCALE]
    for i in range(2 * n):
        c = at(rows, i * STRIDE)
        if c[0] != 0:
            if abs(c[1]) * h > abs(c[0]):
                h = abs(c[0] / c[1])
            if abs(c[2]) * h * h > abs(c[0]):
                h = sqrt(abs(c[0] / c[2]))
    return h * facts[SCALE]


def rescale(peaks: Reals, scales: Reals, facts: Reals, n: int, top: float) -> None:
    """The peaks; a velocity's is at least its coordinate's over the span."""
    least = max(facts[FLOOR] * top, 1e-300)
    for j in range(n):
        scales[j] = max(peaks[j], least)
        scales[n + j] = max(peaks[n + j], least, peaks[j] / facts[SPAN])


def length(rows: Reals, scales: Reals, both: int, order: int, tolerance: float) -> float:
    """The step after which the last terms are the tolerance times the scale, in units of s."""
    h = LARGE
    for k in range(order, order - 4, -1):
        largest = 0.0
        for i in range(both):
            largest = max(largest, abs(rows[i * STRIDE + k]) / scales[i])
        if largest * raised(h, k) > tolerance:
            h = exp(log(tolerance / largest) / k)
    return SAFETY * h


def raised(x: float, k: int) -> float:
    """x to the power k > 0, by squares."""
    result = 1.0
    bits = k
    while bits > 0:
        half = bits // 2
        if bits > 2 * half:
            result = result * x
        x = x * x
        bits = half
    return result


def expand(
    rows: Reals, signs: Reals, state: Reals, peaks: Reals, scales: Reals, facts: Reals, counts: Ints
) -> int:
    """The series at a state, and in `facts` how long its step is; PIVOT, STOPPED or MORE."""
    n = counts[N]
    both = 2 * n
    for i in range(both + 1):
        rows[i * STRIDE] = state[i]
    order = counts[ORDER]
    if facts[SCALE] == 0:
        facts[SCALE] = 1.0
        order = STARTING
    h = 0.0
    for _ in range(8):
        rows[both * STRIDE + 1] = facts[SCALE]
        if series(rows, signs, order) == 0:
            return PIVOT
        see(rows, peaks, scales, facts, counts, order)
        h = facts[SCALE] * length(rows, scales, both, order, facts[TOLERANCE])
        h = min(h, facts[LONGEST])
        part = h / facts[SCALE]
        if order == counts[ORDER] and part * WIDEST > 1 and part < WIDEST:
            break
        order = counts[ORDER]
        facts[SCALE] = near(facts[SCALE], h)
    facts[H] = h
    if not h > facts[SHORTEST] * max(state[both], 1e-3 * facts[UNTIL]):  # also where it is nan
        return STOPPED
    return MORE


def near(scale: float, h: float) -> float:
    """A power of 2 near h."""
    if h > 0 and h < LARGE:
        while scale < h:
            scale = scale * 2
        while scale > h:
            scale = scale / 2
    return scale


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
    rows: Reals, state: Reals, lost: Reals, ahead: Reals, end: float, held: Reals, counts: Ints
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
    if total != 0:  # nan: something is not finite
        return STOPPED
    if counts[CONSTRAINTS] > 0:
        return hold(ahead, at(ahead, 2 * both + 1), held, counts)
    return MORE


def hold(state: Reals, work: Reals, held: Reals, counts: Ints) -> int:
    """Back onto the constraints, as `Surface.project`."""
    n = counts[N]
    if counts[HOLONOMIC] > 0:
        before = LARGE
        for _ in range(6):
            if positions(state, work) == 0:
                return PIVOT
            worst = worst_of(at(work, n), held, counts[HOLONOMIC])
            if not (worst > 4e-16 and worst < before):
                break
            before = worst
            for j in range(n):
                state[j] = state[j] - work[j]
    before = LARGE
    for _ in range(3):
        if velocities(state, work) == 0:
            return PIVOT
        worst = worst_of(at(work, n), at(held, counts[HOLONOMIC]), counts[CONSTRAINTS])
        if not (worst > 4e-16 and worst < before):
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
            defect = h * abs(other[(n + j) * STRIDE + 1] - work[j]) / scales[n + j]
            if not defect <= facts[DEFECT]:
                facts[DEFECT] = defect
        if found == 0 or facts[DEFECT] != facts[DEFECT]:
            facts[DEFECT] = LARGE


def drive(
    rows: Reals,
    other: Reals,
    signs: Reals,
    state: Reals,
    lost: Reals,
    ahead: Reals,
    peaks: Reals,
    scales: Reals,
    held: Reals,
    facts: Reals,
    counts: Ints,
    times: Reals,
    out: Reals,
) -> int:
    """Steps until the end, or until so many have been made; the rows asked for into `out`."""
    both = 2 * counts[N]
    work = at(ahead, 2 * both + 1)
    limit = counts[STEPS] + counts[LIMIT]
    while counts[STEPS] < limit:
        status = expand(rows, signs, state, peaks, scales, facts, counts)
        if status != MORE:
            return status
        end = state[both] + facts[H]
        if state[both] + 1.01 * facts[H] >= facts[UNTIL]:
            end = facts[UNTIL]
        h = end - state[both]
        status = move(rows, state, lost, ahead, end, held, counts)
        if status != MORE:
            return status
        if counts[CONSTRAINTS] > 0:
            note(ahead, work, held, counts)
        while counts[PENDING] < counts[TIMES] and times[counts[PENDING]] < end:
            row = at(out, counts[PENDING] * (both + 1))
            inside(rows, row, both, counts[ORDER], times[counts[PENDING]] - state[both])
            row[both] = times[counts[PENDING]]
            if counts[CONSTRAINTS] > 0:
                status = hold(row, work, held, counts)
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
