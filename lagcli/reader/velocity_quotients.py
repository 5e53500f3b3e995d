"""A constraint with quotients of velocities, multiplied out: it is linear in the velocities."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from lagcli.diagnostics import Source
from lagcli.expression import ZERO, Call, Negative, Quotient, factors_of, terms_of
from lagcli.reader.expressions import read_equation, sides_of
from lagcli.reader.names import derivative_order
from lagcli.reader.positions import Excerpt
from lagcli.reader.text import SourceText

if TYPE_CHECKING:
    from lagcli.expression import Expression
    from lagcli.reader.scope import Scope


def multiplied_out(equation: str, scope: Scope) -> str:
    """`y' = x'*tan(phi)` for `y'/x' = tan(phi)` and `phi = atan(y'/x')`; nothing for others."""
    if not re.search(r"/|atan", equation):
        return ""
    left, right = sides_of(read_equation(Excerpt.whole(Source("", equation))))
    text = SourceText.of(Source("", equation))

    def written(part: Expression) -> str:
        return equation[slice(*text.offsets(part.span))]

    def moves(part: Expression) -> bool:
        return derivative_order(part, scope) > 0

    for side, other in ((left, right), (right, left)):
        match side:
            case (
                Call(function="atan", arguments=(Quotient(numerator=y, denominator=x),))
                | Call(function="atan2", arguments=(y, x))
            ) if moves(x):
                return f"{written(y)} = {written(x)}*tan({written(other)})"
    factors = [part for side in (left, right) for term in terms_of(side)
               for part in factors_of(_size(term))]  # fmt: skip
    below = {written(part.denominator) for part in factors
             if isinstance(part, Quotient) and moves(part.denominator)}  # fmt: skip
    if len(below) != 1:
        return ""
    [divisor] = below

    def times(term: Expression) -> str:
        parts = [*factors_of(_size(term))]
        over = [
            isinstance(part, Quotient) and written(part.denominator) == divisor for part in parts
        ]
        shown = [written(part.numerator if isinstance(part, Quotient) and is_over else part)
                 for part, is_over in zip(parts, over, strict=True)]  # fmt: skip
        shown = shown if any(over) else [divisor, written(_size(term))]
        return "-" * isinstance(term, Negative) + "*".join(shown)

    sides = [" + ".join(map(times, terms_of(side))) for side in (left, right) if side != ZERO]
    return f"{' = '.join(sides).replace('+ -', '- ')}{'' if sides[1:] else ' = 0'}"


def _size(term: Expression) -> Expression:
    return term.operand if isinstance(term, Negative) else term
