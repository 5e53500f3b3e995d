"""The boundary term of a candidate: K = dG/dt, and that there is none where none is given.

The change of the action by Delta q = Dq, Delta t = Dt is the integral of

    K = sum_j [ dL/dq_j Dq_j + dL/dq_j' (d(Dq_j)/dt - q_j' d(Dt)/dt) ] + dL/dt Dt + L d(Dt)/dt,

which is a total derivative if and only if dK/dq_j - d/dt dK/dq_j' + d^2/dt^2 dK/dq_j'' = 0
identically (Euler's operator; Olver, *Applications of Lie Groups to Differential Equations*,
2nd ed., theorem 4.7).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from random import Random

from flint import arb

from lagcli.expression import ZERO
from lagcli.statements.answers import Charge
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import Examination
from lagcli.verification.linear import size, solve
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues, column

#: Of terms of order 1, at 128 bits.
_NOTHING = 1e-20


def boundary_term(x: Examination, charge: Charge) -> bool:
    """Whether the boundary term of a candidate is right, be it that there is none."""
    given = [each for each in x.problem.symmetries if each.name == charge.name]
    if charge.source != "candidate" or not given or x.reference.large:
        return True
    what = f"the boundary term of '{charge.name}'"
    if given[0].gauge is not None:
        return charge.gauge is not None and x.holds(
            what, charge.gauge, lambda s: s.at(x.reference.place(given[0].gauge or ZERO))
        )
    change = _change_of_action(x, charge)
    if change is None:
        return True
    if charge.gauge is not None:
        gauge = x.places(what, [charge.gauge])
        if gauge is None:
            return False
        growth = x.reference.program.rate(gauge[0])
        return x.decide(what, lambda s: ([s.loose.at(growth)], [s.loose.at(change)]))
    # on either side of a kink K may be dG/dt without a G that is continuous there
    if x.has_kinks or not is_total_derivative(x, change):
        return True
    x.refute(f"that '{charge.name}' has no boundary term", "the change of L is a total derivative")
    return False


def _change_of_action(x: Examination, charge: Charge) -> int | None:
    """The step of K."""
    names = (*x.reference.names, "t")
    places = x.places("", [charge.transformation.get(name, ZERO) for name in names])
    return None if places is None else change_of_action(x, places[:-1], places[-1])


def change_of_action(x: Examination, changes: Sequence[int], time: int) -> int:
    """The step of K of the steps of Delta q and Delta t."""
    program, reference = x.reference.program, x.reference
    L = reference.lagrangian
    stretch = program.rate(time)
    drift = reference.by(L, reference.time)
    terms = [program.product(drift, time), program.product(L, stretch)]
    for q, v, p, change in zip(reference.q, reference.v, reference.momenta, changes, strict=True):
        growth = program.sum(program.rate(change), program.negative(program.product(v, stretch)))
        terms += [program.product(reference.by(L, q), change), program.product(p, growth)]
    return program.sum(*terms)


def euler_operator(x: Examination, change: int) -> list[int]:
    """The steps of dK/dq_j - d/dt dK/dq_j' + d^2/dt^2 dK/dq_j''."""
    program, reference = x.reference.program, x.reference
    residuals = []
    for q, v, a in zip(reference.q, reference.v, reference.a, strict=True):
        parts = [reference.by(change, each) for each in (q, v, a)]
        rates = program.rate(parts[1]), program.rate(program.rate(parts[2]))
        residuals.append(program.sum(parts[0], program.negative(rates[0]), rates[1]))
    return residuals


def closed_on_surface(x: Examination, charge: Charge) -> bool:
    """Whether K dt = s dq + k dt may be closed on what the constraints a dq + b dt = 0 allow."""
    change = _change_of_action(x, charge)
    reference, n = x.reference, len(x.reference.q) + 1
    if change is None or not reference.rows:
        return True
    (own, *rows) = (_one_form(x, each) for each in (change, *(r.velocity for r in reference.rows)))
    for state in x.states():
        by = [column(state.at.gradient(f), [*reference.q, reference.time]) for f in own]
        bends = [column(state.at.gradient(f), reference.v) for f in own]
        if any(size(each) > _NOTHING for bend in bends for each in bend):
            return True  # not linear in q' off the surface: not tried
        lines = [[state.at(f) for f in row] for row in rows]
        allowed = solve(lines, [arb(0)] * len(lines), n).kernel
        for u, w in combinations(allowed, 2):
            terms = [(by[j][i] - by[i][j]) * u[i] * w[j] for i in range(n) for j in range(n)]
            if size(sum(terms, arb(0))) > _NOTHING * (1 + sum(map(size, terms))):
                x.refute(f"that '{charge.name}' is conserved", "L changes by no total derivative")
                return False
    return True


def _one_form(x: Examination, linear: int) -> list[int]:
    """The steps of the coefficients of dq and dt of what is linear in q'."""
    program, reference = x.reference.program, x.reference
    slopes = [reference.by(linear, v) for v in reference.v]
    terms = (program.product(s, v) for s, v in zip(slopes, reference.v, strict=True))
    return [*slopes, program.sum(linear, *map(program.negative, terms))]


def is_total_derivative(x: Examination, change: int) -> bool:
    """Whether Euler's operator gives 0."""
    return vanish(x, euler_operator(x, change))


def vanish(x: Examination, places: Sequence[int]) -> bool:
    """Whether steps are 0 at random states, off the constraints, with random higher derivatives."""
    states = x.states()
    if not states:
        return False
    return all(is_zero(_anywhere(state)(place)) for state in states for place in places)


def _anywhere(state: State) -> StepValues:
    """The parameters of the state, q near it and its derivatives of orders 1 to 5 random."""
    random = Random(3)
    given = {
        (name, primes): arb(random.randint(-1024, 1024)) / 1024
        for name in state.reference.names
        for primes in range(1, 6)
    }
    for name in state.reference.names:  # off the constraints: Euler's operator knows none
        nearby = arb(random.randint(1000, 1048)) / 1024
        given[name, 0] = state.environment[name, 0] * nearby
    return state.reference.values({**state.environment, **given})
