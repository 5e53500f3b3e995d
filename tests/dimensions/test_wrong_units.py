"""Files with a wrong unit or a wrong term: each says in its head what must be answered, where.

The places were marked by hand in the text of each file, before anything checked it.
"""

import re
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


@pytest.mark.parametrize(
    ("inertia", "factor"), [("g cm^2", 1e7), ("kg cm^2", 1e4), ("g m^2", 1e3), ("kg mm^2", 1e6)]
)
def test_a_unit_of_the_right_dimension_is_changed_with_its_number(inertia, factor):
    """With the unit alone the file would be accepted, and the motion another one."""
    text = (
        f"coordinates: {{phi: {{unit: rad}}}}\nparameters:\n  J: {{unit: {inertia}, value: 2}}\n"
        "  k: {unit: N m/rad, value: 1.5}\n  M: {unit: N m, value: 3}\n"
        "T: J*phi'^2/2\nV: k*phi^2/2\nforces: {phi: M*cos(phi)}\n"
    )
    found = read_problem("p.yaml", text.encode()).diagnostics
    assert {each.span.line for each in found} <= {3, 4, 5}
    assert found
    for each in found:
        for line, hint in enumerate(re.split("; in line . ", each.hint), start=each.span.line):
            expected = {3: 2 / factor, 4: 1.5 * factor, 5: 3 * factor}[line]
            assert float(hint.partition("value: ")[2]) == pytest.approx(expected)
