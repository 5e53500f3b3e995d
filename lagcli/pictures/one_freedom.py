"""The one degree of freedom of a phase portrait: its energy as a function of numbers.

Cyclic coordinates go by Routh's reduction, constraints by being solved; what is left is
E(q, q') with the momenta at their values at t = 0.  U_eff(q) = E(q, 0).  Contacts that may be open
are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

from lagcli.algebra import terms
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.reduction.one_freedom import ReducedFreedom as Reduced
from lagcli.mechanics.reduction.routh import Routh
from lagcli.numerics.equations.arithmetic import Doubles, UndefinedFunction
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.pictures.contours import quiet
from lagcli.pictures.drawing import CannotDraw
from lagcli.pictures.starts import begun
from lagcli.problem_data import Coordinate, Problem
from lagcli.reader.columns import Column, phase_columns


class EnergyNotConserved(CannotDraw):
    """One degree of freedom without an energy to draw levels of."""


class RemainingFreedom:
    """E(q, q') of the coordinate that is left.

    Parameters
    ----------
    problem
        With values for its parameters.

    Attributes
    ----------
    coordinate : Coordinate
        The one that is left.
    momenta : mapping of str to float
        Those of the cyclic coordinates, at t = 0.
    start : tuple of float
        q and q' at t = 0.

    Raises
    ------
    CannotDraw
        Where there are more degrees of freedom, or no conserved energy.
    Refusal
        Where a value is missing.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._equations = EquationsOfMotion(problem)
        self._name = ""
        name, energy, momenta = self._reduced()
        self.coordinate: Coordinate = next(c for c in problem.coordinates if c.name == name)
        self._prepare(energy, momenta)

    def _reduced(self) -> tuple[str, Node, tuple[str, ...]]:
        """The coordinate, its energy, and the momenta that are constants in it."""
        e = self._equations
        if len(e.q) == 1 and not e.rows and "energy" in e.evident_charges:
            return e.q[0].name, e.energy, ()
        routh = Routh(Derivation(self.problem))
        self._name, reduced = routh.potential_name, routh.reduced
        if reduced is None:
            raise CannotDraw(f"there is no portrait of one degree of freedom: {routh.reason}")
        left = [q.name for q in reduced.system.q]
        if len(left) != 1 or reduced.dynamics.constraints.equations:
            raise CannotDraw(_too_many(left))
        motion = Reduced(routh)
        if motion.why_not_conserved:
            raise EnergyNotConserved(_not_conserved(left[0], motion.why_not_conserved))
        if not routh.quadratic:
            raise CannotDraw("the reduced Lagrangian is not quadratic in the velocity")
        formula = terms(motion.energy, reduced.system.order, frozenset())
        return left[0], e.form.read(formula), tuple(p.name for p in routh.momenta)

    def _prepare(self, energy: Node, momenta: tuple[str, ...]) -> None:
        e, arithmetic = self._equations, Doubles()
        motion, q, v = begun(e, [*e.positions, energy])
        constants = motion.constants
        place = {q.name: j for j, q in enumerate(e.q)}
        needed = [e.momenta[place[name.removeprefix("p_")]] for name in momenta]
        values = straight_line(e.state, needed, constants, arithmetic)(0.0, *q, *v)
        self.momenta: Mapping[str, float] = dict(zip(momenta, map(float, values), strict=True))
        held = {e.graph.symbol(name): value for name, value in self.momenta.items()}
        constants = {**motion.constants, **held}
        j = place[self.coordinate.name]
        self.start = (float(q[j]), float(v[j]))
        pair = (e.q[j], e.qdot[j])
        slope = partial(e.graph, e.q[j])(energy)
        try:
            self._energy = straight_line(pair, [energy], constants, arithmetic)
            self._slope = straight_line(pair, [slope], constants, arithmetic)
            given = (
                () if self._name or self.problem.potential is None else (self.problem.potential,)
            )
            self._given = straight_line(
                pair, [e.form.read(each) for each in given], constants, arithmetic
            )
        except UndefinedFunction as error:
            message = f"the function '{error}' is left unspecified: it has no numbers"
            raise CannotDraw(message) from None
        except ArithmeticError as error:
            raise CannotDraw(f"the energy is not defined: {error}") from None

    @cached_property
    def energy(self) -> Callable[[float, float], float]:
        """E(q, q'), nan where it is not defined."""
        return quiet(lambda q, v: float(self._energy(q, v)[0]))

    @cached_property
    def potential(self) -> Callable[[float], float]:
        """U_eff(q) = E(q, 0)."""
        return quiet(lambda q: float(self._energy(q, 0.0)[0]))

    @cached_property
    def potential_name(self) -> str:
        """U_eff at given momenta, else V, or V_eff = V - T_0, as the reduction calls it."""
        if self._name or self.problem.potential is None:
            return self._name or "V_eff"
        places = [self.start[0] + step for step in (-0.23, 0.11, 0.37)]
        gaps = (abs(float(self._given(q, 0.0)[0]) - self.potential(q)) for q in places)
        scale = max(abs(self.potential(q)) for q in places)
        return "V_eff" if any(gap > 1e-9 * scale for gap in gaps) else "V"

    @cached_property
    def slope(self) -> Callable[[float], float]:
        """dU_eff/dq."""
        return quiet(lambda q: float(self._slope(q, 0.0)[0]))

    @property
    def columns(self) -> list[Column]:
        """q and q'."""
        return phase_columns(self.coordinate.name)


def _not_conserved(name: str, why: str) -> str:
    return (
        f"the energy is not conserved ({why}), so there are no energy levels to draw; --kind phase "
        f"--show {name} draws the motion by itself"
    )


def _too_many(left: list[str]) -> str:
    names = ", ".join(left)
    return (
        f"without constraints and cyclic coordinates {names} are left: an effective potential "
        f"or a portrait with energy levels needs one; --kind phase --show {left[0]} draws the "
        "motion in the plane of one coordinate"
    )
