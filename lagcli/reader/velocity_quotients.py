"""Constraints with quotients or squares of velocities, as they are linear in the velocities."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from fractions import Fraction
from itertools import product

from lagcli.diagnostics import Source
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import (
    ZERO,
    Call,
    Equation,
    Expression,
    Negative,
    Number,
    Power,
    Quotient,
    factors_of,
    name_nodes,
    terms_of,
)
from lagcli.reader.expressions import read_equation, sides_of
from lagcli.reader.foreign.functions import bare_text
from lagcli.reader.habits import is_angle
from lagcli.reader.names import derivative_order
from lagcli.reader.positions import Excerpt
from lagcli.reader.scope import Scope
from lagcli.reader.text import SourceText, numbered

_TWO = Number(Fraction(2))
#: x' and y' by the speed, for a heading that is measured from the x or the y axis, either way.
_HEADINGS = (("cos", "sin"), ("sin", "cos"), ("-sin", "cos"), ("cos", "-sin"))


def multiplied_out(equation: str, scope: Scope) -> str:
    """`y' = x'*tan(phi)` for `y'/x' = tan(phi)` and `phi = atan(y'/x')`; nothing for others."""
    if not re.search(r"/|atan", equation):
        return ""
    left, right = sides_of(read_equation(Excerpt.whole(Source("", equation))))
    text = SourceText.of(Source("", equation))

    def written(part: Expression) -> str:
        return text.written(part.span)

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


def without_squares(name: str, written: str, others: Iterable[Equation], scope: Scope) -> str:
    """`x' = s*cos(theta)` and `y' = s*sin(theta)` for `x'^2 + y'^2 = s^2`; else nothing.

    The heading theta is that of the other constraints, or the only angle that is left.  Of
    `x'^2 = s^2` each branch.
    """
    equation = re.sub(r"^\s*sqrt\((.*)\)\s*=\s*([^=]+)$", r"\1 = (\2)^2", written)
    left, right = sides_of(read_equation(Excerpt.whole(Source("", equation))))
    text = SourceText.of(Source("", equation))

    def root(term: Expression) -> str:
        """The product whose square is a term; nothing where it is none."""
        factors = [x for x in factors_of(_size(term)) if isinstance(x, Power)]
        if len(factors) < len(factors_of(_size(term))) or any(x.exponent != _TWO for x in factors):
            return ""
        whole = "*".join(text.written(x.base.span) for x in factors)
        return whole if re.search(r"\S\s*[-+]", whole) else bare_text(whole)

    groups: dict[bool, list[str]] = {True: [], False: []}
    for side in (left, right) if right != ZERO else (left,):
        for term in terms_of(side):
            groups[isinstance(term, Negative) == (side is right)].append(root(term))
    axes, speeds = sorted(groups.values(), key=len, reverse=True)
    if len(speeds) != 1 or not all([*speeds, *axes]):
        return ""
    [speed] = speeds
    if len(axes) == 1:
        return f"write {axes[0]} = {speed}, or {axes[0]} = -{speed}"
    related = [each for each in others if {*axes} <= {*map(str, name_nodes(*sides_of(each)))}]
    used = {node.name for node in name_nodes(left, right)}
    free = [x for x in scope.coordinates if x not in used]
    angles = [x for x in free if is_angle(x)]
    found = [
        (x, forms) for x, forms in product(free if related else angles, _HEADINGS)
        if all(_holds(each, dict(zip(axes, forms, strict=True)), x) for each in related)
    ] if len(axes) == 2 else []  # fmt: skip
    if not found or (not related and angles[1:]):
        return ""
    heading, forms = found[0]
    laws = (f"{axis} = {form[:-3]}{speed}*{form[-3:]}({heading})"
            for axis, form in zip(axes, forms, strict=True))  # fmt: skip
    return f"each equation has its own name: {numbered(name, laws)}"


def _holds(equation: Equation, forms: dict[str, str], heading: str) -> bool:
    """Whether velocities along a heading fulfil an equation."""
    values = {str(node): 0.3 + place for place, node in enumerate(name_nodes(*sides_of(equation)))}
    angle = values.get(heading, 0.0)
    values |= {
        axis: FUNCTIONS[form[-3:]](angle) * (1 - 2 * len(form[:-3])) for axis, form in forms.items()
    }
    try:
        left, right = (evaluated(side, values, FUNCTIONS) for side in sides_of(equation))
    except (KeyError, ArithmeticError, ValueError):
        return False
    return math.isclose(left, right, abs_tol=1e-9)
