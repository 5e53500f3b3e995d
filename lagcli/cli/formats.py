"""`lagcli formats`."""

from __future__ import annotations

import sys

_PDF = "PDF of that LaTeX, where LaTeX is installed."


def formats() -> None:
    """List the formats that solve knows.

    Example: lagcli formats
    """
    from lagcli.formatters.registry import ListedFormatter, list_formatters

    listed = (*list_formatters(), ListedFormatter("pdf", "lagcli", _PDF))
    width = max(len(entry.name) for entry in listed)
    for entry in listed:
        origin = "" if entry.distribution == "lagcli" else f" (from {entry.distribution})"
        text = f"not usable: {entry.problem}" if entry.problem else entry.description
        sys.stdout.write(f"{entry.name:{width}}  {text}{origin}".rstrip() + "\n")
