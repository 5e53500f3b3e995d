"""Every transcript in this folder still holds."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.cli.transcript import Exchange, answer, read_transcript, write_transcript

HERE = Path(__file__).parent
TRANSCRIPTS = sorted((HERE / "transcripts").glob("*.txt"))


@pytest.mark.parametrize("path", TRANSCRIPTS, ids=lambda path: path.stem)
def test_transcript(path, monkeypatch, capsysbinary):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(HERE / "files")
    expected = read_transcript(path)
    found = [Exchange(each.command, answer(each.command, capsysbinary)) for each in expected]
    if os.environ.get("LAGCLI_UPDATE"):
        write_transcript(path, found)
    assert found == expected
