"""Files with a wrong unit or a wrong term: each says in its head what must be answered, where.

The places were marked by hand in the text of each file, before anything checked it.
"""

from pathlib import Path

import pytest

from lagcli.diagnostics import render
from lagcli.reader import read_problem

FILES = sorted((Path(__file__).parent / "files").glob("*.yaml"))


def expected(text: str) -> list[tuple[str, str]]:
    heads = [line[2:] for line in text.splitlines() if line.startswith("# ")]
    return [(place, piece) for place, _, piece in (head.partition(" ") for head in heads)]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_mistake_and_no_other_is_shown(path: Path) -> None:
    data = path.read_bytes()
    reading = read_problem(path.name, data)
    assert reading.problem is None
    wanted = expected(data.decode())
    found = [f"{d.span.line}:{d.span.column}" for d in reading.diagnostics]
    assert found == [place for place, _ in wanted]
    for diagnostic, (_, piece) in zip(reading.diagnostics, wanted, strict=True):
        assert piece in render(reading.source, [diagnostic])


def test_there_are_enough_of_them() -> None:
    assert len(FILES) >= 20
