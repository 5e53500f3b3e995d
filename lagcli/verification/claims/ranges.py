"""Values of a parameter with which a condition lasts or a place is reached: motions beside bounds.

Beside each printed bound the motion is integrated from the initial state.  A condition that
fails within a range, or a place that is reached outside of it, refutes the answer; so does, for
one degree of freedom and no time in L, what does not come to pass until a coordinate has turned
back twice, or has gone round twice.  That an equation holds nowhere on the way is refuted by a
motion on which its sides pass each other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi

from flint import arb

from lagcli.expression import Expression
from lagcli.problem_data import Inequality, Lasting, Reaching, Where
from lagcli.statements.questions import Ranges
from lagcli.verification.claims.reached import Reached
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, size, solve
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State
from lagcli.verification.stepped_motion import SteppedMotion

_STEP, _STEPS = arb(1) / 10, 150
#: Relative distance from a bound; the rule is right to some 1e-4 on the way.
_BESIDE = 0.05
#: Slower is rounding on the constraints.
_MOVES = 1e-6
#: The speed with which what is at rest may begin to move.
_PUSH = arb(1) / 1000


def holds_in_ranges(
    x: Examination, what: str, answer: Ranges, question: Lasting | Reaching, reached: Reached
) -> bool:
    """Whether motions with parameters beside the bounds do what the ranges say."""
    trees = [b for each in answer.ranges or () for _, b in each.bounds]
    places = x.places(what, trees)
    if places is None:
        return False
    bounds = dict(zip(map(id, trees), places, strict=True))
    tried = 0
    for base in x.states(1):
        still = reached.still(base, given_values=answer.given_values)
        at = x.reference.values(still)
        intervals = [
            tuple(
                sign * float("inf") if b is None else float(at(bounds[id(b)]).mid())
                for sign, b in ((-1, each.lower), (1, each.upper))
            )
            for each in answer.ranges or ()
        ]
        for value in _beside(intervals):
            if not _allowed(x, question.unknown.name, value):
                continue
            start = reached.initial({**still, (question.unknown.name, 0): arb(value)})
            claimed = any(low < value < high for low, high in intervals)
            try:
                comes = None if start is None else PassingMotion(x, start, question).outcome()
            except Unclear:
                continue
            tried += start is not None
            if comes not in {None, claimed}:
                said = "it does not hold" if claimed else "it holds"
                x.refute(what, f"{said} where {question.unknown.name} = {value:.6g}")
                return False
    if not tried:
        x.unchecked.append(what)
    return True


def comes_to_pass(x: Examination, question: Where, reached: Reached) -> bool:
    """Whether the sides of an equation surely pass each other on the way from the initial state."""
    for base in x.states(1):
        start = reached.initial(reached.still(base))
        for begun in () if start is None else _begun(x, start):
            try:
                if PassingMotion(x, begun, question).outcome():
                    return True
            except Unclear:
                continue
    return False


def _begun(x: Examination, start: Environment) -> Iterator[Environment]:
    """The state itself, and with a small velocity that constraints and assumptions allow."""
    names, jacobian = x.reference.names, State(x.reference, start).laws.jacobian
    yield start
    for way in solve(jacobian, [arb(0)] * len(jacobian), len(names)).kernel:
        for push in (_PUSH, -_PUSH):
            moved = {n: (start[n, 1] + push * d).mid() for n, d in zip(names, way, strict=True)}
            if all(
                c.assume not in {"positive", "nonnegative"}
                or start[c.name, 0] > 0 or moved[c.name] >= 0
                for c in x.problem.coordinates
            ):  # fmt: skip
                yield {**start, **{(n, 1): v for n, v in moved.items()}}


def _beside(intervals: Sequence[tuple[float, ...]]) -> Iterator[float]:
    """Numbers on both sides of each bound; some where there is none."""
    ends = {e for each in intervals for e in each if abs(e) < float("inf")}
    for end in sorted(ends):
        yield from (end + side * _BESIDE * max(abs(end), 0.2) for side in (-1, 1))
    if not ends:
        yield from (0.3, 2.5)


def _allowed(x: Examination, name: str, value: float) -> bool:
    signs = {p.name: p.assume for p in x.problem.parameters}
    return not (
        (signs[name] in {"positive", "nonnegative"} and value <= 0)
        or (signs[name] == "negative" and value >= 0)
    )


class PassingMotion:
    """The motion from one state, until the question is decided."""

    def __init__(
        self, x: Examination, start: Environment, question: Lasting | Reaching | Where
    ) -> None:
        self.x, self.motion, self.question = x, SteppedMotion(x.reference, start), question
        reference, program = x.reference, x.reference.program
        self.names = reference.names
        held = [c.holds_while for c in x.problem.constraints if c.holds_while is not None]
        if isinstance(question, Reaching):
            self.sought = self._gap(question.coordinate, question.value)
        elif isinstance(question, Where):
            self.sought = self._gap(question.equation.left, question.equation.right)
        else:
            held = [each for each in held if each != question.condition]
            self.sought = self._margin(question.condition)
        self.ends = [self._margin(each) for each in held]
        still = reference.by(reference.lagrangian, reference.time)
        freedom = len(self.names) - len(reference.rows)
        self.periodic = freedom == 1 and still == program.zero and not x.problem.dissipation

    def _gap(self, left: Expression, right: Expression) -> int:
        program, place = self.x.reference.program, self.x.reference.place
        return program.sum(place(left), program.negative(place(right)))

    def _margin(self, condition: Inequality) -> int:
        """What is positive while a condition holds."""
        return self._gap(*condition.larger_first)

    def outcome(self) -> bool | None:
        """Whether the condition holds all the time, or the place or the equation is reached.

        None where that is undecided.

        Raises
        ------
        Unclear
            Where nothing has a value, or nothing moves.
        """
        lasting, turns = isinstance(self.question, Lasting), [0] * len(self.names)
        before: list[float] = []
        begun = dict(self.motion.environment)
        for number in range(_STEPS):
            state = self.motion.state
            rates = self.motion.rates(state)
            values = [float(state.at(p).mid()) for p in (self.sought, *self.ends)]
            if number == 0 and all(size(r) < _MOVES for r in rates):
                raise Unclear  # at rest where it starts
            if lasting and values[0] < -1e-4:
                return False
            if not lasting and before and before[0] * values[0] <= 0 and before[0] != values[0]:
                return True
            if any(v < -1e-4 for v in values[1:]):
                return lasting
            speeds = [float(state.environment[n, 1].mid()) for n in self.names]
            for k, (a, b) in enumerate(zip(before[1:], speeds, strict=False)):
                turns[k] += a * b < 0 and min(abs(a), abs(b)) > _MOVES
            if self.periodic and (max(turns) > 1 or (lasting and self._gone_round(begun, rates))):
                return lasting
            before = [values[0], *speeds]
            self.motion.advance(_STEP, rates)
        return None

    def _gone_round(self, begun: Environment, rates: Sequence[arb]) -> bool:
        """Whether an angle has grown or fallen by two turns; only of one is the motion the same."""
        now = self.motion.environment
        for name in self.names:
            gap = now[name, 0] - begun[name, 0]
            if size(gap) > 4 * pi:
                back = {(name, 0): now[name, 0] - 2 * gap.sgn() * arb.pi()}
                there = self.motion.rates(State(self.x.reference, {**now, **back}))
                return all(size(a - b) < _MOVES for a, b in zip(there, rates, strict=True))
        return False
