"""The format of an output file, by its ending unless `--format` names it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import click

#: Ending -> format, of pages and of tables.
PAGES = {
    ".txt": "text", ".json": "json", ".tex": "latex", ".md": "markdown", ".html": "html",
    ".htm": "html", ".pdf": "pdf",
}  # fmt: skip
TABLES = {
    ".txt": "table", ".json": "json", ".csv": "csv", ".npz": "npz", ".parquet": "parquet",
}  # fmt: skip
PICTURES = {".svg": "svg", ".pdf": "pdf", ".png": "png"}
STUDIES = {".txt": "text", ".json": "json", ".csv": "csv"}
MANUAL = {".txt": "text", ".md": "markdown", ".html": "html", ".htm": "html", ".1": "man"}
JSON = {".json": "json"}


def format_of(
    given: str | None,
    output: Path | None,
    endings: Mapping[str, str],
    usual: str,
    option: str = "--format",
) -> str:
    """The format that `--format` or else the ending of `-o` asks for.

    Parameters
    ----------
    given
        The value of `--format`, if any.
    output
        The file of `-o`, if any.
    endings
        The endings that name a format.
    usual
        The format where neither says anything.
    option
        The name of `--format`.

    Raises
    ------
    click.UsageError
        Where the two disagree, or where no format has the ending.
    """
    ending = output.suffix.lower() if output else ""
    by_ending = endings.get(ending)
    if given is None and ending and by_ending is None:
        message = f"-o {output}: '{ending}' is not one of {', '.join(endings)}"
        raise click.UsageError(message)
    if given is None:
        return by_ending or usual
    if by_ending is not None and given != by_ending and given in endings.values():
        message = f"-o {output} requires {by_ending}, but {option} {given}: change one of them"
        raise click.UsageError(message)
    return given
