"""Frequencies and shapes of small oscillations, each checked by substitution at 50 digits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra import nullspace, simplify
from lagcli.algebra.decimals import decimal, is_decimal
from lagcli.algebra.factors import factors_of
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.positivity import sign_of, weak_sign, without_moduli
from lagcli.algebra.signs import sign
from lagcli.algebra.vanishing_factors import divisors, in_sines
from lagcli.mechanics.inequalities import one_is_negative
from lagcli.mechanics.parameter_values import admissible_values
from lagcli.mechanics.rest.characteristic import Characteristic
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.record import record

_CHOICES = 24
_ZERO = mpf(10) ** -35
_ROUNDED = mpf(10) ** -10  # for squared frequencies given as decimals


@record
class NormalMode:
    """`square` is omega^2; `frequency` None where it is not real, no `shapes` where complex.

    `negative`: the square is, for all values, or is not real; `open_sign`: for some.  Both are
    None, without shapes, for a frequency that was not found, or is `damped`: then the exponents of
    exp(s t) are s = -decay ± i sqrt(square - decay²), or real ones.
    """

    square: Expr | None
    frequency: Expr | None
    shapes: tuple[tuple[Expr, ...], ...]
    multiplicity: int
    negative: bool = False
    damped: bool = False
    open_sign: bool = False
    decay: Expr | None = None
    exponents: tuple[Expr, ...] = ()


def normal_modes(linear: Linearization, characteristic: Characteristic) -> list[NormalMode]:
    """The modes by rising frequency; none where no square is real."""
    factors = characteristic.squares
    if factors is None:
        return _damped(linear, characteristic)
    chosen = choices(linear)
    values = chosen[0]
    modes: list[NormalMode] = []
    unknown, complex_ = 0, True
    for roots, multiplicity, degree in factors:
        if roots is None or not all(
            _is_root(characteristic, r, values) and not r.has(sympy.I) for r in roots
        ):
            unknown += multiplicity * degree
            values_of = [(r, each) for r in roots or () for each in chosen]
            complex_ &= bool(values_of) and all(_is_complex(*pair) for pair in values_of)
            continue
        if never_oscillates(roots, linear.point.positive):
            unknown += multiplicity * degree
            continue
        plain = [without_moduli(root, linear.point.positive) for root in roots]
        given, roots = roots, plain
        pair = beats(roots, chosen)
        shapes: tuple[tuple[Expr, ...], ...] = ()
        for k, root in enumerate(roots):
            if pair:
                frequency, square = pair[k], simplify(pair[k] ** 2)
            else:
                frequency = _frequency(linear, root, chosen)
                square = shorter(simplify(root), root)
            known = sign(square, linear.point.positive)
            falls = frequency is None and known == -1
            shapes = (
                _conjugate(modes[-1], square, linear, values)
                if k and len(roots) == 2 and shapes
                else ()
            )
            shapes = shapes or _shapes(linear, square, values) or _shapes(linear, given[k], values)
            complex_somewhere = any(_is_complex(root, each) for each in chosen)
            turns = known is None and (complex_somewhere or weak_sign(square) != 1)
            modes.append(
                NormalMode(square, frequency, shapes, multiplicity, falls, open_sign=turns)
            )
    modes.sort(key=lambda mode: _number(mode.square, values))
    if unknown and (modes or not complex_):
        modes.append(NormalMode(None, None, (), unknown, complex_))
    return modes


def _damped(linear: Linearization, characteristic: Characteristic) -> list[NormalMode]:
    """By factors of det(K + s C + s² M): the roots of quadratic and of linear ones."""
    s, left = Symbol("#s", real=True), len(linear.M)
    powers = characteristic.in_s or [S.One]
    whole = simplify(sympy.Add(*(c * s**k for k, c in enumerate(powers))))
    modes: list[NormalMode] = []
    exponents: list[Expr] = []
    bases = (factor.as_base_exp() for factor in sympy.Mul.make_args(whole))
    factors = ((f, k * int(e)) for base, e in bases if e.is_Integer for f, k in factors_of(base))
    for factor, power in sorted(factors, key=lambda pair: str(pair[0])):
        coefficients = [simplify(c) for c in sympy.Poly(factor, s).all_coeffs()]
        if len(coefficients) == 2:
            exponents += [simplify(-coefficients[1] / coefficients[0])] * power
        if len(coefficients) != 3:
            continue
        leading, linear_, constant = coefficients
        decay = simplify(linear_ / (2 * leading))
        square = constant / leading - decay**2
        known = sign(simplify(square))
        if known == 1 or known is None:
            left -= power
            turns = {"damped": True, "open_sign": known is None, "decay": decay}
            undamped = simplify(constant / leading)
            shapes = _damped_shapes(linear, undamped, decay, power)
            modes.append(NormalMode(undamped, None, shapes, power, **turns))
        else:
            root = sympy.sqrt(simplify(-square))
            exponents += [simplify(side * root - decay) for side in (1, -1)] * power
    if left:
        alone = tuple(exponents)
        modes.append(NormalMode(None, None, (), left, damped=True, exponents=alone))
    return modes


def _damped_shapes(
    linear: Linearization, square: Expr, decay: Expr, count: int
) -> tuple[tuple[Expr, ...], ...]:
    """The real ones: (K - W M) a = 0 and (C - 2 delta M) a = 0, as s² = -2 delta s - W.

    None where there are fewer than `count`, and of one coordinate.
    """
    n = len(linear.M)
    if n == 1:
        return ()
    matrix = [
        [simplify(rows[i][j] - value * linear.M[i][j]) for j in range(n)]
        for rows, value in ((linear.K, square), (linear.C, 2 * decay))
        for i in range(n)
    ]
    vectors = nullspace(matrix)
    values = choices(linear)[0]
    if len(vectors) != count or not all(_annihilates(matrix, v, values) for v in vectors):
        return ()
    shapes = [_displacement(linear, vector) for vector in vectors]
    return tuple(shape for shape in shapes if shape is not None)


def never_oscillates(roots: Sequence[Expr], positive: Sequence[Expr]) -> bool:
    """Whether neither of two roots W is ever real and positive: they are not real, or negative.

    Of W² - s W + p with p > 0 both are where s² > 4 p and s > 0.
    """
    if len(roots) != 2:
        return False
    total, times = simplify(roots[0] + roots[1]), simplify(roots[0] * roots[1])
    real = simplify(total**2 - 4 * times)
    never = sign_of(total, positive) == -1 or one_is_negative((real, total), positive)
    return sign_of(times, positive) == 1 and never


def _frequency(
    linear: Linearization, square: Expr, chosen: Sequence[Mapping[Symbol, mpf]]
) -> Expr | None:
    """sqrt(W); None where W < 0 or is not real.

    Where the sign is open, the root stands for both cases.
    """
    if any(_is_complex(square, values) for values in chosen):
        return None
    known = sign(square, linear.point.positive)
    if known is None and all(_number(square, values) < 0 for values in chosen):
        known = -1
    if known == -1:
        return None
    if is_decimal(square):
        return decimal(sympy.sqrt(square).evalf(30))
    root = _with_whole_modulus(sympy.sqrt(shorter(simplify(square), square)))
    return root if known is None else shorter(simplify(sympy.sqrt(square)), root)


def _with_whole_modulus(root: Expr) -> Expr:
    """|Omega - sqrt(k/m)| for |sqrt(m) Omega - sqrt(k)|/sqrt(m)."""
    outside, moduli = root.as_independent(sympy.Abs, as_Add=False)
    if not isinstance(moduli, sympy.Abs) or not outside.is_positive:
        return root
    return shorter(root, sympy.Abs(sympy.expand(outside * moduli.args[0])))


def beats(squares: Sequence[Expr], chosen: Sequence[Mapping[Symbol, mpf]]) -> list[Expr] | None:
    """omega = p ± q for omega^2 = a ± sqrt(b), where that is shorter and the motion oscillates.

    4 p^2 = W1 + W2 + 2 sqrt(W1 W2) and 4 q^2 = W1 + W2 - 2 sqrt(W1 W2).
    """
    if len(squares) != 2 or not any(x.exp == S.Half for x in squares[0].atoms(sympy.Pow)):
        return None
    real = [v for v in chosen if not any(_is_complex(square, v) for square in squares)]
    oscillating = [v for v in real if all(_number(square, v) > 0 for square in squares)]
    if not oscillating:
        return None
    both, times = simplify(squares[0] + squares[1]), simplify(squares[0] * squares[1])
    cross = 2 * simplify(sympy.sqrt(times))
    if any(x.exp == S.Half and x.free_symbols for x in cross.atoms(sympy.Pow)):
        return None
    p, q = (sympy.sqrt(simplify((both + sign_ * cross) / 4)) for sign_ in (1, -1))
    p, q = shorter(simplify(p), p), shorter(simplify(q), q)
    # p + |q| and p - |q| are together p + q and p - q; within a root |q| stays
    factors = sympy.Mul.make_args(q)
    q = sympy.Mul(*(f.args[0] if isinstance(f, sympy.Abs) else f for f in factors))
    pair = [p - q, p + q]
    plain = [sympy.sqrt(simplify(square)) for square in squares]
    if sum(map(sympy.count_ops, pair)) >= sum(map(sympy.count_ops, plain)):
        return None
    return pair if all(_are_frequencies(pair, squares, values) for values in oscillating) else None


def _are_frequencies(
    pair: Sequence[Expr], squares: Sequence[Expr], values: Mapping[Symbol, mpf]
) -> bool:
    with mpmath.workdps(DIGITS):
        found = sorted(_number(each, values) for each in pair)
        wanted = sorted(_number(each, values) for each in squares)
        return found[0] > 0 and all(
            abs(a**2 - b) < _ZERO * (1 + abs(b)) for a, b in zip(found, wanted, strict=True)
        )


def shorter(first: Expr, second: Expr) -> Expr:
    """Whichever has fewer operations, the first of equals."""
    return second if sympy.count_ops(second) < sympy.count_ops(first) else first


def _shapes(
    linear: Linearization, square: Expr, values: Mapping[Symbol, mpf]
) -> tuple[tuple[Expr, ...], ...]:
    """Displacements with one component 1: a basis of the null space of K - W M.

    Empty for complex ones (gyroscopic terms), or where one was not found.
    """
    n = len(linear.M)
    if linear.gyroscopic or linear.damped or square.has(sympy.acos):
        return ()
    matrix = [
        [simplify(linear.K[i][j] - square * linear.M[i][j]) for j in range(n)] for i in range(n)
    ]
    vectors = nullspace(matrix) if n > 1 else [[S.One]]
    shapes = [
        _displacement(linear, vector) if _annihilates(matrix, vector, values) else None
        for vector in vectors
    ]
    return () if None in shapes else tuple(shape for shape in shapes if shape is not None)


def _conjugate(
    mode: NormalMode, square: Expr, linear: Linearization, values: Mapping[Symbol, mpf]
) -> tuple[tuple[Expr, ...], ...]:
    """The shape of another mode with the other sign of its one root, where it belongs to W.

    Both are then written alike: (M - m ± sqrt(m² - m M + M²))/M.
    """
    n = len(linear.system.q)
    if len(mode.shapes) != 1 or sympy.Matrix(linear.basis) != sympy.eye(n):
        return ()
    (shape,) = mode.shapes
    roots = {x for part in shape for x in part.atoms(sympy.Pow) if abs(x.exp) == S.Half}
    if len(roots) != 1:
        return ()
    root = roots.pop()
    other = tuple(part.xreplace({root: -root}) for part in shape)
    matrix = [[linear.K[i][j] - square * linear.M[i][j] for j in range(n)] for i in range(n)]
    return (other,) if _annihilates(matrix, other, values) else ()


def _displacement(linear: Linearization, vector: Sequence[Expr]) -> tuple[Expr, ...] | None:
    """The displacement of all coordinates for one in the basis."""
    displacement = [
        simplify(
            sympy.Add(*(x * column[i] for x, column in zip(vector, linear.basis, strict=True)))
        )
        for i in range(len(linear.system.q))
    ]
    moved = [x for x in displacement if x != 0]
    if not moved:
        return None
    known = linear.point.family
    if known is not None:
        return known.displacement(displacement)
    ratios = [tuple(simplify(x / unit) for x in displacement) for unit in moved]
    return next((shape for shape in ratios if not _may_be_infinite(shape)), ratios[0])


def _may_be_infinite(shape: Sequence[Expr]) -> list[Expr]:
    """What it is divided by and may be 0."""
    return [d for x in shape for d in divisors(in_sines(x)) if sign(d**2) is None]


def infinite_where(shape: Sequence[Expr]) -> list[Expr]:
    """What vanishes where a shape has no value, as a coupling does; without roots.

    Of n/(a + b sqrt(D)) it is what n/(a² - b² D) is divided by.
    """
    parts = [_with_norm(x) for x in shape]
    below = dict.fromkeys(_may_be_infinite(parts))
    return [d for d in below if all(p.exp.is_Integer for p in d.atoms(sympy.Pow))]


def _with_norm(part: Expr) -> Expr:
    """n/(a² - b² D) of n/(a + b sqrt(D)) without other roots; anything else as it is."""
    roots = {p for p in part.atoms(sympy.Pow) if abs(p.exp) == S.Half}
    above, below = sympy.fraction(part)
    if len(roots) != 1 or not roots <= below.atoms(sympy.Pow) or above.has(*roots):
        return part
    [root] = roots
    b = sympy.expand(below).coeff(root)
    a = sympy.expand(below - b * root)
    return part if (a * b).has(root) else simplify(above / (a**2 - b**2 * root**2))


# -- checks ------------------------------------------------------------------------------------


def choices(linear: Linearization) -> list[dict[Symbol, mpf]]:
    """Values of parameters (and free coordinates and rates) at which the equilibrium is there.

    Raises
    ------
    ZeroDivisionError
        When none were found.
    """
    entries = (entry for matrix in (linear.M, linear.K) for row in matrix for entry in row)
    rates = {s for entry in entries for s in entry.free_symbols} - {*linear.system.q}
    unknown = (*linear.system.q, *sorted(rates, key=str))  # and parameters, chosen below
    free = {q: mpf(3 + k) / 7 for k, q in enumerate(unknown)}
    known = linear.point.family
    real = [] if known is None else known.radicands
    positive = Evaluator([*linear.point.positive, *real])
    found = []
    for k, choice in enumerate(admissible_values(linear.system, _CHOICES)):
        values = {**free, linear.system.t: mpf((-1) ** k * (k + 1)) / 7, **choice}
        if all(isinstance(x, mpf) and x > 0 for x in positive(values)):
            found.append(values)
    if not found:
        raise ZeroDivisionError
    return found


def _number(expression: Expr | None, values: Mapping[Symbol, mpf]) -> mpf:
    if expression is None:
        return mpf("inf")
    [number] = Evaluator([expression])(values)
    return mpf(number.real) if isinstance(number, mpmath.mpc) else number


def _is_complex(expression: Expr, values: Mapping[Symbol, mpf]) -> bool:
    with mpmath.workdps(DIGITS):
        [number] = Evaluator([expression])(values)
        return isinstance(number, mpmath.mpc) and abs(number.imag) > _ZERO * (1 + abs(number))


def _is_root(characteristic: Characteristic, square: Expr, values: Mapping[Symbol, mpf]) -> bool:
    powers = characteristic.in_square
    if powers is None:
        return False
    with mpmath.workdps(DIGITS):
        [W, *numbers] = Evaluator([square, *powers])(values)
        terms = [c * W**k for k, c in enumerate(numbers)]
        limit = _ROUNDED if is_decimal(square) else _ZERO
        return bool(abs(sum(terms)) < limit * max(mpf(1) / 10**6, *map(abs, terms)))


def _annihilates(
    matrix: Sequence[Sequence[Expr]], vector: Sequence[Expr], values: Mapping[Symbol, mpf]
) -> bool:
    n = len(vector)
    with mpmath.workdps(DIGITS):
        plan = Evaluator([*vector, *(x for row in matrix for x in row)])
        numbers = plan.where_defined(values)
        if numbers is None:
            return False
        v, flat = numbers[:n], numbers[n:]
        for i in range(len(matrix)):
            terms = [a * x for a, x in zip(flat[i * n : (i + 1) * n], v, strict=True)]
            if not abs(sum(terms)) < _ZERO * max(mpf(1), *map(abs, terms)):
                return False
    return True
