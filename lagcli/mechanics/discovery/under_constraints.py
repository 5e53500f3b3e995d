"""The search on a constraint surface: which terms, in which order, with which names."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.admissible import Vector, admissible_fields
from lagcli.mechanics.discovery.ansatz import TimeFunctions, affine, quadratic
from lagcli.mechanics.discovery.constrained import rank_on_surface
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.momentum_equation import Momenta, MomentumEquations
from lagcli.mechanics.discovery.scaling import bare_terms, scaled
from lagcli.mechanics.discovery.surface import independent_on_surface
from lagcli.mechanics.discovery.surface_integrals import Integral, IntegralTerm, SurfaceIntegrals
from lagcli.mechanics.discovery.turning_momenta import squares_of_velocities, turning, with_factors
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.record import replace as changed

_MOST_LINEAR = 420  # measured: at most 314
_MOST_QUADRATIC = 300
_MOST_BESIDE = 16  # linear terms beside those of second degree
_ENERGY = (-1,)  # the mark of T, which is no pair of fields


class UnderConstraints:
    """What is found on the surface beyond the symmetries of L that are tangent to it.

    Attributes
    ----------
    unsolved : int
        Integrals that are there, whose coefficients were not found.
    timed : bool
        Whether displacements of constant momenta, or of x', were given functions of the time.
    """

    def __init__(
        self, noether: Noether, kinds: Kinds, times: TimeFunctions, allowed: Allowance
    ) -> None:
        self.noether = noether
        self.system = noether.system
        self.dynamics = noether.dynamics
        self.kinds = changed(
            kinds, lengths=list(kinds.lengths), angles=list(kinds.angles), radii=list(kinds.radii)
        )
        self.times = times
        self.allowed = allowed
        self.unsolved = 0
        self.timed = False
        self._same: list[Expr] = []
        self.fields = admissible_fields(self.dynamics, allowed)
        self._of_lengths = self._by_lengths()

    def momenta(
        self, symmetries: Sequence[Transformation], known: Sequence[NoetherCharge]
    ) -> Momenta:
        """Momenta along admissible symmetries of L, beyond the known ones that are constant."""
        relations = self.dynamics.constraints.relations
        curved = relations is not None and any(
            not f.free_symbols & set(self.system.qdot) for f in relations.remaining
        )
        if curved or not self.dynamics.constraints.nonholonomic:
            return Momenta([], [])
        moving = (self.system.t, *self.system.qdot)
        given = (c.transformation for c in known)
        constant = [x.changes for x in given if x.displaces_without(moving)]
        equations = MomentumEquations(self.noether, symmetries, self.fields, self.allowed)
        return equations.found(constant)

    def new(self, known: Sequence[Expr], more: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Those of `more` that are independent of the known ones on the surface."""
        charges = [*known, *(c.charge for c in more)]
        kept = independent_on_surface(charges, self.dynamics, self.allowed, self._same)
        return [more[k - len(known)] for k in kept if k >= len(known)]

    # -- of the coordinates alone ------------------------------------------------------------

    def integrated(self) -> list[NoetherCharge]:
        """What velocity constraints keep constant by themselves; a coordinate less for each.

        What holonomic constraints keep constant tells the components of their surface
        apart: from then on one of them is searched.
        """
        kinds = self.dynamics.constraints.kinds.values()
        holonomic = all(kind == "holonomic" for kind in kinds)
        relations = self.dynamics.constraints.relations
        if holonomic and (relations is None or len(relations.remaining) < 4):
            return []  # a single surface f = 0
        one = sympy.S.One
        functions = self._still([one]) if holonomic else [*self.kinds.lengths, *self.kinds.angles]
        found = self._charges(
            self._integrals([IntegralTerm((), one, g) for g in functions if g != 1], [])
        )
        if holonomic:
            self._same = [c.charge for c in found]
            return []
        for charge in found:
            solved = next(x for x in reversed(self.system.q) if x in charge.charge.free_symbols)
            for group in (self.kinds.lengths, self.kinds.angles, self.kinds.radii):
                if solved in group:
                    group.remove(solved)
        return found

    # -- first degree -----------------------------------------------------------------------

    def linear(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Integrals of first degree in the velocities, with the energy as it stands."""
        values = [c.charge for c in known]
        found = self._charges(self._integrals(self._linear_terms(), values))
        along = self._displacements([*known, *found])
        self.timed = bool(along)
        if along:
            values += [c.charge for c in found]
            terms = self._timed_terms(len(along))
            found += self._charges(self._integrals(terms, values, [*along, *self.fields]))
        return found

    def turning(self, known: Sequence[Expr]) -> list[NoetherCharge]:
        """Linear functions of the velocities that turn into each other, made constant."""
        system, momenta = self.system, self.dynamics.lagrange.momenta
        if self.dynamics.constraints.moving:
            return []
        moved = [p - rest for p, rest in zip(momenta, self._at_rest, strict=True)]
        forms = [
            *squares_of_velocities(system.L, system.qdot),
            *system.qdot,
            *(simplify(dot(e, moved)) for e in self.fields),
        ]
        found: list[NoetherCharge] = []
        number = rank_on_surface(self.dynamics, known)
        for pair in turning(self.dynamics, forms, self.allowed):
            values = [*known, *(c.charge for c in found)]
            together = rank_on_surface(self.dynamics, [*values, *pair])
            if number != together:
                found += [c for c in map(self._linear_charge, pair) if c.verified == "exact"]
                number = rank_on_surface(self.dynamics, [*known, *(c.charge for c in found)])
        for factor, form, S in with_factors(self.dynamics, forms, self.allowed):
            values = [*known, *(c.charge for c in found)]
            if rank_on_surface(self.dynamics, [*values, factor * form - S]) != number:
                charge = self._linear_charge(simplify(factor * form), S)
                found += [charge] if charge.verified == "exact" else []
                number = rank_on_surface(self.dynamics, [*known, *(c.charge for c in found)])
        return found

    @cached_property
    def _at_rest(self) -> list[Expr]:
        """The momenta without velocities."""
        still = dict.fromkeys(self.system.qdot, sympy.S.Zero)
        return [p.xreplace(still) for p in self.dynamics.lagrange.momenta]

    def _linear_charge(self, form: Expr, S: Expr = sympy.S.Zero) -> NoetherCharge:
        """w - S of a linear function of the velocities: p.eta without its part at rest is w."""
        form, S = scaled((form, S), set(self.system.parameters))
        tangent = Transformation(self._tangent(form), sympy.S.Zero)
        gauge = dot(self._at_rest, tangent.changes) + S
        charge = self.noether.charge("", "discovered", tangent, gauge)
        return changed(charge, charge=form - S if charge.conserved else charge.charge)

    def _displacements(self, known: Sequence[NoetherCharge]) -> list[Vector]:
        """Admissible ones with angles along which a momentum is constant, or those of lengths.

        A ball that rolls straight on has x - x' t, whose displacement is that of its momentum
        with the factor t: of the fields themselves it is a combination with angles and the time.
        Under a spring its x' has no rate with angles, and x' cos(w t) + w x sin(w t) is constant.
        """
        angles = set(self.kinds.angles)
        moving = {self.system.t, *self.system.qdot}
        constant = [tuple(c.transformation.changes) for c in known if c.transformation.time == 0]
        found = []
        for field in dict.fromkeys([*constant, *self._of_lengths]):
            names = sympy.Tuple(*field).free_symbols
            beyond = names & angles or field in self._of_lengths
            new = beyond and field not in self.fields and not names & moving
            if new and self._is_admissible(field):
                found.append(field)
        return found

    def _is_admissible(self, field: Vector) -> bool:
        relations = self.dynamics.constraints.relations
        assert relations is not None
        equations = self.dynamics.constraints.equations
        rows = (equations[k].row for k in self.dynamics.independent_constraints)
        return all(is_zero(relations.substitute(dot(row, field))) is True for row in rows)

    def _by_lengths(self) -> dict[Vector, Expr]:
        """Those whose momenta are the x' of lengths with x'' linear in lengths and their x'."""
        motion = self.dynamics.motion
        if motion is None:
            return {}
        lengths = set(self.kinds.lengths)
        velocities = dict(zip(self.system.q, self.system.qdot, strict=True))
        others = {*self.kinds.angles, *(v for x, v in velocities.items() if x not in lengths)}
        rates = dict(zip(self.system.q, motion.accelerations, strict=True))
        moving = [*velocities, *velocities.values()]
        closed = [
            velocities[x] for x in self.kinds.lengths
            if free_of(rates[x], others) and _is_linear(rates[x], moving)
        ]  # fmt: skip
        moved = self.dynamics.constraints.moving
        fields = {self._tangent(v): v for v in closed}  # p.e = v on A q' = 0
        return {e: dot(e, self.dynamics.lagrange.momenta) for e in fields} if moved else fields

    def _timed_terms(self, number: int) -> list[IntegralTerm]:
        """Those of the first degree along the given number of displacements, timed or turned.

        The axes of space turn about those of a body: Suslov's has L_1, L_2 and all of omega.
        """
        one = sympy.S.One
        plain = [one, *self.kinds.lengths]
        times = [T for T in self.times.translations if T != 1]
        terms = [IntegralTerm((a,), T, one) for a in range(number) for T in times]
        turned = affine(self.kinds)[: _MOST_LINEAR // (2 * number)]
        terms += [IntegralTerm((a,), one, g) for a in range(number) for g in turned]
        others = range(number, number + len(self.fields))
        terms += [IntegralTerm((a,), one, g) for a in others for g in plain]
        terms += [IntegralTerm((), T, g) for T in (one, *times) for g in self._still(plain)]
        return _ordered([x for x in terms if x.fields or x.function != 1])

    def _linear_terms(self) -> list[IntegralTerm]:
        """All times with 1 and the lengths; the angles, and their products, without time."""
        one = sympy.S.One
        plain = [one, *self.kinds.lengths]
        spaces = list(dict.fromkeys([*plain, *self._of_angles(), *affine(self.kinds)]))
        times, translations = self.times.others, self.times.translations
        while True:
            timed = [T for T in times if T != 1]
            fields = range(len(self.fields))
            terms = [IntegralTerm((a,), one, g) for a in fields for g in spaces]
            terms += [IntegralTerm((a,), T, one) for a in fields for T in translations if T != 1]
            terms += [IntegralTerm((a,), T, g) for a in fields for T in timed for g in plain[1:]]
            terms += [IntegralTerm(_ENERGY, T, one) for T in times]
            terms += [
                IntegralTerm((), T, g)
                for T in times
                for g in (self._still(spaces) if T == 1 else self._still(plain))
                if not T == g == 1
            ]
            if len(terms) <= _MOST_LINEAR:
                break
            if len(times) > 3:
                times, translations = times[:3], translations[:4]
            elif len(spaces) > len(plain) + 4:
                spaces = spaces[: (len(plain) + len(spaces)) // 2]
            elif len(times) > 1:
                times = translations = times[:1]
            elif len(spaces) > 1:
                spaces = plain = spaces[: len(spaces) // 2]
            else:
                break
        return _ordered(terms)

    def _of_angles(self) -> list[Expr]:
        """Sine, cosine, cosecant and cotangent of one angle."""
        found = []
        for x in self.kinds.angles:
            found += [sympy.sin(x), sympy.cos(x)]
            if (pole := self.kinds.latitudes.get(x)) is not None:
                found += [1 / pole, pole.diff(x) / pole]
        return found

    def _still(self, spaces: Sequence[Expr]) -> list[Expr]:
        """Functions of the coordinates for S: affine ones, angles, products of two lengths."""
        x = self.kinds.lengths
        squares = [a * b for i, a in enumerate(x) for b in x[: i + 1]]
        return list(dict.fromkeys([*spaces, *self.kinds.angles, *squares]))

    # -- second degree ----------------------------------------------------------------------

    def quadratic(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Integrals of second degree without explicit time that are no products of others."""
        pairs = list(combinations_with_replacement(range(len(self.fields)), 2))
        if not pairs:
            return []
        functions = quadratic(self.kinds, _MOST_QUADRATIC // len(pairs)) or [sympy.S.One]
        one = sympy.S.One
        terms = [IntegralTerm(pair, one, g) for pair in pairs for g in functions]
        if not self._is_reversible():
            linear = affine(self.kinds)[:_MOST_BESIDE]
            terms += [IntegralTerm((a,), one, g) for a in range(len(self.fields)) for g in linear]
        terms += [IntegralTerm((), one, g) for g in self._potentials(functions)]
        return self._charges(self._integrals(_ordered(terms), self._products(known)))

    def _is_reversible(self) -> bool:
        """Whether a motion may run backwards: then terms of odd degree are apart."""
        back = {v: -v for v in self.system.qdot}
        forcing = self.noether.dynamics.lagrange.forcing
        moving = self.dynamics.constraints.moving
        return not moving and all(is_zero(f.xreplace(back) - f) is True for f in forcing)

    def of_velocities(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Integrals K_ij(q) q_i' q_j' + S: K q' is tangent only with a part along the gradients.

        Jacobi's integral of the geodesics of an ellipsoid is one,
        sum x_i^2/a_i^4 sum x_i'^2/a_i^2 (Arnold, *Mathematical Methods*, section 47).
        """
        n = len(self.system.q)
        pairs = list(combinations_with_replacement(range(n), 2))
        functions = quadratic(self.kinds, _MOST_QUADRATIC // len(pairs))
        one = sympy.S.One
        terms = [IntegralTerm((), one, g, pair) for pair in pairs for g in functions]
        terms += [IntegralTerm((), one, g) for g in self._potentials(functions)]
        return self._charges(self._integrals(_ordered(terms), self._products(known)))

    def _products(self, known: Sequence[NoetherCharge]) -> list[Expr]:
        """Known integrals without the time, and products of those of first degree."""
        fixed = [c for c in known if self.system.t not in c.charge.free_symbols]
        linear = [c.charge for c in fixed if c.transformation.time == 0]
        products = [a * b for a, b in combinations_with_replacement(linear, 2)]
        return [*(c.charge for c in fixed), *products]

    def _potentials(self, functions: Sequence[Expr]) -> list[Expr]:
        """The terms of L at rest with monomials and with the functions of the tensor."""
        q = self.system.q
        rest = self.system.L.xreplace(dict.fromkeys(self.system.qdot, sympy.S.Zero))
        terms = set(bare_terms(rest, q)) - {sympy.S.One}
        monomials = [sympy.S.One, *q, *(x * y for i, x in enumerate(q) for y in q[: i + 1])]
        # z/sqrt(x^2 + y^2) of Kepler's problem on a sphere suggests x/sqrt(x^2 + y^2)
        cores = [t / m for t in terms for m in [_monomial(t, q)] if m not in (1, t)]
        terms |= set(cores)
        made = [a * b for a in sorted(terms, key=sympy.default_sort_key)
                for b in dict.fromkeys([*monomials, *functions[:20]])]  # fmt: skip
        return [m for m in dict.fromkeys([*monomials, *functions, *made]) if not free_of(m, q)]

    # -- common -----------------------------------------------------------------------------

    def _integrals(
        self,
        terms: Sequence[IntegralTerm],
        known: Sequence[Expr],
        fields: Sequence[Vector] | None = None,
    ) -> list[Integral]:
        self._along = self.fields if fields is None else fields
        search = SurfaceIntegrals(self.noether, self._along, terms, known, self.allowed, self._same)
        found = search.found()
        self._J = [dot(e, self.dynamics.lagrange.momenta) for e in self._along]
        self.unsolved += search.unsolved
        return found

    def _charges(self, integrals: Sequence[Integral]) -> list[NoetherCharge]:
        found = []
        for integral in integrals:
            self.allowed.check()
            charge = self._charge(integral)
            if charge.conserved is True and charge.verified == "exact":
                found.append(charge)
            else:
                self.unsolved += 1
        return found

    def _charge(self, integral: Integral) -> NoetherCharge:
        """The charge of Dq = f_a e_a + g_ab (J_a e_b + J_b e_a), Dt = -c, S = -G."""
        n, momenta = len(self.system.q), self.dynamics.lagrange.momenta
        changes: list[Expr] = [sympy.S.Zero] * n
        time = gauge = form = along = sympy.S.Zero
        shorter = False
        for term, value in integral:
            c = value * term.function
            if term.velocities:
                i, k = term.velocities
                form += c * self.system.qdot[i] * self.system.qdot[k]
            elif not term.fields:
                gauge -= c
            elif term.fields == _ENERGY:
                time -= c
            elif len(term.fields) == 1:
                field = self._along[term.fields[0]]
                changes = self._moved(changes, c, field)
                along += c * self._of_lengths.get(field, dot(field, momenta))
                shorter = shorter or field in self._of_lengths
            else:
                a, b = term.fields
                changes = self._moved(changes, c * self._J[a], self._along[b])
                changes = self._moved(changes, c * self._J[b], self._along[a])
                gauge += c * self._J[a] * self._J[b]
        if form != 0:
            form, gauge = scaled((form, gauge), set(self.system.parameters))
            tangent = Transformation(self._tangent(form), sympy.S.Zero)
            charge = self.noether.charge("", "discovered", tangent, gauge + form)
            # p.eta = 2 Q on the surface, and Q is shorter as it was found
            return changed(charge, charge=simplify(form - gauge))
        if shorter:
            *changes, gauge, along = scaled((*changes, gauge, along), set(self.system.parameters))
            still = Transformation(tuple(changes), sympy.S.Zero)
            charge = self.noether.charge("", "discovered", still, gauge)
            return changed(charge, charge=simplify(along - gauge))
        *changes, gauge, time = scaled((*changes, gauge, time), set(self.system.parameters))
        if time != 0 and not time.free_symbols & {self.system.t, *self.system.q}:
            # a moving energy: Q = h + ...
            *changes, gauge, time = (simplify(-x / time) for x in (*changes, gauge, time))
        transformation = Transformation(tuple(changes), time)
        return self.noether.charge("", "discovered", transformation, gauge)

    def _tangent(self, form: Expr) -> Vector:
        """dQ/dp of a form in the velocities, without its part along the gradients.

        eta = M^-1 (dQ/dq' - A^T mu) with A eta = 0.
        """
        slopes = sympy.Matrix([form.diff(v) for v in self.system.qdot])
        return tuple(simplify(x) for x in self._projection * slopes)

    @cached_property
    def _projection(self) -> sympy.Matrix:
        """M^-1 - M^-1 A^T (A M^-1 A^T)^-1 A M^-1."""
        kept = [
            self.dynamics.constraints.equations[k] for k in self.dynamics.independent_constraints
        ]
        rows = sympy.Matrix([list(e.row) for e in kept])
        inverse = sympy.Matrix([list(r) for r in self.dynamics.lagrange.mass_matrix]).inv("ADJ")
        along = (inverse * rows.T).applyfunc(simplify)
        across = (rows * along).applyfunc(simplify).inv("ADJ").applyfunc(simplify)
        return (inverse - along * across * along.T).applyfunc(simplify)

    def _moved(self, changes: Sequence[Expr], factor: Expr, field: Vector) -> list[Expr]:
        return [x + factor * e for x, e in zip(changes, field, strict=True)]


def _is_linear(formula: Expr, variables: Sequence[Expr]) -> bool:
    """Whether it is a polynomial of first degree."""
    polynomial = formula.is_polynomial(*variables)
    return bool(polynomial and sympy.Poly(formula, *variables).total_degree() <= 1)


def _monomial(term: Expr, q: Sequence[Expr]) -> Expr:
    """The coordinates that are factors of a term, with positive powers."""
    powers = (f.as_base_exp() for f in sympy.Mul.make_args(term))
    return sympy.Mul(*(b**e for b, e in powers if b in q and e.is_positive))


def _ordered(terms: Sequence[IntegralTerm]) -> list[IntegralTerm]:
    """The simplest first."""

    def cost(term: IntegralTerm) -> tuple[int, int, int, str, tuple[int, ...]]:
        T, g = term.time, term.space
        return (
            2 * sympy.count_ops(T) + len(T.free_symbols),
            sympy.count_ops(g) + len(g.free_symbols),
            sum(term.fields) if term.fields else 9,
            str(g),
            term.fields,
        )

    return sorted(terms, key=cost)
