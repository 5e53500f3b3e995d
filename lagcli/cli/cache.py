"""`lagcli cache`."""

from __future__ import annotations

import os
import sys
from typing import Annotated

from lagcli.cli.options import flag

Clear = Annotated[bool, flag("--clear", "Remove every answer that is kept.")]


def cache(clear: Clear = False) -> None:
    """Show where earlier answers are kept, or remove them.

    `lagcli solve` and `lagcli explain` print the answer of an earlier run again where the
    files, the options and the program are the same.  `LAGCLI_CACHE_DIR` names another
    folder; with `LAGCLI_NO_CACHE=1` nothing is looked up or kept.

    Example: lagcli cache --clear
    """
    from lagcli.platform.cache import Cache, folder

    place = folder(os.environ)
    if place is None:
        sys.stdout.write("no cache: there is no home directory\n")
        return
    if clear:
        Cache(place).clear()
    count, size = Cache(place).size()
    answers = "1 answer" if count == 1 else f"{count} answers"
    sys.stdout.write(f"{place}: {answers}, {size / 2**20:.1f} MiB\n")
