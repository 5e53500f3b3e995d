"""Colours that are told apart by all eyes, on white and on black.

References
----------
Okabe, Ito, "Color universal design: how to make figures and presentations that are friendly
to colorblind people" (2008).
"""

from __future__ import annotations

from lagcli.record import record

#: Blue, vermilion, bluish green, reddish purple, orange, sky blue.
ON_WHITE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333", "#8B6914")
ON_BLACK = ("#56B4E9", "#E69F00", "#2BC59A", "#E3A3C6", "#F0E442", "#F4875A", "#DDDDDD", "#C9A84C")
#: Beside the colour, so that a print in grey is read as well; as lengths of dash and gap.
DASHES: tuple[tuple[float, ...], ...] = ((), (6, 2), (2, 1.5), (7, 2, 1.5, 2))


@record(kw_only=True)
class Style:
    """The colours of a page."""

    series: tuple[str, ...]
    paper: str
    ink: str
    faint: str  # grid, level lines
    grey: str  # what lies beyond the certificate
    second: str  # notes

    def colour(self, place: int) -> str:
        """Of a curve or a body by its place in the file."""
        return self.series[place % len(self.series)]


LIGHT = Style(
    series=ON_WHITE, paper="#ffffff", ink="#1a1a1a", faint="#c8c8c8", grey="#eeeeee",
    second="#595959",
)  # fmt: skip
DARK = Style(
    series=ON_BLACK, paper="#121212", ink="#ececec", faint="#4a4a4a", grey="#262626",
    second="#a8a8a8",
)  # fmt: skip
