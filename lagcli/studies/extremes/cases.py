"""The extremes of one problem, each a problem of its own."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from lagcli.expression import ZERO, Expression, Name, Number, Sum, multiple_of, signed, sum_of
from lagcli.formatters.grammar import to_grammar
from lagcli.numerics.equations.refusal import Refusal
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.studies.extremes.case import Case
from lagcli.studies.extremes.roles import (
    Angle,
    alike,
    angles_of,
    light_speeds,
    singular_positions,
    unstable_rest,
    used,
)
from lagcli.studies.extremes.scene import ExtremeScene, Vector, number

_BESIDE = Fraction(1, 10**9)
_CLOSE = Fraction(1, 10**12)
_LONG = 100.0
_PI = Name("pi")

#: Targets of an angle: as halves of pi, and from which side.
_TARGETS = ((0, 1), (1, -1), (2, -1))


def cases_of(scene: ExtremeScene) -> list[Case]:
    """All of them, in the order of `KINDS`, no state twice."""
    found = [
        Case(kind="given", name="as given", problem=_with_state(scene)),
        *_ratios(scene),
        *_singular(scene),
        *_angles(scene),
        *_separatrix(scene),
        *_light(scene),
        *_zero(scene),
        Case(kind="spans", name=f"{_LONG:g} times as long", problem=_with_state(scene),
             stretch=_LONG),
    ]  # fmt: skip
    known: dict[object, Case] = {}
    for case in found:
        state = tuple(sorted((str(name), str(x)) for name, x in case.problem.initial.items()))
        values = tuple(sorted((name, str(x)) for name, x in case.parameters.items()))
        known.setdefault((state, values, case.stretch), case)
    return list(known.values())


def _with_state(scene: ExtremeScene) -> Problem:
    """The problem with its whole state given, as the file has it where it does."""
    if scene.problem.initial:
        return scene.problem
    return replace(scene.problem, initial=scene.at(scene.q, scene.v))


# -- parameters ----------------------------------------------------------------------------------


def _ratios(scene: ExtremeScene) -> Iterator[Case]:
    for group in alike(scene):
        first, *others = group
        for name in others:
            for power in (12, -12):
                value = Fraction(scene.value(name)) * Fraction(10) ** power
                yield from _valued(
                    scene, "ratios", f"{first}/{name} = 1e{power}", {first: number(value)}
                )
        if not others:
            for power in (12, -12):
                value = Fraction(scene.value(first)) * Fraction(10) ** power
                yield from _valued(
                    scene, "ratios", f"{first} times 1e{power}", {first: number(value)}
                )


def _zero(scene: ExtremeScene) -> Iterator[Case]:
    for name in used(scene):
        yield from _valued(scene, "zero", f"{name} = 0", {name: number(0)})


def _valued(
    scene: ExtremeScene, kind: str, name: str, values: Mapping[str, Expression]
) -> Iterator[Case]:
    """The problem with other values, its state on its constraints; a 0 is always allowed."""
    parameters = tuple(
        replace(p, value=values[p.name], assume="real" if values[p.name] == ZERO else p.assume)
        if p.name in values
        else p
        for p in scene.problem.parameters
    )
    problem = replace(scene.problem, parameters=parameters)
    if not problem.initial:
        try:
            moved = ExtremeScene(problem, (scene.q, scene.v))
            problem = replace(problem, initial=moved.at(moved.q, moved.v))
        except Refusal:  # the trial finds the same, and says why
            problem = replace(problem, initial=scene.at(scene.q, scene.v))
    yield Case(kind=kind, name=name, problem=problem, parameters=values)


# -- states --------------------------------------------------------------------------------------


def _stated(
    scene: ExtremeScene,
    kind: str,
    name: str,
    q: Sequence[float],
    v: Sequence[float],
    exact: Mapping[Name, Expression],
) -> Iterator[Case]:
    """The state with some coordinates as they are given, the others on the constraints."""
    names = [c.name for c in scene.problem.coordinates]
    fixed = {names.index(one.name) for one in exact}
    found = scene.settled(q, v, fixed)
    if found is not None:
        initial = scene.at(*found, exact)
        problem = replace(scene.problem, initial=initial)
        shown = {one: initial[one] for one in exact}
        yield Case(kind=kind, name=name, problem=problem, initial=shown)


def _angles(scene: ExtremeScene) -> Iterator[Case]:
    names = [c.name for c in scene.problem.coordinates]
    for angle in angles_of(scene):
        for halves, side in _TARGETS:
            yield from _at_angle(scene, names, angle, halves, side)


def _at_angle(
    scene: ExtremeScene, names: Sequence[str], angle: Angle, halves: int, side: int
) -> Iterator[Case]:
    """One term of the argument moved so that its sum is beside a multiple of pi/2."""
    moved = next(((n, k) for n, k in angle.factors if n in names), angle.factors[0])
    name, factor = moved
    rest = [(n, k) for n, k in angle.factors if n != name]
    target = _beside(halves, side)
    words = f"{_combined(angle)} = {to_grammar(target)}"
    if not rest and factor == 1 and not angle.constant:
        exact, value = target, math.pi / 2 * halves + side * float(_BESIDE)
    else:
        others = sum(float(k) * _value(scene, names, n) for n, k in rest) + float(angle.constant)
        value = (math.pi / 2 * halves + side * float(_BESIDE) - others) / float(factor)
        exact = number(value)
    if name in names:
        q = list(scene.q)
        q[names.index(name)] = value
        yield from _stated(scene, "angles", words, q, scene.v, {Name(name): exact})
    else:
        yield from _valued(scene, "angles", words, {name: exact})


def _value(scene: ExtremeScene, names: Sequence[str], name: str) -> float:
    return scene.q[names.index(name)] if name in names else scene.value(name)


def _beside(halves: int, side: int) -> Expression:
    """k pi/2 + 1e-9."""
    whole = [multiple_of(Fraction(halves, 2), [_PI], [])] if halves else []
    return sum_of([*whole, signed(side * _BESIDE, decimal=True)])


def _combined(angle: Angle) -> str:
    terms = [multiple_of(k, [Name(name)], []) for name, k in angle.factors]
    return to_grammar(sum_of([*terms, *([signed(angle.constant)] if angle.constant else [])]))


def _singular(scene: ExtremeScene) -> Iterator[Case]:
    names = [c.name for c in scene.problem.coordinates]
    for root in singular_positions(scene):
        name = names[root.coordinate]
        place = number(root.value) if root.twelfths is None else _twelfths(root.twelfths)
        for beside in (Fraction(0), _BESIDE):
            q = list(scene.q)
            q[root.coordinate] = root.value + float(beside)
            exact = place
            if beside:
                small = Number(beside, decimal=True)
                exact = small if root.twelfths == 0 else Sum((place, small))
            shown = f"{root.value:.10g}" if root.twelfths is None else to_grammar(place)
            words = "1e-9" if beside and shown == "0" else shown + " + 1e-9" * bool(beside)
            yield from _stated(
                scene, "singular", f"{name} = {words}", q, scene.v, {Name(name): exact}
            )


def _twelfths(k: int) -> Expression:
    return multiple_of(Fraction(k, 12), [_PI], []) if k else ZERO


def _separatrix(scene: ExtremeScene) -> Iterator[Case]:
    """At rest 1e-9 near an unstable equilibrium, and with its energy but for 1e-12."""
    names = [c.name for c in scene.problem.coordinates]
    e = scene.equations
    energy = scene.motion.function([e.energy])
    zero = [0.0] * scene.n
    for rest, direction, _ in unstable_rest(scene):
        where = ", ".join(f"{n} = {_place(x)}" for n, x in zip(names, rest, strict=True))
        most = max(range(scene.n), key=lambda j: abs(direction[j]))
        q = [x + float(_BESIDE) * d / abs(direction[most])
             for x, d in zip(rest, direction, strict=True)]  # fmt: skip
        yield from _stated(scene, "separatrix", f"at rest 1e-9 away from {where}", q, zero, {})
        top = float(energy(0.0, *rest, *zero)[0])
        for side in (-1, 1):
            v = _velocity(scene, top, side)
            if v is not None:
                words = f"E = E({where}) {'-+'[side > 0]} 1e-12"
                yield from _stated(scene, "separatrix", words, scene.q, v, {})


def _velocity(scene: ExtremeScene, top: float, side: int) -> Vector | None:
    """The velocity at the usual place with the energy wanted, in the direction of the file's."""
    energy = scene.motion.function([scene.equations.energy])
    zero = [0.0] * scene.n
    below = float(energy(0.0, *scene.q, *zero)[0])
    barrier = top - below
    direction = scene.v if any(scene.v) else [1.0] + [0.0] * (scene.n - 1)
    if not barrier > 0:
        return None
    kinetic = float(energy(0.0, *scene.q, *direction)[0]) - below
    if not kinetic > 0:
        return None
    factor = math.sqrt(barrier * (1 + side * float(_CLOSE)) / kinetic)
    v = [factor * x for x in direction]
    found = float(energy(0.0, *scene.q, *v)[0]) - below
    return v if abs(found - barrier) < 1e-6 * barrier else None


def _place(x: float) -> str:
    twelfths = round(x * 12 / math.pi)
    near = abs(x - twelfths * math.pi / 12) < 1e-9
    return to_grammar(_twelfths(twelfths)) if near else f"{x:.6g}"


def _light(scene: ExtremeScene) -> Iterator[Case]:
    """v = c, v = c (1 - 1e-12) and v = 1e-9 c."""
    names = [c.name for c in scene.problem.coordinates]
    for direction, factor in light_speeds(scene):
        moving = [j for j, x in enumerate(direction) if x]
        words = " and ".join(f"{names[j]}'" for j in moving)
        for share, text in (
            (1 - _CLOSE, "(1 - 1e-12) times"),
            (_BESIDE, "1e-9 times"),
            (Fraction(1), "at"),
        ):
            v = [float(Fraction(factor * x) * share) for x in direction]
            exact = {Name(names[j], 1): number(v[j]) for j in moving}
            yield from _stated(scene, "light", f"{words} {text} the limit", scene.q, v, exact)
