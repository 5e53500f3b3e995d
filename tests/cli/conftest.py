from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

FILES = Path(__file__).parent / "files"


@pytest.fixture(autouse=True)
def _nothing_kept(monkeypatch):
    """No test answers from what another run has kept in the home directory."""
    monkeypatch.setenv("LAGCLI_NO_CACHE", "1")


@pytest.fixture
def lagcli():
    """Run `lagcli …` in a process of its own, among the files of this folder."""

    def run(*arguments, **settings):
        environment = {**os.environ, "PYTHONIOENCODING": "utf-8", **settings.pop("env", {})}
        return subprocess.run(
            [sys.executable, "-m", "lagcli", *arguments],
            cwd=settings.pop("cwd", FILES),
            env=environment,
            capture_output=True,
            timeout=120,
            check=False,
            **settings,
        )

    return run
