"""Bracketing: common factors of some terms written once.

p = a*A + B with the terms that hold an atom a put together, again inside A and B; which
atom comes first is decided by the number of operations of the result.
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd, lcm

from flint import Ordering, fmpz_mpoly_ctx

from lagcli.algebra.shaping.atoms import Atoms, Exponent, Term, Terms, multiply
from lagcli.algebra.shaping.plan import Product, Sum, product, total

_MAX_FACTORED = 400  # terms
_EFFORT = 400  # groups in which several atoms are tried


class Grouper:
    """Plans for sums of products of atoms, the shortest that a bounded search finds."""

    def __init__(self, atoms: Atoms) -> None:
        self.atoms = atoms
        self._memo: dict[tuple[frozenset[tuple[Term, Fraction]], bool], Product | Sum] = {}
        self._effort = _EFFORT

    def group(self, terms: Terms, *, spread: bool = False) -> Product | Sum:
        """The plan of a sum.

        Parameters
        ----------
        spread
            Whether terms may keep denominators of their own.
        """
        self._effort = _EFFORT
        return self._group(terms, spread)

    def _group(self, terms: Terms, spread: bool) -> Product | Sum:
        key = (frozenset(terms.items()), spread)
        known = self._memo.get(key)
        if known is None:
            known = self._memo[key] = self._search(terms, spread)
        return known

    def _search(self, terms: Terms, spread: bool) -> Product | Sum:
        if len(terms) == 1:
            (term, coefficient), = terms.items()
            return product(self.atoms, coefficient, list(term))
        common, number, inner = _content(terms, spread)
        if common or number != 1:
            return self._times(number, common, inner, spread)
        if len(terms) >= 3:
            factored = self._factored(inner)
            if factored is not None:
                return factored
        best: Product | Sum = total([product(self.atoms, c, list(t)) for t, c in inner.items()])
        for with_atom, without in self._splits(inner):
            parts: list[Product] = []
            for half in (with_atom, without):
                plan = self._group(half, spread)
                parts.extend(plan.terms if isinstance(plan, Sum) else (plan,))
            candidate = total(parts)
            if candidate.cost < best.cost:
                best = candidate
        return best

    def _times(self, number: Fraction, common: Term, inner: Terms, spread: bool) -> Product | Sum:
        plan = self._group(inner, spread)
        if isinstance(plan, Product):
            parts: list[tuple[int | Sum, Exponent]] = [*common, *plan.parts]
            return product(self.atoms, number * plan.coefficient, parts)
        return product(self.atoms, number, [*common, (plan, 1)])

    def _splits(self, terms: Terms) -> list[tuple[Terms, Terms]]:
        """Terms with an atom and terms without it, the most promising atoms first."""
        counts: dict[tuple[int, bool], int] = {}
        for term in terms:
            for atom, exponent in term:
                key = (atom, exponent > 0)
                counts[key] = counts.get(key, 0) + 1
        weighed = sorted(
            ((n - 1) * (1 + self.atoms.costs[atom]), n, -atom, atom, positive)
            for (atom, positive), n in counts.items()
            if 1 < n
        )
        weighed.reverse()
        width = 4 if len(terms) <= 6 else 3 if len(terms) <= 12 else 2 if len(terms) <= 30 else 1
        if self._effort <= 0:
            width = 1
        splits = []
        for *_, atom, positive in weighed[:width]:
            self._effort -= 1
            with_atom: Terms = {}
            without: Terms = {}
            for term, value in terms.items():
                holds = any(a == atom and (e > 0) == positive for a, e in term)
                (with_atom if holds else without)[term] = value
            if without:
                splits.append((with_atom, without))
        return splits

    def _factored(self, terms: Terms) -> Product | None:
        """The product of the irreducible factors, None when there is only one."""
        if len(terms) > _MAX_FACTORED:
            return None
        scales: dict[int, int] = {}
        lows: dict[int, Exponent] = {}
        for term in terms:
            for atom, exponent in term:
                scales[atom] = lcm(scales.get(atom, 1), Fraction(exponent).denominator)
                lows[atom] = min(lows.get(atom, 0), exponent)
        if any(low < 0 for low in lows.values()):
            return None
        used = sorted(scales)
        context = fmpz_mpoly_ctx.get([f"a{a}" for a in used], Ordering.lex)
        common = lcm(*(v.denominator for v in terms.values()))
        data = {}
        for term, value in terms.items():
            exponents = dict(term)
            key = tuple(int(exponents.get(a, 0) * scales[a]) for a in used)
            data[key] = int(value * common)
        content, factors = context.from_dict(data).factor()
        if len(factors) == 1 and int(factors[0][1]) == 1:
            return None
        parts: list[tuple[int | Sum, Exponent]] = []
        number = Fraction(int(content), common)
        for factor, exponent in factors:
            inner: Terms = {}
            for key, value in factor.to_dict().items():
                term = tuple(
                    (a, _exact(Fraction(int(e), scales[a])))
                    for a, e in zip(used, key, strict=True)
                    if e
                )
                inner[term] = Fraction(int(value))
            plan = self._group(inner, spread=False)
            if isinstance(plan, Sum):
                parts.append((plan, int(exponent)))
            else:
                number *= plan.coefficient ** int(exponent)
                parts.extend((p, e * int(exponent)) for p, e in plan.parts)
        return product(self.atoms, number, parts)


def _exact(value: Fraction) -> Exponent:
    return value.numerator if value.denominator == 1 else value


def _content(terms: Terms, spread: bool) -> tuple[Term, Fraction, Terms]:
    """A common product of atoms, a common number, and what is left of the terms."""
    shared: dict[int, tuple[Exponent, Exponent, int]] = {}
    for term in terms:
        for atom, exponent in term:
            low, high, count = shared.get(atom, (exponent, exponent, 0))
            shared[atom] = (min(low, exponent), max(high, exponent), count + 1)
    common: list[tuple[int, Exponent]] = []
    for atom, (low, high, count) in shared.items():
        everywhere = count == len(terms)
        if low > 0:
            if everywhere:
                common.append((atom, low))
        elif not spread:
            common.append((atom, low))
        elif high < 0 and everywhere:
            common.append((atom, high))
    number = _number(list(terms.values()))
    common.sort()
    inverse = tuple((atom, -exponent) for atom, exponent in common)
    inner = {multiply(term, inverse): value / number for term, value in terms.items()}
    return tuple(common), number, inner


def _number(values: list[Fraction]) -> Fraction:
    """The common number whose extraction leaves the fewest numbers to write."""
    above = gcd(*(v.numerator for v in values))
    candidates = [
        Fraction(1),
        Fraction(above, lcm(*(v.denominator for v in values))),
        Fraction(above, gcd(*(v.denominator for v in values))),
    ]

    def written(value: Fraction) -> int:
        return (abs(value.numerator) != 1) + (value.denominator != 1)

    return min(candidates, key=lambda c: written(c) + sum(written(v / c) for v in values))
