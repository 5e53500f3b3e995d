"""Pages of the manual on a terminal, as Markdown, or as HTML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.cli.status import Status

if TYPE_CHECKING:
    from lagcli.manual import Page


def contents() -> str:
    """The list of pages, in Markdown."""
    from lagcli.manual import pages

    lines = ["# The manual of lagcli", ""]
    lines += [f"- `{page.name}`: {page.summary}" for page in pages()]
    lines += ["", "`lagcli help TOPIC` shows a page. Sections and commands are topics as well.", ""]
    return "\n".join(lines)


def rendered(text: str, format_name: str, title: str) -> str:
    """A page of Markdown in one of the formats `text`, `markdown` and `html`."""
    match format_name:
        case "html":
            return _html(text, title)
        case "text":
            return _for_terminal(text)
    return text


def open_in_browser(page: Page | None) -> int:
    """Write the whole manual beside its contents and show one page of it in a browser."""
    import tempfile
    import webbrowser
    from pathlib import Path

    from lagcli.cli.error_output import report_line
    from lagcli.manual import pages

    folder = Path(tempfile.mkdtemp(prefix="lagcli-manual-"))
    for each in pages():
        path = folder / f"{each.name}.html"
        path.write_text(rendered(each.text, "html", each.title), "utf-8")
    index = "".join(f"- [{each.title}]({each.name}.md): {each.summary}\n" for each in pages())
    text = f"# The manual of lagcli\n\n{index}"
    (folder / "index.html").write_text(rendered(text, "html", "lagcli"), "utf-8")
    shown = folder / ("index.html" if page is None else f"{page.name}.html")
    if not webbrowser.open(shown.as_uri()):
        report_line(f"no web browser was found; the page is {shown}")
        return Status.NOT_FOUND
    return Status.WELL


def _html(text: str, title: str) -> str:
    """Markdown as a page of HTML; links lead to other such pages, or into the package."""
    import re
    from string import Template

    from markdown_it import MarkdownIt

    from lagcli.manual import HTML_PAGE, NOTEBOOKS

    text = text.replace("](notebooks/", f"]({NOTEBOOKS.as_uri()}/")
    linked = re.sub(r"\]\((?!https?:)([\w-]+)\.md(#[\w-]*)?\)", r"](\1.html\2)", text)
    body = MarkdownIt("commonmark", {"html": False}).enable("table").render(linked)
    return Template(HTML_PAGE.read_text("utf-8")).substitute(title=title, body=body)


def _for_terminal(text: str) -> str:
    """Markdown as text with the terminal's colours and width."""
    from io import StringIO

    from rich.console import Console
    from rich.markdown import Markdown

    terminal = Console()
    page = StringIO()
    console = Console(
        file=page,
        force_terminal=terminal.is_terminal,
        width=min(terminal.width, 100),
        no_color=terminal.no_color,
    )
    console.print(Markdown(text, code_theme="ansi_dark", hyperlinks=False))
    return page.getvalue()
