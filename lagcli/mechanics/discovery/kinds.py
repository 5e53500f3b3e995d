"""Which coordinates are lengths, and which are angles.

A coordinate is taken for an angle where it occurs in L only inside circular functions, without a
parameter as its factor (cos(k x) is a wave), or not at all while its own inertia, or that with
another coordinate, depends on a third one.  What has the unit of a length is none; an angle of
which only the constraints know takes part in both ways, and so does what is cyclic with an inertia
that no circle has (the half plane, x'^2/y^2), and the z of a wave cos(k (z - c t)).  Two cyclic
coordinates of one inertia are lengths.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isqrt

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.spectrum import exponents
from lagcli.mechanics.discovery.time_dependent import of_euler
from lagcli.record import replace


@dataclass(slots=True)
class Kinds:
    """The coordinates by what they look like: lengths, angles, radii among the lengths."""

    lengths: list[Symbol] = field(default_factory=list)
    angles: list[Symbol] = field(default_factory=list)
    radii: list[Symbol] = field(default_factory=list)
    cyclic: list[Symbol] = field(default_factory=list)  # among the angles
    precessing: list[Symbol] = field(default_factory=list)  # in no inertia, and its own one varies
    latitudes: Mapping[Symbol, Expr] = field(default_factory=dict)  # with what is 0 at the poles
    alone: list[Symbol] = field(default_factory=list)  # cyclic, in no inertia with a latitude
    curved: bool = False
    powers: bool = False  # of one length whose inertia depends on its velocity: -2 to 3
    exponentials: list[Expr] = field(default_factory=list)  # of lengths, in the inertia
    waves: Mapping[Symbol, list[Expr]] = field(default_factory=dict)  # by what grows uniformly
    centre: Mapping[Symbol, Expr] = field(default_factory=dict)  # of rotations, where not at 0
    parts: Sequence[Sequence[Symbol]] = ()  # coordinates with an inertia of their own

    def of(self, part: Sequence[Symbol]) -> Kinds:
        """Those of some of the coordinates."""

        def chosen(given: Sequence[Symbol]) -> list[Symbol]:
            return [x for x in given if x in part]

        lengths, angles = chosen(self.lengths), chosen(self.angles)
        return replace(
            self,
            lengths=lengths,
            angles=angles,
            radii=chosen(self.radii),
            latitudes={x: pole for x, pole in self.latitudes.items() if x in part},
            alone=chosen(self.alone),
            exponentials=[e for e in self.exponentials if e.free_symbols & set(part)],
            curved=len(part) > 1 and set(angles) <= set(lengths),
            parts=(),
        )


def kinds(
    L: Expr,
    equations: SlotEquations,
    units: Sequence[str | None] = (),
    constraints: Sequence[Expr] = (),
) -> Kinds:
    """Tell lengths from angles."""
    found = Kinds()
    inertia = {x: sympy.Tuple(*row) for x, row in zip(equations.q, equations.mass, strict=True)}
    inside = {s for f in L.atoms(*CIRCULAR) for s in f.free_symbols
              if f.args[0].diff(s).is_Rational}  # fmt: skip
    turning = {s for e in constraints for f in e.atoms(*CIRCULAR) for s in f.free_symbols}
    phases = (f for f in L.atoms(*CIRCULAR) if not free_of(f, [equations.t]))
    travelling = {s for f in phases for s in f.free_symbols}
    for x, unit in zip(equations.q, units or [None] * len(equations.q), strict=True):
        cyclic = free_of(L, [x])
        turned = any(
            m.free_symbols & (set(equations.q) - {x, y})
            for y, m in zip(equations.q, inertia[x], strict=True)
        ) or inertia[x][equations.q.index(x)].free_symbols & (set(equations.q) - {x})
        angle = bool(cyclic and turned) or (x in inside and not _outside(L, x))
        if angle and cyclic and (unit == "m" or _has_twin(x, equations, L)):
            angle = False
        (found.angles if angle else found.lengths).append(x)
        if angle and cyclic:
            found.cyclic.append(x)
        elif cyclic and x in turning:
            found.angles.append(x)
        elif angle and x in travelling:
            found.lengths.append(x)
        if (
            angle
            and cyclic
            and unit is None
            and not inertia[x].atoms(*CIRCULAR)
            and _is_of_no_circle(x, equations)
        ):
            found.lengths.append(x)
    found.radii = [
        x for x in found.lengths
        if any(x in inertia[y].free_symbols for y in found.angles)
    ]  # fmt: skip
    found.waves = _waves(equations, found.cyclic)
    found.angles += [x for x in found.waves if x not in found.angles]
    not_waves = [x for x in found.lengths if x not in found.waves]
    in_inertia = {s for row in equations.mass for m in row for s in m.free_symbols}
    found.precessing = [
        x for k, x in enumerate(equations.q)
        if x in found.angles and x not in in_inertia and not free_of(inertia[x][k], equations.q)
    ]  # fmt: skip
    found.curved = set(found.angles) <= set(not_waves) and not in_inertia.isdisjoint(found.lengths)
    found.powers = len(found.lengths) == len(equations.q) == 1 and not free_of(
        equations.mass[0][0], equations.v
    )
    found.exponentials = _exponentials(equations)
    found.lengths += [x for x in found.waves if x not in found.lengths]
    found.parts = [factor.q for factor in Metric(equations.q, equations.mass).factors]
    poles = {x: _at_poles(x, equations) for x in found.angles}
    found.latitudes = {x: pole for x, pole in poles.items() if pole is not None}
    found.alone = [
        x for x in found.cyclic if inertia[x].free_symbols.isdisjoint(found.latitudes)
    ]  # fmt: skip
    return found


def _has_twin(x: Symbol, equations: SlotEquations, L: Expr) -> bool:
    """Whether another cyclic coordinate has its inertia, as x and y in z^2 (x'^2 + 4 y'^2).

    The two turn into each other, so they are lengths of a plane and no angles.  So are those
    whose principal inertias have a constant ratio while the axes turn, as of a body in a fluid.
    """
    q, mass = equations.q, equations.mass
    i = q.index(x)
    for k, y in enumerate(q):
        if k != i and free_of(L, [y]):
            trace = mass[i][i] + mass[k][k]
            determinant = mass[i][i] * mass[k][k] - mass[i][k] ** 2
            if trace == 0 or free_of(simplify(determinant / trace**2), q):
                return True
    return False


def _is_of_no_circle(x: Symbol, equations: SlotEquations) -> bool:
    """Whether its inertia is no square of a radius: as a circle shrinks to a point it falls as r^2.

    1 + x^2 vanishes nowhere, r^(2 p) falls so for p = 1 alone, and with r'^2/r^2 no point is near.
    """
    q, places = equations.q, {y: k for k, y in enumerate(equations.q)}
    inertia = equations.mass[places[x]][places[x]]
    above, below = sympy.fraction(sympy.together(inertia))
    if not free_of(below, q) or any(not free_of(e, q) for e in inertia.atoms(sympy.exp)):
        return True
    inside = [y for y in q if y in above.free_symbols]
    if len(inside) == 1:
        [r] = inside
        radial = sympy.denom(sympy.together(equations.mass[places[r]][places[r]]))
        if radial.xreplace({r: sympy.S.Zero}) == 0:
            return True
    if not above.is_polynomial(*inside):
        base, exponent = above.as_independent(*q, as_Add=False)[1].as_base_exp()
        return base in q and exponent != 2
    if len(inside) == 1 and bool(sympy.discriminant(above, *inside).is_negative):
        return True
    return all(sympy.degree(above, x) != 2 for x in inside)


def _exponentials(equations: SlotEquations) -> list[Expr]:
    """Of the inertia: exp(x), its root and their inverses, as isometries have them.

    With m constant and a drag -c x'^2, m exp(2 c x/m) is the inertia of a Lagrangian.
    """
    atoms = {e for row in equations.mass for m in row for e in m.atoms(sympy.exp)}
    inside = [e.args[0] for e in sorted(atoms, key=sympy.default_sort_key)
              if not free_of(e, equations.q) and free_of(e, [equations.t])]  # fmt: skip
    powers = [sympy.Rational(k, 2) for k in (-2, -1, 1, 2)]
    if len(equations.q) == 1 and free_of(equations.mass[0][0], (*equations.q, *equations.v)):
        [x], [v], [force], [[m]] = equations.q, equations.v, equations.forcing, equations.mass
        drag = simplify(-force.diff(v, 2) / m)
        inside += [drag * x] if drag != 0 and free_of(drag, (x, v, equations.t)) else []
    return list(dict.fromkeys(sympy.exp(k * x) for x in inside for k in powers))


def _waves(equations: SlotEquations, cyclic: Sequence[Symbol]) -> dict[Symbol, list[Expr]]:
    """Functions of a u that grows uniformly, as time does: p_v = c u' of a plane wave.

    With u' = 1, x'' = k x + c x' has the exponents by which a Killing vector f(u) d/dx changes, and
    x'' = k x/u^2 + c x'/u those in log(u), f' with it as f/u.
    """
    q, v, mass = equations.q, equations.v, equations.mass
    found: dict[Symbol, list[Expr]] = {}
    for row, force in zip(mass, equations.forcing, strict=True):
        driven = [k for k, m in enumerate(row) if m != 0]
        if force != 0 or len(driven) != 1 or not free_of(row[driven[0]], q):
            continue
        [c] = driven
        u = q[c]
        beside = [[m for i, m in enumerate(own) if i not in (k, c)] for k, own in enumerate(mass)]
        alone = [k for k, m in enumerate(beside) if k != c and not any(m)]
        alone = [k for k in alone if mass[k][k] != 0 and free_of(mass[k][k], q)]
        time = {v[c]: sympy.S.One}
        forces = [sympy.expand(equations.forcing[k].xreplace(time) / mass[k][k]) for k in alone]
        motion = forces, [q[k] for k in alone], [v[k] for k in alone], u
        alike = exponents(*motion) if u in cyclic else []
        each = [f for exponent in alike for f in exponent.functions(u)]
        tau, scaled, _ = of_euler(*motion)
        each += [f / tau for exponent in scaled for f in exponent.functions(sympy.log(tau))]
        if each:
            found[u] = each
    return found


def _at_poles(x: Symbol, equations: SlotEquations) -> Expr | None:
    """sin(x) or cos(x), where det M vanishes with it or changes with x at all; else None."""
    if not any(x in m.free_symbols for row in equations.mass for m in row):
        return None
    entries = Evaluator([m for row in equations.mass for m in row])
    symbols = {s for row in equations.mass for m in row for s in m.free_symbols}
    source = random.Random("lagcli determinant")
    point = {s: mpf(source.randint(3000, 13000)) / 10007 for s in sorted(symbols, key=str)}
    with mpmath.workdps(DIGITS):
        values = []
        for at in (mpf(2) / 7, mpf(11) / 9, mpmath.pi / 2):
            try:
                values.append(mpmath.det(_square(entries({**point, x: at}))))
            except (ArithmeticError, ValueError):
                return sympy.cos(x) if len(values) == 2 else sympy.sin(x)
        small = mpf(10) ** -12 * (1 + abs(values[0]))
        if abs(values[2]) < small < abs(values[0]):
            return sympy.cos(x)
        return sympy.sin(x) if abs(values[0] - values[1]) > small else None


def _square(entries: Sequence[mpf]) -> mpmath.matrix:
    n = isqrt(len(entries))
    return mpmath.matrix([list(entries[k * n : (k + 1) * n]) for k in range(n)])


def _outside(L: Expr, x: Symbol) -> bool:
    """Whether x occurs anywhere but inside circular functions."""
    marks = {f: sympy.Dummy() for f in L.atoms(*CIRCULAR) if x in f.free_symbols}
    return x in L.xreplace(marks).free_symbols
