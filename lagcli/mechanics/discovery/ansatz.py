"""What is searched: which functions of t and of the coordinates multiply the generators.

Coordinates that are lengths enter to first degree, angles by sine and cosine (and by cosecant
and cotangent, as rotations about other axes have them), a radius also by its inverse (`kinds`).
Where the inertia depends on lengths that are no radii, the space is curved, or the chart is:
there the second degree is taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement, product

import sympy
from sympy import Expr, Symbol

from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.search import SlotUnknown
from lagcli.mechanics.discovery.slots import Slot, SlotEquations
from lagcli.mechanics.discovery.spectrum import (
    Exponent,
    differences,
    exponents,
    forced_motion,
    has_unsolved_exponents,
    sums,
)
from lagcli.mechanics.discovery.time_dependent import adjoint, of_changing_coefficients
from lagcli.statements.wording import enumerated

_MOST_FUNCTIONS = 60  # measured: at most 54
_MOST_CURVED = 4
_FEW = 8  # functions of the coordinates that all powers of t multiply


@dataclass(frozen=True, slots=True)
class TimeFunctions:
    """Functions of time for generators that are constant in q, and for the others."""

    translations: tuple[Expr, ...]
    others: tuple[Expr, ...]
    exponents: tuple[Exponent, ...]
    forced: tuple[Expr, ...] = ()
    changing: bool = False  # with the solutions of a linear equation whose coefficients change
    lacking: bool = False  # no closed form was found of exponents of linear equations
    unsolved: bool = False  # no formula is known for solutions of such an equation

    @property
    def suggested(self) -> bool:
        """Whether the equations of motion suggest some beyond powers of t."""
        return bool(self.exponents or self.changing or self.forced)

    @property
    def words(self) -> str:
        """What they are, behind the functions of the coordinates."""
        highest = "third" if any(T.is_Pow and T.exp == 3 for T in self.others) else "second"
        words = f", polynomial in t to {highest} degree"
        if self.exponents:
            words += " and with the exponents of the linear part"
        if self.changing:
            words += " and with the solutions of the linear part of the equations of motion"
        return words + (" and with the functions of time of the driving" if self.forced else "")


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
    linear = accelerations, equations.q, equations.v, t
    changing, stretched, moved_along, solved = of_changing_coefficients(*linear)
    if not potential:
        changing += of_changing_coefficients(adjoint(*linear), *linear[1:])[0]
    forced += [f for f in moved_along if f not in forced]
    if changing or forced:  # sin(2 t) is 2 sin(t) cos(t) for a force at resonance
        others = _independent([*others, *stretched], t)
        moved = [f * T for f in forced for T in (others if f != t else others[3:])]
        moved += others if forced else []
        translations = _independent([*translations, *moved, *changing], t)
    return TimeFunctions(
        tuple(dict.fromkeys(translations)),
        tuple(dict.fromkeys(others)),
        tuple(found),
        tuple(f for f in forced if f != t),
        bool(changing),
        has_unsolved_exponents(accelerations, equations.q, equations.v, t),
        not solved,
    )


def _independent(functions: Sequence[Expr], t: Symbol) -> list[Expr]:
    """The first of them that span all, over the constants: t/(t + 1) is 1 - 1/(t + 1)."""
    each = list(dict.fromkeys(functions))
    return [each[k] for k in Relation([[f] for f in each], [t], Allowance()).independent()]


def _functions(found: Iterable[Exponent], t: Symbol) -> list[Expr]:
    return [f for each in found for f in each.functions(t)]


def affine(found: Kinds) -> list[Expr]:
    """Functions of the coordinates for point transformations, the simplest first."""
    lengths, turned, by_angle = _of_each(found)
    if _size([[*lengths, *turned], *by_angle.values()]) <= _MOST_FUNCTIONS:
        lengths += turned
    if _size([lengths, *by_angle.values()]) <= _MOST_FUNCTIONS:
        return _products([lengths, *by_angle.values()])
    # too many: of each part of the coordinates, and the simpler ones of all
    parts = found.parts if len(found.parts) > 1 else ()
    own = [f for part in parts for f in affine(found.of(part))]
    return sorted(dict.fromkeys([*own, *_fewer(lengths, by_angle, found)]), key=complexity)


def has_all_products(found: Kinds) -> bool:
    """Whether `affine` has all products of functions of several coordinates."""
    lengths, _, by_angle = _of_each(found)
    return _size([lengths, *by_angle.values()]) <= _MOST_FUNCTIONS


def _of_each(found: Kinds) -> tuple[list[Expr], list[Expr], dict[Symbol, list[Expr]]]:
    """Functions of lengths, of these and a radius, and of each angle."""
    one = sympy.S.One
    x = [y - found.centre.get(y, 0) for y in found.lengths]
    turned = [y / r for r in found.radii for y in x if y != r]  # r to z, in cylindrical coordinates
    lengths = [one, *x, *(1 / r for r in found.radii), *found.exponentials]
    if found.powers:
        lengths += [x[0] ** k for k in (-2, -1, 2, 3)]
    elif found.curved and len(x) <= _MOST_CURVED:
        lengths += [a * b for i, a in enumerate(x) for b in x[: i + 1]]
    return lengths, turned, {y: _angle(y, found) for y in found.angles}


def _fewer(lengths: list[Expr], by_angle: dict[Symbol, list[Expr]], found: Kinds) -> list[Expr]:
    """Products without cosecants, without angles that are lengths too, or without lengths."""
    one = sympy.S.One

    def too_many(*groups: Sequence[Expr]) -> bool:
        return _size([*groups, *by_angle.values()]) > _MOST_FUNCTIONS

    if found.latitudes and too_many():
        by_angle = {y: f for y, f in by_angle.items() if y not in found.alone}
    if too_many() or (too_many(lengths) and not found.radii):
        by_angle = {y: [one, sympy.sin(y), sympy.cos(y)] for y in found.angles}
    if too_many():
        by_angle = {}
    if too_many(lengths):
        plain = {y for y in by_angle if y not in found.lengths or y in found.waves}
        by_angle = {y: f for y, f in by_angle.items() if y in plain}
    if too_many(lengths):
        lengths = [one, *(y for y in found.lengths if y in found.radii)]
    if too_many(lengths):
        lengths = [one]
    return _products([lengths, *by_angle.values()])


def quadratic(found: Kinds, most: int) -> list[Expr]:
    """A bounded number of functions for Killing tensors: second degree in lengths, sin and cos."""
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


def products_of_two(X: Sequence[Expr]) -> list[Expr]:
    """Of equal ones too."""
    return [x * y for x, y in combinations_with_replacement(X, 2)]


def up_to_second_degree(X: Sequence[Expr], most: int) -> list[Expr]:
    """Monomials in Cartesian coordinates, a bounded number of them."""
    one = sympy.S.One
    choices = [one, *X, *products_of_two(X)], [one, *X], [one]
    return next((made for made in choices if len(made) <= most), [])


def _angle(x: Symbol, found: Kinds) -> list[Expr]:
    if x in found.waves:
        return [sympy.S.One, *found.waves[x]]
    s, c = sympy.sin(x), sympy.cos(x)
    pole = found.latitudes.get(x)
    return [sympy.S.One, s, c, *([pole.diff(x) / pole, 1 / pole] if pole is not None else [])]


def _second(x: Symbol, found: Kinds) -> list[Expr]:
    if x in found.waves:
        return []
    s, c = sympy.sin(x), sympy.cos(x)
    if len(found.angles) == 1 and x not in found.cyclic:
        # parabolic coordinates of a plane: r (1 + cos phi) and r (1 - cos phi)
        return [s * c, s**2, sympy.sin(x / 2), sympy.cos(x / 2)]
    pole = found.latitudes.get(x)
    return [s * c, s**2, *([pole.diff(x) / pole**2, pole**-2] if pole is not None else [])]


def _size(groups: Sequence[Sequence[Expr]]) -> int:
    size = 1
    for group in groups:
        size *= len(group)
    return size


def _products(groups: Sequence[Sequence[Expr]]) -> list[Expr]:
    made = [sympy.Mul(*parts) for parts in product(*groups)]
    return sorted(dict.fromkeys(made), key=complexity)


def complexity(function: Expr) -> tuple[int, str]:
    """What is tried first: few operations of few symbols."""
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
    slots: Sequence[int], spaces: Sequence[Expr], times: Sequence[Expr] = (sympy.S.One,)
) -> list[SlotUnknown]:
    """T(t) g(q) for the components of a Killing tensor and of the linear part."""
    return ordered([SlotUnknown(k, T, g) for k in slots for g in spaces for T in times])


def ordered(unknowns: list[SlotUnknown]) -> list[SlotUnknown]:
    """Those that may be eliminated first, the most complicated, in front."""

    def cost(unknown: SlotUnknown) -> tuple[int, int, str, int]:
        T, g = unknown.time, unknown.space
        return (2 * sympy.count_ops(T) + len(T.free_symbols), *complexity(g), unknown.slot)

    return sorted(unknowns, key=cost, reverse=True)


def in_words(spaces: Sequence[Expr], kinds: Kinds) -> str:
    """What transformations with these functions of the coordinates are."""
    shapes = []
    if not kinds.angles or any(s.free_symbols & {*kinds.lengths} for s in spaces):
        second = any(x**2 in spaces for x in kinds.lengths)
        degree = f"{'of second degree' if second else 'affine'} in the coordinates"
        shapes.append("with powers −2 to 3 of the coordinate" if kinds.powers else degree)
        if kinds.exponentials:
            shapes.append("and in exponentials of them")
    turning = {x for s in spaces for f in s.atoms(sympy.sin, sympy.cos) for x in f.free_symbols}
    if angles := [x.name for x in kinds.angles if x in turning]:
        shapes.append(f"with sines and cosines of {enumerated(angles)}")
    return " ".join(shapes) or "constant in the coordinates"
