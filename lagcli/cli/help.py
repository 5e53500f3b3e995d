"""`lagcli help`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

from lagcli.cli.choices import MANUAL_FORMATS, topics
from lagcli.cli.options import Output, argument, flag, option

if TYPE_CHECKING:
    from lagcli.manual import Page

Topic = Annotated[str | None, argument("[TOPIC]", "A topic.", topics)]
_FORMATS = "text, markdown, html, or man for a man page of every command."
_USUAL = "  [default: text on a terminal, else markdown]"
Format = Annotated[str | None, option("--format -f", "NAME", _FORMATS + _USUAL, MANUAL_FORMATS)]
Open = Annotated[bool, flag("--open", "Show the page in a web browser.")]


def help(  # noqa: A001 - the command's name
    topic: Topic = None, format_name: Format = None, output: Output = None, open_page: Open = False
) -> int:
    """Read the manual, or its page on a topic.

    A topic is a command, a section, a key of the problem format, or the name of a page.

    \b
    Examples:
      lagcli help
      lagcli help problem-format
      lagcli help steady_motions --open
      lagcli help simulate -o simulate.html
      lagcli help -o lagcli.1
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.choices import MANUAL_FORMATS
    from lagcli.cli.endings import MANUAL, format_of
    from lagcli.cli.error_output import report_line
    from lagcli.cli.manual_page import open_in_browser
    from lagcli.cli.motion_commands import is_known
    from lagcli.cli.output import has_place, place
    from lagcli.cli.status import Status
    from lagcli.manual import find_page

    page = None if topic is None else find_page(topic)
    if topic is not None and page is None:
        report_line(_unknown(topic))
        return Status.USAGE
    if format_name is not None and not is_known("--format", format_name, MANUAL_FORMATS):
        return Status.USAGE
    if open_page:
        return open_in_browser(page)
    if not has_place(output):
        return Status.USAGE
    terminal = output is None and sys.stdout.isatty()
    chosen = format_of(format_name, output, MANUAL, "text" if terminal else "markdown")
    done = place(_shown(page, chosen).encode(), output)
    return Status.WELL if done else Status.USAGE


def _shown(page: Page | None, format_name: str) -> str:
    from lagcli.cli.manual_page import contents, rendered

    if format_name == "man":
        from lagcli.cli.man_page import man_page

        return man_page()
    return rendered(contents() if page is None else page.text, format_name, _title(page))


def _title(page: Page | None) -> str:
    return "lagcli: the manual" if page is None else f"lagcli: {page.title}"


def _unknown(topic: str) -> str:
    from lagcli.manual import pages
    from lagcli.reader.suggest import did_you_mean

    known = [name for page in pages() for name in (page.name, *page.topics)]
    hint = did_you_mean(topic.lower(), known) or "lagcli help lists the topics"
    return f"error: the manual has no topic {topic!r}: {hint}"
