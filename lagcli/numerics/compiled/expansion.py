"""The series at a state and how long a step it is good for, in the language of `language`.

With numbers of 80 bits the first coefficients alone are worked out in them.  The others stand
before terms so small that the rounding of doubles, in which the same series is worked out
beside, is below that of 80 bits: they cost what doubles cost.  How many are the first is found
from step to step, by the terms themselves.

References
----------
Jorba, Zou, "A software package for the numerical integration of ODEs by means of
high-order Taylor methods", Experimental Mathematics 14 (2005), section 3.
"""

from __future__ import annotations

from lagcli.numerics.compiled.intrinsics import (
    DoubleCells,
    Ints,
    Reals,
    at,
    exp,
    in_doubles,
    log,
    series,
    sqrt,
)
from lagcli.numerics.compiled.layout import (
    EXACT,
    FLOOR,
    LARGE,
    LONGEST,
    MORE,
    ORDER,
    PIVOT,
    SCALE,
    SHORTEST,
    SPAN,
    STEPS,
    STOPPED,
    STRIDE,
    TOLERANCE,
    UNTIL,
    WATCHED,
    WIDTH,
    H,
    N,
)
from lagcli.numerics.compiled.unseen import unblocked

SAFETY = 0.9
FIRST = 1e-3
WIDEST = 256.0
STARTING = 4
#: Terms whose step differs from the one before it by less than a sixth.
ALIKE = 16.0
#: 2^-15: doubles have 11 bits less than numbers of 80.
SMALL = 0.000030517578125
LOOKED_AT = 3
#: Steps between two attempts with fewer exact coefficients.
OFTEN = 16


def see(rows: Reals, peaks: Reals, scales: Reals, facts: Reals, counts: Ints, order: int) -> None:
    """Note where the motion is and, for what has been at 0 so far, where it goes at first."""
    n = counts[N]
    higher = False
    top = 0.0
    for i in range(2 * n):
        size = abs(rows[i * STRIDE])
        if size == 0 and peaks[i] == 0:
            h = sudden(rows, facts, n, order) / facts[SCALE]
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


def sudden(rows: Reals, facts: Reals, n: int, order: int) -> float:
    """A time in which nothing that is not 0 changes by more than itself.

    Nor does the first term of what begins at 0.
    """
    h = FIRST * facts[LONGEST] / facts[SCALE]
    for i in range(2 * n):
        c = at(rows, i * STRIDE)
        if c[0] != 0:
            if abs(c[1]) * h > abs(c[0]):
                h = abs(c[0] / c[1])
            if abs(c[2]) * h * h > abs(c[0]):
                h = sqrt(abs(c[0] / c[2]))
        else:
            first = 0
            for k in range(1, order + 1):
                if first > 0 and abs(c[k]) * raised(h, k - first) > abs(c[first]):
                    h = exp(log(abs(c[first] / c[k])) / (k - first))
                if first == 0 and c[k] != 0:
                    first = k
    return h * facts[SCALE]


def rescale(peaks: Reals, scales: Reals, facts: Reals, n: int, top: float) -> None:
    """The peaks; a velocity's is at least its coordinate's over the span."""
    least = max(facts[FLOOR] * top, 1e-300)
    for j in range(n):
        scales[j] = max(peaks[j], least)
        scales[n + j] = max(peaks[n + j], least, peaks[j] / facts[SPAN])


def length(
    rows: Reals, scales: Reals, both: int, order: int, tolerance: float, guess: float
) -> float:
    """The step after which the last terms are the tolerance times the scale, in units of s.

    Where they nearly are after the step before this one, that of the largest of them counts:
    it misses the least step of all by 3 % at most.
    """
    power = raised(guess, order - 3)
    worst = 0.0
    top = 0.0
    place = order
    for k in range(order - 3, order + 1):
        largest = largest_of(rows, scales, both, k)
        if largest * power > worst:
            worst = largest * power
            top = largest
            place = k
        power = power * guess
    if worst * ALIKE > tolerance and worst < tolerance * ALIKE:
        return SAFETY * exp(log(tolerance / top) / place)
    h = LARGE
    for k in range(order, order - 4, -1):
        largest = largest_of(rows, scales, both, k)
        if largest * raised(h, k) > tolerance:
            h = exp(log(tolerance / largest) / k)
    return SAFETY * h


def largest_of(rows: Reals, scales: Reals, both: int, k: int) -> float:
    """The largest coefficient of an order beside the scale of its component."""
    largest = 0.0
    for i in range(both):
        largest = max(largest, abs(rows[i * STRIDE + k]) / scales[i])
    return largest


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


def coefficients(
    rows: Reals, small: DoubleCells, signs: Reals, watch: Ints, counts: Ints, order: int
) -> int:
    """As `series`; the later coefficients from doubles where these are good enough."""
    exact = counts[EXACT]
    if exact == 0 or exact >= order:
        return series(rows, signs, order)
    if series(rows, signs, exact) == 0:
        return 0
    both = 2 * counts[N]
    for i in range(both + 1):
        small[i * STRIDE] = rows[i * STRIDE]
    small[both * STRIDE + 1] = rows[both * STRIDE + 1]
    if in_doubles(small, signs, order) == 0:
        return series(rows, signs, order)
    for i in range(both):
        for k in range(exact + 1, order + 1):
            rows[i * STRIDE + k] = small[i * STRIDE + k]
    for i in range(counts[WATCHED]):
        for k in range(exact, order):  # one less than of the state
            for j in range(1, 3):
                place = watch[i * WIDTH + j] * STRIDE
                rows[place + k] = small[watch[i * WIDTH + j + 3] * STRIDE + k]
    return 1


def are_small(rows: Reals, both: int, first: int, part: float) -> int:
    """Whether the terms from an order on are small beside the first three; 1 or 0."""
    begin = raised(part, first)
    for i in range(both):
        c = at(rows, i * STRIDE)
        size = SMALL * max(abs(c[0]), abs(c[1]) * part, abs(c[2]) * part * part)
        power = begin
        for k in range(first, first + LOOKED_AT):
            if not abs(c[k]) * power <= size:
                return 0
            power = power * part
    return 1


def suffice(rows: Reals, counts: Ints, order: int, part: float) -> int:
    """Whether there were enough exact coefficients, 1 or 0; how many there are to be next."""
    exact = counts[EXACT]
    if exact == 0:
        return 1
    both = 2 * counts[N]
    if exact < order and are_small(rows, both, exact + 1, part) == 0:
        counts[EXACT] = exact + 1 + exact // 4
        return 0
    if counts[STEPS] == OFTEN * (counts[STEPS] // OFTEN):
        while exact > 3 and are_small(rows, both, exact - 1, part) == 1:
            exact = exact - 1
        counts[EXACT] = exact
    return 1


def expand(
    rows: Reals,
    small: DoubleCells,
    signs: Reals,
    state: Reals,
    peaks: Reals,
    scales: Reals,
    watch: Ints,
    facts: Reals,
    counts: Ints,
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
    for _ in range(12):
        rows[both * STRIDE + 1] = facts[SCALE]
        if coefficients(rows, small, signs, watch, counts, order) == 0:
            return PIVOT
        see(rows, peaks, scales, facts, counts, order)
        guess = 1.0
        if facts[H] > 0:
            guess = facts[H] / facts[SCALE] / SAFETY
        allowed = facts[TOLERANCE]
        if order < counts[ORDER]:  # the unit of time of the motion is sought
            allowed = 1.0
        h = length(rows, scales, both, order, allowed, guess) * facts[SCALE]
        h = min(h, facts[LONGEST])
        part = h / facts[SCALE]
        if order == counts[ORDER] and part * WIDEST > 1 and part < WIDEST:
            enough = suffice(rows, counts, order, part)
            if enough == 1:
                break
        order = counts[ORDER]
        facts[SCALE] = near(facts[SCALE], h)
    if counts[WATCHED] > 0:
        scale = rows[both * STRIDE + 1]
        h = unblocked(rows, watch, counts, order - 1, h / scale) * scale
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
