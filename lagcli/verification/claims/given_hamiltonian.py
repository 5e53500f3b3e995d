"""The Lagrangian that follows from the H of a file: p q' - L = H and dH/dp = q' at p = dL/dq'."""

from __future__ import annotations

from flint import arb

from lagcli.verification.examination import Examination
from lagcli.verification.states import State
from lagcli.verification.sweeps import column


def legendre_transform(x: Examination) -> bool:
    """Whether the Lagrangian of the problem is the transform of its H; noted if not."""
    given = x.problem.hamiltonian
    assert given is not None
    H = x.reference.place(given)

    def sides(s: State) -> tuple[list[arb], list[arb]]:
        rates = column(s.at.gradient(H), x.reference.p)
        return [s.laws.energy, *s.laws.velocities], [s.at(H), *rates]

    return x.decide("the Lagrangian that follows from H", sides)
