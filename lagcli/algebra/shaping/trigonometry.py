"""The ways to write a trigonometric polynomial: powers, multiple angles, products.

A polynomial in cos(a_k), sin(a_k) has one Fourier form

    sum over n of  A_n cos(n.a) + B_n sin(n.a),    n a vector of integers,

which is also a Laurent polynomial in z_k = exp(i a_k).  Where it is even (only cosines)
or odd (only sines) that has rational coefficients, and its factors z^u ± z^v over Q are
the cosine and the sine of (u - v).a/2: so sums are turned into products.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import cache
from math import lcm
from typing import TypeAlias

from flint import Ordering, fmpz_mpoly_ctx

from lagcli.algebra.entry import Field
from lagcli.algebra.ring import Monomial, Poly, factorization
from lagcli.algebra.shaping.atoms import Angles, Atoms, Coefficient, Term, Terms, multiply

Vector: TypeAlias = tuple[int, ...]
Fourier: TypeAlias = dict[Vector, tuple[Coefficient, Coefficient]]  # of exp(i n.a): real, imaginary

_MAX_DEGREE = 10  # measured: at most 7
_MAX_SIZE = 150  # measured: at most 27


@cache
def _power(cosines: int, sines: int) -> tuple[tuple[int, int, int], ...]:
    """2^(p + q) cos^p sin^q = (z + 1/z)^p ((z - 1/z)/i)^q as (n, real, imaginary)."""
    row = {0: 1}
    for sign in [1] * cosines + [-1] * sines:
        following: dict[int, int] = {}
        for n, value in row.items():
            following[n + 1] = following.get(n + 1, 0) + value
            following[n - 1] = following.get(n - 1, 0) + sign * value
        row = following
    # i^-q = 1, -i, -1, i
    real, imaginary = [(1, 0), (0, -1), (-1, 0), (0, 1)][sines % 4]
    return tuple((n, value * real, value * imaginary) for n, value in row.items() if value)


class Trigonometry:
    """Rewrites trigonometric polynomials, given by the terms of a ring, in atoms."""

    def __init__(self, field: Field, atoms: Atoms) -> None:
        self.field = field
        self.atoms = atoms
        self._rewritten: dict[tuple[tuple[tuple[Monomial, int], ...], bool], list[Terms]] = {}

    def rewritten(
        self, terms: Iterable[tuple[Monomial, int]], *, squared: bool = False
    ) -> list[Terms]:
        """Equal sums of products of atoms: in multiple angles, and as products.

        Squared: with sin² x for cos 2x, too.
        """
        key = tuple(terms), squared
        known = self._rewritten.get(key)
        if known is None:
            known = self._rewritten[key] = list(self._forms(*key))
        return known

    def _forms(self, terms: tuple[tuple[Monomial, int], ...], squared: bool) -> Iterator[Terms]:
        generators = self.field.generators
        cosines = sorted(
            {g if generators[g].kind == "cos" else generators[g].partner
             for monomial, _ in terms for g, _ in monomial},
            key=self.atoms.angle_rank,
        )  # fmt: skip
        if any(sum(e for _, e in monomial) > _MAX_DEGREE for monomial, _ in terms):
            return
        fourier = self._fourier(terms, cosines)
        if fourier is None:
            return
        yield self._sum(fourier, cosines)
        if squared:
            yield self._sum(fourier, cosines, squared=True)
        products: Terms = {}
        for part in (0, 1):
            half = {n: v for n, v in fourier.items() if v[part]}
            for term, value in self._product(half, cosines, odd=part == 1).items():
                products[term] = products.get(term, 0) + value
        yield {t: v for t, v in products.items() if v}

    def _fourier(
        self, terms: tuple[tuple[Monomial, int], ...], cosines: list[int]
    ) -> Fourier | None:
        total: dict[Vector, tuple[int, int]] = {}  # times 2^degree
        degrees = [sum(e for _, e in monomial) for monomial, _ in terms]
        scale = 2 ** max(degrees)
        for (monomial, coefficient), degree in zip(terms, degrees, strict=True):
            exponents = dict(monomial)
            product: dict[Vector, tuple[int, int]] = {(): (coefficient * scale // 2**degree, 0)}
            for cosine in cosines:
                factor = _power(exponents.get(cosine, 0), exponents.get(cosine + 1, 0))
                product = {
                    (*n, m): (a * x - b * y, a * y + b * x)
                    for n, (a, b) in product.items()
                    for m, x, y in factor
                }
                if len(product) > _MAX_SIZE:
                    return None
            for n, (a, b) in product.items():
                x, y = total.get(n, (0, 0))
                total[n] = (a + x, b + y)
        return {
            n: (Fraction(a, scale), Fraction(b, scale)) for n, (a, b) in total.items() if a or b
        }

    def _atom(self, function: str, n: Vector, cosines: list[int]) -> tuple[int, Term]:
        """(sign, atom) of sin or cos of n.a, the first multiple made positive."""
        angles: Angles = tuple((c, k) for c, k in zip(cosines, n, strict=True) if k)
        if not angles:
            return (1, ()) if function == "cos" else (0, ())
        sign = 1
        if angles[0][1] < 0:
            angles = tuple((c, -k) for c, k in angles)
            sign = -1 if function == "sin" else 1
        return sign, ((self.atoms.circular(function, angles), 1),)

    def _sum(self, fourier: Fourier, cosines: list[int], *, squared: bool = False) -> Terms:
        """sum A_n cos(n.a) + B_n sin(n.a): both n and -n give half of each.

        Squared: 1 - 2 sin²(n.a/2) for the cosine of a multiple that is even.
        """
        result: Terms = {}
        for n, (real, imaginary) in fourier.items():
            if squared and real and any(n) and all(k % 2 == 0 for k in n):
                _, ((sine, _),) = self._atom("sin", tuple(k // 2 for k in n), cosines)
                result[()] = result.get((), 0) + real
                square = ((sine, 2),)
                result[square] = result.get(square, 0) - 2 * real
                real = 0
            for function, value in (("cos", real), ("sin", -imaginary)):
                if value:
                    sign, term = self._atom(function, n, cosines)
                    if sign:
                        result[term] = result.get(term, 0) + sign * value
        return {t: v for t, v in result.items() if v}

    def _product(self, fourier: Fourier, cosines: list[int], *, odd: bool) -> Terms:
        """An even or odd trigonometric polynomial as a product of sines and cosines."""
        part = {n: v[odd] for n, v in fourier.items()}
        if not part:
            return {}
        common = lcm(*(v.denominator for v in part.values()))
        low = [min(n[k] for n in part) for k in range(len(cosines))]
        context = fmpz_mpoly_ctx.get([f"z{c}" for c in cosines], Ordering.lex)
        poly = context.from_dict(
            {tuple(k - m for k, m in zip(n, low, strict=True)): int(v * common)
             for n, v in part.items()}
        )  # fmt: skip
        content, factors = factorization(poly)
        # poly z^low = i^-odd sum; each factor (z^u + s z^v) = z^((u+v)/2) * 2 cos or 2i sin
        doubled: dict[tuple[str, Vector], int] = {}
        rest: Poly = context.constant(1)
        number = Fraction(int(content), common)
        phase = 1 if odd else 0  # the power of i that is still to be multiplied
        for factor, exponent in factors:
            sign, vector = _binomial(factor)
            if vector is None:
                rest *= factor**exponent
                continue
            function = "cos" if sign > 0 else "sin"
            doubled[function, vector] = doubled.get((function, vector), 0) + int(exponent)
        term: Term = ()
        for (function, vector), exponent in doubled.items():
            exponents = exponent
            if any(k % 2 for k in vector):
                other = doubled.get(("sin" if function == "cos" else "cos", vector), 0)
                pairs = min(exponent, other)
                exponents = exponent - pairs
                if function == "sin" and pairs:
                    # (z^u - z^v)(z^u + z^v) is the sine of twice the angle
                    flip, atom = self._atom("sin", vector, cosines)
                    term = multiply(term, tuple((a, pairs) for a, _ in atom))
                    number *= (2 * flip) ** pairs
                    phase += pairs
                if exponents:
                    u = _half(context, vector, 1 if function == "cos" else -1)
                    rest *= u**exponents
                continue
            half = tuple(k // 2 for k in vector)
            flip, atom = self._atom(function, half, cosines)
            term = multiply(term, tuple((a, exponents) for a, _ in atom))
            number *= (2 * flip) ** exponents
            phase += exponents if function == "sin" else 0
        return self._times_rest(term, number, phase, rest, cosines)

    def _times_rest(
        self, term: Term, number: Fraction, phase: int, rest: Poly, cosines: list[int]
    ) -> Terms:
        """The product with what was no sine or cosine: a sum in multiple angles."""
        real, imaginary = [(1, 0), (0, 1), (-1, 0), (0, -1)][phase % 4]
        exponents = [tuple(map(int, m)) for m in rest.monoms()]
        # centred: the Laurent polynomial is (anti)symmetric under z -> 1/z
        middle = [max(m[k] for m in exponents) + min(m[k] for m in exponents)
                  for k in range(len(cosines))]  # fmt: skip
        fourier: Fourier = {
            tuple((2 * e - c) // 2 for e, c in zip(m, middle, strict=True)): (
                number * int(v) * real,
                number * int(v) * imaginary,
            )
            for m, v in zip(exponents, rest.coeffs(), strict=True)
        }
        return {multiply(term, each): value for each, value in self._sum(fourier, cosines).items()}


def _binomial(factor: Poly) -> tuple[int, Vector | None]:
    """(s, u - v) of a factor z^u + s z^v, s = ±1."""
    if len(factor) != 2 or abs(int(factor.coeffs()[0])) != 1:
        return 0, None
    first, second = (int(c) for c in factor.coeffs())
    if abs(second) != 1 or first != 1:
        return 0, None
    u, v = factor.monoms()
    return second, tuple(int(a) - int(b) for a, b in zip(u, v, strict=True))


def _half(context: object, vector: Vector, sign: int) -> Poly:
    """z^u + s z^v with u - v the vector and no common factor."""
    u = tuple(max(k, 0) for k in vector)
    v = tuple(max(-k, 0) for k in vector)
    return context.from_dict({u: 1, v: sign})  # type: ignore[attr-defined]
