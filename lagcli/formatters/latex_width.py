"""An estimate of how wide LaTeX sets a formula, in points of Computer Modern at 10 pt.

It errs on the wide side: a line that is broken too early is only a little shorter.
"""

from __future__ import annotations

from lagcli.formatters.layout import DIGITS, Layout, TextPiece
from lagcli.formatters.numbers import digit_groups

#: The text width of the article class, in points.
TEXT_WIDTH = 345.0
#: A formula in a subscript or an exponent is so much smaller (cmmi7 is broad for its size).
SCRIPT = 0.82
#: Spaces around binary operators and relations, the sign included.
BINARY, RELATION = 12.3, 13.4
THIN_SPACE = 1.7
QUAD = 10.0

# The wider of cmmi10 and cmr10, with the italic correction (Knuth, Computer Modern Typefaces).
_WIDTHS = {
    **dict.fromkeys("ijl,.;:'|!", 4.7),
    **dict.fromkeys("()[]", 5.2),
    **dict.fromkeys("0123456789", 5.05),
    **dict.fromkeys("crst", 4.8),
    **dict.fromkeys("aegoqvyz", 5.3),
    **dict.fromkeys("bdhkpux", 5.8),
    **dict.fromkeys("fn", 6.0),
    **dict.fromkeys("wm", 8.8),
    **dict.fromkeys("IJLS", 6.8),
    **dict.fromkeys("ABCEFGOPQRTUVYZ", 8.1),
    **dict.fromkeys("DHKNX", 9.2),
    **dict.fromkeys("MW", 10.8),
}
_OTHER = 8.5


def text_width(text: str) -> float:
    """Estimate the width of letters and digits; one beyond ASCII may need a longer stand-in."""
    return sum(_WIDTHS.get(c, _OTHER if c.isascii() else 20.0) for c in text)


def digits(value: int) -> Layout:
    """The digits of a whole number in groups, between which a line may end."""
    first, *others = digit_groups(value)
    pieces = [TextPiece(first, text_width(first))]
    for group in others:
        size = text_width(group)
        pieces.append(TextPiece(group, size, 0, DIGITS, group, size, tail=r" \backslash"))
    return tuple(pieces)
