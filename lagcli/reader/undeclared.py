"""Names that a file uses and does not know: one mistake, not one for each place."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagcli.diagnostics import Diagnostic
from lagcli.reader.regex import regex
from lagcli.record import replace

#: What `lagcli.reader.names` says of a name that nothing resembles.
UNDECLARED = "declare it under 'parameters'"
#: What it says of v: another velocity in each line.
_SPEED = "the velocities are "
#: What it says of one with a prime.
COORDINATE = "declare it under 'coordinates'"
#: What is said of one that is the only unknown in an energy in which nothing moves.
BY_OTHERS = "by them under 'definitions'"
_KEY = regex(r"unknown keys? (?P<keys>'.*') in (?P<place>(?:the |[^']).*)")
_ORDER = regex(r"^(the (?:coordinate|velocity|acceleration|momentum)) (\S+) (cannot stand in .*)$")
_MISSING_LINE = regex(r"a line '\w+:' is missing")
_OF_NAMES = regex(r"unknown name '|'\w+' is not a parameter$|\w+: there is no point '")
_NO_COORDINATE = regex(r"'(\w+)'*' (?:in (?:initial|the symmetry)|is not a parameter)")
#: What a message quotes; a name may end with a prime.
_QUOTED = regex(r"'[^ ]+'+(?=[ ,:;]|$)")
#: Of the hints for one cause.
_SHOWN = 3
#: A longer list of parameters is not repeated.
_LONGEST = 80
_SHAPE = regex(r"^(?:an? |one of )\S.* must be an? (?:map|list), not an? (?:text|list|map)$")
_SHAPE_OF_SECTION = regex(r"'?(\w+)'? must be an? (?:map|list)\b.*")
_THE_KEY = "the key is "
#: Entries that belong to a section.
_MOVED = regex(
    r"unknown key (?P<key>'.*') in (?P<place>[^:]*): "
    r"(?P<hint>(?:[^:]* stands? (?:under|by) [^:]*: )?write \w+: \{)(?P<entry>.*)\}"
)
_OTHER_KEY = regex(
    rf"unknown keys? (?P<key>'.*') in (?P<place>[^:]*): (?P<hint>{_THE_KEY})(?P<entry>\w+)"
)
_NAME = regex(r"unknown name '(\w+)' in (.*)")
#: Of a name that is declared in a wrong way, and what follows from it.
_CAUSE = regex(
    r"the (?:definition|arguments) of '(\w+)'|([\w, ]+) (?:is|are) not (?:a )?(?:func|param)"
)
_USE = regex(r"unknown name '(\w+)' in |(\w+) is a definition, not a function")


def _once_by_name(diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Without what a state or a symmetry has to say of a name that is unknown elsewhere."""
    if any(_MISSING_LINE.match(each.hint) for each in diagnostics):  # what it would declare
        diagnostics = [each for each in diagnostics if not _OF_NAMES.match(each.message)]
    undeclared = (x for x in diagnostics if UNDECLARED in x.hint or COORDINATE in x.hint)
    names = (_NAME.fullmatch(each.message) for each in undeclared)
    unknown = {part for found in names if found for part in (found[1], found[1].removeprefix("p_"))}
    kept = []
    for each in diagnostics:
        found = _NO_COORDINATE.match(each.message)
        if found is None or found[1] not in unknown:
            kept.append(each)
    return kept


def one_for_cause(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for a name that is declared in a wrong way and where it is used."""
    causes = {
        name: each
        for each in diagnostics
        if (found := _CAUSE.match(each.message))
        for name in (found[1] or found[2]).split(", ")
    }
    uses = [
        (causes[name], each)
        for each in diagnostics
        if (found := _USE.match(each.message)) and (name := found[1] or found[2]) in causes
    ]
    lines: dict[int, dict[str, None]] = {}
    for cause, each in uses:
        advice = re.sub(r"^.*?: (?=write )", "", each.hint)
        told = {f"; in line {each.span.line} {advice}": None} if advice[:6] == "write " else {}
        lines.setdefault(id(cause), {}).update(told)
    kept = [each for each in diagnostics if all(each is not use for _, use in uses)]
    return tuple(replace(x, hint=x.hint + "".join(lines.get(id(x), ()))) for x in kept)


def one_for_alike(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for those of one map or list that have the same advice.

    Parameters
    ----------
    diagnostics
        By their place.
    """
    kept: dict[tuple[str, str], Diagnostic] = {}
    for each in _together(list(_with_value(diagnostics))):
        wrong = _KEY.fullmatch(each.message)
        place = wrong["place"] if wrong else _ORDER.sub(r"\1 \3", each.message)
        same = wrong is None or place != "the problem" or each.hint.startswith("it is one sum")
        same &= place != each.message
        key = (place, each.hint) if each.hint and same else (str(each.span), each.message)
        key = (place, "") if _SHAPE.search(each.message) else key
        first = kept.setdefault(key, each)
        if wrong and first is not each:
            earlier = _KEY.sub(r"\g<keys>", first.message)
            message = f"unknown keys {earlier}, {wrong['keys']} in {place}"
            kept[key] = replace(first, message=message)
    return tuple(kept.values())


def one_for_shapes(
    diagnostics: Sequence[Diagnostic], sections: Sequence[tuple[int, str]]
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for all sections whose whole value has another shape.

    Parameters
    ----------
    diagnostics
        By their place.
    sections
        The lines at which the sections begin, with their names.
    """
    names = {name for _, name in sections}
    found = [
        (each, match[1])
        for each in diagnostics
        if (match := _SHAPE_OF_SECTION.match(each.message)) and match[1] in names
        and each.hint.startswith("write ") and not each.related
    ]  # fmt: skip
    if not found[1:]:
        return tuple(diagnostics)
    listed = ", ".join(name for _, name in found[:-1])
    told = (x.hint if x.hint[6] in "[{" else f"write {{{x.hint[6:]}}}" for x, _ in found)
    lines = [f"in line {x.span.line} {hint}" for (x, _), hint in zip(found, told, strict=True)]
    message = f"{listed} and {found[-1][1]} must be lists or maps"
    hint = re.sub("^in line \\d+ ", "", "; ".join(lines))
    whole = replace(found[0][0], message=message, hint=hint)
    gone = {id(each) for each, _ in found[1:]}
    kept = (whole if each is found[0][0] else each for each in diagnostics)
    return tuple(each for each in kept if id(each) not in gone)


def one_for_habit(
    diagnostics: Sequence[Diagnostic], starts: Sequence[int]
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for those of one section that have the same cause, and its advice.

    Two have the same cause where their messages differ in what is quoted only, and their advice
    in single words: `vx: 1, vy: 2` in `initial`.

    Parameters
    ----------
    diagnostics
        By their place.
    starts
        The lines at which the sections begin.
    """
    groups: list[list[Diagnostic]] = []
    for each in diagnostics:
        section = bisect_right(starts, each.span.line)
        alike = (
            group
            for group in groups
            if bisect_right(starts, group[0].span.line) == section
            and _has_same_cause(group[0], each)
        )
        if (group := next(alike, None)) is None:
            groups.append([each])
        else:
            group.append(each)
    return tuple(map(_joined, groups))


def _has_same_cause(one: Diagnostic, other: Diagnostic) -> bool:
    if not one.hint or not other.hint:
        return False
    if other.hint.startswith("did you mean '") or UNDECLARED in other.hint:
        return False
    unquoted, others = (_QUOTED.sub("''", each.message) for each in (one, other))
    if one.related or other.related or unquoted != others:
        return False
    words, rest = (each.hint.partition("; in line")[0].split() for each in (one, other))
    same = sum(map(str.__eq__, words, rest))
    return words[0] == rest[0] and (words[0] == "write" or 2 * same >= len(words) == len(rest))


def _joined(group: list[Diagnostic]) -> Diagnostic:
    """The first, with the advice of each, of three where there are more."""
    keys = [(each, found) for each in group
            if (found := _OTHER_KEY.fullmatch(f"{each.message}: {each.hint}"))]  # fmt: skip
    if len(keys) == len(group) and len({found["key"] for _, found in keys}) > 1:
        return _other_keys(keys)
    moved = [_MOVED.fullmatch(f"{each.message}: {each.hint}") for each in group]
    parts = [(each["hint"], each["entry"]) for each in moved if each]
    if len(parts) == len(group) and len({hint for hint, _ in parts}) == 1:  # of one section
        entries = dict.fromkeys(entry for _, entry in parts)
        also = tuple((each.span, "this one too") for each in group[1:])
        return replace(group[0], hint=f"{parts[0][0]}{', '.join(entries)}}}", related=also)
    hints = {group[0].hint: group[0].hint}
    lines: dict[str, list[str]] = {}
    names: list[str] = []
    first = _KEY.match(group[0].message)
    for before, each in pairwise(group):
        line = f"in line {each.span.line} " if each.span.line != before.span.line else ""
        named = [*{*_QUOTED.findall(each.message)} - {*_QUOTED.findall(before.message)}]
        if each.hint not in hints:
            advice = re.sub(r"^.*?: (?=write |give )", "", each.hint, flags=re.DOTALL)
            is_told = len(named) != 1 or named[0][1:-1] in advice or "the unit '" in each.message
            hints[each.hint] = (line if line or is_told else f"for {named[0]} ") + advice
        elif line:
            key = _KEY.match(each.message)
            other = f" ({key['keys']})" if key and first and key["keys"] != first["keys"] else ""
            lines.setdefault(each.hint, []).append(f"{each.span.line}{other}")
        else:
            names += named if len(named) == 1 else []
    more = ["and so on"] if len(hints) > _SHOWN else []
    more += [f"for {', '.join(names)} the same"] if names else []
    for hint, same in lines.items():
        hints[hint] += f"; in line{'s' * bool(same[1:])} {', '.join(same)} the same"
    return replace(group[0], hint="; ".join([*list(hints.values())[:_SHOWN], *more]))


def _with_value(diagnostics: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """A wrong key and the wrong shape of its value as one mistake."""
    last: Diagnostic | None = None
    for each in diagnostics:
        meant = re.search(r"the key is (\w+)$", last.hint) if last is not None else None
        begins = rf"'?{meant[1]}'? (?:must be|is one)\b" if meant else ""
        within = last is not None and each.span.line == last.span.line
        of_value = within and each.hint.startswith("write ") and not _KEY.match(each.message)
        shape = re.match(begins, each.message) or of_value
        if last is not None and meant and each.span == last.span:
            last = each  # which says what to do with it
            continue
        if (
            last is not None
            and meant
            and shape
            and each.hint
            and each.span.line - last.span.line in {0, 1}
        ):
            last = replace(last, hint=f"{last.hint}; {each.hint}")
            continue
        if last is not None:
            yield last
        last = each
    if last is not None:
        yield last


def _together(diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """The mistakes, with one for all other words for keys, and for all entries of one section."""
    groups: dict[tuple[str, str], list[tuple[Diagnostic, re.Match[str]]]] = {}
    for each in diagnostics:
        said = f"{each.message}: {each.hint}"
        found = _MOVED.fullmatch(said) or _OTHER_KEY.fullmatch(said)
        if found and (found["hint"] != _THE_KEY or found["place"] == "the problem"):
            groups.setdefault((found["place"], found["hint"]), []).append((each, found))
    kept = {id(each): each for each in diagnostics}
    for (place, hint), group in groups.items():
        if group[1:]:
            first = group[0][0]
            for each, _ in group[1:]:
                del kept[id(each)]
            if hint == _THE_KEY:
                kept[id(first)] = _other_keys(group)
                continue
            keys = ", ".join(found["key"] for _, found in group)
            entries = ", ".join(dict.fromkeys(found["entry"] for _, found in group))
            message = f"unknown keys {keys} in {place}"
            kept[id(first)] = replace(first, message=message, hint=f"{hint}{entries}}}")
    return [*kept.values()]


def _other_keys(group: list[tuple[Diagnostic, re.Match[str]]]) -> Diagnostic:
    """One mistake for other words for keys: which they are, where they stand, what they mean."""
    places: dict[str, dict[str, str]] = {}
    for _, found in group:
        places.setdefault(found["place"], {})[found["key"]] = found["entry"]
    pairs = {key: meant for inner in places.values() for key, meant in inner.items()}
    listed = f"{', '.join(pairs)} in {' and '.join(places)}"
    if any(inner != pairs for inner in places.values()):
        listed = ", ".join(f"{', '.join(inner)} in {place}" for place, inner in places.items())
    lines = [each.span.line for each, _ in group]
    hint = f"the keys are {', '.join(map('{0[1]} for {0[0]}'.format, pairs.items()))}"
    if len({*lines}) == len(lines):
        also = (f"; in line {line} it is {found['entry']}"
                for line, (_, found) in zip(lines[1:], group[1:], strict=True))  # fmt: skip
        hint = f"{_THE_KEY}{group[0][1]['entry']}{''.join(also)}"
    return replace(group[0][0], message=f"unknown keys {listed}", hint=hint)


def one_for_undeclared(
    diagnostics: Sequence[Diagnostic], parameters: str
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for each name that is not known and its advice.

    Parameters
    ----------
    diagnostics
        By their place.
    parameters
        The list or map of parameters as the file writes it; nothing where it has none.
    """
    diagnostics = _once_by_name(diagnostics)
    moving = {name: COORDINATE for each in diagnostics if (name := undeclared_velocity(each))}
    by_others = [each for each in diagnostics if BY_OTHERS in each.hint]
    moving = {each.message.split("'")[1]: each.hint for each in by_others} | moving
    diagnostics = [
        replace(each, hint=moving[named[1]])
        if (named := _NAME.fullmatch(each.message)) and named[1] in moving
        else each
        for each in diagnostics
    ]
    kept: list[Diagnostic] = []
    reported: set[tuple[str, str]] = set()
    undeclared: dict[str, Diagnostic] = {}
    for each in diagnostics:
        found = _NAME.fullmatch(each.message)
        hint = UNDECLARED if UNDECLARED in each.hint else each.hint
        hint += f" in line {each.span.line}" if hint.startswith(_SPEED) else ""
        if found is None or (found[1], hint) not in reported:
            kept.append(each)
        if found is not None:
            reported.add((found[1], hint))
            if each.hint.partition(",")[0] == UNDECLARED:  # and nothing else is advised
                undeclared.setdefault(found[1], each)
    if not undeclared:
        return tuple(kept)
    first = next(iter(undeclared.values()))
    entry = _declaration(parameters, [*undeclared])
    if len(undeclared) == 1:
        hint = first.hint.replace(UNDECLARED, f"declare it: {entry}")
        whole = replace(first, hint=hint if entry else first.hint)
    else:
        place = first.message.partition("' in ")[2]
        message = f"unknown names {', '.join(undeclared)}: the first stands in {place}"
        hint = f"declare them: {entry}" if entry else "declare them under 'parameters'"
        whole = Diagnostic(message, first.span, hint)
    one = [whole if each is first else each for each in kept]
    return tuple(each for each in one if not any(each is other for other in undeclared.values()))


def undeclared_velocity(mistake: Diagnostic) -> str:
    """The name of a velocity that belongs to no coordinate of the file; nothing for others."""
    return mistake.message.split("'")[1] if mistake.hint == COORDINATE else ""


def _declaration(parameters: str, names: list[str]) -> str:
    """The parameters with further names, or the lines to add; nothing for a long list."""
    if re.fullmatch(r"\w+(?:\s*,\s*\w+)*", parameters):  # a list without its brackets
        parameters = f"[{parameters}]"
    begin, inner = parameters[:1] or "[", parameters[1:-1].strip()
    listed = f"{begin}{inner}{', ' * bool(inner)}{', '.join(names)}{']' if begin == '[' else '}'}"
    if begin in {"[", "{"}:
        return f"parameters: {listed}" if len(listed) <= _LONGEST else ""
    lines = ", ".join(f"'- {each}'" if begin == "-" else f"'{each}:'" for each in names)
    return f"{lines} below 'parameters:'"
