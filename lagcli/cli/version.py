"""`lagcli version`."""

from __future__ import annotations

import sys

from lagcli import __version__


def version() -> None:
    """Print the version.

    Example: lagcli version
    """
    sys.stdout.write(f"lagcli {__version__}\n")
