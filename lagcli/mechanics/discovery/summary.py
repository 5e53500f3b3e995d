"""The algebra of the discovered charges: dimension, name, independence, integrability."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal

from sympy import Expr, Tuple

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.brackets import ChargeBrackets, NoState, Structure
from lagcli.mechanics.discovery.constrained import dimension_of_states, rank_on_surface
from lagcli.mechanics.discovery.discovery import Discovery
from lagcli.mechanics.discovery.lie_algebra import has_constants, name_of
from lagcli.mechanics.discovery.limits import Allowance, TooMuchWork
from lagcli.mechanics.states import Contradiction
from lagcli.statements.answers import AlgebraSection

#: Choices of the parameters at which an algebra must have the same name.
_PARAMETERS = 12


@dataclass(frozen=True, slots=True)
class Summary:
    """What `algebra` states; `dimension` is that of the algebra that `name` names."""

    dimension: int
    name: str | None
    independent: int | None
    in_involution: int | None
    integrable: bool | None
    notes: tuple[str, ...] = ()
    closed: bool = False  # all brackets are combinations of the charges and of constants
    with_constants: bool = False  # constants belong to the algebra that `dimension` counts
    autonomous: tuple[int, str] | None = None  # of those without t: how many, and their algebra
    by_functions: bool = False  # fewer charges than functions of them are in involution


def algebra_section(
    discovery: Discovery, found: Summary, separates: Callable[[], bool]
) -> AlgebraSection:
    """The statement of it.

    A complete integral of the Hamilton-Jacobi equation, which `separates` looks for where the
    charges do not suffice, has n constants: functions of q and p, independent and in involution.
    As many independent charges as a state has dimensions give the state at every time by algebra.

    References
    ----------
    Liouville, J. Math. Pures Appl. 20 (1855) 137 (n integrals in involution: quadratures).
    Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., sections 47 and 49.
    """
    determines = "" if found.integrable else _determined(discovery, found.independent or 0)
    integrable = found.integrable or bool(determines) or None
    separable = integrable is None and discovery.canonical and separates()
    return AlgebraSection(
        ansatz="; ".join((discovery.ansatz, *found.notes)),
        dimension=found.dimension,
        name=found.name,
        independent=found.independent,
        in_involution=found.in_involution,
        integrable=True if separable else integrable,
        separates=separable,
        determines=determines,
        number=len(discovery.charges),
        closed=found.closed,
        with_constants=found.with_constants,
        autonomous=found.autonomous,
        by_functions=found.by_functions,
        is_prescribed=discovery.is_prescribed,
    )


def _determined(discovery: Discovery, independent: int) -> Literal["", "state", "orbit"]:
    """What as many independent charges give by algebra.

    One less than a state has dimensions, without the time where nothing depends on it, leave a
    curve: dt = dx/f(x) along it (Rauch-Wojciechowski, Przybylska, Regul. Chaotic Dyn. 30 (2025)
    866).
    """
    dynamics = discovery.dynamics
    system, states = dynamics.system, dimension_of_states(dynamics)
    if 0 < states == independent:
        return "state"
    relations = [e.f for e in dynamics.constraints.equations]
    if not (0 < states - 1 <= independent) or not free_of(
        Tuple(system.L, *system.applied_forces, *relations), [system.t]
    ):
        return ""
    fixed = [c.charge for c in discovery.fixed_charges]
    return "orbit" if rank_on_surface(dynamics, fixed) == states - 1 else ""


def summary(discovery: Discovery) -> Summary:
    """Brackets and what follows from them; counts alone where they were not worked out."""
    fewer = discovery.unconstrained
    try:
        kinds = discovery.dynamics.constraints.kinds.values()
        if any(kind != "holonomic" for kind in kinds):
            return _nonholonomic(discovery)
        if fewer is not None and len(fewer.charges) == len(discovery.charges):
            found = summary(fewer)
            if found.integrable or not _of_the_file(discovery):
                return found
        return _free(discovery)
    except TooMuchWork:
        why = "the brackets were not worked out: too much work"
    except (NoState, Contradiction):
        why = "the brackets were not worked out: no state was found to do it at"
    independent = None if discovery.charges else 0
    return Summary(len(discovery.point_charges), None, independent, None, None, (why,))


def _free(discovery: Discovery) -> Summary:
    points = len(discovery.point_charges)
    charges = [c.charge for c in discovery.charges]
    count = len(charges)
    if not count:
        number = None if discovery.unsearched else 0
        return Summary(0, None, number, number, None)
    more = _of_the_file(discovery)
    brackets = ChargeBrackets([*charges, *more], discovery.dynamics, Allowance())
    everything = list(range(count))
    if not discovery.canonical:
        # with other forces than those of L the motion is no canonical flow
        return Summary(points, None, brackets.independent(everything), None, None,
                       ("brackets mean nothing for forces beside L",))  # fmt: skip
    independent = brackets.independent(everything)
    dimension, name, notes = points, None, []
    if count > points and brackets.independent(everything[:points]) == independent:
        notes.append("the integrals of second degree are functions of the other charges")
        everything = everything[:points]
    energy = next((k for k, c in enumerate(discovery.charges) if c.name == "energy"), None)
    structure = brackets.structure(everything)
    closed = structure is not None and len(everything) == count
    if structure is not None:
        dimension, name = len(everything), _name(brackets, everything, structure)
    elif len(everything) > points:
        dimension, name, structure = _over_energy(brackets, everything, points, energy)
        if name is None:
            notes.append("the integrals of second degree are not counted in the dimension")
    t = discovery.system.t
    alone = None if closed else _without_time(discovery)
    autonomous = t not in discovery.system.L.free_symbols
    fixed = [
        k for k, c in enumerate([*charges, *more])
        if not autonomous or t not in c.free_symbols
    ]  # fmt: skip
    timed = [k for k in range(count) if k not in fixed]
    if autonomous and energy is not None and timed:
        fixed += brackets.still(timed, energy)
    fixed.sort(key=lambda k: (k != energy, k < count))
    freedom = discovery.dynamics.degrees_of_freedom
    involution = brackets.functions_in_involution(fixed)
    if involution is None:  # there are more integrals, which are not in the list
        linear = brackets.functions_in_involution([k for k in fixed if k < points or k == energy])
        given = tuple(fixed)  # a sum of integrals may commute with another, as each does not
        for k in range(points, count):
            fixed += brackets.still(given, k) if k in given else []
    commuting = brackets.in_involution(fixed)
    if involution is None:
        involution = max(commuting, linear or 0)
    return Summary(
        dimension,
        name,
        independent,
        involution,
        involution == freedom or None,
        tuple(notes),
        closed,
        structure is not None and has_constants(structure),
        alone,
        involution > commuting,
    )


def _without_time(discovery: Discovery) -> tuple[int, str] | None:
    """The algebra of the charges without t where these close, as u(2) of the plane oscillator.

    None where it is abelian, or another one for other parameters, also where others are not real.
    """
    t = discovery.system.t
    charges = [c.charge for c in discovery.charges if t not in c.charge.free_symbols]
    if not 3 <= len(charges) < len(discovery.charges):
        return None
    brackets, chosen = ChargeBrackets(charges, discovery.dynamics, Allowance()), range(len(charges))
    structure = brackets.structure(chosen)
    name = None if structure is None else _name(brackets, chosen, structure)
    return (len(charges), name) if name and not name.startswith("R") else None


def _over_energy(
    brackets: ChargeBrackets, everything: list[int], points: int, energy: int | None
) -> tuple[int, str | None, Structure | None]:
    """The algebra where coefficients depend on the energy (Kepler's); else of the points."""
    if energy is not None and all(brackets.commute(energy, k) for k in everything):
        rest = [k for k in everything if k != energy]
        structure = brackets.structure(rest, energy)
        name = None if structure is None else _name(brackets, rest, structure, energy)
        if name is not None:
            return len(everything), f"the energy and {name}", structure
    structure = brackets.structure(everything[:points])
    name = None if structure is None else _name(brackets, everything[:points], structure)
    return points, name, structure


def _name(
    brackets: ChargeBrackets, chosen: Sequence[int], structure: Structure, energy: int | None = None
) -> str | None:
    """The name of the algebra; None where it is another one for other parameters."""
    name = name_of(structure)
    for turn in range(1, _PARAMETERS) if name is not None and brackets.has_parameters else ():
        with suppress(NoState):
            other = brackets.structure(chosen, energy, turn)
            if other is None or name_of(other) != name:
                return None
    return name


def _of_the_file(discovery: Discovery) -> list[Expr]:
    """The conserved charges of its candidates, of any degree, for involution."""
    return [
        c.charge for c in discovery.noether.charges
        if c.source == "candidate" and c.conserved and is_zero(c.charge) is not True
    ]  # fmt: skip


def _nonholonomic(discovery: Discovery) -> Summary:
    """Counts on the constraint surface: the motion is no Hamiltonian flow there."""
    dynamics = discovery.dynamics
    charges = [c.charge for c in discovery.charges]
    independent = rank_on_surface(dynamics, charges)
    note = "velocity constraints leave no Poisson brackets to compare charges by"
    v = discovery.system.qdot  # those of first degree with x phi' displace without velocities
    points = sum(free_of(Tuple(*c.transformation.changes), v) for c in discovery.charges)
    return Summary(points, None, independent, None, None, (note,))
