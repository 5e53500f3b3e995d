"""Answers to `find`: put back into states that share the initial values of the charges.

The energy function (where it is conserved), the momenta of cyclic coordinates and the charges
that are printed have the values of the initial state; the answer must hold wherever they do.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from flint import arb

from lagcli.expression import Expression
from lagcli.problem_data import Lasting, Reaching, Rewrite, Where
from lagcli.record import replace
from lagcli.statements.answers import Charge, ChargesSection
from lagcli.statements.questions import Answer, FindSection, Ranges, Rewritten, Solutions
from lagcli.verification.claims.reached import Reached
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear
from lagcli.verification.states import State
from lagcli.verification.stepped_motion import SteppedMotion
from lagcli.verification.sweeps import Unknown

#: Relative difference of an answer and the truth; a velocity at a turning point is the root of
#: what is left of the energy.
_AGREE = 1e-6
#: Along the motion: the rule is right to some 1e-8 with short steps, and 1e-4 with long ones.
_STEP, _SAMPLES = arb(1) / 32, 8
_STRIDE, _STRIDES = arb(1) / 16, 160
_NEWTON_STEPS = 5
#: The part that is left of what decays: of exp(-k t) at t = 10, where k > 0.5.
_NEARED = 1e-2


def find(x: Examination, section: FindSection, charges: Sequence[Charge]) -> FindSection:
    """Each answer, at states that the initial values of the charges allow."""
    found = {name: _answer(x, name, each, charges) for name, each in section.answers.items()}
    return replace(section, answers=found)


def printed_charges(section: object) -> tuple[Charge, ...]:
    """Those of the sheet that are conserved."""
    if not isinstance(section, ChargesSection):
        return ()
    return tuple(each for each in section.charges if each.conserved and each.charge is not None)


def _answer(x: Examination, name: str, answer: Answer, charges: Sequence[Charge]) -> Answer:
    question = next(each for each in x.problem.find if each.name == name)
    what = f"the answer to '{name}'"
    if not all(row.holonomic for row in x.reference.rows) or x.reference.large:
        return answer
    reached = Reached(x, charges)
    if isinstance(answer, Rewritten) and isinstance(question, Rewrite):
        values = [v for v in (answer.value, *answer.values) if v is not None]
        allowed = _is_in_terms_of(x, what, question, values)
        if not values or (allowed and _is_value(x, what, question.value, values, reached)):
            return answer
        return replace(answer, value=None, values=(), note=_NOTE)
    if isinstance(answer, Solutions) and isinstance(question, Where) and answer.solutions == ():
        from lagcli.verification.claims.ranges import comes_to_pass

        moving = (question.unknown.name, question.unknown.primes) in reached.everything
        if not moving or not comes_to_pass(x, question, reached):
            return answer
        x.refute(what, "a motion comes to where the equation holds")
        return replace(answer, solutions=None, note=_NOTE)
    if isinstance(answer, Solutions) and isinstance(question, Where) and answer.solutions:
        places = x.places(what, answer.solutions)
        given = answer.given_values
        if places is not None and all(
            _is_root(x, what, question, p, reached, given_values=given) for p in places
        ):
            return answer
        return replace(answer, solutions=None, note=_NOTE)
    if isinstance(answer, Ranges) and isinstance(question, Lasting | Reaching):
        from lagcli.verification.claims.ranges import holds_in_ranges

        sound = answer.ranges is None or holds_in_ranges(x, what, answer, question, reached)
        return answer if sound else replace(answer, ranges=None, note=_NOTE)
    return answer


def _is_in_terms_of(
    x: Examination, what: str, question: Rewrite, values: Sequence[Expression]
) -> bool:
    """Whether the answer has no moving quantity but those that the question names."""
    names = x.reference.names
    moving = {("t", 0), *((n, k) for n in names for k in (0, 1, 2))}
    moving |= {(f"p_{n}", 0) for n in names}
    wanted = {(each.name, each.primes) for each in question.in_terms_of}
    used = x.reference.program.symbols(x.places(what, values) or [])
    other = sorted((used & moving) - wanted)
    if other:
        x.refute(what, f"it contains {other[0][0] + chr(39) * other[0][1]}")
    return not other


_NOTE = "what was derived does not hold at random states"


def _is_value(
    x: Examination, what: str, asked: Expression, values: Sequence[Expression], reached: Reached
) -> bool:
    """Whether the formula (or one of two) answers the question."""
    places = x.places(what, values)
    if places is None:
        return False
    truth = x.reference.place(asked)
    bases = [reached.still(base) for base in x.states(6)]
    on_charges = (state for known in bases for state in reached.states(known))
    tried, apart = _compared(on_charges, truth, places)
    if apart:  # along the motion more may hold than the charges say
        on_the_way = (s for known in bases[:2] for s in reached.passed(known, _STEP, _SAMPLES))
        decided, still_apart = _compared(on_the_way, truth, places)
        apart = still_apart if decided else apart
    if apart:
        x.refute(what, apart)
    elif not tried:
        x.unchecked.append(what)
    return not apart


def _compared(states: Iterator[State], truth: int, places: Sequence[int]) -> tuple[bool, str]:
    """Whether there were values, and where none of the formulas has the true one."""
    tried = 0
    while tried < _SAMPLES:
        try:
            state = next(states)
            true, found = state.at(truth), [state.at(place) for place in places]
        except StopIteration:
            break
        except Unclear:
            continue
        finite = [each for each in found if each.is_finite()]
        if not true.is_finite() or not finite:
            continue
        tried += 1
        if not any(_near(each, true) for each in finite):
            shown = f"{float(finite[0].mid()):.6g} where {float(true.mid()):.6g} is right"
            return True, f"as derived it is {shown}"
    return tried > 0, ""


def _is_root(
    x: Examination,
    what: str,
    question: Where,
    root: int,
    reached: Reached,
    *,
    given_values: bool,
) -> bool:
    """Whether the equation holds where the unknown has the value of the root."""
    key = (question.unknown.name, question.unknown.primes)
    if key not in {*reached.everything, ("t", 0)}:
        return True
    program = x.reference.program
    unknown = program.symbol(*key)
    pinned = [program.sum(unknown, program.negative(root))]
    sides = [x.reference.place(s) for s in (question.equation.left, question.equation.right)]
    if not program.symbols([root]) and not x.reference.values({})(root).is_finite():
        x.refute(what, "it is not real")
        return False
    gaps = []
    for base in x.states(5):
        try:
            if not x.reference.values(base.environment)(root).is_finite():
                continue
            known = reached.still(base, given_values=given_values)
            for state in reached.states(known, pinned):
                left, right = map(state.at, sides)
                if left.is_finite() and right.is_finite():
                    gaps.append(_near(left, right))
        except (Unclear, Unknown):
            continue
        if any(gaps):
            return True
    if gaps and _passed_as_root(x, reached, pinned[0], sides):
        return True
    if gaps:
        x.refute(what, "the equation does not hold there")
    else:
        x.unchecked.append(what)
    return not gaps


def _passed_as_root(x: Examination, reached: Reached, gap: int, sides: Sequence[int]) -> bool:
    """Whether a motion passes a place where the gap is 0 and the sides are equal, or nears one."""
    for base in x.states(5):
        gaps: list[float] = []
        apart: list[float] = []
        with suppress(Unclear, Unknown):
            for state in reached.passed(reached.still(base), _STRIDE, _STRIDES):
                left, right = map(state.at, sides)
                gaps.append(float(state.at(gap).mid()))
                apart.append(float((left - right).mid()))
                if gaps[-1] == 0 or gaps[0] * gaps[-1] < 0:
                    motion = SteppedMotion(x.reference, state.environment)
                    for _ in range(_NEWTON_STEPS):
                        here = motion.state
                        motion.advance(-here.at(gap) / here.laws.rate(gap))
                    if _near(*map(motion.state.at, sides)):
                        return True
                    break
            else:
                if all(abs(each[-1]) < _NEARED * abs(each[0]) for each in (gaps, apart)):
                    return True
    return False


def _near(a: arb, b: arb) -> bool:
    scale = 1.0 + abs(float(a.mid())) + abs(float(b.mid()))
    return abs(float((a - b).mid())) < _AGREE * scale
