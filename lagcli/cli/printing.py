"""Where the result goes, and in which form."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

    from lagcli.formatters import Options

PIPE_WIDTH = 80


class Printing(NamedTuple):
    """Where to, and in which form.

    Attributes
    ----------
    latex : tuple of str
        The words of `--latex`.
    pdf : bool
        The LaTeX is compiled.
    motion : bool
        With plots and animations under the answers.
    """

    format_name: str
    output: Path | None
    standalone: bool
    width: int | None
    latex: tuple[str, ...] = ()
    pdf: bool = False
    motion: bool = False

    @property
    def columns(self) -> int:
        """As requested; else those of the terminal, or 80."""
        if self.width:
            return self.width
        if self.output is not None or not sys.stdout.isatty():
            return PIPE_WIDTH
        from shutil import get_terminal_size

        return get_terminal_size((PIPE_WIDTH, 24)).columns

    @property
    def encoding(self) -> str:
        """UTF-8, but for text on a terminal that has something else."""
        if self.output is not None or self.format_name != "text":
            return "utf-8"
        return sys.stdout.encoding or "utf-8"

    def options(self, *, several: bool, below: tuple[str, ...] = ()) -> Options:
        """What the formatter knows of the page around its text."""
        from lagcli.cli.latex_options import latex_options
        from lagcli.formatters import Options

        return Options(
            width=self.columns,
            unicode=self.encoding.lower().startswith("utf"),
            standalone=self.standalone,
            several=several,
            latex=latex_options(self.latex),
            below=below,
        )


def printing_of(
    form: str,
    output: Path | None,
    *,
    standalone: bool,
    width: int | None,
    latex: list[str] | None,
    motion: bool,
) -> Printing:
    """The options of a page; HTML that goes into a file is a whole page.

    Raises
    ------
    click.UsageError
        Where they do not fit each other, or there is nothing that makes a PDF.
    """
    pdf = form == "pdf"
    if pdf:
        from lagcli.cli.pdf import demand_latex

        demand_latex(output)
    if latex:
        from lagcli.cli.latex_options import demand_options

        demand_options(latex, form)
    if motion:
        from lagcli.cli.motion_on_page import demand_pictures

        demand_pictures(form)
    whole = standalone or pdf or (form == "html" and output is not None)
    words = tuple(latex or ())
    return Printing("latex" if pdf else form, output, whole, width, words, pdf, motion)
