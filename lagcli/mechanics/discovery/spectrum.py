"""The exponents of time that the equations suggest: those of their linear part.

The terms of q''(q, q') that are linear with constant coefficients, q'' = K q + C q', have
solutions exp(lambda t) with det(lambda^2 - C lambda - K) = 0.  For the oscillator these are
+- i omega, for a charge in a magnetic field 0 and +- i q B/m, for a damped oscillator
-gamma/2 +- i sqrt(omega^2 - gamma^2/4).  A symmetry that is affine in q carries solutions
into solutions, so its time dependence has the differences of the exponents.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify

_LARGEST_BLOCK = 4  # measured: at most 3
_MOST_OPERATIONS = 3000  # measured: at most 25
_MOST_IN_ROOTS = 20  # operations; measured: 18 are found, 26 take all the work of the search
_WAVES = (sympy.sin, sympy.cos, sympy.exp)


@dataclass(frozen=True, slots=True)
class Exponent:
    """lambda = growth +- i frequency; the frequency is 0 where it is real."""

    growth: Expr
    frequency: Expr
    repeated: bool = False  # then t times the functions is a solution too

    def functions(self, t: Expr) -> list[Expr]:
        """Real functions of time, or of log(tau): exp(growth t) times sine and cosine."""
        envelope = sympy.exp(self.growth * t)
        if isinstance(t, sympy.log):  # SymPy does not know that the two are the same
            envelope = t.args[0] ** self.growth
        if self.frequency == 0:
            plain = [] if self.growth == 0 else [envelope]
        else:
            angle = self.frequency * t
            plain = [envelope * sympy.sin(angle), envelope * sympy.cos(angle)]
        return [*plain, *(t * f for f in plain)] if self.repeated else plain


def exponents(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> list[Exponent]:
    """The exponents of the linear part, none of them 0, none twice."""
    found: list[Exponent] = []
    for determinant, lam in _characteristic(accelerations, q, v, t):
        for exponent in roots_of(determinant, lam) if determinant is not None else ():
            _keep(found, exponent)
    return found


def has_unsolved_exponents(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> bool:
    """Whether linear equations have exponents without a closed form here."""
    parts = [a.diff(x) for a in accelerations for x in (*q, *v)]
    if any(part.free_symbols & {*q, *v, t} for part in parts):
        return False
    return any(
        determinant is None
        or any(factor.degree() and not _roots(factor) for factor, _ in _factors(determinant, lam))
        for determinant, lam in _characteristic(accelerations, q, v, t)
    )


def _characteristic(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> Iterator[tuple[Expr | None, Symbol]]:
    """det(lambda^2 - C lambda - K) of coupled coordinates; None of too many."""
    n, lam = len(q), Symbol("#lambda", real=True)
    rows = [_linear_part(x, [*q, *v], t) for x in accelerations]
    for block in _blocks(rows, n):
        if len(block) > _LARGEST_BLOCK:
            yield None, lam
            continue
        matrix = sympy.Matrix(
            [
                [
                    (lam**2 if i == j else 0) - rows[i].get(j, 0) - lam * rows[i].get(n + j, 0)
                    for j in block
                ]
                for i in block
            ]
        )
        yield matrix.det(method="berkowitz"), lam


def roots_of(determinant: Expr, lam: Symbol) -> Iterator[Exponent]:
    """The exponents that a characteristic equation has, by its factors."""
    for factor, multiplicity in _factors(determinant, lam):
        for exponent in _roots(factor):
            yield Exponent(exponent.growth, exponent.frequency, multiplicity > 1)


def _factors(determinant: Expr, lam: Symbol) -> list[tuple[sympy.Poly, int]]:
    try:
        if determinant.has(sympy.sin, sympy.cos):  # sin²β + cos²β = 1
            coefficients = sympy.Poly(determinant, lam).all_coeffs()
            determinant = sympy.Poly([*map(simplify, coefficients)], lam).as_expr()
        numerator = sympy.numer(sympy.together(sympy.expand(determinant)))
        factors = sympy.factor_list(numerator, lam)[1]
    except sympy.PolynomialError:
        return []
    return [(factor.as_poly(lam), multiplicity) for factor, multiplicity in factors]


def differences(found: Sequence[Exponent], most: int = 9) -> list[Exponent]:
    """Of two exponents, one of which may be 0, with either sign: at most this number.

    Those of two that one equation has come first, as twice the frequency of two conjugate ones.
    """
    result: list[Exponent] = []

    def add(growth: Expr, frequency: Expr) -> None:
        for sign in (1, -1):
            _keep(result, Exponent(simplify(sign * growth), simplify(frequency)))

    for each in found:
        add(sympy.S.Zero, 2 * each.frequency)
    real = [each.growth for each in found if each.frequency == 0]
    for growth, other in zip(real[::2], real[1::2], strict=False):
        add(growth - other, sympy.S.Zero)
    for each in found:  # as they stand, for two forms of one function would be two functions
        for rate in (each.growth, -each.growth):
            _keep(result, Exponent(rate, each.frequency))
    pairs = list(combinations(found, 2))
    for sign in (-1, 1):  # differences first: a turning frame has its own frequency among them
        for other, one in pairs if len(result) < most else ():
            add(one.growth - other.growth, one.frequency + sign * other.frequency)
    return result[:most]


def sums(found: Sequence[Exponent], most: int = 6) -> list[Exponent]:
    """Of two exponents, equal ones too: the time dependence of products of two integrals."""
    result: list[Exponent] = []
    for i, one in enumerate(found):
        for other in found[: i + 1]:
            growth = simplify(one.growth + other.growth)
            for frequency in (one.frequency - other.frequency, one.frequency + other.frequency):
                _keep(result, Exponent(growth, simplify(frequency)))
    return result[:most]


def forced_motion(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> list[Expr]:
    """Functions of time in a motion forced by the terms of q'' without q and q'.

    A sine, cosine or exponential of time in them returns in the motion; a constant gives a
    drift, as of a falling body with drag, or of a charge in crossed fields.  A symmetry of
    the equations without these terms is moved along with the motion, and has them as factors.
    """
    found: dict[Expr, None] = {}
    for acceleration in accelerations:
        terms = sympy.Add.make_args(sympy.expand(acceleration))
        free = [x for x in terms if not x.free_symbols & {*q, *v}]
        if any(t in sympy.denom(x).free_symbols for x in free):  # m/(m - t) - t/(m - t)
            free = list(sympy.Add.make_args(sympy.expand(sympy.cancel(sympy.Add(*free)))))
        for term in free:
            waves = sorted(
                (f for f in term.atoms(*_WAVES) if t in f.free_symbols),
                key=sympy.default_sort_key,
            )
            alike = [
                [wave]
                if wave.func is sympy.exp
                else [f(wave.args[0]) for f in (sympy.sin, sympy.cos)]
                for wave in waves
            ]
            if waves:  # exp(-a t) cos(b t) returns with exp(-a t) sin(b t)
                found |= dict.fromkeys(sympy.Mul(*choice) for choice in product(*alike))
        powers = sympy.Add(*(x for x in free if x.is_polynomial(t)))
        if powers != 0:  # a motion of the same degree, of two more without a spring
            degree = int(sympy.degree(powers, t)) if t in powers.free_symbols else -1
            found |= dict.fromkeys(t**k for k in range(1, max(2, degree + 3)))
    return list(found)


def _keep(found: list[Exponent], new: Exponent) -> None:
    """Add an exponent that is not 0 and that differs from the others, also as a conjugate."""
    if is_zero(new.frequency):
        new = Exponent(new.growth, sympy.S.Zero, new.repeated)
        if is_zero(new.growth):
            return
    for each in found:
        if is_zero(each.growth - new.growth) and (
            is_zero(each.frequency - new.frequency) or is_zero(each.frequency + new.frequency)
        ):
            return
    if new.frequency.could_extract_minus_sign():
        new = Exponent(new.growth, -new.frequency, new.repeated)
    found.append(new)


def _linear_part(acceleration: Expr, variables: Sequence[Symbol], t: Symbol) -> dict[int, Expr]:
    if sympy.count_ops(acceleration) > _MOST_OPERATIONS:
        return {}
    position = {x: k for k, x in enumerate(variables)}
    part: dict[int, Expr] = {}
    for term in sympy.Add.make_args(sympy.expand(acceleration)):
        constant, rest = term.as_independent(*variables, as_Add=False)
        if rest in position and t not in constant.free_symbols:
            k = position[rest]
            part[k] = part.get(k, sympy.S.Zero) + constant
    return part


def _blocks(rows: Sequence[dict[int, Expr]], n: int) -> list[list[int]]:
    """Coordinates that are coupled with each other."""
    label = list(range(n))
    for i, row in enumerate(rows):
        for k in row:
            a, b = label[i], label[k % n]
            label = [a if x == b else x for x in label]
    return [[i for i in range(n) if label[i] == x] for x in dict.fromkeys(label)]


def _roots(poly: sympy.Poly) -> list[Exponent]:
    """Of a linear factor, a quadratic one, or a quartic one that is even about its mean root."""
    zero = sympy.S.Zero
    c = [simplify(x) for x in reversed(poly.all_coeffs())]
    if poly.degree() == 1:
        return [Exponent(simplify(-c[0] / c[1]), zero)]
    if poly.degree() == 2:
        return _quadratic(simplify(c[1] / c[2]), simplify(c[0] / c[2]))
    if poly.degree() == 4:
        mean = simplify(-c[3] / (4 * c[4]))
        about = poly.compose(sympy.Poly(poly.gen + mean, poly.gen)).monic()
        constant, odd, square, *_ = [simplify(x) for x in reversed(about.all_coeffs())]
        if is_zero(odd):
            found = _biquadratic(square, constant)
            real = not any(e.frequency.has(sympy.I) or e.growth.has(sympy.I) for e in found)
            return [Exponent(simplify(mean + e.growth), e.frequency) for e in found if real]
    return []


def _quadratic(b: Expr, c: Expr) -> list[Exponent]:
    """lambda^2 + b lambda + c = 0."""
    # without a word on the sign, c > b^2/4 is taken: both forms are the same functions
    inside = simplify(c - b**2 / 4)
    if inside.is_negative or (c.could_extract_minus_sign() and not c.is_positive):
        root = frequency_of(simplify(-inside))
        return [Exponent(simplify(-b / 2 + root), sympy.S.Zero),
                Exponent(simplify(-b / 2 - root), sympy.S.Zero)]  # fmt: skip
    return [Exponent(simplify(-b / 2), frequency_of(inside))]


def _biquadratic(b: Expr, c: Expr) -> list[Exponent]:
    """lambda^4 + b lambda^2 + c = 0: i (sqrt(b + 2s) +- sqrt(b - 2s))/2 where c = s^2."""
    if c.is_nonpositive:  # one square of each sign
        s, inside = frequency_of(-c), frequency_of(simplify(b**2 / 4 - c))
        frequency = sympy.sqrt(simplify(inside + b / 2))
        growth = sympy.sqrt(simplify(inside - b / 2)) if has_roots(s) else s / frequency
        real = [Exponent(sign * growth, sympy.S.Zero) for sign in (1, -1)]
        return [*real, Exponent(sympy.S.Zero, frequency)]
    s = frequency_of(c)
    gap, frequency = simplify(c - b**2 / 4), sympy.sqrt(simplify(b + 2 * s)) / 2
    if gap.is_nonnegative and frequency.count_ops() <= _MOST_IN_ROOTS:  # the squares are conjugate
        growth = simplify(frequency_of(gap) / (2 * frequency))
        return [Exponent(sign * growth, frequency) for sign in (1, -1)]
    if has_roots(s):
        inside = frequency_of(simplify(b**2 / 4 - c))
        squares = [simplify(b / 2 + inside), simplify(b / 2 - inside)]
        return [exponent for x in squares for exponent in _quadratic(sympy.S.Zero, x)]
    one, inside = frequency_of(simplify(b + 2 * s)), simplify(b - 2 * s)
    if inside.is_negative:
        growth, frequency = frequency_of(-inside) / 2, simplify(one / 2)
        return [Exponent(simplify(sign * growth), frequency) for sign in (1, -1)]
    other = frequency_of(inside)
    return [
        Exponent(sympy.S.Zero, simplify((one + other) / 2)),
        Exponent(sympy.S.Zero, simplify((one - other) / 2)),
    ]


def has_roots(formula: Expr) -> bool:
    """Whether there is a broken power in it."""
    return any(p.exp.is_Rational and p.exp.q > 1 for p in formula.atoms(sympy.Pow))


def frequency_of(square: Expr) -> Expr:
    """A root without a modulus: either sign serves for sine and cosine.

    sqrt(k/m) is sqrt(k*m)/m where the sign of m is open: one root, whose square is exact.
    """
    factored = sympy.factor(square)
    above, below = factored.as_numer_denom()
    if below.free_symbols and not below.is_nonnegative:
        return simplify(frequency_of(above * below) / below)
    root = sympy.sqrt(factored)
    roots = [p for p in root.atoms(sympy.Pow) if p.exp.is_Rational and p.exp.q == 2]
    radicands = [p.base for p in roots if not p.base.is_number]
    if len(radicands) > 1 and any(each.is_Add for each in radicands):
        # 4 m^2 of g/l - c^2/4 m^2; what is left is not torn apart
        factors = [f.as_base_exp() for f in sympy.Mul.make_args(below)]
        whole = sympy.Mul(*(b**n for b, n in factors if n == 2 or sympy.sqrt(b).is_Integer))
        if whole.is_number:
            root = sympy.sqrt(square)
        else:
            root = sympy.sqrt(sympy.expand(whole * square)) / sympy.sqrt(whole)
    return simplify(root).replace(sympy.Abs, lambda x: x)
