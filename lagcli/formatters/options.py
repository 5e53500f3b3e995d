"""What a formatter is, and the few things one may ask of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from lagcli.record import field, record

if TYPE_CHECKING:
    from lagcli.statements.answers import Answers


@record(kw_only=True)
class LatexOptions:
    r"""How the equations of `latex` are set.

    Attributes
    ----------
    labels : str
        What the labels of the equations begin with, which are then numbered; none where empty.
    separate : bool
        Each equation in an `equation`, not several in one `align`.
    variants : tuple of str
        Letters that stand for their other shape, such as `varphi` for `phi`.
    """

    labels: str = ""
    separate: bool = False
    variants: tuple[str, ...] = ()


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
        Several files were requested: `json` prints an array, also of one answer.
    latex : LatexOptions
        Of `latex`.
    below : tuple of str
        HTML under the answers, one for each: plots and animations of `html`.
    """

    width: int = 80
    unicode: bool = True
    standalone: bool = False
    several: bool = False
    latex: LatexOptions = field(default_factory=LatexOptions)
    below: tuple[str, ...] = ()


class Formatter(Protocol):
    """A function from results to text, one `Answers` for each file."""

    def __call__(self, answers: Sequence[Answers], options: Options) -> str:
        """Print the answers, one file after another."""
        ...
