"""What the shell may complete: names, known without reading or deriving anything."""

from __future__ import annotations

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
_SHOWN = (
    "coordinates", "velocities", "accelerations", "multipliers", "constraint_forces", "momenta",
    "charges", "energy",
)  # fmt: skip


def complete_section(incomplete: str) -> list[str]:
    """The sections that the last word of `a,b,c` may become."""
    from lagcli.statements.registry import section_names

    before, comma, word = incomplete.rpartition(",")
    return [before + comma + name for name in section_names() if name.startswith(word)]


def complete_format(incomplete: str) -> list[str]:
    """The formats that begin so."""
    from lagcli.formatters.registry import built_in

    return [name for name in (*built_in(), "pdf") if name.startswith(incomplete)]


def complete_report(incomplete: str) -> list[str]:
    """The forms of a check's report that begin so."""
    return [name for name in REPORTS if name.startswith(incomplete)]


def complete_table(incomplete: str) -> list[str]:
    """The forms of a table that begin so."""
    return [name for name in TABLES if name.startswith(incomplete)]


def complete_method(incomplete: str) -> list[str]:
    """The methods that begin so."""
    from lagcli.problem_data import METHODS

    return [name for name in METHODS if name.startswith(incomplete)]


def complete_kind(incomplete: str) -> list[str]:
    """The kinds of pictures that begin so."""
    return [name for name in KINDS if name.startswith(incomplete)]


def complete_column(incomplete: str) -> list[str]:
    """The groups of columns that the last word of `a,b,c` may become."""
    before, comma, word = incomplete.rpartition(",")
    return [before + comma + name for name in _SHOWN if name.startswith(word)]


def complete_page_format(incomplete: str) -> list[str]:
    """The formats of an explanation that begin so."""
    from lagcli.formatters.explaining import FORMATS

    return [name for name in (*FORMATS, "pdf") if name.startswith(incomplete)]


def complete_study(incomplete: str) -> list[str]:
    """The forms of a study that begin so."""
    return [name for name in STUDIES if name.startswith(incomplete)]


def complete_cost(incomplete: str) -> list[str]:
    """What a study may weigh that begins so."""
    return [name for name in COSTS if name.startswith(incomplete)]


def complete_methods(incomplete: str) -> list[str]:
    """The methods that the last word of `a,b,c` may become."""
    from lagcli.problem_data import METHODS

    before, comma, word = incomplete.rpartition(",")
    return [before + comma + name for name in METHODS[1:] if name.startswith(word)]


def complete_topic(incomplete: str) -> list[str]:
    """The topics of the manual that begin so."""
    from lagcli.manual import pages

    known = dict.fromkeys(name for page in pages() for name in (page.name, *page.topics))
    return [name for name in known if name.startswith(incomplete)]


def complete_manual_format(incomplete: str) -> list[str]:
    """The formats of a page of the manual that begin so."""
    return [name for name in MANUAL_FORMATS if name.startswith(incomplete)]


def complete_problem(incomplete: str) -> list[str]:
    """The problems of the library whose name, with or without its folder, begins so."""
    from lagcli.library import entries

    names = [name for entry in entries() for name in (entry.name.rpartition("/")[2], entry.name)]
    return sorted({name for name in names if name.startswith(incomplete)})


def complete_template(incomplete: str) -> list[str]:
    """The templates of `lagcli new` that begin so."""
    from lagcli.templates import TEMPLATES

    return [name for name in TEMPLATES if name.startswith(incomplete)]


def complete_schema(incomplete: str) -> list[str]:
    """The schemas whose name begins so."""
    return [name for name in SCHEMAS if name.startswith(incomplete)]


def complete_language(incomplete: str) -> list[str]:
    """The languages that begin so."""
    return [name for name in LANGUAGES if name.startswith(incomplete)]
