"""Whether there is an equilibrium that is not listed, searched for by Newton's method."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from random import Random

from flint import arb

from lagcli.answers import Equilibrium
from lagcli.verification.claims.rest import NOTHING, Near, Place, eigenvalues
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, size, solve
from lagcli.verification.states import Environment

_STARTS = 8
_STEPS = 25
#: How near two places are the same.
_SAME = 1e-9


def another(x: Examination, listed: Sequence[Equilibrium], places: Sequence[Place]) -> str:
    """An equilibrium that none of these is, up to whole turns; empty where none was found.

    Only for systems without constraints, contacts and families, whose forces are smooth.
    """
    if x.problem.constraints or x.problem.contacts or any(e.free or e.on for e in listed):
        return ""
    if any(e.sticking or e.indeterminate for e in listed):
        return ""
    random = Random(5)
    for state in x.states(2):
        known = [place for each in places if (place := each.near(state.environment)) is not None]
        for _ in range(_STARTS):
            environment = dict(state.environment)
            for name in x.reference.names:
                environment[name, 0] = arb(random.randint(-3600, 3600)) / 1024
                environment[name, 1] = arb(0)
            found = _rest(x, environment)
            if found is not None and not any(_same(x, found, each) for each in known):
                where = (f"{n} = {float(found.environment[n, 0]):.6g}" for n in x.reference.names)
                return ", ".join(where)
    return ""


def _rest(x: Examination, environment: Environment) -> Near | None:
    """Newton's method on d(V - T_0)/dq = Q, from one place."""
    names = x.reference.names
    step = arb(2) ** -60
    for _ in range(_STEPS):
        here = Near(x, environment)
        pull = here.pull
        if not all(each.is_finite() for each in pull):
            return None
        if max(map(size, pull)) < NOTHING**2:
            definite = all(abs(z) > _SAME for z in eigenvalues(here.laws.mass_matrix))
            return here if definite and here.regular and _allowed(x, here) else None
        columns = []
        for name in names:
            moved = {**environment, (name, 0): environment[name, 0] + step}
            pairs = zip(pull, Near(x, moved).pull, strict=True)
            columns.append([(b - a) / step for a, b in pairs])
        rows = [list(row) for row in zip(*columns, strict=True)]
        try:
            change = solve(rows, [-each for each in pull], len(names)).x
        except Unclear:
            return None
        longest = max(map(size, change))
        if not longest < 1e6:
            return None
        for name, d in zip(names, change, strict=True):
            shorter = d if longest < 1 else d / arb(longest)
            environment[name, 0] = (environment[name, 0] + shorter).mid()
    return None


def _allowed(x: Examination, near: Near) -> bool:
    signs = {"positive": 1, "nonnegative": 1, "negative": -1}
    far = any(size(near.environment[n, 0]) > 30 for n in x.reference.names)
    return not far and all(
        float(near.environment[c.name, 0]) * signs.get(c.assume, 0) >= 0
        for c in x.problem.coordinates
    )


def _same(x: Examination, a: Near, b: Near) -> bool:
    """Whether two places are equal, up to whole turns."""
    gaps = (float(a.environment[n, 0] - b.environment[n, 0]) for n in x.reference.names)
    return all(abs(gap - 2 * pi * round(gap / (2 * pi))) < _SAME for gap in gaps)
