"""Text from a file made harmless to a terminal, and paragraphs filled to a width."""

from __future__ import annotations

import unicodedata

from lagcli.formatters.display_width import display_width

#: Categories that a terminal acts upon, or shows nothing for.
_UNSHOWN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
#: The joiners that some scripts are spelled with.
_JOINERS = "\u200c\u200d"

#: Between the words of one formula.
FIRM_SPACE = "\N{NO-BREAK SPACE}"
_OPERATORS = tuple(f"{FIRM_SPACE}{sign}{FIRM_SPACE}" for sign in "+−-=<>≤≥")


def harmless(text: str) -> str:
    r"""Put the text on one line, control and direction characters written as `\u{1b}`."""
    spaced = " ".join(text.split())
    return "".join(
        f"\\u{{{ord(character):x}}}" if _acts(character) else character for character in spaced
    )


def with_spaces_of(part: str, shown: str, after: str = " ") -> str:
    """A part of a sentence as it is shown, with the spaces at the ends that it had."""
    return (" " if part[:1] == " " else "") + shown + (after if part[-1:] == " " else "")


def _acts(character: str) -> bool:
    return unicodedata.category(character) in _UNSHOWN and character not in _JOINERS


def filled(words: list[str], width: int) -> list[str]:
    """Lines of words, none wider than `width`; a wider one is cut, a formula at a space."""
    lines: list[str] = []
    line = ""
    for word in words:
        candidate = f"{line} {word}" if line else word
        if display_width(candidate) <= width:
            line = candidate
            continue
        if line:
            lines.append(line)
        *full, line = _cut(word, width)
        lines.extend(full)
    return [*lines, line] if line else lines


def _at_space(line: str) -> tuple[str, str]:
    """The line up to its last operator, or else its last firm space, if that is not far back."""
    for breaks in (_OPERATORS, (FIRM_SPACE,)):
        place = max(line.rfind(each) for each in breaks)
        if place > len(line) // 2:
            return line[:place], line[place:].lstrip(FIRM_SPACE)
    return line, ""


def _cut(word: str, width: int) -> list[str]:
    pieces = [""]
    for character in word:
        if pieces[-1] and display_width(pieces[-1] + character) > width:
            line, rest = _at_space(pieces[-1])
            pieces[-1:] = [line, rest]
        pieces[-1] += character
    return pieces
