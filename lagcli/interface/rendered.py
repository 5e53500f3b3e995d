"""What is printed as text, LaTeX, HTML and JSON: a solution, an account."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lagcli.record import replace

if TYPE_CHECKING:
    from lagcli.formatters.options import LatexOptions, Options


class Rendered(ABC):
    """A page in the formats of lagcli."""

    @abstractmethod
    def _render(self, format_name: str, options: Options) -> str:
        """Print the page by a formatter."""

    def _rendered(
        self, format_name: str, width: int = 80, latex: LatexOptions | None = None
    ) -> str:
        from lagcli.formatters import Options

        options = Options(width=width)
        return self._render(
            format_name, options if latex is None else replace(options, latex=latex)
        )

    def to_text(self, width: int = 80) -> str:
        """As the command line prints it."""
        return self._rendered("text", width)

    def to_latex(
        self, *, labels: str = "", separate: bool = False, variants: Sequence[str] = ()
    ) -> str:
        r"""A fragment for \input.

        Parameters
        ----------
        labels : str
            What the labels of the equations begin with; without it they are not numbered.
        separate : bool
            Each equation in an `equation`, not several in one `align`.
        variants : sequence of str
            Letters in their other shape, such as `varphi`.
        """
        from lagcli.formatters.options import LatexOptions

        chosen = LatexOptions(labels=labels, separate=separate, variants=tuple(variants))
        return self._rendered("latex", latex=chosen)

    def to_html(self) -> str:
        """HTML with MathML."""
        return self._rendered("html")

    def to_json(self) -> str:
        """As `--format json` has it."""
        return self._rendered("json")

    def __str__(self) -> str:
        return self.to_text().rstrip("\n")

    def _repr_html_(self) -> str:
        return self.to_html()

    def _repr_markdown_(self) -> str:
        return self._rendered("markdown")
