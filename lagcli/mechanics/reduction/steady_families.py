"""Families of steady motions: the conditions solved for one rate or momentum.

The conditions dU_eff/dq = 0 are polynomials in one rate (or momentum) u, the other quantities
given: solved for u, they are a family over the places q; a factor without u gives places for
every u.

References
----------
Whittaker, *Analytical Dynamics*, 4th ed., sections 83 and 84.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, combinations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import at, lies_in
from lagcli.algebra.positivity import deciding
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import SystemSolution, solve_system
from lagcli.algebra.vanishing_factors import divisors
from lagcli.mechanics.inequalities import never_together
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady_motion import Steady

_ROOT_COST = 6  # operations that a root is worth


class SteadyFamilies:
    """The steady motions of a reduced system.

    Parameters
    ----------
    routh
        The reduced system, on which no force acts that has no potential.
    conditions
        What vanishes on a steady motion: dU_eff/dq, or its part along the constraints, and these.

    Attributes
    ----------
    complete
        Whether each that was found holds by substitution.
    """

    def __init__(self, routh: Routh, conditions: Sequence[Expr]) -> None:
        assert routh.reduced is not None
        self.routh = routh
        self.full, self.system = routh.system, routh.reduced.system
        self.conditions = conditions
        self.complete = True

    def motions(self) -> list[Steady] | None:
        """Those of the choice of the unknown with the shortest answer; None without any."""
        solved = (self._solved(unknown, chart) for unknown, chart in self._charts())
        choices = [found for found in solved if found is not None]
        if not choices:
            return None
        best = min(choices, key=lambda found: sum(map(_cost_of, found)))
        known = [*chain(*choices)]
        whole = [self._without_poles(one, known) for one in best]
        q = self.system.q
        return [one for one in whole if not any(one.within(other, q) for other in whole)]

    def _without_poles(self, one: Steady, others: Sequence[Steady]) -> Steady:
        """The same family by another rate or momentum, which has no pole at any place.

        With p_φ = p_ψ/cos θ rotation about a diameter, p_ψ = 0 and cos θ = 0, would be left out.
        """
        if not self._poles(one):
            return one
        wider = [each for each in others if not self._poles(each) and self._contains(each, one)]
        return min(wider, key=_cost_of, default=one)

    def _poles(self, one: Steady) -> bool:
        """Whether a value is infinite somewhere."""
        values = (*one.values.values(), *(one.rates or {}).values())
        below = (d for value in values for d in divisors(value))
        return any(not free_of(d, self.system.q) and sign(d) not in (1, -1) for d in below)

    def _contains(self, family: Steady, one: Steady) -> bool:
        put_in = {**one.values, **{self.full.qdot[j]: v for j, v in (one.rates or {}).items()}}
        fixed = [{q: e.values.get(q, q) for q in self.system.q} for e in (family, one)]
        return fixed[0] == fixed[1] and lies_in(family.values, put_in)

    def _charts(self) -> Iterator[tuple[Symbol, dict[Expr, Expr]]]:
        """What to solve for, and p_c by the rate of c where the rate is what is given."""
        potential = self.routh.effective_potential
        momenta, cyclic = self.routh.momenta, self.routh.cyclic
        entering = [p for p in momenta if not all(free_of(f, [p]) for f in self.conditions)]
        for p, j in zip(momenta, cyclic, strict=True):
            if p not in entering:
                continue
            rate, slope = self.full.qdot[j], simplify(potential.diff(p))
            stiffness = simplify(slope.diff(p))
            if is_zero(stiffness) is not False or not free_of(stiffness, momenta):
                continue
            chart = {p: simplify((rate - slope.xreplace({p: S.Zero})) / stiffness)}
            yield rate, chart
            for other in entering:
                if other != p:
                    yield other, chart

    def _solved(self, unknown: Symbol, chart: Mapping[Expr, Expr]) -> list[Steady] | None:
        """All steady motions by one unknown; None where a closed form is missing."""
        conditions = [simplify(c.xreplace(dict(chart))) for c in self.conditions]
        conditions = [c for c in conditions if c != 0]
        within = [c for c in conditions if not free_of(c, [unknown])]
        if not within:
            return None
        first = min(within, key=lambda c: int(sympy.count_ops(c)))
        rest = [c for c in conditions if c is not first]
        reversing = (*self.routh.momenta, *(self.full.qdot[j] for j in self.routh.cyclic))
        found: list[Steady] = []
        for factor, power in factors_of(first):
            if power < 0 or sign(factor) in (1, -1):
                continue
            if free_of(factor, [unknown]):
                if free_of(factor, self.system.q):
                    continue
                solved = solve_system([factor, *rest], self.system.q)
                if not solved.complete:
                    return None
                for each in solved.solutions:
                    found += self._checked(each.values, chart, each.positive)
                continue
            found += self._for_any(factor, unknown, rest, chart)
            roots = solve_for(factor, unknown)
            if roots is None:
                return None
            for root, mirrored in _without_mirrors(roots.values, reversing):
                root = simplify(root)
                put_in = {unknown: root}
                others = self._others([c.xreplace(put_in) for c in rest])
                if others is None:
                    return None
                for each in (self._shortest(other, root) for other in others):
                    value = at(root, each.values)
                    values = {**each.values, unknown: value}
                    open_ = (deciding(x) for x in not_negative_where_real(value) if sign(x) != 1)
                    positive = (*each.positive, *open_)
                    found += self._checked(values, chart, positive, mirrored=mirrored)
        return found

    def _for_any(
        self, factor: Expr, unknown: Symbol, rest: list[Expr], chart: Mapping[Expr, Expr]
    ) -> Iterator[Steady]:
        """Where all coefficients of the unknown vanish: for every value of it.

        a(q, v) u + b(q, v) = 0 is solved for u where a is not 0; where a = b = 0, any u will do.
        """
        coefficients = sympy.Poly(factor, unknown).coeffs() if factor.is_polynomial(unknown) else []
        given = [v for v in self.full.qdot if any(c.has(v) for c in coefficients)]
        if not given:
            return
        solved = solve_system([*coefficients, *rest], [*self.system.q, *given])
        for each in solved.solutions:
            if any(v in each.values for v in given):
                yield from self._checked(each.values, chart, each.positive)

    def _others(self, conditions: list[Expr]) -> Sequence[SystemSolution] | None:
        """The other conditions solved for all coordinates, or for as many, the rest given."""
        q = self.system.q
        for chosen in dict.fromkeys((q, *combinations(q, len(conditions)))):
            solved = solve_system(conditions, chosen)
            if solved.complete and solved.solutions:
                return solved.solutions
        return None

    def _shortest(self, found: SystemSolution, root: Expr) -> SystemSolution:
        """The same motions with those coordinates given by which they and `root` are shortest."""
        values, q = found.values, self.system.q
        if found.positive or found.relation or all(free_of(value, q) for value in values.values()):
            return found
        relations = [simplify(x - value) for x, value in values.items()]
        charts = [found]
        for chosen in combinations(q, len(values)):
            solved = solve_system(relations, chosen)
            if solved.complete and len(solved.solutions) == 1:
                charts += (each for each in solved.solutions if not each.positive)
        return min(charts, key=lambda c: sum(map(_cost, (*c.values.values(), at(root, c.values)))))

    def _checked(
        self,
        values: Mapping[Symbol, Expr],
        chart: Mapping[Expr, Expr],
        positive: Sequence[Expr],
        *,
        mirrored: bool = False,
    ) -> list[Steady]:
        """The motion with its momenta and rates, put into the conditions and q' = dU_eff/dp."""
        state = {q: values[q] for q in self.system.q if q in values}
        rates_given = {v: values[v] for v in self.full.qdot if v in values}
        momenta = {p: values[p] for p in self.routh.momenta if p in values}
        try:
            for p, by_rate in chart.items():
                momenta[p] = at(by_rate.xreplace({**momenta, **rates_given}), state)
            whole = {**state, **momenta}
            if not self.routh.regular_at(state) or never_together(positive):
                return []
            if not all(is_zero(at(c, whole)) is True for c in self.conditions):
                self.complete = False
                return []
            rates = self.routh.rates_at(whole)
            if any(x.has(sympy.I) for x in (*whole.values(), *rates.values())):
                return []
            for j, rate in rates.items():
                given = values.get(self.full.qdot[j])
                if given is not None and is_zero(rate - given) is True:
                    rates[j] = given
            return [Steady(whole, rates, tuple(positive), mirrored)]
        except ZeroDivisionError:
            return []


def _cost_of(motion: Steady) -> int:
    return sum(map(_cost, motion.values.values()))


def _cost(value: Expr) -> int:
    powers = value.atoms(sympy.Pow)
    roots = sum(1 for power in powers if power.exp.is_Rational and power.exp.q > 1)
    return int(sympy.count_ops(value)) + _ROOT_COST * roots


def _without_mirrors(
    roots: Sequence[Expr], reversing: Sequence[Symbol]
) -> Iterator[tuple[Expr, bool]]:
    """The roots, and whether x stands for -x, too: with all momenta and rates reversed.

    x(p) and -x(-p) are the same motion run backwards.  For x(-p) = x(p) that is the root -x(p);
    any other x needs both roots.
    """
    reversal = {symbol: -symbol for symbol in reversing}
    mirrored: list[Expr] = []
    for root in sorted(roots, key=lambda root: bool(root.could_extract_minus_sign())):
        if any(is_zero(root + other) is True for other in mirrored):
            continue
        opposite = any(is_zero(root + other) is True for other in roots if other is not root)
        even = opposite and is_zero(root - root.xreplace(reversal)) is True
        if even:
            mirrored.append(root)
        yield root, even
