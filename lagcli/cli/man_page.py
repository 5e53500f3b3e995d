"""The man page: every command with its options, in the macros of man(7)."""

from __future__ import annotations

from collections.abc import Iterator

import click

from lagcli import __version__
from lagcli.cli.app import COMMANDS, application, load_command


def man_page() -> str:
    """The page `lagcli.1`, for `man ./lagcli.1`."""
    program = application()
    lines = [
        f'.TH LAGCLI 1 "" "lagcli {__version__}"',
        ".SH NAME",
        r"lagcli \- Lagrangian mechanics from the command line",
        ".SH SYNOPSIS",
        r".B lagcli \fICOMMAND\fR [\fIOPTION\fR ...] [\fIFILE\fR ...]",
        ".SH DESCRIPTION",
        _text(program.help or ""),
        r"The manual is read with \fBlagcli help\fR.",
        ".SH COMMANDS",
    ]
    for name in COMMANDS:
        command = load_command(name)
        command.fill_in()
        lines += _command(name, command)
    lines += [".SH EXIT STATUS"]
    for status, meaning in _STATUSES.items():
        lines += [".TP", status, meaning]
    return "\n".join(lines) + "\n"


_STATUSES = {
    "0": "All was answered.",
    "1": "An answer was not found, or a check failed.",
    "2": "The command line or a file is wrong.",
    "130": "Interrupted.",
}


def _command(name: str, command: click.Command) -> Iterator[str]:
    yield f".SS lagcli {name}"
    summary, _, rest = (command.help or "").partition("\b")
    for paragraph in summary.strip().split("\n\n"):
        yield ".PP"
        yield _text(paragraph)
    with click.Context(command, info_name=name) as context:
        for parameter in command.get_params(context):
            record = parameter.get_help_record(context)
            if record:
                yield ".TP"
                yield rf"\fB{_escaped(record[0])}\fR"
                yield _text(record[1])
    if rest.strip():
        yield from (".PP", ".nf", *(_text(line, joined=False) for line in rest.splitlines()), ".fi")


def _text(text: str, *, joined: bool = True) -> str:
    """A paragraph; a line that begins with a dot or a quote would be a request."""
    words = " ".join(text.split()) if joined else text.strip("\n")
    escaped = _escaped(words)
    return rf"\&{escaped}" if escaped.startswith((".", "'")) else escaped


def _escaped(text: str) -> str:
    return text.replace("\\", r"\e").replace("-", r"\-")
