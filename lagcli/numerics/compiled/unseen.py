"""How long a step may be that passes over nothing, in the language of `language`.

Over a step of length h the argument u of what may be narrow lies within
r = |u_1| h + |u_2| h^2 + ... of its value u_0 at the beginning, in the whole disc of complex
times around it.  So nothing is passed over

- where a u that divides, or stands in a root or a logarithm, has r < |u_0|: it has no zero in
  the disc.  With a simple zero in its inner part, |u_0| + |u_2| h^2 + ... < |u_1| h, what it
  divides is regular all the same if its own series settles (sin(x)/x): a pole would leave the
  ratio of its coefficients at more than 1.5 / h;
- where exp(u) changes by no more than what its series shows, r <= 8, or stays nothing;
- where tanh(u) and 1/cosh(u) are shown by their series, r <= 4, or u stays far from 0;
- where a high power of u changes in the same way by its logarithm, or its own series settles;
- where the u of a sine that is looked at in a few places turns by r <= 3;
- where the u of a sign or an absolute value has no zero, or one at the most: u' has none.

The u are those of the polynomial that the step keeps: r bounds all its values at all times of the
step, none of it is a sample.  It leaves out the terms beyond the order, which the length of the
step holds at the tolerance, and the rounding of the coefficients, for both of which ROOM is left;
a zero that is divided out is judged by coefficients alone.  So a certificate is no proof.  A
polynomial is watched where a power in it is above 8; of products within products, whose degree the
reader limits, the probes of `kernels.probe` see what lasts for 1/2000 of the span.

References
----------
Moore, Kearfott, Cloud, *Introduction to Interval Analysis* (SIAM 2009), chapters 5 and 8.
Rouche's theorem: Ahlfors, *Complex Analysis*, 3rd ed., section 4.5.2.
"""

from __future__ import annotations

from lagcli.numerics.compiled.intrinsics import Ints, Reals, at, exp
from lagcli.numerics.compiled.layout import (
    BLOCKED,
    DIVIDES,
    FLAT,
    GROWS,
    HIGH,
    JUMPS,
    NEAR,
    SHORTENED,
    STRIDE,
    TOUCHED,
    TURNS,
    WATCHED,
    WIDTH,
)

#: A zero at the very rim of the disc is passed in many steps.
ROOM = 0.8
GROWTH = 8.0
VANISHED = 300.0
TURN = 4.0
FAR = 150.0
WAVE = 3.0
#: The last terms of a series that settles are this part of the largest.
SETTLED = 1e-4
#: The length of a step that passes a zero, as a multiple of the distance to it.
INNER = 1.5
SHORTER = 0.8
ATTEMPTS = 400
#: An argument of a sign that only touches 0 shortens a step no more than to 2^-30 of it, and
#: the next one, where it touches again, no more than to 2^-6.
DEEPEST = 9.313225746154785e-10
LEAST = 0.015625
#: Steps after one that was shortened that count as near something narrow.
NEIGHBOURS = 40


def reach(c: Reals, first: int, order: int, part: float) -> float:
    """The sum of |c_k| part^k from k = first on."""
    total = 0.0
    for k in range(order, first - 1, -1):
        total = total * part + abs(c[k])
    for _ in range(first):
        total = total * part
    return total


def bend(c: Reals, order: int, part: float) -> float:
    """The sum of k |c_k| part^k from k = 2 on."""
    total = 0.0
    for k in range(order, 1, -1):
        total = total * part + k * abs(c[k])
    return total * part * part


def settles(c: Reals, order: int, part: float) -> int:
    """Whether the last terms of a series are nothing beside its largest; 1 or 0."""
    power = 1.0
    top = 0.0
    last = 0.0
    for k in range(order + 1):
        size = abs(c[k]) * power
        top = max(top, size)
        if k > order - 4:
            last = max(last, size)
        if not size <= top:
            return 0
        power = power * part
    if last <= SETTLED * top:
        return 1
    return 0


def divides(c: Reals, whole: Reals, has_whole: int, order: int, part: float) -> int:
    """Whether what is divided by this is regular; 1 or 0."""
    first = abs(c[0])
    if reach(c, 1, order, part) <= ROOM * first:
        return 1
    linear = abs(c[1]) * part
    alone = first + reach(c, 2, order, part) <= ROOM * linear
    if has_whole == 1 and INNER * first <= linear and alone:
        return settles(whole, order, part)
    return 0


def is_seen(kind: int, c: Reals, whole: Reals, power: int, order: int, part: float) -> int:
    """Whether a step of this part of s passes over nothing of one kind; 1 or 0."""
    first = abs(c[0])
    rest = reach(c, 1, order, part)
    if kind == GROWS and (rest <= GROWTH or c[0] + rest <= -VANISHED):
        return 1
    if kind == FLAT and (rest <= TURN or first - rest >= FAR):
        return 1
    if kind == HIGH:
        if rest <= first * (exp(GROWTH / power) - 1) or first + rest <= exp(-VANISHED / power):
            return 1
        if whole[0] != 0:
            return settles(whole, order, part)
    if kind == JUMPS and (rest < first or bend(c, order, part) <= abs(c[1]) * part):
        return 1
    if kind == TURNS and rest <= WAVE:
        return 1
    if kind == DIVIDES:
        return divides(c, whole, power, order, part)
    return 0


def is_clear(rows: Reals, watch: Ints, i: int, order: int, part: float, least: float) -> int:
    """Whether the step passes over nothing of what is watched at a place of the list; 1 or 0."""
    kind = watch[i * WIDTH]
    if kind == JUMPS and part < least:
        return 1
    c = at(rows, watch[i * WIDTH + 1] * STRIDE)
    whole = at(rows, watch[i * WIDTH + 2] * STRIDE)
    return is_seen(kind, c, whole, watch[i * WIDTH + 3], order, part)


def unblocked(rows: Reals, watch: Ints, counts: Ints, order: int, part: float) -> float:
    """The part of s over which a step passes over nothing: this or less."""
    before = part + 1
    least = part * DEEPEST
    if counts[TOUCHED] == 1:
        least = part * LEAST
    counts[BLOCKED] = 0
    attempts = 0
    while part < before and attempts < ATTEMPTS:
        before = part
        for i in range(counts[WATCHED]):
            while attempts < ATTEMPTS and is_clear(rows, watch, i, order, part, least) == 0:
                attempts += 1
                part = part * SHORTER
                if watch[i * WIDTH] != JUMPS:
                    counts[BLOCKED] = i + 1
    counts[TOUCHED] = 0
    if part < least:
        counts[TOUCHED] = 1
    if counts[BLOCKED] > 0:
        counts[SHORTENED] += 1
        counts[NEAR] = NEIGHBOURS
    elif counts[NEAR] > 0:
        counts[NEAR] -= 1
    return part
