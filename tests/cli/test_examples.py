"""The examples of every `--help`, run in an empty folder."""

from __future__ import annotations

import re
import shlex

import pytest

from lagcli.cli.app import COMMANDS
from lagcli.cli.run import run

#: Needs a scheduler that answers, a browser, or a folder of problems.
NOT_HERE = ("--scheduler", "--open", "check problems/")


def examples():
    from lagcli.cli.app import load_command

    for name in COMMANDS:
        for line in re.findall(r"^\s*lagcli (.*)$", load_command(name).help or "", re.MULTILINE):
            if not any(word in f"{line}" for word in NOT_HERE):
                yield line


@pytest.mark.long
@pytest.mark.parametrize("example", [*examples()])
def test_an_example_works_in_an_empty_folder(example, tmp_path, monkeypatch, capsysbinary):
    monkeypatch.chdir(tmp_path)
    words = shlex.split(example.partition(" > ")[0])
    assert run(words) == 0, capsysbinary.readouterr().err.decode()
    if "-o" in words:
        assert (tmp_path / words[words.index("-o") + 1]).stat().st_size
