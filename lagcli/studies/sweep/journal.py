"""What is done of a sweep, on disk: a run that was killed is taken up where it ended.

The first line names the sweep by a digest of all that determines it; each further line holds
the rows of one chunk.  A line that was cut off is not there.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from types import TracebackType
from typing import Self

Rows = list[list[float | None]]


class Journal:
    """The file beside the output, `out.csv.partial`.

    Parameters
    ----------
    path
        Of the output; None keeps nothing.
    digest
        Names the sweep; what another one left is overwritten.
    """

    def __init__(self, path: Path | None, digest: str) -> None:
        self.path = None if path is None else path.with_name(f"{path.name}.partial")
        self.done: dict[int, Rows] = {}
        self._file = None
        if self.path is None:
            return
        whole = self._read(digest)
        self._file = self.path.open("r+b" if whole else "wb")
        self._file.truncate(whole)
        self._file.seek(whole)
        if not whole:
            self._write({"sweep": digest})

    def _read(self, digest: str) -> int:
        """Read what is whole; its length in bytes, 0 where it is of another sweep."""
        assert self.path is not None
        try:
            data = self.path.read_bytes()
        except OSError:
            return 0
        length = 0
        for place, line in enumerate(data.split(b"\n")[:-1]):
            try:
                entry = json.loads(line)
            except ValueError:
                break
            if place == 0 and entry != {"sweep": digest}:
                return 0
            if place > 0:
                self.done[entry["chunk"]] = entry["rows"]
            length += len(line) + 1
        return length

    def keep(self, chunk: int, rows: Rows) -> None:
        """Note the rows of a chunk; they are on the disk when this returns."""
        self.done[chunk] = rows
        if self._file is not None:
            self._write({"chunk": chunk, "rows": rows})

    def _write(self, entry: dict[str, object]) -> None:
        assert self._file is not None
        self._file.write(json.dumps(entry).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def remove(self) -> None:
        """The sweep is finished and written."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file is not None:
            self._file.close()
