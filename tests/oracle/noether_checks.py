"""Charges: the formula, the rate along the motion, the verdict, the boundary term."""

from __future__ import annotations

from dataclasses import replace
from random import Random
from typing import Any

from mpmath import mpf

from lagcli.expression import Expression

from .evaluate import Moment
from .examine import Examination, agree, vanishes
from .jets import Number, real_part
from .reference import Scalar, dot, gradient, rate, rates
from .states import random_moments, reals


def check(x: Examination) -> None:
    """The charges of the candidates and of the evident symmetries."""
    listed: list[dict[str, Any]] = []
    for section in ("charges", "discovered"):
        for entry in x.sheet.get(section) or []:
            if entry not in listed:
                listed.append(entry)
                _charge(x, entry)
    if "charges" in x.sheet:
        _complete(x, x.sheet["charges"])


def _complete(x: Examination, listed: list[dict[str, Any]]) -> None:
    """Every candidate is answered, and the evident conserved quantities are there."""
    names = [entry["name"] for entry in listed]
    for symmetry in x.problem.symmetries:
        if symmetry.name not in names:
            x.missing(f"charges.{symmetry.name}", "the candidate is not answered")
    for j, name in enumerate(x.reference.names):
        cyclic = vanishes(
            [real_part(gradient(x.reference.lagrangian, s.moment, 0)[j]) for s in x.states]
        )
        if cyclic and f"p_{name}" not in names:
            # a momentum that the constraints alone make 0 is no result (form.md, rule 12)
            if vanishes([reals(x.reference.momenta(s.moment))[j] for s in x.states]):
                continue
            same = any(
                _proportional(x, entry, lambda m, j=j: x.reference.momenta(m)[j])
                for entry in listed
            )
            if not same:
                x.missing(f"charges.p_{name}", "the cyclic coordinate is not listed")


def _proportional(x: Examination, entry: dict[str, Any], truth: Scalar) -> bool:
    node = x.read(f"charges.{entry['name']}", entry["charge"])
    if node is None:
        return False
    ratios = []
    for state in x.states[:1]:
        for moment in _neighbours(state.moment):
            value = real_part(x.reference.of(node)(moment))
            ratios.append((value, real_part(truth(moment))))
    (a, b), *rest = ratios
    return all(agree(a * d, b * c) for c, d in rest)


def _neighbours(moment: Moment) -> list[Moment]:
    """States with the same parameters and other velocities."""
    return [moment, moment.shifted(1, {j: mpf(j + 1) / 64 for j in range(len(moment.chain[0]))})]


def _transformation(
    x: Examination, entry: dict[str, Any]
) -> tuple[dict[str, Expression], Expression | None]:
    where = f"charges.{entry['name']}.transformation"
    read = {name: x.read(where, text) for name, text in entry["transformation"].items()}
    given = {name: node for name, node in read.items() if node is not None}
    time = given.pop("t", None)
    return given, time


def _charge(x: Examination, entry: dict[str, Any]) -> None:
    where = f"charges.{entry['name']}"
    changes, time = _transformation(x, entry)
    _as_asked(x, entry, changes, time)
    gauge = None if entry["gauge"] is None else x.read(where + ".gauge", entry["gauge"])
    if entry["charge"] is None:
        x.missing(where)
        return
    charge = x.read(where, entry["charge"])
    if charge is None:
        return
    truth = x.reference.charge(changes, time, gauge)
    sign = _sign(entry)
    x.compare(where, entry["charge"], lambda s: sign * truth(s.moment))
    _rate(x, entry, x.reference.of(charge), changes, time)
    if entry["source"] == "candidate":
        _boundary_term(x, entry, changes, time)


def _sign(entry: dict[str, Any]) -> int:
    """The energy is listed with Q = +h for Dt = 1."""
    shift = entry["transformation"] == {"t": "1"}
    return -1 if entry["source"] == "time" or (entry["source"] == "discovered" and shift) else 1


def _as_asked(
    x: Examination,
    entry: dict[str, Any],
    changes: dict[str, Expression],
    time: Expression | None,
) -> None:
    """The transformation of a candidate is that of the file."""
    for symmetry in x.problem.symmetries:
        if entry["source"] == "candidate" and symmetry.name == entry["name"]:
            pairs = [(symmetry.changes.get(n), changes.get(n)) for n in x.reference.names]
            for asked, answered in [*pairs, (symmetry.time, time)]:
                for state in x.states:
                    a, b = (
                        mpf(0) if node is None else real_part(x.reference.of(node)(state.moment))
                        for node in (asked, answered)
                    )
                    if not agree(a, b):
                        x.wrong(f"charges.{entry['name']}.transformation", "is not the file's")


def _rate(
    x: Examination,
    entry: dict[str, Any],
    charge: Scalar,
    changes: dict[str, Expression],
    time: Expression | None,
) -> None:
    """dQ/dt on the motion; where q'' is not determined, off it by Noether's identity."""
    where = f"charges.{entry['name']}"
    if all(s.regular for s in x.states):
        true = [real_part(rate(charge, s.moment)) for s in x.states]
    else:
        true = _rates_off_the_motion(x, entry, charge, changes, time)
    conserved = vanishes(true)
    if entry["conserved"] is None:
        x.missing(where + ".conserved", f"undecided, true is {conserved}")
    elif entry["conserved"] is not conserved:
        x.wrong(where + ".conserved", f"{entry['conserved']}, the rates are {true}")
    if entry["rate"] is None:
        x.missing(where + ".rate")
        return
    rates_by_state = {id(s): r for s, r in zip(x.states, true, strict=True)}
    x.compare(where + ".rate", entry["rate"], lambda s: rates_by_state[id(s)])


def _rates_off_the_motion(
    x: Examination,
    entry: dict[str, Any],
    charge: Scalar,
    changes: dict[str, Expression],
    time: Expression | None,
) -> list[mpf]:
    """dQ/dt - sum_j (d/dt(dL/dq_j') - dL/dq_j - Q_j) (Dq_j - q_j' Dt), for any q''."""
    sign = _sign(entry)

    def identity(m: Moment) -> Number:
        forces = x.reference.applied(m)
        residual = [e - f for e, f in zip(x.reference.inertia(m), forces, strict=True)]
        stretch = mpf(0) if time is None else x.reference.of(time)(m)
        characteristic = [
            (x.reference.of(changes[n])(m) if n in changes else mpf(0)) - v * stretch
            for n, v in zip(x.reference.names, m.chain[1], strict=True)
        ]
        return rate(charge, m) - sign * dot(residual, characteristic)

    return [real_part(identity(s.moment)) for s in x.states]


def _boundary_term(
    x: Examination,
    entry: dict[str, Any],
    changes: dict[str, Expression],
    time: Expression | None,
) -> None:
    """K = dG/dt for the G that was found; where none was, K is no total derivative."""
    where = f"charges.{entry['name']}.gauge"
    asked = next(s for s in x.problem.symmetries if s.name == entry["name"])
    change = x.reference.change_of_action(changes, time)
    if entry["gauge"] is not None:
        gauge = x.read(where, entry["gauge"])
        if asked.gauge is not None:
            same = lambda s: x.reference.of(asked.gauge)(s.moment)  # noqa: E731
            x.compare(where, entry["gauge"], same)
        elif gauge is not None and not x.problem.constraints:
            for s in x.states:
                growth = real_part(rate(x.reference.of(gauge), s.moment))
                if not agree(real_part(change(s.moment)), growth):
                    x.wrong(where, f"dG/dt is not the change of L for G = {entry['gauge']}")
        return
    _no_boundary_term(x, where, change)


def _no_boundary_term(x: Examination, where: str, change: Scalar) -> None:
    """K(t, q, q', q'') = dG/dt only if K_q - d/dt K_q' + d^2/dt^2 K_q'' = 0 identically."""
    random = Random(3)
    residuals: list[mpf] = []
    for moment in random_moments(x.reference, 2, seed=7, constrained=False):
        higher = [
            tuple(mpf(random.randint(-99, 99)) / 50 for _ in moment.chain[0]) for _ in range(3)
        ]
        m = replace(moment, chain=(*moment.chain[:2], *higher))

        def by_velocity(n: Moment) -> list[Number]:
            return gradient(change, n, 1)

        def growth_by_acceleration(n: Moment) -> list[Number]:
            return rates(lambda k: gradient(change, k, 2), n)

        terms = zip(
            gradient(change, m, 0),
            rates(by_velocity, m),
            rates(growth_by_acceleration, m),
            strict=True,
        )
        residuals += reals([a - b + c for a, b, c in terms])
    if vanishes(residuals):
        x.missing(where, "the change of L is a total derivative, no boundary term was found")
