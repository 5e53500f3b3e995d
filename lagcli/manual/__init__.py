"""The manual: Markdown pages that travel with the package, found by their topics.

A page begins with its title, an empty line, and a line such as

    `reduction` `steady_motions`: cyclic coordinates removed, and what is left

with the topics it covers and its summary.  `lagcli help TOPIC` shows it.
"""

from __future__ import annotations

import re
from pathlib import Path

from lagcli.record import record

_HEAD = re.compile(r"# (?P<title>.+)\n\n(?P<topics>(?:`[^`]+` ?)+): (?P<summary>.+)\n")

#: The pages in reading order.
ORDER = (
    "tour", "problem-format", "solve", "explain", "simulate", "plot", "animate", "sweep",
    "tradeoff", "extremes", "check", "export", "pages", "symmetries", "find", "forces",
    "equilibria", "reduction", "phase-space", "units", "python",
    "conventions", "extending", "architecture", "glossary",
)  # fmt: skip


#: What is around a page that is shown as HTML.
HTML_PAGE = Path(__file__).with_name("page.html")
#: Where the notebooks of the page `python` are.
NOTEBOOKS = Path(__file__).resolve().parent / "notebooks"


@record
class Page:
    """One page of the manual.

    Attributes
    ----------
    name : str
        The name of its file.
    title, summary : str
        The heading, and what the page is about in one line.
    topics : tuple of str
        The words under which `lagcli help` finds it, besides its name.
    text : str
        The whole page in Markdown.
    """

    name: str
    title: str
    summary: str
    topics: tuple[str, ...]
    text: str


def pages() -> tuple[Page, ...]:
    """Every page, in reading order; pages that `ORDER` does not name come last."""
    folder = Path(__file__).parent
    names = {path.stem for path in folder.glob("*.md")}
    listed = [name for name in ORDER if name in names]
    return tuple(_page(folder / f"{name}.md") for name in (*listed, *sorted(names - set(ORDER))))


def find_page(topic: str) -> Page | None:
    """The page of a topic, a section, a command or a page's name; None where no page has it."""
    wanted = topic.casefold().replace("_", "-")
    every = pages()
    for page in every:
        if page.name == wanted:
            return page
    for page in every:
        if wanted in (each.casefold().replace("_", "-") for each in page.topics):
            return page
    return None


def _page(path: Path) -> Page:
    text = path.read_text("utf-8")
    head = _HEAD.match(text)
    assert head is not None, f"{path.name} has no line of topics"
    topics = tuple(re.findall(r"`([^`]+)`", head["topics"]))
    return Page(path.stem, head["title"], head["summary"], topics, text)
