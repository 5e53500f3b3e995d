"""The examination of one answer sheet: what it shares between the kinds of claims.

Every formula is printed in the grammar of the problem format, as the JSON has it, read back,
and evaluated at random states.  A claim that a state refutes is retracted with a sentence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import cast

from flint import arb, ctx

from lagcli.diagnostics import ProblemError
from lagcli.expression import Call, Expression, Name, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.problem_data import Problem
from lagcli.reader import parse_text
from lagcli.rewriting import expressions_in
from lagcli.verification.comparison import ComparisonVerdict, compare, is_zero
from lagcli.verification.linear import Unclear, rank
from lagcli.verification.reference import Reference
from lagcli.verification.states import OF_ONE_ORDER, State, phase_states, random_states
from lagcli.verification.sweeps import StepValues, Unknown

#: What a warning says of a claim that does not hold at a state, and of claims without a value.
REFUTED = "could not be confirmed; this is left out"
UNDECIDED = "not verified in numbers"
#: States at which each claim is tried, and how many are looked at where it has no value.
STATES = 3
LOOKED_AT = OF_ONE_ORDER
#: States at which a rate that is claimed not to be 0 is tried where constraints may have branches:
#: a fifth of the states on y (x + z) (z - 3 y) = 0 is on the least likely one.
BRANCHED = 24
#: Bits, and those with which balls are evaluated again where they are too wide to decide.
PRECISIONS = (128, 320, 800)

#: A true value at a state, and the values in which a printed formula is evaluated there.
Truth = Callable[[State], arb]
#: Two lists of values at a state; None where the claim says nothing of it.
Sides = Callable[[State], tuple[Sequence[arb], Sequence[arb]] | None]
Truths = Callable[[State], Sequence[arb]]
Scene = Callable[[State], StepValues]


def at_state(state: State) -> StepValues:
    """The values of parameters, t, q, q', q'', multipliers and momenta there."""
    return state.at


class Unreadable(Exception):
    """What is printed cannot be read back."""


class Examination:
    """The reference, the states, and what was found.

    Attributes
    ----------
    retracted : list of str
        A sentence for each claim that did not hold.
    unchecked : list of str
        What could not be evaluated.
    moving : set of str
        The names of shared formulas in which velocities occur.
    """

    def __init__(
        self, problem: Problem, reference: Reference | None = None, rank: int | None = None
    ) -> None:
        self.problem = problem
        self._rank = rank  # of the constraints where the answers hold
        self.reference = Reference(problem) if reference is None else reference
        self.retracted: list[str] = []
        self.unchecked: list[str] = []
        self.moving: set[str] = set()
        self._count = 1 if self.reference.large else STATES
        self._why = ""
        self._read: dict[str, int] = {}
        self._found: dict[int, list[State]] = {}
        self._more: dict[int, Iterator[State]] = {}

    def of(self, problem: Problem) -> Examination:
        """The examination of a variant of the problem, whose findings are noted here."""
        other = Examination(problem)
        other.retracted, other.unchecked = self.retracted, self.unchecked
        return other

    # -- states -----------------------------------------------------------------------------

    def states(self, count: int = 0, bits: int = PRECISIONS[0]) -> list[State]:
        """The first states (as many as each claim is tried at), fewer where no more are found."""
        count = count or self._count
        found = self._found.setdefault(bits, [])
        more = self._more.get(bits)
        if more is None:
            more = self._more[bits] = self._random_states()
        while len(found) < count:
            with ctx.workprec(bits):
                state = next(more, None)
            if state is None:
                break
            found.append(state)
        return found[:count]

    def _random_states(self) -> Iterator[State]:
        if self.reference.of_phase_space:
            return cast("Iterator[State]", phase_states(self.reference))
        return self._of_the_rank(random_states(self.reference))

    def _of_the_rank(self, states: Iterator[State]) -> Iterator[State]:
        """Those on the branches of the constraints where the answers hold; all if none is seen."""
        filtered = self._rank is not None and len(self.reference.rows) > 1
        others: list[State] = []
        for state in states if filtered else ():
            if self._has_rank(state):
                yield state
                others = []
                break
            others.append(state)
            if len(others) == LOOKED_AT:
                break
        yield from others
        yield from states if others or not filtered else filter(self._has_rank, states)

    def _has_rank(self, state: State) -> bool:
        return self._rank_at(state) == self._rank

    def _rank_at(self, state: State) -> int | None:
        try:
            return rank(state.laws.jacobian, len(self.reference.names))
        except Unclear:
            return None

    def rank_is_possible(self) -> bool:
        """Whether the constraints may have the rank of the answers at a state."""
        if self.reference.of_phase_space or self.reference.large:
            return True
        found = {self._rank_at(state) for state in self.states()}
        return not found or not found.isdisjoint({self._rank, None})

    @property
    def regular(self) -> bool:
        """Whether the equations determine q'' at the states."""
        return all(state.laws.regular for state in self.states())

    # -- formulas -----------------------------------------------------------------------------

    def place(self, expression: Expression) -> int:
        """The step of a formula, read back from its printed form.

        Raises
        ------
        Unreadable
            When the reader does not read it.
        """
        text = to_grammar(expression)
        if text not in self._read:
            try:
                self._read[text] = self.reference.place(parse_text(text))
            except (ProblemError, KeyError) as error:
                raise Unreadable(text) from error
        return self._read[text]

    def places(self, what: str, expressions: Sequence[Expression]) -> list[int] | None:
        """The steps of printed formulas; None, and noted, where one cannot be read back."""
        try:
            return [self.place(expression) for expression in expressions]
        except Unreadable as error:
            self.refute(what, f"its printed form {error} cannot be read back")
        return None

    def define(self, what: str, shared: Mapping[str, Expression]) -> None:
        """Let names stand for printed formulas, each of which may use earlier ones."""
        for name, expression in shared.items():
            if self.places(what, [expression]) is not None:
                self.reference.program.define(name, self.place(expression))
            if self.has_velocities(expression):
                self.moving.add(name)

    def has_velocities(self, expression: Expression) -> bool:
        """Whether a velocity occurs in it, by itself or in a shared formula."""
        names = (node for node in walk(expression) if isinstance(node, Name))
        return any(node.primes or node.name in self.moving for node in names)

    def holds(
        self, what: str, expression: Expression, truth: Truth, scene: Scene = at_state
    ) -> bool:
        """Whether a printed formula has the true value at random states; noted if not."""
        return self.hold(what, [expression], lambda s: [truth(s)], scene)

    def hold(self, what: str, expressions: Sequence[Expression], truths: Truths,
             scene: Scene = at_state) -> bool:  # fmt: skip
        """The same for several formulas that are one claim."""
        places = self.places(what, expressions)
        if places is None:
            return False
        return self.decide(what, lambda s: ([scene(s)(place) for place in places], truths(s)))

    def differ_by(
        self, what: str, sides: Sequence[tuple[Expression, Expression]], truths: Truths
    ) -> bool:
        """Whether left - right of printed equations is right for any q'' and lambda."""
        places = self.places(what, [side for pair in sides for side in pair])
        if places is None:
            return False
        pairs = list(zip(places[::2], places[1::2], strict=True))
        return self.decide(
            what, lambda s: ([s.loose.at(a) - s.loose.at(b) for a, b in pairs], truths(s))
        )

    def vanishes(self, what: str, value: Truth) -> bool:
        """Whether a quantity is 0 at random states; noted if not."""
        return self.decide(what, lambda s: ([value(s)], [arb(0)]))

    def constant(self, what: str, claim: bool, value: Truth) -> bool:
        """Whether a rate is 0 at all states (claim True), or not 0 at one (False); noted if not."""
        if claim:
            return self.vanishes(what, value)
        if not self.states():
            self.unchecked.append(what)
        elif self._all_zero(value, self._count) and self._all_zero(value, self._on_branches):
            self.refute(what, "the value that it denies to be 0 is 0 at random states")
            return False
        return True

    def _all_zero(self, value: Truth, count: int) -> bool:
        return all(is_zero(value(s)) for s in self.states(count))

    @property
    def has_kinks(self) -> bool:
        """Whether a formula of the file may have no derivative, or jump, somewhere."""
        parts = (part for tree in expressions_in(self.problem) for part in walk(tree))
        return any(isinstance(part, Call) and part.function in {"abs", "sign"} for part in parts)

    @property
    def _on_branches(self) -> int:
        """States that meet the branches of the constraints: a rate may be 0 on some of them."""
        return BRANCHED if self.reference.rows else self._count

    def determined(self, what: str, at: Callable[[State], bool]) -> bool:
        """Whether the laws determine a quantity at some state; noted if not."""
        states = self.states()
        if not states or any(map(at, states)):
            return True
        self.refute(what, "the equations do not determine it")
        return False

    def decide(self, what: str, sides: Sides) -> bool:
        """Whether two lists of values agree at random states; noted if not."""
        tried = looked_at = 0
        undefined = False
        while tried < self._count and looked_at < (BRANCHED if undefined else LOOKED_AT):
            looked_at += 1
            try:
                verdict = self._at_state(sides, looked_at)
            except Unknown as error:
                self.refute_name(what, error)
                return False
            if verdict is ComparisonVerdict.DIFFERENT:
                self.refute(what, f"as derived it is {self._why}")
                return False
            tried += verdict is ComparisonVerdict.EQUAL
            undefined |= verdict is ComparisonVerdict.UNDEFINED
        if tried:
            return True
        if undefined:
            self.refute(what, "as derived it has no real value at random states")
            return False
        self.unchecked.append(what)
        return True

    def _at_state(self, sides: Sides, number: int) -> ComparisonVerdict | None:
        """What one state says, with more bits where balls are too wide; None: nothing."""
        verdict = None
        for bits in PRECISIONS:
            states = self.states(number, bits)
            if len(states) < number:
                return verdict
            with ctx.workprec(bits):
                values = sides(states[-1])
                verdict = None if values is None else self._compared(*values)
            if verdict in {
                None,
                ComparisonVerdict.EQUAL,
                ComparisonVerdict.UNDEFINED,
            } or self._exact(verdict):
                break
        return verdict

    def _exact(self, verdict: ComparisonVerdict | None) -> bool:
        """Whether no rounding of a projected state can be what makes a difference."""
        return verdict is ComparisonVerdict.DIFFERENT and not self.reference.rows

    def _compared(self, left: Sequence[arb], right: Sequence[arb]) -> ComparisonVerdict:
        verdicts = []
        for a, b in zip(left, right, strict=True):
            verdict = compare(a, b)
            if verdict is ComparisonVerdict.DIFFERENT:
                self._why = f"{_shown(a)} at a random state, where {_shown(b)} is right"
                return verdict
            verdicts.append(verdict)
        worse = (
            v for v in (ComparisonVerdict.UNDECIDED, ComparisonVerdict.UNDEFINED) if v in verdicts
        )
        return next(worse, ComparisonVerdict.EQUAL)

    # -- findings -----------------------------------------------------------------------------

    def refute(self, what: str, why: str) -> None:
        """Note that a claim is not printed."""
        sentence = f"{what} {REFUTED}: {why}"
        if sentence not in self.retracted:
            self.retracted.append(sentence)

    def refute_name(self, what: str, error: Unknown) -> None:
        """Note that a claim uses a name that means nothing."""
        self.refute(what, f"its printed form uses {error}, which is not declared")

    def warnings(self) -> tuple[str, ...]:
        """A sentence for each claim that is not printed, and one for all that were not tried."""
        if not self.unchecked:
            return tuple(self.retracted)
        names = ", ".join(dict.fromkeys(self.unchecked))
        why = "" if self.states() else " (no state was found that the constraints allow)"
        return (*self.retracted, f"{UNDECIDED}{why}: {names}")


def _shown(x: arb) -> str:
    return f"{float(x.mid()):.6g}"
