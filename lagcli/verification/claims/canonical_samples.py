"""Functions of q, q' and t as functions on phase space, at states that share their parameters.

With p = dL/dq', dp = P dq + M dq', so that at constant p and q

    df/dq = f_q - P^T M^-1 f_q',    df/dp = M^-1 f_q'.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import TypeVar

from flint import arb

from lagcli.verification.examination import BRANCHED, LOOKED_AT, Examination
from lagcli.verification.linear import Unclear, dot, solve
from lagcli.verification.phase_points import Slopes, poisson
from lagcli.verification.states import State, onto_constraints
from lagcli.verification.sweeps import column

#: Attempts for each sample: a root may have no value there.
_ATTEMPTS = 8


class CanonicalSample:
    """One state, with the values of functions and their derivatives by q and p."""

    def __init__(self, state: State, functions: Sequence[int]) -> None:
        reference = state.reference
        self.state = state
        self.values = [state.at(f) for f in functions]
        found = [state.at.gradient(f) for f in functions]
        by = [(column(each, reference.q), column(each, reference.v)) for each in found]
        #: by q and q', of the same rank, also where M is regular on the constraints alone
        self.gradients = [[*by_q, *by_v] for by_q, by_v in by]
        self.slopes = slopes_in_phase_space(state, by)

    @property
    def finite(self) -> bool:
        """Whether everything has a value."""
        flat = [e for by_q, by_p in self.slopes for e in (*by_q, *by_p)]
        return all(e.is_finite() for e in (*self.values, *flat))

    def bracket(self, i: int, j: int) -> arb:
        """{f_i, f_j}."""
        return poisson(self.slopes[i], self.slopes[j])


Sample = TypeVar("Sample", bound=CanonicalSample)


def slopes_in_phase_space(
    state: State, by: Sequence[tuple[Sequence[arb], Sequence[arb]]]
) -> list[Slopes]:
    """The derivatives with respect to q and p of functions, by those with respect to q and q'."""
    reference, laws, one = state.reference, state.laws, arb(1)
    P = [column(laws.hessian({q: one}), reference.v) for q in reference.q]  # row j: dp/dq_j
    found = []
    for by_q, by_v in by:
        by_p = list(solve(laws.mass_matrix, by_v, laws.size).x)
        found.append(([a - dot(row, by_p) for a, row in zip(by_q, P, strict=True)], by_p))
    return found


def samples(x: Examination, functions: Sequence[int], count: int) -> list[CanonicalSample]:
    """So many samples, fewer where no more are found.

    They lie around a state at which the functions have values, on the one side of a horizon.
    """
    return next(around_states(x, functions, count, CanonicalSample), [])


def around_states(
    x: Examination,
    functions: Sequence[int],
    count: int,
    sampled: Callable[[State, Sequence[int]], Sample],
) -> Iterator[list[Sample]]:
    """So many samples for each of several choices of the parameters; fewer where no more exist."""

    def inside(states: Sequence[State]) -> list[State]:
        return [s for s in states if all(s.at(f).is_finite() for f in functions)]

    found: list[Sample] = []
    for first in inside(x.states(LOOKED_AT)) or inside(x.states(BRANCHED)) or x.states(1):
        around = _around(first, functions, count, sampled)
        found = max(found, around, key=len)
        if len(around) == count:
            yield around
    if len(found) < count:
        yield found


def _around(
    first: State,
    functions: Sequence[int],
    count: int,
    sampled: Callable[[State, Sequence[int]], Sample],
) -> list[Sample]:
    found: list[Sample] = []
    for state in nearby(first, count * _ATTEMPTS):
        try:
            sample = sampled(state, functions)
        except Unclear:
            continue
        if sample.finite:
            found.append(sample)
        if len(found) == count:
            break
    return found


def nearby(first: State, count: int) -> Iterator[State]:
    """States with the parameters of the first and other t, q and q', on the constraints."""
    random, reference = Random(23), first.reference
    for _ in range(count):
        known = dict(first.environment)
        for key in [("t", 0), *((n, k) for n in reference.names for k in (0, 1))]:
            change = arb(random.randint(-512, 512)) / 1024
            known[key] = known[key] * (1 + change) + (change / 8 if key[1] else 0)
        if onto_constraints(reference, known):
            yield State(reference, known)
