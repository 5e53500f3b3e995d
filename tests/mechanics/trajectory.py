"""A trajectory of thirty digits by extrapolation, to test charges on.

The modified midpoint rule with 2, 4, 6, … substeps, extrapolated to none (Gragg, Bulirsch,
Stoer); see Hairer, Noersett, Wanner, *Solving Ordinary Differential Equations I*, section II.9.
"""

import mpmath
from mpmath import mpf

from lagcli.algebra.numeric import Evaluator

DIGITS = 36
STAGES = 12
SPAN = mpf(1) / 5
TOLERANCE = mpf(10) ** -26


def trajectory(dynamics):
    """States along a motion that does not end in a collision."""
    for number in range(1, 6):
        found = _from_state(dynamics, number, SPAN)
        if found is not None:
            return found
    raise AssertionError("every motion tried ends in a collision")


def _from_state(dynamics, number, span):
    """States from t0 to t0 + span: dicts from symbols to values, parameters among them."""
    system = dynamics.system
    evaluate = Evaluator(list(dynamics.motion.accelerations), DIGITS)
    variables = (*system.q, *system.qdot)
    n = len(system.q)
    with mpmath.workdps(DIGITS):
        state = dict(dynamics.states.take(number)[-1])

        def rates(t, y):
            values = evaluate({**state, system.t: t, **dict(zip(variables, y, strict=True))})
            return [*y[n:], *values]

        t, y = state[system.t], [state[x] for x in variables]
        end = t + span
        states = [dict(state)]
        step = span / 4
        while t < end:
            step = min(step, end - t)
            after, error = _extrapolated(rates, t, y, step)
            if error > TOLERANCE:
                step /= 2
                if step < span / 2048:
                    return None
                continue
            t, y = t + step, after
            states.append({**state, system.t: t, **dict(zip(variables, y, strict=True))})
            step *= 2
    return states


def _extrapolated(rates, t, y, step):
    table = []
    for k in range(1, STAGES + 1):
        row = [_midpoint(rates, t, y, step, 2 * k)]
        for j in range(1, k):
            ratio = (mpf(k) / (k - j)) ** 2 - 1
            row.append(
                [a + (a - b) / ratio for a, b in zip(row[-1], table[-1][j - 1], strict=True)]
            )
        table.append(row)
    best, other = table[-1][-1], table[-1][-2]
    return best, max(abs(a - b) / (1 + abs(a)) for a, b in zip(best, other, strict=True))


def _midpoint(rates, t, y, step, count):
    h = step / count
    before, now = y, [a + h * b for a, b in zip(y, rates(t, y), strict=True)]
    for k in range(1, count):
        slope = rates(t + k * h, now)
        before, now = now, [a + 2 * h * b for a, b in zip(before, slope, strict=True)]
    slope = rates(t + step, now)
    return [(a + b + h * c) / 2 for a, b, c in zip(before, now, slope, strict=True)]
