"""What the shell may complete: names, known without reading or deriving anything."""

from __future__ import annotations

from collections.abc import Iterable

#: The forms of a table of `simulate`, and those of them that are no text.
TABLES = ("table", "json", "csv", "npz", "parquet")
BINARY = ("npz", "parquet")
#: The forms of a study of `tradeoff`, and what it weighs.
STUDIES = ("text", "json", "csv")
COSTS = ("total", "integration", "evaluations")
#: The forms of a report of `check`.
REPORTS = ("text", "json", "junit", "github", "sarif")
#: What `lagcli export --to` writes.
LANGUAGES = ("python", "c", "julia", "fortran", "matlab", "modelica", "sympy", "mathematica")
#: What `lagcli schema` describes.
SCHEMAS = ("problem", "answers")
#: The formats of a page of the manual.
MANUAL_FORMATS = ("text", "markdown", "html", "man")

#: What `plot` draws, and the endings of the files it writes.
KINDS = ("series", "phase", "path", "potential", "poincare", "drift", "error")
PICTURES = ("svg", "pdf", "png")
ANIMATIONS = ("html", "gif", "mp4")

#: What `simulate --show` knows besides the names of the file.
COLUMNS = (
    "coordinates", "velocities", "accelerations", "multipliers", "constraint_forces", "momenta",
    "charges", "energy",
)  # fmt: skip


def sections() -> Iterable[str]:
    """The sections of `solve`."""
    from lagcli.statements.registry import section_names

    return section_names()


def formats() -> Iterable[str]:
    """The formats of answers."""
    from lagcli.formatters.registry import built_in

    return (*built_in(), "pdf")


def page_formats() -> Iterable[str]:
    """The formats of explanations."""
    from lagcli.formatters.explaining import FORMATS

    return (*FORMATS, "pdf")


def methods() -> Iterable[str]:
    """The methods of integration, first `auto`."""
    from lagcli.problem_data import METHODS

    return METHODS


def topics() -> Iterable[str]:
    """The topics of the manual."""
    from lagcli.manual import pages

    return dict.fromkeys(name for page in pages() for name in (page.name, *page.topics))


def templates() -> Iterable[str]:
    """The templates of `new`."""
    from lagcli.templates import TEMPLATES

    return TEMPLATES


def problems() -> Iterable[str]:
    """The problems of the library, with and without their folders."""
    from lagcli.library import entries

    return sorted({name for e in entries() for name in (e.name.rpartition("/")[2], e.name)})
