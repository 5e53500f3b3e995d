"""A hint is read as it would stand in the file, and mended where that has a mistake of its own.

`forces: F*cos(ωt)` is `{x: F*cos(omega*t)}`, not `{x: F*cos(ωt)}`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagcli.diagnostics import Diagnostic, Source
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.regex import regex
from lagcli.reader.text import Mistake, SourceText
from lagcli.reader.undeclared import COORDINATE, UNDECLARED
from lagcli.record import replace

#: Longer files are not tried, nor more mistakes of a file, nor more mistakes inside of a hint.
_LONGEST, _MOST, _DEEPEST = 20_000, 8, 4
#: The text that a hint proposes.
_PROPOSED = regex(r"(?:.*: )?(?:write|did you mean) (\S.*?)\??")

Reading = Callable[[Source], tuple[DocumentNode, list[Diagnostic]]]


def followed(source: Source, found: list[Diagnostic], read: Reading) -> list[Diagnostic]:
    """The mistakes, with the texts in their hints as the reader accepts them.

    Parameters
    ----------
    source
        The file.
    found
        Its mistakes.
    read
        The document of a text, and the mistakes in it; `Mistake` where YAML does not read it.
    """
    if len(source.text) > _LONGEST:
        return found
    return [*(_followed(source, each, read) for each in found[:_MOST]), *found[_MOST:]]


def with_hidden(
    source: Source, found: list[Diagnostic], declaring: list[tuple[int, int]], read: Reading
) -> list[Diagnostic]:
    """The mistakes, the rest of them as in a file that declares its names as the hints say.

    Parameters
    ----------
    source
        The file.
    found
        Its mistakes.
    declaring
        The first and last lines of the sections that declare names.
    read
        The document of a text, and the mistakes in it.
    """
    text = SourceText.of(source)
    edits = []
    for each in found if len(source.text) <= _LONGEST else ():
        line, end = each.span.line, each.span.end_line
        proposed = _PROPOSED.fullmatch(each.hint)
        if not each.is_error or not any(first <= line <= last for first, last in declaring):
            continue
        is_shape = " must be " in each.message  # another name is still used elsewhere
        if proposed is None or not is_shape or ", or " in proposed[1] or line != end:
            return found
        edits.append((*text.offsets(each.span), proposed[1]))
    changed, before = source.text, len(source.text) + 1
    for start, stop, written in sorted(edits, reverse=True):
        if stop > before:
            return found
        is_bare = written[:1] not in "[{" and ": " in written
        changed = changed[:start] + (f"{{{written}}}" if is_bare else written) + changed[stop:]
        before = start
    if not edits:
        return found
    try:
        _, mistakes = read(replace(source, text=changed))
    except Mistake:
        return found
    wrong = [each for each in mistakes if each.is_error]
    edited = {text.span(start, start).line for start, *_ in edits}
    if any(each.span.line in edited for each in wrong):
        return found
    kept = [each for each in found if each.span.line in edited]
    return [*kept, *followed(replace(source, text=changed), wrong, read)]


def _followed(source: Source, mistake: Diagnostic, read: Reading) -> Diagnostic:
    proposed = _PROPOSED.fullmatch(mistake.hint)
    if proposed is None or ", or " in proposed[1] or mistake.span.line < 1:
        return mistake
    start, end = SourceText.of(source).offsets(mistake.span)
    text, written = source.text, proposed[1]
    changed = text[:start] + written + text[end:]
    whole = _settled(changed, start, start + len(written), read, text[start:end], _DEEPEST)
    if whole in {"", written}:
        return mistake
    at = proposed.start(1)
    return replace(mistake, hint=mistake.hint[:at] + whole + mistake.hint[at + len(written) :])


def _settled(text: str, start: int, end: int, read: Reading, author: str, left: int) -> str:
    """The stretch of a text with the hints inside of it followed; nothing where some remain.

    Only what the author has written is mended: a hint may be a sentence.
    """
    source = SourceText.of(Source("", text))
    try:
        root, found = read(source.source)
    except Mistake:
        return ""
    inside = [each for each in found if each.is_error and _is_within(source, each, start, end)]
    if not inside:
        return text[start:end]
    begin, stop = source.offsets(inside[0].span)
    proposed = _PROPOSED.fullmatch(inside[0].hint)
    if proposed is None or not left or text[begin:stop] not in author:
        return ""
    scalars = ((x.start, x.end) for x in _scalars(root) if x.start <= begin <= stop <= x.end)
    around = next(scalars, (begin, stop))
    written = _nearest(
        text[slice(*around)], begin - around[0], stop - around[0], _unquoted(proposed[1])
    )
    changed = text[: around[0]] + written + text[around[1] :]
    return _settled(changed, start, end + len(changed) - len(text), read, author, left - 1)


def _unquoted(proposed: str) -> str:
    """`tau` for `'tau'`: a name is quoted in a hint."""
    return re.sub(r"^'(\w+)'$", r"\1", proposed)


def _nearest(text: str, start: int, end: int, proposed: str) -> str:
    """A text with what a hint proposes for all of it or for the stretch in it.

    It is the one that is most like the text.  What follows a colon may be the reason.
    """
    from difflib import SequenceMatcher

    parts = dict.fromkeys((proposed, *re.split(r"[:;] ", proposed)[:1]))
    wholes = (whole for each in parts for whole in (each, text[:start] + each + text[end:]))
    return max(wholes, key=lambda whole: SequenceMatcher(None, text, whole).ratio())


def _is_within(source: SourceText, mistake: Diagnostic, start: int, end: int) -> bool:
    """Whether a mistake is in the stretch, and not of a name that is declared elsewhere."""
    if UNDECLARED in mistake.hint or COORDINATE in mistake.hint or mistake.span.line < 1:
        return False
    first, last = source.offsets(mistake.span)
    return start <= first and last <= end


def _scalars(node: DocumentNode) -> Iterator[Scalar]:
    if isinstance(node, Scalar):
        yield node
    elif isinstance(node, Sequence):
        for item in node.items:
            yield from _scalars(item)
    elif isinstance(node, Mapping):
        for key, value in node.entries:
            yield from (*_scalars(key), *_scalars(value))
