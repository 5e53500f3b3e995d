"""The application and its commands, each loaded when it is called."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import Annotated, Any, cast

import click
import typer
from typer.core import TyperCommand, TyperGroup

#: What `lagcli --help` says of each command, on one line of a terminal, by groups.  The module
#: `lagcli.cli.<command>` has the function `<command>`; it is imported only when it is called.
GROUPS = {
    "formulas": {
        "solve": "Derive the equations of motion, multipliers and charges.",
        "explain": "Print the derivation step by step, with its reasons.",
        "export": "Write the equations of motion as code.",
    },
    "motions": {
        "simulate": "Compute the motion to a stated accuracy.",
        "plot": "Draw a motion over time, in space or in phase space.",
        "animate": "Show a motion as a page to play, a GIF or an MP4.",
        "sweep": "Compute an ensemble of motions.",
    },
    "studies": {
        "check": "Check problems against their known answers.",
        "diff": "Say whether two files mean the same physics.",
        "tradeoff": "Measure what accuracy costs.",
        "extremes": "Take a problem to where it breaks.",
    },
    "problems": {
        "new": "Write a first problem, to change into your own.",
        "list": "List the problems of the library.",
        "show": "Print the file of a problem of the library.",
    },
    "more": {
        "help": "Read the manual, or its page on a topic.",
        "formats": "List the formats that solve knows.",
        "schema": "Print the JSON Schema of problem files, or of answers.",
        "cache": "Show where earlier answers are kept, or remove them.",
        "version": "Print the version.",
    },
}
COMMANDS = {name: text for group in GROUPS.values() for name, text in group.items()}
_ABOUT = "Lagrangian mechanics: from a YAML file to equations, charges and motions."
_OPTIONS = "--version, --install-completion, --show-completion"
#: For someone in an empty directory, to whom nobody has given a file.
_FIRST_STEPS = "lagcli new swing; lagcli solve swing.yaml"


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

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Everything on one screen of 24 lines."""
        formatter.write_usage(ctx.command_path, "COMMAND [OPTIONS] [ARGS]...")
        formatter.write_text(_ABOUT)
        formatter.write_paragraph()
        formatter.write_dl([*_rows(), ("options", _OPTIONS), ("start", _FIRST_STEPS)])


def _rows() -> Iterator[tuple[str, str]]:
    """A line for each command, the first of a group with the group's name."""
    for group, commands in GROUPS.items():
        for place, (name, summary) in enumerate(commands.items()):
            if name != "version":  # the option of that name stands below
                yield f"{'' if place else group:8}  {name}", summary


class SectionsInHelp(TyperCommand):
    """A command whose help names the sections, which are looked up when help is wanted."""

    def fill_in(self) -> None:
        """Put the names of the sections in for {sections} and {steps}."""
        wanting = [p for p in self.params if "{" in (getattr(p, "help", None) or "")]
        if wanting:
            from lagcli.statements.registry import every_section, explained_in_order

            lists = {"{sections}": every_section(), "{steps}": explained_in_order()}
            for option in wanting:
                for mark, declared in lists.items():
                    names = ", ".join(each.name for each in declared)
                    option.help = option.help.replace(mark, names)  # type: ignore[attr-defined]

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help with the names of the sections."""
        self.fill_in()
        super().format_help(ctx, formatter)


def load_command(name: str) -> SectionsInHelp:
    """Import a command's module and make the command of its function."""
    function = getattr(import_module(f"lagcli.cli.{name}"), name)
    single = typer.Typer(rich_markup_mode=None, add_completion=False)
    single.command(name, cls=SectionsInHelp)(function)
    return cast(SectionsInHelp, typer.main.get_command(single))


def application() -> click.Command:
    """Make the command `lagcli`."""
    app = typer.Typer(
        cls=DeferredGroup,
        rich_markup_mode=None,  # rich would cost more than everything else that --help does
        pretty_exceptions_enable=False,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"]},
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
    """Lagrangian mechanics: from a YAML file to equations, charges and motions."""
