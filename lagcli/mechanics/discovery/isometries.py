"""The isometries of a kinetic energy of constant curvature, and the point symmetries from them.

A point symmetry of L = T - V with T quadratic in the velocities moves q by an isometry of T,
or by a dilation where time is stretched too.  Of constant curvature these are known in any
coordinates, up to constant factors.

References
----------
Katzin, Levine, J. Math. Phys. 15 (1974) 1460 (symmetries of dynamical systems).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import chain

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.ansatz import TimeFunctions, affine, ordered, time_functions
from lagcli.mechanics.discovery.constant_curvature import ConstantCurvature, Vector
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import bare_terms
from lagcli.mechanics.discovery.search import Search, SlotUnknown
from lagcli.mechanics.discovery.slots import Slot, SlotEquations

_MOST_COORDINATES = 6  # two bodies in space; coupled ones in spherical coordinates are not finished
_MOST_TOGETHER = 4

#: What stands before the X_a that are Cartesian coordinates as they are, not but for factors.
THEY_ARE = "The Cartesian coordinates are "


class Isometries(ConstantCurvature):
    """The Killing vectors of a kinetic energy of constant curvature.

    Parameters
    ----------
    equations
        Of a system whose mass matrix depends on the coordinates.
    rest
        L at rest, -V: terms of it that are linear forces in the X_a suggest functions of time.
    """

    def __init__(self, equations: SlotEquations, rest: Expr, allowed: Allowance) -> None:
        self.equations = equations
        factor, mass = _time_apart(equations)
        self._rest = _by_parameters(rest / factor, equations.q)
        self._forcing = [f / factor for f in equations.forcing]
        super().__init__(Metric(equations.q, mass), allowed)

    @staticmethod
    def apply(equations: SlotEquations) -> bool:
        """Whether coordinates are worth looking for: M depends on q, and on nothing that moves.

        But for a factor f(t), which leaves its isometries the same.
        """
        _, mass = _time_apart(equations)
        entries = sympy.Tuple(*(m for row in mass for m in row))
        fixed = free_of(entries, [equations.t, *equations.v])
        if not fixed or free_of(entries, equations.q) or len(equations.q) > _MOST_COORDINATES:
            return False
        return all(factor.n <= _MOST_TOGETHER for factor in Metric(equations.q, mass).factors)

    @property
    def what_they_are(self) -> str:
        """The X_a of a flat space as what stands before them in a sentence."""
        if len(self.functions) == 1:
            return "The arc length is proportional to "
        if not self.gram.is_diagonal():
            return "Cartesian coordinates are linear combinations of "
        if len({*self.gram.diagonal()}) > 1:
            return "Cartesian coordinates are constant multiples of "
        return THEY_ARE

    @property
    def terms(self) -> list[Expr]:
        """The functions that the components of the Killing vectors consist of."""
        components = (simplify(x) for field in self.fields for x in field)
        q = self.equations.q
        return list(dict.fromkeys(term for x in components for term in bare_terms(x, q)))

    def beyond(self, kinds: Kinds) -> bool:
        """Whether they are there, and not all combinations of the functions of `affine`."""
        fields = [*self.fields, *([self.dilation] if self.functions and self.flat else [])]
        return bool(self.functions) and are_beyond(fields, kinds, self.equations.q, self.allowed)

    @property
    def words(self) -> str:
        """What is searched."""
        if self.flat:
            which = "Cartesian coordinates" if self.metric.n > 1 else "the arc length"
            return f"point transformations affine in {which} of the kinetic energy"
        return "point transformations that are isometries of the kinetic energy"

    # -- point symmetries -------------------------------------------------------------------

    @cached_property
    def times(self) -> TimeFunctions:
        """The functions of time that forces linear in the X_a suggest."""
        equations = self.equations
        symbols = [sympy.Dummy(f"X_{k}", real=True) for k in range(len(self.functions))]
        rates = [sympy.Dummy(f"Y_{k}", real=True) for k in range(len(self.functions))]
        own = SlotEquations(equations.t, tuple(symbols), tuple(rates), (), ())
        accelerations = [self._linear(D, [*symbols, *rates]) for D in self.translations]
        return time_functions(own, accelerations or None, potential=True)

    def _linear(self, gradient: Vector, symbols: Sequence[Expr]) -> Expr:
        """X'' = grad X . F, to first degree in q', by the terms that the X_b and X_b' make up."""
        whole = [self._to_first(f) for f in self._forcing]
        linear = self._part(dot(gradient, whole), symbols)
        if linear is not None:
            return linear
        parts = (self._part(dot(gradient, force), symbols) for force in self._forces)
        return sympy.Add(*(part for part in parts if part is not None))

    @cached_property
    def _forces(self) -> list[list[Expr]]:
        """-grad V by the terms of V, and what of the forces is left to first degree in q'."""
        q = self.equations.q
        pushes = [[term.diff(x) for x in q] for term in self._rest]
        rows = zip(self._forcing, *pushes, strict=True)
        left = [simplify(self._to_first(f) - sympy.Add(*parts)) for f, *parts in rows]
        return [force for force in (left, *pushes) if any(force)]

    def _part(self, force: Expr, symbols: Sequence[Expr]) -> Expr | None:
        """The force as a combination of the X_b and X_b'; None where it is none."""
        q, v = self.equations.q, self.equations.v
        rates = [dot([X.diff(x) for x in q], v) for X in self.functions]
        vectors = [[X] for X in (*self.functions, *rates, sympy.S.One)]
        values = Relation([*vectors, [-force]], (*q, *v), self.allowed).of_last()
        return None if values is None else dot(values, (*symbols, sympy.S.One))

    def _to_first(self, force: Expr) -> Expr:
        still = dict.fromkeys(self.equations.v, sympy.S.Zero)
        slopes = [force.diff(v).xreplace(still) for v in self.equations.v]
        return force.xreplace(still) + dot(slopes, self.equations.v)

    def search(self, times: TimeFunctions, allowed: Allowance) -> Search:
        """The linear system for the point symmetries: constant factors of T(t) xi."""
        rates = Slot(("tau",), tuple(-v for v in self.equations.v))
        moves = [*self.rotations, *([self.dilation] if self.flat else [])]
        fields = [*self.translations, *moves]
        slots = [rates, *(Slot(("xi", k), field) for k, field in enumerate(fields))]
        shifts = range(1, 1 + len(self.translations))
        one = sympy.S.One
        unknowns = [
            SlotUnknown(k, T, one)
            for k in range(len(slots))
            for T in (times.translations if k in shifts else times.others)
        ]
        return Search(self.equations, slots, ordered(unknowns), allowed)


def are_beyond(
    fields: Sequence[Vector], kinds: Kinds, q: Sequence[Symbol], allowed: Allowance
) -> bool:
    """Whether not all components are combinations of the functions of `affine`."""
    known = affine(kinds)
    terms = [term for x in dict.fromkeys(chain(*fields)) for term in bare_terms(x, q)]
    new = [x for x in dict.fromkeys(terms) if x not in {*known, sympy.S.Zero}]
    if not new:
        return False
    try:
        found = Relation([[x] for x in (*known, *new)], q, allowed).independent()
    except (NoPoint, ZeroDivisionError):
        return True
    return any(k >= len(known) for k in found)


def _time_apart(equations: SlotEquations) -> tuple[Expr, tuple[tuple[Expr, ...], ...]]:
    """f(t) and the rest of M, where all components have the factor."""
    entries = [m for row in equations.mass for m in row if m != 0]
    if free_of(sympy.Tuple(*entries), [equations.t]):
        return sympy.S.One, equations.mass
    f = sympy.factor(entries[0]).as_independent(equations.t, as_Add=False)[1]
    return f, tuple(tuple(simplify(m / f) for m in row) for row in equations.mass)


def _by_parameters(rest: Expr, q: Sequence[Symbol]) -> list[Expr]:
    """The terms of L at rest, those with the same parameters together."""
    found: dict[Expr, Expr] = {}
    for term in sympy.Add.make_args(sympy.expand(rest)):
        key = term.as_independent(*q, as_Add=False)[0].as_coeff_Mul()[1]
        found[key] = found.get(key, sympy.S.Zero) + term
    return list(found.values())
