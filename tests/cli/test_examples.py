"""The examples of every `--help` and of the manual run, and every option has one."""

from __future__ import annotations

import re
import shlex
import webbrowser

import pytest

from lagcli.cli import watching
from lagcli.cli.app import COMMANDS, load_command
from lagcli.cli.run import run
from lagcli.manual import pages

SH = re.MULTILINE | re.DOTALL

#: Needs a folder of problems, or minutes.
NOT_HERE = ("check problems/", "--orbits 40", "--plot kepler.svg",
            "extremes problems/", "tests/benchmarks/", "snakeboard")  # fmt: skip
#: A cluster that a reader has; the test has one of its own.
CLUSTER = "tcp://host:8786"


def shell():
    """What stands in blocks of the shell in the manual."""
    return re.findall(r"^```sh\n(.*?)^```$", "".join(page.text for page in pages()), SH)


def examples():
    texts = [load_command(name).help or "" for name in COMMANDS] + shell()
    found = [line for text in texts for line in re.findall(r"^\s*lagcli (.*)$", text, re.MULTILINE)]
    yield from dict.fromkeys(x for x in found if not any(word in x for word in NOT_HERE))


def test_every_option_of_every_command_has_an_example_in_the_manual():
    text = "".join(page.text for page in pages())
    used = {}
    for line in re.findall(r"^(?:\$ )?lagcli (.*)$", text, re.MULTILINE):
        command, *words = shlex.split(line, comments=True)
        used.setdefault(command, set()).update(words)
    missing = [
        (command, option.opts[0])
        for command in COMMANDS
        for option in load_command(command).params
        if option.opts[0].startswith("-") and not used.get(command, set()) & {*option.opts}
    ]
    assert missing == []


@pytest.fixture
def scheduler():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


@pytest.mark.long
@pytest.mark.parametrize("example", [*examples()])
def test_an_example_works_in_an_empty_folder(example, tmp_path, monkeypatch, capsysbinary, request):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LAGCLI_CACHE_DIR", str(tmp_path / "cache"))
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda page: opened.append(page) or True)

    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(watching, "sleep", interrupted)
    words = shlex.split(example.partition(" > ")[0], comments=True)
    if CLUSTER in words:
        words[words.index(CLUSTER)] = request.getfixturevalue("scheduler")
    status = run(words)
    assert status == (130 if "--watch" in words else 0), capsysbinary.readouterr().err.decode()
    assert bool(opened) == ("--open" in words)
    if "-o" in words:
        assert (tmp_path / words[words.index("-o") + 1]).stat().st_size
