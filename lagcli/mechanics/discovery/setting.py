"""One system as its searches see it: equations, kinds of coordinates, curvature."""

from __future__ import annotations

from contextlib import suppress
from functools import cached_property

import mpmath
import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.row_rank import rank
from lagcli.mechanics.discovery import point
from lagcli.mechanics.discovery.ansatz import TimeFunctions, time_functions
from lagcli.mechanics.discovery.cartesian import Cartesian, about_an_axis, cartesian
from lagcli.mechanics.discovery.centre import centre_of
from lagcli.mechanics.discovery.isometries import Isometries, are_beyond
from lagcli.mechanics.discovery.killing_fields import KillingFields
from lagcli.mechanics.discovery.kinds import Kinds, kinds
from lagcli.mechanics.discovery.limits import Allowance, TooMuchWork
from lagcli.mechanics.discovery.listing import Listing
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.search import Search
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.mechanics.states import Contradiction
from lagcli.record import replace

_MOST_COORDINATES = 9  # measured: at most 5
_FEW_TERMS = 3  # measured: up to 7


class Setting:
    """The system, the work that its searches may do, and what they have found so far.

    Attributes
    ----------
    words, stopped : list of str
        What is searched, and which parts of it were not finished, and why.
    """

    def __init__(self, noether: Noether) -> None:
        self.noether = noether
        self.dynamics = noether.dynamics
        self.system = noether.system
        self.allowed = Allowance()
        self.words: list[str] = []
        self.stopped: list[str] = []
        self._without_isometries = ""
        #: Isometries of T where not all were found.
        self.partial: KillingFields | None = None

    @cached_property
    def listing(self) -> Listing:
        """The charges that were found, with their names."""
        kinds = self.coordinate_kinds
        constraints = self.dynamics.constraints.equations
        return Listing(self.system, constraints, kinds, self.axes(kinds))

    def axes(self, kinds: Kinds) -> Cartesian | None:
        """Cartesian coordinates, those of a flat T about an axis where no others are known."""
        found = cartesian(kinds, self.equations)
        if found is None and self.flat is not None and self.flat.inertia:
            return about_an_axis(self.flat.functions, self.flat.inertia, self.system.q)
        return found

    @property
    def point_charges(self) -> tuple[NoetherCharge, ...]:
        """Of point symmetries."""
        return self.listing.points

    @property
    def hidden_charges(self) -> tuple[NoetherCharge, ...]:
        """Of higher degree in the velocities, beyond them."""
        return self.listing.hidden

    @property
    def charges(self) -> tuple[NoetherCharge, ...]:
        """All of them, the point symmetries first."""
        return (*self.point_charges, *self.hidden_charges)

    @property
    def fixed_charges(self) -> list[NoetherCharge]:
        """Those without explicit time."""
        return [c for c in self.charges if self.system.t not in c.charge.free_symbols]

    @cached_property
    def unusable(self) -> str:
        """Why there is no search, empty where there is one."""
        if len(self.system.q) > _MOST_COORDINATES:
            return f"more than {_MOST_COORDINATES} coordinates are not searched"
        if self.dynamics.constraints.equations:
            return ""
        try:
            return "the Lagrangian is singular" if self._singular else ""
        except Contradiction:
            return "no state was found at which the Lagrangian is real"

    @property
    def _singular(self) -> bool:
        """Whether M has no inverse, by its rank at a random state."""
        mass = self.dynamics.lagrange.mass_matrix
        n = len(mass)
        evaluate = Evaluator([m for row in mass for m in row])
        for state in self.dynamics.states.take(3):
            try:
                entries = evaluate(state)
            except (ArithmeticError, ValueError):
                continue
            with mpmath.workdps(DIGITS):
                if rank([entries[k * n : (k + 1) * n] for k in range(n)]) == n:
                    return False
        return True

    @cached_property
    def equations(self) -> SlotEquations:
        """The equations of motion without constraints."""
        lagrange = self.dynamics.lagrange
        return SlotEquations(
            self.system.t,
            self.system.q,
            self.system.qdot,
            tuple(tuple(map(self._short, row)) for row in lagrange.mass_matrix),
            tuple(map(self._short, lagrange.forcing)),
        )

    def _short(self, expression: Expr) -> Expr:
        """Shorter where sines and cosines may cancel; sums of pair forces stay as they are."""
        self.allowed.check()
        angular = any(not free_of(f, self.system.q) for f in expression.atoms(sympy.sin, sympy.cos))
        few = len(sympy.Add.make_args(expression)) <= _FEW_TERMS
        return simplify(expression) if angular or few else expression

    @cached_property
    def coordinate_kinds(self) -> Kinds:
        """Which coordinates are lengths and which are angles."""
        units = [c.unit for c in self.system.problem.coordinates]
        rows = [x for e in self.dynamics.constraints.equations for x in (*e.row, e.drift)]
        L = self.system.L
        turning = {s for f in L.atoms(sympy.sin, sympy.cos) for s in f.free_symbols}
        if not turning & {*self.system.q} <= self.equations_symbols:
            L = simplify(L)  # sin(q)^2 + cos(q)^2 is 1
        return kinds(L, self.equations, units, rows)

    @property
    def centred_kinds(self) -> Kinds:
        """The same, with the centre of the rotations found."""
        given = [c.transformation for c in self.point_charges]
        centre = centre_of(given, self.system, self.coordinate_kinds.lengths)
        return replace(self.coordinate_kinds, centre=centre)

    @cached_property
    def canonical(self) -> bool:
        """Whether no forces act beside those of L."""
        return all(is_zero(f) is True for f in self.system.applied_forces)

    @cached_property
    def quadratic_mass(self) -> bool:
        """Whether the mass matrix does not depend on velocities."""
        v = self.system.qdot
        return all(free_of(m, v) for row in self.equations.mass for m in row)

    @cached_property
    def accelerations(self) -> tuple[Expr, ...] | None:
        """q'' for its linear part; None where there are constraints."""
        if self.dynamics.constraints.equations:
            return None
        mass = self.equations.mass
        if all(m == 0 for i, row in enumerate(mass) for j, m in enumerate(row) if i != j):
            forcing = map(self._with_linear_terms, range(len(mass)))
            found = [f / row[i] for i, (f, row) in enumerate(zip(forcing, mass, strict=True))]
            # one denominator with velocities, that of M, may cancel
            return tuple(found if self.quadratic_mass else map(simplify, found))
        if any(not free_of(m, self.system.q) for row in mass for m in row):
            return None  # its inverse times the forcing has no linear terms of use
        motion = self.dynamics.motion
        return None if motion is None else motion.accelerations

    @cached_property
    def time_functions(self) -> TimeFunctions:
        """Those that the linear part of the forces suggests, in Cartesian coordinates if any."""
        if self.isometries is not None and self.isometries.flat:
            return self.isometries.times
        given = self._of_exponential or self.accelerations
        times = time_functions(self.equations, given, potential=self.canonical)
        translations = dict.fromkeys([*times.translations, *self._of_momenta])
        stretching = self._of_stretching
        return replace(
            times,
            translations=tuple(translations),
            others=tuple(dict.fromkeys([*times.others, *stretching.others])),
            exponents=(*times.exponents, *stretching.exponents),
        )

    @cached_property
    def _of_stretching(self) -> TimeFunctions:
        """Those with d^3f/dt^3 = -K df/dt where something stretches T and V suits it."""
        rest = self.system.L.xreplace(dict.fromkeys(self.system.qdot, sympy.S.Zero))
        fixed = self._fields is not None and free_of(rest, [self.system.t])
        K = self._fields.rate_of(-rest) if self._fields is not None and fixed else None
        x, v = sympy.Dummy("x", real=True), sympy.Dummy("v", real=True)
        own = SlotEquations(self.system.t, (x,), (v,), (), ())
        return time_functions(own, None if K is None else [-K * x / 4], potential=True)

    @property
    def _of_momenta(self) -> list[Expr]:
        """exp(-integral of a) where p' = a(t) p, as of a top with a drag about its axis."""
        if self.canonical:
            return []
        system, lagrange = self.system, self.dynamics.lagrange
        pushes = zip(lagrange.lagrangian_forces, system.applied_forces, strict=True)
        found = []
        for p, push in zip(lagrange.momenta, (a + b for a, b in pushes), strict=True):
            if p == 0 or not push.free_symbols & set(system.qdot):
                continue
            rate = simplify(push / p)
            if free_of(rate, (*system.q, *system.qdot)):
                integral = antiderivative(rate, system.t)
                found += [] if integral is None else [simplify(sympy.exp(-integral))]
        return found

    @property
    def _of_exponential(self) -> tuple[Expr] | None:
        """K x where u = exp(c x) obeys u'' = K u, as under a drag -c x'^2 and a constant force."""
        if self.accelerations is None or len(self.accelerations) > 1:
            return None
        [x], [v], [acceleration] = self.system.q, self.system.qdot, self.accelerations
        for u in self.coordinate_kinds.exponentials:
            c = u.args[0].diff(x)
            K = simplify(c * acceleration + c**2 * v**2)
            if K != 0 and free_of(K, (x, v, self.system.t)):
                return (K * x,)
        return None

    @cached_property
    def isometries(self) -> Isometries | None:
        """Those of a kinetic energy of constant curvature that depends on the coordinates."""
        if self.dynamics.constraints.equations or not (self.canonical and self.quadratic_mass):
            return None
        if not Isometries.apply(self.equations):
            return None
        rest = self.system.L.xreplace(dict.fromkeys(self.system.qdot, sympy.S.Zero))
        found = Isometries(self.equations, rest, self.allowed)
        if not found.functions and found.metric.n > 1 and found.metric.curvature is not None:
            kind, what = "of constant curvature", "isometries"
            if found.flat:
                kind, what = "flat", "Cartesian coordinates"
            self._without_isometries = f"the kinetic energy is {kind}, but no {what} were found"
        return found if found.functions else None

    @cached_property
    def killing(self) -> KillingFields | None:
        """All isometries of another T, where `affine` has not all or what stretches T has times."""
        q, kinds, found = self.equations.q, self.coordinate_kinds, self._fields
        if found is None or self._of_stretching.exponents:
            return found
        with suppress(TooMuchWork):
            if are_beyond(found.fields, kinds, q, self.allowed.part(0.45)):
                return found
        return None

    @cached_property
    def _fields(self) -> KillingFields | None:
        """The isometries of a kinetic energy of another curvature, where all were found."""
        if self.isometries is not None or not (self.canonical and self.quadratic_mass):
            return None
        if self.dynamics.constraints.equations or not KillingFields.apply(self.equations):
            return None
        q, allowed = self.equations.q, self.allowed.part(0.45)
        with suppress(NoPoint, TooMuchWork, ZeroDivisionError):
            found = KillingFields(Metric(q, self.equations.mass), allowed)
            if len(found.fields) == found.number:
                return found
            self.partial = found
        return None

    def transformations(self, search: Search) -> list[Transformation]:
        """The solutions of a search."""
        constants = set(self.system.parameters)
        return [point.transformation_of(search, s, constants) for s in search.solutions()]

    def of_partial(self, partial: KillingFields, allowed: Allowance) -> list[NoetherCharge]:
        """The charges of isometries of T, where not all were found."""
        search = partial.search(self.equations, self.time_functions, allowed)
        moves = self.transformations(search)
        found = [point.charge_of(self.noether, each, allowed) for each in moves]
        return [charge for charge in found if charge is not None]

    @property
    def without_isometries(self) -> str:
        """That T has isometries that were not found, if it is so."""
        moving = (self.system.t, *self.system.qdot)
        shown = sum(c.transformation.displaces_without(moving) for c in self.point_charges)
        found = None if self._without_isometries else self.partial
        if found is None or max(len(found.fields), shown) >= found.isometries:
            return self._without_isometries
        return (
            f"the kinetic energy has {found.isometries} isometries, of which formulas were found "
            f"for {max(len(found.fields), shown)}"
        )

    @property
    def flat(self) -> Isometries | None:
        """Those of a flat kinetic energy that depends on the coordinates."""
        return self.isometries if self.isometries is not None and self.isometries.flat else None

    @cached_property
    def spacetime(self) -> Isometries | None:
        """Those of the metric of space and time; None where there are none."""
        equations = self.of_spacetime
        if equations is None or not Isometries.apply(equations):
            return None
        found = Isometries(equations, sympy.S.Zero, self.allowed)
        return found if found.functions else None

    @cached_property
    def of_spacetime(self) -> SlotEquations | None:
        """Of g where L is the length sqrt(-g) of the path (t, q), whatever its parameter.

        But for terms up to first degree in q', those of a field.  With g positive along space,
        roots of its components are real where L is.

        Landau, Lifshitz, *The Classical Theory of Fields*, section 87.
        """
        t, q, v = self.system.t, self.system.q, self.system.qdot
        parts = sympy.Add.make_args(self.system.L)
        field = sympy.Add(*(part for part in parts if part.is_polynomial(*v)))
        square = -((self.system.L - field) ** 2)
        if sympy.Poly(field, *v).total_degree() > 1:
            return None
        if self.dynamics.constraints.equations or self.quadratic_mass or not self.canonical:
            return None
        if not square.is_polynomial(*v) or sympy.Poly(square, *v).total_degree() > 2:
            return None
        rate = sympy.Dummy("t'", real=True)
        whole = sympy.Poly(square, *v).homogenize(rate).as_expr()
        moving = (rate, *v)
        mass = tuple(tuple(_with_squares(whole.diff(a, b) / 2) for a in moving) for b in moving)
        forcing = (sympy.S.Zero,) * len(mass)
        return SlotEquations(sympy.Dummy("s"), (t, *q), moving, mass, forcing)

    def _with_linear_terms(self, i: int) -> Expr:
        """A force in the form that has linear terms: simplified, or as it was derived.

        In one fraction with b/x^3 no term of k x is linear; as derived from points that turn the
        terms of sin(w t) have not cancelled.
        """
        simple = self.equations.forcing[i]
        plain = free_of(sympy.fraction(simple)[1], self.system.q)
        return simple if plain else self.dynamics.lagrange.forcing[i]

    @property
    def equations_symbols(self) -> set[Expr]:
        """All symbols of M and of the forcing."""
        return set().union(
            *(m.free_symbols for row in self.equations.mass for m in row),
            *(f.free_symbols for f in self.equations.forcing),
        )


def _with_squares(formula: Expr) -> Expr:
    """(1 + a x)^2 for 1 + 2 a x + a^2 x^2, so that its root is 1 + a x."""
    above, below = sympy.fraction(sympy.together(formula))
    return sympy.sqf(above) / sympy.sqf(below)
