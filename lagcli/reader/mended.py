"""The hints of a file followed, one after another, until none is left.

Each is an edit of the text; the file is read again after it.  So a hint has the text that the
reader accepts, not one with a mistake of its own, a mistake that another hides is found, and
one that goes with another was a consequence and is not reported.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from lagcli.diagnostics import Diagnostic, Source, Span
from lagcli.problem_data import Problem
from lagcli.reader.edits import NO_NAME, PROPOSED, Edit, edits_of, is_node
from lagcli.reader.nodes import DocumentNode
from lagcli.reader.regex import regex
from lagcli.reader.text import Mistake, SourceText, also_in_lines
from lagcli.reader.undeclared import COORDINATE, UNDECLARED
from lagcli.record import replace

#: Longer files are not tried; characters that are read for the hints of one file, and edits.
_LONGEST, _READ, _MOST = 20_000, 100_000, 32
_ENTRY = regex(r"\{?\w+'*: ")
#: Hints inside of hints.
_DEEPEST = 4

Reading = Callable[[Source], tuple[DocumentNode, Problem | None, list[Diagnostic]]]


@dataclass(slots=True)
class _State:
    """A text with its mistakes, and where each character of it comes from.

    An origin is a place of the file, or -1 - k for what hint k has written.
    """

    text: SourceText
    origins: list[int]
    root: DocumentNode
    mistakes: list[Diagnostic]
    is_read: bool  # but for dimensions

    @property
    def errors(self) -> Iterator[tuple[Diagnostic, tuple[int, int]]]:
        """The errors that have a place, with it, but for names that are declared elsewhere."""
        for each in self.mistakes:
            if each.is_error and each.span.line > 0 and not _is_undeclared(each):
                yield each, self.text.offsets(each.span)

    def owner(self, place: tuple[int, int]) -> int | None:
        """The hint that has written a stretch of the text, or a part of it."""
        inside = self.origins[place[0] : max(place[1], place[0] + 1)]
        return next((-1 - each for each in inside if each < 0), None)


@dataclass(slots=True)
class _Followed:
    """A hint that was followed: the mistake at its place in the file, and what was written."""

    mistake: Diagnostic
    written: str
    begin: int


@dataclass(slots=True)
class _Mending:
    """The work on one file."""

    file: SourceText
    read: Reading
    first: Callable[[Diagnostic], bool]
    left: int = _READ
    followed: list[_Followed] = field(default_factory=list)
    refused: set[tuple[int, str]] = field(default_factory=set)

    @property
    def words(self) -> set[str]:
        """The words of the file."""
        text = re.sub(r"_?[\[{](\w+)[\]}]", r"_\1", self.file.source.text)  # k[0]
        found = {*re.findall(r"[^\W\d]\w*", f"{text} {self.file.source.text}")}
        return found | {each.removesuffix("t") for each in found}  # ωt

    def step(self, state: _State) -> _State | None:
        """The state after the next hint that can be followed; None where none can be."""
        if state.is_read:
            return None
        for each, place in sorted(state.errors, key=lambda one: (not self.first(one[0]), one[1])):
            known = (self.begin_of(state, place[0]), each.message)
            if known in self.refused or len(self.followed) >= _MOST:
                continue
            if (after := self._after(state, each, place)) is not None:
                return after
            self.refused.add(known)
        return None

    def _after(self, state: _State, mistake: Diagnostic, place: tuple[int, int]) -> _State | None:
        """The state after the edit that leaves the fewest mistakes; None where none helps."""
        text = state.text.source.text
        best: tuple[int, int, _State, list[Edit]] | None = None
        others = [at for one, at in state.errors if one is not mistake and at != place]
        for edits in edits_of(mistake, state.text, state.root):
            start, end, _ = edits[0]
            owner = state.owner((start, end)) if start < end else None
            number = len(self.followed) if owner is None else owner
            author = " ".join([text[slice(*place)], *(text[e.start : e.end] for e in edits)])
            after = self._settled(
                self._edited(state, edits, number), number, author, mistake.message
            )
            count = 0 if after is None else _count_after(after, edits[0])
            count += sum(start <= at and upto <= end for at, upto in others)  # not answered by it
            if after is not None and (best is None or count < best[0]):
                best = (count, number, after, edits)
                is_whole = (
                    start == place[0] and place[1] <= end and not _ENTRY.match(edits[0].written)
                )
                if is_whole and is_node(*place, state.root, text):
                    break
        if best is None:
            return None
        _, number, after, edits = best
        if number == len(self.followed):
            begin = self.begin_of(state, edits[0].start)
            also = tuple(
                (self.span_in_file(state, (edit.start, edit.end)), "it is written here too")
                for edit in edits[1:] if NO_NAME.match(mistake.message)
            )  # fmt: skip
            span = self.span_in_file(state, place)
            hint = mistake.hint
            if edits[1:] and hint.startswith("did you mean '"):  # the name, where it stands too
                name = "'" + text[slice(*place)].rstrip("'’′") + "'"
                alike = (at for one, at in state.errors if one.hint == hint and name in one.message)
                lines = {self.span_in_file(state, at).line for at in alike} - {span.line}
                hint += also_in_lines(sorted(lines)).removeprefix(",")
            here = replace(mistake, span=span, hint=hint, related=mistake.related + also)
            self.followed.append(_Followed(here, edits[0].written.lstrip("\n"), begin))
        return after

    def _settled(
        self, state: _State | None, number: int, author: str, message: str, depth: int = _DEEPEST
    ) -> _State | None:
        """The state with the hints followed inside of what hint `number` has written.

        Nothing where some remain.  Only what the author has written is mended: a hint may be a
        sentence.
        """
        if state is None:
            return None
        inside = [(each, at) for each, at in state.errors if state.owner(at) == number]
        if not inside:
            return state
        each, place = inside[0]
        repeats = depth == _DEEPEST and each.message == message
        if repeats or not depth or state.text.source.text[slice(*place)] not in author:
            return None
        for edits in edits_of(each, state.text, state.root):
            after = self._edited(state, edits, number)
            if (found := self._settled(after, number, author, message, depth - 1)) is not None:
                return found
        return None

    def _edited(self, state: _State, edits: list[Edit], number: int) -> _State | None:
        """The state after edits, the first of them hint `number`; None where it is not YAML."""
        text, origins = state.text.source.text, [*state.origins]
        for edit in sorted(edits, reverse=True):
            start, end, written = edit
            text = text[:start] + written + text[end:]
            origin = (
                -1 - number if edit is edits[0] else state.origins[min(start, len(origins) - 1)]
            )
            origins[start:end] = [origin] * len(written)
        self.left -= len(text) + 400
        source = replace(self.file.source, text=text)
        try:
            return None if self.left < 0 else _state(source, origins, self.read)
        except Mistake:
            return None

    def begin_of(self, state: _State, place: int) -> int:
        """Where in the file a place of a later text is."""
        origin = next(iter(state.origins[place : place + 1]), len(self.file.source.text))
        return origin if origin >= 0 else self.followed[-1 - origin].begin

    def span_in_file(self, state: _State, place: tuple[int, int]) -> Span:
        """The stretch of the file that a stretch of a later text is."""
        begin = self.begin_of(state, place[0])
        written = state.owner(place)
        if written is not None and begin >= len(self.file.source.text):  # in a new section
            return self.followed[written].mistake.span
        inside = [each for each in state.origins[slice(*place)] if each >= begin]
        owner = state.owner(place)
        if not inside and owner is not None and owner < len(self.followed):
            inside = [self.file.offsets(self.followed[owner].mistake.span)[1] - 1]
        end = min(max([*inside, begin]) + 1, len(self.file.source.text))
        return self.file.span(begin, max(begin, end) if place[0] < place[1] else begin)


def _state(source: Source, origins: list[int], read: Reading) -> _State:
    root, problem, found = read(source)
    return _State(SourceText.of(source), origins, root, found, problem is not None)


def _count_after(state: _State, edit: Edit) -> int:
    """The mistakes in the lines of an edit, and the names that nothing declares."""
    last = len(state.origins)
    lines = [state.text.position(min(at, last))[0]
             for at in (edit.start, edit.start + len(edit.written))]  # fmt: skip
    wrong = [each for each in state.mistakes if each.is_error and not state.is_read]
    return sum(_is_undeclared(each) or lines[0] <= each.span.line <= lines[1] for each in wrong)


def _is_undeclared(mistake: Diagnostic) -> bool:
    is_open = UNDECLARED in mistake.hint or COORDINATE in mistake.hint
    return is_open or mistake.message.startswith("the multiplier '")


def mended(
    source: Source, read: Reading, fully: Reading, first: Callable[[Diagnostic], bool]
) -> list[Diagnostic]:
    """The mistakes of a file and those that they hide, with hints that lead to a file that is read.

    To read a text gives its document, the problem where only dimensions are wrong, and the
    mistakes, or raises `Mistake`; `fully` also gives the best advice on dimensions, and takes
    longer.  What is `first` is mended before others.
    """
    state = _state(source, [*range(len(source.text))], fully)
    if len(source.text) > _LONGEST:
        return state.mistakes
    work = _Mending(state.text, read, first)
    while (after := work.step(state)) is not None:
        state = after
    mistakes = fully(state.text.source)[-1] if state.is_read else state.mistakes
    rest = []
    for each in mistakes:
        place = state.text.offsets(each.span) if each.span.line > 0 else None
        owner = state.owner(place) if place else None
        is_author = owner is None or (
            _is_undeclared(each) and {*re.findall(r"'(\w+)'", each.message)} & work.words
        )
        if is_author:
            span = work.span_in_file(state, place) if place else each.span
            rest.append(replace(each, span=span))
    return [*(_with_rest(one, number, state) for number, one in enumerate(work.followed)), *rest]


def _with_rest(one: _Followed, number: int, state: _State) -> Diagnostic:
    """The mistake with what its hint became when the hints inside of it were followed."""
    pairs = zip(state.text.source.text, state.origins, strict=True)
    whole = "".join(each for each, origin in pairs if origin == -1 - number).lstrip("\n")
    hint = one.mistake.hint
    if not one.written or whole in {"", one.written} or not PROPOSED.fullmatch(hint):
        return one.mistake
    name = f"'{one.written}'" if f"'{one.written}'?" in hint else one.written  # of a formula then
    return replace(one.mistake, hint=hint.replace(name, whole, 1))
