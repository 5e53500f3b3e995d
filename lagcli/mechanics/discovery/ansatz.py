"""What is searched: which functions of t and of the coordinates multiply the generators.

Coordinates that are lengths enter to first degree, angles by sine and cosine (and by cosecant
and cotangent, as rotations about other axes have them), a radius also by its inverse.  A
coordinate is taken for an angle where it occurs in L only inside circular functions, or not at
all while its own inertia, or that with another coordinate, depends on a third one.  What has the
unit of a length is none; an angle of which only the constraints know takes part in both ways,
and so does what is cyclic with an inertia that no circle has (the half plane, x'^2/y^2).  Two
cyclic coordinates of one inertia are lengths.  Where the inertia depends on lengths that are no
radii, the space is curved, or the chart is: there the second degree is taken.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from math import isqrt

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import pivot_columns
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.search import SlotUnknown
from lagcli.mechanics.discovery.slots import Slot, SlotEquations
from lagcli.mechanics.discovery.spectrum import (
    Exponent,
    differences,
    exponents,
    forced_motion,
    sums,
)
from lagcli.mechanics.discovery.time_dependent import of_changing_coefficients

_CIRCULAR = (sympy.sin, sympy.cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc)
_MOST_FUNCTIONS = 60
_MOST_CURVED = 3
_FEW = 8  # functions of the coordinates that all powers of t multiply


@dataclass(slots=True)
class Kinds:
    """The coordinates by what they look like: lengths, angles, radii among the lengths."""

    lengths: list[Symbol] = field(default_factory=list)
    angles: list[Symbol] = field(default_factory=list)
    radii: list[Symbol] = field(default_factory=list)
    cyclic: list[Symbol] = field(default_factory=list)  # among the angles
    latitudes: list[Symbol] = field(default_factory=list)  # angles in the inertia of others
    alone: list[Symbol] = field(default_factory=list)  # cyclic, in no inertia with a latitude
    curved: bool = False
    exponentials: list[Expr] = field(default_factory=list)  # of lengths, in the inertia
    centre: Mapping[Symbol, Expr] = field(default_factory=dict)  # of rotations, where not at 0


def kinds(
    L: Expr,
    equations: SlotEquations,
    units: Sequence[str | None] = (),
    constraints: Sequence[Expr] = (),
) -> Kinds:
    """Tell lengths from angles."""
    found = Kinds()
    inertia = {x: sympy.Tuple(*row) for x, row in zip(equations.q, equations.mass, strict=True)}
    inside = {s for f in L.atoms(*_CIRCULAR) for s in f.free_symbols}
    turning = {s for e in constraints for f in e.atoms(*_CIRCULAR) for s in f.free_symbols}
    for x, unit in zip(equations.q, units or [None] * len(equations.q), strict=True):
        cyclic = free_of(L, [x])
        turned = any(
            m.free_symbols & (set(equations.q) - {x, y})
            for y, m in zip(equations.q, inertia[x], strict=True)
        ) or inertia[x][equations.q.index(x)].free_symbols & (set(equations.q) - {x})
        angle = bool(cyclic and turned) or (x in inside and not _outside(L, x))
        if cyclic and (unit == "m" or _has_twin(x, equations, L)):
            angle = False
        (found.angles if angle else found.lengths).append(x)
        if angle and cyclic:
            found.cyclic.append(x)
        elif cyclic and x in turning:
            found.angles.append(x)
        if (
            angle
            and cyclic
            and unit is None
            and _is_of_no_circle(inertia[x][equations.q.index(x)], equations.q)
        ):
            found.lengths.append(x)
    found.radii = [
        x for x in found.lengths
        if any(x in inertia[y].free_symbols for y in found.angles)
    ]  # fmt: skip
    in_inertia = {s for row in equations.mass for m in row for s in m.free_symbols}
    found.curved = set(found.angles) <= set(found.lengths) and not in_inertia.isdisjoint(
        found.lengths
    )
    found.exponentials = _exponentials(equations)
    found.latitudes = [x for x in found.angles if _in_determinant(x, equations)]
    found.alone = [
        x for x in found.cyclic if inertia[x].free_symbols.isdisjoint(found.latitudes)
    ]  # fmt: skip
    return found


def _has_twin(x: Symbol, equations: SlotEquations, L: Expr) -> bool:
    """Whether another cyclic coordinate has its inertia, as x and y in z^2 (x'^2 + 4 y'^2).

    The two turn into each other, so they are lengths of a plane and no angles.
    """
    i = equations.q.index(x)
    own = equations.mass[i]
    return any(
        own[k] == 0 and free_of(L, [y]) and free_of(sympy.cancel(equations.mass[k][k] / own[i]), q)
        for q in [equations.q]
        for k, y in enumerate(q)
        if k != i
    )


def _is_of_no_circle(inertia: Expr, q: Sequence[Symbol]) -> bool:
    """Whether it is no square of a radius: where a circle shrinks to a point it falls as r^2."""
    above, below = sympy.fraction(sympy.together(inertia))
    if not free_of(below, q) or any(not free_of(e, q) for e in inertia.atoms(sympy.exp)):
        return True
    inside = [x for x in q if x in above.free_symbols]
    if not above.is_polynomial(*inside):
        return False
    return all(sympy.degree(above, x) != 2 for x in inside)


def _exponentials(equations: SlotEquations) -> list[Expr]:
    """Of the inertia: exp(x), its root and their inverses, as isometries have them."""
    atoms = {e for row in equations.mass for m in row for e in m.atoms(sympy.exp)}
    inside = [e.args[0] for e in sorted(atoms, key=sympy.default_sort_key)
              if not free_of(e, equations.q) and free_of(e, [equations.t])]  # fmt: skip
    powers = [sympy.Rational(k, 2) for k in (-2, -1, 1, 2)]
    return list(dict.fromkeys(sympy.exp(k * x) for x in inside for k in powers))


def _in_determinant(x: Symbol, equations: SlotEquations) -> bool:
    """Whether det M changes with the angle: there its chart has poles, as at theta = 0."""
    if not any(x in m.free_symbols for row in equations.mass for m in row):
        return False
    entries = Evaluator([m for row in equations.mass for m in row], 20)
    symbols = {s for row in equations.mass for m in row for s in m.free_symbols}
    source = random.Random("lagcli determinant")
    point = {s: mpf(source.randint(3000, 13000)) / 10007 for s in symbols}
    with mpmath.workdps(20):
        values = []
        for at in (mpf(2) / 7, mpf(11) / 9):
            try:
                values.append(mpmath.det(_square(entries({**point, x: at}))))
            except (ArithmeticError, ValueError):
                return True
        return bool(abs(values[0] - values[1]) > mpf(10) ** -12 * (1 + abs(values[0])))


def _square(entries: Sequence[mpf]) -> mpmath.matrix:
    n = isqrt(len(entries))
    return mpmath.matrix([list(entries[k * n : (k + 1) * n]) for k in range(n)])


def _outside(L: Expr, x: Symbol) -> bool:
    """Whether x occurs anywhere but inside circular functions."""
    marks = {f: sympy.Dummy() for f in L.atoms(*_CIRCULAR) if x in f.free_symbols}
    return x in L.xreplace(marks).free_symbols


@dataclass(frozen=True, slots=True)
class TimeFunctions:
    """Functions of time for generators that are constant in q, and for the others."""

    translations: tuple[Expr, ...]
    others: tuple[Expr, ...]
    exponents: tuple[Exponent, ...]
    forced: tuple[Expr, ...] = ()
    changing: bool = False  # with the solutions of a linear equation whose coefficients change
    pushed: bool = False  # by forces without q and q', which translations alone take up


def time_functions(
    equations: SlotEquations, accelerations: Sequence[Expr] | None, *, potential: bool
) -> TimeFunctions:
    """1, t, t^2 (t^3 for translations) and the functions that the linear part suggests."""
    t = equations.t
    if accelerations is None:
        polynomial = (sympy.S.One, t, t**2)
        return TimeFunctions(polynomial, polynomial, ())
    found = exponents(accelerations, equations.q, equations.v, t)
    between = differences(found)
    own = list(found)
    if not potential:
        # integrating factors solve the adjoint equation, whose exponents are the negatives
        own = [Exponent(-e.growth, e.frequency, e.repeated) for e in found]
        between = [*sums(own), *differences(own)]
    powers = [sympy.S.One, t, t**2]
    others = [*powers, *_functions(between, t)]
    translations = [*powers, t**3, *_functions(own, t), *_functions(between, t)]
    forced = forced_motion(accelerations, equations.q, equations.v, t)
    translations += [f * T for f in forced for T in (others if f != t else others[3:])]
    changing, stretched = of_changing_coefficients(accelerations, equations.q, equations.v, t)
    if changing:
        translations = _independent([*translations, *changing], t)
        others = _independent([*others, *stretched], t)
    return TimeFunctions(
        tuple(dict.fromkeys(translations)),
        tuple(dict.fromkeys(others)),
        tuple(found),
        tuple(f for f in forced if f != t),
        bool(changing),
        bool(forced),
    )


def _independent(functions: Sequence[Expr], t: Symbol) -> list[Expr]:
    """The first of them that span all, over the constants: t/(t + 1) is 1 - 1/(t + 1)."""
    each = list(dict.fromkeys(functions))
    rows = Relation([[f] for f in each], [t], Allowance()).rows(len(each) + 4)
    return [each[k] for k in pivot_columns(rows)]


def _functions(found: Iterable[Exponent], t: Symbol) -> list[Expr]:
    return [f for each in found for f in each.functions(t)]


def affine(found: Kinds) -> list[Expr]:
    """Functions of the coordinates for point transformations, the simplest first."""
    one = sympy.S.One
    by_angle = [_angle(x, found) for x in found.angles]
    if found.latitudes and _size(by_angle) > _MOST_FUNCTIONS:
        by_angle = [_angle(x, found) for x in found.angles if x not in found.alone]
    if _size(by_angle) > _MOST_FUNCTIONS:
        by_angle = [[one, sympy.sin(x), sympy.cos(x)] for x in found.angles]
    if _size(by_angle) > _MOST_FUNCTIONS:
        by_angle = []
    x = [y - found.centre.get(y, 0) for y in found.lengths]
    lengths = [one, *x, *(1 / r for r in found.radii), *found.exponentials]
    if found.curved and len(x) <= _MOST_CURVED:
        lengths += [a * b for i, a in enumerate(x) for b in x[: i + 1]]
    if _size([lengths, *by_angle]) > _MOST_FUNCTIONS:
        lengths = [one, *(x for x in found.lengths if x in found.radii)]
    if _size([lengths, *by_angle]) > _MOST_FUNCTIONS:
        lengths = [one]
    return _products([lengths, *by_angle])


def quadratic(found: Kinds, most: int) -> list[Expr]:
    """At most so many functions for Killing tensors: second degree in lengths, sin and cos."""
    one = sympy.S.One
    x = [y - found.centre.get(y, 0) for y in found.lengths]
    squares = [a * b for i, a in enumerate(x) for b in x[: i + 1]]
    inverse = [1 / r for r in found.radii]
    lengths = [
        [one, *x, *squares, *inverse, *(r**-2 for r in found.radii)],
        [one, *x, *inverse],
        [one, *inverse],
    ]
    angles = [
        [[*_angle(y, found), *_second(y, found)] for y in found.angles],
        [[*_angle(y, found), *_second(y, found)[2:]] for y in found.angles],
        [[one, sympy.sin(y), sympy.cos(y)] for y in found.angles],
    ]
    for plain, by_angle in ((0, 0), (1, 0), (1, 1), (2, 1), (2, 2)):
        groups = [lengths[plain], *angles[by_angle]]
        if _size(groups) <= most:
            return _products(groups)
    return []


def _angle(x: Symbol, found: Kinds) -> list[Expr]:
    s, c = sympy.sin(x), sympy.cos(x)
    return [sympy.S.One, s, c, *([c / s, 1 / s] if x in found.latitudes else [])]


def _second(x: Symbol, found: Kinds) -> list[Expr]:
    s, c = sympy.sin(x), sympy.cos(x)
    if len(found.angles) == 1 and x not in found.cyclic:
        # parabolic coordinates of a plane: r (1 + cos phi) and r (1 - cos phi)
        return [s * c, s**2, sympy.sin(x / 2), sympy.cos(x / 2)]
    return [s * c, s**2, *([c / s**2, s**-2] if x in found.latitudes else [])]


def _size(groups: Sequence[Sequence[Expr]]) -> int:
    size = 1
    for group in groups:
        size *= len(group)
    return size


def _products(groups: Sequence[Sequence[Expr]]) -> list[Expr]:
    made = [sympy.Mul(*parts) for parts in product(*groups)]
    return sorted(dict.fromkeys(made), key=_complexity)


def _complexity(function: Expr) -> tuple[int, str]:
    return sympy.count_ops(function) + len(function.free_symbols), str(function)


def point_unknowns(
    slots: Sequence[Slot],
    times: TimeFunctions,
    spaces: Sequence[Expr],
    *,
    time_with_space: bool,
) -> list[SlotUnknown]:
    """T(t) g(q) for tau and every xi, those that may be eliminated first in front.

    Where L is quadratic in the velocities tau does not depend on q: the terms of third
    degree of the condition are T dtau/dq . q'.
    """
    unknowns: list[SlotUnknown] = []
    for k, slot in enumerate(slots):
        alone = slot.kind[0] == "tau" and not time_with_space
        for g in [sympy.S.One] if alone else spaces:
            unknowns += [
                SlotUnknown(k, T, g) for T in _times(times, slot, g, all_powers=len(spaces) <= _FEW)
            ]
    return ordered(unknowns)


def _times(times: TimeFunctions, slot: Slot, g: Expr, *, all_powers: bool) -> list[Expr]:
    """t^2 only where it can be or where it costs little.

    dxi/dq + (dxi/dq)^T is of the degree of dtau/dt; beyond it are rotations of frames.
    """
    if slot.kind[0] == "xi" and g == 1:
        return list(times.translations)
    if slot.kind[0] == "tau" or all_powers:
        return list(times.others)
    return [T for T in times.others if not (T.is_Pow and T.exp == 2)]


def quadratic_unknowns(
    pairs: Sequence[int],
    linear: Sequence[int],
    spaces: Sequence[Expr],
    times: Sequence[Expr] = (sympy.S.One,),
) -> list[SlotUnknown]:
    """T(t) g(q) for the components of a Killing tensor and of the linear part."""
    return ordered([SlotUnknown(k, T, g) for k in (*pairs, *linear) for g in spaces for T in times])


def ordered(unknowns: list[SlotUnknown]) -> list[SlotUnknown]:
    """Those that may be eliminated first, the most complicated, in front."""

    def cost(unknown: SlotUnknown) -> tuple[int, int, str, int]:
        T, g = unknown.time, unknown.space
        return (2 * sympy.count_ops(T) + len(T.free_symbols), *_complexity(g), unknown.slot)

    return sorted(unknowns, key=cost, reverse=True)
