"""Each example of a command in the manual runs, and each option of each command has one."""

from __future__ import annotations

import re
import shlex
import webbrowser
from pathlib import Path

import pytest

from lagcli.cli import watching
from lagcli.cli.app import COMMANDS, load_command
from lagcli.cli.run import run
from tests.test_manual import PAGES, ROOT, blocks

#: A cluster that the reader has; the test has one of its own.
CLUSTER = "tcp://host:8786"
#: Takes longer than a test of `make check` may.
SLOW = {
    "export",
    "solve",
    "simulate",
    "plot",
    "animate",
    "sweep",
    "check",
    "tradeoff",
    "extremes",
    "explain",
}


#: What takes 10 to 100 seconds, and is run in tests of its own with less to do.
LONG = {
    "lagcli check problems/rigid",
    "lagcli extremes problems/pendulums/plane-pendulum.yaml",
    "lagcli tradeoff problems/central/kepler.yaml --plot kepler.svg",
}


def words_of(line):
    return shlex.split(line, comments=True)[1:]


def examples():
    """The lines that begin with `lagcli` in blocks of the shell."""
    lines = (line for page in PAGES for body in blocks("sh", page) for line in body.splitlines())
    return list(dict.fromkeys(line for line in lines if line.startswith("lagcli ")))


def shown():
    """Those with their answers, which `test_manual` runs."""
    answered = "".join(body for page in PAGES for body in blocks("console", page))
    return re.findall(r"^\$ (lagcli .*)$", answered, re.MULTILINE)


def test_every_option_of_every_command_has_an_example():
    used = {}
    for command, *words in map(words_of, [*examples(), *shown()]):
        used.setdefault(command, set()).update(words)
    missing = [
        (command, option.opts[0])
        for command in COMMANDS
        for option in load_command(command).params
        if option.opts[0].startswith("-") and not used.get(command, set()) & {*option.opts}
    ]
    assert missing == []


@pytest.mark.parametrize(
    "line",
    [
        pytest.param(line, marks=[pytest.mark.long] if words_of(line)[0] in SLOW else [])
        for line in examples()
        if line not in LONG and "--orbits" not in line
    ],
)
def test_an_example_runs(line, tmp_path, monkeypatch, capsysbinary):
    monkeypatch.chdir(tmp_path)
    for folder in ("problems", "tests"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.setenv("LAGCLI_CACHE_DIR", str(tmp_path / "cache"))
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda page: opened.append(page) or True)

    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(watching, "sleep", interrupted)
    words = words_of(line)
    if CLUSTER in words:
        distributed = pytest.importorskip("distributed")
        with distributed.LocalCluster(
            n_workers=1, processes=False, dashboard_address=None
        ) as cluster:
            words[words.index(CLUSTER)] = cluster.scheduler_address
            status = run(words)
    else:
        status = run(words)
    told = capsysbinary.readouterr().err.decode()
    assert int(status) == (130 if "--watch" in words else 0), told
    assert bool(opened) == ("--open" in words)
    written = [
        words[at + 1] for at, word in enumerate(words) if word in {"-o", "--output", "--plot"}
    ]
    assert all(Path(name).stat().st_size > 0 for name in written)
