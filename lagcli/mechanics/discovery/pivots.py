"""Values of the parameters at which a linear system has more solutions than elsewhere.

The conditions on the unknown coefficients, one for each monomial in t, q and q', are reduced
exactly over the ring of the parameters.  Pivots that are numbers, or never 0, come first.
The rank can fall only where another pivot vanishes, or a factor that was common to a row;
whether it does at a root of such a factor is seen modulo a prime, at a random point of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from sympy import Expr

from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.signs import sign
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular_rank import ModularRank, Row
from lagcli.mechanics.discovery.search import Search
from lagcli.platform.effort import EFFORT

_MOST_TERMS = 80
_MOST_TERMS_OF_PAIR = 3
_MOST_PAIRED = 8


class Pivots:
    """The special factors of one search.

    Parameters
    ----------
    search
        Its conditions are taken as they are, for all its unknowns.
    allowed
        Raises TooMuchWork.
    """

    def __init__(self, search: Search, allowed: Allowance) -> None:
        self.exact = ExactSolver(search.points)
        self.field = search.points.field
        self.ring = self.field.ring
        self.allowed = allowed
        columns = [search.formulas(i) for i in range(len(search.unknowns))]
        self.rows = list(self._rows(columns))
        self._rank = ModularRank(self.exact.points, self.rows, len(columns), allowed)

    def factors(self) -> list[Expr]:
        """Irreducible polynomials in the parameters at whose roots the rank is lower."""
        found = [f for f in self.candidates if self._rank.is_lower_at(f)]
        return [self.field.polynomial_to_sympy(f) for f in found if self._may_vanish(f)]

    def pairs(self) -> list[tuple[Expr, Expr]]:
        """Two that lower the rank together, and neither alone: a = b and c = 3, or b = c = 0.

        The second are the factors of the pivots where the first is solved for one symbol.
        """
        found = []
        for first in filter(self._of_pair, self.candidates[:_MOST_PAIRED]):
            solved = self._solved(first)
            if solved is None:
                continue
            put_in = [
                {k: self.ring.compose(x, solved) for k, x in row.items()} for row in self.rows
            ]
            rows = [{k: x for k, x in row.items() if x != 0} for row in put_in]
            others = filter(self._of_pair, self._candidates([row for row in rows if row]))
            found += [(first, x) for x in others if self._rank.is_lower_at_both(first, x)]
        shown = self.field.polynomial_to_sympy
        return [(shown(first), shown(second)) for first, second in found]

    def _of_pair(self, factor: Poly) -> bool:
        few = len(factor) <= _MOST_TERMS_OF_PAIR and self._may_vanish(factor)
        return few and not self._rank.is_lower_at(factor)

    def _solved(self, factor: Poly) -> dict[int, Poly] | None:
        """A symbol by its value where the factor vanishes, if that has no denominator."""
        for g in self.ring.used(factor):
            slope = self.ring.derivative(factor, g)
            if slope in (1, -1) and self.field.generators[g].kind == "symbol":
                return {g: self.ring.generator(g) - slope * self.ring.lift(factor)}
        return None

    def _rows(self, columns: Sequence[Sequence[Expr]]) -> Iterator[Row]:
        seen = set()
        for entries in zip(*columns, strict=True):
            self.allowed.check()
            for sparse in self.exact.collected(entries):
                key = tuple((k, str(x)) for k, x in sparse.items())
                if sparse and key not in seen:
                    seen.add(key)
                    yield sparse

    # -- elimination --------------------------------------------------------------------------

    @cached_property
    def candidates(self) -> list[Poly]:
        """Factors of pivots and of rows."""
        return self._candidates(self.rows)

    def _candidates(self, given: Sequence[Row]) -> list[Poly]:
        found: dict[str, Poly] = {}
        rows = [self._without_content(row, found) for row in given]
        best = [self._best(row) for row in rows]
        while rows:
            self.allowed.spend(len(rows))
            index = min(range(len(rows)), key=best.__getitem__)
            column = best.pop(index)[-1]
            pivot_row = rows.pop(index)
            if len(pivot_row[column]) > _MOST_TERMS:
                break
            self._note(pivot_row[column], found)
            for k in [k for k, row in enumerate(rows) if column in row]:
                rows[k] = self._without_content(self._eliminated(rows[k], pivot_row, column), found)
                best[k] = self._best(rows[k])
            kept = [k for k, row in enumerate(rows) if row]
            rows, best = [rows[k] for k in kept], [best[k] for k in kept]
        return sorted(found.values(), key=lambda f: (len(f), str(f)))

    def _best(self, row: Row) -> tuple[int, int, int, int]:
        """The cost of the cheapest pivot of a row, and its column: numbers, then short ones."""
        self.allowed.spend(3 * len(row))
        return (
            min(
                (0 if x.is_constant() else 1, len(x), len(row), column) for column, x in row.items()
            )
            if row
            else (2, 0, 0, -1)
        )

    def _eliminated(self, row: Row, pivot_row: Row, column: int) -> Row:
        a, b = pivot_row[column], row[column]
        common = a.gcd(b)
        a, b = a / common, b / common
        result = {k: a * x for k, x in row.items() if k != column}
        for k, x in pivot_row.items():
            if k == column:
                continue
            EFFORT.done += 5 + len(b) * len(x)
            value = result[k] - b * x if k in result else -(b * x)
            value = self.ring.reduce(value)
            if value == 0:
                result.pop(k, None)
            else:
                result[k] = value
        return result

    def _without_content(self, row: Row, found: dict[str, Poly]) -> Row:
        common = self.ring.zero
        for x in row.values():
            EFFORT.done += 5 + len(x) * 4
            common = common.gcd(x) if common != 0 else x
            if common == 1:
                return row
        if common != 0 and not common.is_constant():
            self._note(common, found)
        return row if common == 0 else {k: x / common for k, x in row.items()}

    def _note(self, poly: Poly, found: dict[str, Poly]) -> None:
        """Remember the factors that may vanish."""
        if poly.is_constant():
            return
        for factor, _ in factorization(poly)[1]:
            if str(factor) not in found and not factor.is_constant():
                found[str(factor)] = factor

    def _may_vanish(self, factor: Poly) -> bool:
        expression = self.field.polynomial_to_sympy(factor)
        return bool(expression.free_symbols) and sign(expression) not in (1, -1)
