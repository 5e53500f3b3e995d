"""Reports of a check as text: each form is a function from the reports to text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from lagcli.studies.check.findings import Report
from lagcli.studies.check.reports import github, json, junit, sarif, text

#: Form -> what makes it; the pieces come as soon as what they tell of is known.
FORMS: dict[str, Callable[[Iterable[Report]], Iterator[str]]] = {
    "text": text.render,
    "json": json.render,
    "junit": junit.render,
    "github": github.render,
    "sarif": sarif.render,
}

__all__ = ["FORMS"]
