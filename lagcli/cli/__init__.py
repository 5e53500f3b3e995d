"""The command line: arguments in, exit status out."""

from __future__ import annotations

from lagcli.cli.run import main

__all__ = ["main"]
