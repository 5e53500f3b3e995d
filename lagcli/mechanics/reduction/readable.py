"""U_eff as it is read: squares of the momenta over what they are divided by, then the rest.

Landau, Lifshitz, *Mechanics*, 3rd ed., section 35, problem 1: for the heavy top
(M_z - M_3 cos)^2/(2 I_1 sin^2) + M_3^2/(2 I_3) + mu g l cos.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, shape, simplify, terms
from lagcli.algebra.build import free_of
from lagcli.algebra.factors import factors_of
from lagcli.algebra.leaves import Translator
from lagcli.algebra.one_ratio import in_one_ratio
from lagcli.algebra.signs import between_angles, sign, sign_beside_zero, sign_of_circle
from lagcli.algebra.writing import Writer
from lagcli.expression import ZERO, Expression, operation_count
from lagcli.statements.motions import Above

#: Operations by which a potential as given may exceed another form and is left as it is.
_LONGER = 1


def effective_potential(
    expression: Expr, momenta: Sequence[Symbol], order: Sequence[str], given_V: Expr | None = None
) -> Expression:
    """The shorter of the sum over monomials in the momenta and the sum of squares.

    What has no momenta is left as `given_V`, the potential of the file, has it.
    """
    static = expression.xreplace(dict.fromkeys(momenta, S.Zero))
    given = terms(static, order, ())
    if given_V is not None and is_zero(given_V - static) is True:
        given = _as_given(given_V, order)
    if not momenta:
        return given
    plain = terms(expression, order, {p.name for p in momenta})
    squares = _squares(expression, momenta)
    if squares is None:
        return plain
    writer = Writer(order)
    *quadratic, rest = squares
    parts = [shape(each, order) for each in quadratic]
    linear = not free_of(rest, momenta)
    parts.append(terms(rest, order, {p.name for p in momenta}) if linear else given)
    written = writer.sum(parts)
    longer = operation_count(written) - operation_count(plain)
    return written if longer <= (0 if linear else _LONGER) else plain


def _as_given(potential: Expr, order: Sequence[str]) -> Expression:
    """A potential as the file has it, unless another form is shorter by more than a little."""
    found, given = terms(potential, order, ()), Translator(Writer(order)).tree(potential)
    return given if operation_count(given) <= operation_count(found) + _LONGER else found


def _squares(expression: Expr, momenta: Sequence[Symbol]) -> list[Expr] | None:
    """[k_1 (p_1 + …)²/2, …, what is of lower degree in p]; None without a quadratic form."""
    second = [[simplify(expression.diff(a, b)) for b in momenta] for a in momenta]
    if not momenta or any(not free_of(entry, momenta) for row in second for entry in row):
        return None
    rest = expression
    found = []
    for i in range(len(momenta)):
        pivot = second[i][i]
        if is_zero(pivot) is not False:
            return None
        along = [simplify(entry / pivot) for entry in second[i]]
        linear = sum((c * q for c, q in zip(along[i:], momenta[i:], strict=True)), S.Zero)
        square = pivot * linear**2 / 2
        found.append(square)
        rest -= square
        second = [
            [simplify(second[a][b] - pivot * along[a] * along[b]) for b in range(len(momenta))]
            for a in range(len(momenta))
        ]
    return [*found, simplify(rest)]


def deciding(expression: Expr, positive: Sequence[Expr] = ()) -> Expr:
    """A polynomial that is positive just where the expression is.

    Factors of known sign are left out, and squares that are divided by, which are not 0.
    """
    kept, direction = S.One, 1
    nonzero: dict[Expr, None] = {}
    for factor, power in _with_sines(expression):
        even = power % 2 == 0
        known = 1 if even and factor**2 in positive else None
        known = sign(factor**2 if even else factor, positive) if known is None else known
        if known is None and power < 0:
            known = _beside_zero(factor)
        if known is not None:
            direction *= known if power % 2 else 1
        elif factor.is_Pow and factor.exp.is_Rational and not factor.exp.is_Integer:
            rest = S.One if sign(factor.base, positive) == 1 else deciding(factor.base, positive)
            kept *= S.One if rest in {x**2 for x in nonzero} else rest
        elif isinstance(factor, sympy.Abs):
            nonzero[factor.args[0]] = None
        elif even:
            nonzero |= {factor: None} if power > 0 else {}
        else:
            kept *= factor
    return direction * sympy.Mul(kept, *(x**2 for x in nonzero))


def _with_sines(expression: Expr) -> list[tuple[Expr, int]]:
    """The factors, cos² - 1 among them as -sin², which has one sign."""
    powers = dict(factors_of(expression))
    for factor in list(powers):
        less = factor - 2
        if isinstance(factor - 1, sympy.cos) and powers.get(less) == powers[factor]:
            power = powers.pop(less)
            del powers[factor]
            powers[sympy.sin((factor - 1).args[0])] = 2 * power
            powers[S.NegativeOne] = powers.get(S.NegativeOne, 0) + power
    return list(powers.items())


def is_positive(expression: Expr, positive: Sequence[Expr] = ()) -> bool:
    """Whether it is positive wherever it is finite: what it is divided by is not 0."""
    return sign(expression, positive) == 1 or _by_factors(expression, positive) == 1


def weak_sign(expression: Expr, positive: Sequence[Expr] = ()) -> int | None:
    """1 or -1 where the expression has no other sign, though it may be 0; else None."""
    return _by_factors(expression, positive, zeros=True)


@between_angles
def _by_factors(
    expression: Expr, positive: Sequence[Expr] = (), *, zeros: bool = False
) -> int | None:
    """The sign where no divisor is 0, nor the expression itself, which `zeros` allows."""
    result = 1
    for factor, power in factors_of(expression):
        beside_zero = zeros or power < 0
        if power % 2 == 0 and beside_zero:
            continue
        known = sign(factor**power, positive)
        known = _beside_zero(factor) if beside_zero and not known else known
        if known is None:
            return None
        result *= known
    return result


def without_moduli(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """The expression with x or -x for |x| where x has one sign beside 0."""
    put_in = {
        modulus: known * modulus.args[0]
        for modulus in expression.atoms(sympy.Abs)
        if (known := weak_sign(modulus.args[0], positive)) is not None
    }
    return simplify(expression.xreplace(put_in)) if put_in else expression


def _beside_zero(factor: Expr) -> int | None:
    """The sign of what has only one beside 0: roots, moduli, cos - 1 and cos + 1."""
    if isinstance(factor, sympy.Abs) or (factor.is_Pow and factor.exp == S.Half):
        return 1
    return sign_of_circle(factor) or sign_beside_zero(factor)


def conditions(
    expressions: Sequence[Expr], order: Sequence[str], positive: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """What must be positive, without what the others imply."""
    solved = _in_ratios(expressions, positive)
    split = [part for expression in solved for part in _without_squares(expression)]
    kept = _without_implied(sorted(split, key=_is_square), order, positive)
    return tuple(dict.fromkeys(each for each, _ in kept))


def opposites(
    expressions: Sequence[Expr], order: Sequence[str], positive: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """The opposite inequalities of `conditions`, those that can hold."""
    solved = _in_ratios(expressions, positive)
    plain = [_without_zeros(each, solved) for each in solved]
    kept = _without_implied(plain, order, positive, squares=True)
    possible = [each for each, rest in kept if weak_sign(rest, positive) != 1]
    return tuple(dict.fromkeys(Above(each.right, each.left) for each in possible))


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
            if squares and any(p > 0 and p % 2 == 0 for _, p in _with_sines(rest)):
                others = list(positive)
            shorter = above(rest, order, others)
            found[k : k + 1] = [] if shorter is None else [(shorter, deciding(rest, others))]
    return found


def _without_squares(expression: Expr) -> list[Expr]:
    """k p² > 0 is k > 0 and p² > 0, which is p ≠ 0."""
    rest = deciding(expression)
    squares = [f**p for f, p in _with_sines(rest) if p % 2 == 0 and p > 0]
    other = simplify(rest / sympy.Mul(*squares))
    return [*([] if other == 1 else [other]), *squares] if squares else [expression]


def _is_square(expression: Expr) -> bool:
    return bool(expression.is_Pow and expression.exp % 2 == 0)


def _implies(given: Expr, expression: Expr) -> bool:
    """Whether the expression is a positive multiple of what is positive, and something positive."""
    if _is_square(expression) and expression.base.is_Symbol:  # given fails at x = 0
        at_zero = given.xreplace({expression.base: S.Zero})
        return at_zero == 0 or weak_sign(at_zero) == -1
    own, other = (e.expand().as_coefficients_dict() for e in (expression, given))
    ratios = {own[term] / other[term] for term in own if term in other}
    rests = (simplify(expression - ratio * given) for ratio in ratios if ratio.is_positive)
    return any(rest == 0 or weak_sign(rest) == 1 for rest in rests)


def above(expression: Expr, order: Sequence[str], positive: Sequence[Expr] = ()) -> Above | None:
    """`left > right` for an expression that is to be positive; None where it always is."""
    rest = deciding(expression, positive)
    if rest == 1:
        return None
    if any(power % 2 == 0 for _, power in _with_sines(rest)):
        return Above(shape(rest, order), ZERO)
    differences = [factor for factor, _ in factors_of(rest) if factor.is_Add]
    if len(differences) == 2 and all(map(_is_difference, differences)):  # (A - B) (A - C) > 0
        return Above(shape(rest, order), ZERO)
    by_monomial: dict[Expr, Expr] = {}
    for term in rest.expand().as_ordered_terms():
        number, monomial = term.as_independent(*term.free_symbols, as_Add=False)
        by_monomial[monomial] = by_monomial.get(monomial, S.Zero) + number
    right = -sympy.Add(*(n * m for m, n in by_monomial.items() if n < 0))
    left = sympy.Add(*(n * m for m, n in by_monomial.items() if n > 0))
    found = Above(shape(left, order), shape(right, order))
    constant, others = left.as_coeff_Add()
    if constant > 0 and others != 0:  # 1 > 27 mu (1 - mu)
        other = Above(shape(constant, order), shape(simplify(right - others), order))
        found = min(found, other, key=_operations)
    return found


def _is_difference(factor: Expr) -> bool:
    """A - B."""
    return len(factor.args) == 2 and sum(t.could_extract_minus_sign() for t in factor.args) == 1


def _operations(each: Above) -> int:
    return operation_count(each.left) + operation_count(each.right)
