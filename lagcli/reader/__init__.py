"""Text to a checked `Problem`: YAML nodes with positions, expressions, names.

Reading runs nothing of what it reads.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lagcli.reader.expressions import parse_equation_text, parse_text
    from lagcli.reader.problem_file import ProblemReading, read_problem
    from lagcli.reader.settings import set_parameters, set_state

__all__ = [
    "ProblemReading",
    "parse_equation_text",
    "parse_text",
    "read_problem",
    "set_parameters",
    "set_state",
]

_HOMES = {
    "parse_equation_text": "expressions",
    "parse_text": "expressions",
    "ProblemReading": "problem_file",
    "read_problem": "problem_file",
    "set_parameters": "settings",
    "set_state": "settings",
}


def __getattr__(name: str) -> Any:
    """Import what is used: who needs a part of the reader does not load YAML."""
    if name not in _HOMES:
        raise AttributeError(name)
    from importlib import import_module

    return getattr(import_module(f"lagcli.reader.{_HOMES[name]}"), name)
