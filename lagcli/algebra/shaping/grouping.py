"""Bracketing: common factors of some terms written once.

p = a*A + B with the terms that hold an atom a put together, again inside A and B; which
atom comes first is decided by the number of operations of the result.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import chain, combinations
from math import isqrt, lcm

from flint import Ordering, fmpz_mpoly_ctx

from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.shaping.atoms import Atoms, Coefficient, Exponent, Term, Terms, exact, multiply
from lagcli.algebra.shaping.kernels import Integers, common_brackets, content
from lagcli.algebra.shaping.plan import PlannedProduct, PlannedSum, product, total

_MAX_FACTORED = 400  # terms
_MAX_PLAIN = 10  # terms that may be left without any bracket
_MAX_SHORTENED = 12  # terms
_SHORTENINGS = 20  # attempts
_MIN_KERNEL = 5  # terms among which (a + b)*(c + d) + rest is looked for
_MAX_KERNEL = 60  # measured: up to 310
_FORM = 1.25  # times as long a quadratic form in the momenta may be, its terms in order
_RATES = 1  # operations that a sum may have more, its terms collected by velocities
_EFFORT = 400  # splits that are tried in all; then the most promising one only


class Grouper:
    """Plans for sums of products of atoms, the shortest that a bounded search finds."""

    def __init__(self, atoms: Atoms, shorter: Callable[[Poly], Poly | None] | None) -> None:
        self.atoms = atoms
        self._shorter = shorter
        self._shortenings = _SHORTENINGS
        self._memo: dict[tuple[frozenset[tuple[Term, int]], bool], PlannedProduct | PlannedSum] = {}
        self._left = _EFFORT
        self._effort = 0

    def renew(self) -> None:
        """The full effort for another formula."""
        self._left, self._shortenings = _EFFORT, _SHORTENINGS

    def group(self, terms: Terms, *, spread: bool = False) -> PlannedProduct | PlannedSum:
        """The plan of a sum.

        Parameters
        ----------
        spread
            Whether terms may keep denominators of their own.
        """
        # later calls for the same formula get less and less
        self._effort = 10 + self._left // 3
        self._left -= self._left // 3
        before = self._effort
        common = lcm(*(v.denominator for v in terms.values()))
        integers = {t: v.numerator * (common // v.denominator) for t, v in terms.items()}
        plan = self._group(integers, spread)
        self._left += max(0, min(self._effort, before - 10))
        return plan if common == 1 else self._scaled(Fraction(1, common), plan)

    def _scaled(
        self, number: Fraction, plan: PlannedProduct | PlannedSum
    ) -> PlannedProduct | PlannedSum:
        if isinstance(plan, PlannedProduct):
            return product(self.atoms, number * plan.coefficient, list(plan.parts))
        outside = product(self.atoms, number, [(plan, 1)])
        inside = total(
            [product(self.atoms, number * t.coefficient, list(t.parts)) for t in plan.terms]
        )
        return inside if inside.score < outside.score else outside

    def _group(self, terms: Integers, spread: bool) -> PlannedProduct | PlannedSum:
        key = (frozenset(terms.items()), spread)
        known = self._memo.get(key)
        if known is None:
            known = self._memo[key] = self._search(self._shortened(terms), spread)
        return known

    def _shortened(self, terms: Integers) -> Integers:
        """The sum by a shorter one where relations allow that: x² + y² by l²."""
        if self._shorter is None or not 1 < len(terms) <= _MAX_SHORTENED:
            return terms
        self._shortenings -= 1
        if self._shortenings < 0:
            return terms
        poly = self.atoms.polynomial(terms)
        other = None if poly is None else self._shorter(poly)
        if other is None or other == 0:
            return terms
        return {t: int(v) for t, v in self.atoms.terms(other).items()}

    def _search(self, terms: Integers, spread: bool) -> PlannedProduct | PlannedSum:
        if not terms:  # what the angles' relations leave nothing of
            return product(self.atoms, 0, [])
        if len(terms) == 1:
            ((term, coefficient),) = terms.items()
            return product(self.atoms, coefficient, list(term))
        common, number, inner = content(terms, spread)
        if common or number != 1:
            return self._times(number, common, inner, spread)
        if len(terms) >= 3:
            factored = self._factored(inner)
            if factored is not None:
                return factored
        splits = self._splits(inner)
        best: PlannedSum | None = None
        if len(inner) <= _MAX_PLAIN or not splits:
            best = total([product(self.atoms, c, list(t)) for t, c in inner.items()])
        for with_atom, without in splits:
            parts: list[PlannedProduct] = []
            for half in (with_atom, without):
                plan = self._group(half, spread)
                parts.extend(plan.terms if isinstance(plan, PlannedSum) else (plan,))
            candidate = total(parts)
            if best is None or candidate.score < best.score:
                best = candidate
        assert best is not None
        for degree in (2,) if self._of_forms(inner) else (1,):
            form = self._collected(inner, self.atoms.is_momentum, spread, degree)
            if form is not None and form.cost <= _FORM * best.cost:
                return form
        form = self._collected(inner, self.atoms.is_rate, spread, 2, others=True)
        return best if form is None or form.cost > best.cost + _RATES else form

    def _collected(
        self,
        terms: Integers,
        kind: Callable[[int], bool],
        spread: bool,
        degree: int,
        *,
        others: bool = False,
    ) -> PlannedSum | None:
        """A form a p_x² + b p_x p_y + c p_y² with each of the three collected, or a p_x + b p_y.

        With `others` beside terms without any: (a² − b²) u'² + (m + M) g.
        """
        groups: dict[Term, Integers] = {}
        for term, value in terms.items():
            group = tuple(pair for pair in term if kind(pair[0]))
            groups.setdefault(group, {})[term] = value
        few = len(groups) < (2 if others else degree + 1) or len(groups) == len(terms)
        if few or (() in groups) != others:
            return None
        if any(sum(e for _, e in group) != degree for group in groups if group):
            return None  # c (x' − y') stays together
        plans = [self._group(each, spread) for each in groups.values()]
        parts = [plan for plan in plans if isinstance(plan, PlannedProduct)]
        return total(parts) if len(parts) == len(plans) else None

    def _times(
        self, number: int, common: Term, inner: Integers, spread: bool
    ) -> PlannedProduct | PlannedSum:
        plan = self._group(inner, spread)
        if isinstance(plan, PlannedProduct):
            parts: list[tuple[int | PlannedSum, Exponent]] = [*common, *plan.parts]
            return product(self.atoms, number * plan.coefficient, parts)
        return product(self.atoms, number, [*common, (plan, 1)])

    def _splits(self, terms: Integers) -> list[tuple[Integers, Integers]]:
        """Terms with an atom and terms without it, the most promising atoms first."""
        counts: dict[tuple[int, bool], int] = {}
        for term in terms:
            for atom, exponent in term:
                key = (atom, exponent > 0)
                counts[key] = counts.get(key, 0) + 1
        whole = self._of_forms(terms)
        weighed = sorted(
            ((n - 1) * (1 + self.atoms.costs[atom]), n, -atom, atom, positive)
            for (atom, positive), n in counts.items()
            if n > 1 and atom not in whole
        )
        weighed.reverse()
        width = 4 if len(terms) <= 6 else 3 if len(terms) <= 12 else 2 if len(terms) <= 30 else 1
        if self._effort <= 0:
            width = 1
        splits = self._squares(terms) if len(terms) <= _MAX_SHORTENED else []
        kernels = self._effort > 0 and _MIN_KERNEL <= len(terms) <= _MAX_KERNEL
        halves = []
        for *_, atom, positive in weighed if kernels else weighed[:width]:
            with_atom: Integers = {}
            without: Integers = {}
            for term, value in terms.items():
                holds = any(a == atom and (e > 0) == positive for a, e in term)
                (with_atom if holds else without)[term] = value
            if without:
                halves.append((with_atom, without))
        if kernels:
            splits.extend(common_brackets(halves))
        self._effort -= len(halves[:width])
        return splits + [half for half in halves[:width] if half not in splits]

    def _of_forms(self, terms: Integers) -> set[int]:
        """The variables of a x² + b x y + c y², of which none is to be taken out."""
        variables = [[p for p in term if self.atoms.is_variable(p[0])] for term in terms]
        squares = {a for pairs in variables for a, exponent in pairs if exponent == 2}
        linear = [[a for a, e in pairs if e == 1 and a in squares] for pairs in variables]
        return {atom for each in linear if len(each) > 1 for atom in each}

    def _squares(self, terms: Integers) -> list[tuple[Integers, Integers]]:
        """Squares (u ± v)² and (u ± v ± w)², written out among the terms, apart from the rest."""
        roots: dict[bool, list[tuple[Term, int, Term]]] = {True: [], False: []}  # by their sign
        for term, value in terms.items():
            root = isqrt(abs(value))
            if root * root == abs(value) and all(e % 2 == 0 for _, e in term):
                roots[value > 0].append((tuple((a, e // 2) for a, e in term), root, term))
        found = []
        for count in (3, 2):
            for chosen in chain(*(combinations(each, count) for each in roots.values())):
                square = {own: terms[own] for *_, own in chosen}
                for (u, a, _), (v, b, _) in combinations(chosen, 2):
                    mixed = multiply(u, v)
                    if abs(terms.get(mixed, 0)) == 2 * a * b:
                        square[mixed] = terms[mixed]
                if len(square) == count * (count + 1) // 2 < len(terms):
                    found.append((square, {t: c for t, c in terms.items() if t not in square}))
        return found

    def _factored(self, terms: Integers) -> PlannedProduct | None:
        """The product of the irreducible factors, None when there is only one."""
        if len(terms) > _MAX_FACTORED:
            return None
        below, number, terms = content(terms, spread=False)
        if any(exponent > 0 for _, exponent in below):
            return None
        scales: dict[int, int] = {}
        powers: dict[int, Exponent] = {}  # added up over the terms
        for term in terms:
            for atom, exponent in term:
                powers[atom] = powers.get(atom, 0) + exponent
                if isinstance(exponent, int):
                    scales.setdefault(atom, 1)
                else:
                    scales[atom] = lcm(scales.get(atom, 1), exponent.denominator)
        if any(powers[atom] * scale == 1 for atom, scale in scales.items()):
            return None  # a*A + B with one term A has no factor but a common one
        used = {atom: position for position, atom in enumerate(sorted(scales))}
        context = fmpz_mpoly_ctx.get([f"a{a}" for a in used], Ordering.lex)
        data = {}
        for term, value in terms.items():
            exponents = [0] * len(used)
            for atom, exponent in term:
                exponents[used[atom]] = int(exponent * scales[atom])
            data[tuple(exponents)] = value
        ratio, found = factorization(context.from_dict(data))
        factors = with_squares(found)
        if len(factors) == 1 and int(factors[0][1]) == 1:
            return None
        parts: list[tuple[int | PlannedSum, Exponent]] = [*below]
        coefficient: Coefficient = int(number * ratio)
        for factor, exponent in factors:
            inner: Integers = {}
            for key, value in factor.to_dict().items():
                term = tuple(
                    (a, int(e) if scales[a] == 1 else exact(Fraction(int(e), scales[a])))
                    for a, e in zip(used, key, strict=True)
                    if e
                )
                inner[term] = int(value)
            plan = self._group(inner, spread=False)
            if isinstance(plan, PlannedSum):
                parts.append((plan, int(exponent)))
            else:
                coefficient *= plan.coefficient ** int(exponent)
                parts.extend((p, e * int(exponent)) for p, e in plan.parts)
        return product(self.atoms, coefficient, parts)


def with_squares(factors: list[tuple[Poly, int]]) -> list[tuple[Poly, int]]:
    """(c - v)(c + v) as c² - v²."""
    left = [(factor, int(exponent)) for factor, exponent in factors]
    for i, (one, exponent) in enumerate(left):
        for j in range(i + 1, len(left)):
            other, same = left[j]
            if len(one) == len(other) == 2 and exponent == same and len(one * other) == 2:
                left[i], left[j] = (one * other, exponent), (one, 0)
                break
    return [(factor, exponent) for factor, exponent in left if exponent]
