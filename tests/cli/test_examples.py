"""The examples of every `--help` and of the manual, run in an empty folder."""

from __future__ import annotations

import re
import shlex

import pytest

from lagcli.cli.app import COMMANDS
from lagcli.cli.run import run
from lagcli.manual import pages

SH = re.MULTILINE | re.DOTALL

#: Needs a scheduler that answers, a browser, a folder of problems, or minutes.
NOT_HERE = ("--scheduler", "--open", "check problems/", "--orbits 40", "--plot kepler.svg",
            "extremes problems/", "tests/benchmarks/", "snakeboard")  # fmt: skip


def examples():
    from lagcli.cli.app import load_command

    texts = [load_command(name).help or "" for name in COMMANDS]
    texts += re.findall(r"^```sh\n(.*?)^```$", "".join(page.text for page in pages()), SH)
    found = [line for text in texts for line in re.findall(r"^\s*lagcli (.*)$", text, re.MULTILINE)]
    yield from dict.fromkeys(x for x in found if not any(word in x for word in NOT_HERE))


@pytest.mark.long
@pytest.mark.parametrize("example", [*examples()])
def test_an_example_works_in_an_empty_folder(example, tmp_path, monkeypatch, capsysbinary):
    monkeypatch.chdir(tmp_path)
    words = shlex.split(example.partition(" > ")[0], comments=True)
    assert run(words) == 0, capsysbinary.readouterr().err.decode()
    if "-o" in words:
        assert (tmp_path / words[words.index("-o") + 1]).stat().st_size
