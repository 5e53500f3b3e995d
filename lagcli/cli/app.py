"""The application and its commands, each loaded when it is called."""

from __future__ import annotations

from importlib import import_module
from typing import Annotated, Any

import click
import typer
from typer.core import TyperGroup

#: Command -> what `lagcli --help` says of it.  The module `lagcli.cli.<command>` has the
#: function `<command>`; it is imported only when that command is called.
COMMANDS = {
    "solve": "Derive and print the equations of motion, multipliers and charges.",
    "explain": "Tell the derivation step by step, with its reasons.",
    "simulate": "Compute the motion to a stated accuracy, with a certificate.",
    "plot": "Draw a motion over time, in space or in phase space.",
    "animate": "Show a motion as a page to play, a GIF or an MP4.",
    "sweep": "Compute an ensemble of motions over parameters and initial states.",
    "tradeoff": "Measure what accuracy costs: every method against a known reference.",
    "extremes": "Take a problem to its extremes and report where it breaks.",
    "export": "Write the equations of motion as code in another language.",
    "check": "Check problems against their known answers and against the mathematics.",
    "diff": "Say whether two files mean the same physics.",
    "new": "Write a first problem, to change into your own.",
    "list": "List the problems of the library that comes with lagcli.",
    "show": "Print the file of a problem of the library, to read or to change.",
    "formats": "List the formats that `solve --format` knows.",
    "schema": "Print the JSON Schema of problem files, or of the answers in JSON.",
    "help": "Read the manual, or its page on a topic.",
    "cache": "Show where the answers of earlier runs are kept, or remove them.",
    "version": "Print the version.",
}


#: For someone in an empty directory, to whom nobody has given a file.
_FIRST_PROBLEM = """\b
First steps:
  lagcli new swing          a problem of your own, swing.yaml
  lagcli solve swing.yaml
  lagcli list pendulum      the library, whose problems are found by name
  lagcli explain kepler
"""


class DeferredCommand(click.Command):
    """A command known by name and summary, which becomes the real one when called."""

    def make_context(
        self,
        info_name: str | None,
        args: list[str],
        parent: click.Context | None = None,
        **extra: Any,
    ) -> click.Context:
        """The context of the real command, which is loaded here."""
        return load_command(str(self.name)).make_context(info_name, args, parent, **extra)


class DeferredGroup(TyperGroup):
    """A group whose commands are deferred."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.suggest_commands = False  # click does it
        for name, summary in COMMANDS.items():
            self.commands[name] = DeferredCommand(name, help=summary, short_help=summary)


def load_command(name: str) -> click.Command:
    """Import a command's module and make the command of its function."""
    function = getattr(import_module(f"lagcli.cli.{name}"), name)
    single = typer.Typer(rich_markup_mode=None, add_completion=False)
    single.command(name)(function)
    return typer.main.get_command(single)


def application() -> click.Command:
    """Make the command `lagcli`."""
    app = typer.Typer(
        cls=DeferredGroup,
        rich_markup_mode=None,  # rich would cost more than everything else that --help does
        pretty_exceptions_enable=False,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"]},
        epilog=_FIRST_PROBLEM,
    )
    app.callback()(lagcli)
    return typer.main.get_command(app)


def _print_version(wanted: bool) -> None:
    if wanted:
        from lagcli import __version__

        typer.echo(f"lagcli {__version__}")
        raise typer.Exit


Version = Annotated[
    bool,
    typer.Option(
        "--version", help="Print the version and exit.", callback=_print_version, is_eager=True
    ),
]


def lagcli(version: Version = False) -> None:
    """Lagrangian mechanics: from a problem in YAML to equations, multipliers and charges."""
