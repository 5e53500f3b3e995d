"""The values of a parameter p at which an answer may change, as formulas and as numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.decimals import is_decimal
from lagcli.algebra.entry import Field
from lagcli.algebra.equations import solve_for
from lagcli.algebra.numeric import FINE_DIGITS
from lagcli.algebra.signs import sign
from lagcli.algebra.weights import NotAPower, Weights, weights
from lagcli.mechanics.finding.reach import real_value

_REAL = mpf(10) ** -40


class NoClosedForm(Exception):
    """A special value that is not solved for; the text is the equation."""


class SpecialValues:
    """The roots in p of several expressions, each 0 at a change.

    Parameters
    ----------
    p
        The parameter in question.
    events
        Expressions in p and other parameters.
    positive
        Expressions in the other parameters that are positive.

    Attributes
    ----------
    roots : list of Expr
        Formulas of the values, real for some of the other parameters at least.
    walls : list of Expr
        Factors without p, which vanish for special values of the other parameters alone.
    angle : bool
        Whether p stands in sines and cosines alone, and is taken from (-pi, pi].

    Raises
    ------
    NoClosedForm
        Where one of them was not solved.
    """

    def __init__(self, p: Symbol, events: Sequence[Expr], positive: Sequence[Expr] = ()) -> None:
        self.p = p
        self.positive = tuple(positive)
        self.walls: list[Expr] = []
        kinds: set[bool] = set()
        roots: dict[Expr, None] = {}
        for factor in _factors(events):
            if p not in factor.free_symbols:
                self.walls.append(factor)
                continue
            # sqrt(p) = 0
            found = solve_for(factor.base if factor.is_Pow and factor.exp > 0 else factor, p)
            hidden = any(p in f.free_symbols for f in factor.atoms(sympy.Function))
            if found is None or (hidden and not found.angle) or any(map(is_decimal, found.values)):
                raise NoClosedForm(str(factor).replace("**", "^"))
            if found.values:
                kinds.add(found.angle)
            roots.update(dict.fromkeys(map(simplify, found.values)))
        self.roots = list(roots)
        self.angle = kinds == {True}
        if len(kinds) > 1:
            raise NoClosedForm(f"{p} as an angle and as a number")

    def sorted_numbers(self, values: Mapping[Symbol, mpf]) -> list[tuple[mpf, int]]:
        """The real ones in the domain of p with their numbers in `roots`, ascending."""
        found = []
        with mpmath.workdps(FINE_DIGITS):
            for index, root in enumerate(self.roots):
                value = real_value(root, values, FINE_DIGITS)
                if value is not None and self._inside(value):
                    found.append((value, index))
        return sorted(found)

    def domain(self) -> tuple[mpf | None, mpf | None]:
        """The open interval in which p lies by assumption, None for an infinite end."""
        low = mpf(0) if self.p.is_nonnegative else -mpmath.pi if self.angle else None
        high = mpf(0) if self.p.is_nonpositive else +mpmath.pi if self.angle else None
        return low, high

    def _inside(self, value: mpf) -> bool:
        """Strictly inside; the end 0 itself is one, where p may be 0 there."""
        low, high = self.domain()
        return (low is None or value > low + _REAL) and (high is None or value < high - _REAL)

    def are_ordered(self, order: Sequence[Sequence[int]]) -> bool:
        """Whether it is certain that for all other parameters the order is the same.

        Parameters
        ----------
        order
            Groups of equal values, ascending.
        """
        if any(sign(wall, self.positive) is None for wall in self.walls):
            return False
        present = {index for group in order for index in group}
        for index, root in enumerate(self.roots):
            if self._is_present(root) is not (index in present):
                return False
        for group in order:
            if any(
                sign(self.roots[group[0]] - self.roots[other], self.positive) != 0
                for other in group[1:]
            ):
                return False
        chain = [self.roots[group[0]] for group in order]
        return all(sign(other - one, self.positive) == 1 for one, other in pairwise(chain))

    def _is_present(self, root: Expr) -> bool | None:
        """Whether a root is real and in the domain; None where that is not certain."""
        if root.atoms(sympy.Function):
            return None
        for power in root.atoms(sympy.Pow):
            if power.exp.is_Integer:
                continue
            below = sign(power.base, self.positive)
            if below is None:
                return None
            if below < 0:
                return False
        side = sign(root, self.positive)
        if self.p.is_nonnegative or self.p.is_nonpositive:
            wanted = 1 if self.p.is_nonnegative else -1
            return None if side is None else side == wanted
        return True

    def scales(self, variables: Sequence[Symbol], others: Sequence[Symbol],
               functions: Sequence[Expr]) -> bool:  # fmt: skip
        """Whether scalings of the variables make every other parameter 1 or -1.

        All functions must be homogeneous: their monomials scale alike.
        """
        if not all(other.is_positive or other.is_negative for other in others):
            return False
        symbols = [*variables, *others]
        rows: list[Weights] = []
        try:
            for function in functions:
                weights(simplify(function), rows)
        except NotAPower:
            return False
        if not rows:
            return True
        whole = sympy.Matrix([[row.get(s, 0) for s in symbols] for row in rows])
        return bool(whole.rank() == whole[:, : len(variables)].rank())


def _factors(events: Sequence[Expr]) -> Iterator[Expr]:
    """The irreducible factors of numerators and denominators, each once, without numbers."""
    seen: set[Expr] = set()
    for event in events:
        field = Field([event])
        try:
            element = field(event)
        except ZeroDivisionError:
            raise NoClosedForm("a quotient whose denominator is 0") from None
        for poly in (element.numerator, element.denominator):
            if poly == 0:
                continue
            for factor, _ in field.ring.lift(poly).factor()[1]:
                expression = field.polynomial_to_sympy(factor)
                if expression.free_symbols and expression not in seen and -expression not in seen:
                    seen.add(expression)
                    yield expression
