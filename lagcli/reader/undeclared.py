"""Letters that a file uses and does not declare: one mistake, not one for each place."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagcli.diagnostics import Diagnostic

#: What `lagcli.reader.names` says of a name that nothing resembles.
UNDECLARED = "declare it under 'parameters'"
_NAME = re.compile(r"unknown name '(\w+)' in (.*)")


def one_for_undeclared(
    diagnostics: Sequence[Diagnostic], *, together: bool
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for each name that is to be declared as a parameter.

    Parameters
    ----------
    diagnostics
        By their place.
    together
        Whether one is enough for all these names: the file declares no parameter.
    """
    places: dict[str, Diagnostic] = {}
    for each in diagnostics:
        if name := _undeclared(each):
            places.setdefault(name, each)
    if not places:
        return tuple(diagnostics)
    first = next(iter(places.values()))
    if together and len(places) > 1:
        names = ", ".join(places)
        found = _NAME.fullmatch(first.message)
        assert found is not None
        message = f"unknown names {names}: the first stands in {found[2]}"
        whole = Diagnostic(message, first.span, f"declare them: parameters: [{names}]")
        places = dict.fromkeys(places, whole)
        diagnostics = [whole if each is first else each for each in diagnostics]
    kept = [*places.values()]
    return tuple(
        each
        for each in diagnostics
        if any(each is one for one in kept) or _undeclared(each) not in places
    )


def _undeclared(diagnostic: Diagnostic) -> str:
    """The name, where it is one of those."""
    found = _NAME.fullmatch(diagnostic.message)
    return found[1] if found and UNDECLARED in diagnostic.hint else ""
