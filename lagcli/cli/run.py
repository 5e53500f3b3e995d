"""From the process's arguments to its exit status, whatever happens on the way."""

from __future__ import annotations

import atexit
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

from lagcli.cli.interrupts import end_at_once, interrupted, raise_exceptions
from lagcli.cli.status import Status
from lagcli.cli.streams import hush
from lagcli.sparing import collect_rarely


def main() -> NoReturn:
    """Run the command of `sys.argv` and exit."""
    collect_rarely()
    if sys.stderr is None:  # closed: what would be said there is not heard
        sys.stderr = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    try:
        raise_exceptions()
        status = run(sys.argv[1:])
    except KeyboardInterrupt:
        status = Status.INTERRUPTED
    end_at_once()
    if interrupted():
        os._exit(Status.INTERRUPTED)  # what still computes in a thread need not be waited for
    leave(status)


def leave(status: int) -> NoReturn:
    """Exit without taking apart what is in memory: for SymPy that takes a tenth of a run."""
    atexit._run_exitfuncs()  # noqa: SLF001 - all that a usual exit does for others
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):  # closed, or nobody reads
            stream.flush()
    os._exit(status)


def run(arguments: Sequence[str]) -> int:
    """The exit status of a command line; whatever goes wrong is reported on standard error."""
    if sys.stdout is None:
        sys.stderr.write("standard output: error: it is closed\n")
        return Status.USAGE
    try:
        from click import Abort, ClickException

        from lagcli.cli.app import application

        try:
            if {"--set", "--at", "--vary"} & {*arguments}:
                from lagcli.cli.usage import refuse_values_apart

                refuse_values_apart(arguments)
            outcome = application().main(
                args=list(arguments), prog_name="lagcli", standalone_mode=False
            )
            sys.stdout.flush()
        except ClickException as mistake:
            from lagcli.cli.usage import report_mistake

            report_mistake(mistake, arguments)
            return Status.USAGE
        except Abort:
            return Status.INTERRUPTED
    except KeyboardInterrupt:
        return Status.INTERRUPTED
    except BrokenPipeError:
        hush()
        return Status.WELL
    except OSError as error:
        from lagcli.cli.files import reason

        where = error.filename or "standard output"
        sys.stderr.write(f"{where}: error: {reason(error)}\n")
        return Status.USAGE
    except Exception as error:  # noqa: BLE001 - the last resort: no traceback reaches a user
        if interrupted():
            return Status.INTERRUPTED
        from lagcli.platform.failures import describe

        sys.stderr.write(f"lagcli: error: {describe(error)}\n")
        return Status.NOT_FOUND
    return outcome if isinstance(outcome, int) else Status.WELL
