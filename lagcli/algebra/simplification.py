"""The shortest readable shape of an expression's unique form."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from sympy import Expr

from lagcli.algebra.cancellation import cancelled
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.leaves import Translator
from lagcli.algebra.relations import Relations
from lagcli.algebra.shaping.plan import OPERATION
from lagcli.algebra.shaping.shaper import Shaper
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression, operation_count

_LONG = 60  # terms of an element of which ...
_OF_LONG = 2  # ... no more than these equal forms are shaped


def shape(
    expression: Expr, order: Sequence[str] = (), relations: Relations | None = None
) -> Expression:
    """The shortest readable tree of an expression.

    Parameters
    ----------
    expression
        What to write; anything that is no rational function of the field's generators
        is kept as it is.
    order
        Parameters, ``t``, coordinates, multipliers, as they are to follow in a product.
    relations
        What may be used to shorten it.
    """
    if relations:
        expression = relations.substitute(expression)
    writer = Writer(order)
    field = Field([expression])
    try:
        element = field(expression)
    except ZeroDivisionError:
        return Translator(writer).tree(expression)
    tree, _ = _shortest(field, writer, element, relations)
    given = Translator(writer).tree(expression)
    return given if operation_count(given) < operation_count(tree) else tree


def simplify(expression: Expr, relations: Relations | None = None) -> Expr:
    """The shortest readable shape as a SymPy expression; see `shape`."""
    if relations:
        expression = relations.substitute(expression)
    field = Field([expression])
    try:
        element = field(expression)
    except ZeroDivisionError:
        return expression
    tree, shaper = _shortest(field, Writer(), element, relations)
    given = Translator(shaper.writer).count(expression)
    if given is not None and given < operation_count(tree):
        return expression
    return shaper.to_sympy(tree)


def readable(field: Field, element: Element, relations: Relations | None = None) -> Expr:
    """The shortest readable shape of an element of the field."""
    tree, shaper = _shortest(field, Writer(), element, relations)
    return shaper.to_sympy(tree)


def is_zero(expression: Expr, relations: Relations | None = None) -> bool | None:
    """Whether an expression vanishes, wherever the relations hold.

    Returns
    -------
    True when its normal form is 0 (modulo the relations), False when it certainly does
    not vanish identically, None when the normal form does not decide.
    """
    if relations:
        expression = relations.substitute(expression)
    field = Field([expression])
    try:
        element = field(expression)
    except ZeroDivisionError:
        return None
    if element.is_zero():
        return True
    if relations and relations.remaining:
        return True if relations.contain(field, element.numerator) else None
    return None if field.doubtful else False


def _shortest(
    field: Field, writer: Writer, element: Element, relations: Relations | None
) -> tuple[Expression, Shaper]:
    """The best tree among equal elements, and the shaper that made it."""
    # cancelled first: a reduced numerator may share no factor with the denominator any more
    element = cancelled(field, element)
    candidates = [element]
    if relations:
        candidates.extend(cancelled(field, e) for e in relations.reductions(field, element))
    candidates.sort(key=Element.size)
    if candidates[0].size() > _LONG:
        del candidates[_OF_LONG:]
    shorter = partial(relations.shorter, field) if relations and relations.remaining else None
    shapers = [Shaper(field, writer, shorter=shorter)]
    if field.root_scales:
        shapers.insert(0, Shaper(field, writer, scaled=True, shorter=shorter))
    shapes = [(shaper.plan(each), shaper) for each in candidates for shaper in shapers]
    # sqrt(1 - v²/c²), where it was put in so, may cost one operation more than sqrt(c² - v²)
    plan, shaper = min(shapes, key=lambda pair: pair[0].score - OPERATION * pair[1].scaled)
    return shaper.written(plan), shaper
