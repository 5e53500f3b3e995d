"""The sign of an expression, proved factor by factor from what is known to be positive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache, wraps

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.factors import irreducible_factors
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.roots import substitute_square
from lagcli.algebra.squares import sign_by_squares

_PRODUCTS = 16  # of given ones, with which one more is multiplied
# One verdict asks for 33,000 signs of 500 expressions: 34 s, and 1.6 s with those kept
_KEPT = 10_000
_MOST_TERMS = 40  # of a discriminant


def between_angles(of: Callable[..., int | None]) -> Callable[..., int | None]:
    """A function for the sign, used again with one angle for each x - y where it finds none."""

    @wraps(of)
    def both(expression: Expr, positive: Sequence[Expr] = (), **options: bool) -> int | None:
        found = of(expression, positive, **options)
        freed = _by_angles_between([expression, *positive]) if found is None else None
        return found if freed is None else both(freed[0], freed[1:], **options)

    return both


@between_angles
def sign(expression: Expr, positive: Sequence[Expr] = ()) -> int | None:
    """1, -1 or 0 where the sign is certain, None where it is not.

    Parameters
    ----------
    positive
        Expressions that are positive, beside what the symbols' assumptions say.
    """
    if expression.is_number:
        return _of_number(expression)
    return _sign_given(expression, tuple(positive))


@lru_cache(_KEPT)
def _sign_given(expression: Expr, positive: tuple[Expr, ...]) -> int | None:
    found = _sign(*_with_signed(expression, positive, sympy.Symbol))
    known = [*positive, *_factors_of_known_sign(positive)] if found is None and positive else []
    if known:
        put_in = _with_signed(expression, known, (sympy.Symbol, sympy.Function))
        found = _sign(*put_in) if put_in[0] != expression else None
    if found is None and (roots := _positive_roots(expression, positive)):
        found = sign(expression.xreplace(roots), positive)
    return _beyond_bounds(expression, known) if found is None else found


def _beyond_bounds(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """The sign with a + d for r where r - a = d > 0 is given: of 4 r³ - 3 a r² + b, of R² - l²."""
    for given in positive:
        for put_in in beyond(given, expression, _positive_symbol(given)):
            others = [e.xreplace(put_in) for e in positive if e is not given]
            found = _sign(expression.xreplace(put_in), others)
            if found is not None:
                return found
    return None


def beyond(given: Expr, expression: Expr, distance: sympy.Symbol) -> Iterator[dict[Expr, Expr]]:
    """Each symbol of the expression by which `given`, linear in it, is the distance."""
    for s in sorted(given.free_symbols & expression.free_symbols, key=str):
        slope = given.diff(s)
        if not slope.has(s) and sign(slope) in (1, -1):
            yield {s: (distance - given.xreplace({s: sympy.S.Zero})) / slope}


def _by_angles_between(expressions: Sequence[Expr]) -> list[Expr] | None:
    """The expressions in an angle u for each x - y in sines and cosines; None without any.

    What has one sign for all u has it for all x and y.
    """
    circular = {f for e in expressions for f in e.atoms(sympy.sin, sympy.cos)}
    angles: dict[Expr, Expr] = {}
    put_in: dict[Expr, Expr] = {}
    for function in sorted(circular, key=sympy.default_sort_key):
        content, between = function.args[0].as_content_primitive()
        if len(between.free_symbols) > 1:
            falls = between.could_extract_minus_sign()
            between, content = (-between, -content) if falls else (between, content)
            u = angles.setdefault(between, sympy.Symbol(f"#angle{len(angles)}", real=True))
            put_in[function] = function.func(content * u)
    return [e.xreplace(put_in) for e in expressions] if put_in else None


def _positive_roots(expression: Expr, positive: Sequence[Expr]) -> dict[Expr, Expr]:
    """Positive symbols for the roots of what is known to be positive."""
    return {
        root: _positive_symbol(root)
        for root in expression.atoms(sympy.Pow)
        if root.exp.is_Rational and not root.exp.is_Integer and sign(root.base, positive) == 1
    }


@lru_cache(_KEPT)
def _positive_symbol(value: Expr) -> sympy.Symbol:
    """The same one each time, by which what was asked before is known again."""
    return sympy.Dummy(f"#{value}", positive=True)


def _factors_of_known_sign(positive: Sequence[Expr]) -> list[Expr]:
    """cos(x) where (a + cos(x)) cos(x) and a + cos(x) are positive."""
    field = Field(positive)
    try:
        given = [field(each).numerator * field(each).denominator for each in positive]
    except ZeroDivisionError:
        return []
    return [field.polynomial_to_sympy(factor) for factor in _known_factors(field, given)]


def _sign(expression: Expr, positive: Sequence[Expr]) -> int | None:
    field = Field([expression, *positive])
    try:
        element = field(expression)
        given = [
            field(each).numerator * field(each).denominator
            for each in positive
            if sign(each) is None
        ]
    except ZeroDivisionError:
        return None
    if element.is_zero():
        return 0
    known = _known_factors(field, given)
    # no factor of what is positive is 0
    nonzero = [f for poly in given for f, _ in factorization(field.ring.lift(poly))[1]]
    number, factors = irreducible_factors(element)
    result, open_ = 1 if number > 0 else -1, list[Poly]()
    for factor, exponent in factors:
        found = _of_factor(field, factor, known)
        if found is None and _is_nonnegative(field, factor):
            found = 1 if exponent < 0 or _is_modulus_of(field, factor, nonzero) else None
        if found is not None:
            result *= found if exponent % 2 else 1
            continue
        # a square is positive where it is not 0, as what is divided by is not
        if exponent % 2:
            open_.append(factor)
        elif exponent > 0 and not _is_nonzero(field, factor, nonzero):
            return None
    return _of_product(field, open_, given, result)


def _of_product(
    field: Field, open_: Sequence[Poly], given: Sequence[Poly], others: int
) -> int | None:
    """The sign of `others` times a product: some of the given ones may have just its factors."""
    seen = list(open_)
    known: dict[frozenset[int], int] = {frozenset(): 1}
    for each in given:
        content, factors = factorization(field.ring.lift(each))
        value, rest = 1 if int(content) > 0 else -1, set()
        for factor, exponent in factors:
            found = _of_factor(field, factor, ())
            value *= found**exponent if found else 1
            if found is None and exponent % 2:
                seen += [] if factor in seen else [factor]
                rest.add(seen.index(factor))
        before = [*known.items()][:_PRODUCTS]
        known |= {other ^ rest: value * of_other for other, of_other in before}
    found = known.get(frozenset(range(len(open_))))
    return None if found is None else others * found


def _known_factors(field: Field, given: Sequence[Poly]) -> list[Poly]:
    """Factors that are positive, one after the other: of a (a + b) > 0 and a + b > 0 a is."""
    known: list[Poly] = []
    while True:
        more = [x for poly in given for x in _open_factors(field, poly, known) if x not in known]
        if not more:
            return known
        known += more


def _with_signed(
    expression: Expr, positive: Sequence[Expr], kinds: type | tuple[type, ...]
) -> tuple[Expr, Sequence[Expr]]:
    """Both with -k' for k where -k is positive: k' is a symbol that is; not 0 where k² is."""
    signs: dict[Expr, Expr] = {}
    for each in positive:
        others = [f for f in sympy.Mul.make_args(each) if f.is_positive is not True]
        open_ = [f for f in others if f.is_negative is not True]
        if len(open_) == 1 and isinstance(open_[0], kinds):
            s, value = open_[0], 1 - 2 * (len(others) % 2 == 0)
            signs[s] = value * sympy.Symbol(f"#{s}", positive=True)
    for square in positive:
        s = square.base if square.is_Pow and square.exp.is_even else None
        if isinstance(s, sympy.Symbol) and not s.is_nonzero and s not in signs:
            signs[s] = sympy.Symbol(f"#{s}", real=True, nonzero=True)
    if not signs:
        return expression, positive
    return expression.xreplace(signs), [each.xreplace(signs) for each in positive]


def sign_beside_zero(expression: Expr) -> int | None:
    """1 or -1 where squares show that the expression has no other sign, though it may be 0."""
    field = Field([expression])
    try:
        element = field(expression)
    except ZeroDivisionError:
        return None
    if element.denominator != 1:
        return None
    for equal in (element.numerator, *_with_squares_swapped(field, element.numerator)):
        found = sign_by_squares(field, equal)
        if found is not None:
            return found[0]
    return None


def _is_nonzero(field: Field, factor: Poly, others: Sequence[Poly]) -> bool:
    known = factor in others or -factor in others
    return known or field.polynomial_to_sympy(factor).is_nonzero is True


def _is_nonnegative(field: Field, factor: Poly) -> bool:
    """Whether it is one generator that is nowhere negative: a root, a modulus."""
    used = field.ring.used(factor)
    return factor == field.ring.generator(used[0]) and field.generators[used[0]].nonnegative


def _is_modulus_of(field: Field, factor: Poly, nonzero: Sequence[Poly]) -> bool:
    """Whether it is |x|, and all factors of x² are among what is not 0."""
    modulus = field.polynomial_to_sympy(factor)
    if not isinstance(modulus, sympy.Abs):
        return False
    square = field(modulus.args[0] ** 2).numerator
    return all(_is_nonzero(field, f, nonzero) for f, _ in factorization(field.ring.lift(square))[1])


def sign_of_circle(factor: Expr) -> int | None:
    """The sign of cos - 1 and cos + 1, where they are not 0."""
    constant, rest = factor.as_coeff_Add()
    if abs(constant) == 1 and isinstance(rest, sympy.cos | sympy.sin):
        return int(constant)
    return None


def _open_factors(field: Field, poly: Poly, known: Sequence[Poly]) -> list[Poly]:
    """The one factor whose sign a positive product decides, made positive; none if several."""
    content, factors = factorization(field.ring.lift(poly))
    value = 1 if int(content) > 0 else -1
    unknown = []
    for factor, exponent in factors:
        # none of the factors is 0, as their product is not
        found = _by_terms(field, factor) or sign_of_circle(field.polynomial_to_sympy(factor))
        if found is None and factor in known:
            found = 1
        if found is None and -factor in known:
            found = -1
        if found is None:
            unknown.append((factor, exponent))
        else:
            value *= found**exponent
    if len(unknown) != 1 or unknown[0][1] % 2 == 0:
        return []
    return [unknown[0][0] * value]


def _of_factor(field: Field, factor: Poly, positive: Sequence[Poly]) -> int | None:
    for equal in (factor, *_with_squares_swapped(field, factor)):
        by_terms = _by_terms(field, equal)
        if by_terms is not None:
            return by_terms
        by_squares = sign_by_squares(field, equal)
        if by_squares is not None and by_squares[1]:
            return by_squares[0]
    for known in positive:
        if factor == field.ring.lift(known):
            return 1
        if -factor == field.ring.lift(known):
            return -1
    expression = field.polynomial_to_sympy(factor)
    if expression.is_number:
        return _of_number(expression)
    if expression.is_positive:
        return 1
    if expression.is_negative:
        return -1
    return (
        _between_ends(field, factor, positive)
        or _beside_root(field, factor, positive)
        or _by_discriminant(field, factor)
    )


def _by_discriminant(field: Field, factor: Poly) -> int | None:
    """The sign of a polynomial a x² + b x + c with 4 a c > b² is that of a."""
    used = field.ring.used(factor)
    if any(field.generators[g].kind != "symbol" for g in used):
        return None
    for g in used:
        if field.ring.degree(factor, g) != 2:
            continue
        parts = field.ring.coefficients(factor, g)
        if set(parts) != {0, 1, 2}:
            continue
        leading = _by_terms(field, parts[2])
        outside = 4 * parts[2] * parts[0] - parts[1] ** 2
        short = sum(1 for _ in field.ring.terms(outside)) <= _MOST_TERMS
        if leading and short and sign(field.polynomial_to_sympy(outside)) == 1:
            return leading
    return None


def _beside_root(field: Field, factor: Poly, positive: Sequence[Poly]) -> int | None:
    """The sign of a + b sqrt(c): that of a where a² > b² c or b has it, too, that of b else."""
    given = [field.polynomial_to_sympy(each) for each in positive]
    for g in field.ring.used(factor):
        parts = field.ring.coefficients(factor, g)
        if field.generators[g].kind != "root" or set(parts) != {0, 1}:
            continue
        a, b = (field.polynomial_to_sympy(parts[k]) for k in (0, 1))
        root = field.generators[g].expression
        first, second = sign(a, given), sign(b, given)
        known = first or second
        if known and (root.is_real or 1 in (sign(root**2, given), sign_beside_zero(root**2))):
            if first == second:
                return first
            rest = sympy.expand(a**2 - b**2 * root**2)
            if _roots(rest) >= _roots(field.polynomial_to_sympy(factor)):
                continue  # no simpler
            decisive = {1: first, -1: second}.get(sign(rest, given) or 0)
            if decisive:
                return decisive
    return None


def _roots(expression: Expr) -> int:
    return sum(not e.exp.is_Integer for e in expression.atoms(sympy.Pow)) + len(
        expression.atoms(sympy.Abs)
    )


def _between_ends(field: Field, factor: Poly, positive: Sequence[Poly]) -> int | None:
    """The sign of a + b cos² where a and a + b have it, of a + b cos where a + b and a - b do."""
    for equal in (factor, *_with_squares_swapped(field, factor)):
        used = field.ring.used(equal)
        for g in used:
            generator, parts = field.generators[g], field.ring.coefficients(equal, g)
            circular = generator.kind in ("cos", "sin") and generator.partner not in used
            if not circular or len(parts) != 2 or 0 not in parts or max(parts) > 2:
                continue
            a, b = parts[0], parts[max(parts)]
            ends = (a + b, a if 2 in parts else a - b)
            signs = {_of_factor(field, end, positive) for end in ends}
            if len(signs) == 1:
                return signs.pop()
    return None


def _with_squares_swapped(field: Field, poly: Poly) -> Iterator[Poly]:
    """The factor with 1 - sin² for a cos², and with 1 - cos² for a sin²."""
    one = field.ring.one
    for g in field.ring.used(poly):
        generator = field.generators[g]
        if generator.kind in ("cos", "sin") and field.ring.degree(poly, g) > 1:
            yield substitute_square(
                field, poly, g, one - field.ring.generator(generator.partner) ** 2
            )


def _by_terms(field: Field, poly: Poly) -> int | None:
    """All terms of one sign, products of positive generators and even powers, one not 0."""
    signs = set()
    never_zero = False
    for monomial, coefficient in field.ring.terms(poly):
        value = 1 if coefficient > 0 else -1
        strict = True
        for g, exponent in monomial:
            expression = field.generators[g].expression
            if exponent % 2 == 0:
                strict = strict and expression.is_nonzero is True
            elif expression.is_nonpositive:
                value = -value
                strict = strict and expression.is_negative is True
            elif expression.is_nonnegative:
                strict = strict and expression.is_positive is True
            else:
                return None
        never_zero = never_zero or strict
        signs.add(value)
    return signs.pop() if len(signs) == 1 and never_zero else None


def _of_number(expression: Expr) -> int | None:
    value = expression.evalf(30)
    if not value.is_real or abs(value) < 1e-20:
        return 0 if expression.is_zero else None
    return 1 if value > 0 else -1
