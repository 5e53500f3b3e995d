"""First files of students, with their mistakes: each hint has the text that would be right.

`first_files.txt` has the files one after another, each with the place and the hint of all its
mistakes. Hints were judged by hand: they name what the author should have written.
"""

import re
from pathlib import Path

import pytest

from lagcli.reader import read_problem

_GIVEN = Path(__file__).with_name("first_files.txt").read_text("utf-8")
_ONE = re.compile(r"^=== (\w+)\n(.*?)^--- expected\n(.*?)(?=^=== |\Z)", re.DOTALL | re.MULTILINE)
FILES = _ONE.findall(_GIVEN)


@pytest.mark.parametrize(("name", "written", "expected"), FILES, ids=[name for name, *_ in FILES])
def test_a_first_file_is_told_what_would_be_right(name, written, expected):
    found = read_problem(f"{name}.yaml", written.encode()).diagnostics
    shown = [f"{each.span.line}:{each.span.column} {each.hint}" for each in found]
    assert shown == expected.splitlines()


def test_no_file_was_lost():
    assert len(FILES) == _GIVEN.count("--- expected\n") >= 70
