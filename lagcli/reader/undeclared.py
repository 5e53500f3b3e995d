"""Names that a file uses and does not know: one mistake, not one for each place."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise

from lagcli.diagnostics import Diagnostic
from lagcli.reader.misshapen import with_entries
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


def once(
    mistakes: Sequence[Diagnostic], sections: Sequence[tuple[int, str]], parameters: str
) -> tuple[Diagnostic, ...]:
    """The mistakes by their place, with one for those that have one cause.

    The sections are the lines where they begin, with their names; the parameters are those of the
    file as it writes them.
    """
    starts = [line for line, _ in sections]
    caused = _one_for_cause(sorted(mistakes, key=lambda each: each.span))
    declared = _one_for_undeclared(_one_for_alike(caused, starts), parameters)
    return _one_for_habit(_one_for_shapes(declared, sections), starts)


def _once_by_name(diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Without what a state or a symmetry has to say of a name that is unknown elsewhere."""
    if any(_MISSING_LINE.match(each.hint) for each in diagnostics):  # what it would declare
        diagnostics = [each for each in diagnostics if not _OF_NAMES.match(each.message)]
    undeclared = (x for x in diagnostics if UNDECLARED in x.hint or COORDINATE in x.hint)
    names = (_NAME.fullmatch(each.message) for each in undeclared)
    unknown = {part for found in names if found for part in (found[1], found[1].removeprefix("p_"))}
    found_in = ((each, _NO_COORDINATE.match(each.message)) for each in diagnostics)
    return [each for each, found in found_in if found is None or found[1] not in unknown]


def _one_for_cause(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
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


def _one_for_alike(
    diagnostics: Sequence[Diagnostic], starts: Sequence[int]
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for those of one map or list that have the same advice."""
    kept: dict[tuple[str, str], Diagnostic] = {}
    for each in _together(_with_value(diagnostics), starts):
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


def _one_for_shapes(
    diagnostics: Sequence[Diagnostic], sections: Sequence[tuple[int, str]]
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for all sections whose whole value has another shape."""
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


def _one_for_habit(
    diagnostics: Sequence[Diagnostic], starts: Sequence[int]
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for those of one section that have the same cause, and its advice.

    Two have the same cause where their messages differ in what is quoted only, and their advice
    in single words: `vx: 1, vy: 2` in `initial`.
    """
    groups: list[tuple[int, list[Diagnostic]]] = []
    for each in diagnostics:
        section = bisect_right(starts, each.span.line)
        alike = (group for at, group in groups if at == section and _has_same_cause(group[0], each))
        if (group := next(alike, None)) is None:
            groups.append((section, [each]))
        else:
            group.append(each)
    return tuple(_joined(group) for _, group in groups)


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


def _with_value(diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """A wrong key and the wrong shape of its value as one mistake."""
    kept: list[Diagnostic] = []
    for each in diagnostics:
        last = kept[-1] if kept else each
        meant = re.search(r"the key is (\w+)$", last.hint) if kept else None
        below = each.span.line - last.span.line
        of_value = below == 0 and each.hint.startswith("write ") and not _KEY.match(each.message)
        if meant and each.span == last.span:
            kept[-1] = each  # which says what to do with it
        elif meant and each.hint and below in {0, 1} and (
            of_value or re.match(rf"'?{meant[1]}'? (?:must be|is one)\b", each.message)
        ):  # fmt: skip
            kept[-1] = replace(last, hint=f"{last.hint}; {each.hint}")
        else:
            kept.append(each)
    return kept


def _together(diagnostics: list[Diagnostic], starts: Sequence[int]) -> list[Diagnostic]:
    """The mistakes, with one for the other words for keys of a section, and for its entries."""
    groups: dict[tuple[int, str, str], list[tuple[Diagnostic, re.Match[str]]]] = {}
    for each in diagnostics:
        said = f"{each.message}: {each.hint}"
        if found := _MOVED.fullmatch(said) or _OTHER_KEY.fullmatch(said):
            section = bisect_right(starts, each.span.line) * (found["place"] != "the problem")
            alike = (section, _QUOTED.sub("''", found["place"]), found["hint"])
            groups.setdefault(alike, []).append((each, found))
    kept = {id(each): each for each in diagnostics}
    for group in groups.values():
        is_other = group[0][1]["hint"] == _THE_KEY
        keys = {
            found.group("key") if is_other else found.group("place", "key") for _, found in group
        }
        if group[1:] and len(keys) >= (2 if is_other else len(group)):
            kept[id(group[0][0])] = _of_keys(group, is_other=is_other)
            for each, _ in group[1:]:
                del kept[id(each)]
    return [*kept.values()]


def _of_keys(group: list[tuple[Diagnostic, re.Match[str]]], *, is_other: bool) -> Diagnostic:
    """One mistake for keys: which they are, where they stand, and what they mean or become."""
    places: dict[str, dict[str, str]] = {}
    for _, found in group:
        places.setdefault(found["place"], {})[found["key"]] = found["entry"]
    pairs = {key: meant for inner in places.values() for key, meant in inner.items()}
    listed = f"{', '.join(pairs)} in {' and '.join(places)}"
    if any(inner.keys() != pairs.keys() for inner in places.values()):
        listed = ", ".join(f"{', '.join(inner)} in {place}" for place, inner in places.items())
    lines = [each.span.line for each, _ in group]
    entries = [found["entry"] for _, found in group]
    hint = f"the keys are {', '.join(map('{0[1]} for {0[0]}'.format, pairs.items()))}"
    if not is_other:
        hint = f"{group[0][1]['hint']}{', '.join(dict.fromkeys(entries))}}}"
    elif len({*lines}) == len(lines):
        hint = _THE_KEY + "; in line ".join(
            [entries[0], *map("{} it is {}".format, lines[1:], entries[1:])]
        )
    message = f"unknown key{'s' * (len(pairs) > 1)} {listed}"
    return replace(group[0][0], message=message, hint=hint)


def _one_for_undeclared(
    diagnostics: Sequence[Diagnostic], parameters: str
) -> tuple[Diagnostic, ...]:
    """The mistakes, with one for each name that is not known and its advice."""
    diagnostics = _once_by_name(diagnostics)
    moving = {name: COORDINATE for each in diagnostics if (name := undeclared_velocity(each))}
    by_others = [each for each in diagnostics if BY_OTHERS in each.hint]
    moving = {each.message.split("'")[1]: each.hint for each in by_others} | moving
    named = ((each, _NAME.fullmatch(each.message)) for each in diagnostics)
    hints = ((each, moving.get(found[1]) if found else None) for each, found in named)
    diagnostics = [replace(each, hint=hint) if hint else each for each, hint in hints]
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
    if parameters[:1] in {"", "[", "{"}:
        whole = with_entries(parameters or "[]", ", ".join(names))
        return f"parameters: {whole}" if whole else ""
    form = "'- {}'" if parameters[:1] == "-" else "'{}:'"
    return f"{', '.join(map(form.format, names))} below 'parameters:'"
