"""The modes of a proof: which constraints act, on which side of 0 the switching functions are."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Call, Node, ancestry, mask_of
from lagcli.graph.substitution import Substitution
from lagcli.numerics.equations.columns import Values
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.rigorous.crossings import Restart, Watched
from lagcli.numerics.rigorous.enclosure import Enclosures, NotEnclosed
from lagcli.numerics.rigorous.field import VectorField
from lagcli.numerics.rigorous.initial import vanishing
from lagcli.numerics.rigorous.solution import LinearSystem

_ARGUMENT = "the argument of abs or sign"

Key = tuple[frozenset[int], tuple[int, ...]]


class ProofModes:
    """The equations of each mode, made when it is met.

    Parameters
    ----------
    setup : Setup
    constants, arithmetic
        Exact parameters in balls.
    implied : frozenset of int
        Constraints that the others imply.
    order, target, least
        As of `Enclosures`.
    """

    def __init__(
        self,
        setup: Setup,
        constants: Any,
        arithmetic: Any,
        implied: frozenset[int],
        order: int,
        target: float,
        least: float,
    ) -> None:
        self.setup, self.constants, self.arithmetic = setup, constants, arithmetic
        self.implied, self.order, self.target, self.least = implied, order, target, least
        #: that what is closed at the beginning is closed exactly
        self.assumed: list[str] = []
        #: of what `--stop-when` compares with 0, at the beginning
        self.stop_sign = 0
        self.peaks = [0.0] * (2 * len(setup.equations.q))
        self._known: dict[Key, ProofMode] = {}

    def __call__(self, held: frozenset[int], signs: Sequence[int]) -> ProofMode:
        """The mode in which these constraints act, and the switching functions have these signs."""
        key = held, tuple(signs)
        if key not in self._known:
            self._known[key] = ProofMode(self, *key)
        return self._known[key]

    def at_first(self, t: Any, x: Sequence[Any]) -> tuple[ProofMode, dict[Watched, int]]:
        """The mode of the initial state, and what is 0 there and leaves it at once.

        Raises
        ------
        NotEnclosed
            When the state is at the edge of a mode and does not leave it.
        """
        setup = self.setup
        trial = self(setup.given, [1] * len(setup.equations.kinks))
        signs = [_sign_of(each.at(t, x)) for each in trial.watched if each.kind == "kink"]
        mode = self(setup.given, self._leaving(t, x, signs) if 0 in signs else signs)
        mode = self._resting(t, x, mode)
        leaving = {each: 1 for each in mode.watched if not each.at(t, x) > 0}
        for each in leaving:
            if not (each.at(t, x).contains(0) and each.rate(mode.field, t, x) > 0):
                raise NotEnclosed(
                    f"{each.name} is at its edge at the beginning, and may stay there"
                )
        return mode, leaving

    def _resting(self, t: Any, x: Sequence[Any], mode: ProofMode) -> ProofMode:
        """The mode in which contacts act that are closed at the beginning, without speed."""
        gaps = self.setup.gaps
        closed = frozenset(
            each.index
            for each in mode.watched
            if each.kind == "gap"
            and each.at(t, x).contains(0)
            and each.rate(mode.field, t, x).contains(0)
        )
        if not closed:
            return mode
        together = self.setup.equations.holding(mode.held | closed)
        rates = [together.rates[together.place[k]] for k in closed]
        self.assumed += vanishing(mode.motion, x, [*(gaps[k] for k in closed), *rates])
        return self(mode.held | closed, mode.signs)

    def _leaving(self, t: Any, x: Sequence[Any], signs: Sequence[int]) -> list[int]:
        """The signs just after the beginning, where some are 0 there; 0 where friction holds."""
        found = [sign or 1 for sign in signs]
        for _ in range(2):
            wrong = self._returning(t, x, signs, found)
            if not wrong:
                return found
            found = [-sign if k in wrong else sign for k, sign in enumerate(found)]
        wrong = self._returning(t, x, signs, found)
        found = [0 if k in wrong else sign for k, sign in enumerate(found)]
        kinks = self.setup.equations.kinks
        self.assumed += vanishing(
            self(self.setup.given, found).motion, x, [kinks[k] for k in wrong]
        )
        return found

    def _returning(
        self, t: Any, x: Sequence[Any], signs: Sequence[int], trial: Sequence[int]
    ) -> set[int]:
        """What is 0 and does not leave 0 to the side of its sign."""
        mode = self(self.setup.given, trial)
        return {
            each.index
            for each in mode.watched
            if each.kind == "kink" and not signs[each.index] and not each.rate(mode.field, t, x) > 0
        }


class ProofMode:
    """The motion while some constraints act and the switching functions keep their signs.

    Where a sign is 0, dry friction holds its argument at 0: see `Equations.sticking`.
    """

    def __init__(self, modes: ProofModes, held: frozenset[int], signs: tuple[int, ...]) -> None:
        self.modes, self.held, self.signs = modes, held, signs
        setup = modes.setup
        whole = setup.equations.holding(held)
        self.equations = _without(whole, modes.implied)
        self.stuck = [k for k, sign in enumerate(signs) if not sign]
        for k in self.stuck:
            self.equations = self.equations.sticking(k)
        self.motion = Motion(
            self.equations, modes.constants, modes.arithmetic, [float(sign) for sign in signs]
        )
        #: A q' + b of the constraints that the others imply
        self.implied = self.motion.function(
            [whole.rates[place] for k, place in whole.place.items() if k in modes.implied]
        )
        self.field = VectorField(self.motion)
        self.enclosures = Enclosures(
            self.field, modes.order, modes.target, modes.peaks, modes.least
        )
        self.values = Values(self.motion, setup.reading, setup.nodes)

    @cached_property
    def watched(self) -> list[Watched]:
        """What ends the mode."""
        setup, equations = self.modes.setup, self.equations
        names = [c.name for c in setup.whole.constraints]
        found = [
            self._watch("kink", k, equations.kink_name(k) or _ARGUMENT, sign, node)
            for (k, node), sign in zip(enumerate(equations.kinks), self.signs, strict=True)
            if sign
        ]
        for k in self.stuck:
            found += self._slipping(k)
        if setup.stop is not None:
            sign = self.modes.stop_sign or 1
            found.append(self._watch("stop", 0, setup.request.stop_name, sign, setup.stop))
        found += [
            self._watch("gap", k, names[k], 1, node)
            for k, node in setup.gaps.items()
            if k not in self.held
        ]
        found += [
            self._watch("force", k, names[k], 1, node)
            for k, node in setup.margins.items()
            if k in self.held
        ]
        return found

    def _slipping(self, k: int) -> list[Watched]:
        """c - lambda and c + lambda of friction that holds: |sigma| < 1, sigma = -lambda/c."""
        equations, name = self.equations, self.equations.kink_name(k)
        graph, limit = equations.graph, equations.friction(k)
        if limit is None or equations.eliminated is None:
            raise NotEnclosed(
                f"what holds {name} at 0 is not dry friction of its own: not enclosed"
            )
        _, forces = equations.eliminated.motion(equations.forcing, equations.bias)
        held = forces[len(forces) - len(self.stuck) + self.stuck.index(k)]
        return [
            self._watch("slip", k, name, sign, graph.sum([held, graph.scaled(limit, sign)]))
            for sign in (1, -1)
        ]

    def _of_state(self, node: Node) -> Node:
        """A node without accelerations and multipliers."""
        equations, reading = self.equations, self.modes.setup.reading
        symbols = [*reading.accelerations, *reading.multipliers]
        if not any(node.mask & s.mask for s in symbols):
            return node
        if equations.eliminated is None:
            message = "not enclosed: the accelerations have no formula of their own"
            raise Refusal(message, mistake=False)
        a, found = equations.eliminated.motion(equations.forcing, equations.bias)
        zero = equations.graph.zero
        places = map(equations.place.get, range(len(reading.multipliers)))
        held = [zero if place is None else found[place] for place in places]
        known = dict(zip(symbols, [*a, *held], strict=True))
        return Substitution(equations.graph, known)(node)

    def _watch(self, kind: str, index: int, name: str, sign: int, node: Node) -> Watched:
        node = self._of_state(node)
        kinks, mask = self.equations.kinks, mask_of(self.equations.state)
        for each in ancestry([node]):
            jumps = isinstance(each, Call) and each.function == "sign" and each.mask & mask
            if jumps and each.parts[0] not in kinks:
                message = f"not enclosed: where {name} jumps with a sign is not found"
                raise Refusal(message, mistake=False)
        roots = [node, *(partial(self.equations.graph, x)(node) for x in self.equations.state)]
        return Watched(kind, index, name, sign, self.motion.function(roots, frozen=True))

    def sign_of_stop(self, t: Any, x: Sequence[Any]) -> int:
        """Of what `--stop-when` compares with 0."""
        return next(_sign_of(w.at(t, x)) for w in self.watched if w.kind == "stop")

    def ends(self, watched: Watched) -> str:
        """What the end of the motion is called, where it is one."""
        setup, k = self.modes.setup, watched.index
        match watched.kind:
            case "stop":
                return "stopped"
            case "gap":
                return "contact closes" if setup.contacts[k].restitution is None else ""
            case "force":
                return "contact lost" if setup.whole.constraints[k].on_loss == "stop" else ""
        return ""

    def through(self, watched: Watched, t: Any, x: Sequence[Any]) -> tuple[ProofMode, Restart, str]:
        """What follows when a watched function becomes 0: mode, state, and what it is called.

        Raises
        ------
        NotEnclosed
            When the motion does not go on in one mode.
        """
        if watched.kind == "gap":
            return self._struck(watched, t, x)
        same = Restart(lambda _, y: list(y), self._unmoved)
        if watched.kind == "force":
            return self.modes(self.held - {watched.index}, self.signs), same, "contact lost"
        if watched.kind == "slip":
            return self._with_sign(watched.index, watched.sign), same, "slips"
        after = self._with_sign(watched.index, -watched.sign)
        rate = watched.rate(after.field, t, x)
        if rate < 0:
            return after, same, "switch"
        if rate > 0:
            return self._with_sign(watched.index, 0), same, "sticks"
        raise NotEnclosed(
            f"whether friction holds {watched.name} at 0 near t = {float(t):.6g} is not decided"
        )

    def _with_sign(self, k: int, sign: int) -> ProofMode:
        """The mode with another sign of a switching function."""
        return self.modes(self.held, [*self.signs[:k], sign, *self.signs[k + 1 :]])

    def _struck(self, watched: Watched, t: Any, x: Sequence[Any]) -> tuple[ProofMode, Restart, str]:
        """An impact by Newton's law: M (v+ - v) = A^T Lambda, g'+ = -e g'."""
        k, setup = watched.index, self.modes.setup
        contact = setup.contacts[k]
        assert contact.restitution is not None
        equations = _without(setup.equations.holding(self.held | {k}), self.modes.implied)
        graph, e = equations.graph, equations.form.read(contact.restitution)
        zero = graph.zero
        own = equations.place[k]
        jump = graph.product(graph.sum([graph.one, e]), equations.rates[own])
        bias = [jump if row == own else zero for row in range(len(equations.rows))]
        motion = Motion(equations, self.modes.constants, self.modes.arithmetic, self.motion.signs)
        restart = self._impulse(LinearSystem(motion, [zero] * motion.n, bias, equations.state))
        ratio = self.motion.function([e])(t, *x)[0]
        after = restart.state(t, x)
        signs = self._signs_after(t, after)
        if ratio > 0:
            return self.modes(self.held, signs), restart, "impact"
        if not ratio.is_zero():
            raise NotEnclosed(f"whether {watched.name} bounces is not decided")
        mode = self.modes(self.held | {k}, signs)
        if not all(each.at(t, after) > 0 for each in mode.watched if each.kind == "force"):
            raise NotEnclosed(
                f"whether {watched.name} stays closed after the impact is not decided"
            )
        return mode, restart, "impact"

    def _signs_after(self, t: Any, x: Sequence[Any]) -> list[int]:
        found: list[int] = []
        if self.stuck:
            raise NotEnclosed(
                f"an impact while friction holds, at t = {float(t):.6g}: not enclosed"
            )
        for each in self.watched:
            if each.kind == "kink":
                found.append(_sign_of(each.sign * each.at(t, x)))
                if not found[-1]:
                    raise NotEnclosed("an impact leaves a switching function undecided")
            elif each.kind == "force" and not each.at(t, x) > 0:
                raise NotEnclosed(f"whether {each.name} is lost by an impact is not decided")
        return found

    def _impulse(self, system: LinearSystem) -> Restart:
        """The change of velocities that solves a system."""
        n = self.motion.n

        def state(t: Any, x: Sequence[Any]) -> list[Any]:
            jumps = system.solution([t], [[each] for each in x], 1).found[0].entries()[:n]
            return [*x[:n], *(v + d for v, d in zip(x[n:], jumps, strict=True))]

        def jacobian(t: Any, x: Sequence[Any]) -> Any:
            whole, found = self._unmoved(t, x), system.slopes([t], [[each] for each in x], 1)[0]
            for i in range(n):
                for j in range(2 * n + 1):
                    whole[n + i, j] += found[i, j]
            return whole

        return Restart(state, jacobian)

    @staticmethod
    def _unmoved(_: Any, x: Sequence[Any]) -> Any:
        """d/dt and d/dx of x itself."""
        from flint import arb_mat

        n = len(x)
        return arb_mat(n, n + 1, [int(j == i + 1) for i in range(n) for j in range(n + 1)])


def _sign_of(x: Any) -> int:
    """1 or -1; 0 where that is not decided."""
    return 1 if x > 0 else -1 if x < 0 else 0


def _without(equations: EquationsOfMotion, implied: frozenset[int]) -> EquationsOfMotion:
    if not implied:
        return equations
    kept = [place for k, place in equations.place.items() if k not in implied]
    fewer = equations.without_implied(kept)
    fewer.place = {k: kept.index(place) for k, place in equations.place.items() if place in kept}
    return fewer
