"""A line that YAML does not read, as it reads it: what a hint may propose.

One change of one line is made after another, and the file is read again.  The first that the
reader accepts is proposed, or the first after which YAML reads further.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace

from lagcli.diagnostics import Diagnostic, Source, Span
from lagcli.reader.habits import colon_advice, habits

#: Longer files are not tried.
_LONGEST = 20_000
#: A key with its value.
_ENTRY = re.compile(r"(?P<key>\s*(?:- )?[^\W\d][\w ']*:\s+)(?P<value>\S.*)")
#: What other languages put before a formula: `@(x)`, `lambda x:`, and marks that YAML keeps.
_BEFORE = re.compile(r"^(?:@\([\w, ]*\)|lambda\b[\w, ]*:|[`@%&!*>=]+(?=[\w( ]))\s*")
#: A formula that begins with a group in brackets or quotes.
_GROUP = re.compile(
    r"(?:\[([^\]]*)\]|\{([^}:]*)\}|\"([^\"]*)\"|'([^']*)')(?P<rest>\s*[-+*/^(\w].*)"
)
#: The formula in a hint.
_PROPOSED = re.compile(r"(?:write|did you mean) (.*?)\??")
#: Keys with a text that is no formula.
_TEXTS = frozenset({"title", "source", "description"})
_PAIRS = {"[": "]", "{": "}", '"': '"', "'": "'"}
#: Advice that fits many lines; a repair is better.
_GENERAL = frozenset({"", "put the whole value in quotes", "group with parentheses ( )"})


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


def _paired(line: str) -> str:
    """`[x]` for `[x)`, and `"x"` for `"x'`."""
    found = re.fullmatch(r"(\s*[\w ]+:\s+)([\[{\"'])(.*)([\]})\"'])\s*", line)
    return line if found is None else f"{found[1]}{found[2]}{found[3]}{_PAIRS[found[2]]}"


def _separated(line: str) -> str:
    """`{m: 1, k: 2}` for `{m: 1 k: 2}`."""
    return re.sub(r"([\w.)\]'\"])\s+(?=[\"']?[^\W\d]\w*[\"']?:\s)", r"\1, ", line)


def _listed(line: str) -> str:
    """`[x, y]` for `{x[t], y[t]}`."""
    names = re.sub(r"[\[(]t[\])]", "", line)
    return re.sub(r"(:\s+)\{([^{}:]*,[^{}:]*)\}", r"\1[\2]", names)


def _formula(line: str) -> str:
    """Without what other languages put before a formula."""
    found = _ENTRY.fullmatch(line)
    return line if found is None else found["key"] + _BEFORE.sub("", found["value"]).rstrip("`")


def _grouped(line: str) -> str:
    """`V: (m/2)*x` for `V: {m/2}*x`, `[m/2]*x` and `"m/2"*x`."""
    found = _ENTRY.fullmatch(line)
    group = None if found is None else _GROUP.fullmatch(found["value"])
    if found is None or group is None or found["key"].strip(" :") in _TEXTS:
        return line
    inner = next(each for each in group.groups()[:-1] if each is not None)
    return f"{found['key']}({inner}){group['rest']}"


def _quoted(line: str) -> str:
    found = _ENTRY.fullmatch(line)
    if found is None or found["key"].strip(" :") not in _TEXTS:
        return line
    value = found["value"].replace("\\", "\\\\").replace('"', '\\"')
    return f'{found["key"]}"{value}"'


#: In the order in which they are tried.
_CHANGES: tuple[Callable[[str], str], ...] = (
    lambda line: re.sub(r"\s+//\s*(?=\S)", "  # ", line, count=1),
    lambda line: re.sub(r"^(\s*)-(?=[^\W\d]\w*\s*$)", r"\1- ", line),
    lambda line: re.sub(r"^(\s*\"?[^\W\d]\w*\"?)\s*(?:<-|←|:=|->|→|=>|=)\s*", r"\1: ", line),
    _formula,
    lambda line: re.sub(r"^(\s*[\w ]+:\s+)-\s+(?=\S)", r"\1-", line),
    _grouped,
    lambda line: re.sub(r"^(\s*)-\s+(?=[^\W\d]\w*:\s)", r"\1", line),
    lambda line: re.sub(r"^(\s*[^\W\d]\w*);\s", r"\1: ", line),
    lambda line: re.sub(r"'(\w+)'('+)(?=\s*:)", r"\1\2", line),
    lambda line: re.sub(r"(?<=[\[{,\s])['\"](?=[^\W\d]\w*'*(?::\s|\s*[\]},]))", "", line),
    lambda line: re.sub(r"\s+#\s*([^\]}#]*)([\]}]+)\s*$", r"\2  # \1", line),
    lambda line: re.sub(r"(?<=[\w)])\s+\[[\w*/^ ]+\](?=\s*[,}])", "", line),
    _paired,
    lambda line: line.replace(";", ",") if re.search(r"[\[{].*;", line) else line,
    lambda line: re.sub(r"\s+(?:%|--|;)\s*(?=\S)", "  # ", line, count=1),
    lambda line: re.sub(r"^([^{]*?)\s*[;,]\s+(?=[^\W\d]\w*:\s)", r"\1\n", line, count=1),
    lambda line: re.sub(r"(?<=[:,\[] )[%@`&!*](?=\w)", "", line),
    _listed,
    _closed,
    _separated,
    lambda line: line.rstrip() + "," if re.match(r"\s+[\w\"']+:.*[^:,]$", line) else line,
    lambda line: re.sub(r"([\]}\"'])\s*[;,.]\s*$", r"\1", line),
    _quoted,
    lambda line: re.sub(r"([\]}])\s*=\s*[^\s,\]}]+", r"\1", line),
)


def repaired_line(
    text: str, mistake: Diagnostic, read: Callable[[Source], tuple[bool, tuple[Diagnostic, ...]]]
) -> Diagnostic:
    """The mistake, with the line as it should be where one was found.

    Parameters
    ----------
    text
        The file.
    mistake
        What YAML complains about.
    read
        Whether YAML reads a text, and the mistakes in it.
    """
    lines = text.split("\n")
    first = mistake.span.line - 1
    shown = lines[first].strip() if first < len(lines) else ""
    general = (
        _GENERAL | {hint for *_, hint in habits()["yaml"]} | {f"write {shown}", colon_advice(shown)}
    )
    other = mistake.hint == "indent with spaces" or "U+" in mistake.message
    other |= mistake.hint.startswith("write parameters: ")
    if len(text) > _LONGEST or other or not (mistake.hint in general or re.match(r"-\w", shown)):
        return mistake
    for number, line in _tried(lines, first):
        changed = "\n".join([*lines[:number], line, *lines[number + 1 :]])
        is_read, found = read(Source("", changed))
        is_moved = line.strip() == lines[number].strip()
        near = {number + 1, number + 1 - is_moved}
        here = [each for each in found if each.span.line in near and each.is_error]
        proposed = _PROPOSED.fullmatch(here[0].hint) if is_read and here else None
        entry = _ENTRY.fullmatch(line)
        if proposed and entry:
            line = entry["key"] + proposed[1]
            changed = "\n".join([*lines[:number], line, *lines[number + 1 :]])
            is_read, found = read(Source("", changed))
            here = [each for each in found if each.span.line == number + 1 and each.is_error]
        further = found and found[0].span.line > max(first, number) + 1 and not proposed
        if not here and (is_read or further):
            span = mistake.span
            if number != first:
                begin = len(line) - len(line.lstrip()) + 1
                span = Span(number + 1, begin, number + 1, len(lines[number]) + 1)
            if line.strip() == lines[number].strip():
                return replace(mistake, hint=_indented(lines[:number], line))
            _, cut, key = line.partition("\n")
            hint = (
                f"begin a new line with '{key.partition(':')[0]}:'"
                if cut
                else f"write {line.strip()}"
            )
            return replace(mistake, span=span, hint=hint)
    return mistake


def _indented(above: list[str], line: str) -> str:
    """Where a line begins that was moved."""
    begin = len(line) - len(line.lstrip())
    before = next(each for each in reversed(above) if each.strip())
    if len(before) - len(before.lstrip()) != begin:
        return "begin the line with blanks"
    return f"begin the line where '{before.strip().partition(':')[0]}' begins"


def _tried(lines: list[str], first: int) -> Iterator[tuple[int, str]]:
    """The places of the lines near the mistake, each with what may have been meant."""
    above = [k for k in range(min(first, len(lines) - 1), -1, -1) if lines[k].strip()][:4]
    for number in above[1:]:
        indent = re.match(r"\s*", lines[number])
        yield above[0], f"{indent[0] if indent else ''}{lines[above[0]].lstrip()}"
    if above[1:] and re.fullmatch(r"(title|source|description):\s*", lines[above[1]]):
        yield above[0], f"  {lines[above[0]]}"
    for change in _CHANGES:
        for number in above:
            if (line := change(lines[number])) != lines[number]:
                yield number, line
