"""How many exponentials stand inside each other, through definitions too.

exp(exp(exp(3))) has two hundred million digits before its point; one level more, and no
arithmetic holds the exponent.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.diagnostics import Diagnostic
from lagcli.expression import Call, Expression, Name, Number, Power, children, postorder
from lagcli.reader.limits import EXPONENTIAL_LEVELS

if TYPE_CHECKING:
    from lagcli.reader.scope import Scope

_GROWING = frozenset({"exp", "sinh", "cosh"})


def exponential_levels(expression: Expression, scope: Scope) -> tuple[int, Diagnostic | None]:
    """The levels of an expression with its definitions, and what is too many."""
    levels: list[int] = []
    wrong = None
    for node in postorder(expression):
        count = len(children(node))
        parts = levels[len(levels) - count :]
        del levels[len(levels) - count :]
        level = max(parts, default=0)
        if isinstance(node, Name) and node.name in scope.definitions:
            level = scope.definitions[node.name].exponentials
        elif isinstance(node, Call) and node.function in _GROWING:
            level += 1
        elif isinstance(node, Power) and not isinstance(node.exponent, Number):
            level = max(parts[0], parts[1] + _moves(node.exponent))
        if level > EXPONENTIAL_LEVELS and wrong is None:
            wrong = Diagnostic(
                f"more than {EXPONENTIAL_LEVELS} exponentials inside each other",
                node.span,
                f"the limit is {EXPONENTIAL_LEVELS} levels",
            )
        levels.append(level)
    return levels[0], wrong


def _moves(exponent: Expression) -> bool:
    return any(isinstance(node, Name | Call) for node in postorder(exponent))
