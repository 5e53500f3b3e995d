"""A derivation step by step, for Python and notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.interface.rendered import Rendered
from lagcli.statements.explanation import Explanation

if TYPE_CHECKING:
    from lagcli.formatters import Options


class Account(Rendered):
    """What `explain` gives: numbered steps with their reasons."""

    def __init__(self, explanation: Explanation) -> None:
        self.title = explanation.title
        self.steps = tuple(step.title for step in explanation.steps)
        self.warnings = explanation.warnings
        self.complete = explanation.complete
        self._explanation = explanation

    def __repr__(self) -> str:
        return f"<Account of {self.title!r}: {len(self.steps)} steps>"

    def _render(self, format_name: str, options: Options) -> str:
        from lagcli.formatters.explaining import render

        return render([self._explanation], format_name, options)
