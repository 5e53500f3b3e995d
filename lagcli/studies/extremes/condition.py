"""The condition number of the mass matrix, whatever units its coordinates have."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from lagcli.numerics.certified.precise import precision
from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.motion import Motion
from lagcli.studies.extremes.scene import ExtremeScene

_DIGITS = 60
#: A smallest eigenvalue below this part of the largest is none.
_SINGULAR = 1e-45


def mass_condition(scene: ExtremeScene) -> float:
    """Of D M D with D = diag(M)^(-1/2), in the 2-norm; inf where M is singular.

    Worked out with 60 digits at the state as doubles: no scaling is better by more than a
    factor n.

    References
    ----------
    van der Sluis, "Condition numbers and equilibration of matrices", Numer. Math. 14 (1969).
    """
    import mpmath

    e, n = scene.equations, scene.n
    with precision(_DIGITS):
        arithmetic = Balls()
        constants = {symbol: arithmetic.ball(x) for symbol, x in scene.constants.items()}
        motion = Motion(e, constants, arithmetic)
        state = [arithmetic.ball(x) for x in (0.0, *scene.q, *scene.v)]
        values = motion.function([entry for row in e.mass for entry in row])(*state)
        if not all(arithmetic.ball(x).is_finite() for x in values):
            return math.inf
        with mpmath.workdps(_DIGITS):
            numbers = [_number(arithmetic.ball(x)) for x in values]
            return _condition([numbers[n * i : n * i + n] for i in range(n)])


def _number(ball: Any) -> Any:
    import mpmath

    return mpmath.mpf(ball.mid().str(_DIGITS, radius=False))


def _condition(rows: Sequence[Sequence[Any]]) -> float:
    import mpmath

    n = len(rows)
    if not all(rows[i][i] for i in range(n)):
        return math.inf
    scales = [1 / mpmath.sqrt(abs(rows[i][i])) for i in range(n)]
    scaled = [[rows[i][j] * scales[i] * scales[j] for j in range(n)] for i in range(n)]
    sizes = sorted(abs(x) for x in mpmath.eigsy(mpmath.matrix(scaled), eigvals_only=True))
    if not sizes[0] > _SINGULAR * sizes[-1]:
        return math.inf
    return float(sizes[-1] / sizes[0])
