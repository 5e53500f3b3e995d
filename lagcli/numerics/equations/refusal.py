"""Why there are no numbers: a sentence for the user, with its place in the file."""

from __future__ import annotations

from lagcli.diagnostics import Diagnostic


class Refusal(Exception):
    """The run cannot be made as requested.

    Parameters
    ----------
    message
        The sentence, or diagnostics that already have their places.
    mistake
        Whether the file or the command line is to be changed; otherwise an answer was
        not found.
    """

    def __init__(self, message: str | tuple[Diagnostic, ...], *, mistake: bool = True) -> None:
        if isinstance(message, str):
            message = (Diagnostic(message),)
        super().__init__("; ".join(diagnostic.message for diagnostic in message))
        self.diagnostics = message
        self.mistake = mistake


def reason_of(error: BaseException) -> str:
    """What went wrong in a formula, in words."""
    match error:
        case ZeroDivisionError():
            return "something is divided by zero"
        case OverflowError():
            return "a number grows beyond all bounds"
        case ValueError():
            return "a root, a logarithm or the like has no real value"
        case _:
            return str(error)
