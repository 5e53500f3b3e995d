"""A Taylor method of its own for theta'' = -k sin theta, as a textbook has it; shares no code.

One step of length h from the set m + B r: the box of an a-priori enclosure by Picard's operator, the
Taylor polynomial from m with the last coefficient over the box, its derivatives with respect to
the initial values over m + B r, and B turned by a QR decomposition.  Every operation is in the same
number of bits, with the balls of python-flint for outward rounding.

N. Nedialkov, K. Jackson, G. Corliss, Appl. Math. Comput. 105 (1999) 21, sections 4 to 6.
"""

from __future__ import annotations

import math
from typing import Any

from flint import arb, arb_mat, ctx

#: A step is this part of 1/sqrt(k); so short, the box is found at once.
_PART = 0.25


def coefficients(theta: Any, omega: Any, k: Any, order: int) -> tuple[list[Any], list[Any]]:
    """Of theta and of its rate: s' = c theta', c' = -s theta', omega' = -k s."""
    angle, rate, sine, cosine = [theta], [omega], [theta.sin()], [theta.cos()]
    for n in range(order):
        angle.append(rate[n] / (n + 1))
        rate.append(-k * sine[n] / (n + 1))
        turned = [(j * angle[j], n + 1 - j) for j in range(1, n + 2)]
        sine.append(sum(a * cosine[i] for a, i in turned) / (n + 1))
        cosine.append(-sum(a * sine[i] for a, i in turned) / (n + 1))
    return angle, rate


def variations(angle: list[Any], k: Any, order: int, first: tuple[int, int]) -> tuple[Any, Any]:
    """Of d theta and d omega, from their first values: d omega' = -k cos(theta) d theta."""
    sine, cosine = [angle[0].sin()], [angle[0].cos()]
    for n in range(order):
        turned = [(j * angle[j], n + 1 - j) for j in range(1, n + 2)]
        sine.append(sum(a * cosine[i] for a, i in turned) / (n + 1))
        cosine.append(-sum(a * sine[i] for a, i in turned) / (n + 1))
    place, speed = [arb(first[0])], [arb(first[1])]
    for n in range(order):
        place.append(speed[n] / (n + 1))
        speed.append(-k * sum(cosine[i] * place[n - i] for i in range(n + 1)) / (n + 1))
    return place, speed


def _value(c: list[Any], h: Any) -> Any:
    total = c[-1]
    for each in reversed(c[:-1]):
        total = each + h * total
    return total


def _box(theta: Any, omega: Any, k: Any, h: Any) -> tuple[Any, Any]:
    """X with x + [0, h] f(X) inside X."""
    times = arb(h / 2, h / 2)
    box = theta, omega
    for _ in range(60):
        image = theta + times * box[1], omega - times * k * box[0].sin()
        if all(x.contains(y) for x, y in zip(box, image, strict=True)):
            return image
        box = tuple(x.union(y) + arb(0, 1e-3) for x, y in zip(box, image, strict=True))
    raise ArithmeticError("the step is too long")


def pendulum(theta: str, k: str, until: int, bits: int) -> tuple[tuple[Any, Any], int]:
    """(theta, theta') at the end from rest, and the number of steps."""
    usual, ctx.prec = ctx.prec, bits
    try:
        return _followed(arb(theta), arb(k), until, bits)
    finally:
        ctx.prec = usual


def _followed(theta: Any, k: Any, until: int, bits: int) -> tuple[tuple[Any, Any], int]:
    steps = math.ceil(until * math.sqrt(float(k)) / _PART)
    h, order = arb(until) / steps, 2 * bits // 5
    middle = [theta.mid(), arb(0)]
    frame = arb_mat(2, 2, [1, 0, 0, 1])
    radii = arb_mat(2, 1, [theta - theta.mid(), 0])
    for _ in range(steps):
        spread = frame * radii
        whole = [m + x for m, x in zip(middle, spread.entries(), strict=True)]
        box = _box(*whole, k, h)
        over = coefficients(*box, k, order)
        point = coefficients(*middle, k, order)
        ends = [_value([*p[:order], o[order]], h) for p, o in zip(point, over, strict=True)]
        series = coefficients(*whole, k, order)[0]
        columns = []
        for first in ((1, 0), (0, 1)):
            at, wide = variations(series, k, order, first), variations(over[0], k, order, first)
            # over the box the variations themselves have grown
            last = [w[order] * 2 * abs(k).sqrt().max(1) for w in wide]
            columns.append([_value([*a[:order], x], h) for a, x in zip(at, last, strict=True)])
        derivative = arb_mat(2, 2, [columns[j][i] for i in range(2) for j in range(2)])
        middle = [x.mid() for x in ends]
        rest = arb_mat(2, 1, [x - m for x, m in zip(ends, middle, strict=True)])
        turned = derivative * frame
        frame = _turned(turned, radii)
        inverse = frame.inv()
        radii = (inverse * turned) * radii + inverse * rest
    spread = (frame * radii).entries()
    return (middle[0] + spread[0], middle[1] + spread[1]), steps


def _turned(matrix: Any, radii: Any) -> Any:
    """Orthogonal axes, the first along the longer side."""
    rows = [[float(x.mid()) for x in row] for row in matrix.tolist()]
    lengths = [
        math.hypot(rows[0][j], rows[1][j]) * float(radii[j, 0].abs_upper()) for j in range(2)
    ]
    j = 0 if lengths[0] >= lengths[1] else 1
    x, y = rows[0][j], rows[1][j]
    x, y = x / math.hypot(x, y), y / math.hypot(x, y)
    return arb_mat(2, 2, [x, -y, y, x])
