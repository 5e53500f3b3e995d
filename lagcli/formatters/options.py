"""What a formatter is, and the few things one may ask of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.answers import Answers


@record(kw_only=True)
class Options:
    """How to print.

    Attributes
    ----------
    width : int
        Display columns of the terminal; `text` prints no wider line.
    unicode : bool
        False where the terminal has ASCII only.
    standalone : bool
        `latex` and `html` print a whole document instead of a fragment.
    several : bool
        Several files were asked for: `json` prints an array, also of one answer.
    """

    width: int = 80
    unicode: bool = True
    standalone: bool = False
    several: bool = False


class Formatter(Protocol):
    """A function from results to text, one `Answers` for each file."""

    def __call__(self, answers: Sequence[Answers], options: Options) -> str:
        """Print the answers, one file after another."""
        ...
