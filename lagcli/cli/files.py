"""Files in and files out: what cannot be read is reported, what is written is whole."""

from __future__ import annotations

import errno
import os
import stat
import sys
from contextlib import suppress
from pathlib import Path

from lagcli.cli.streams import hush

STANDARD = "-"


def read_input(name: str) -> bytes:
    """The bytes of a file, of standard input for `-`, or of a problem of the library.

    Raises
    ------
    OSError
        When there is nothing to read.
    """
    if name == STANDARD:
        if sys.stdin is None:  # the caller has closed it
            raise OSError(errno.EBADF, "standard input is closed")
        return sys.stdin.buffer.read()
    try:
        return Path(name or "''").read_bytes()  # an empty name is not the folder
    except FileNotFoundError:
        from lagcli.library import find_problem

        return find_problem(name).read_bytes()


def is_same_file(path: Path, name: str) -> bool:
    """Whether both lead to one regular file, through links of either kind."""
    try:
        read = sys.stdin.fileno() if name == STANDARD and sys.stdin else name
        return path.is_file() and os.path.samestat(path.stat(), os.stat(read))  # noqa: PTH116
    except OSError:
        return False


def reason(error: OSError) -> str:
    """Why a file could not be used: `no such file or directory`."""
    sentence = error.strerror or str(error)
    return sentence[:1].lower() + sentence[1:]


def print_result(data: bytes) -> None:
    """Write to standard output; a reader that has left (`| head`) has had enough."""
    try:
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        hush()


def write_output(path: Path, data: bytes) -> None:
    """Write a file that at every moment is the old one or the new one, never a part.

    A temporary file in the same folder takes its place at the end.  What is no regular
    file (`/dev/null`, a pipe) is written as it is.

    Raises
    ------
    OSError
        When it cannot be written; the old file is then unchanged.
    """
    target = Path(os.path.realpath(path))  # through a symbolic link, not in its place
    if target.exists() and not target.is_file():
        target.write_bytes(data)
        return
    import tempfile

    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:80]}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).chmod(_mode(target))
        Path(temporary).replace(target)
    except BaseException:
        with suppress(OSError):
            Path(temporary).unlink()
        raise


def _mode(target: Path) -> int:
    """The permissions of the file that is replaced, or those of any new file."""
    if target.exists():
        return stat.S_IMODE(target.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
