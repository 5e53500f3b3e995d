"""What is declared by being a module of a folder: found by its name, with nothing imported."""

from __future__ import annotations

import re
from os import scandir
from pathlib import Path

_PARTS = re.compile(r"(\D*)(\d*)")


def modules_in(folder: Path) -> list[str]:
    """The names of the public modules of a folder, in the order of their letters and numbers."""
    names = (entry.name for entry in scandir(folder) if entry.name.endswith(".py"))
    public = (name.removesuffix(".py") for name in names if name[0] not in "._")
    return sorted(public, key=_order)


def _order(name: str) -> tuple[str, int, str]:
    letters, number = _PARTS.match(name).groups()  # type: ignore[union-attr]
    return letters, int(number or 0), name
