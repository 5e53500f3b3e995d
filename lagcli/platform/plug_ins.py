"""What other packages bring: their entry points of a group."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint


def entry_points(*, group: str) -> Iterable[EntryPoint]:
    """The entry points of a group; the scanner costs half of typer to import."""
    from importlib.metadata import entry_points as installed

    return installed(group=group)


def plug_ins(group: str) -> list[EntryPoint]:
    """Those of a group that are not lagcli's own, by name and then by package."""
    every = entry_points(group=group)  # of lagcli itself, too, where an older one is installed
    points = [point for point in every if not point.dist or point.dist.name != "lagcli"]
    return sorted(points, key=lambda point: (point.name, point.dist.name if point.dist else ""))
