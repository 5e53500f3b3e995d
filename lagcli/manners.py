"""How a file writes its formulas, and answers written in the same manner.

The algebra decides what is bracketed with what.  Which way round a difference stands, where a
minus goes and whether a number comes first does not change a value, and follows the file:

    R − a where the file has R − a, not a − R;      1 − cos θ, not cos θ − 1;
    l √l for l^(3/2);      cot θ for 1/tan θ;       (a − b)/(…), not −(b − a)/(…).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from typing import TypeAlias

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    walk,
)
from lagcli.problem_data import Problem
from lagcli.rewriting import rebuilt
from lagcli.signs_of_sums import sign_at_random

Key: TypeAlias = tuple[object, ...]

_ODD = frozenset(("sin", "tan", "sinh", "tanh", "asin", "atan", "asinh", "atanh", "sign"))
_EVEN = frozenset(("cos", "cosh", "abs", "sec"))
_INVERSE = {"tan": "cot", "cot": "tan"}
_PARTS = (
    "definitions", "points", "kinetic", "potential", "lagrangian", "hamiltonian", "forces",
    "dissipation", "symmetries", "observables", "initial", "find",
)  # fmt: skip


def signed_key(node: Expression) -> tuple[int, Key]:
    """(sign, key): equal keys for what is equal up to its sign and the order of terms and factors.

    The sign says which of the two it is, so that a − b and b − a have one key and two signs.
    """
    match node:
        case Negative(operand=operand):
            sign, key = signed_key(operand)
            return -sign, key
        case Sum(terms=terms):
            pairs = sorted(((k, s) for s, k in map(signed_key, terms)), key=repr)
            lead = pairs[0][1]
            return lead, ("+", *((s * lead, k) for k, s in pairs))
        case Product(factors=factors):
            signed = [signed_key(each) for each in factors]
            minus = sum(s < 0 for s, _ in signed) % 2
            return -1 if minus else 1, ("*", *sorted((k for _, k in signed), key=repr))
        case Quotient(numerator=above, denominator=below):
            (a, one), (b, other) = signed_key(above), signed_key(below)
            return a * b, ("/", one, other)
        case Power(base=base, exponent=exponent):
            sign, key = signed_key(base)
            return (1 if _parity(exponent) == 0 else sign), ("^", key, signed_key(exponent))
        case Call(function=function, arguments=arguments, primes=primes):
            inner = [signed_key(each) for each in arguments]
            if function in _EVEN:
                return 1, (function, inner[0][1])
            if function in _ODD:
                return inner[0][0], (function, inner[0][1])
            return 1, (function, primes, *inner)
        case PartialCall(function=function, indices=indices, arguments=arguments):
            return 1, (function, indices, *map(signed_key, arguments))
        case _:
            return 1, (str(node),)


class Manner:
    """The way in which one file writes sums.

    Parameters
    ----------
    problem
        Whose formulas are taken as the example.
    """

    def __init__(self, problem: Problem) -> None:
        self._signs: dict[Key, int] = {}  # of a sum: that of the file, 0 where it has both
        self._known: dict[tuple[Expression, bool], Expression] = {}
        self._below: dict[Key, int] = {}  # of a denominator: its sign when it was first written
        quantities = (*problem.parameters, *problem.coordinates)
        self._positive = frozenset(q.name for q in quantities if q.assume == "positive")
        for node in given(problem):
            for part in walk(node):
                if isinstance(part, Sum):
                    sign, key = signed_key(part)
                    self._signs[key] = sign if self._signs.get(key, sign) == sign else 0

    def __call__(self, node: Expression) -> Expression:
        """The formula as the file would write it; its value stays."""
        return self._in_manner(node, inside=False)

    def _in_manner(self, node: Expression, *, inside: bool) -> Expression:
        """The same; `inside` a function or a root the sign of a denominator is left alone."""
        if isinstance(node, (Name, Number)):
            return node
        known = self._known.get((node, inside))
        if known is None:
            deeper = inside or isinstance(node, (Call, PartialCall))
            parts = rebuilt(node, lambda part: self._in_manner(part, inside=deeper))
            known = self._known[node, inside] = self._written(parts, inside=inside)
        return known

    def _written(self, node: Expression, *, inside: bool) -> Expression:
        match node:
            case Product(factors=(*_, Sum(terms=(first, *_)) as series)) if first == ONE:
                # a period, 2 pi sqrt(l/g) (1 + a²/16): what stands before the series stays there
                before = _quotient(list(node.factors[:-1]), [])
                return _joined(self._written(before, inside=inside), series)
            case Product() | Quotient():
                return self._signed(_with_whole_powers(node), inside=inside)
            case Power():
                return self._power(node)
            case Call(function=function, arguments=(Sum() as inner,)) if function in _ODD | _EVEN:
                return self._function(node, inner)
            case Negative(operand=Negative(operand=inner)):
                return inner
            case Negative(operand=Sum() as inner) if self._wrong(negative_of(inner)) is False:
                return negative_of(inner)
            case Negative(operand=Product() | Quotient() as inner):
                return self._signed(node, inside=inside) if _sums(inner) else node
            case Sum(terms=(one, other)) if angle := _difference_of_angles(one, other):
                return angle
            case Sum():
                return _ordered(node)
            case Call(function="sqrt", arguments=(Quotient(numerator=above) as inner,)):
                # sqrt(1/x) = 1/sqrt(x)
                return node if above != ONE else Quotient(ONE, Call("sqrt", (inner.denominator,)))
            case _:
                return node

    def _wrong(self, node: Sum, *, below: bool = False) -> bool | None:
        """Whether the other sign is the better one; None where neither is.

        A denominator stands as it stood the last time: the rows of an answer have the same one.
        """
        sign, key = signed_key(node)
        given = self._signs.get(key, 0) or (self._below.get(key, 0) if below else 0)
        if given:
            return given != sign
        if below and (found := sign_at_random(node, self._positive)):
            return found < 0
        number = next((t for t in node.terms if _is_number(t)), None)
        if number is not None:
            return isinstance(number, Negative)
        return True if all(isinstance(t, Negative) for t in node.terms) else None

    def _function(self, node: Call, inner: Sum) -> Expression:
        """sin(a − b) = −sin(b − a), cos(a − b) = cos(b − a)."""
        if not self._wrong(inner) or _constant(inner):
            return node
        turned = Call(node.function, (negative_of(inner),), node.primes)
        return turned if node.function in _EVEN else Negative(turned)

    def _power(self, node: Power) -> Expression:
        base = node.base
        if isinstance(base, Sum) and _parity(node.exponent) == 0:
            wrong = self._wrong(base)
            if wrong or (wrong is None and _begins_better(base)):
                return Power(negative_of(base), node.exponent)
        return _with_whole_powers(node)

    def _signed(self, node: Expression, *, inside: bool) -> Expression:
        """A product or quotient with every sum in its right sign, the sign of all before it."""
        minus, above, below = _parts(node)
        free: list[tuple[list[Expression], int]] = []  # sums that may stand either way
        for factors in (above, below):
            for place, factor in enumerate(factors):
                base, odd = _odd_base(factor)
                if base is None or not odd:
                    continue
                wrong = self._wrong(base, below=factors is below and not inside)
                if wrong:
                    factors[place] = _with_base(factor, negative_of(base))
                    minus = not minus
                elif wrong is None:
                    free.append((factors, place))
        for factors, place in free if minus else ():
            base, _ = _odd_base(factors[place])
            assert base is not None
            if 2 * sum(isinstance(t, Negative) for t in base.terms) >= len(base.terms):
                factors[place] = _with_base(factors[place], negative_of(base))
                minus = False
                break
        for factor in () if inside else below:
            base, _ = _odd_base(factor)
            if base is not None:
                sign, key = signed_key(base)
                self._below.setdefault(key, sign)
        whole = _quotient(above, below)
        return Negative(whole) if minus else whole


def given(problem: Problem) -> Iterator[Expression]:
    """The formulas of the file that say what the system is."""
    for name in _PARTS:
        yield from _expressions(getattr(problem, name))
    for constraint in problem.constraints:
        left, right = constraint.equation.left, constraint.equation.right
        yield from (left, right)


_DECIMAL = re.compile(r"(?<![\w.])(\d+\.\d*|\.\d+)(?![\w.])")


def decimals_of(problem: Problem, settings: Iterable[str] = ()) -> list[Fraction]:
    """The values that the formulas of the file, or settings, write with a decimal point."""
    lines = problem.source.text.splitlines()
    found = []
    state = set(map(id, _expressions(problem.initial)))
    for node in given(problem):
        for part in walk(node):
            if id(node) in state:
                break
            if isinstance(part, Number) and part.value.denominator != 1 and part.span.line:
                place = part.span
                written = lines[place.line - 1 : place.line]
                if any("." in line[place.column - 1 : place.end_column - 1] for line in written):
                    found.append(part.value)
    for setting in settings:
        value = setting.partition("=")[2]
        found += [Fraction(text) for text in _DECIMAL.findall(value)]
    return [value for value in found if value.denominator != 1]


def _expressions(value: object) -> Iterator[Expression]:
    if isinstance(value, Expression):
        yield value
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from _expressions(part)
    elif isinstance(value, tuple):
        for part in value:
            yield from _expressions(part)
    elif hasattr(value, "__match_args__") or hasattr(type(value), "__dataclass_fields__"):
        for name in getattr(type(value), "__dataclass_fields__", ()):
            yield from _expressions(getattr(value, name))


def negative_of(node: Sum) -> Sum:
    """The sum of the terms with their signs changed, a positive one first where there is one."""
    terms = [t.operand if isinstance(t, Negative) else Negative(t) for t in node.terms]
    if isinstance(terms[0], Negative):
        for place, term in enumerate(terms):
            if not isinstance(term, Negative):
                terms.insert(0, terms.pop(place))
                break
    return Sum(tuple(terms))


def _ordered(node: Sum) -> Sum:
    """The sum without brackets around inner sums, a positive term first where there is one."""
    terms: list[Expression] = []
    for term in node.terms:
        terms.extend(term.terms if isinstance(term, Sum) else (term,))
    if isinstance(terms[0], Negative) and not _accelerates(terms[0]):
        place = next((k for k, t in enumerate(terms) if not isinstance(t, Negative)), 0)
        terms.insert(0, terms.pop(place))
    return node if tuple(terms) == node.terms else Sum(tuple(terms))


def _difference_of_angles(one: Expression, other: Expression) -> Expression | None:
    """cos a cos b + sin a sin b = cos(a - b), sin a cos b - cos a sin b = sin(a - b)."""
    match (one, other):
        case (
            Product(factors=(Call(function="sin", arguments=(a,)), Call(arguments=(b,)) as second)),
            Product(factors=(Call(function="cos", arguments=(c,)), Call(arguments=(d,)) as fourth)),
        ) if (a, b) == (c, d) and second.function == "sin" and fourth.function == "cos":
            return Call("cos", (Sum((a, Negative(b))),))
        case (
            Product(factors=(Call(function="sin", arguments=(a,)), Call(arguments=(b,)) as second)),
            Negative(
                operand=Product(
                    factors=(Call(function="sin", arguments=(c,)), Call(arguments=(d,)) as fourth)
                )
            ),
        ) if (a, b) == (d, c) and second.function == fourth.function == "cos":
            return Call("sin", (Sum((a, Negative(b))),))
        case _:
            return None


def _begins_better(node: Sum) -> bool:
    """Whether the square of −f(x) y + x is better written as that of x − f(x) y."""
    match node.terms:
        case (first, Negative(operand=Name())):
            return not isinstance(first, (Name, Negative, Number))
        case _:
            return False


def _accelerates(node: Expression) -> bool:
    return any(isinstance(part, Name) and part.primes > 1 for part in walk(node))


def _parts(node: Expression) -> tuple[bool, list[Expression], list[Expression]]:
    """Whether there is a minus, the factors above and those below."""
    match node:
        case Negative(operand=inner):
            minus, above, below = _parts(inner)
            return not minus, above, below
        case Quotient(numerator=numerator, denominator=denominator):
            one, above, under = _parts(numerator)
            other, below, over = _parts(denominator)
            return one ^ other, [*above, *over], [*under, *below]
        case Product(factors=factors):
            found = [_parts(factor) for factor in factors]
            minus = sum(m for m, _, _ in found) % 2 == 1
            above = [f for _, parts, _ in found for f in parts if f != ONE]
            return minus, above or [ONE], [f for _, _, parts in found for f in parts]
        case _:
            return False, [node], []


def _joined(before: Expression, last: Sum) -> Expression:
    if isinstance(before, Negative):
        return Negative(_joined(before.operand, last))
    factors = before.factors if isinstance(before, Product) else (before,)
    return Product((*factors, last))


def _quotient(above: list[Expression], below: list[Expression]) -> Expression:
    whole = above[0] if len(above) == 1 else Product(tuple(above))
    if not below:
        return whole
    return Quotient(whole, below[0] if len(below) == 1 else Product(tuple(below)))


def _odd_base(node: Expression) -> tuple[Sum | None, bool]:
    """The sum that a factor is, or is an odd whole power of."""
    if isinstance(node, Sum):
        return node, True
    if isinstance(node, Power) and isinstance(node.base, Sum):
        return node.base, _parity(node.exponent) == 1
    return None, False


def _with_base(node: Expression, base: Sum) -> Expression:
    return Power(base, node.exponent) if isinstance(node, Power) else base


def _parity(exponent: Expression) -> int | None:
    """0 or 1 of a whole number, None of anything else."""
    match exponent:
        case Number(value=value) | Negative(operand=Number(value=value)):
            return value.numerator % 2 if value.denominator == 1 else None
        case _:
            return None


def _sums(node: Expression) -> bool:
    _, above, below = _parts(node)
    return any(_odd_base(factor)[0] is not None for factor in (*above, *below))


def _is_number(node: Expression) -> bool:
    inner = node.operand if isinstance(node, Negative) else node
    return isinstance(inner, Number)


def _constant(node: Expression) -> bool:
    return not any(isinstance(part, Name) for part in walk(node))


# -- powers of letters ----------------------------------------------------------------------


def _with_whole_powers(node: Expression) -> Expression:
    """l^(3/2) as l sqrt(l), 1/tan as cot, in a product, a quotient or alone."""
    if isinstance(node, Power):
        return _quotient(_whole(node), [])
    minus, above, below = _parts(node)
    turned = {id(f): other for f in below if (other := _reciprocal(f)) is not None}
    if turned:
        below = [f for f in below if id(f) not in turned]
        above = [*(f for f in above if f != ONE), *turned.values()]
    above = [part for factor in above for part in _whole(factor)]
    below = [part for factor in below for part in _whole(factor)]
    whole = _quotient(above or [ONE], below)
    return Negative(whole) if minus else whole


def _reciprocal(node: Expression) -> Expression | None:
    """cot for 1/tan, also of powers; None of anything else."""
    match node:
        case Call(function=function, arguments=arguments, primes=0) if function in _INVERSE:
            return Call(_INVERSE[function], arguments)
        case Power(base=base, exponent=exponent):
            inner = _reciprocal(base)
            return None if inner is None else Power(inner, exponent)
        case _:
            return None


def _whole(node: Expression) -> list[Expression]:
    """The factors x^n, sqrt(x) of x^(n + 1/2)."""
    if not isinstance(node, Power) or not isinstance(node.base, (Name, Call)):
        return [node]
    exponent = _half(node.exponent)
    if exponent is None or exponent < 1:
        return [node]
    whole = Number(Fraction(exponent.numerator // 2))
    power = node.base if whole == ONE else Power(node.base, whole)
    return [power, Call("sqrt", (node.base,))]


def _half(node: Expression) -> Fraction | None:
    """n/2 of an exponent that is one, n odd."""
    match node:
        case Number(value=value) if value.denominator == 2:
            return value
        case Quotient(numerator=Number(value=a), denominator=Number(value=b)) if b == 2:
            return Fraction(a, 2) if a.denominator == 1 else None
        case _:
            return None
