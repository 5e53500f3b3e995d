"""Whether a steady motion is stable: a minimum of U_eff first, then the spectrum.

With M x'' + C x' + K x = 0, C antisymmetric, about it:
K > 0 is a minimum of U_eff, so it is stable (Lagrange, Dirichlet, Routh).  Otherwise the
roots W = omega^2 of det(K - W M + i omega C) decide to first order: it is stable where all
are positive and distinct (gyroscopic stabilization), unstable where one is not, or complex.
The spectrum alone proves instability, not stability.

References
----------
Routh, *Stability of a Given State of Motion*, chapter IV.
Chetaev, *The Stability of Motion*, chapter V.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 35, problem 1(c): the sleeping top.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import Field, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import coefficients, rounded
from lagcli.algebra.ring import factorization
from lagcli.algebra.signs import sign
from lagcli.mechanics.oscillations.characteristic import Characteristic, determinant_in
from lagcli.mechanics.oscillations.feeding import cannot_feed
from lagcli.mechanics.oscillations.linearization import Linearization, Matrix
from lagcli.mechanics.oscillations.stability import NOT_DEFINITE, positive_definite, stability
from lagcli.mechanics.reduction.readable import is_positive, weak_sign
from lagcli.mechanics.reduction.spectrum import real_and_distinct
from lagcli.record import record

_UNLESS = "U_eff has no minimum of second order, and is flat where a parameter or momentum is 0"


@record
class Verdict:
    """What is known; where both `minimum` and `spectrum` are None nothing was decided.

    Attributes
    ----------
    minimum, spectrum
        What must be positive for a minimum of U_eff, and for a spectrum on the imaginary
        axis; empty: it is always so.  None: never so, or not decided.
    unstable
        Whether it is unstable for all parameters.
    squares
        omega^2 of the small oscillations, where they have a closed form.
    """

    minimum: tuple[Expr, ...] | None
    spectrum: tuple[Expr, ...] | None
    unstable: bool
    squares: tuple[Expr, ...]
    reason: str = ""


def verdict(linear: Linearization) -> Verdict:
    """The verdict on the steady motion that was linearised about."""
    positive = linear.point.positive
    squares = _squares(linear)
    undecided = Verdict(None, None, False, squares)
    if not linear.M or not linear.regular:
        return _because(undecided, "the mass matrix is singular there")
    complete = linear.damped and positive_definite(linear.damping, positive)
    feeds = not complete and (linear.damped or not cannot_feed(linear.system))
    if linear.nonholonomic or not linear.has_potential or feeds:
        if any(_sign(square, positive) == -1 for square in squares):
            return Verdict(None, None, True, squares)
        return _because(undecided, "the linearised forces are not those of a potential alone")
    if not all(is_positive(e, positive) for e in _leading_minors(linear.M)):
        return _because(undecided, NOT_DEFINITE)
    elementary = _relative_to(linear.M, linear.K)
    if elementary is None:
        return _because(undecided, "the characteristic polynomial was not found")
    minimum, fails = _open(elementary, positive)
    if minimum and all(x == 0 for i, row in enumerate(linear.K) for x in (*row[:i], *row[i + 1 :])):
        minimum = _open([row[i] for i, row in enumerate(linear.K)], positive)[0]
    fails |= 0 in (_sign(e, positive) for e in elementary)  # det K is not 0: some W < 0
    if minimum == ():
        return Verdict((), None, False, squares)
    if _sign(elementary[-1], positive) == 0:
        if _across(linear):
            return Verdict((), None, False, squares)
        return _because(undecided, "neutral to first order in some direction")
    if complete or not linear.gyroscopic:  # Kelvin, Tait and Chetaev
        found = Verdict(minimum, None, fails, squares)
        return found if fails or minimum is not None else _because(found, _UNLESS)
    if _sign(elementary[-1], positive) == -1:
        return Verdict(None, None, True, squares)
    spectrum = real_and_distinct(linear)
    if spectrum is None:
        return _because(
            Verdict(minimum, None, False, squares), "the spectrum has no simple criterion"
        )
    open_, unstable = _open(spectrum, positive)
    return Verdict(minimum, open_, unstable, squares)


def _across(linear: Linearization) -> bool:
    """Whether U_eff has a strict minimum across a family of places at the same momenta."""
    values, q = linear.point.values, linear.system.q
    if not all(free_of(value, q) for x, value in values.items() if x not in q):
        return False
    return stability(linear, Characteristic(linear)).stable is True


def curvature(potential: Expr, mass: Expr, positive: Sequence[Expr] = ()) -> Verdict:
    """The verdict on one coordinate with M and U'' given."""
    square = simplify(potential / mass)
    if not is_positive(mass, positive):
        return Verdict(None, None, False, (square,), NOT_DEFINITE)
    minimum, fails = _open([square], positive)
    found = Verdict(minimum, None, fails, (square,))
    return found if fails or minimum is not None else _because(found, _UNLESS)


def _because(found: Verdict, reason: str) -> Verdict:
    return Verdict(found.minimum, found.spectrum, found.unstable, found.squares, reason)


def _open(
    expressions: Sequence[Expr], positive: Sequence[Expr]
) -> tuple[tuple[Expr, ...] | None, bool]:
    """Those whose sign is open, None where one is not positive; whether one is negative."""
    signs = [_sign(e, positive) for e in expressions]
    weak = [weak_sign(e, positive) for e in expressions]
    if -1 in signs or 0 in signs or -1 in weak:
        return None, -1 in signs
    return tuple(e for e, s in zip(expressions, signs, strict=True) if s is None), False


def _sign(expression: Expr, positive: Sequence[Expr]) -> int | None:
    known = sign(expression, positive)
    return _on_the_circle(expression, positive) if known is None else known


def _on_the_circle(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1 for a + b cos(x) with a > 0 and squares at cos = 1 and cos = -1, over a positive."""
    field = Field([expression])
    element = field(expression)
    below = sign(1 / field.to_sympy(field.polynomial(element.denominator)), positive)
    if below is None:
        return None
    poly = element.numerator * below
    for g in field.ring.used(poly):
        if field.generators[g].kind != "cos" or field.ring.degree(poly, g) != 1:
            continue
        if g + 1 in field.ring.used(poly):
            continue
        a, b = coefficients(field, poly, g)
        ends = [(a + b).numerator, (a - b).numerator]
        if sign(field.to_sympy(a), positive) == 1 and all(map(_is_square, ends)):
            return 1
    return None


def _is_square(poly: object) -> bool:
    content, factors = factorization(poly)
    return int(content) > 0 and all(exponent % 2 == 0 for _, exponent in factors)


def _leading_minors(matrix: Matrix) -> list[Expr]:
    from lagcli.mechanics.oscillations.characteristic import determinant

    minors = [determinant([row[:k] for row in matrix[:k]]) for k in range(1, len(matrix) + 1)]
    return [S.Zero if minor is None else minor for minor in minors]


def _relative_to(M: Matrix, K: Matrix) -> list[Expr] | None:
    """e_1, …, e_n of the roots W of det(K - W M): all are positive where K > 0."""
    n, W = len(M), Symbol("#W", real=True)
    powers = determinant_in(W, [[W * M[i][j] + K[i][j] for j in range(n)] for i in range(n)])
    return None if powers is None else [simplify(c / powers[-1]) for c in powers[-2::-1]]


def _squares(linear: Linearization) -> tuple[Expr, ...]:
    if linear.damped:
        return ()
    factors = Characteristic(linear).squares
    found: list[Expr] = []
    for roots, multiplicity, _ in factors or ():
        if roots is None or any(root.has(sympy.I) for root in roots):
            return ()
        found += [_shorter(root) for root in roots] * multiplicity
    return tuple(found)


def _shorter(root: Expr) -> Expr:
    short = rounded(simplify(root))
    return root if sympy.count_ops(root) < sympy.count_ops(short) else short
