"""Transcripts of commands: what is typed, what is answered, and the exit status.

    $ lagcli solve pendulum.yaml --show momenta
    the lines of standard output
    ! the lines of standard error
    => 2

`=> 0` is left out.  `LAGCLI_UPDATE=1 pytest tests/cli` writes what lagcli answers now.
"""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path

from lagcli.cli.run import run


@dataclass(frozen=True)
class Exchange:
    """One command with its answer."""

    command: str
    answer: str


def read_transcript(path: Path) -> list[Exchange]:
    """The exchanges of a file."""
    blocks = ("\n" + path.read_text(encoding="utf-8")).split("\n$ ")[1:]
    pairs = (block.partition("\n") for block in blocks)
    return [Exchange(command, answer.strip("\n")) for command, _, answer in pairs]


def write_transcript(path: Path, exchanges: list[Exchange]) -> None:
    """The file of some exchanges."""
    text = "\n\n".join(f"$ {each.command}\n{each.answer}".rstrip() for each in exchanges)
    path.write_text(text + "\n", encoding="utf-8")


def answer(command: str, capture) -> str:
    """What lagcli answers now."""
    program, *arguments = shlex.split(command)
    assert program == "lagcli"
    status = run(arguments)
    shown = capture.readouterr()
    lines = shown.out.decode().splitlines()
    lines += [f"! {line}".rstrip() for line in shown.err.decode().splitlines()]
    if status:
        lines.append(f"=> {int(status)}")
    return "\n".join(lines).strip("\n")
