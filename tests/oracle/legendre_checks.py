"""Momenta, the energy function, the Hamiltonian, the canonical equations."""

from __future__ import annotations

from mpmath import mpf

from lagcli.expression import Call, walk

from .dynamics_checks import jacobian
from .examine import Examination, agree, vanishes, with_momenta
from .jets import real_part
from .linear import rank
from .reference import gradient, rate
from .states import State, random_moments, reals, with_motion


def check(x: Examination) -> None:
    """Everything about p and h."""
    if "momenta" in x.sheet:
        for j, name in enumerate(x.reference.names):
            x.compare(
                f"momenta.{name}",
                x.sheet["momenta"].get(name),
                lambda s, j=j: x.reference.momenta(s.moment)[j],
            )
    if "energy" in x.sheet:
        _energy(x)
    if "hamiltonian" in x.sheet:
        _hamiltonian(x)
    if "canonical_equations" in x.sheet:
        _canonical_equations(x)


def _energy(x: Examination) -> None:
    claim = x.sheet["energy"]
    x.compare("energy.function", claim["function"], lambda s: x.reference.energy(s.moment))
    if all(s.regular for s in x.states):
        conserved = vanishes([real_part(rate(x.reference.energy, s.moment)) for s in x.states])
        _verdict(x, "energy.conserved", claim["conserved"], conserved)
    total: bool | None = None
    if x.problem.lagrangian is None and x.problem.hamiltonian is None:
        total = all(
            agree(
                real_part(x.reference.energy(s.moment)),
                real_part(x.reference.kinetic(s.moment) + x.reference.potential(s.moment)),
            )
            for s in x.states
        )
    _verdict(x, "energy.is_total_energy", claim["is_total_energy"], total)


def _verdict(x: Examination, where: str, claim: bool | None, truth: bool | None) -> None:
    if claim is truth:
        return
    if claim is None:
        x.missing(where, f"undecided, true is {truth}")
    else:
        x.wrong(where, f"{claim}, true is {truth}")


def _hessian_regular(x: Examination) -> bool:
    size = x.reference.size
    return all(
        rank([reals(row) for row in x.reference.mass_matrix(s.moment)], size) == size
        for s in x.states
    )


def _unspecified_momenta(x: Examination) -> bool:
    """Whether L leaves open how it depends on the velocities."""
    given = (x.problem.lagrangian, x.problem.kinetic, x.problem.potential)
    return any(
        isinstance(part, Call) and part.function in x.problem.functions and x.reference.moves(part)
        for node in given
        if node is not None
        for part in walk(node)
    )


def _hamiltonian(x: Examination) -> None:
    """H(q, dL/dq') = h, on the constraints and off them."""
    if x.sheet["hamiltonian"] is None:
        if _hessian_regular(x) and not _unspecified_momenta(x):
            x.missing("hamiltonian")
        return
    x.compare(
        "hamiltonian",
        x.sheet["hamiltonian"],
        lambda s: x.reference.energy(s.moment),
        lambda s: with_momenta(x.reference, s),
    )
    if x.problem.constraints:
        node = x.read("hamiltonian", x.sheet["hamiltonian"])
        for moment in random_moments(x.reference, 1, seed=5, constrained=False):
            state = with_motion(x.reference, moment)
            value = node and x.number("hamiltonian", node, with_momenta(x.reference, state))
            true = real_part(x.reference.energy(moment))
            if value is not None and not agree(value, true):
                x.wrong("hamiltonian", "does not hold off the constraints")


def _canonical_equations(x: Examination) -> None:
    pairs = x.sheet["canonical_equations"]
    if pairs is None:
        if _hessian_regular(x) and not _unspecified_momenta(x):
            x.missing("canonical_equations")
        return
    for j, name in enumerate(x.reference.names):
        x.compare(
            f"canonical_equations.{name}.q",
            pairs[name]["q"],
            lambda s, j=j: s.moment.chain[1][j],
            lambda s: with_momenta(x.reference, s),
        )
        if not all(s.motion.consistent for s in x.states):
            continue

        def growth(s: State, j: int = j) -> mpf:
            """p' = dL/dq + Q - dD/dq' + sum lambda a."""
            slope = real_part(gradient(x.reference.lagrangian, s.moment, 0)[j])
            force = real_part(x.reference.applied(s.moment)[j])
            rows = jacobian(x, s.moment)
            return (
                slope
                + force
                + sum((m * a[j] for m, a in zip(s.multipliers, rows, strict=True)), mpf(0))
            )

        x.compare(
            f"canonical_equations.{name}.p",
            pairs[name]["p"],
            growth,
            lambda s: with_momenta(x.reference, s),
        )
