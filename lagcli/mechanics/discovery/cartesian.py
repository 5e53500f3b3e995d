"""Cartesian coordinates of one particle, those of the file or made of r and its angles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.slots import SlotEquations

Functions = tuple[tuple[str, Expr], ...]
_PLANES = ("xy", "yz", "zx")  # across the axis of a cylinder, right-handed


@dataclass(frozen=True, slots=True)
class Cartesian:
    """Functions X of coordinates q, with their names: T is m (dX/dt)^2/2 plus that of others."""

    q: tuple[Symbol, ...]
    names: tuple[str, ...]
    X: tuple[Expr, ...]
    mass: Expr

    @property
    def radius(self) -> Expr:
        """The distance from the origin."""
        length: Expr = simplify(sympy.sqrt(sympy.Add(*(x**2 for x in self.X))))
        return length.replace(sympy.Abs, lambda r: r)

    def moved(self, q: Sequence[Symbol], changes: Sequence[Expr]) -> list[Expr]:
        """The components of a displacement, or of a velocity, that the coordinates have."""
        return [simplify(dot([x.diff(c) for c in q], changes)) for x in self.X]


def cartesian(kinds: Kinds, equations: SlotEquations) -> Cartesian | None:
    """Lengths about their centre; r and phi, with z; r, theta and phi; None for anything else.

    Beside r and its angles there may be coordinates of another inertia, as of a centre of mass.
    """
    curved = _of_radius(kinds, equations)
    others = {x: (x.name, x - kinds.centre.get(x, 0)) for x in equations.q if x not in curved[0]}
    whole = tuple(others), tuple(others.values())
    choices = [(whole[0] + curved[0], curved[1] + whole[1]), *([curved] if curved[0] else [])]
    made = (_of_one_mass(q, functions, equations) for q, functions in choices)
    return next((each for each in made if each is not None), None)


def about_an_axis(
    X: Sequence[Expr], inertia: Sequence[Expr], q: Sequence[Symbol]
) -> Cartesian | None:
    """x and y with the cosine and the sine of one coordinate, z without it; else None.

    They are X_a sqrt(m_a) to a common factor, of which the squares of parameters are taken out: in
    prolate coordinates m a^2 is the inertia of x/a.
    """
    for phi in q if len(X) == 3 else ():
        alike = [[k for k, f in enumerate(X) if f.has(g(phi))] for g in (sympy.cos, sympy.sin)]
        rest = [k for k, f in enumerate(X) if free_of(f, [phi])]
        places = [*alike[0], *alike[1], *rest]
        if sorted(places) != [0, 1, 2] or not len(alike[0]) == len(alike[1]) == 1:
            continue
        m = inertia[places[0]]
        powers = (f.as_base_exp() for f in sympy.Mul.make_args(m))
        squares = sympy.Mul(*(b ** (e // 2) for b, e in powers if e.is_Integer))
        scales = [squares * sympy.sqrt(simplify(inertia[k] / m)) for k in places]
        functions = [scale * X[k] for scale, k in zip(scales, places, strict=True)]
        first = next((x for x in q if x in functions[2].free_symbols), q[0])
        if functions[2].diff(first).could_extract_minus_sign():
            functions[2] *= -1  # z = (xi - eta)/2
        real = not any(scale.has(sympy.I) for scale in scales)  # z is no time
        if real and all(scale.is_rational_function(*scale.free_symbols) for scale in scales):
            return Cartesian(tuple(q), ("x", "y", "z"), tuple(functions), m / squares**2)
    return None


def _of_radius(kinds: Kinds, equations: SlotEquations) -> tuple[tuple[Symbol, ...], Functions]:
    """r and its angles, with x, y and z of them; nothing where there is no r, or more than one.

    Names of other coordinates are not taken again: about x they are y and z.
    """
    if len(kinds.radii) != 1:
        return (), ()
    taken = {x.name for x in equations.q if x not in (*kinds.radii, *kinds.angles)}
    [r] = kinds.radii
    if len(kinds.angles) == 1:
        [phi] = kinds.angles
        plane = next((axes for axes in _PLANES if taken.isdisjoint(axes)), "")
        circle = r * sympy.cos(phi), r * sympy.sin(phi)
        return ((r, phi), tuple(zip(plane, circle, strict=True))) if plane else ((), ())
    if taken.isdisjoint("xyz") and len(kinds.latitudes) == 1 and len(kinds.angles) == 2:
        [(theta, pole)] = kinds.latitudes.items()
        [phi] = [y for y in kinds.angles if y != theta]
        axis = (sympy.sin if pole.func is sympy.cos else sympy.cos)(theta)
        x, y = r * pole * sympy.cos(phi), r * pole * sympy.sin(phi)
        return (r, theta, phi), (("x", x), ("y", y), ("z", r * axis))
    return (), ()


def _of_one_mass(
    q: tuple[Symbol, ...], functions: Functions, equations: SlotEquations
) -> Cartesian | None:
    places = [equations.q.index(x) for x in q]
    rest = [k for k in range(len(equations.q)) if k not in places]
    if not q or len(functions) != len(q):
        return None
    if any(is_zero(equations.mass[i][k]) is not True for i in places for k in rest):
        return None
    names, X = zip(*functions, strict=True)
    columns = [[function.diff(x) for function in X] for x in q]
    m = simplify(equations.mass[places[0]][places[0]] / dot(columns[0], columns[0]))
    if not m.free_symbols.isdisjoint({equations.t, *equations.q, *equations.v}):
        return None
    if not all(
        is_zero(equations.mass[i][k] - m * dot(a, b)) is True
        for i, a in zip(places, columns, strict=True)
        for k, b in zip(places, columns, strict=True)
    ):
        return None
    return Cartesian(q, names, X, m)
