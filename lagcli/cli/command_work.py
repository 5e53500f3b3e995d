"""What a command makes of each file's derivation, and how that is printed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Generic, NamedTuple, TypeVar

from lagcli.formatters import Options
from lagcli.formatters.explaining import FORMATS
from lagcli.formatters.explaining import render as render_explanations
from lagcli.formatters.registry import UnknownFormatter, find_formatter
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import Request, explain, render, state
from lagcli.reader.suggest import did_you_mean
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Declaration
from lagcli.statements.explanation import Explanation
from lagcli.statements.registry import explained_in_order, in_order

Result = TypeVar("Result", Answers, Explanation)


class CommandWork(NamedTuple, Generic[Result]):
    """One command's way from derivations to text."""

    make: Callable[[Derivation, Request], Result]
    render: Callable[[Sequence[Result], str, Options], str]
    mistakes: Callable[[str], list[str]]
    option: str = "--show"  # that picks sections
    sections: Callable[[Iterable[str] | None], list[Declaration]] = in_order


def _format_of_answers(name: str) -> list[str]:
    formatter = find_formatter(name)
    return [f"--format: {formatter.message}"] if isinstance(formatter, UnknownFormatter) else []


def _format_of_explanations(name: str) -> list[str]:
    if name in FORMATS:
        return []
    advice = did_you_mean(name, FORMATS) or f"there are {', '.join(FORMATS)}"
    return [f"--format: an explanation has no format '{name}': {advice}"]


#: By command.
WORKS: dict[str, CommandWork[Any]] = {
    "solve": CommandWork(state, render, _format_of_answers),
    "explain": CommandWork(
        lambda derivation, request: explain(
            derivation, request.sections or (), named=request.named
        ),
        render_explanations,
        _format_of_explanations,
        "--also",
        explained_in_order,
    ),
}
