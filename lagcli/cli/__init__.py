"""The command line: arguments in, exit status out."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

__all__ = ["main"]


def main() -> NoReturn:
    """Run the command of `sys.argv` and exit."""
    from lagcli.cli.interrupts import end_at_once

    end_at_once()  # before anything that takes time to load
    from lagcli.cli.run import main as run_and_leave

    run_and_leave()
