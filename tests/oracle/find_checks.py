"""Answers to `find`: put back into states on the constraints with the initial charges."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from random import Random

from mpmath import mp, mpf

from lagcli.expression import Expression, Name, walk
from lagcli.problem_data import Lasting, Reaching, Rewrite, Where

from .evaluate import Moment, OutsideDomain, evaluate
from .examine import AGREEMENT, Examination, agree, with_momenta
from .jets import Number, real_part
from .linear import least_step
from .reference import Scalar, by_time, gradient
from .states import random_moments, reals, with_motion

STARTS = 4
PARAMETER_SETS = 8
STEPS = 12
#: At a turning point the velocity is only the root of what is left of the energy.
SETTLED = mpf(10) ** -24
ROOT_AGREEMENT = mpf(10) ** -9
#: Relative error that a Runge-Kutta run of this length may have.
RUN_AGREEMENT = mpf(10) ** -5


def check(x: Examination) -> None:
    """Every question of the file."""
    if "find" not in x.sheet:
        return
    for question in x.problem.find:
        where = f"find.{question.name}"
        answer = (x.sheet["find"] or {}).get(question.name)
        if answer is None:
            x.missing(where)
        elif isinstance(question, Where):
            _where(x, question, answer.get("solutions"))
        elif isinstance(question, Rewrite):
            _rewrite(x, question, answer.get("value"))
        else:
            _ranges(x, question, answer.get("ranges"))


def _initial(x: Examination, moment: Moment) -> Moment:
    """The state at t = 0; what is not given is 0, or what the constraints then leave."""
    reference = x.reference
    q, v = [mpf(0)] * reference.size, [mpf(0)] * reference.size
    fixed: list[set[int]] = [set(), set()]
    start = replace(moment, t=mpf(0))
    for name, node in x.problem.initial.items():
        index = reference.names.index(name.name)
        (v if name.primes else q)[index] = real_part(evaluate(node, reference.setting, start))
        fixed[name.primes].add(index)
    start = replace(start, chain=(tuple(q), tuple(v), *moment.chain[2:]))
    constraints = x.problem.constraints
    positions = [reference.value(c) for c in constraints if reference.holonomic(c)]
    forms = [reference.velocity_form(c) for c in constraints]
    everything = set(range(reference.size))
    start = _settle(start, positions, {0: everything - fixed[0]})
    return _settle(start, forms, {1: everything - fixed[1]})


def _settle(
    moment: Moment,
    functions: Sequence[Scalar],
    free: Mapping[int, set[int]],
    *,
    at_any_time: bool = False,
) -> Moment:
    """Newton's shortest steps in the free components until the functions vanish."""
    columns = [(level, i) for level, indices in free.items() for i in sorted(indices)]
    for _ in range(50):
        residual = reals([f(moment) for f in functions])
        if all(abs(r) < SETTLED for r in residual):
            return moment
        rows = []
        for f in functions:
            slopes = {level: reals(gradient(f, moment, level)) for level in free}
            row = [slopes[level][i] for level, i in columns]
            rows.append([*row, real_part(by_time(f, moment))] if at_any_time else row)
        step = least_step(rows, residual, len(columns) + at_any_time)
        longest = max(map(abs, step), default=mpf(0))
        if longest > 1:
            step = [d / longest for d in step]
        if at_any_time:
            moment = replace(moment, t=moment.t + step.pop())
        for (level, i), d in zip(columns, step, strict=True):
            moment = moment.shifted(level, {i: d})
    raise OutsideDomain("Newton's method found no such state")


def _flow(x: Examination, moment: Moment) -> list[Moment]:
    """States that the motion itself comes to, by the classical Runge-Kutta method."""

    def slope(m: Moment) -> Moment:
        return with_motion(x.reference, m).moment

    def moved(m: Moment, by: Moment, time: mpf) -> Moment:
        q, v = (
            tuple(a + time * b for a, b in zip(m.chain[level], by.chain[level + 1], strict=True))
            for level in (0, 1)
        )
        return replace(m, t=m.t + time, chain=(q, v, *m.chain[2:]))

    state, h, met = _initial(x, moment), mpf(1) / 32, []
    for step in range(1, STEPS + 1):
        k1 = slope(state)
        k2 = slope(moved(state, k1, h / 2))
        k3 = slope(moved(state, k2, h / 2))
        k4 = slope(moved(state, k3, h))
        mean = replace(
            k1,
            chain=tuple(
                tuple((a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(*rows, strict=True))
                for rows in zip(k1.chain, k2.chain, k3.chain, k4.chain, strict=True)
            ),
        )
        state = moved(state, mean, h)
        if step % 4 == 0:
            met.append(state)
    return met


def _reached(x: Examination, moment: Moment, extra: Sequence[Scalar] = ()) -> list[Moment]:
    """Random states with the constraints, the initial charges, and what else is asked."""
    reference = x.reference
    start = _initial(x, moment)
    constraints = x.problem.constraints
    functions: list[Scalar] = [reference.value(c) for c in constraints if reference.holonomic(c)]
    functions += [reference.velocity_form(c) for c in constraints]
    for entry in x.sheet.get("charges", []):
        node = x.read("find", entry["charge"]) if entry["conserved"] else None
        if node is not None:
            charge = reference.of(node)
            functions.append(_minus(charge, real_part(charge(start))))
    functions += extra
    everything = set(range(reference.size))
    random = Random(11)
    found = []
    for _ in range(STARTS):
        q, v = (
            tuple(mpf(round(random.uniform(-1.5, 1.5), 5)) for _ in reference.names)
            for _ in range(2)
        )
        there = replace(moment, chain=(q, v, *moment.chain[2:]))
        try:
            free = {0: everything, 1: everything}
            found.append(_settle(there, functions, free, at_any_time=bool(extra)))
        except (OutsideDomain, ZeroDivisionError):
            continue
        if len(found) == 2:
            break
    return found


def _minus(f: Scalar, value: Number) -> Scalar:
    return lambda m: f(m) - value


def _complete_moment(x: Examination, moment: Moment) -> Moment:
    """With accelerations, multipliers and momenta."""
    return with_momenta(x.reference, with_motion(x.reference, moment))


def _rewrite(x: Examination, question: Rewrite, value: object) -> None:
    where = f"find.{question.name}"
    if value is None:
        x.missing(where)
        return
    node = x.read(where, value)
    if node is None:
        return
    # A velocity constraint may have an integral that only the run itself knows.
    by_run = not all(map(x.reference.holonomic, x.problem.constraints))
    for state in x.states[: 1 if by_run else 2]:
        for moment in _flow(x, state.moment) if by_run else _reached(x, state.moment):
            full = _complete_moment(x, moment)
            answered = x.number(where, node, full)
            true = real_part(evaluate(question.value, x.reference.setting, full))
            near = RUN_AGREEMENT if by_run else AGREEMENT
            if answered is not None and not agree(answered, true, near):
                x.wrong(where, f"{value} is {mp.nstr(answered, 8)}, true is {mp.nstr(true, 8)}")


def _where(x: Examination, question: Where, solutions: Sequence[str] | None) -> None:
    where = f"find.{question.name}"
    if solutions is None:
        x.missing(where)
        return
    for text in solutions:
        node = x.read(where, text)
        if node is None:
            continue
        gaps = _gaps_somewhere(x, question, node)
        if not any(agree(gap, mpf(0), ROOT_AGREEMENT) for gap in gaps):
            shown = [mp.nstr(gap, 8) for gap in gaps]
            x.wrong(where, f"{text}: left - right is {shown or 'nowhere reached'}")


def _gaps_somewhere(x: Examination, question: Where, root: Expression) -> list[mpf]:
    """left - right at the root, for the first parameters with which the motion reaches it."""
    gaps: list[mpf] = []
    for moment in random_moments(x.reference, PARAMETER_SETS, seed=4):
        gaps += _gaps(x, question, root, moment)
        if any(agree(gap, mpf(0), ROOT_AGREEMENT) for gap in gaps):
            break
    return gaps


def _gaps(x: Examination, question: Where, root: Expression, moment: Moment) -> list[mpf]:
    """left - right where the unknown has the value of the root."""
    unknown = question.unknown
    value = x.reference.of(root)
    moves = any(isinstance(part, Name) and part.name in x.reference.names for part in walk(root))
    try:
        if unknown.name in x.reference.names:
            pinned: Scalar = _minus(x.reference.of(unknown), real_part(value(moment)))
            candidates = _reached(x, moment, [pinned])
        elif moves:  # a parameter by coordinates: at the places that its value belongs to
            size = moment.extra[unknown.name]
            candidates = [
                there
                for chosen in (size, -size)
                for there in _reached(
                    x,
                    replace(moment, extra={**moment.extra, unknown.name: chosen}),
                    [_minus(value, chosen)],
                )
            ]
        else:
            changed = {**moment.extra, unknown.name: real_part(value(moment))}
            candidates = _reached(x, replace(moment, extra=changed))
    except OutsideDomain:
        return []  # a root for other values of the parameters
    return [_gap(x, question, _complete_moment(x, m)) for m in candidates]


def _gap(x: Examination, question: Where, moment: Moment) -> mpf:
    left: Callable[[Moment], Number] = x.reference.of(question.equation.left)
    return real_part(left(moment) - x.reference.of(question.equation.right)(moment))


def _ranges(x: Examination, question: Lasting | Reaching, ranges: object) -> None:
    """A condition that lasts for a value within a range holds at states of a run with it."""
    where = f"find.{question.name}"
    if not isinstance(ranges, list):
        x.missing(where)
        return
    for bounds in ranges:
        read = [x.read(where, text.split(" ", 2)[2]) for text in bounds]
        for moment in random_moments(x.reference, 2, seed=5):
            numbers = [x.number(where, node, moment) for node in read if node is not None]
            values = [number for number in numbers if number is not None]
            if isinstance(question, Lasting) and len(values) == len(bounds):
                inside = _within(values, [text.split(" ")[1] for text in bounds])
                _lasts(x, question, replace(moment, extra=_with(moment, question, inside)))


def _within(bounds: Sequence[mpf], signs: Sequence[str]) -> mpf:
    if len(bounds) == 2:
        return sum(bounds) / 2
    if not bounds:
        return mpf(1)
    outwards = mpf(1) if signs[0][0] == ">" else mpf(-1)
    return bounds[0] + outwards * abs(bounds[0]) / 16


def _with(moment: Moment, question: Lasting | Reaching, value: mpf) -> Mapping[str, mpf]:
    return {**moment.extra, question.unknown.name: value}


def _lasts(x: Examination, question: Lasting, moment: Moment) -> None:
    condition = question.condition
    sign = 1 if condition.comparison[0] == ">" else -1
    for there in _flow(x, moment):
        full = _complete_moment(x, there)
        left, right = (
            real_part(evaluate(side, x.reference.setting, full))
            for side in (condition.left, condition.right)
        )
        if sign * (left - right) < -RUN_AGREEMENT * max(1, abs(left), abs(right)):
            x.wrong(f"find.{question.name}", f"{mp.nstr(left, 8)} against {mp.nstr(right, 8)}")
