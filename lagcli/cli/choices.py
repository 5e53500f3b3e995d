"""What the shell may complete: names, known without reading or deriving anything."""

from __future__ import annotations


def complete_section(incomplete: str) -> list[str]:
    """The sections that the last word of `a,b,c` may become."""
    from lagcli.answers import SECTIONS

    before, comma, word = incomplete.rpartition(",")
    return [before + comma + name for name in SECTIONS if name.startswith(word)]


def complete_format(incomplete: str) -> list[str]:
    """The formats that begin so."""
    from lagcli.formatters.registry import BUILT_IN

    return [name for name in BUILT_IN if name.startswith(incomplete)]


def complete_report(incomplete: str) -> list[str]:
    """The forms of a check's report that begin so."""
    return [name for name in ("text", "json", "junit", "github") if name.startswith(incomplete)]
