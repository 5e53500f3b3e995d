"""What is remarked on an answer: words with formulas among them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from sympy import Add, Expr, Pow, asin, atan, default_sort_key

from lagcli.algebra import simplify
from lagcli.algebra.factors import factors_of
from lagcli.algebra.positivity import deciding, weak_sign
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.expression import Expression

Remark = str | tuple[str | Expr, ...]
FOR_GIVEN_VALUES = "for the values of the file"


def in_words(remarks: Iterable[Remark]) -> str:
    """All remarks as plain text, each once, their formulas in the grammar."""
    return "; ".join(dict.fromkeys(_plain(remark) for remark in remarks if remark))


def as_parts(
    remarks: Iterable[Remark], tree: Callable[[Expr], Expression]
) -> tuple[str | Expression, ...]:
    """The same with the formulas as trees; empty without remarks."""
    parts: list[str | Expression] = []
    for remark in dict.fromkeys(each for each in remarks if each):
        parts += ["; "] if parts else []
        parts += _trees((remark,) if isinstance(remark, str) else remark, tree)
    return tuple(parts)


def real_where(roots: Iterable[Expr]) -> Iterator[Remark]:
    """What arccosines, arcsines and square roots of parameters ask for to be real and finite."""
    roots = tuple(roots)
    bounds = (simplify(bound) for root in roots for bound in not_negative_where_real(root))
    open_ = (deciding(bound) for bound in bounds if weak_sign(bound) is None)
    divisors = {
        factor
        for root in roots
        for power in root.atoms(Pow)
        if power.exp.is_negative
        for factor in _factors(power.base)
    }
    for bound in dict.fromkeys(each for each in open_ if each != 1):
        less, more = _sides(bound)
        factors = _factors(bound)
        divided = factors & divisors
        if divided == factors:
            yield ("real for ", less, " < ", more)
        else:
            yield ("real for ", less, " ≤ ", more, *_not_zero(divided))


def _factors(product: Expr) -> set[Expr]:
    """What it is made of besides numbers, each of f and -f in one form."""
    found = (f for f, _ in factors_of(product) if not f.is_number)
    return {-f if f.could_extract_minus_sign() else f for f in found}


def _not_zero(divisors: Iterable[Expr]) -> Iterator[str | Expr]:
    for each in sorted(divisors, key=default_sort_key):
        less, more = _sides(each)
        yield from (", ", less, " ≠ ", more)


def positive_where(roots: Iterable[Expr]) -> Iterator[Remark]:
    """What roots ask for that are to be positive, where they may be negative."""
    plain = (root for root in roots if not root.has(asin, atan))
    open_ = [deciding(root) for root in plain if weak_sign(root) is None]
    for bound in dict.fromkeys(each for each in open_ if each != 1):
        less, more = _sides(bound)
        yield ("positive for ", less, " < ", more)


def _sides(difference: Expr) -> tuple[Expr, Expr]:
    terms = Add.make_args(difference.expand())
    negative = [term for term in terms if term.could_extract_minus_sign()]
    return -Add(*negative), Add(*(term for term in terms if term not in negative))


def _plain(remark: Remark) -> str:
    parts = (remark,) if isinstance(remark, str) else remark
    return "".join(str(part).replace("**", "^") for part in parts)


def _trees(
    parts: Iterable[str | Expr], tree: Callable[[Expr], Expression]
) -> Iterator[str | Expression]:
    for part in parts:
        yield part if isinstance(part, str) else tree(part)
