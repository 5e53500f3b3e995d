"""Problems that give H: what is printed in q and p, at random points of the phase space."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from mpmath import mpf

from .evaluate import Moment, OutsideDomain
from .examine import Examination, agree
from .jets import Number, coefficient, family, infinitesimal, real_part
from .linear import Matrix, rank
from .reference import Reference, gradient
from .states import anywhere

#: What is read off L, and null where H has none.
OF_L = ("lagrangian", "matrix_form", "accelerations", "multipliers", "momenta")


def check(x: Examination) -> None:
    """H is the file's; q' = dH/dp, and p' = -dH/dq where no forces act."""
    points = list(phase_points(x.reference))
    expected = {"hamiltonian": [real_part(x.reference.hamiltonian(m)) for m in points]}
    claims = {"hamiltonian": x.sheet.get("hamiltonian")}
    pairs = x.sheet.get("canonical_equations") or {}
    for j, name in enumerate(x.reference.names):
        claims[f"canonical_equations.{name}.q"] = pairs.get(name, {}).get("q")
        expected[f"canonical_equations.{name}.q"] = [
            real_part(slopes_by_momenta(x.reference, m)[j]) for m in points
        ]
        if not (x.problem.forces or x.problem.dissipation or x.problem.constraints):
            claims[f"canonical_equations.{name}.p"] = pairs.get(name, {}).get("p")
            expected[f"canonical_equations.{name}.p"] = [
                -real_part(gradient(x.reference.hamiltonian, m, 0)[j]) for m in points
            ]
    for where, values in expected.items():
        node = x.read(where, claims[where])
        for moment, true in zip(points, values, strict=True):
            value = node and x.number(where, node, moment)
            if value is not None and not agree(value, true):
                x.wrong(where, f"{claims[where]} is {value}, true is {true}")


def check_without_lagrangian(x: Examination) -> None:
    """Where the Hessian of H by the momenta is singular, nothing of L is claimed."""
    check(x)
    for name in OF_L:
        if name in x.sheet and x.sheet[name] not in (None, [], {}):
            x.wrong(name, f"{x.sheet[name]!r}, though H has no Lagrangian")


def is_singular(reference: Reference) -> bool:
    """Whether d2H/dp2 is singular at every point."""
    size = reference.size
    return all(rank(_hessian(reference, m), size) < size for m in phase_points(reference))


def slopes_by_momenta(reference: Reference, moment: Moment) -> list[Number]:
    """dH/dp_j."""
    with family() as nearby:
        names = [f"p_{name}" for name in reference.names]
        steps = {n: moment.extra[n] + infinitesimal(nearby, j) for j, n in enumerate(names)}
        there = Moment(moment.t, moment.chain, {**moment.extra, **steps})
        value = reference.hamiltonian(there)
        return [coefficient(value, nearby, j) for j in range(reference.size)]


def _hessian(reference: Reference, moment: Moment) -> Matrix:
    size = reference.size
    with family() as nearby:
        names = [f"p_{name}" for name in reference.names]
        steps = {n: moment.extra[n] + infinitesimal(nearby, j) for j, n in enumerate(names)}
        there = Moment(moment.t, moment.chain, {**moment.extra, **steps})
        slopes = slopes_by_momenta(reference, there)
        return [[real_part(coefficient(s, nearby, j)) for j in range(size)] for s in slopes]


def phase_points(reference: Reference, count: int = 2, seed: int = 3) -> Iterator[Moment]:
    """Moments with random q, p and t at which H is real."""
    random = Random(seed)
    found = 0
    while found < count:
        moment = anywhere(reference.problem, random, 0.0)
        named = {f"p_{name}": mpf(random.uniform(-1, 1)) for name in reference.names}
        moment = Moment(moment.t, moment.chain, {**moment.extra, **named})
        try:
            reference.hamiltonian(moment)
        except (OutsideDomain, ZeroDivisionError):
            continue
        found += 1
        yield moment
