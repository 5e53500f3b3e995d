"""`lagcli formats`."""

from __future__ import annotations

import sys


def formats() -> None:
    """List the formats that `solve --format` knows, with those of other packages.

    Example: lagcli formats
    """
    from lagcli.formatters.registry import list_formatters

    listed = list_formatters()
    width = max(len(entry.name) for entry in listed)
    for entry in listed:
        origin = "" if entry.distribution == "lagcli" else f" (from {entry.distribution})"
        told = f"not usable: {entry.problem}" if entry.problem else entry.description
        sys.stdout.write(f"{entry.name:{width}}  {told}{origin}".rstrip() + "\n")
