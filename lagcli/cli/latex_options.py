"""The words of `--latex`: labels, environments, and shapes of letters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import click

from lagcli.formatters.options import LatexOptions
from lagcli.notation.greek import VARIANTS
from lagcli.reader.suggest import did_you_mean

_KNOWN = ("labels", "align", "equation", *VARIANTS)
_USUAL_PREFIX = "eq"
_PREFIX = re.compile(r"[A-Za-z0-9:._-]+")


def demand_options(given: Sequence[str], form: str) -> None:
    """Read the words, to have their mistakes.

    Raises
    ------
    click.UsageError
        Where a word is unknown, or nothing is set in LaTeX.
    """
    if form not in ("latex", "pdf"):
        raise click.UsageError(f"--latex needs --format latex or pdf, not {form}")
    for word, prefix in _words(given):
        if word not in _KNOWN:
            advice = did_you_mean(word, _KNOWN) or f"there are {', '.join(_KNOWN)}"
            raise click.UsageError(f"--latex: unknown word '{word}': {advice}")
        if prefix and (word != "labels" or not _PREFIX.fullmatch(prefix)):
            message = "labels=PREFIX takes letters, digits and the signs : . _ -"
            raise click.UsageError(f"--latex {word}={prefix}: {message}")


def latex_options(given: Sequence[str]) -> LatexOptions:
    """The options that the words make."""
    words = dict(_words(given))
    return LatexOptions(
        labels=(words["labels"] or _USUAL_PREFIX) if "labels" in words else "",
        separate="equation" in words,
        variants=tuple(word for word in words if word in VARIANTS),
    )


def _words(given: Sequence[str]) -> Iterator[tuple[str, str]]:
    for text in given:
        for piece in text.split(","):
            word, _, prefix = piece.strip().partition("=")
            yield word, prefix
