"""The modes of a motion: which contacts are closed, and what friction holds.

Each mode has its own equations of the same kind; a problem without contacts has one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any

from lagcli.graph.nodes import Node, Symbol
from lagcli.numerics.equations.arithmetic import Arithmetic
from lagcli.numerics.equations.columns import ColumnRows, Values
from lagcli.numerics.equations.motion import Function, Motion
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.charges import Sizes, conserved_charges
from lagcli.numerics.hybrid.events import Condition
from lagcli.numerics.hybrid.friction import StuckMotion
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.sight import Sight
from lagcli.numerics.integrators.steps import Method

#: Makes the method of a mode.
MakeMethod = Callable[["Mode", "Surface | None"], Method]


class Mode:
    """The motion while some constraints act and some kinks stick."""

    def __init__(
        self,
        modes: Modes,
        held: frozenset[int],
        stuck: frozenset[int],
        motion: Motion | None = None,
    ) -> None:
        self.modes, self.held, self.stuck = modes, held, stuck
        self.key = held, stuck
        setup = modes.setup
        every = len(setup.equations.rows)
        whole = setup.equations
        self.equations = whole if len(held) == every else whole.holding(held)
        self.motion = motion or self._motion()
        #: what a method has generated for this mode
        self.generated: Any = None

    def _motion(self) -> Motion:
        arguments = (self.equations, self.modes.constants, self.modes.arithmetic)
        signs = self.modes.signs
        motion = (
            StuckMotion(*arguments, signs, self.stuck)
            if self.stuck
            else Motion(*arguments, signs or None)
        )
        motion.looked_at = self._looked_at()
        return motion

    def _looked_at(self) -> tuple[Node, ...]:
        """The margins of the conditions."""
        setup = self.modes.setup
        margins = [node for k, node in setup.margins.items() if k in self.held]
        gaps = [node for k, node in setup.gaps.items() if k not in self.held]
        return (*margins, *gaps, *([] if setup.stop is None else [setup.stop]))

    def surface(self) -> Surface | None:
        """The constraints that act, nothing measured yet."""
        return Surface(self.motion, self.modes.rounding) if self.equations.rows else None

    def method(self, surface: Surface | None) -> Method:
        """What integrates it."""
        return self.modes.make_method(self, surface)

    @cached_property
    def sight(self) -> Sight:
        """What steps may pass over."""
        return Sight(self.motion)

    @cached_property
    def conditions(self) -> list[Condition]:
        """What ends the mode, or the run."""
        modes = self.modes
        setup = modes.setup
        names = [c.name for c in setup.whole.constraints]
        found = [
            Condition(names[k], "contact lost", self._watched(node), "loss", k)
            for k, node in setup.margins.items()
            if k in self.held
        ]
        found += [
            Condition(
                names[k],
                "contact closes",
                self._watched(node),
                "gap",
                k,
                exact_margin=self._exactly(node),
            )
            for k, node in setup.gaps.items()
            if k not in self.held
        ]
        found += [
            Condition(modes.setup.equations.kink_name(k), "slips", self._friction(place), "slip", k)
            for place, k in enumerate(sorted(self.stuck))
        ]
        if setup.stop is not None:
            name = setup.request.stop_name
            margin = self._watched(setup.stop)
            found.append(Condition(name, "stopped", margin, two_sided=True))
        return found

    def _watched(self, node: Node) -> Callable[..., float]:
        values = Values(self.motion, self.modes.setup.reading, [node])

        def margin(t: float, q: Sequence[Any], v: Sequence[Any]) -> float:
            [value] = values(t, q, v)
            return math.inf if value is None else float(value)

        return margin

    def _exactly(self, node: Node) -> Callable[..., float]:
        known: list[Function] = []

        def margin(t: float, q: Sequence[float], v: Sequence[float]) -> float:
            if not known:
                known.append(self.motion.exactly([node]))
            return float(known[0](t, *q, *v)[0])

        return margin

    def _friction(self, place: int) -> Callable[..., float]:
        """1 - |sigma|."""
        motion = self.motion
        assert isinstance(motion, StuckMotion)
        return lambda t, q, v: 1.0 - abs(motion.friction(t, *q, *v)[place])

    @cached_property
    def conserved(self) -> list[bool]:
        """Which of the charges stay as they are in this mode."""
        kept = conserved_charges(self.modes.setup, self.motion)
        return [name in kept for name in self.modes.setup.charges]

    @cached_property
    def sizes(self) -> Sizes:
        """What the charges are measured against."""
        e, charges = self.equations, [*self.modes.setup.charges.values()]
        return Sizes(e, charges, self.modes.constants)

    @cached_property
    def tabulate(self) -> ColumnRows:
        """The columns and then the charges at a state."""
        setup = self.modes.setup
        nodes = [*setup.nodes, *setup.charges.values()]
        return ColumnRows(self.motion, setup.reading, nodes)


class Modes:
    """The modes met so far.

    Parameters
    ----------
    setup
        The problem and the request.
    constants, arithmetic
        As for `Motion`.
    make_method
        Makes the method of a mode.
    rounding
        At which a projection onto the constraints is done.
    """

    def __init__(
        self,
        setup: Setup,
        constants: Mapping[Symbol, Any],
        arithmetic: Arithmetic,
        make_method: MakeMethod,
        rounding: float,
    ) -> None:
        self.setup, self.constants, self.arithmetic = setup, constants, arithmetic
        self.make_method, self.rounding = make_method, rounding
        self.signs = [1.0] * len(setup.equations.kinks)
        self._known: dict[tuple[frozenset[int], frozenset[int]], Mode] = {}

    def by(self, make_method: MakeMethod, setup: Setup | None = None) -> Modes:
        """The same columns and charges in the same numbers, by another method or elsewhere."""
        other = self.of(setup or self.setup)
        other.make_method = make_method
        first = other.first
        first.conserved = self.first.conserved
        first.tabulate, first.sizes = self.first.tabulate, self.first.sizes
        return other

    def of(self, setup: Setup) -> Modes:
        """The same motion with another start or other charges."""
        numbers = self.constants, self.arithmetic, self.make_method, self.rounding
        other = Modes(setup, *numbers)
        other.signs = self.signs
        key = self.first.key
        other._known[key] = Mode(other, *key, self.first.motion)
        return other

    def mode(self, held: frozenset[int], stuck: frozenset[int] = frozenset()) -> Mode:
        """The mode in which these act."""
        key = (held, stuck)
        if key not in self._known:
            self._known[key] = Mode(self, held, stuck)
        return self._known[key]

    @cached_property
    def first(self) -> Mode:
        """The one of the file: its constraints, and no contact."""
        return self.mode(self.setup.given)

    @cached_property
    def whole(self) -> Motion:
        """The motion with every constraint, for its matrices only."""
        every = frozenset(range(len(self.setup.equations.rows)))
        return self.mode(every).motion
