"""What YAML complains about, in a sentence for someone who does not know YAML."""

from __future__ import annotations

import itertools
import re
from typing import Any

from lagcli.diagnostics import Diagnostic
from lagcli.reader.assignments import pieces
from lagcli.reader.foreign.cases import without_cases
from lagcli.reader.habits import CASE, COMMENT, KEYS, MAPS, PROGRAM, colon_advice, habits, key_meant
from lagcli.reader.headings import SAID, SECTIONS
from lagcli.reader.regex import regex
from lagcli.reader.text import SourceText, numbered


def explain(error: Exception, text: SourceText) -> Diagnostic:
    """A syntax error of YAML as a diagnostic with its place."""
    mark: Any = getattr(error, "problem_mark", None)
    problem = str(getattr(error, "problem", None) or getattr(error, "reason", None) or error)
    context = str(getattr(error, "context", None) or "")
    if mark is None:
        return _explain_character(error, text)
    offset = min(mark.index, len(text.source.text))
    start: Any = getattr(error, "context_mark", None)
    at_end = offset >= len(text.source.text.rstrip())
    if start is not None and at_end and "node" not in context:  # something was never closed
        offset = start.index
    span = text.span(offset, min(offset + 1, len(text.source.text)))
    said = f"{context} {problem}"
    if text.source.text[offset : offset + 1] == "\t" and "token" in said:
        return Diagnostic("a tab cannot indent", span, "indent with spaces")
    if at_end and "node content" in said:
        return Diagnostic(
            "the file ends inside of a list '[' or a map '{'", span, "write its ']' or '}'"
        )
    if start is not None and "could not find expected ':'" in said:
        offset = start.index
        span = text.span(offset, offset + 1)
    lines = text.source.text.split("\n")
    number = text.position(offset)[0] - 1
    line = lines[number]
    for place, each in enumerate(lines[: number + 1]):
        if foreign := _FOREIGN.match(each):
            begin = text.line_starts[place] + foreign.start(1)
            foreign_line = text.span(begin, begin + len(each.strip()))
            hint = _sections_meant(lines)
            if not foreign[1].startswith("["):
                has_keys = any(_BEFORE.match(line) and ":" in line for line in lines)
                hint = COMMENT if has_keys else f"{COMMENT}; {PROGRAM}"
                hint = hint if foreign[2] else colon_advice(each)
                hint = "leave it out" if each.strip() == ";" else hint
            return Diagnostic("this line is none of the file", foreign_line, hint)
    if assigned := re.match(
        r"\s*([\w.]+\s*=\s*(?:dict\()?)\{?\s*$", next(filter(str.strip, lines), "")
    ):
        begin_ = text.source.text.index(assigned[1])
        message = "the file is the map itself, without a name"
        span_ = text.span(begin_, begin_ + len(assigned[1].rstrip()))
        return Diagnostic(message, span_, f"leave out '{assigned[1].strip()}'")
    near = "\n".join(lines[max(0, number - 1) : number + 1])
    if blank := re.search(r"^\s*\w+:([^\S \t\r\n])", near, re.MULTILINE):
        here = text.source.text.index(blank[1])
        message = f"the blank U+{ord(blank[1]):04X} is none that YAML knows"
        return Diagnostic(message, text.span(here, here + 1), "type a usual blank there")
    if (at := _cut_by_comment(lines, number)) is not None:
        place = text.line_starts[at] + lines[at].index("#")
        span = text.span(place, place + len(lines[at].rstrip()) - lines[at].index("#"))
        hint = "put it on a line above the key"
        return Diagnostic("a comment ends the value that goes on below it", span, hint)
    if quoted := _QUOTED.fullmatch(line):
        hint = f"leave out the outer quotes: {quoted[1]}: {quoted[3].strip(quoted[2])}"
        return Diagnostic("this quote ends before the text does", span, hint)
    if section := _missing_section(lines, number):
        begin = text.line_starts[number] + len(line) - len(line.lstrip())
        key = line.partition(":")[0].strip()
        message = f"'{key}' is indented, and no line above it has a section for it"
        span = text.span(begin, begin + len(key))
        return Diagnostic(message, span, f"a line '{section}:' is missing above it")
    if "mapping values are not allowed" in said:
        return _second_colon(offset, text)
    if latex := re.search(r"\\[A-Za-z]+\{", line):
        begin = text.line_starts[number] + latex.start()
        message = "'\\' has no meaning in an expression"
        return Diagnostic(message, text.span(begin, begin + 1), "put the formula in quotes: '…'")
    if text.source.text.startswith("?", offset):
        return Diagnostic("'?' is not a value", span, "leave out what is not known")
    after = text.source.text[offset:]
    if bars := re.match(r"\|()", after) or re.match(r"[^|]*:\s+(\|[^|]+\|)", line):
        at = text.line_starts[number] + bars.start(1) if bars[1] else offset
        hint = "put the whole value in quotes" if bars[1] else "a modulus is written abs(x)"
        return Diagnostic("'|' has no meaning in an expression", text.span(at, at + 1), hint)
    for pattern, message, hint in habits()["lines"]:
        if found := re.search(pattern, line):
            return Diagnostic(message, span, found.expand(hint))
    first = next((each for each in lines if each.strip()), "")
    if "<document start>" in said and first[:1] == " " != line[:1]:
        key = first.split(":")[0].strip()
        return Diagnostic(f"this line begins further left than '{key}'", span, "begin them alike")
    for piece, sentence, hint in habits()["yaml"]:
        if piece in said:
            if not hint and (begin_line := continued(lines, number)) is not None:
                return Diagnostic(sentence, span, f"{CONTINUES}{begin_line + 1}")
            return Diagnostic(sentence, span, hint or colon_advice(line))
    return Diagnostic(f"this is not YAML: {problem}", span)


#: A line that begins in the middle of a formula.
_MIDDLE = regex(r"\s*([-+*^=]|/(?![/*])|\w+[-+*/^(])")
CONTINUES = "begin the line further right: it goes on with line "
#: Keys with a text that is no formula.
TEXTS = frozenset({"title", "source", "description"})
#: A text in quotes with one of them inside.
_QUOTED = regex(r"\s*([\w ]+):\s*(['\"])([^#]*\2[^#]*)\2\s*(?:#.*)?")
#: A comment of another language, the head of a section, a program: // a, ; a, % a; [a]; import a.
_FOREIGN = regex(
    r"\s*((//|/\*|;|%(?!YAML)|<!--|--\s|'''|\"\"\").*|\[\w+\]\s*$|(?:from\s+[\w.]+\s+)?import\s.*)"
)
#: A line with a key or a left side of its own.
_OWN = regex(r"\s*[^-+*/^=\s][^-+*/^=]*(:(\s|$)|=)")
_ENTRY = regex(r"( *)([^\W\d][\w']*):(?:\s|$)")
_BEFORE = regex(r"(?P<indent>\s*)(?P<key>[^\W\d][\w ]*)(?P<colon>:\s+\S)?")


def continued(lines: list[str], here: int) -> int | None:
    """The place of the entry that a line goes on with which begins where the entry does.

    Words go on with a text, and what begins with a sign, as `+ m*g*x` does, with a formula.
    """
    line = lines[here]
    entry = here - 1
    while entry > 0 and not (begun := _ENTRY.match(lines[entry])):
        entry -= 1
    begun = _ENTRY.match(lines[entry]) if entry >= 0 else None
    indent = len(line) - len(line.lstrip())
    if begun is None or len(begun[1]) != indent or _OWN.match(line):
        return None
    is_apart = not all(map(str.strip, lines[entry:here]))
    if begun[2] not in TEXTS:
        return entry if _MIDDLE.match(line) and not is_apart else None
    words = re.findall(r"\w+", line)
    short = re.search(r"[*/^{\[\d]|\w'(?!s)", line) or all(len(word) < 3 for word in words[1:])
    is_key = short and any(key_meant(" ".join(words[:k]), KEYS) for k in (1, 2))
    is_program = any(re.match(form, line) for form, _ in habits()["begins"])
    is_other = begun[2] != "description" and (is_apart or is_program or not words[1:])
    return entry if words and line[indent] not in "#-" and not is_key and not is_other else None


def _sections_meant(lines: list[str]) -> str:
    """What is written for lines such as `[parameters]`, the heads of sections elsewhere."""
    parts: list[str] = []
    for number, line in enumerate(lines, start=1):
        found = re.fullmatch(r"\s*\[(\w+)\]\s*", line)
        if found is None:
            continue
        key = key_meant(found[1], KEYS)
        at = f"in line {number} " if parts else ""
        parts.append(f"{at}write {key}:" if key else f"{at}leave it out")
    if not any("write" in each for each in parts):
        return "a key is written without brackets: key: value"
    return f"{'; '.join(parts)}; the entries of a section begin with blanks"


def _cut_by_comment(lines: list[str], here: int) -> int | None:
    """The line with the comment that cuts a value in two, where line `here` goes on with it."""
    if re.match(r"\s*([^\W\d][\w']*\s*:|#|$)|\S", lines[here]):
        return None
    above = here - 1
    while above >= 0 and re.match(r"\s*#", lines[above]):
        above -= 1
    begins = re.match(r"[^#'\"]+:\s+[^\s#'\"|>][^#]*?(?P<comment>\s#|\s*$)", lines[above])
    if above < 0 or begins is None or not (begins["comment"].strip() or above < here - 1):
        return None
    return above if begins["comment"].strip() else above + 1


def _second_colon(offset: int, text: SourceText) -> Diagnostic:
    """A colon where none can stand: the line is indented too far, or the one above has none."""
    line, column = text.position(offset)
    lines = text.source.text.split("\n")
    here = _BEFORE.fullmatch(lines[line - 1][: column - 1])
    place = next((k for k in range(line - 2, -1, -1) if lines[k].strip()), None)
    above = None if place is None else _BEFORE.match(lines[place])
    if here is not None and above is not None and place is not None:
        start = text.line_starts[line - 1] + len(here["indent"])
        outer = re.match(r"(\s*)(\w+):\s*$", lines[place - 1]) if place else None
        if outer and outer[1] == above["indent"] and above["key"] in SECTIONS:
            begin = text.line_starts[place] + len(above["indent"])
            message = f"'{above['key']}' stands below '{outer[2]}', but not in it"
            span = text.span(begin, begin + len(above["key"]))
            return Diagnostic(message, span, "begin the line with more blanks")
        is_name = re.fullmatch(r"\s*\w+\s*", lines[place])
        if is_name and len(above["indent"]) < len(here["indent"]):
            begin = text.line_starts[place] + len(above["indent"])
            key = above["key"].strip()
            span = text.span(begin, begin + len(key))
            return Diagnostic(f"a ':' is missing behind '{key}'", span, f"write {key}:")
        if above["colon"] and len(above["indent"]) < len(here["indent"]):
            message = f"'{here['key']}' is indented further than '{above['key']}' above it"
            hint = f"begin the line where '{above['key']}' begins"
            return Diagnostic(message, text.span(start, offset), hint)
        if not above["colon"] and len(above["indent"]) == len(here["indent"]):
            start = text.line_starts[place] + len(above["indent"])
            end = text.line_starts[place] + len(lines[place])
            missing = "blank" if lines[place][above.end() :].startswith(":") else "':'"
            message = f"a {missing} is missing behind '{above['key'].split()[0]}'"
            hint = colon_advice(lines[place], text.source.text)
            return Diagnostic(message, text.span(start, end), hint)
    span = text.span(offset, offset + 1)
    if re.search(r"\S\s+\?\s+\S|:\s+if\s", lines[line - 1]):
        value = lines[line - 1].partition(":")[2].strip()
        whole = without_cases(value)
        return Diagnostic(
            "a formula has no cases", span, CASE if whole == value else f"write {whole}"
        )
    inner = re.match(r"\s*(\w+):\s+([^\W\d][\w ]*'*:.*\S)", lines[line - 1])
    name, _, value = inner[2].partition(":") if inner else ("", "", "")
    if inner and (inner[1] in MAPS or (name in {*SECTIONS, *SAID} and inner[1] not in TEXTS)):
        parts = pieces(value, ",")
        if parts[1:] and all(re.search("[^<>]=", each) for each in parts):
            whole = numbered("_".join(name.split()), map(str.strip, parts))
            return Diagnostic("each equation has a name", span, f"write {inner[1]}: {{{whole}}}")
        hint = f"write {inner[1]}: {{{inner[2]}}}"
        return Diagnostic("a map on the line of its key stands in braces", span, hint)
    return Diagnostic("a second ':' in one value", span, "put the whole value in quotes")


def _missing_section(lines: list[str], here: int) -> str:
    """The section whose line is missing above an indented entry; empty where none is."""
    entry = re.match(r"(\s+)(\w+):(?:\s+(\S.*)|\s*$)", lines[here])
    above = next((k for k in range(here - 1, -1, -1) if re.match(r"\s*[^\s#]", lines[k])), None)
    if entry is None or above is None or key_meant(entry[2], KEYS) is not None:
        return ""
    begun = re.match(r"(\w+):\s+[^\s#|>]", lines[above])
    if begun is None or begun[1] not in KEYS:
        return ""
    deeper = itertools.takewhile(lambda each: each.startswith(f"{entry[1]} "), lines[here + 1 :])
    value, text = entry[3] or " ".join(deeper), "\n".join(lines)
    given = set(re.findall(r"^(\w+):", text, re.MULTILINE))
    keys = re.findall(r"(\w+):", value)
    found = [SECTIONS[key] for key in keys if key in SECTIONS]
    if not keys and re.search(r"[<>]=?", value):
        found.append("contacts")
    elif not keys and "=" in value:
        found.append("constraints")
    usual = ["parameters", "definitions", "points", "constraints", "symmetries"]
    return next(
        each for each in (*found, *usual, "initial") if each not in given or each == "initial"
    )


def _explain_character(error: Exception, text: SourceText) -> Diagnostic:
    """A character that YAML forbids, such as a control character."""
    for offset, character in enumerate(text.source.text):
        code = ord(character)
        allowed = character in "\t\n\x85" or 0x20 <= code <= 0x7E or code >= 0xA0
        if not allowed or 0xD800 <= code <= 0xDFFF or code in {0xFFFE, 0xFFFF}:
            message = f"the character U+{code:04X} cannot stand in a file"
            return Diagnostic(message, text.span(offset, offset + 1))
    return Diagnostic(f"this is not YAML: {error}", text.span(0, 0))
