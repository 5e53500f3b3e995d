"""`lagcli help`: the manual in a terminal, in a pipe, as HTML."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from rich.cells import cell_len

from lagcli.cli.manual_page import rendered
from lagcli.cli.run import run
from lagcli.manual import pages


def test_without_a_topic_it_lists_every_page(capsysbinary):
    assert run(["help"]) == 0
    shown = capsysbinary.readouterr().out.decode()
    assert [page.name for page in pages() if f"`{page.name}`" not in shown] == []


@pytest.mark.parametrize("topic", ["simulate", "steady_motions", "steady-motions", "T", "EXPECT"])
def test_a_topic_may_be_a_command_a_section_or_a_key(topic, capsysbinary):
    assert run(["help", topic]) == 0
    assert capsysbinary.readouterr().out.startswith(b"# ")


def test_an_unknown_topic_is_answered_with_a_near_one(capsysbinary):
    assert run(["help", "modse"]) == 2
    assert b"did you mean 'modes'?" in capsysbinary.readouterr().err


def test_the_format_must_be_known(capsysbinary):
    assert run(["help", "units", "-f", "pdf"]) == 2
    assert b"text, markdown, html" in capsysbinary.readouterr().err


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_a_terminal_of_80_columns_shows_every_page(page, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    shown = rendered(page.text, "text", page.title)
    assert max(map(cell_len, shown.splitlines())) <= 80


class _Tags(HTMLParser):
    """The elements that are open; every closing tag must meet its own."""

    def __init__(self):
        super().__init__()
        self.open, self.links = [], []

    def handle_starttag(self, tag, attributes):
        self.links += [value for name, value in attributes if name in ("href", "src")]
        if tag not in ("meta", "br", "hr", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_a_page_of_html_is_whole_and_its_links_are_pages(page):
    tags = _Tags()
    tags.feed(rendered(page.text, "html", page.title))
    assert tags.open == []
    names = {f"{each.name}.html" for each in pages()}
    local = [re.sub("#.*", "", link) for link in tags.links if not link.startswith("https:")]
    files = {link for link in local if link.startswith("file:")}
    assert set(local) - files <= names
    assert all(Path(unquote(urlsplit(link).path)).is_file() for link in files)
