"""A problem as text through the command line, as a user would run it."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from lagcli.cli.run import run

ROOT = Path(__file__).parents[2]


@pytest.fixture
def lagcli(tmp_path, capsys, monkeypatch):
    """Status, standard output and standard error of a command on a text, or a library problem."""
    monkeypatch.setenv("LAGCLI_NO_CACHE", "1")

    def call(command, text, *options):
        path = ROOT / text
        if "\n" in text or "{" in text:
            path = tmp_path / "case.yaml"
            path.write_text(text, encoding="utf-8")
        status = run([command, str(path), *map(str, options)])
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return SimpleNamespace(status=status, out=out, err=err)

    return call


@pytest.fixture
def simulate(lagcli):
    """The table of a run: `last` has the last row by its columns."""

    def call(text, until, *options, show=None, accuracy=1e-9, samples=2):
        options = [*options, "--until", until, "--accuracy", accuracy, "--samples", samples]
        options += ["--show", show] if show else []
        answer = lagcli("simulate", text, "-f", "json", *options)
        if answer.out:
            document = json.loads(answer.out)
            answer.document = document
            answer.rows = [dict(zip(document["columns"], r, strict=True)) for r in document["rows"]]
            answer.last = answer.rows[-1] if answer.rows else None
            answer.events = document["events"]
            answer.held = document["certificate"]
            answer.warnings = " ".join(document["warnings"])
        return answer

    return call
