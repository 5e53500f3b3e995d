"""A wrong command line: what is wrong, and what was meant."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path

from click import BadOptionUsage, ClickException, Context, NoSuchOption, UsageError

from lagcli.cli.error_output import within_a_terminal

#: Options by what other programs call them.
_MEANT = {
    "--set": "--start --initial --init --ics --x0 --param --params --parameter --parameters -p -D",
    "--until": "-u -t --t --time --tmax --t-max --tend --t-end --end --to --duration -T",
    "--samples": "-n -N --n --steps --points --rows --dt --step --fps --frames",
    "--accuracy": "-a --tol --rtol --atol --eps --error --digits --tolerance",
    "--method": "-m --solver --integrator",
    "--show": "-s --section --sections --only --column --columns --print",
    "--output": "-O --out --outfile --file --save",
    "--format": "--type --fmt --output-format",
    "--to": "--language --lang -l --format -f",
    "--vary": "--sweep --range --over",
    "--version": "-v -V",
}


#: An option with a value behind a blank, in place of `name=value`.
_NAMED_VALUE = re.compile(r"[^\W\d]\w*['’′]*")
_NUMBER = re.compile(r"[-+]?\d[\d.]*(?:[eE][-+]?\d+)?")

#: What stands behind options that lack it.
_FOR_EXAMPLE = {
    "--latex": "--format latex, and beside it words such as --latex labels=eq",
    "--until": "--until 10",
    "--set": "--set m=1",
    "--show": "--show energy,modes",
    "--format": "--format latex",
    "--accuracy": "--accuracy 1e-9",
    "--output": "--output answer.tex",
    "--vary": "--vary m=1,2,4",
}


def report_mistake(mistake: ClickException, arguments: Sequence[str]) -> None:
    """Show a mistake of the command line on standard error."""
    said = mistake.format_message()
    context = mistake.ctx if isinstance(mistake, UsageError) else None
    if isinstance(mistake, NoSuchOption) and context is not None:
        known = {name for each in context.command.get_params(context) for name in each.opts}
        meant = _option_meant(mistake.option_name, known, arguments)
        one = meant or "Did you mean '" in said
        elsewhere = "" if one else _command_with(mistake.option_name)
        said = f"{mistake.message} Did you mean {meant}?" if meant else said
        said = f"{mistake.message} It is an option of lagcli {elsewhere}." if elsewhere else said
    elif isinstance(mistake, BadOptionUsage) and mistake.option_name in _FOR_EXAMPLE:
        said = f"{said} Write {_FOR_EXAMPLE[mistake.option_name]}."
    elif context is not None and context.parent is None and "No such command" in said:
        from lagcli.reader.habits import meanings

        named = next((each for each in arguments if not each.startswith("-")), "")
        other = meanings("commands").get(named)
        if Path(named).suffix in {".yaml", ".yml"} or Path(named).exists():
            said = f"A command comes first: lagcli solve {named}"
        elif other:
            said = f"No such command '{named}'. Did you mean '{other}'?"
    elif context is not None and "unexpected extra argument" in said and _columns(context, said):
        said = f"{said}. Columns stand behind --show, as in --show {_columns(context, said)}."
    UsageError(within_a_terminal(f"Error: {said}").removeprefix("Error: "), context).show()


def refuse_values_apart(arguments: Sequence[str]) -> None:
    """Refuse `--set k 2` and `--vary k 1 4`, whose numbers would be read as files.

    Raises
    ------
    UsageError
        With the option as it is written.
    """
    for option, name, *rest in (arguments[place:] for place in range(len(arguments) - 2)):
        if option not in {"--set", "--at", "--vary"} or not _NAMED_VALUE.fullmatch(name):
            continue
        behind = rest[1:] if rest[0] == "=" else rest
        numbers = [*takewhile(_NUMBER.fullmatch, behind)]
        if not numbers:
            continue
        value = numbers[0] if option != "--vary" else ",".join(numbers)
        whole = f"{name}={value}"
        whole = f'"{whole}"' if "'" in name else whole
        said = f"{option} {name}: an '=' is missing: write {option} {whole}"
        if option == "--vary" and len(numbers) == 2:
            said += (
                f", or for 10 values from {numbers[0]} on {option} {name}={':'.join(numbers)}:10"
            )
        raise UsageError(said)


def _columns(context: Context, said: str) -> str:
    """`x,y` for the extra arguments x and y of a command with columns; nothing for others."""
    has_columns = any("--show" in each.opts for each in context.command.get_params(context))
    words = said.partition("(")[2].rstrip(")").split()
    names = [each for each in words if each.isidentifier() and each not in {"vs", "over", "and"}]
    return ",".join(each for each in names if each != "t") if has_columns else ""


def _command_with(option: str) -> str:
    """The first command that has an option, with it; nothing where none has."""
    from lagcli.cli.app import COMMANDS, load_command

    for name in COMMANDS:
        for each in load_command(name).params:
            if option in each.opts:
                value = "" if getattr(each, "is_flag", False) else f" {each.metavar or 'VALUE'}"
                return f"{name}: lagcli {name} FILE {option}{value}"
    return ""


def _option_meant(written: str, known: set[str], arguments: Sequence[str]) -> str:
    """The option of the command that another word stands for; nothing where none is."""
    for each in arguments:  # -show
        long = "-" + each.partition("=")[0]
        if each.startswith(written) and not each.startswith("--") and long in known:
            return long
    return next((o for o, words in _MEANT.items() if o in known and written in words.split()), "")
