"""A derivation step by step, for Python and notebooks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.statements.explanation import Explanation


class Account:
    """What `explain` gives: numbered steps with their reasons."""

    def __init__(self, explanation: Explanation) -> None:
        self.title = explanation.title
        self.steps = tuple(step.title for step in explanation.steps)
        self.warnings = explanation.warnings
        self.complete = explanation.complete
        self._explanation = explanation

    def to_text(self, width: int = 80) -> str:
        """As `lagcli explain` prints it."""
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
        """The steps as a list for a machine."""
        return self._rendered("json")

    def __str__(self) -> str:
        return self.to_text().rstrip("\n")

    def __repr__(self) -> str:
        return f"<Account of {self.title!r}: {len(self.steps)} steps>"

    def _repr_html_(self) -> str:
        return self.to_html()

    def _rendered(self, format_name: str, width: int = 80, **options: Any) -> str:
        from lagcli.formatters import Options
        from lagcli.formatters.explaining import render

        return render([self._explanation], format_name, Options(width=width, **options))
