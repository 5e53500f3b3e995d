"""Signs of expressions at places where a square of a momentum is not negative."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign


class KnownSigns:
    """Signs at places where N >= 0."""

    def __init__(self, radicand: Expr, positive: Sequence[Expr]) -> None:
        self.radicand, self.positive = radicand, positive

    def sign(self, expression: Expr) -> int | None:
        """1 or -1 where there is no other, but for values at which it is 0."""
        found = sign(expression, self.positive) or weak_sign(expression, self.positive)
        if found is not None or not expression.free_symbols:
            return found
        return next((s for s in (1, -1) if self._follows(s * expression)), None)

    def _follows(self, expression: Expr) -> bool:
        """Whether expression - N/factor > 0 for some positive factor, where N >= 0."""
        for each in sorted(expression.free_symbols, key=str):
            slope = simplify(self.radicand.diff(each) / expression.diff(each))
            if slope != 0 and sign(slope, self.positive) == 1:
                rest = sympy.Add(
                    expression, *(-term / slope for term in sympy.Add.make_args(self.radicand))
                )
                whole = simplify(rest)
                if whole == 0 or weak_sign(whole, self.positive) == 1:
                    return True
                if all(weak_sign(t, self.positive) == 1 for t in sympy.Add.make_args(rest)):
                    return True
        return False
