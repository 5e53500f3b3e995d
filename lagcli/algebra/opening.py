"""Other forms of a system of equations where none of them can be solved by itself.

- Of two whose terms of highest degree are proportional, a multiple of one is taken from the
  other: two circles become a circle and a line.
- n equations that are linear in the inverses of n square roots are solved for these: the
  forces of two centres give the two distances.  Where the determinant vanishes is a branch
  of its own.
- |f| is f, -f or 0, and the sign of f is 1, -1 or 0.
- sin u = ± sin v and cos u = ± cos v, among the equations and the sums and differences of two,
  relate the angles linearly.
- A function of one sign is 0 only where its derivatives are: x² + y² only for x = y = 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import gcd

import sympy
from sympy import Dummy, Expr, Symbol

from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.factors import factors_of
from lagcli.algebra.linear import solve_linear
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import is_zero, simplify
from lagcli.record import record

_MOST_ROOTS = 3  # measured: at most 3, of which each has its own equation
_WAVES = (sympy.sin, sympy.cos)
_POWERS = (0, 1, -1, 2, -2, 3, -3)


@record
class Opened:
    """Equations that hold with f > 0 for every f of `positive`."""

    equations: tuple[Expr, ...]
    positive: tuple[Expr, ...] = ()


def opened(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    """The branches that together have the same solutions; none where no form is better."""
    return (
        _without_moduli(equations, unknowns)
        or _by_equal_angles(equations, unknowns)
        or _lowered(equations, unknowns)
        or _at_extrema(equations, unknowns)
    )


def whole_angles(equation: Expr, unknowns: Sequence[Symbol]) -> Expr:
    """With sin x in place of 2 sin(x/2) cos(x/2), where no function of x/2 is left then."""

    def halves(e: Expr) -> bool:
        angles = (f.args[0] for f in e.atoms(*_WAVES))
        return any(angle.coeff(x).is_Rational and angle.coeff(x).q == 2
                   for angle in map(sympy.expand, angles) for x in unknowns)  # fmt: skip

    if not halves(equation):
        return equation
    found = sympy.expand(equation).replace(lambda e: e.is_Mul or e.is_Pow, _doubled)
    return equation if halves(found) else found


def _doubled(product: Expr) -> Expr:
    """sin x cos x, sin² x and cos² x by the sine and the cosine of 2 x."""
    powers = product.as_powers_dict()
    for x in {f.args[0] for f in product.atoms(*_WAVES)}:
        s, c = sympy.sin(2 * x), sympy.cos(2 * x)
        own = powers[sympy.sin(x)], powers[sympy.cos(x)]
        image = {(1, 1): s, (2, 0): 1 - c, (0, 2): 1 + c}.get(own)
        if image is not None:
            product *= image / (2 * sympy.sin(x) ** own[0] * sympy.cos(x) ** own[1])
    return product


def _by_equal_angles(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    """sin u + sin v = 2 sin((u + v)/2) cos((u - v)/2) and its like, where an unknown turns once."""
    turning = [x for x in unknowns if turns(equations, x)]
    sums = ((e, (e,)) for e in equations)
    pairs = ((f + sign * g, (f,)) for f, g in combinations(equations, 2) for sign in (1, -1))
    for whole, replaced in (*sums, *pairs):
        found = _equal_angles(sympy.expand(whole))
        if found is None:
            continue
        rest = [e for e in equations if e not in replaced]
        if all(any(abs(branch.coeff(x)) == 1 for x in turning) for branch in found):
            return [Opened((branch, *rest)) for branch in found]
    return []


def turns(equations: Sequence[Expr], x: Symbol) -> bool:
    """Whether all is periodic in x with the period 2 pi: sines and cosines of whole multiples."""

    def is_wave(f: Expr) -> bool:
        return isinstance(f, CIRCULAR) and bool(f.args[0].diff(x).is_Integer)

    return all(free_of(e.replace(is_wave, lambda _: Dummy()), [x]) for e in equations)


def phases(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> dict[Symbol, Expr]:
    """The phases d ≠ 0 of unknowns that occur in sines and cosines of c (x - d) only."""
    found: dict[Symbol, Expr] = {}
    for x in unknowns:
        waves = {f for e in equations for f in e.atoms(*CIRCULAR) if not free_of(f, [x])}
        angles = [sympy.expand(f.args[0]) for f in waves]
        hidden: dict[Expr, Expr] = {f: Dummy() for f in waves}
        masked = [e.xreplace(hidden) for e in equations]
        if x.is_positive is not None or not all(free_of(e, [x]) for e in masked):
            continue
        zeros = {
            sympy.expand(-a.subs(x, 0) / a.diff(x)) if free_of(a.diff(x), unknowns) else x
            for a in angles
        }
        if len(zeros) == 1 and all(e != 0 and free_of(e, unknowns) for e in zeros):
            [found[x]] = zeros
    return found


def common_multiple(equation: Expr, x: Symbol) -> int:
    """n where x occurs in sines and cosines of whole multiples of n x only; else 1."""
    if not turns([equation], x):
        return 1
    slopes = {f.args[0].diff(x) for f in equation.atoms(*CIRCULAR)}  # not whole of sin(c sin(x))
    return gcd(*(int(slope) for slope in slopes if slope.is_Integer)) or 1


def without_phases(equation: Expr, phases: Mapping[Symbol, Expr]) -> Expr:
    """With x + d for x: sin(c x) where sin(c (x - d)) was."""
    moved = equation.xreplace({x: x + d for x, d in phases.items()})
    return moved.replace(
        lambda f: isinstance(f, CIRCULAR), lambda f: f.func(sympy.expand(f.args[0]))
    )


def _equal_angles(whole: Expr) -> tuple[Expr, Expr] | None:
    """What vanishes where c (sin u ± sin v) or c (cos u ± cos v) does, up to whole turns."""
    terms = sympy.Add.make_args(whole)
    waves = [f for term in terms for f in sympy.Mul.make_args(term) if isinstance(f, _WAVES)]
    if len(terms) != 2 or len(waves) != 2 or waves[0].func is not waves[1].func:
        return None
    ratio = (terms[0] * waves[1]) / (terms[1] * waves[0])
    if ratio not in (1, -1):
        return None
    (u,), (v,) = waves[0].args, waves[1].args
    if isinstance(waves[0], sympy.sin):
        return (u + v, u - v - sympy.pi) if ratio == 1 else (u - v, u + v - sympy.pi)
    return (u + v - sympy.pi, u - v - sympy.pi) if ratio == 1 else (u - v, u + v)


def _without_moduli(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    jumps = {m for e in equations for m in e.atoms(sympy.Abs, sympy.sign)}
    jumps = {m for m in jumps if not free_of(m, unknowns)}
    if not jumps:
        return []
    inner = min((m.args[0] for m in jumps), key=sympy.default_sort_key)
    branches = []
    for value in (1, -1, 0):
        images = {sympy.Abs(inner): value * inner, sympy.sign(inner): sympy.Integer(value)}
        put_in = tuple(e.xreplace(images) for e in equations)
        branches.append(Opened(put_in, (value * inner,)) if value else Opened((inner, *put_in)))
    return branches


def _lowered(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    polynomials = [e.as_poly(*unknowns) for e in equations]
    for i, j in combinations(range(len(equations)), 2):
        f, g = polynomials[i], polynomials[j]
        if f is None or g is None or f.total_degree() != g.total_degree():
            continue
        monomial = f.monoms(order="grlex")[0]
        ratio = g.coeff_monomial(monomial)
        rest = simplify((f.LC(order="grlex") * g - ratio * f).as_expr())
        lower = rest.as_poly(*unknowns)
        if rest != 0 and lower is not None and lower.total_degree() < f.total_degree():
            others = [e for k, e in enumerate(equations) if k != j]
            return [Opened((rest, *others))]
    return []


def _at_extrema(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    for e in equations:
        if _one_sign(e, unknowns) is None:
            continue
        slopes = [slope for slope in (simplify(e.diff(x)) for x in unknowns) if slope != 0]
        new = [s for s in slopes if not any(free_of(simplify(s / f), unknowns) for f in equations)]
        if new:
            return [Opened((*new, *equations))]
    return []


def _one_sign(e: Expr, unknowns: Sequence[Symbol]) -> int | None:
    """1 or -1 where e has no other sign: as a x² + b x + c has that of a for b² - 4 a c ≤ 0."""
    known = weak_sign(e)
    if known is not None or not e.is_polynomial(*unknowns):
        return known
    for x, *others in (unknowns[k:] for k in range(len(unknowns))):
        form = e.as_poly(x)
        if form.degree() == 2:
            discriminant = sympy.expand(form.discriminant())
            first = sign(form.LC())
            return first if first and _one_sign(discriminant, others) == -1 else None
    return None


def by_distances(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> list[Opened]:
    """Solved for the square roots that occur, where the equations are linear in them or 1/them."""
    powers = {
        power
        for e in equations
        for power in e.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q == 2 and not free_of(power.base, unknowns)
    }
    bases = sorted({power.base for power in powers}, key=sympy.default_sort_key)
    if not 0 < len(bases) <= min(_MOST_ROOTS, len(equations)):
        return []
    roots = [Dummy(f"#r{k}", positive=True) for k in range(len(bases))]
    images = {
        power: root * power.base ** (power.exp - sympy.S.Half)
        for power in powers
        for base, root in zip(bases, roots, strict=True)
        if power.base == base
    }
    plain = [e.xreplace(images) for e in equations]
    inverted = [_inverted(e, roots) for e in plain]
    whole = [_whole(e, dict(zip(bases, roots, strict=True))) for e in equations]
    for forms, exponent in ((inverted, -1), (plain, 1), (whole, 1)):
        for chosen in combinations(range(len(forms)), len(roots)):
            found = _linear([forms[k] for k in chosen], roots)
            if found is None:
                continue
            values, determinant = found
            conditions = [
                _distance(base, value, exponent, unknowns)
                for base, value in zip(bases, values, strict=True)
            ]
            put_in = dict(zip(roots, values, strict=True))
            rest = [simplify(e.xreplace(put_in)) for k, e in enumerate(forms) if k not in chosen]
            singular = [
                factor for factor, power in factors_of(determinant)
                if power > 0 and not free_of(factor, unknowns)
                and not any(is_zero(factor - base) is True for base in bases)
            ]  # fmt: skip
            return [
                Opened((*conditions, *rest), tuple(values)),
                *(Opened((factor, *equations)) for factor in singular),
            ]
    return []


def _inverted(equation: Expr, roots: Sequence[Symbol]) -> Expr:
    """The equation in w = 1/r, times every r that occurs."""
    own = [r for r in roots if r in equation.free_symbols]
    return simplify(equation.xreplace({r: 1 / r for r in own}) * sympy.Mul(*own))


def _whole(equation: Expr, roots: Mapping[Expr, Symbol]) -> Expr:
    """The numerator with r for the roots, and r^2 written out."""
    images = {
        power: roots[power.base] ** (2 * power.exp)
        for power in equation.atoms(sympy.Pow)
        if power.base in roots and power.exp.is_Rational and power.exp.q == 2
    }
    found = sympy.numer(sympy.together(equation.xreplace(images)))
    if not found.is_polynomial(*roots.values()):
        return found
    for base, root in roots.items():
        poly = sympy.Poly(found, root)
        found = sympy.Add(*(c * base ** (n // 2) * root ** (n % 2) for (n,), c in poly.terms()))
    return found


def _linear(equations: Sequence[Expr], roots: Sequence[Symbol]) -> tuple[list[Expr], Expr] | None:
    """The roots of equations that are linear in them, and the determinant."""
    matrix = [[simplify(e.diff(r)) for r in roots] for e in equations]
    rests = [
        simplify(sympy.Add(*(c * r for c, r in zip(row, roots, strict=True))) - e)
        for row, e in zip(matrix, equations, strict=True)
    ]
    if any(not free_of(entry, roots) for row in (*matrix, rests) for entry in row):
        return None
    solution = solve_linear(matrix, rests)
    if solution is None or solution.determinant is None:
        return None
    return [x for x in solution.values if isinstance(x, Expr)], solution.determinant


def _distance(base: Expr, value: Expr, exponent: int, unknowns: Sequence[Symbol]) -> Expr:
    """base^(exponent/2) = value; where value = c base^k it is solved for the base."""
    for k in _POWERS:
        if all(is_zero(value.diff(x) * base - k * base.diff(x) * value) is True for x in unknowns):
            c = simplify(value / base**k)
            return base - (c**2) ** sympy.Rational(1, exponent - 2 * k)
    return value ** (2 * exponent) - base
