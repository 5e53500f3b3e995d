"""How a mistake of lagcli itself is reported: one line, and how to see more."""

from __future__ import annotations

import os
import traceback


def describe(error: BaseException) -> str:
    """A sentence for an error that no one foresaw; its traceback on request only."""
    if os.environ.get("LAGCLI_TRACEBACK"):
        traceback.print_exception(error)
    match error:
        case MemoryError():
            return "the memory did not suffice; --show matrix_form needs least"
        case RecursionError():
            return "the formulas are nested too deeply"
        case TimeoutError():
            return f"not found: {error}"
        case _:
            message = " ".join(str(error).split())
            return (
                f"this is a bug of lagcli ({type(error).__name__}: {message[:200]}); "
                "LAGCLI_TRACEBACK=1 shows where"
            )
