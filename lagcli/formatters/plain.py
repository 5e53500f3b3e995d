"""Text from a file made harmless to a terminal, and paragraphs filled to a width."""

from __future__ import annotations

import unicodedata

from lagcli.formatters.display_width import display_width

#: Categories that a terminal acts upon, or shows nothing for.
_UNSHOWN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
#: The joiners that some scripts are spelled with.
_JOINERS = "\u200c\u200d"


def harmless(text: str) -> str:
    r"""Put the text on one line, control and direction characters written as `\u{1b}`."""
    spaced = " ".join(text.split())
    return "".join(
        f"\\u{{{ord(character):x}}}" if _acts(character) else character for character in spaced
    )


def _acts(character: str) -> bool:
    return unicodedata.category(character) in _UNSHOWN and character not in _JOINERS


def filled(words: list[str], width: int) -> list[str]:
    """Lines of words, none wider than `width`; a word that is wider is cut."""
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


def _cut(word: str, width: int) -> list[str]:
    pieces = [""]
    for character in word:
        if pieces[-1] and display_width(pieces[-1] + character) > width:
            pieces.append("")
        pieces[-1] += character
    return pieces
