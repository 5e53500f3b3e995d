"""What was found for one system: the charges, each proved, and what was searched.

References
----------
Lutzky, J. Phys. A 11 (1978) 249 (the oscillator's five).
Ibragimov, *Elementary Lie Group Analysis and Ordinary Differential Equations*, ch. 11.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress

import sympy
from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery import point
from lagcli.mechanics.discovery.ansatz import (
    TimeFunctions,
    affine,
    has_all_products,
    in_words,
    point_unknowns,
    products_of_two,
    quadratic_unknowns,
)
from lagcli.mechanics.discovery.brackets import ChargeBrackets, NoState
from lagcli.mechanics.discovery.centralizer import centralized, with_one_stretching, without_time
from lagcli.mechanics.discovery.centre import centre_of
from lagcli.mechanics.discovery.constrained import rank_on_surface, tangent
from lagcli.mechanics.discovery.fixed_energy import at_fixed_energy, has_fixed_energy, relativistic
from lagcli.mechanics.discovery.fixed_values import FixedValues, at_fixed_momenta, problem_with
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals, Slots, is_gyroscopic
from lagcli.mechanics.discovery.hidden_names import HiddenNames
from lagcli.mechanics.discovery.killing import KillingFrame, common_factors, known_factors
from lagcli.mechanics.discovery.killing_integrals import KillingIntegrals
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.lifted import growth_of, lifted, of_growing, of_velocity_constraints
from lagcli.mechanics.discovery.limits import MOST_UNKNOWNS, Allowance, TooMuchWork
from lagcli.mechanics.discovery.listing import more, times
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.names import own_name
from lagcli.mechanics.discovery.on_surface import ALL_ARE_KNOWN, all_are_known, search_on_surface
from lagcli.mechanics.discovery.products import Products, energies_of_parts
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.search import Search
from lagcli.mechanics.discovery.setting import Setting
from lagcli.mechanics.discovery.slots import point_slots
from lagcli.mechanics.discovery.special import new_charges
from lagcli.mechanics.discovery.timed import TimedIntegrals
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.platform.effort import OutOfWork
from lagcli.platform.limited import limited_to
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.wording import PRESCRIBED

_UNPROVED = "a symmetry whose charge was not proved is left out"
_SECOND = "first integrals of second degree in the velocities"
_SHARE = 0.9  # of the work that is left: the rest is for what was found
_MOST_FOR_TENSORS = 6  # measured: at most 4

Named = tuple[str, Expr, NoetherCharge]
#: What makes charges of another problem those of this one.
Lift = Callable[[Iterable[NoetherCharge]], Iterator[NoetherCharge]]


class Discovery(Setting):
    """The search for one system, bounded in its work.

    Attributes
    ----------
    unsearched : bool
        Whether there was no search at all, for the reason in `stopped`.
    momentum_equations : tuple of NoetherCharge
        Of symmetries that nonholonomic constraints admit without a constant charge.
    cartesian : tuple of Expr
        The functions in which the ansatz is affine, where these are not the coordinates.
    cartesian_lead : str
        The beginning of a sentence that ends with them.
    unproved : str
        The sentence of `stopped` where a symmetry is known, but not its charge.
    unconstrained : Discovery
        The search that was made in coordinates that no constraint binds; None where there was none.
    """

    def __init__(
        self,
        noether: Noether,
        unconstrained: Callable[[], Discovery | None],
        search: Callable[[Problem], Discovery],
    ) -> None:
        super().__init__(noether)
        self._unconstrained = unconstrained
        self._search_of = search
        self.momentum_equations: tuple[NoetherCharge, ...] = ()
        self.unsearched = bool(self.unusable)
        self.unconstrained: Discovery | None = None
        self.cartesian: tuple[Expr, ...] = ()
        self.cartesian_lead = ""
        self.unproved = ""
        self._of_lagrangian: list[Transformation] = []
        #: of the integrals that were sought, in the velocities
        self.degree = 1
        if self.unsearched:
            self.words, self.stopped = ["nothing"], [self.unusable]
        elif self.is_prescribed:
            self.words.append(f"nothing, as {PRESCRIBED}")
        else:
            self._run()

    @property
    def ansatz(self) -> str:
        """What was searched and what was not, as a sentence without its full stop."""
        return "; ".join(dict.fromkeys((*self.words, *self.stopped)))

    @property
    def is_prescribed(self) -> bool:
        """Whether positions are prescribed, so that every function of the state is known."""
        equations = self.dynamics.constraints.equations
        bound = self.dynamics.degrees_of_freedom == 0 and all(e.holonomic for e in equations)
        return bound and not self.unsearched

    # -- the two searches -------------------------------------------------------------------

    def _run(self) -> None:
        searches: list[tuple[Callable[[], None], str]] = []
        put_in = self._of_unconstrained()
        growing = not put_in and self._of_growing()
        if not (put_in or growing):
            searches.append((self._points, "point symmetries"))
        if self.dynamics.constraints.equations:
            if not (put_in and self._suffices):
                searches.append((self._on_surface, "integrals on the constraint surface"))
        else:
            searches += [
                (self._hidden, "Killing tensors"),
                (self._of_higher_degree, "integrals of higher degree"),
            ]
        for search, what in searches:
            try:
                limited_to(_SHARE, search)
            except (TooMuchWork, OutOfWork):
                stopped = f"stopped before all {what} were found: too much work"
                (self.words if self._is_integrable() else self.stopped).append(stopped)
            except NoPoint:
                self.stopped.append(f"{what}: no sample point, so the search is incomplete")
            except ZeroDivisionError:
                self.stopped.append(
                    f"{what}: a formula has no value there, so the search is incomplete"
                )
        if self.without_isometries:
            self.words.append(self.without_isometries)
        if len(self.system.q) > 1 and not (self.dynamics.constraints.equations or growing):
            what = "those" if self.degree > 1 else "other first integrals"
            what += f" of degree {self.degree + 1} or higher" if self.quadratic_mass else ""
            self.words.append(f"{what} were not sought")

    def _of_unconstrained(self) -> bool:
        """What is found without the coordinates that constraints give; whether it was sought."""
        if not (self.dynamics.constraints.equations and self.dynamics.degrees_of_freedom):
            return False
        fewer = self._unconstrained()
        if fewer is None or fewer.unsearched:
            return False
        self.unconstrained = fewer
        given = "constraints" if len(self.dynamics.constraints.equations) > 1 else "constraint"
        self.listing.add(of_velocity_constraints(self.noether))
        self._take(
            fewer, f"with the {given} put in", lambda c: lifted(c, fewer.system, self.noether)
        )
        proved = sum(
            any(c.transformation.changes) or c.transformation.time != 0 for c in self.charges
        )
        if proved < len(fewer.charges) and not self.unproved:
            self.unproved = _UNPROVED
            self.stopped.append(_UNPROVED)
        if all_are_known(self):
            self.words.append(ALL_ARE_KNOWN)
        return True

    def _of_growing(self) -> bool:
        """What is found for exp(Gamma) L without forces; whether these are -Gamma'(t) dL/dq'."""
        growth = growth_of(self.noether)
        if growth is None or free_of(sympy.Tuple(*self.equations.mass), self.system.q):
            return False
        n = range(len(self.system.q))
        there = self._search_of(problem_with(self.system, n, growth * self.system.L, ()))
        words = "with L times a function of time in place of the drag"
        self._take(there, words, lambda charges: of_growing(charges, growth, self.noether))
        return True

    def _take(self, there: Discovery, where: str, lift: Lift) -> None:
        """What was found for another problem, as charges of this one."""
        self.words.append(f"{where}, {'; '.join(dict.fromkeys(there.words))}")
        self.stopped += there.stopped
        self.unproved = there.unproved
        self.cartesian, self.cartesian_lead = there.cartesian, there.cartesian_lead
        self.listing.add(lift(there.point_charges))
        for charge in there.hidden_charges:
            name = own_name(charge.name)
            self.listing.add_hidden((name, c) for c in lift([charge]))

    @property
    def _suffices(self) -> bool:
        """Whether there are as many charges without the time as degrees of freedom.

        Jacobi's integral of a paraboloid is of second degree in space, and not in x and y alone.
        """
        freedom = self.dynamics.degrees_of_freedom
        return freedom == 1 or self._independent() >= freedom

    def _search(self, kinds: Kinds, allowed: Allowance) -> tuple[Search, str]:
        """The linear system for the point symmetries, and what its ansatz is in words."""
        equations, isometries = self.equations, self.isometries
        times = self.time_functions
        if isometries is not None and (isometries.flat or isometries.beyond(kinds)):
            if isometries.flat:
                axes = self.listing.naming.cartesian
                found = tuple(isometries.functions)
                named = axes.X if axes is not None else ()  # x, y, z, by which charges are named
                self.cartesian = named if {*named} == {*found} else found
                self.cartesian_lead = isometries.what_they_are
            return isometries.search(times, allowed), isometries.words + times.words
        slots = point_slots(equations)
        if self.spacetime is not None:
            unknowns = quadratic_unknowns(range(len(slots)), self.spacetime.terms)
            words = "point transformations that are isometries of space and time"
            return Search(equations, slots, unknowns, allowed), words
        if self.killing is not None:
            words = self.killing.words + times.words
            return self.killing.search(equations, times, allowed), words
        spaces, whole = affine(kinds), has_all_products(kinds)
        if kinds.powers:
            times = replace(times, others=(*times.others, self.system.t**3))
        # of L = T - V the terms of third degree leave tau a function of t
        fixed = self.quadratic_mass and (self.canonical or not kinds.exponentials)
        while True:
            unknowns = point_unknowns(slots, times, spaces, time_with_space=not fixed)
            if len(unknowns) <= MOST_UNKNOWNS or len(spaces) == 1:
                break
            spaces, whole = spaces[: len(spaces) // 2], False
        what = "point transformations" if self.canonical else "integrating factors"
        words = f"{what} {in_words(spaces, kinds)}{'' if whole else ', not all products of such'}"
        return Search(equations, slots, unknowns, allowed), words + times.words

    def _points(self) -> None:
        allowed = self.allowed.part(0.7)
        constraints = self.dynamics.constraints.equations
        search, words = self._search(self.coordinate_kinds, allowed)
        self.words.append(words)
        if self.time_functions.lacking:
            self.words.append(
                "symmetries with the exponents of the linear equations were not sought where no "
                "closed form was found for these"
            )
        if self.time_functions.unsolved:
            self.stopped.append(
                "symmetries made of the solutions of the linear part, whose coefficients change, "
                "were not sought: no elementary formula was found for them"
            )
        transformations = self.transformations(search)
        centre = centre_of(transformations, self.system, self.coordinate_kinds.lengths)
        if len(centre) > 1:  # rotations about it are mixed where they are counted from 0
            search, _ = self._search(replace(self.coordinate_kinds, centre=centre), allowed)
            transformations = self.transformations(search)
        if search.unsolved:
            self.stopped.append(
                f"{more(search.unsolved, 'symmetry')} there, whose coefficients were not solved"
            )
        transformations.reverse()
        transformations = with_one_stretching(transformations, self.system)
        transformations = centralized(transformations, self.system, allowed, self.cartesian)
        if constraints:
            self._of_lagrangian = transformations
            if not self.dynamics.without_reactions:
                transformations = tangent(transformations, self.dynamics, allowed)
        lengths = self.isometries.translated if self.isometries else ()
        unproved = []
        for transformation in transformations:
            allowed.check()
            charge = point.charge_of(self.noether, transformation, allowed, lengths)
            if charge is None:
                unproved.append(transformation)
            elif is_zero(charge.charge) is True:
                self.unproved = _UNPROVED
            else:
                self.listing.add([charge])
        for transformation in unproved:
            charge = Products(self.noether, self.point_charges, allowed).charge_of(transformation)
            if charge is None:
                self.unproved = _UNPROVED
            else:
                self.listing.add([charge])
        if self.partial is not None:
            self.listing.add(self._new(self.of_partial(self.partial, allowed)))
        self.stopped += [self.unproved] if self.unproved else []
        if not (constraints or self.canonical):
            self.listing.add(self._new([*point.with_integrating_factors(self.noether, allowed)]))
        if not constraints:
            self.listing.rebase(lambda charges: without_time(charges, self.system, allowed))

    def _on_surface(self) -> None:
        self.momentum_equations = search_on_surface(self, self._of_lagrangian)

    def _hidden(self) -> None:
        if len(self.system.q) < 2 or not self.canonical:
            return
        if not self.quadratic_mass:
            new, naming = self._new([*energies_of_parts(self.noether)]), self.listing.naming
            self.listing.add_hidden((naming.of_mode(c.transformation.changes), c) for c in new)
            if self.system.t not in self.equations_symbols:
                self._at_fixed_values()
            return
        if len(self.system.q) > _MOST_FOR_TENSORS:
            return
        still = self.system.t not in self.equations_symbols
        if not (still and self._by_killing_vectors()):
            self.degree = 2
            integrals = QuadraticIntegrals(
                self.noether, self.equations, self.centred_kinds, self.allowed, self.isometries
            )
            self.words.append(f"{_SECOND} without explicit time, {integrals.words}")
            if not integrals.functions:
                self.stopped.append("there are too many coordinates for the second degree")
                return
            self._keep(integrals.found(self.charges))
            self._say_unproved(integrals.unproved)
            if still and self.isometries is None:
                self._at_fixed_values()
        timed = self.timed(self.time_functions, self.allowed)
        if timed is not None and timed.functions:
            self.degree = 2
            functions = "with the same functions of time in the coefficients"
            self.words.append(f"also {functions}")
            self._keep(timed.found(self.charges))
            self._say_unproved(timed.unproved)

    def timed(self, times: TimeFunctions, allowed: Allowance) -> TimedIntegrals | None:
        """The search for integrals of second degree with these functions of time, if there is."""
        in_lengths = not (self.isometries or self.coordinate_kinds.angles)
        if not (self.flat or in_lengths):
            return None
        if not TimedIntegrals.apply(self.equations, self.point_charges):
            return None
        kinds = self.centred_kinds
        return TimedIntegrals(self.noether, self.equations, kinds, times, self.flat, allowed)

    def _of_higher_degree(self) -> None:
        """Those of third degree beyond the known, and of fourth while fewer than n commute.

        At most 2 n - 1 without the time are independent.
        """
        if not (self.canonical and self.quadratic_mass and self.fixed_charges):
            return
        n = len(self.system.q)
        if self._independent() >= 2 * n - 1:
            return
        frame = KillingFrame.of(self.equations, self.isometries)
        if frame is None and len(self.fixed_charges) < n:
            frame = KillingFrame.found(self.equations, self.coordinate_kinds, self.allowed)
        for degree in frame.degrees if frame else ():
            if frame is None or (degree > 3 and self._in_involution() >= n):
                return
            self.degree = degree
            made = " made of Killing vectors of T" if frame.accelerations else ""
            self.words.append(
                f"of degree {degree}{made}, with the terms of V and of its gradient times "
                "monomials in the lower parts"
            )
            found = self._of_frame(frame, degree)
            for charge in sorted(found, key=lambda c: sympy.count_ops(c.charge)):
                if self._independent(charge) > self._independent():
                    self.listing.add_hidden([("", charge)])

    def _independent(self, *more: NoetherCharge) -> int:
        """How many charges without the time are independent."""
        charges = [c.charge for c in (*self.fixed_charges, *more)]
        return rank_on_surface(self.dynamics, charges) or len(charges)

    def _is_integrable(self) -> bool:
        """Whether enough charges commute already: what is not found then decides nothing."""
        return (
            self.canonical
            and not self.dynamics.constraints.equations
            and bool(self.fixed_charges)
            and self._in_involution() >= len(self.system.q)
        )

    def _in_involution(self) -> int:
        """How many functions of the charges without the time commute."""
        charges = [c.charge for c in self.fixed_charges]
        brackets = ChargeBrackets(charges, self.dynamics, Allowance())
        with suppress(NoState):
            found = brackets.functions_in_involution(range(len(charges)))
            return brackets.in_involution(range(len(charges))) if found is None else found
        return 0

    def _by_killing_vectors(self) -> bool:
        """Those of T of constant curvature, which are all; else of T without a factor w(q)."""
        equations, what = self.equations, _SECOND
        if is_gyroscopic(equations):
            return False
        if self.isometries is None:
            for frame in KillingFrame.without_factor(equations, self.allowed):
                self.words.append(f"{what} from Killing vectors of T without a common factor")
                self._keep(((), charge) for charge in self._of_frame(frame, 2))
            return False
        self.degree = 2
        self.words.append(f"all {what} without explicit time")
        whole = KillingFrame.of(equations, self.isometries)
        assert whole is not None
        fields = [*self._symmetries(), *whole.fields]
        chosen = Relation(fields, self.system.q, self.allowed).independent()
        whole = replace(whole, fields=[fields[k] for k in chosen])
        self._keep(((), charge) for charge in self._of_frame(whole, 2))
        return True

    def _of_frame(self, frame: KillingFrame, degree: int) -> list[NoetherCharge]:
        integrals = KillingIntegrals(self.noether, self.equations, frame, degree, self.allowed)
        found = integrals.found(self.charges)
        self._say_unproved(integrals.unproved)
        if integrals.unsolved:
            there = more(integrals.unsolved, "first integral")
            self.stopped.append(f"{there} there, whose coefficients were not solved")
        return found

    def _say_unproved(self, number: int) -> None:
        if number:
            there = more(number, "first integral")
            self.stopped.append(f"{there} there, of whose part at rest no formula was found")

    def _at_fixed_values(self) -> None:
        """Of a relativistic L, of T = w(q) T0 in a field, else of R without cyclic coordinates."""
        if has_fixed_energy(self.system):
            return
        energy = "also at a fixed energy, "
        if not self.quadratic_mass:
            self._of_whole(
                relativistic(self.system),
                energy + "of second degree in the momenta without explicit time",
            )
            return
        if is_gyroscopic(self.equations):
            known = [w for w in known_factors(self.equations) if w != 1]
            factors = known or common_factors(self.equations)
            energies = (at_fixed_energy(self.system, w) for w in factors)
            if self._of_whole(energies, energy + "T without a common factor"):
                return
        if self._independent() < 2 * len(self.system.q) - 1:
            momenta = at_fixed_momenta(self.noether, self.equations)
            self._of_whole(momenta, "also without cyclic coordinates, at fixed momenta")

    def _of_whole(self, problems: Iterable[FixedValues], words: str) -> bool:
        """Whether integrals were found at fixed values of constants that give new ones."""
        for fixed in problems:
            there = self._search_of(fixed.problem)
            hidden = [c for c in there.fixed_charges if c in there.hidden_charges]
            found = list(fixed.of_whole(self.noether, hidden))
            self.words.append(words)
            if found:
                new = self._new(found, products_of_two([c.charge for c in self.charges]))
                self.listing.add_hidden((charge.name, charge) for charge in new)
                return True
        return False

    def _new(
        self, found: Sequence[NoetherCharge], products: Sequence[Expr] = ()
    ) -> tuple[NoetherCharge, ...]:
        """Those that are no combinations of what is known, and of products of it."""
        known = [*(c.charge for c in self.charges), *products]
        return new_charges(known, found, self.dynamics, self.allowed)

    def _symmetries(self) -> list[tuple[Expr, ...]]:
        """Killing vectors that V admits: their products, which are nothing new, stand alone."""
        moving = (self.system.t, *self.system.qdot)
        given = (c.transformation for c in self.point_charges)
        return [x.changes for x in given if x.displaces_without(moving)]

    def _keep(self, found: Iterable[tuple[Slots, NoetherCharge]]) -> None:
        """Add what is found, with names."""
        naming = HiddenNames(self.system, self.equations, self.axes(self.centred_kinds))
        named = self._with_energies_of_modes(
            [(*naming.of(functions, charge), charge) for functions, charge in found]
        )
        named.sort(key=lambda each: (not each[0], each[0]))
        self.listing.add_hidden((name, times(charge, factor)) for name, factor, charge in named)

    def _with_energies_of_modes(self, named: list[Named]) -> list[Named]:
        """Energies of modes for as many products of point charges, unnamed or as p_x p_y."""
        products = Products(self.noether, self.point_charges, self.allowed)
        plain = [each for each in named if not each[0] or each[0].startswith("p_")]
        nameless = [each for each in plain if products.includes(each[2])]
        kept = [each for each in named if each not in nameless]
        known = [*self.fixed_charges, *(charge for _, _, charge in kept)]
        modes = products.modes(known)[: len(nameless)] if nameless else []
        if len(modes) < len(nameless):
            return named
        naming = self.listing.naming
        return kept + [(naming.of_mode(c.transformation.changes), sympy.S.One, c) for c in modes]
