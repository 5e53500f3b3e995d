"""The condition number of the mass matrix, whatever units its coordinates have."""

from __future__ import annotations

import math

from lagcli.numerics.certified.precise import precision
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
    from flint import arb, arb_mat

    n = scene.n
    with precision(_DIGITS):
        motion, state = scene.in_balls()
        entries = [entry for row in scene.equations.mass for entry in row]
        mass = arb_mat(n, n, [arb(x).mid() for x in motion.function(entries)(*state)])
        scales = [abs(mass[i, i]).rsqrt() for i in range(n)]
        scaled = [[mass[i, j] * scales[i] * scales[j] for j in range(n)] for i in range(n)]
        if not all(x.is_finite() for row in scaled for x in row):
            return math.inf
        values = arb_mat(scaled).mid().eig(algorithm="approx", nonstop=True)
        sizes = sorted((abs(x.real.mid()) for x in values), key=float)
        if not sizes[0] > _SINGULAR * sizes[-1]:
            return math.inf
        return float(sizes[-1] / sizes[0])
