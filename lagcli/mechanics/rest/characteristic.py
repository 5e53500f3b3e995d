"""The characteristic polynomial of a linearised motion and what its coefficients tell.

det(K - W M) = 0,  W = omega^2,          without terms in x'
det(s^2 M + s C + K) = 0,  s^2 = -W,     with gyroscopic terms, where only s^2 occurs
"""

from __future__ import annotations

from functools import cached_property

from sympy import Expr, S, Symbol

from lagcli.algebra import Field
from lagcli.algebra.determinants import determinant_in
from lagcli.algebra.polynomial_roots import factor_roots
from lagcli.mechanics.rest.linearization import Linearization


class Characteristic:
    """The polynomial in W = omega^2; None in all answers where there is none (damping)."""

    def __init__(self, linear: Linearization) -> None:
        self.linear = linear

    @cached_property
    def in_s(self) -> list[Expr] | None:
        """The coefficients by powers of s, the constant term det K first."""
        linear, s = self.linear, Symbol("#s", real=True)
        n = len(linear.M)
        return determinant_in(
            s,
            [
                [s**2 * linear.M[i][j] + s * linear.C[i][j] + linear.K[i][j] for j in range(n)]
                for i in range(n)
            ],
        )

    @cached_property
    def in_square(self) -> list[Expr] | None:
        """The coefficients by powers of W = -s^2; None where odd powers of s occur."""
        if self.in_s is None or any(c != 0 for c in self.in_s[1::2]):
            return None
        return [(-1) ** k * c for k, c in enumerate(self.in_s[::2])]

    @cached_property
    def squares(self) -> list[tuple[list[Expr] | None, int, int]] | None:
        """By irreducible factor: the roots W (None: no closed form), multiplicity, degree."""
        powers = self.in_square
        if powers is None or len(powers) == 1:  # no displacement is free
            return None
        W = Symbol("#W", real=True)
        polynomial = sum((c * W**k for k, c in enumerate(powers)), S.Zero)
        field = Field([polynomial])
        number = field.number_of(W)
        assert number is not None
        return factor_roots(field, field(polynomial).numerator, number)
