"""A finished text to its place."""

from __future__ import annotations

from os.path import realpath
from pathlib import Path
from stat import S_ISDIR
from typing import TYPE_CHECKING

from lagcli.cli.error_output import report_line
from lagcli.cli.files import is_same_file, print_result, reason, write_output

if TYPE_CHECKING:
    from lagcli.cli.printing import Printing


def has_place(output: Path | None, *inputs: str) -> bool:
    """Whether there is a place for what comes out; checked before any work is done.

    A file that is read is none, by whatever name or link.
    """
    if output is None:
        return True
    if any(is_same_file(output, name) for name in inputs):
        report_line(f"{output}: error: is the problem itself, which would be lost")
        return False
    try:
        found = output.stat()
    except FileNotFoundError:
        pass
    except OSError as error:  # links in a circle, a name too long
        report_line(f"{output}: error: {reason(error)}")
        return False
    else:
        if S_ISDIR(found.st_mode):
            report_line(f"{output}: error: is a directory")
            return False
    if not Path(realpath(output)).parent.is_dir():
        report_line(f"{output}: error: there is no directory '{output.parent}'")
        return False
    return True


def deliver(text: str, printing: Printing) -> bool:
    """Print the text or write it to the file; whether that was possible."""
    if not printing.pdf:
        return place(text.encode(printing.encoding, "replace"), printing.output)
    from lagcli.cli.pdf import LatexError, to_pdf

    try:
        return place(to_pdf(text), printing.output)
    except LatexError as error:
        report_line(f"lagcli: error: {error}")
        return False


def place(data: bytes, output: Path | None) -> bool:
    """Print the bytes or write them to the file; whether that was possible."""
    if output is None:
        print_result(data)
        return True
    try:
        write_output(output, data)
    except OSError as error:
        report_line(f"{output}: error: {reason(error)}")
        return False
    return True
