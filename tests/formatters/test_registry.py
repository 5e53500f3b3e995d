"""Formatters are found by name, and a plug-in can neither break nor replace anything."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import EntryPoint

import pytest

from lagcli.formatters import registry
from lagcli.formatters.registry import (
    UnknownFormatter,
    built_in,
    find_formatter,
    list_formatters,
)
from lagcli.platform import plug_ins


def install(monkeypatch, **points):
    found = [EntryPoint(name, value, registry.GROUP) for name, value in points.items()]
    monkeypatch.setattr(plug_ins, "entry_points", lambda **_: found)


@pytest.mark.parametrize("name", built_in())
def test_built_in_formatters_are_found_without_a_scan(name, monkeypatch):
    monkeypatch.setattr(plug_ins, "entry_points", lambda **_: pytest.fail("scanned"))
    assert callable(find_formatter(name))


def test_only_the_module_asked_for_is_imported():
    code = (
        "import sys; from lagcli.formatters.registry import find_formatter; "
        "find_formatter('json'); print([m for m in sys.modules if m in "
        "('lagcli.formatters.built_in.text', 'sympy', 'numpy', 'rich')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_an_unknown_name_gets_a_suggestion():
    found = find_formatter("latx")
    assert isinstance(found, UnknownFormatter)
    assert "did you mean 'latex'?" in found.message


def test_a_name_like_no_other_gets_the_list(monkeypatch):
    install(monkeypatch)
    assert "html, json, latex, markdown, text" in find_formatter("zzzzz").message


def test_a_plug_in_is_found_and_listed(monkeypatch):
    install(monkeypatch, mine="lagcli.formatters.built_in.text:render")
    assert callable(find_formatter("mine"))
    assert list_formatters()[-1].description == find_formatter("text").__doc__.strip()


def test_a_broken_plug_in_is_reported(monkeypatch):
    install(monkeypatch, broken="no_such_module:render", wrong="lagcli:__version__")
    assert "does not load" in find_formatter("broken").message
    problems = {each.name: each.problem for each in list_formatters()}
    assert "no_such_module" in problems["broken"]
    assert "not a function" in problems["wrong"]
    assert problems["text"] is None


def test_a_built_in_name_cannot_be_taken(monkeypatch):
    install(monkeypatch, text="evil:render")
    assert find_formatter("text").__module__ == "lagcli.formatters.built_in.text"
    assert list_formatters()[-1].problem == "the name 'text' is taken"


def test_the_list_says_what_each_formatter_says_of_itself():
    for each in list_formatters():
        assert each.description
        assert each.description == find_formatter(each.name).__doc__.partition("\n")[0]
