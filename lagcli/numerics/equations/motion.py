"""The equations of motion as functions of numbers.

Where a pivot of the written-out elimination vanishes, the null-space way of `null_space`
answers instead, at that very state and no other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from lagcli.graph.nodes import Node, Symbol, mask_of
from lagcli.numerics.equations.arithmetic import Arithmetic, UndefinedFunction
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.null_space import Held, held_motion
from lagcli.numerics.equations.refusal import Refusal, reason_of
from lagcli.numerics.equations.regular import regular_motion
from lagcli.numerics.equations.straight_line import Guard, straight_line

Function = Callable[..., tuple[Any, ...]]
Vector = list[Any]

#: A time in which a sign shows itself.
_AFTER = 1e-6
_NUDGE = 1e-6
#: In which the argument of an event is worked out.
_BITS = 160
_EPSILON = 2.2e-16
#: An argument of a sign within this multiple of the rounding of its terms is 0.
_ROUNDINGS = 100 * _EPSILON


class Motion:
    """Every function takes t, then the coordinates, then the velocities.

    Parameters
    ----------
    equations
        As nodes.
    constants
        The value of every parameter.
    arithmetic
        `Doubles()` or `Balls()`.
    signs
        Those of another motion of the same problem, to share with it; balls need them given.

    Raises
    ------
    Refusal
        When a part that depends on parameters only is not defined.
    """

    def __init__(
        self,
        equations: EquationsOfMotion,
        constants: Mapping[Symbol, Any],
        arithmetic: Arithmetic,
        signs: list[float] | None = None,
    ) -> None:
        #: the kinks at which friction holds the motion
        self.stuck: tuple[int, ...] = ()
        #: what is looked at along the way, beside the equations: gaps, margins
        self.looked_at: tuple[Node, ...] = ()
        self.equations = equations
        self.arithmetic = arithmetic
        self.constants = constants
        self.n, self.m = len(equations.q), len(equations.rows)
        self.kinks = equations.kinks if arithmetic.ordered or signs is not None else []
        #: of each kink's argument, as the dynamics is to take it
        self.signs = [1.0] * len(self.kinks) if signs is None else signs
        self._independent: tuple[int, ...] | None = None
        self._frozen = ({node: k for k, node in enumerate(self.kinks)}, self.signs)

    def function(
        self,
        roots: Sequence[Node],
        extra: Sequence[Symbol] = (),
        guards: Sequence[Guard] = (),
        otherwise: Callable[..., Any] | None = None,
        *,
        frozen: bool = False,
    ) -> Function:
        """The values of any nodes; `extra` are arguments after the state."""
        try:
            made = straight_line(
                (*self.equations.state, *extra),
                roots,
                self.constants,
                self.arithmetic,
                guards=guards,
                otherwise=otherwise,
                frozen=self._frozen if frozen else None,
                generated=self.equations.generated,
            )
            return made if self.arithmetic.ordered else self._of_balls(made)
        except UndefinedFunction as error:
            message = f"the function '{error}' is left unspecified: it has no numbers"
            raise Refusal(message) from None
        except (ArithmeticError, ValueError) as error:
            if otherwise is not None and isinstance(error, ZeroDivisionError):
                return otherwise  # a pivot is 0 at every state
            message = f"with these values the equations are not defined: {reason_of(error)}"
            raise Refusal(message) from None

    def _of_balls(self, made: Function) -> Function:
        """The same function, which takes a time that is a double or a fraction as well."""
        number = self.arithmetic.number

        def of_balls(t: Any, *rest: Any) -> tuple[Any, ...]:
            return made(number(Fraction(t)) if isinstance(t, (float, Fraction)) else t, *rest)

        return of_balls

    # -- the equations -----------------------------------------------------------------------

    @cached_property
    def accelerations(self) -> Function:
        """q'' as a tuple of n."""
        eliminated = self.equations.eliminated
        if eliminated is None:
            self._need_order()
            return lambda *state: tuple(self.held(*state).accelerations)
        roots, _ = eliminated.motion(self.equations.forcing, self.equations.bias)
        return self.function(
            roots,
            guards=eliminated.guards,
            otherwise=lambda *state: tuple(self.held(*state).accelerations),
            frozen=True,
        )

    @cached_property
    def accelerations_and_multipliers(self) -> Function:
        """q'' and then the multipliers; None for one that is not determined."""
        eliminated = self.equations.eliminated
        if eliminated is None:
            self._need_order()
            return self._held_whole
        accelerations, multipliers = eliminated.motion(self.equations.forcing, self.equations.bias)
        return self.function(
            [*accelerations, *multipliers],
            guards=eliminated.guards,
            otherwise=self._held_whole,
            frozen=True,
        )

    def _held_whole(self, *state: float) -> tuple[Any, ...]:
        held = self.held(*state)
        multipliers = (
            value if known else None
            for value, known in zip(held.multipliers, held.determined, strict=True)
        )
        return (*held.accelerations, *multipliers)

    def held(self, *state: float) -> Held:
        """The null-space way, or a quicker one of numbers where it does as well."""
        found = self._held(*self.system(*state))
        self._independent = found.independent if len(found.independent) < self.m else None
        return found

    def independent(self, *state: float) -> tuple[int, ...] | None:
        """Rows of A that imply the others at a state; None where none is implied."""
        self._independent = None
        self.accelerations(*state)
        return self._independent

    def _held(self, mass: Any, forcing: Any, rows: Any, bias: Any) -> Held:
        if self.equations.eliminated is None:  # otherwise a pivot has vanished
            found = regular_motion(mass, forcing, rows, bias)
            if found is not None:
                return Held(*found, tuple(range(len(rows))), (True,) * len(rows))
        return held_motion(mass, forcing, rows, bias)

    @cached_property
    def matrices(self) -> Function:
        """M, forcing, A and the bias c, row by row in one tuple."""
        return self.function(self.equations.dynamics, frozen=True)

    def system(self, *state: Any) -> tuple[list[Vector], Vector, list[Vector], Vector]:
        """The same apart: M and A by rows."""
        n, m, values = self.n, self.m, list(self.matrices(*state))
        rows = [values[i : i + n] for i in range(0, (n + 1 + m) * n, n)]
        return rows[:n], rows[n], rows[n + 1 :], values[(n + 1 + m) * n :]

    @cached_property
    def pivots(self) -> tuple[Function, Function]:
        """Each pivot of M and what it is left of; each of A M^-1 A^T and what it is left of."""
        parts = (self.equations.factored, getattr(self.equations.eliminated, "schur", None))
        pairs = [[*part.pivots] if part is not None else [] for part in parts]
        mass, held = (self.function([node for pair in each for node in pair]) for each in pairs)
        return mass, held

    @cached_property
    def kink_arguments(self) -> Function:
        """What stands in abs and sign in the equations of motion."""
        return self.function(self.kinks)

    @cached_property
    def exact_kink_arguments(self) -> Function:
        """The same, the state taken as exact."""
        return self.exactly(self.kinks)

    def exactly(self, nodes: Sequence[Node]) -> Function:
        """The values of nodes, rounded once: a state of doubles, the parameters of the file."""
        from flint import ctx

        from lagcli.numerics.equations.arithmetic import Balls
        from lagcli.numerics.equations.constants import constants_of

        equations, arithmetic = self.equations, Balls()

        with ctx.workprec(_BITS):
            constants = constants_of(equations, list(nodes), arithmetic)
            function = straight_line(equations.state, nodes, constants, arithmetic)

        def at(*state: float) -> tuple[float, ...]:
            balls = [*map(arithmetic.ball, state)]
            with ctx.workprec(_BITS):
                found = function(*balls)
            return tuple(map(float, found))

        return at

    @cached_property
    def kink_rates(self) -> Function:
        """The rates of what stands in abs and sign, of the state and then q''."""
        e = self.equations
        rates = [e.form.read.total_derivative(node) for node in self.kinks]
        return self.function(rates, [e.graph.symbol(q.name, 2) for q in e.q])

    @cached_property
    def moving_kinks(self) -> tuple[int, ...]:
        """The kinks whose argument depends on the velocities: dry friction."""
        mask = mask_of(self.equations.qdot)
        return tuple(k for k, node in enumerate(self.kinks) if node.mask & mask)

    def kink_noise(self, t: float, q: Sequence[float], v: Sequence[float]) -> list[float]:
        """How much rounding of the time and the state changes the arguments of abs and sign."""
        state = [t, *q, *v]
        here = self.kink_arguments(*state)
        noise = [0.0] * len(here)
        for j, x in enumerate(state):
            if x:
                for k, y in enumerate(self._nudged(state, j, _NUDGE * x)):
                    noise[k] += abs(y - here[k]) / _NUDGE * _ROUNDINGS
        return noise

    def kink_change(
        self, k: int, t: float, state: Sequence[float], sizes: Sequence[float]
    ) -> float:
        """How much a rounding of every component of the state changes one of these arguments."""
        whole, total = [t, *state], 0.0
        here = self.kink_arguments(*whole)[k]
        for j, size in enumerate(sizes, 1):
            if size:
                total += abs(self._nudged(whole, j, _NUDGE * size)[k] - here)
        return total / _NUDGE * _EPSILON

    def _nudged(self, state: Sequence[float], j: int, change: float) -> tuple[Any, ...]:
        return self.kink_arguments(*state[:j], state[j] + change, *state[j + 1 :])

    def set_signs(self, t: float, q: Sequence[float], v: Sequence[float]) -> None:
        """Take the signs of the kinks' arguments here, or just after where they are 0."""
        found = self.kink_arguments(t, *q, *v)
        if not found:
            return
        noise = self.kink_noise(t, q, v)
        self.signs[:] = [
            0.0 if abs(x) <= limit else 1.0 if x > 0 else -1.0
            for x, limit in zip(found, noise, strict=True)
        ]
        if 0 not in self.signs:
            return
        a, h = self.accelerations(t, *q, *v), _AFTER * (1 + abs(t))
        later_q = [x + h * (u + h * b / 2) for x, u, b in zip(q, v, a, strict=True)]
        later_v = [u + h * b for u, b in zip(v, a, strict=True)]
        after = self.kink_arguments(t + h, *later_q, *later_v)
        for k, x in enumerate(after):
            self.signs[k] = self.signs[k] or (1.0 if x >= 0 else -1.0)

    @cached_property
    def rates(self) -> Function:
        """A q' + b of every constraint."""
        return self.function(self.equations.rates)

    @cached_property
    def positions(self) -> Function:
        """f(q, t) of the holonomic constraints."""
        return self.function(self.equations.positions)

    def _need_order(self) -> None:
        if not self.arithmetic.ordered:
            raise Refusal(
                "the mass matrix or the constraints are singular in their structure: "
                "only double precision solves them",
                mistake=False,
            )

    # -- the constraint surface ----------------------------------------------------------------

    @cached_property
    def position_correction(self) -> Function:
        """(d, f): q - d is nearer to f(q, t) = 0, by the shortest way in the metric M."""
        e = self.equations
        return self._correction(e.eliminated_positions, e.positions, e.holonomic)

    @cached_property
    def velocity_correction(self) -> Function:
        """(d, r): q' - d satisfies A q' + b = 0, whose left side is r."""
        e = self.equations
        return self._correction(e.eliminated, e.rates, tuple(range(self.m)))

    @cached_property
    def residuals(self) -> Function:
        """f of the holonomic constraints, then A q' + b of all."""
        return self.function([*self.equations.positions, *self.equations.rates])

    def _correction(
        self, eliminated: Any, residuals: Sequence[Node], which: Sequence[int]
    ) -> Function:
        plain = self.function(residuals)

        def robust(*state: float) -> tuple[Any, ...]:
            (mass, _, rows, _), found = self.system(*state), plain(*state)
            free, lacking = [0.0] * self.n, [-value for value in found]
            held = self._held(mass, free, [rows[k] for k in which], lacking)
            return (*held.accelerations, *found)

        if eliminated is None:
            self._need_order()
            return robust
        roots = [*eliminated.correction(residuals), *residuals]
        return self.function(roots, guards=eliminated.guards, otherwise=robust)

    @cached_property
    def sizes(self) -> Function:
        """What the residuals of positions and rates are compared with."""
        return self.function(self.equations.sizes)
