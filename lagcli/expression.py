"""Expressions as plain trees: what the reader reads and what the formatters print.

The nodes say how a formula is written, nothing is computed with them.  The reader
makes them from text, `lagcli.algebra` turns them into SymPy (or symengine) objects and
back, the formatters print them.  So neither reading nor printing imports SymPy.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from fractions import Fraction
from operator import attrgetter
from typing import Any, TypeVar

from lagcli.diagnostics import NOWHERE, Span
from lagcli.record import field, record

Value = TypeVar("Value")

#: A fraction within the numerator of another is worth that many operations: the spherical
#: p_r²/(2 m) + (p_theta² + p_phi²/sin²)/(2 m r²), not (p_r² + (p_theta² + …)/r²)/(2 m).
_WITHIN = 2
#: Functions of the grammar with a fixed meaning, and their number of arguments.
FUNCTIONS: dict[str, int] = {
    **dict.fromkeys(
        "sqrt exp log abs sign sin cos tan cot sec csc asin acos atan "
        "sinh cosh tanh asinh acosh atanh".split(),
        1,
    ),
    "atan2": 2,
}

#: Names that cannot be declared: the functions, `diff`, the time and the number pi.
RESERVED = frozenset(FUNCTIONS) | {"diff", "t", "pi"}


@record(kw_only=True)
class Expression:
    """A node; `span` is its place in the file and takes no part in equality."""

    span: Span = field(default=NOWHERE, compare=False, repr=False)


@record
class Number(Expression):
    """An exact non-negative rational: `0.1` is one tenth.

    `decimal` says that it is to be written with a decimal point: only those that
    `--numeric` makes are, and their denominators divide a power of ten.
    """

    value: Fraction
    decimal: bool = field(default=False, compare=False)


@record
class Name(Expression):
    """A name with its primes: `x`, `x'` the velocity, `x''` the acceleration."""

    name: str
    primes: int = 0

    def __str__(self) -> str:
        return self.name + "'" * self.primes


@record
class Negative(Expression):
    """`-operand`."""

    operand: Expression


@record
class PlusMinus(Expression):
    """`±operand`: two formulas in one, the upper sign with the upper one of every other.

    Only pages have it; `minus_above` says that it is ∓.
    """

    operand: Expression
    minus_above: bool = False


@record
class Sum(Expression):
    """Two or more terms; a subtracted term is a `Negative`."""

    terms: tuple[Expression, ...]


@record
class Product(Expression):
    """Two or more factors; a quotient of the file is a `Quotient`."""

    factors: tuple[Expression, ...]


@record
class Quotient(Expression):
    """`numerator / denominator`."""

    numerator: Expression
    denominator: Expression


@record
class Power(Expression):
    """`base ^ exponent`."""

    base: Expression
    exponent: Expression


@record
class Call(Expression):
    """A function at its arguments: `sin(x)`, `U(r)`; with primes `U'(d)`, `U''(d)`."""

    function: str
    arguments: tuple[Expression, ...]
    primes: int = 0


@record
class PartialCall(Expression):
    """`diff(Phi, 1, 2)(a, b)`: Phi differentiated by those arguments (from 1), at (a, b)."""

    function: str
    indices: tuple[int, ...]
    arguments: tuple[Expression, ...]


@record
class Diff(Expression):
    """`diff(operand, name)`: the partial derivative, which sees through definitions."""

    operand: Expression
    variable: Name


@record
class Rate(Expression):
    """d(operand)/dt, named in an explanation; in a file it is a prime."""

    operand: Expression


@record
class Equation:
    """`left = right`; an expression alone is `left = 0`."""

    left: Expression
    right: Expression
    span: Span = field(default=NOWHERE, compare=False, repr=False)


ZERO = Number(Fraction(0))
ONE = Number(Fraction(1))


#: How the direct parts of a node are had: of names and numbers there are none.
_PARTS: dict[type[Expression], Callable[[Any], tuple[Expression, ...]]] = {
    **dict.fromkeys((Negative, PlusMinus, Rate), lambda node: (node.operand,)),
    Sum: attrgetter("terms"),
    Product: attrgetter("factors"),
    Quotient: attrgetter("numerator", "denominator"),
    Power: attrgetter("base", "exponent"),
    **dict.fromkeys((Call, PartialCall), attrgetter("arguments")),
    Diff: attrgetter("operand", "variable"),
}


def children(node: Expression) -> tuple[Expression, ...]:
    """The direct parts of a node."""
    parts = _PARTS.get(type(node))
    return parts(node) if parts else ()


def walk(node: Expression) -> Iterator[Expression]:
    """The node and everything below it, in the order in which it is written."""
    stack = [node]
    while stack:
        top = stack.pop()
        yield top
        stack.extend(reversed(children(top)))


def name_nodes(*formulas: Expression) -> list[Name]:
    """The names of formulas, as often as they stand there."""
    return [node for each in formulas for node in walk(each) if isinstance(node, Name)]


def postorder(node: Expression) -> list[Expression]:
    """The node and everything below it, each after its parts."""
    order: list[Expression] = []
    stack = [node]
    while stack:
        top = stack.pop()
        order.append(top)
        stack.extend(children(top))
    order.reverse()
    return order


def folded(root: Expression, combine: Callable[[Expression, list[Value]], Value]) -> Value:
    """The value of a tree, that of each node from the values of its parts."""
    values: list[Value] = []
    for node in postorder(root):
        first = len(values) - len(children(node))
        parts = values[first:]
        del values[first:]
        values.append(combine(node, parts))
    return values[0]


def signed(value: float | Fraction, *, decimal: bool = False) -> Expression:
    """A number, which is exact, with a `Negative` for its sign."""
    size = Number(abs(Fraction(value)), decimal=decimal)
    return Negative(size) if value < 0 else size


def sum_of(terms: Iterable[Expression]) -> Expression:
    """The sum of some terms; a single one is its own, none are 0."""
    kept = tuple(terms)
    return Sum(kept) if len(kept) > 1 else (*kept, ZERO)[0]


def added_and_subtracted(difference: Expression) -> tuple[Expression, Expression]:
    """The sum of the terms that are added, and of those that are subtracted."""
    terms = difference.terms if isinstance(difference, Sum) else (difference,)
    minus = [term.operand for term in terms if isinstance(term, Negative)]
    return sum_of(t for t in terms if not isinstance(t, Negative)), sum_of(minus)


def product_of(factors: Iterable[Expression]) -> Expression:
    """The product of some factors; a single one is its own, none are 1."""
    kept = tuple(factors)
    return Product(kept) if len(kept) > 1 else (*kept, ONE)[0]


def quotient_of(above: Iterable[Expression], below: Collection[Expression]) -> Expression:
    """The product of the factors above over that of those below, where there are any."""
    divided = any(factor != ONE for factor in below)
    return Quotient(product_of(above), product_of(below)) if divided else product_of(above)


def power_of(base: Expression, exponent: int | Fraction) -> Expression:
    """The power of a base; the first is the base itself."""
    return base if exponent == 1 else Power(base, Number(Fraction(exponent)))


def multiple_of(
    number: Fraction, above: Sequence[Expression], below: Sequence[Expression]
) -> Expression:
    """A number times factors over others: its numerator and denominator stand in front of them."""
    size = abs(number)
    over = [Number(Fraction(size.numerator))] if size.numerator != 1 or not above else []
    under = [Number(Fraction(size.denominator))] if size.denominator != 1 else []
    found = quotient_of(
        *(
            [part for factor in factors for part in factors_of(factor)]
            for factors in ([*over, *above], [*under, *below])
        )
    )
    return Negative(found) if number < 0 else found


def opposite(node: Expression) -> Expression:
    """-a of a, and a of -a."""
    return node.operand if isinstance(node, Negative) else Negative(node)


def all_negative(node: Expression) -> bool:
    """Whether every term has a minus: −a, −a − b."""
    return all(isinstance(term, Negative) for term in terms_of(node))


def without_minus(node: Expression) -> Expression:
    """a + b for −a − b; anything else as it is."""
    return sum_of(map(opposite, terms_of(node))) if all_negative(node) else node


def operation_count(node: Expression) -> int:
    """How many operations a formula shows: signs, sums, products, powers, calls.

    The measure by which readable shapes are compared.
    """
    count = 0
    for part in walk(node):
        match part:
            case Sum(terms=parts) | Product(factors=parts):
                count += len(parts) - 1
            case Name() | Number():
                pass
            case _:
                count += 1
    return count


def length(node: Expression) -> int:
    """How long a formula is to read: its operations, and more for fractions within fractions."""
    above = (part.numerator for part in walk(node) if isinstance(part, Quotient))
    brackets = (part for numerator in above for part in walk(numerator) if isinstance(part, Sum))
    within = sum(isinstance(term, Quotient) for bracket in brackets for term in bracket.terms)
    return operation_count(node) + _WITHIN * within


def has_nested_fraction(node: Expression) -> bool:
    """Whether a fraction stands in a denominator, or in a sum over a sum, of a rational part.

    What a function holds is a part of its own: 1/sqrt(1 - v^2/c^2) has none.
    """
    return any(isinstance(part, Quotient) and _is_nested(part) for part in walk(node))


def terms_of(node: Expression) -> tuple[Expression, ...]:
    """The terms of a sum; of all others the node itself."""
    return node.terms if isinstance(node, Sum) else (node,)


def factors_of(node: Expression) -> tuple[Expression, ...]:
    """The factors of a product; of all others the node itself."""
    return node.factors if isinstance(node, Product) else (node,)


def _is_nested(node: Quotient) -> bool:
    if _has_fraction(node.denominator):
        return True
    over_sum = any(isinstance(part, Sum) for part in _rational_parts(node.denominator))
    return over_sum and any(
        isinstance(part, Sum) and _has_fraction(part) for part in _rational_parts(node.numerator)
    )


def _has_fraction(node: Expression) -> bool:
    return any(isinstance(part, Quotient) for part in _rational_parts(node))


def _rational_parts(node: Expression) -> Iterator[Expression]:
    """The node and its parts but for exponents and what functions hold."""
    stack = [node]
    while stack:
        top = stack.pop()
        yield top
        if isinstance(top, Power):
            stack.append(top.base)
        elif not isinstance(top, (Call, PartialCall)):
            stack.extend(children(top))
