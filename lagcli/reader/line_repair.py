"""A line that YAML does not read, as it reads it: what a hint may propose.

One change of one line is made after another, and the file is read again.  The first that the
reader accepts is proposed, or the first after which YAML reads further.  The mistakes in the rest
of the file are those of the file with the line as proposed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from html import unescape
from typing import NamedTuple

from lagcli.diagnostics import Diagnostic, Source, Span
from lagcli.reader.compose import BLANKS
from lagcli.reader.habits import KEYS, SIGNS, colon_advice, habits
from lagcli.reader.regex import regex
from lagcli.reader.text import also_in_lines
from lagcli.reader.yaml_errors import CONTINUES, TEXTS, continued
from lagcli.record import replace

#: Longer files are not tried, nor more lines of a file.
_LONGEST, _MOST = 20_000, 8
#: Of the lines in one hint.
_SHOWN = 5
#: A key with its value.
_ENTRY = regex(r"(?P<key>\s*(?:- )?[^\W\d][\w ']*:\s+)(?P<value>\S.*)")
#: What other languages put before a formula: `@(x)`, `lambda x:`, and marks that YAML keeps.
_BEFORE = regex(r"^(?:@\([\w, ]*\)|lambda\b[\w, ]*:|[`@%&!*>=]+(?=[\w( ]))\s*")
#: Between dividend and divisor: m*x'^2 : 2.
_OVER = regex(r"(?<=[\w)'²³])\s+:\s+(?=[\d(])")
#: A formula that begins with a group in brackets or quotes.
_GROUP = regex(r"(?:\[([^\]]*)\]|\{([^}:]*)\}|\"([^\"]*)\"|'([^']*)')(?P<rest>\s*[-+*/^(\w].*)")
#: A value that is a sign: `> 0`, `assume: m>0`.
_SIGNED = regex(
    r"(?<!\w)(?:(value|assume|range|sign):\s+(?:\w+\s*)?|(\w+):\s+)(>=?|<|!=)\s*0(?=\s*(?:[,}]|$))"
)
#: The formula in a hint.
_PROPOSED = regex(r"(?:write|did you mean) (.*?)\??")
_ASSIGNED = regex(r"[^\W\d][\w()=' ]*?\s*:?=\s*[^=]")
_TWO_KEYS = (
    rf"^(.*?[^\s:;,])\s*[;,]?\s+(?=(?:{'|'.join(KEYS)}):\s)|^([^{{]*?)\s*[;,]\s+(?=[^\W\d]\w*:\s)"
)
#: What is said of a line that is none of the file.
_NO_LINE = regex(
    r"this line is none of the file; (?!.*(?:write |```)).*"
    r"|'-' is no value; .*"
    r"|(?:a ':' is missing behind|a key without) .*; "
    r"(?:leave it out: a problem has keys with|write title:|a comment begins with '#':) .*"
)
_PAIRS = {"[": "]", "{": "}", '"': '"', "'": "'"}
#: By what was added at the end of a line.
_NEVER_CLOSED = {"]": "a list '[' is never closed", "}": "a map '{' is never closed",
                 **dict.fromkeys("'\"", "this quote is never closed")}  # fmt: skip
#: Advice that fits many lines; a repair is better.
_GENERAL = {"", "put the whole value in quotes", "group with parentheses ( )",
            "leave out what is not known"}  # fmt: skip


def _closed(line: str) -> str:
    """With the brackets and quotes that are open at its end."""
    open_: list[str] = []
    before = " "
    for each in line.rstrip().rstrip(","):
        if open_ and each == open_[-1]:
            open_.pop()
        elif each in "[{" or (
            each in "'\"" and before in " [{,:" and open_[-1:] not in (["'"], ['"'])
        ):
            open_ += _PAIRS[each]
        before = each
    return line.rstrip().rstrip(",") + "".join(reversed(open_)) if open_ else line


def _without_last(line: str) -> str:
    """`[x]` for `[x]]`."""
    found = re.fullmatch(r"(.*([\]}]))\2\s*", line)
    opened = {"]": "[", "}": "{"}
    is_left = found is not None and line.count(found[2]) > line.count(opened[found[2]])
    return found[1] if found is not None and is_left else line


def _paired(line: str) -> str:
    """`[x]` for `[x)`, and `"x"` for `"x'`."""
    found = re.fullmatch(r"(\s*[\w ]+:\s+)([\[{\"'])(.*)([\]})\"'])\s*", line)
    return line if found is None else f"{found[1]}{found[2]}{found[3]}{_PAIRS[found[2]]}"


def _with_blanks(line: str) -> str:
    """`parameters: {m: 1}` for `parameters:{m:1}`."""
    begun = re.sub(r"^(\s*[^\W\d]\w*):(?=[^\s:])", r"\1: ", line)
    return re.sub(r"(?<=[{,\s])(\w+):(?=[\w.-])", r"\1: ", begun) if begun != line else line


def _with_points(line: str) -> str:
    """`{x: 1.5, y: 0}` for `{x: 1,5; y: 0}`."""
    if not re.search(r"\{.*;.*\}", line):
        return line
    return re.sub(r"(?<=\d),(?=\d)", ".", line).replace(";", ",")


def _listed(line: str) -> str:
    """`[x, y]` for `{x[t], y[t]}`."""
    names = re.sub(r"[\[(]t[\])]", "", line)
    return re.sub(r"(:\s+)\{([^{}:]*,[^{}:]*)\}", r"\1[\2]", names) if names != line else line


def _formula(line: str) -> str:
    """Without what other languages put before a formula, and with '/' for ':'."""
    found = _ENTRY.fullmatch(line)
    value = _BEFORE.sub("", found["value"]).rstrip("`") if found else ""
    return found["key"] + _OVER.sub("/", value) if found else line


def _grouped(line: str) -> str:
    """`V: (m/2)*x` for `V: {m/2}*x`, `[m/2]*x` and `"m/2"*x`."""
    found = _ENTRY.fullmatch(line)
    group = None if found is None else _GROUP.fullmatch(found["value"])
    if found is None or group is None or found["key"].strip(" :") in TEXTS:
        return line
    inner = next(each for each in group.groups()[:-1] if each is not None)
    return f"{found['key']}({inner}){group['rest']}"


def _quoted(line: str) -> str:
    found = _ENTRY.fullmatch(line)
    if found is None or found["key"].strip(" :") not in TEXTS:
        return line
    value = found["value"].replace("\\", "\\\\").replace('"', '\\"')
    return f'{found["key"]}"{value}"'


def _with_units(line: str) -> str:
    """`coordinates: {x: {unit: m}}` for `coordinates: [x [m]]`."""
    listed = re.fullmatch(r"(\w+:\s+)\[(.*\[.*\].*)\]\s*", line)
    items = listed[2].split(",") if listed else []
    found = [re.fullmatch(r"\s*(\w+)(?:\s*\[([^\[\]]+)\])?\s*", each) for each in items]
    if listed is None or not all(found):
        return line
    named = [f"{each[1]}: {{unit: {each[2]}}}" if each[2] else f"{each[1]}: {{}}"
             for each in found if each]  # fmt: skip
    return f"{listed[1]}{{{', '.join(named)}}}"


def _assumed(line: str) -> str:
    """`k: {assume: positive}` for `k: > 0`, and `assume: positive` for `value: > 0`."""

    def entry(found: re.Match[str]) -> str:
        sign = f"assume: {SIGNS[found[3]]}"
        return sign if found[1] else f"{found[2]}: {{{sign}}}"

    return _SIGNED.sub(entry, line)


def _with_indices(line: str) -> str:
    """`[x_1, x_2, x_3]` for `[x_{1}, x[2], Subscript[x, 3]]`."""
    form = r"Subscript\[(\w+),\s*(\w+)\]|(?<![\w:])([^\W\d]\w*?)_?(?:\[(\d+)\]|_\{(\w+)\})"
    is_listed = re.match(r"\s*\w+:\s+[\[{]", line)
    return re.sub(form, lambda m: "_".join(filter(None, m.groups())), line) if is_listed else line


#: What is written for each form, or the line for each line, in the order in which they are tried.
_CHANGES: tuple[tuple[str, str] | Callable[[str], str], ...] = (
    (r"^(.*?)\s+(?://|/\*|!\s)\s*(?=\S)", r"\1  # "),
    (r"^(\s*)-(?=[^\W\d]\w*\s*$)", r"\1- "),
    (r"(?<=:)\s+\?\s*$", ""),
    (r"(?:(?<=\{)value: +\?+(?:, +)?|, +value: +\?+)(?=[\w},])", ""),
    (r"(?<=: )\s*\?+\s*(?=[,}])", ""),
    (r"(?<=unit: )\s*-+(?=\s*(?:#|$))", "1"),
    _assumed,
    lambda line: re.sub(r"\\\[([A-Z])([a-z]+)\]", lambda m: m[1].lower() + m[2], line),
    (r"^([TVLH]:)\s+[a-z][a-z ]*:(?=\s)", r"\1"),
    _with_indices,
    _with_units,
    (r"^(\s*[\w ]+:\s+)(\|[^|]+\|.*)$", r'\1"\2"'),
    (r"^(\s*)[*•·–—+]\s+(?=[^\W\d]\w*\s*$)", r"\1- "),
    lambda line: unescape(line) if re.search(r"&\w+;", line) else line,
    (r"^[A-Za-z][a-z ]*\s([TVLH])\s*=\s*(?=\S)", r"\1: "),
    (rf"^({'|'.join(KEYS)})(?:\s+(?=[^\s:=])|(?=[\[{{]))", r"\1: "),
    (r"(?<=\w)\s*(?=\{\s*\w+:\s)", ": "),  # {m{value: 1}}
    (r"^(\s*\"?[^\W\d]\w*'?\"?(?:\((?:t=)?0\))?)\s*(?:<-|←|:=|->|→|=>|=|：)\s*", r"\1: "),
    (r"^(\s+[^\W\d]\w*)(?=\s*(?:#.*)?$)", r"\1:"),
    (r"(?<=[{,])(\s*\w+: )(\w+: [^,:{}\[\]]*[^\s,:{}\[\]])\s*(?=[,}])", r"\1{\2}"),  # {S: for: m}
    _with_blanks,
    _formula,
    (r"^(\s*[\w ]+:\s+)-\s+(?=\S)", r"\1-"),
    _grouped,
    (r"^(\s*)-\s+(?=[^\W\d]\w*:\s)", r"\1"),
    (r"^(\s*[^\W\d]\w*);\s", r"\1: "),
    (r"'(\w+)'('+)(?=\s*:)", r"\1\2"),
    (r"(?<=[\[{,\s])['\"](?=[^\W\d]\w*'*(?::\s|\s*[\]},]))", ""),
    (r"\s+#\s*([^\]}#]*)([\]}]+)\s*$", r"\2  # \1"),
    (r"(?<=[\w)])\s+\[[\w*/^ ]+\](?=\s*[,}])", ""),
    _paired,
    _without_last,
    _with_points,
    (  # bob: [x, y], m
        r"^(\s+\w+:\s+)(\[[^\[\]]+\]),\s*(?:m\w*\s*[:=]\s*)?(\w+)\s*$",
        r"\1{position: \2, mass: \3}",
    ),
    lambda line: line.replace(";", ",") if re.search(r"[\[{].*;", line) else line,
    (_TWO_KEYS, r"\1\2\n"),
    (r"^(.*?[^\s:,])\s+(?:%|--|;)\s*(?=\S)", r"\1  # "),
    (r"(?<=[:,\[] )[%@`&!*](?=\w)", ""),
    _listed,
    _closed,
    (r"([\w.)\]'\"])\s+(?=[\"']?[^\W\d]\w*[\"']?:\s)", r"\1, "),  # {m: 1 k: 2}
    lambda line: line.rstrip() + "," if re.match(r"\s+[\w\"']+:.*[^:,]$", line) else line,
    (r"(?<=[\w)\]}\"'])\s*[;,.]\s*$", ""),
    _quoted,
    (r"([\]}])\s*=\s*[^\s,\]}]+", r"\1"),
)


Reading = Callable[[Source], tuple[bool, tuple[Diagnostic, ...]]]
_Change = Callable[[str], str]


class _Repair(NamedTuple):
    """A mistake with the line as it should be, the file with that line, and how it changed."""

    mistake: Diagnostic
    text: str
    change: _Change


def all_mistakes(
    text: str, mistakes: tuple[Diagnostic, ...], fully: Reading, read: Reading
) -> tuple[Diagnostic, ...]:
    """The mistakes of a file that is not YAML: of its lines, and of the rest.

    Whether YAML reads a text is known with the mistakes that others hide (`fully`), or without.
    """
    found: list[Diagnostic] = []
    cuts: list[tuple[int, int]] = []  # lines that are two, and where the second begins
    is_read = False
    while not is_read and len(found) < _MOST:
        repair = _repaired(text, mistakes[0], read) or _left_out(text, mistakes[0])
        repair = repair or _continued(text, mistakes[0]) or _without_tabs(text, mistakes[0], read)
        if repair is None:
            break
        repair = _everywhere(text, repair, read)
        found.append(_at(repair.mistake, cuts))
        if repair.text.count("\n") > text.count("\n"):
            line = repair.mistake.span.line
            one, two = text.split("\n")[line - 1], repair.text.split("\n")[line]
            cuts.append((line, one.rfind(f"{two.partition(':')[0]}:")))
        text = repair.text
        is_read, mistakes = read(Source("", text))
    rest = fully(Source("", text))[1] if is_read else mistakes[:1] if found else mistakes
    whole = (*found, *(_at(each, cuts) for each in rest if each.is_error))
    return tuple(sorted(whole, key=lambda each: each.span))


def _left_out(text: str, mistake: Diagnostic) -> _Repair | None:
    """The file without a line that is none of it, or is its title; None for other mistakes."""
    lines, place = text.split("\n"), mistake.span.line - 1
    if not re.search(r"^coordinates:", text, re.MULTILINE) or not _NO_LINE.fullmatch(
        f"{mistake.message}; {mistake.hint}"
    ):
        return None
    if lines[place].lstrip().startswith("/*") or not any(map(str.strip, lines[place + 1 :])):
        return None
    named = re.fullmatch("write (title: .*)", mistake.hint)
    lines[place] = named[1] if named else ""
    return _Repair(mistake, "\n".join(lines), str)


def _continued(text: str, mistake: Diagnostic) -> _Repair | None:
    """The file with blanks before the lines that go on with a value; None for other mistakes."""
    if not mistake.hint.startswith(CONTINUES):
        return None
    lines, last = text.split("\n"), mistake.span.line
    while last < len(lines) and continued(lines, last) is not None:
        last += 1
    more = range(mistake.span.line, last)
    for k in (mistake.span.line - 1, *more):
        lines[k] = f"  {lines[k]}"
    hint = mistake.hint + also_in_lines(k + 1 for k in more)
    return _Repair(replace(mistake, hint=hint), "\n".join(lines), str)


def _without_tabs(text: str, mistake: Diagnostic, read: Reading) -> _Repair | None:
    """The file with a blank for each tab or other blank, where one indents, in the same column.

    None where lines with blanks do not fit them.
    """
    whole = re.sub(f"[{BLANKS}]", " ", text)
    if mistake.hint != "indent with spaces" or whole == text:
        return None
    is_mixed = re.search(r"^ +\S", text, re.MULTILINE)
    if is_mixed and not read(Source("", whole))[0]:
        return None
    lines = [k for k, line in enumerate(text.split("\n")) if re.match(rf" *[{BLANKS}]\s*\S", line)]
    hint = mistake.hint + also_in_lines(k + 1 for k in lines[1:])
    return _Repair(replace(mistake, hint=hint), whole, str)


def _at(mistake: Diagnostic, cuts: list[tuple[int, int]]) -> Diagnostic:
    """The mistake at its place in the file, in which a line is one that was cut in two."""
    for line, column in reversed(cuts):
        span = mistake.span
        if span.line > line:
            begin, end = ((at - 1, column * (at == line + 1)) for at in (span.line, span.end_line))
            moved = Span(begin[0], span.column + begin[1], end[0], span.end_column + end[1])
            mistake = replace(mistake, span=moved)
    return mistake


def _repaired(text: str, mistake: Diagnostic, read: Reading) -> _Repair | None:
    """The mistake with the line as it should be; None where none was found."""
    lines = text.split("\n")
    first = mistake.span.line - 1
    shown = lines[first].strip() if first < len(lines) else ""
    general = {*_GENERAL, f"write {shown}", colon_advice(shown)}
    general |= {hint for *_, hint in habits()["yaml"]}
    other = mistake.hint == "indent with spaces" or "U+" in mistake.message
    other |= mistake.hint.startswith("write parameters: ")
    if len(text) > _LONGEST or other or not (mistake.hint in general or re.match(r"-\w", shown)):
        return None
    for number, tried, change in _tried(lines, first):
        is_read, found, changed, line = _with_line(lines, number, tried, read)
        is_moved = line.strip() == lines[number].strip()
        near = {number + 1, number + 1 - is_moved}
        here = [each for each in found if each.span.line in near and each.is_error]
        further = found and found[0].span.line > max(first, number) + 1 and line == tried
        if not _beside_keys(here) and (is_read or further):
            span = mistake.span
            if number != first:
                begin = len(line) - len(line.lstrip()) + 1
                span = Span(number + 1, begin, number + 1, len(lines[number]) + 1)
            if is_moved:
                moved = replace(mistake, hint=_indented(lines[:number], line))
                return _Repair(moved, changed, change)
            one, cut, second = line.strip().partition("\n")
            hint = f"write {one}" + f", and on a line of its own {second}" * bool(cut)
            added = line[-1] if line.startswith(lines[number].rstrip()) else ""
            message = "two keys on one line" if cut else mistake.message
            message = _NEVER_CLOSED.get(added, message)
            left = lines[number].strip().removeprefix(line.strip()).strip()
            message = f"no '{left}' ends a line" if left in {*";,."} else message
            return _Repair(replace(mistake, message=message, span=span, hint=hint), changed, change)
    return None


def _beside_keys(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The errors, but for keys that are known to be lines of their own and in the wrong place."""
    return [x for x in found if x.is_error and not x.message.startswith("unknown key")]


def _with_line(
    lines: list[str], number: int, line: str, read: Reading
) -> tuple[bool, tuple[Diagnostic, ...], str, str]:
    """Whether a file is read with another line, its mistakes, its text, and the line.

    What the first mistake in the line proposes is followed.
    """
    for _ in range(2):
        changed = "\n".join([*lines[:number], line, *lines[number + 1 :]])
        is_read, found = read(Source("", changed))
        here = [each for each in found if each.span.line == number + 1 and each.is_error]
        proposed = _PROPOSED.fullmatch(here[0].hint) if is_read and here else None
        entry = _ENTRY.fullmatch(line)
        if proposed is None or entry is None:
            break
        key = entry["key"].lstrip()
        own = proposed[1].partition("; ")[0]
        only = re.match(r"\{(\w+: )[^,]*\}$", entry["value"])  # {S: {for: m}}
        own = f"{{{own}}}" if only and own.startswith(only[1]) else own
        line = entry["key"] + own.removeprefix(key)
    return is_read, found, changed, line


def _everywhere(text: str, repair: _Repair, read: Reading) -> _Repair:
    """The repair of all lines with the same mistake, where the file is read then."""
    before, first = text.split("\n"), repair.mistake.span.line - 1
    if not repair.mistake.hint.startswith("write "):
        return repair
    lines = [*before]
    for number, line in enumerate(before):
        entry = _ENTRY.fullmatch(line)
        is_text = entry is not None and entry["key"].strip(" :") in TEXTS
        lines[number] = line if is_text and number != first else repair.change(line)
    others = [k for k, line in enumerate(before) if lines[k] != line and k != first]
    if not others or len(others) > _MOST or any("\n" in line for line in lines):
        return repair
    for number in (first, *others):
        is_read, found, whole, lines[number] = _with_line(lines, number, lines[number], read)
    places = {first + 1, *(number + 1 for number in others)}
    if not is_read or any(each.span.line in places for each in _beside_keys(found)):
        return repair
    parts = [f"in line {number + 1} write {lines[number].strip()}" for number in others]
    parts[_SHOWN - 1 :] = ["and so on"] * (len(parts) >= _SHOWN)
    between = ", " if ";" in before[first] else "; "  # the ';' of a line is left out
    hint = between.join([f"write {lines[first].strip()}", *parts])
    return repair._replace(mistake=replace(repair.mistake, hint=hint), text=whole)


def _indented(above: list[str], line: str) -> str:
    """Where a line begins that was moved."""
    begin = len(line) - len(line.lstrip())
    before = next(each for each in reversed(above) if each.strip())
    if len(before) - len(before.lstrip()) != begin:
        return "begin the line with blanks"
    return f"begin the line where '{before.strip().partition(':')[0]}' begins"


def _attribute(lines: list[str], at: int) -> str:
    """`equation` for a line `r = R` among the attributes of a constraint, `gap` in contacts."""
    line = lines[at]
    indent = len(line) - len(line.lstrip())
    above = (
        each for each in reversed(lines[:at]) if re.match(rf"\s{{0,{max(0, indent - 1)}}}\S", each)
    )
    name, section = next(above, ""), next((x for x in reversed(lines[:at]) if x[:1].strip()), "")
    is_law = re.fullmatch(r"[^:#]*[=<>≤≥][^:#]*", line) and re.fullmatch(r"\s+\w+:\s*", name)
    return (
        {"constraints:": "equation", "contacts:": "gap"}.get(section.strip(), "") if is_law else ""
    )


def _tried(lines: list[str], first: int) -> Iterator[tuple[int, str, _Change]]:
    """The places of the lines near the mistake, each with what may have been meant."""
    above = [k for k in range(min(first, len(lines) - 1), -1, -1) if lines[k].strip()][:4]
    if name := _attribute(lines, above[0]):
        yield above[0], re.sub(r"^\s*", rf"\g<0>{name}: ", lines[above[0]]), str
    for number in above[1:] if not _ASSIGNED.match(lines[above[0]]) else ():
        indent = re.match(r"\s*", lines[number])
        yield above[0], f"{indent[0] if indent else ''}{lines[above[0]].lstrip()}", str
    if above[1:] and re.fullmatch(r"(title|source|description):\s*", lines[above[1]]):
        yield above[0], f"  {lines[above[0]]}", str
    for form in _CHANGES:
        change = form if callable(form) else partial(re.sub, *form)
        for number in above:
            if (line := change(lines[number])) != lines[number]:
                yield number, line, change
