"""What holds a body at rest beside smooth forces: one-sided contacts and static friction.

Each combination of closed contacts is a system of its own, in which these are constraints, and
those that are open have a gap > 0.  An equilibrium in it is one of the problem where every
condition on a multiplier (`holds_while`, N >= 0) holds at rest.

Dry friction -f sign(u), u = sum a_j q_j', takes at rest whatever holds it, up to f (Coulomb): the
rest states are those of the system with u = 0 for a constraint, where its force has |lambda| <= f.
So does a kink c |u(q)| of the potential, c > 0, with u = 0 for a constraint on the positions and
|lambda| <= c (Clarke's generalized gradient): V has a minimum across it.

References
----------
Clarke, *Optimization and Nonsmooth Analysis*, section 2.3.
Pfeiffer, Glocker, *Multibody Dynamics with Unilateral Contacts* (1996), section 2.2 and
chapter 5.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, shape, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of, weak_sign
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.diagnostics import ProblemError
from lagcli.expression import ZERO, Equation
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.minimal import with_lagrangian
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.problem_data import Constraint, pushing_sign
from lagcli.record import record, replace

_MOST_CONTACTS = 4  # 2^4 combinations, each a search of its own


@record
class Friction:
    """-f sign(u) of dry friction, or of a kink f |u| of the potential."""

    u: Expr
    f: Expr


@record
class OneSidedCondition:
    """A contact, or a constraint of the file (`given`) under conditions.

    The `gap` is positive where it is open; None: the model ends where it opens.
    """

    name: str
    multiplier: str
    demands: tuple[Expr, ...]
    gap: Expr | None
    given: bool

    @property
    def may_open(self) -> bool:
        """Whether there is a motion without it."""
        return self.gap is not None


@record
class HeldCombination:
    """One combination of what is closed, and what must not be negative at rest.

    Attributes
    ----------
    rest
        The equilibria with the closed contacts, and what sticks, as constraints.
    demands
        Functions of q and the multipliers.
    gaps
        Of the contacts that are open.
    touching, closed, sticking
        The closed contacts that may open; all that are closed; whether dry friction holds.
    """

    rest: RestPoints
    demands: tuple[Expr, ...] = ()
    gaps: tuple[Expr, ...] = ()
    touching: tuple[str, ...] = ()
    open: tuple[str, ...] = ()
    closed: tuple[str, ...] = ()
    sticking: bool = False
    kinked: bool = False

    def points(self) -> tuple[RestPoint, ...] | None:
        """The equilibria that these conditions allow; None where they were not found."""
        points = self.rest.points
        if points is None or not (self.demands or self.gaps):
            return points
        kept = (self._allowed(point) for point in points)
        return tuple(point for point in kept if point is not None)

    def excluded(self) -> tuple[RestPoint, ...]:
        """Where forces balance, and the condition of a constraint fails: a contact would pull."""
        if not self.demands:
            return ()
        return tuple(point for point in self.rest.points or () if self._demands_fail(point))

    def _demands_fail(self, point: RestPoint) -> bool:
        values = [self._at_rest(demand, point) for demand in self.demands]
        return any(v is not None and sign_of(v, point.positive) == -1 for v in values)

    def _allowed(self, point: RestPoint) -> RestPoint | None:
        """The equilibrium with the conditions for it; None where one fails."""
        conditions: list[Expr] = []
        for demand in (*self.demands, *self.gaps):
            value = self._at_rest(demand, point)
            if value is None:
                continue
            known = sign_of(value, point.positive)
            strict = any(demand is gap for gap in self.gaps)
            if known == -1 or (known == 0 and strict):
                return None
            if known is None and weak_sign(value, point.positive) == -1:
                return None
            conditions += [value] if known is None else []
        return replace(point, positive=tuple(dict.fromkeys((*point.positive, *conditions))))

    def _at_rest(self, demand: Expr, point: RestPoint) -> Expr | None:
        """Its value; None where a multiplier is not determined."""
        try:
            forces = Linearization(self.rest, point).constraint_forces
        except ZeroDivisionError:
            return None
        system, equations = self.rest.system, self.rest.dynamics.constraints.equations
        put_in: dict[Expr, Expr] = dict.fromkeys((*system.qdot, *system.qddot), S.Zero)
        put_in |= {equations[k].multiplier: value for k, value in forces.items()}
        there = at(demand.xreplace(put_in), point.values)
        return there if free_of(there, [e.multiplier for e in equations]) else None

    def grazes(self, point: RestPoint) -> bool:
        """Whether nothing presses on something that is closed, so that it may open."""
        return any(self._at_rest(demand, point) == 0 for demand in self.demands)

    @property
    def firmly(self) -> bool:
        """Whether contacts, friction or kinks exclude displacements."""
        return self.sticking or self.kinked or bool(self.touching)


def held(dynamics: Dynamics) -> list[HeldCombination]:
    """All combinations; the system itself where nothing may open or close and nothing sticks."""
    contacts, friction, kinks = one_sided(dynamics), _friction(dynamics), _kinks(dynamics)
    if not (any(each.may_open for each in contacts) or friction or kinks):
        demands = tuple(x for each in contacts for x in each.demands)
        return [HeldCombination(RestPoints(dynamics), demands)]
    names = [*kinks, *(each.name for each in contacts if each.may_open)][:_MOST_CONTACTS]
    variants = [
        _variant(dynamics, contacts, friction, kinks, opened)
        for size in range(len(names), -1, -1)
        for opened in combinations(names, size)
    ]
    return [each for each in variants if each is not None] or [
        HeldCombination(RestPoints(dynamics))
    ]


def one_sided(dynamics: Dynamics) -> list[OneSidedCondition]:
    """The contacts, and the constraints that hold under a condition."""
    system, problem = dynamics.system, dynamics.system.problem
    found = []
    for given, equation in zip(problem.constraints, dynamics.constraints.equations, strict=True):
        if given.holds_while is None:
            continue
        condition = given.holds_while
        larger, smaller = map(system.build, condition.larger_first)
        side = pushing_sign(given.multiplier, condition) if given.on_loss == "release" else None
        gap = None if side is None else side * equation.f
        found.append(
            OneSidedCondition(given.name, given.multiplier, (larger - smaller,), gap, given=True)
        )
    for each in problem.contacts:
        gap = system.build(each.equation.left) - system.build(each.equation.right)
        found.append(OneSidedCondition(each.name, each.multiplier, (), gap, given=False))
    return found


def _variant(
    dynamics: Dynamics,
    contacts: Sequence[OneSidedCondition],
    friction: Sequence[Friction],
    kinks: Mapping[str, Friction],
    opened: Sequence[str],
) -> HeldCombination | None:
    """The system with these contacts open; None where the others cannot be closed together."""
    system, problem = dynamics.system, dynamics.system.problem
    closed = [each for each in contacts if each.name not in opened]
    added = [(x.name, x.gap, x.multiplier) for x in closed if not x.given and x.gap is not None]
    forces = list(system.applied_forces)
    for k, each in enumerate(friction):
        forces = [f.xreplace({sympy.sign(each.u): S.Zero}) for f in forces]
        added.append((f"sticks{k}", each.u, f"#lambda{k}"))
    shut = {name: each for name, each in kinks.items() if name not in opened}
    added += [(name, each.u, name) for name, each in shut.items()]
    bent = {f(each.u): S.Zero for each in shut.values() for f in (sympy.Abs, sympy.sign)}
    given = zip(dynamics.constraints.equations, problem.constraints, strict=True)
    rows = [(c.name, e.f, c.multiplier) for e, c in given if c.name not in opened]
    derivation = with_lagrangian(
        Derivation(problem),
        list(range(len(system.q))),
        system.L.xreplace(bent),
        forces,
        problem.parameters,
        tuple(
            Constraint(name=name, equation=Equation(shape(f, system.order), ZERO), multiplier=lam)
            for name, f, lam in (*rows, *added)
        ),
    )
    try:
        derivation.dynamics.independent_constraints  # noqa: B018 - asks whether they agree
    except ProblemError:
        return None
    symbol = derivation.system.symbol_of
    demands = [x for each in closed for x in each.demands or (symbol(each.multiplier),)]
    for k, each in enumerate(friction):
        demands += [each.f - symbol(f"#lambda{k}"), each.f + symbol(f"#lambda{k}")]
    demands += [each.f + s * symbol(name) for name, each in shut.items() for s in (1, -1)]
    gaps = [x.gap for x in contacts if x.name in opened and x.gap is not None]
    return HeldCombination(
        RestPoints(derivation.dynamics, kinks_apart=bool(kinks)),
        tuple(demands),
        (*gaps, *(each.u**2 for name, each in kinks.items() if name in opened)),
        tuple(each.name for each in closed if each.may_open),
        tuple(name for name in opened if name not in kinks),
        tuple(each.name for each in closed),
        sticking=bool(friction),
        kinked=bool(shut),
    )


def _kinks(dynamics: Dynamics) -> dict[str, Friction]:
    """The terms c |u(q)| of the potential with c > 0, by name; empty where other forces jump."""
    system, found = dynamics.system, {}
    still = dict.fromkeys(system.qdot, S.Zero)
    forces = [f.xreplace(still) for f in dynamics.lagrange.forcing]
    jumps = {node.args[0] for f in forces for node in f.atoms(sympy.sign)}
    place = sympy.Dummy("place", real=True)
    for k, u in enumerate(sorted((u for u in jumps if u.free_symbols & {*system.q}), key=str)):
        slope = -system.L.xreplace(still).xreplace({sympy.Abs(u): place}).diff(place)
        plain = free_of(slope, [place]) and free_of(u, system.qdot)
        if (
            not plain
            or sign(slope) != 1
            or any(f.has(sympy.sign(u)) for f in system.applied_forces)
            or _crosses_itself(u, system.q)
        ):
            return {}
        found[f"#kink{k}"] = Friction(u, slope)
    return found


def _crosses_itself(u: Expr, q: Sequence[Symbol]) -> bool:
    """Whether u = 0 may have a point without a tangent, as x y = 0 has: what moves along leaves."""
    found = solve_system([u, *(u.diff(x) for x in q)], q)
    return bool(found.solutions) or not found.complete


def _friction(dynamics: Dynamics) -> list[Friction]:
    """The terms -f sign(u) in the forces with u linear in the velocities, 0 at rest."""
    system = dynamics.system
    still = dict.fromkeys(system.qdot, S.Zero)
    found: dict[Expr, Friction] = {}
    for j, force in enumerate(system.applied_forces):
        for node in force.atoms(sympy.sign):
            u = node.args[0]
            slope = simplify(u.diff(system.qdot[j]))
            if (
                slope == 0
                or not free_of(slope, system.qdot)
                or is_zero(u.xreplace(still)) is not True
            ):
                continue
            part = force.xreplace({node: S.One}) - force.xreplace({node: S.Zero})
            largest = simplify(simplify(-part / slope).xreplace(still))
            if is_zero(largest) is not True:  # quadratic drag -c |u| u holds nothing
                found.setdefault(u, Friction(u, largest))
    return list(found.values())
