"""What must be positive, as inequalities that are read: without what is known or implied."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import sympy
from sympy import Expr, S

from lagcli.algebra import shape, simplify
from lagcli.algebra.factors import factors_of
from lagcli.algebra.one_ratio import in_one_ratio
from lagcli.algebra.positivity import deciding, sign_of, weak_sign, with_sines
from lagcli.algebra.signs import sign
from lagcli.expression import (
    ZERO,
    Expression,
    Negative,
    Power,
    Sum,
    added_and_subtracted,
    operation_count,
    walk,
)
from lagcli.mechanics.inequalities import shorter_sums
from lagcli.statements.motions import Above

_MOST_KNOWN = 6  # products of up to two of them: 22 are tried
_LONG = 100  # operations


def conditions(
    expressions: Sequence[Expr], order: Sequence[str], positive: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """What must be positive, without what the others imply."""
    positive = _with_numerators(positive)
    expressions = [e for e in expressions if not isinstance(e, sympy.acos)]  # 0 at its end alone
    solved = _in_ratios([_times_known(e, positive) for e in expressions], positive)
    split = [part for expression in solved for part in _without_squares(expression)]
    pairs = _in_pairs(split)
    for k, each in enumerate(pairs):
        pairs[k] = _times_known(each, [*positive, *pairs[:k], *pairs[k + 1 :]])
    split = [part for e in pairs for part in _of_one_sign(e, split, positive)]
    kept = _without_implied(sorted(split, key=_is_square), order, positive)
    return tuple(dict.fromkeys(each for each, _ in kept))


def opposites(
    expressions: Sequence[Expr], order: Sequence[str], positive: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """The opposite inequalities of `conditions`, those that can hold, squares set beside them."""
    positive = _with_numerators(positive)
    solved = _in_ratios([_times_known(e, positive) for e in expressions], positive)
    solved = [e for each in solved for e in _of_one_sign(each, solved, positive, zeros=True)]
    plain = [_without_zeros(each, solved) for each in solved]
    kept = _without_implied(plain, order, positive, squares=True)
    possible = [pair for pair in kept if not _never_negative(pair[1], positive)]
    return tuple(dict.fromkeys(_reversed(*pair, order, positive) for pair in possible))


def _reversed(
    condition: Above, rest: Expr, order: Sequence[str], positive: Sequence[Expr]
) -> Above:
    """The opposite of `condition`, that `rest` is positive: of k p² > 0, k < 0 and p ≠ 0."""
    other, *squares = _without_squares(rest)
    plain = above(other, order) if squares else condition
    assert plain is not None
    besides = (above(square, order, positive) for square in squares)
    return Above(plain.right, plain.left, tuple(each for each in besides if each is not None))


def _with_numerators(positive: Sequence[Expr]) -> list[Expr]:
    """Where a/b > 0, a b > 0 is known too."""
    return list(dict.fromkeys(part for e in positive for part in (e, deciding(e))))


def _times_known(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """The same sign, shorter: where k (k - a) > 0 and k (k + a) > 0, k² - a² > 0 always."""
    if not positive or expression.count_ops() > _LONG:
        return expression
    known = list(dict.fromkeys(map(deciding, positive)))[:_MOST_KNOWN]
    nonzero = [*positive, *(f**2 for p in known for f, _ in factors_of(p))]
    products = (sympy.Mul(*some) for n in range(3) for some in combinations(known, n))
    same = [deciding(expression * product, nonzero) for product in products]
    shortest = min(same, key=lambda e: int(e.count_ops()))
    return shortest if shortest.count_ops() < deciding(expression).count_ops() else expression


def _in_ratios(expressions: Sequence[Expr], positive: Sequence[Expr]) -> list[Expr]:
    """What must be positive, solved for a ratio of parameters: all for one, else each for its."""
    plain = [deciding(e, positive) for e in expressions]
    together = in_one_ratio(plain, positive)
    if together is not None:
        return together
    each = ((e, in_one_ratio([p], positive)) for e, p in zip(expressions, plain, strict=True))
    return [part for e, parts in each for part in ([e] if parts is None else parts)]


def _without_zeros(expression: Expr, all_: Sequence[Expr]) -> Expr:
    """The expression over x² where at x = 0 another one is negative."""
    for factor, power in factors_of(expression):
        if factor.is_Symbol and power > 0 and power % 2 == 0:
            others = [e.xreplace({factor: S.Zero}) for e in all_ if e is not expression]
            if -1 in map(sign, others):
                expression = simplify(expression / factor**power)
    return expression


def _without_implied(
    expressions: Sequence[Expr], order: Sequence[str], positive: Sequence[Expr], *,
    squares: bool = False,
) -> list[tuple[Above, Expr]]:  # fmt: skip
    """Each with what must be positive for it; `squares` stay that may be 0 with the others."""
    known = list(positive)
    found: list[tuple[Above, Expr]] = []
    for expression in expressions:
        each = above(expression, order, known)
        rest = deciding(expression)
        if each is not None and not any(
            _implies(given, form) for given in known for form in (expression, rest)
        ):
            found = [(a, e) for a, e in found if not _implies(rest, e)]
            found.append((each, rest))
            known.append(rest)
    for _ in range(2):  # what is shorter the first time may imply others
        for inequality, rest in tuple(found):
            k = found.index((inequality, rest))
            others = [*positive, *(e for _, e in found[:k] + found[k + 1 :])]
            if squares and any(p > 0 and p % 2 == 0 for _, p in with_sines(rest)):
                others = list(positive)
            shorter = above(rest, order, others)
            found[k : k + 1] = [] if shorter is None else [(shorter, deciding(rest, others))]
    return found


def _without_squares(expression: Expr) -> list[Expr]:
    """k p² > 0 is k > 0 and p² > 0, which is p ≠ 0."""
    rest = deciding(expression)
    squares = [f**p for f, p in with_sines(rest) if p % 2 == 0 and p > 0]
    other = simplify(rest / sympy.Mul(*squares))
    return [*([] if other == 1 else [other]), *squares] if squares else [expression]


def _in_pairs(expressions: Sequence[Expr]) -> list[Expr]:
    """k (k - a) > 0 and k (k + a) > 0 are k² > a²: k times the sum of both is never negative."""
    left = list(expressions)
    for pair in combinations([e for e in expressions if e.count_ops() <= _LONG], 2):
        first, second = ({f: n for f, n in factors_of(deciding(e)) if n == 1} for e in pair)
        for shared in (f for f in first if f.is_Symbol and f in second):
            others = [simplify(deciding(e) / shared) for e in pair]
            never_below = weak_sign(simplify(shared * sympy.Add(*others))) == 1
            if never_below and all(e in left for e in pair):
                left = [e for e in left if e not in pair] + [simplify(sympy.Mul(*others))]
    return left


def _of_one_sign(
    expression: Expr, all_: Sequence[Expr], positive: Sequence[Expr], *, zeros: bool = False
) -> tuple[Expr, ...]:
    """a b > 0 is a > 0 and b > 0 where another condition excludes that both are negative.

    With `zeros` it excludes, too, that one is negative and the other 0.
    """
    factors = [f for f, _ in factors_of(deciding(expression, positive))]
    if len(factors) != 2 or (zeros and not all(f.is_Symbol for f in factors)):
        return (expression,)
    a, b = factors
    cases: list[tuple[dict[Expr, Expr], tuple[Expr, ...]]] = [({}, (-a, -b))]
    cases += [({a: S.Zero}, (-b,)), ({b: S.Zero}, (-a,))] * zeros
    excluded = any(
        all(sign_of(e.xreplace(put_in), [*positive, *less]) == -1 for put_in, less in cases)
        for e in all_
        if e is not expression
    )
    return (a, b) if excluded else (expression,)


def _never_negative(expression: Expr, positive: Sequence[Expr]) -> bool:
    """Whether it is a square, or its factors beside squares are positive."""
    return weak_sign(expression, positive) == 1 or all(
        _is_square(part) or sign_of(part, positive) == 1 for part in _without_squares(expression)
    )


def _is_square(expression: Expr) -> bool:
    return bool(expression.is_Pow and expression.exp % 2 == 0)


def _implies(given: Expr, expression: Expr) -> bool:
    """Whether the expression is a positive multiple of what is positive, and something positive."""
    if _is_square(expression) and expression.base.is_Symbol:  # given fails at x = 0
        at_zero = given.xreplace({expression.base: S.Zero})
        return at_zero == 0 or weak_sign(at_zero) == -1
    return any(rest == 0 or weak_sign(rest) == 1 for rest in shorter_sums(expression, -given))


def above(expression: Expr, order: Sequence[str], positive: Sequence[Expr] = ()) -> Above | None:
    """`left > right` for an expression that is to be positive; None where it always is."""
    rest = deciding(expression, positive)
    if rest == 1:
        return None
    if any(power % 2 == 0 for _, power in with_sines(rest)):
        return Above(shape(rest, order), ZERO)
    factors = [factor for factor, _ in factors_of(rest) if not factor.is_number]
    differences = [factor for factor in factors if factor.is_Add]
    product = _product(rest, order) if len(differences) > 1 else None
    if differences and len(factors) > len(differences):  # w (A - C) > 0, not A w > C w
        return _product(rest, order)
    if product and len(differences) == 2 and all(map(_is_difference, differences)):
        return product  # (A - B) (A - C) > 0
    if product and len(factors) == 2:
        product = min(product, _squares(rest, factors, order), key=_operations)
    by_monomial: dict[Expr, Expr] = {}
    for term in rest.expand().as_ordered_terms():
        number, monomial = term.as_independent(*term.free_symbols, as_Add=False)
        by_monomial[monomial] = by_monomial.get(monomial, S.Zero) + number
    right = -sympy.Add(*(n * m for m, n in by_monomial.items() if n.is_negative))
    left = sympy.Add(*(n * m for m, n in by_monomial.items() if not n.is_negative))
    if product is not None and _share_a_factor(left, right):
        return product  # (p + q) (A p + B q) < 0
    found = Above(shape(left, order), shape(right, order))
    tree = shape(rest, order)
    powers = (p.base for p in walk(tree) if isinstance(p, Power))
    # k - m a² sin² is not k + m a² cos² - m a², k² (R² - l²)³ > g² is not multiplied out
    if (
        rest.has(sympy.sin, sympy.cos)
        or any(isinstance(base, Sum) for base in powers)
        or _share_a_letter(left, right)
    ):
        found = min(found, Above(*added_and_subtracted(tree)), key=_operations)
    constant, others = left.as_coeff_Add()
    if constant > 0 and right == 0 and not others.is_Add:  # n > -3
        number, power = others.as_coeff_Mul()
        return Above(shape(power, order), shape(-constant / number, order))
    if constant > 0 and others != 0:  # 1 > 27 mu (1 - mu), but 1 + 2 a > b
        subtracted = simplify(right - others)
        other = Above(shape(constant, order), shape(subtracted, order))
        found = min((found, other) if subtracted.is_Add else (other, found), key=_operations)
    return found if product is None else min(found, product, key=_operations)


def _product(rest: Expr, order: Sequence[str]) -> Above:
    """A product > 0, or < 0 where that has fewer minus signs."""
    more, less = shape(rest, order), shape(-rest, order)
    if _minus_signs(less) < _minus_signs(more):
        return Above(ZERO, less)
    return Above(more, ZERO)


def _squares(rest: Expr, factors: Sequence[Expr], order: Sequence[str]) -> Above:
    """u² > v² for (u + v) (u - v) > 0."""
    one, other = factors
    u, v = (sympy.factor(simplify((one + side * other) / 2)) for side in (1, -1))
    number = simplify(rest / (one * other))
    if not number.is_number:  # with powers
        return _product(rest, order)
    more, less = (u, v) if number > 0 else (v, u)
    return Above(shape(more**2, order), shape(less**2, order))


def _minus_signs(tree: Expression) -> int:
    return sum(isinstance(part, Negative) for part in walk(tree))


def _share_a_factor(left: Expr, right: Expr) -> bool:
    """Whether both sides of an inequality have one, beside numbers."""
    factors = [
        {factor for factor, _ in factors_of(side) if not factor.is_number} for side in (left, right)
    ]
    return left != 0 and right != 0 and bool(factors[0] & factors[1])


def _share_a_letter(left: Expr, right: Expr) -> bool:
    """Whether the same power of a letter is on both sides: (A - C) p² > B q² is one side each."""
    powers = [
        {f for term in sympy.Add.make_args(side) for f in sympy.Mul.make_args(term) if f.is_Pow}
        for side in (left, right)
    ]
    return bool(powers[0] & powers[1])


def _is_difference(factor: Expr) -> bool:
    """A - B."""
    return len(factor.args) == 2 and sum(t.could_extract_minus_sign() for t in factor.args) == 1


def _operations(each: Above) -> int:
    return operation_count(each.left) + operation_count(each.right)
