"""Which of several one-sided contacts carry: w = W z + b with w, z >= 0 and w z = 0.

References
----------
Murty, *Linear Complementarity, Linear and Nonlinear Programming* (1988), section 4.1: the
least-index principal pivoting ends for every P-matrix, as W = A M^-1 A^T of independent
contacts is.
Glocker, *Set-Valued Force Laws* (2001), chapters 8 and 9 (impacts and contact forces).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

#: For a set of carrying contacts: the force of each of them, the separation of the others.
Trial = Callable[[frozenset[int]], tuple[Mapping[int, float], Mapping[int, float]]]

_ROUNDS = 200


def carrying(contacts: frozenset[int], trial: Trial, rounding: float) -> frozenset[int] | None:
    """The contacts that carry.

    Parameters
    ----------
    contacts
        All that may.
    trial
        What follows when some carry.
    rounding
        A force or separation above minus this is not negative.

    Returns
    -------
    frozenset of int or None
        None where no set was found.
    """
    chosen = contacts
    for _ in range(_ROUNDS):
        forces, separations = trial(chosen)
        wrong = [k for k, force in forces.items() if force < -rounding]
        wrong += [k for k, separation in separations.items() if separation < -rounding]
        if not wrong:
            return chosen
        chosen ^= {min(wrong)}
    return None
