"""A formula that the reader refuses, as it accepts it: what a hint may propose."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from lagcli.diagnostics import Source
from lagcli.expression import Equation, Expression
from lagcli.problem_data import Inequality
from lagcli.reader.habits import name_meant
from lagcli.reader.names import name_mistakes
from lagcli.reader.positions import Excerpt
from lagcli.reader.text import Mistake
from lagcli.reader.translation import Unclear, Vocabulary, translated
from lagcli.reader.undeclared import UNDECLARED

if TYPE_CHECKING:
    from lagcli.reader.scope import Role, Scope

#: A longer text is not tried.
_LONGEST = 300
#: What stands before a formula that is given as an equation: `T =`, `V(x) =`.
_LEFT_SIDE = re.compile(r"^\s*[^\W\d]\w*(?:\(\w+\))?\s*:?=(?!=)")


def repaired(
    value: str,
    scope: Scope,
    role: Role,
    read: Callable[[Excerpt], Expression | Equation | Inequality],
) -> str:
    """The text in the notation of the format; nothing where the reader refuses that, too.

    A name that is not declared may be left in it: that is another mistake.
    """
    if len(value) > _LONGEST:
        return ""
    names = _vocabulary(scope, role)
    for written in (value, _LEFT_SIDE.sub("", value)):
        try:
            whole = translated(written, names)
            found = read(Excerpt.whole(Source("", whole)))
        except (Unclear, Mistake):
            continue
        sides = (found,) if isinstance(found, Expression) else (found.left, found.right)
        wrong = [each for side in sides for each in name_mistakes(side, scope, role, "")]
        words = set(re.findall(r"\w+", value))
        if all(
            UNDECLARED in each.hint and set(re.findall(r"'(\w+)'", each.message)) <= words
            for each in wrong
        ):
            return whole if whole != value.strip() else ""
    return ""


def in_all(hint: str, whole: str) -> str:
    """A hint on a part of a formula, with the whole of it."""
    between = " In all: " if hint.endswith("?") else "; in all: "
    return f"{hint}{between}{whole}" if hint else f"write {whole}"


def _vocabulary(scope: Scope, role: Role) -> Vocabulary:
    coordinates = tuple(scope.of_kind("coordinate"))
    functions = frozenset(scope.of_kind("function"))
    refused = [name for each in scope.refused if (name := name_meant(each))]
    usable = {*scope.usable(role), *refused} - {*coordinates} - functions
    return Vocabulary(coordinates, frozenset(usable), functions, role.momenta)
