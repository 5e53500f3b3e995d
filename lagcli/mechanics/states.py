"""Random states on the constraint surface, at 50 digits, for checks by substitution.

Parameters, time, coordinates and velocities are drawn from a fixed sequence, then moved
onto f(q, t) = 0 by Newton steps of least norm and onto A q' + b = 0 by one linear step.
The rank of A there names redundant constraints; where the factors of the constraints make several
surfaces, the states are on those of one rank.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator, Sequence
from itertools import count, islice, product

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.build import without_jumps
from lagcli.algebra.numeric import DIGITS, Evaluator, with_assumed_sign
from lagcli.algebra.row_rank import Elimination, independent_rows, least_norm_solution, rows_of
from lagcli.mechanics.constraints import Constraints
from lagcli.mechanics.system import System

_GUARD = 15  # digits beyond those that are claimed
_TOLERANCE = mpf(10) ** -(DIGITS + 5)
_ATTEMPTS = 40  # measured: all 40 where a branch has no real state
_NEWTON_STEPS = 60  # at a double root each gains a bit
_HALVINGS = 8  # to a 256th of a step; a shorter one leads nowhere
_AS_DRAWN = 20  # attempts with the parameters as they were drawn
_SURFACES = 32  # at most: of two or three forms with three factors each, all
_REDRAWN = 60  # times, for each quantity, until roots and logarithms are real
_NEAR = 3  # states drawn near 0, before those that come from afar

State = dict[Symbol, mpf]


class Contradiction(Exception):
    """No state satisfies the constraints; carries the index of the one that cannot hold."""

    def __init__(self, index: int) -> None:
        super().__init__(index)
        self.index = index


class RandomStates:
    """States (parameters, t, q, q') that satisfy every constraint, always the same ones."""

    def __init__(self, system: System, constraints: Constraints) -> None:
        self.system = system
        self.constraints = constraints
        self._positions = [e for e in constraints.equations if e.holonomic]
        self._forms = self._branches()
        self._surfaces = [self._surface(forms, system.q) for forms in self._forms]
        self._wide: dict[int, Evaluator] = {}
        fixed = [p for p in system.parameters if p.is_integer]
        self._movable = (*system.q, *(p for p in system.parameters if p not in fixed), system.t)
        self._f, self._f_rows = self._surfaces[0]
        self._a_rows = Evaluator(
            [x for e in constraints.equations for x in (*e.row, e.drift)], DIGITS + _GUARD
        )
        self._lagrangian = Evaluator([system.L, *system.applied_forces], DIGITS + _GUARD)
        self._radicands = Evaluator(_radicands([system.L, *system.applied_forces]))
        self._kinks = Evaluator(_kinks(e.f for e in constraints.equations), DIGITS + _GUARD)
        self._kept: list[State] = []
        self._open = list(range(len(self._surfaces)))  # those that are visited
        self._generator = self._of_one_rank()
        self._contradiction: Contradiction | None = None
        self._last: Elimination | None = None
        #: The independent constraints, the same at all states, and surfaces where others are.
        self.elimination: Elimination | None = None
        self.other_surfaces: list[tuple[Sequence[Expr], Elimination]] = []

    @property
    def surfaces(self) -> int:
        """The number of surfaces that the factors of the constraints make; all are visited."""
        return len(self._open)

    def _branches(self) -> list[list[Expr]]:
        """The forms f of the holonomic constraints, one factor of each."""
        branches = self.constraints.branches
        choices = [branches.get(e.name, (e.f,)) for e in self._positions]
        return [list(forms) for forms in islice(product(*choices), _SURFACES)]

    def _surface(
        self, forms: Sequence[Expr], variables: Sequence[Symbol]
    ) -> tuple[Evaluator, Evaluator]:
        """The forms, and their gradients."""
        rows = [without_jumps(f.diff(q)) for f in forms for q in variables]
        return Evaluator(forms, DIGITS + _GUARD), Evaluator(rows, DIGITS + _GUARD)

    def take(self, number: int) -> list[State]:
        """The first `number` states.

        Raises
        ------
        Contradiction
            When no state was found that satisfies all constraints.
        """
        while len(self._kept) < number:
            if self._contradiction is not None:
                raise self._contradiction
            try:
                self._kept.append(next(self._generator))
            except Contradiction as found:
                self._contradiction = found  # the generator has ended with it
                raise
        return self._kept[:number]

    def placed(self, state: State) -> bool:
        """Move a state onto the constraints, its parameters as they are; whether it worked."""
        with mpmath.workdps(DIGITS + _GUARD):
            return self._project(state) is None

    # -- drawing ------------------------------------------------------------------------

    def _draw(self, source: random.Random, scale: float, *, wide: bool) -> State:
        state: State = {}
        system = self.system
        for parameter in system.parameters:
            state[parameter] = random_value(source, parameter, 0.6, 1.7)
        state[system.t] = mpf(source.randint(100, 900)) / 1009
        for q in system.q:
            state[q] = random_value(source, q, 0.3, 3.3 if wide else 1.3)
            if wide and source.random() < 0.3 and _has_assumed_sign(q, -state[q]):
                state[q] = -state[q]
        for v in system.qdot:
            state[v] = random_value(source, v, 0.1, 0.9) * scale
        return state

    def _of_one_rank(self) -> Iterator[State]:
        """The states at which the same constraints are independent, as many of them as possible."""
        first = self._first_of_each_surface()
        self.elimination = max((e for _, e, _ in first), key=lambda e: len(e.independent))
        self._open = sorted({k for k, e, _ in first if e == self.elimination})
        others = {k: e for k, e, _ in first if k not in self._open}
        self.other_surfaces = [(self._forms[k], e) for k, e in others.items()]
        yield from (state for _, e, state in first if e == self.elimination)
        for _, _, state in self._generate(self._open):
            if state not in self._kept:
                yield state

    def _first_of_each_surface(self) -> list[tuple[int, Elimination, State]]:
        """One state; where there are several surfaces, two of each that has regular ones."""
        found: list[tuple[int, Elimination, State]] = []
        failed: list[Contradiction] = []
        for surface in self._open:  # each by itself: few draws reach z = u = π on z = u, sin z = 0
            try:
                for each in islice(self._generate([surface]), 1 if self.surfaces == 1 else 2):
                    found.append(each)  # noqa: PERF402 - what came before a contradiction counts
            except Contradiction as contradiction:
                failed.append(contradiction)
        if not found:
            raise failed[0]
        return found

    def _generate(self, surfaces: Sequence[int]) -> Iterator[tuple[int, Elimination, State]]:
        """States of the surfaces in turn; ends with a contradiction where too many draws fail."""
        with mpmath.workdps(DIGITS + _GUARD):
            source = random.Random("lagcli")
        failures: dict[int, int] = {}
        attempts = 0
        for draw in count():
            attempts += 1
            surface = surfaces[draw % len(surfaces)]
            self._f, self._f_rows = self._surfaces[surface]
            scale = 1.0 if attempts % 3 else 0.1
            with mpmath.workdps(DIGITS + _GUARD):
                # the branches of x^2 = y^2 or cos(x) = cos(y) are met from all sides
                often = len(self._surfaces) > 1 or len(self._kept) >= _NEAR
                wide = attempts % 2 == 1 if often else attempts % 3 == 0
                state = self._draw(source, scale, wide=wide)
                if attempts > _AS_DRAWN:
                    self._make_real(source, state)
                    self._adapt(state, surface)
                failed = self._project(state)
                good = failed is None and self._is_regular(state)
            if good and self._last is not None and self.elimination in {None, self._last}:
                attempts = min(attempts // _AS_DRAWN, 1) * _AS_DRAWN  # adapted, too, if this was
                yield surface, self._last, state
                continue
            if failed is not None:
                failures[failed] = failures.get(failed, 0) + 1
            if attempts >= _ATTEMPTS:
                worst = max(failures, key=lambda k: (failures[k], k)) if failures else -1
                raise Contradiction(worst)

    def _make_real(self, source: random.Random, state: State) -> None:
        """Draw one quantity after the other anew, where that makes no root less real."""
        moving = (*self._movable, *self.system.qdot)
        best = self._unreal(state)
        for _ in range(_REDRAWN * len(moving)):
            if not best[0]:
                return
            x = source.choice(moving)
            size = mpf(source.randint(1000, 10000)) / 10007 * source.choice((1, 1, 3, 9))
            other = {**state, x: with_assumed_sign(source, x, size)}
            there = self._unreal(other)
            if there <= best:
                state[x], best = other[x], there

    def _unreal(self, state: State) -> tuple[float, mpf]:
        """How many arguments of roots and logarithms are not positive, and how far in sum."""
        values = self._radicands.where_defined(state)
        if values is None:
            return math.inf, mpf(0)
        below = [-value if is_real(value) else 0 for value in values]
        below = [x for x in below if x >= 0]
        return len(below), mpmath.fsum(below)

    def _is_regular(self, state: State) -> bool:
        """Whether L and the forces are finite and real there, and no constraint has a kink."""
        try:
            values = self._lagrangian(state)
            smooth = all(map(_far, self._kinks(state)))
        except (ArithmeticError, ValueError):
            return False
        return smooth and all(is_real(v) for v in values)

    def _project(self, state: State) -> int | None:
        """Move the state onto the constraints; the index of one that fails, or None."""
        try:
            failed = self._project_positions(state)
            return failed if failed is not None else self._project_velocities(state)
        except (ArithmeticError, ValueError):
            return 0 if self.constraints.equations else -1

    def _index(self, position: int) -> int:
        return self.constraints.equations.index(self._positions[position])

    def _adapt(self, state: State, surface: int) -> None:
        """Move the parameters and the time as well, to where the constraints can hold.

        x = 4 a and x² + y² = l² have a solution for l > 4 a.  Not where they hold for special
        parameters only, x = a and x = b: there the gradients in q alone have a lower rank.
        """
        if not self._positions:
            return
        if surface not in self._wide:
            self._wide[surface] = self._surface(self._forms[surface], self._movable)[1]
        moved, wide = dict(state), self._wide[surface]
        try:
            if self._newton(moved, self._movable, wide) is None:
                narrow = self._independent(self._f_rows(moved), len(self.system.q))
                if len(narrow) == len(self._independent(wide(moved), len(self._movable))):
                    state.update(moved)
        except (ArithmeticError, ValueError):
            return

    def _independent(self, flat: Sequence[mpf], width: int) -> tuple[int, ...]:
        return independent_rows(rows_of(flat, width), mpf(10) ** -25).independent

    def _project_positions(self, state: State) -> int | None:
        if not self._positions:
            return None
        start = dict(state)
        failed = self._newton(state, self.system.q, self._f_rows)
        if failed is not None:  # 1/x = 50 and ln x = 5 from x = 1
            state.update(start)
            failed = self._newton(state, self.system.q, self._f_rows, damped=True)
        return failed

    def _newton(
        self,
        state: State,
        unknowns: Sequence[Symbol],
        gradients: Evaluator,
        *,
        damped: bool = False,
    ) -> int | None:
        """Newton steps of least norm in the unknowns; the index of a constraint that fails.

        Those that are `damped` are halved until no constraint is further off than before.
        """
        n = len(unknowns)
        for _ in range(_NEWTON_STEPS):
            values = self._f(state)
            if not all(is_real(v) for v in values):
                return self._index(0)
            flat = gradients(state)
            if not all(is_real(x) for x in flat):
                return self._index(0)
            rows = rows_of(flat, n)
            elimination = independent_rows(rows, mpf(10) ** -12)
            kept = elimination.independent
            if max(map(abs, values)) < _TOLERANCE:
                return None if self._admissible(state) else self._index(0)
            if not kept:
                return self._index(0)
            step = least_norm_solution([rows[i] for i in kept], [-values[i] for i in kept])
            longest = max(map(abs, step))
            room = 2 + damped * max(abs(state[q]) for q in unknowns)
            shrink = min(mpf(1), room / longest) if longest else mpf(1)
            for _ in range(_HALVINGS if damped else 1):
                there = _moved(state, unknowns, [shrink * delta for delta in step])
                if not damped or self._is_nearer({**state, **there}, values):
                    break
                shrink /= 2
            state.update(there)
            if longest < _TOLERANCE and elimination.dependent:
                wrong = [i for i in elimination.dependent if abs(values[i]) > mpf(10) ** -20]
                if wrong:
                    return self._index(wrong[0])
        return self._index(max(range(len(values)), key=lambda i: abs(values[i])))

    def conditions_on_positions(self) -> int:
        """How many constraints without velocities are independent of each other at a state."""
        held = [k for k, e in enumerate(self.constraints.equations) if e.holonomic]
        if len(held) < 2:
            return len(held)
        [state], n = self.take(1), len(self.system.q)
        with mpmath.workdps(DIGITS):
            rows = rows_of(self._a_rows(state), n + 1)
            kept = independent_rows([rows[k][:n] for k in held], mpf(10) ** -25)
        return len(kept.independent)

    def _is_nearer(self, state: State, before: Sequence[mpf]) -> bool:
        """Whether the constraints are less far from 0 than they were."""
        try:
            values = self._f(state)
        except (ArithmeticError, ValueError):
            return False
        return all(map(is_real, values)) and max(map(abs, values)) <= max(map(abs, before))

    def _admissible(self, state: State) -> bool:
        """Whether the coordinates kept the signs that the file assumes."""
        return all(_has_assumed_sign(q, state[q]) for q in self.system.q)

    def _project_velocities(self, state: State) -> int | None:
        equations = self.constraints.equations
        if not equations:
            self._last = Elimination((), ())
            return None
        n = len(self.system.q)
        flat = self._a_rows(state)
        if not all(is_real(x) for x in flat):
            return 0
        rows = [row[:n] for row in rows_of(flat, n + 1)]
        drift = flat[n :: n + 1]
        elimination = independent_rows(rows, mpf(10) ** -25)
        kept = elimination.independent
        corners = [
            i for i, e in enumerate(equations) if e.holonomic and not any(map(_far, rows[i]))
        ]
        if corners or not kept:  # z^2 = y z and z (z - 2 y) = 0 where y and z are 0
            return corners[0] if corners else 0
        residual = [
            -sum(a * state[v] for a, v in zip(rows[i], self.system.qdot, strict=True)) - drift[i]
            for i in kept
        ]
        for v, delta in zip(
            self.system.qdot, least_norm_solution([rows[i] for i in kept], residual), strict=True
        ):
            state[v] += delta
        for i in elimination.dependent:
            rest = sum(a * state[v] for a, v in zip(rows[i], self.system.qdot, strict=True))
            if abs(rest + drift[i]) > mpf(10) ** -25:
                return i
        self._last = elimination
        return None


def random_value(source: random.Random, symbol: Symbol, low: float, high: float) -> mpf:
    """Draw a value within [low, high] of the sign that is assumed, either sign without one."""
    if symbol.is_integer:
        return mpf(source.randint(2, 5))
    magnitude = mpf(source.randint(int(low * 10007), int(high * 10007))) / 10007
    return with_assumed_sign(source, symbol, magnitude, 0.7)


def _moved(state: State, unknowns: Sequence[Symbol], step: Sequence[mpf]) -> State:
    """A step on; a coordinate that has a sign keeps it: half-way to zero instead."""
    pairs = ((q, state[q] + delta) for q, delta in zip(unknowns, step, strict=True))
    return {q: x if _has_assumed_sign(q, x) else state[q] / 2 for q, x in pairs}


def _has_assumed_sign(symbol: Symbol, value: mpf) -> bool:
    return not (symbol.is_nonnegative and value <= 0) and not (symbol.is_negative and value >= 0)


def _kinks(forms: Iterable[Expr]) -> list[Expr]:
    """What is 0 where |u| has a kink or sign(u) jumps: a constraint has no gradient there."""
    found = {f.args[0] for form in forms for f in form.atoms(sympy.Abs, sympy.sign)}
    return sorted(found, key=str)


def _radicands(formulas: Iterable[Expr]) -> list[Expr]:
    """What is positive where roots and logarithms are real."""
    found = {f.args[0] for each in formulas for f in each.atoms(sympy.log)}
    found |= {p.base for f in formulas for p in f.atoms(sympy.Pow) if not p.exp.is_integer}
    return sorted((u for u in found if not u.is_number), key=str)


def _far(x: mpf) -> bool:
    return bool(abs(x) > mpf(10) ** -20)


def is_real(value: object) -> bool:
    """Whether a value is a finite real number."""
    return isinstance(value, mpf) and bool(mpmath.isfinite(value))
