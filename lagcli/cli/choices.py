"""What the shell may complete: names, known without reading or deriving anything."""

from __future__ import annotations

from collections.abc import Callable, Iterable

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


def completion(
    names: Callable[[], Iterable[str]], *, listed: bool = False
) -> Callable[[str], list[str]]:
    """What the shell asks: the names that begin so; `listed`: the last word of `a,b,c`."""

    def complete(incomplete: str) -> list[str]:
        before, comma, word = incomplete.rpartition(",") if listed else ("", "", incomplete)
        return [before + comma + name for name in names() if name.startswith(word)]

    return complete


def _sections() -> Iterable[str]:
    from lagcli.statements.registry import section_names

    return section_names()


def _formats() -> Iterable[str]:
    from lagcli.formatters.registry import built_in

    return (*built_in(), "pdf")


def _page_formats() -> Iterable[str]:
    from lagcli.formatters.explaining import FORMATS

    return (*FORMATS, "pdf")


def _methods() -> tuple[str, ...]:
    from lagcli.problem_data import METHODS

    return METHODS


def _topics() -> Iterable[str]:
    from lagcli.manual import pages

    return dict.fromkeys(name for page in pages() for name in (page.name, *page.topics))


def _templates() -> Iterable[str]:
    from lagcli.templates import TEMPLATES

    return TEMPLATES


def _problems() -> Iterable[str]:
    """The problems of the library, with and without their folders."""
    from lagcli.library import entries

    names = [name for entry in entries() for name in (entry.name.rpartition("/")[2], entry.name)]
    return sorted(set(names))


complete_section = completion(_sections, listed=True)
complete_column = completion(lambda: _SHOWN, listed=True)
complete_methods = completion(lambda: _methods()[1:], listed=True)
complete_method = completion(_methods)
complete_format = completion(_formats)
complete_page_format = completion(_page_formats)
complete_manual_format = completion(lambda: MANUAL_FORMATS)
complete_table = completion(lambda: TABLES)
complete_report = completion(lambda: REPORTS)
complete_study = completion(lambda: STUDIES)
complete_cost = completion(lambda: COSTS)
complete_kind = completion(lambda: KINDS)
complete_topic = completion(_topics)
complete_problem = completion(_problems)
complete_template = completion(_templates)
complete_schema = completion(lambda: SCHEMAS)
complete_language = completion(lambda: LANGUAGES)
