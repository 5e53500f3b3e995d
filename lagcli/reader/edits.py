"""A hint as an edit of the file: what its reader would type, tried by the program itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import SequenceMatcher
from itertools import takewhile
from typing import NamedTuple

from lagcli.diagnostics import Diagnostic, Source
from lagcli.reader.assignments import pieces
from lagcli.reader.habits import KEYS, MAPS, is_unit
from lagcli.reader.misshapen import with_entries
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, entries_in, names_in, nodes_in
from lagcli.reader.regex import regex
from lagcli.reader.text import SourceText, as_sum
from lagcli.record import replace

#: The text that a hint proposes; what follows a colon may be the reason.
PROPOSED = regex(
    r"(?:.*: |in place of \w+ |leave it out, and on a line of its own )?"
    r"(?:write|did you mean) (\S.*?)\??"
    r"|(?:a vector is written by its components|each equation has its own name): (.*)",
    re.DOTALL,
)
_RENAMED = regex(
    r"(?:(?:the key is|the velocity of \w+ is) (\w+'*)|did you mean (?:'(\S+)'|(\w+'*))\?)"
)
#: An example, or a change of more places.
_NOT_TO_TYPE = regex(r" under '|without '-'|, as in |^it is one sum|left = right$")
NO_NAME = regex(r"'(.*)' is not a name")
_SECTION = regex(r"(\w+): (.*)", re.DOTALL)
#: An entry of a map.
_ENTRY = regex(r"\s*[^\W\d]\w*'*: \S")
#: What stands before a place of the line of an entry.
_LINE = regex(r"\s*(?:[^\s:{\[][^:{\[]*:\s+)?")
_BLANKS = "  "
#: The value of a section, on its line and below it.
_LINES_OF = r"^{}:[^\S\n]*(.*(?:\n(?:[ \t-].*)?)*)"
#: A section that a hint writes whole.
_WHOLE = regex(
    r"(?P<stands>under \w+: )?"
    r"(?:write |(?<=declare it: )(?=f)|(?<=as such: )|(?<=; )|(?P<lead>and ))"
    rf"(?P<key>{'|'.join(MAPS)}|observables|picture): \{{"
)
#: What a comma has cut off a value in braces.
_CUT = regex(r"(?:\s*,\s*[^,{}\[\]:\n]+)+(?=\s*[,}])")


class Edit(NamedTuple):
    """What stands in the place of `text[start:end]`; an edit with a hole proposes nothing."""

    start: int
    end: int
    written: str


def edits_of(mistake: Diagnostic, text: SourceText, root: DocumentNode) -> list[list[Edit]]:
    """What a hint may mean, each as one or two edits, first what changes the file least."""
    hint = mistake.hint
    if mistake.span.line < 1 or "…" in hint or _NOT_TO_TYPE.search(hint):
        return []
    start, end = text.offsets(mistake.span)
    if named := _RENAMED.fullmatch(hint):
        written = text.source.text[start:end]
        better = named[1] or named[2] or named[3]
        bare = written.rstrip("'")
        edit = Edit(start, end, better + written[len(bare) :] * ("'" not in better))
        is_name = named[2] and mistake.message.startswith("unknown name '")
        is_name = is_name and not (len(bare) == 1 and is_unit(bare))  # the m of N/m
        return [[edit, *(_elsewhere(bare, edit, text.source.text) if is_name else ())]]
    if moved := _moved(mistake, end, text):
        return [moved]
    if hint.partition(":")[0] == "leave it out":
        if hint.endswith("begins with blanks"):  # ...
            marks = re.match(r"(.)\1*", text.source.text[start:])
            return [[Edit(start, start + len(marks[0]), "")]] if marks else []
        return [[_without(start, end, text, root)]]
    section = hint[:12] == "in place of " and hint.split()[3]
    for key, value in root.pairs:
        if key.label == section:
            start, end = key.start, _end(value, text.source.text)
    proposed = PROPOSED.fullmatch(hint)
    if proposed is None or ", or " in hint:
        return []
    whole = re.sub(r", without \w+, also .*|; and so on", "", proposed[1] or proposed[2])
    whole = re.sub(r"^'(.*)'$", r"\1", whole)
    if proposed[2] and (entry := entry_at(root, start, end)):  # entries in the place of one
        return [
            [Edit(entry[0].start, _end(entry[1], text.source.text), _in_lines(whole, entry[0]))]
        ]
    parts = dict.fromkeys((whole, *_without_reason(whole)))
    found = [edits for part in parts for edits in _placed(part, start, end, text, root)]
    written = text.source.text
    if name := NO_NAME.match(mistake.message):
        is_text = re.fullmatch(r"\w+", name[1]) is None
        found = [edits + _elsewhere(name[1], edits[0], written) * is_text for edits in found]
    is_own = is_node(start, end, root, written) and not _SECTION.fullmatch(whole)
    return sorted(found, key=lambda edits: (
        edits[0].start < edits[0].end or not edits[1:],  # not an entry that is moved
        not is_own or edits[0].start != start or edits[0].end < end, -_likeness(edits, written)
    ))  # fmt: skip


def is_node(start: int, end: int, root: DocumentNode, text: str) -> bool:
    """Whether a stretch is all of a text, a list or a map."""
    return any((each.start, _end(each, text)) == (start, end) for each in nodes_in(root))


def _elsewhere(name: str, edit: Edit, text: str) -> list[Edit]:
    """The other places of a name, or of a text that was to be one, such as `x-cart`."""
    better = edit.written.rstrip("'")
    behind = r"(?![\w'])" if name.endswith("'") else r"(?!\w)"
    form = rf"(?<!\w){re.escape(name)}{behind}"
    comments = {k for m in re.finditer(r"(?m:^|\s)#.*", text) for k in range(*m.span())}
    others = re.finditer(form, text) if better.isidentifier() else ()
    others = (m for m in others if m.start() not in comments)
    return [Edit(m.start(), m.end(), better) for m in others if m.start() != edit.start]


def _without_reason(whole: str) -> Iterator[str]:
    """The text before `: numbers are in the units of the file`, and before `; the product is`."""
    if named := re.fullmatch(r"(\w+'*), \w+ .*", whole):
        yield named[1]
    head, found, _ = whole.partition("; ")
    if found:
        yield head
    head, found, tail = whole.rpartition(": ")
    if found and re.match(r"(?:[^\W\d]+ ){2}", tail):
        yield head


def _placed(
    part: str, start: int, end: int, text: SourceText, root: DocumentNode
) -> Iterator[list[Edit]]:
    """The places of a proposed text: of the mistake, and of the nodes and the entry around it."""
    written = text.source.text
    section = _SECTION.fullmatch(part)
    entry = entry_at(root, start, end)
    if section and section[1] in KEYS:
        of_problem = (pair for pair in root.pairs if pair[0].label in KEYS)
        if start < end and entry is not None and entry in of_problem:
            is_whole = (entry[0].start, _end(entry[1], written)) == (start, end)
            if entry[0].label == section[1] or is_whole:
                yield [Edit(entry[0].start, _end(entry[1], written), part)]
            return  # else a part of it goes there
        gone = [_without(start, end, text, root)] if start < end else []
        edits = [*_into_section(section[1], section[2], text, root), *gone]
        if edits:  # none where its section is no map
            yield edits
        return
    if section and entry is not None and entry[0].label != section[1]:
        around = next(each for each in nodes_in(root) if entry in each.pairs)
        beside = section[1] in names_in(around)
        if beside and (edits := _into_section(section[1], section[2], text, around)):
            yield [*edits, _without(start, end, text, root)]
    end = start + len(written[start:end].rstrip())
    if part.replace("*", "") == "".join(written[start:end].split()):  # 2*m for 2 m
        yield [Edit(start, end, part)]
        return
    before = part[: start - end - 1]  # g: 9 of g: 9,81
    if written[:start].endswith(f"{before},") and part.endswith(f".{written[start:end]}"):
        yield [Edit(start - len(before) - 1, end, part)]
        return
    cut = _CUT.match(written, end)
    if cut and all(each.strip() in part for each in cut[0].split(",")):
        yield [Edit(start, cut.end(), part)]
    yield [Edit(start, end, part)]
    if section and written[start:end].partition(":")[0] != section[1] and part[:1] not in "[{":
        yield [Edit(start, end, f"{{{part}}}")]
    for one in nodes_in(root):
        stop = _end(one, written)
        is_around = one.start <= start <= end <= stop and (one.start, stop) != (start, end)
        is_whole = isinstance(one, Scalar) and stop - one.start <= 3 * len(part)
        if is_around and (is_whole or _keeps(written[one.start : stop], part)):
            is_bare = section and part[:1] != "{" and written[one.start] == "{"
            yield [Edit(one.start, stop, f"{{{part}}}" if is_bare else part)]
    if section and entry is not None:
        stop = _end(entry[1], written)
        if _keeps(written[entry[0].start : stop], part):
            yield [Edit(entry[0].start, stop, _in_lines(part, entry[0]))]


def _keeps(before: str, after: str) -> bool:
    """Whether a list, a map or an entry is there with another shape, not only a part of it."""
    if before[:1] == after[:1] == "[":
        return True
    keys, words = ({*re.findall(form, before)} for form in (r"\w+'*(?=:\s)", r"\w+"))
    kept = {*re.findall(r"\w+'*", after)}
    return (bool(keys) and keys <= kept) or 2 * len(words & kept) >= len(words)


def _in_lines(part: str, first: Scalar) -> str:
    """The entries of a map on a line each, where the first is not between braces."""
    entries = [each.strip() for each in pieces(part, ",")]
    is_block = not first.in_flow and all(map(_SECTION.fullmatch, entries))
    return f"\n{' ' * (first.span.column - 1)}".join(entries) if is_block else part


def _likeness(edits: list[Edit], text: str) -> float:
    """How much the lines of an edit are like the lines before it."""
    start, end, written = edits[0]
    begin = text.rfind("\n", 0, start) + 1
    stop = len(text) if (at := text.find("\n", end)) < 0 else at
    changed = f"{text[begin:start]}{written}{text[end:stop]}"
    return SequenceMatcher(None, text[begin:stop], changed, autojunk=False).ratio()


def _moved(mistake: Diagnostic, end: int, text: SourceText) -> list[Edit]:
    """The edits of hints on blanks and hyphens at the beginnings of lines."""
    written, hint, line = text.source.text, mistake.hint, mistake.span.line
    begin = text.line_starts[line - 1]
    if mistake.message.endswith("', but not in it"):
        above = written[:begin].rstrip().rpartition("\n")[2]
        blanks = " " * (len(above) - len(above.lstrip())) or _BLANKS
        lines = [line, *map(int, re.findall(r"\d+", hint.partition(", also in line")[2]))]
        return [Edit(at, at, blanks) for at in (text.line_starts[each - 1] for each in lines)]
    if hint == "leave out the '-' before each key":
        inner = written[begin:end]
        whole = re.sub(r"^(\s*)-( +)(?=[^\W\d][\w']*:)", r"\1 \2", inner, flags=re.MULTILINE)
        return [Edit(begin, end, whole)] if whole != inner else []
    return []


def _without(start: int, end: int, text: SourceText, root: DocumentNode) -> Edit:
    """Without the entry, or the item of a list, that stands there."""
    written = text.source.text
    entry = entry_at(root, start, end)
    items = (x for node in nodes_in(root) for x in node.parts)
    item = next((x for x in items if x.start == start and x.end >= end), None)
    if item is not None:
        end = _end(item, written)
    elif entry is not None:
        start, end = entry[0].start, _end(entry[1], written)
        around = [key for key, value in entries_in(root)
                  if value.pairs == [entry] and key.label in KEYS]  # fmt: skip
        start = around[0].start if around else start  # the only one of its section
        end += written[start:end].count("{") - written[start:end].count("}")
    if comma := re.match(r"\s*,\s*", written[end:]):
        return Edit(start, end + comma.end(), "")
    if comma := re.search(r",\s*$", written[:start]):
        return Edit(comma.start(), end, "")
    begin = written.rfind("\n", 0, start) + 1
    is_line = re.fullmatch(r"\s*(?:- )?", written[begin:start]) is not None
    return Edit(begin, end, "") if is_line else Edit(start, end, "")


def _into_section(key: str, value: str, text: SourceText, root: DocumentNode) -> list[Edit]:
    """An entry of a section put where it belongs."""
    written = text.source.text
    entries = root.pairs
    node = next((value for name, value in entries if name.label == key), None)
    if node is None:
        return [Edit(len(written), len(written), f"\n{key}: {value}")]
    inner = value.strip()[1:-1]
    if not isinstance(node, Mapping) or value[:1] != "{" or not node.entries:
        return []
    end = _end(node, written)
    if written[node.start] == "{":
        return [Edit(end - 1, end - 1, f", {inner}")]
    indent = " " * (text.position(node.start)[1] - 1)
    lines = (f"\n{indent}{each.strip()}" for each in pieces(inner, ","))
    return [Edit(end, end, "".join(lines))]


def _end(node: DocumentNode, text: str) -> int:
    """Where a node ends, without the lines of a block below it."""
    return node.start + len(text[node.start : node.end].rstrip())


def entry_at(root: DocumentNode, start: int, end: int) -> tuple[Scalar, DocumentNode] | None:
    """The innermost entry of a map that begins there, or around a stretch of the text."""
    found = None
    for key, value in entries_in(root):
        if key.start <= start <= end <= max(key.end, value.end):
            found = (key, value)
    return found


def as_typed(mistake: Diagnostic, source: Source) -> Diagnostic:
    """The mistake with a hint that can be typed as it stands in the file."""
    return _on_lines(_in_given_sections(mistake, source), source)


def _in_given_sections(mistake: Diagnostic, source: Source) -> Diagnostic:
    """`below parameters: write k: 2` for `write parameters: {k: 2}` beside other parameters."""
    hint = mistake.hint
    for found in reversed([*_WHOLE.finditer(hint)]):
        key, begin = found["key"], found.end()
        section = re.search(_LINES_OF.format(key), source.text, re.MULTILINE)
        if section is None:
            continue
        given, first = section[1].rstrip(), source.text.count("\n", 0, section.start()) + 1
        inner = pieces(f"{{{hint[begin:]}", "}")[0][1:]
        entries = [_with_given(each.strip(), given, key) for each in pieces(inner, ",")]
        names = {each.partition(":")[0] for each in entries}
        is_flow = given[:1] in {"{", "["}
        lines = pieces(given[1:-1], ",;") if is_flow else given.split("\n")
        own = {each.partition(":")[0].strip() for each in lines} - {""}
        is_all = own <= names and key != "forces"  # the hint has the whole section
        if is_all or first <= mistake.span.line <= first + given.count("\n"):
            continue
        place = f"{'in' if own & names else 'below'} {key}: write {_on_own_lines(entries)}"
        if is_flow:
            whole = with_entries(given, ", ".join(entries))
            place = f"between the braces of {key}: write {', '.join(entries)}"
            place = f"{found['stands'] or ''}write all as {key}: {whole}" if whole else place
        hint = (
            hint[: found.start()] + (found["lead"] or "") + place + hint[begin + len(inner) + 1 :]
        )
    return replace(mistake, hint=hint)


def _with_given(entry: str, given: str, section: str) -> str:
    """An entry, of a coordinate that has a force already with the sum of both."""
    name, _, law = entry.partition(": ")
    own = re.search(rf"(?<![\w']){re.escape(name)}:[^\S\n]*([^\n,}}#]*[^\s,}}#])", given)
    return f"{name}: {as_sum((own[1], law))}" if own and section == "forces" else entry


def _on_lines(mistake: Diagnostic, source: Source) -> Diagnostic:
    """`write a: 1, and on a line of its own b: 2` for `write a: 1, b: 2` where one has a line."""
    span, before = mistake.span, "{"
    if span.line > 0:
        before = source.text.split("\n")[span.line - 1][: span.column - 1]
    if not _LINE.fullmatch(before):
        return mistake
    sentences = re.split(r"(; in line \d+ )", mistake.hint)
    return replace(mistake, hint="".join(map(_entries_on_lines, sentences)))


def _entries_on_lines(hint: str) -> str:
    proposed = PROPOSED.fullmatch(hint)
    whole = (proposed[1] or proposed[2]) if proposed else ""
    parts = pieces(whole, ",;")
    entries = [each.strip() for each in takewhile(_ENTRY.match, parts)]
    rest = whole[len("".join(parts[: len(entries)])) + len(entries) - 1 :]
    return f"{hint[: -len(whole)]}{_on_own_lines(entries)}{rest}" if entries[1:] else hint


def _on_own_lines(entries: list[str]) -> str:
    lines = "lines of their own" if entries[2:] else "a line of its own"
    return entries[0] + f", and on {lines} {' and '.join(entries[1:])}" * bool(entries[1:])
