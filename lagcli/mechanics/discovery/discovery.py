"""What was found for one system: the charges, each proved, and what was searched.

References
----------
Lutzky, J. Phys. A 11 (1978) 249 (the oscillator's five).
Ibragimov, *Elementary Lie Group Analysis and Ordinary Differential Equations*, ch. 11.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property

import mpmath
import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.jumps import is_continuous
from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.discovery import point
from lagcli.mechanics.discovery.ansatz import (
    Kinds,
    TimeFunctions,
    affine,
    kinds,
    point_unknowns,
    quadratic,
    time_functions,
)
from lagcli.mechanics.discovery.brackets import rank
from lagcli.mechanics.discovery.centralizer import centralized
from lagcli.mechanics.discovery.centre import centre_of
from lagcli.mechanics.discovery.constrained import rank_on_surface, tangent
from lagcli.mechanics.discovery.hidden import (
    MOST_UNKNOWNS as MOST_FOR_TENSORS,
)
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals, is_gyroscopic
from lagcli.mechanics.discovery.hidden_names import HiddenNames
from lagcli.mechanics.discovery.isometries import Isometries
from lagcli.mechanics.discovery.killing import KillingIntegrals
from lagcli.mechanics.discovery.limits import MOST_UNKNOWNS, Allowance, TooMuchWork
from lagcli.mechanics.discovery.listing import led_momentum, more, rank_of, times
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.names import Naming, distinct
from lagcli.mechanics.discovery.search import Search
from lagcli.mechanics.discovery.slots import SlotEquations, point_slots
from lagcli.mechanics.discovery.special import SpecialCase
from lagcli.mechanics.discovery.special_search import special_cases
from lagcli.mechanics.discovery.third_degree import CubicIntegrals
from lagcli.mechanics.discovery.timed import TimedIntegrals
from lagcli.mechanics.discovery.under_constraints import UnderConstraints
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.mechanics.states import Contradiction

_MOST_COORDINATES = 9
_DIGITS = 40
_MOST_FOR_TENSORS = 6
_FEW_TERMS = 3
_MOST_IN_SPACE = 4


class Discovery:
    """The search for one system, bounded in its work.

    Attributes
    ----------
    point_charges, hidden_charges : tuple of NoetherCharge
        Of point symmetries, and of second degree in the velocities beyond them.
    unsearched : bool
        Whether there was no search at all, for the reason in `stopped`.
    momentum_equations : tuple of NoetherCharge
        Of symmetries that nonholonomic constraints admit without a constant charge.
    stopped : list of str
        Which parts of the search were not finished, and why.
    unproved : str
        The sentence of that where a symmetry is known, but not its charge.
    """

    def __init__(self, noether: Noether) -> None:
        self.noether = noether
        self.dynamics = noether.dynamics
        self.system = noether.system
        self.allowed = Allowance()
        self.stopped: list[str] = []
        self.words: list[str] = []
        self.point_charges: tuple[NoetherCharge, ...] = ()
        self.hidden_charges: tuple[NoetherCharge, ...] = ()
        self.momentum_equations: tuple[NoetherCharge, ...] = ()
        self.unsearched = False
        self.unproved = ""
        self._found: list[tuple[str, NoetherCharge]] = []
        self._of_lagrangian: list[Transformation] = []
        self._run()

    @property
    def charges(self) -> tuple[NoetherCharge, ...]:
        """All of them, the symmetries first."""
        return (*self.point_charges, *self.hidden_charges)

    @property
    def ansatz(self) -> str:
        """What was searched and what was not, as a sentence without its full stop."""
        return "; ".join(dict.fromkeys((*self.words, *self.stopped)))

    def _unusable(self) -> str:
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
        evaluate = Evaluator([m for row in mass for m in row], _DIGITS)
        for state in self.dynamics.states.take(3):
            try:
                entries = evaluate(state)
            except (ArithmeticError, ValueError):
                continue
            with mpmath.workdps(_DIGITS):
                if rank([entries[k * n : (k + 1) * n] for k in range(n)]) == n:
                    return False
        return True

    # -- the two searches -------------------------------------------------------------------

    def _run(self) -> None:
        why = self._unusable()
        if why:
            self.unsearched = True
            self.words.append("nothing")
            self.stopped.append(why)
            return
        searches: list[tuple[Callable[[], None], str]] = [(self._points, "point symmetries")]
        if self.dynamics.constraints.equations:
            searches += [(self._on_surface, "integrals on the constraint surface")]
        else:
            searches += [(self._hidden, "Killing tensors"), (self._cubic, "cubic integrals")]
        for search, what in searches:
            try:
                search()
            except TooMuchWork:
                self.stopped.append(f"stopped before all {what} were found: too much work")
            except NoPoint:
                self.stopped.append(f"{what}: no sample point, so the search is incomplete")
            except ZeroDivisionError:
                self.stopped.append(f"{what}: a formula is infinite, so the search is incomplete")

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
        return kinds(self.system.L, self.equations, units, rows)

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
            return tuple(f / row[i] for i, (f, row) in enumerate(zip(forcing, mass, strict=True)))
        if any(not free_of(m, self.system.q) for row in mass for m in row):
            return None  # its inverse times the forcing has no linear terms of use
        motion = self.dynamics.motion
        return None if motion is None else motion.accelerations

    @cached_property
    def isometries(self) -> Isometries | None:
        """Those of a kinetic energy of constant curvature that depends on the coordinates."""
        if self.dynamics.constraints.equations or not (self.canonical and self.quadratic_mass):
            return None
        if not Isometries.apply(self.equations):
            return None
        found = Isometries(self.equations, self.allowed)
        return found if found.functions else None

    def _with_linear_terms(self, i: int) -> Expr:
        """A force in the form that has linear terms: simplified, or as it was derived.

        In one fraction with b/x^3 no term of k x is linear; as derived from points that turn the
        terms of sin(w t) have not cancelled.
        """
        simple = self.equations.forcing[i]
        plain = free_of(sympy.fraction(simple)[1], self.system.q)
        return simple if plain else self.dynamics.lagrange.forcing[i]

    def _search(self, kinds: Kinds, allowed: Allowance) -> tuple[Search, str]:
        """The linear system for the point symmetries, and what its ansatz is in words."""
        isometries = self.isometries
        if isometries is not None and isometries.beyond(kinds):
            times = isometries.times
            return isometries.search(times, allowed), isometries.words + _timed(times)
        equations = self.equations
        times = time_functions(equations, self.accelerations, potential=self.canonical)
        slots = point_slots(equations)
        spaces = affine(kinds)
        while True:
            unknowns = point_unknowns(slots, times, spaces, time_with_space=not self.quadratic_mass)
            if len(unknowns) <= MOST_UNKNOWNS or len(spaces) == 1:
                break
            spaces = spaces[: len(spaces) // 2]
        return Search(equations, slots, unknowns, allowed), self._sentence(times, spaces)

    def _points(self) -> None:
        allowed = self.allowed.part(0.7)
        constraints = self.dynamics.constraints.equations
        search, words = self._search(self.coordinate_kinds, allowed)
        self.words.append(words)
        transformations = self._transformations(search)
        centre = centre_of(transformations, self.system, self.coordinate_kinds.lengths)
        if len(centre) > 1:  # rotations about it are mixed where they are counted from 0
            search, _ = self._search(replace(self.coordinate_kinds, centre=centre), allowed)
            transformations = self._transformations(search)
        if search.unsolved:
            self.stopped.append(
                f"{more(search.unsolved, 'symmetry')} there, whose coefficients were not solved"
            )
        transformations.reverse()
        transformations = centralized(transformations, self.system, allowed)
        if constraints:
            self._of_lagrangian = transformations
            transformations = tangent(transformations, self.dynamics, allowed)
        for transformation in transformations:
            allowed.check()
            charge = point.charge_of(self.noether, transformation, allowed)
            if charge is None or is_zero(charge.charge) is True:
                self.unproved = "a symmetry whose charge was not proved is left out"
                self.stopped.append(self.unproved)
                continue
            self._add(charge)

    def _transformations(self, search: Search) -> list[Transformation]:
        constants = set(self.system.parameters)
        return [point.transformation_of(search, s, constants) for s in search.solutions()]

    @cached_property
    def special(self) -> tuple[SpecialCase, ...]:
        """Values of parameters at which there are more charges, with these."""
        return special_cases(self)

    @cached_property
    def _naming(self) -> Naming:
        return Naming(self.system.t, self.system.q, self.coordinate_kinds)

    def _lasts(self, charge: NoetherCharge) -> bool:
        """Whether it is constant also where the argument of a sign passes 0."""
        return self.system.is_continuous and is_continuous(charge.charge)

    def _add(self, *charges: NoetherCharge) -> None:
        """Name them, and sort all point symmetries anew."""
        naming = self._naming
        for charge in filter(self._lasts, charges):
            given = charge.transformation
            name = naming.of_point(given.changes, given.time)
            name = name or naming.of_relative(charge.charge, given.changes, self.system.qdot)
            if name == "energy" and self._moved and charge.gauge != 0:
                name = "moving_energy"
            if not name and self.dynamics.constraints.equations:
                name, charge = led_momentum(charge, self.system)
            self._found.append((name, charge))
        found = sorted(self._found, key=lambda pair: rank_of(pair[0]))
        names = distinct([name for name, _ in found])
        self.point_charges = tuple(
            replace(
                times(charge, naming.orientation(name, charge.transformation.changes)), name=name
            )
            for name, (_, charge) in zip(names, found, strict=True)
        )

    @cached_property
    def _moved(self) -> bool:
        """Whether a constraint moves, and so does work."""
        return any(e.drift != 0 for e in self.dynamics.constraints.equations)

    # -- with constraints -------------------------------------------------------------------

    def _on_surface(self) -> None:
        """Momenta along admissible displacements, then integrals that hold on the surface."""
        times = time_functions(self.equations, self._constrained_motion, potential=self.canonical)
        search = UnderConstraints(self.noether, self.coordinate_kinds, times, self.allowed)
        integrated = search.integrated()
        kept = search.new([], [c for _, c in self._found])
        self._found = [pair for pair in self._found if pair[1] in kept]
        self._add(*integrated)
        self._add(*search.linear(self._values()))
        momenta = search.momenta(self._of_lagrangian, self.point_charges)
        names = [self._naming.of_point(c.transformation.changes, sympy.S.Zero) or f"momentum_{k}"
                 for k, c in enumerate(momenta.changing, 1)]  # fmt: skip
        self.momentum_equations = tuple(
            replace(c, name=name, source="momentum equation")
            for c, name in zip(momenta.changing, names, strict=True)
        )
        self._add(*search.new(self._values(), momenta.conserved))
        self.words.append(
            "on the constraints, first integrals of first degree in the velocities "
            "along admissible displacements"
            + (" with the exponents of the linear part" if times.exponents else "")
            + ", coefficients of first degree in the coordinates"
        )
        freedom = self.dynamics.degrees_of_freedom
        if freedom > 1 and rank_on_surface(self.dynamics, self._values()) == 2 * freedom:
            self.words.append("all others are functions of these")
        elif freedom > 1 and self.system.t not in self.equations_symbols:
            found = search.quadratic(self.point_charges)
            if self._few([*self.point_charges, *found]):
                found += search.of_velocities([*self.point_charges, *found])
            found = [c for c in found if self._lasts(c)]
            names = distinct([*(c.name for c in self.point_charges), *("" for _ in found)])
            self.hidden_charges = tuple(
                replace(c, name=name)
                for c, name in zip(found, names[len(self.point_charges) :], strict=True)
            )
            self.words.append(
                "and of second degree without explicit time, with coefficients of second degree"
            )
        if search.unsolved:
            self.stopped.append(
                f"{more(search.unsolved, 'integral')} there, whose coefficients were not solved"
            )

    def _few(self, known: Sequence[NoetherCharge]) -> bool:
        """Whether fewer than n are known that do not contain the time, on a surface at rest."""
        constraints = self.dynamics.constraints
        still = all(e.drift == 0 for e in constraints.equations)
        holonomic = all(kind == "holonomic" for kind in constraints.kinds.values())
        fixed = [c.charge for c in known if self.system.t not in c.charge.free_symbols]
        freedom = self.dynamics.degrees_of_freedom
        few = len(self.system.q) <= _MOST_IN_SPACE
        return few and still and holonomic and rank_on_surface(self.dynamics, fixed) < freedom

    def _values(self) -> list[Expr]:
        return [c.charge for c in self.point_charges]

    @property
    def _constrained_motion(self) -> Sequence[Expr] | None:
        motion = self.dynamics.motion
        return None if motion is None else motion.accelerations

    def _hidden(self) -> None:
        if len(self.system.q) < 2 or not self.quadratic_mass or not self.canonical:
            return
        if len(self.system.q) > _MOST_FOR_TENSORS:
            self.words.append(
                "no integrals of second degree, because there are too many coordinates"
            )
            return
        if self._by_killing_vectors():
            return
        if self.system.t not in self.equations_symbols:
            self.words.append(
                "first integrals of second degree in the velocities without explicit time, "
                "coefficients up to second degree in the coordinates"
            )
            integrals = QuadraticIntegrals(
                self.noether, self.equations, self.centred_kinds, self.allowed
            )
            if not integrals.functions:
                self.stopped.append("there are too many coordinates for the second degree")
                return
            self._keep_hidden(integrals)
        if TimedIntegrals.applies(self.equations, self.coordinate_kinds, self.point_charges):
            functions = time_functions(self.equations, self.accelerations, potential=True)
            timed = TimedIntegrals(
                self.noether, self.equations, self.centred_kinds, functions, self.allowed
            )
            if timed.functions:
                self.words.append("and with the same functions of time as coefficients")
                self._keep_hidden(timed)

    def _cubic(self) -> None:
        """Those of third degree, where fewer than n are known that do not contain the time."""
        t, n = self.system.t, len(self.system.q)
        fixed = [c for c in self.charges if t not in c.charge.free_symbols]
        if not self.canonical or not self.quadratic_mass or not 0 < len(fixed) < n:
            return
        if not CubicIntegrals.applies(self.equations):
            return
        self.words.append(
            "and of third degree, with the terms of V and of its gradient times monomials in the "
            "part of first degree"
        )
        found = CubicIntegrals(self.noether, self.equations, self.allowed).found(self.charges)
        known = [c.name for c in self.charges]
        kept = [charge for charge in found if self._lasts(charge)]
        names = distinct([*known, *("" for _ in kept)])[len(known) :]
        self.hidden_charges += tuple(
            replace(charge, name=name) for name, charge in zip(names, kept, strict=True)
        )

    def _by_killing_vectors(self) -> bool:
        """All integrals of second degree of L = T - V, where the ansatz has not all of them."""
        isometries = self.isometries
        if isometries is None or self.system.t in self.equations_symbols:
            return False
        n = len(self.system.q)
        most = MOST_FOR_TENSORS // (n * (n + 1) // 2)
        if is_gyroscopic(self.equations) or not isometries.products_beyond(
            quadratic(self.centred_kinds, most)
        ):
            return False
        self.words.append(
            "all first integrals of second degree in the velocities without explicit time"
        )
        moving = {self.system.t, *self.system.qdot}
        given = [c.transformation for c in self.point_charges]
        symmetries = [
            x.changes for x in given
            if x.time == 0 and not sympy.Tuple(*x.changes).free_symbols & moving
        ]  # fmt: skip
        kinds = self.coordinate_kinds
        self._keep_hidden(KillingIntegrals(self.noether, isometries, kinds, symmetries))
        return True

    def _keep_hidden(self, integrals: QuadraticIntegrals) -> None:
        """Add what is found, with names."""
        naming = HiddenNames(self.system, self.equations, self.centred_kinds)
        found = [each for each in integrals.found(self.charges) if self._lasts(each[1])]
        named = [(*naming.of(functions, charge), charge) for functions, charge in found]
        named.sort(key=lambda each: (not each[0], each[0]))
        known = [c.name for c in self.charges]
        names = distinct([*known, *(name for name, _, _ in named)])
        self.hidden_charges += tuple(
            replace(times(charge, factor), name=name)
            for name, (_, factor, charge) in zip(names[len(known) :], named, strict=True)
        )

    @property
    def equations_symbols(self) -> set[Expr]:
        """All symbols of M and of the forcing."""
        return set().union(
            *(m.free_symbols for row in self.equations.mass for m in row),
            *(f.free_symbols for f in self.equations.forcing),
        )

    def _sentence(self, times: TimeFunctions, spaces: Sequence[Expr]) -> str:
        what = "point transformations" if self.canonical else "integrating factors"
        shapes = []
        if any(set(s.free_symbols) & set(self.coordinate_kinds.lengths) for s in spaces) or (
            not self.coordinate_kinds.angles
        ):
            second = any(x**2 in spaces for x in self.coordinate_kinds.lengths)
            shapes.append(f"{'of second degree' if second else 'affine'} in the coordinates")
        if self.coordinate_kinds.angles and len(spaces) > 1 + len(self.coordinate_kinds.lengths):
            shapes.append("with sines and cosines of the angles")
        space = " ".join(shapes) or "constant in the coordinates"
        return f"{what} {space}{_timed(times)}"


def _timed(times: TimeFunctions) -> str:
    """The functions of time of an ansatz."""
    timed = ", polynomial in t to second degree"
    if times.exponents:
        timed += " and with the exponents of the linear part"
    if times.changing:
        timed += " and with the solutions of the linear equation"
    return timed + (" and the functions of time of the driving" if times.forced else "")
