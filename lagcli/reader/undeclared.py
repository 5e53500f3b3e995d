"""Names that a file uses and does not know: one mistake, not one for each place."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lagcli.diagnostics import Diagnostic

#: What `lagcli.reader.names` says of a name that nothing resembles.
UNDECLARED = "declare it under 'parameters'"
#: What it says of one with a prime.
COORDINATE = "declare it under 'coordinates'"
_KEY = re.compile(r"unknown keys? (?P<keys>'.*') in (?P<place>(?:the |[^']).*)")
_NAME = re.compile(r"unknown name '(\w+)' in (.*)")


def one_for_alike(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for those of one map or list that have the same advice.

    Parameters
    ----------
    diagnostics
        By their place.
    """
    kept: dict[tuple[str, str], Diagnostic] = {}
    for each in diagnostics:
        found = _KEY.fullmatch(each.message)
        place = found["place"] if found else each.message
        same = found is None or place != "the problem"
        key = (place, each.hint) if each.hint and same else (str(each.span), each.message)
        first = kept.setdefault(key, each)
        if found and first is not each:
            earlier = _KEY.sub(r"\g<keys>", first.message)
            message = f"unknown keys {earlier}, {found['keys']} in {place}"
            kept[key] = replace(first, message=message)
    return tuple(kept.values())


def one_for_undeclared(
    diagnostics: Sequence[Diagnostic], *, together: bool
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for each name that is not known and its advice.

    Parameters
    ----------
    diagnostics
        By their place.
    together
        Whether one is enough for all names to be declared: the file declares no parameter.
    """
    moving = {each.message.split("'")[1] for each in diagnostics if each.hint == COORDINATE}
    diagnostics = [
        replace(each, hint=COORDINATE)
        if (named := _NAME.fullmatch(each.message))
        and named[1] in moving
        and UNDECLARED in each.hint
        else each
        for each in diagnostics
    ]
    kept: list[Diagnostic] = []
    reported: set[tuple[str, str]] = set()
    undeclared: dict[str, Diagnostic] = {}
    for each in diagnostics:
        found = _NAME.fullmatch(each.message)
        if found is None or (found[1], each.hint) not in reported:
            kept.append(each)
        if found is not None:
            reported.add((found[1], each.hint))
            if UNDECLARED in each.hint:
                undeclared.setdefault(found[1], each)
    if not (together and len(undeclared) > 1):
        return tuple(kept)
    first = next(iter(undeclared.values()))
    names = ", ".join(undeclared)
    place = first.message.partition("' in ")[2]
    message = f"unknown names {names}: the first stands in {place}"
    whole = Diagnostic(message, first.span, f"declare them: parameters: [{names}]")
    one = [whole if each is first else each for each in kept]
    return tuple(each for each in one if not any(each is other for other in undeclared.values()))
