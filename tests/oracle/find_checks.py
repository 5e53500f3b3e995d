"""Answers to `find`: put back into states on the constraints with the initial charges."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from random import Random

from mpmath import mp, mpf

from lagcli.problem import Rewrite, Where

from .evaluate import Moment, OutsideDomain, evaluate
from .examine import Examination, agree, with_momenta
from .jets import Number, real_part
from .linear import least_step
from .reference import Scalar, gradient
from .states import ON_SURFACE, reals, with_motion

STARTS = 12


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
        else:
            _rewrite(x, question, answer.get("value"))


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
    start = _settle(start, positions, [(0, set(range(reference.size)) - fixed[0])])
    return _settle(start, forms, [(1, set(range(reference.size)) - fixed[1])])


def _settle(
    moment: Moment, functions: Sequence[Scalar], free: Sequence[tuple[int, set[int]]]
) -> Moment:
    """Newton's shortest steps in the free components until the functions vanish."""
    for _ in range(80):
        residual = reals([f(moment) for f in functions])
        if all(abs(r) < ON_SURFACE for r in residual):
            return moment
        columns = [(level, i) for level, indices in free for i in sorted(indices)]
        rows = []
        for f in functions:
            slopes = {level: reals(gradient(f, moment, level)) for level, _ in free}
            rows.append([slopes[level][i] for level, i in columns])
        step = least_step(rows, residual, len(columns))
        longest = max(map(abs, step), default=mpf(0))
        if longest > 1:
            step = [d / longest for d in step]
        for (level, i), d in zip(columns, step, strict=True):
            moment = moment.shifted(level, {i: d})
    raise OutsideDomain("Newton's method found no such state")


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
            found.append(_settle(there, functions, [(0, everything), (1, everything)]))
        except (OutsideDomain, ZeroDivisionError):
            continue
        if len(found) == 4:
            break
    return found


def _minus(f: Scalar, value: mpf) -> Scalar:
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
    for state in x.states[:2]:
        for moment in _reached(x, state.moment):
            full = _complete_moment(x, moment)
            answered = x.number(where, node, full)
            true = real_part(evaluate(question.value, x.reference.setting, full))
            if answered is not None and not agree(answered, true):
                x.wrong(where, f"{value} is {mp.nstr(answered, 8)}, true is {mp.nstr(true, 8)}")


def _where(x: Examination, question: Where, solutions: Sequence[str] | None) -> None:
    where = f"find.{question.name}"
    if solutions is None:
        x.missing(where)
        return
    unknown = question.unknown
    moment = x.states[0].moment
    for text in solutions:
        node = x.read(where, text)
        value = None if node is None else x.number(where, node, moment)
        if value is None:
            continue
        if unknown.name in x.reference.names:
            pinned = _minus(x.reference.of(unknown), value)
            candidates = _reached(x, moment, [pinned])
        else:
            changed = replace(moment, extra={**moment.extra, unknown.name: value})
            candidates = [_initial(x, changed)]
        gaps = [_gap(x, question, _complete_moment(x, m)) for m in candidates]
        if not any(agree(gap, mpf(0)) for gap in gaps):
            shown = [mp.nstr(gap, 8) for gap in gaps]
            x.wrong(where, f"{text}: left - right is {shown or 'nowhere reached'}")


def _gap(x: Examination, question: Where, moment: Moment) -> mpf:
    left: Callable[[Moment], Number] = x.reference.of(question.equation.left)
    return real_part(left(moment) - x.reference.of(question.equation.right)(moment))
