"""Finished results on disk, found by everything that determines them.

An entry is one file, named by the digest of the request.  It holds the digest of
its own text, so what is cut off, damaged or half-written is not read but replaced.  It
comes into being under another name and takes its own in one step, so that runs at the
same time see a whole entry or none.  Whatever cannot be read or written is left out: a
cache never makes a run fail.
"""

from __future__ import annotations

import json
import os
import re
import stat
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from hashlib import sha256
from typing import Any, NamedTuple

LIMIT = 64 << 20  # bytes, of all entries together
_SHELVES = "0123456789abcdef"  # an entry stands on the shelf of its first digit
_HEAD = b"lagcli result 1\n"
_NAME = re.compile(r"[0-9a-f]{64}|\.[0-9a-f]{64}\.\d+")  # an entry, one half written
#: A pipe in the folder is not waited for.
_READ = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)
_ABANDONED = 3600.0  # seconds after which a half-written file is nobody's


class KeptAnswer(NamedTuple):
    """What a run printed: the result, the sentences beside it, and the exit status."""

    status: int
    text: str | None
    said: tuple[str, ...] = ()


class Cache:
    """A folder of entries, bounded in size; the entries least used go first.

    Parameters
    ----------
    folder
        Where the entries are; it need not exist.
    limit
        Bytes that all entries together may take.
    """

    def __init__(self, folder: str, limit: int = LIMIT) -> None:
        self.folder = folder
        self.limit = limit

    def find(self, key: str) -> KeptAnswer | None:
        """The entry of a key; None when there is none that can be trusted."""
        shelf = self._shelf(key)
        path = os.path.join(shelf, key)  # noqa: PTH118
        try:
            if not _ours(shelf):
                return None
            with os.fdopen(os.open(path, _READ), "rb") as file:
                if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                    return None
                data = file.read()
        except OSError:
            return None
        entry = _read(data, key)
        if entry is not None:
            with suppress(OSError):
                os.utime(path)  # used just now
        return entry

    def keep(self, key: str, entry: KeptAnswer) -> None:
        """Keep an entry, if there is a place for it."""
        shelf, data = self._shelf(key), _written(entry, key)
        if len(data) > self.limit // len(_SHELVES):
            return
        with suppress(OSError):
            os.makedirs(self.folder, mode=0o700, exist_ok=True)  # noqa: PTH103
            with suppress(FileExistsError):
                os.mkdir(shelf, mode=0o700)  # noqa: PTH102
            if _ours(shelf):
                _put(shelf, key, data)
                self._shorten(shelf)

    def clear(self) -> None:
        """Remove every entry."""
        for path, _ in self._files():
            with suppress(OSError):
                os.unlink(path)  # noqa: PTH108

    def size(self) -> tuple[int, int]:
        """How many entries there are, and how many bytes they take."""
        sizes = [found.st_size for _, found in self._files()]
        return len(sizes), sum(sizes)

    def _shelf(self, key: str) -> str:
        return os.path.join(self.folder, key[0])  # noqa: PTH118

    def _files(self) -> Iterator[tuple[str, os.stat_result]]:
        for digit in _SHELVES:
            yield from _files(self._shelf(digit))

    def _shorten(self, shelf: str) -> None:
        """Let no shelf take more than its part of the limit."""
        files = sorted(_files(shelf), key=lambda file: file[1].st_mtime_ns, reverse=True)
        newest = files[0][1].st_mtime if files else 0.0
        room = self.limit // len(_SHELVES)
        for path, found in files:
            half_written = os.path.basename(path).startswith(".")  # noqa: PTH119
            abandoned = half_written and found.st_mtime < newest - _ABANDONED
            room -= found.st_size
            if abandoned or room < 0:
                with suppress(OSError):
                    os.unlink(path)  # noqa: PTH108


def _files(shelf: str) -> Iterator[tuple[str, os.stat_result]]:
    """What the cache has put on a shelf; nothing else there is touched."""
    with suppress(OSError):
        if not _ours(shelf):
            return
        with os.scandir(shelf) as entries:
            for entry in entries:
                with suppress(OSError):
                    if _NAME.fullmatch(entry.name) and entry.is_file(follow_symlinks=False):
                        yield entry.path, entry.stat(follow_symlinks=False)


def _put(shelf: str, key: str, data: bytes) -> None:
    """Write under another name, then take the right one in one step.

    Not synchronized with the disk: what a crash of the machine leaves fails its digest.
    """
    temporary = os.path.join(shelf, f".{key}.{os.getpid()}")  # noqa: PTH118
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | getattr(os, "O_NOFOLLOW", 0)
    try:
        handle = os.open(temporary, flags, 0o600)
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.replace(temporary, os.path.join(shelf, key))  # noqa: PTH105, PTH118
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)  # noqa: PTH108
        raise


def _written(entry: KeptAnswer, key: str) -> bytes:
    body = json.dumps({"key": key, **entry._asdict()}, separators=(",", ":")).encode()
    return _HEAD + sha256(body).hexdigest().encode() + b"\n" + body


def _read(data: bytes, key: str) -> KeptAnswer | None:
    if not data.startswith(_HEAD):
        return None
    digest, _, body = data[len(_HEAD) :].partition(b"\n")
    if sha256(body).hexdigest().encode() != digest:
        return None
    try:
        found = json.loads(body)
        whole = (found["key"], found["status"], found["text"], tuple(found["said"]))
    except (ValueError, TypeError, LookupError, RecursionError):  # not of our making
        return None
    return KeptAnswer(*whole[1:]) if _is_entry(*whole, sought=key) else None


def _is_entry(
    key: object, status: object, text: object, said: Iterable[object], *, sought: str
) -> bool:
    return (
        key == sought
        and status in (0, 1, 2)
        and isinstance(text, str | None)
        and all(isinstance(sentence, str) for sentence in said)
    )


def _ours(shelf: str) -> bool:
    """Whether it is a folder into which nobody else can have put anything."""
    found = os.lstat(shelf)
    if not hasattr(os, "getuid"):
        return stat.S_ISDIR(found.st_mode)
    is_open = found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    return stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not is_open


# -- where, and by what ---------------------------------------------------------------------


def folder(environment: Mapping[str, str]) -> str | None:
    """The place of the cache; None without a home.

    `LAGCLI_CACHE_DIR`, else `lagcli` in `XDG_CACHE_HOME` or in `~/.cache`.
    """
    chosen = environment.get("LAGCLI_CACHE_DIR")
    if chosen:
        return os.path.abspath(chosen)  # noqa: PTH100
    base = environment.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # noqa: PTH117 - unset, or to be ignored by the specification
        home = os.path.expanduser("~")  # noqa: PTH111
        if not os.path.isabs(home):  # noqa: PTH117
            return None
        base = os.path.join(home, ".cache")  # noqa: PTH118
    return os.path.join(base, "lagcli")  # noqa: PTH118


def key(request: Mapping[str, Any], files: Sequence[tuple[str, bytes]]) -> str:
    """The digest of all that determines a result.

    Parameters
    ----------
    request
        The options, as JSON can write them.
    files
        Names and contents of the problem files, in their order.
    """
    digests = [[name, sha256(data).hexdigest()] for name, data in files]
    whole = [request, digests, _program()]
    return sha256(json.dumps(whole, sort_keys=True).encode()).hexdigest()


def _program() -> list[Any]:
    """What computes: Python, every file of lagcli, the versions of what it stands on."""
    import lagcli

    root = os.path.dirname(os.path.abspath(lagcli.__file__))  # noqa: PTH100, PTH120
    return [sys.version, lagcli.__version__, sorted(_sources(root)), [*_versions()]]


def _sources(root: str) -> Iterator[list[Any]]:
    """Name, size and time of each file: a changed program never shows an old result."""
    folders = [root]
    while folders:
        with os.scandir(folders.pop()) as entries:
            for entry in entries:
                if entry.name == "__pycache__":
                    continue
                if entry.is_dir():
                    folders.append(entry.path)
                else:
                    found = entry.stat()
                    yield [entry.path, found.st_size, found.st_mtime_ns]


def _versions() -> Iterator[list[str]]:
    """The files in which the packages keep their version; none of them is imported."""
    from importlib.util import find_spec

    for package, file in (
        ("sympy", "release.py"),
        ("mpmath", "__init__.py"),
        ("flint", "__init__.py"),
        ("yaml", "__init__.py"),
        ("symengine", "__init__.py"),
        ("gmpy2", "__init__.py"),
    ):
        found = find_spec(package)
        if found is None or not found.origin:
            continue
        path = os.path.join(os.path.dirname(found.origin), file)  # noqa: PTH118, PTH120
        with open(path, "rb") as text:  # noqa: PTH123
            yield [path, sha256(text.read()).hexdigest()]
