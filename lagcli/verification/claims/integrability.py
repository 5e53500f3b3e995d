"""Whether velocity constraints are integrable, by the derivatives of their forms at random states.

Of forms w_k = a_k dq + b_k dt and their common kernel, dw_k(u, v) = 0 for all u, v in it where w_k
belongs to the integrable part; where it vanishes for all k, all of them are integrable (Frobenius).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from flint import arb

from lagcli.statements.answers import MultipliersSection
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, dot, size, solve
from lagcli.verification.states import State
from lagcli.verification.sweeps import column

#: Of the curls at random states: those that are not 0 are some 1e-2.
_NOTHING = 1e-15


def refuted_kinds(x: Examination, section: MultipliersSection) -> list[str]:
    """The constraints that are called integrable, or not, and are not so."""
    kinds = [section.multipliers[row.constraint.name].kind for row in x.reference.rows]
    if not {"integrable", "nonholonomic"} & {*kinds} or x.reference.large:
        return []
    wrong: set[int] = set()
    states, turning = x.states()[:2], False
    for state in states:
        try:
            for curls in _curls(x, state):
                curled = {k for k, curl in enumerate(curls) if size(curl) > _NOTHING}
                wrong |= {k for k in curled if kinds[k] == "integrable"}
                turning = turning or bool(curled)
        except Unclear:
            return []
    if states and not turning:
        wrong |= {k for k, kind in enumerate(kinds) if kind == "nonholonomic"}
    return [x.reference.rows[k].constraint.name for k in sorted(wrong)]


def _curls(x: Examination, state: State) -> Iterator[list[arb]]:
    """dw_k(u, v) by constraint, for each two vectors u, v of a basis of the kernel."""
    reference = x.reference
    still = {(name, 1): arb(0) for name in reference.names}
    at = reference.values({**state.environment, **still})
    gradients = [at.gradient(row.velocity) for row in reference.rows]
    forms = [
        [*column(by, reference.v), at(row.velocity)]
        for by, row in zip(gradients, reference.rows, strict=True)
    ]
    places = [*reference.q, reference.time]
    kernel = solve(forms, [arb(0)] * len(forms), len(places)).kernel
    for u, v in combinations(kernel, 2):
        found = []
        for row, by in zip(reference.rows, gradients, strict=True):
            along = []
            for one, other in ((u, v), (v, u)):
                rates = at.gradient_rates(row.velocity, by, dict(zip(places, one, strict=True)))
                drift = dot(column(by, places), one)
                along.append(dot([*column(rates, reference.v), drift], other))
            found.append(along[0] - along[1])
        yield found
