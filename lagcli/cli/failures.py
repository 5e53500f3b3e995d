"""How a mistake of lagcli itself is told: one line, and how to see more."""

from __future__ import annotations

import os
import sys
import traceback


def report_bug(error: BaseException, subject: str = "lagcli") -> None:
    """Say that something went wrong inside lagcli, and with what."""
    if os.environ.get("LAGCLI_TRACEBACK"):
        traceback.print_exception(error)
    sys.stderr.write(f"{subject}: error: {describe(error)}\n")


def describe(error: BaseException) -> str:
    """A sentence for an error that no one foresaw."""
    match error:
        case MemoryError():
            return "the memory did not suffice; `--show matrix_form` needs least"
        case RecursionError():
            return "the formulas are nested too deeply"
        case _:
            message = " ".join(str(error).split())
            return (
                f"this is a bug of lagcli ({type(error).__name__}: {message[:200]}); "
                "LAGCLI_TRACEBACK=1 shows where"
            )
