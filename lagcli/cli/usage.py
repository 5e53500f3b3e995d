"""A wrong command line: what is wrong, and what was meant."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from click import BadOptionUsage, ClickException, NoSuchOption, UsageError

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
        said = f"{mistake.message} Did you mean {meant}?" if meant else said
    elif isinstance(mistake, BadOptionUsage) and mistake.option_name in _FOR_EXAMPLE:
        said = f"{said} Write {_FOR_EXAMPLE[mistake.option_name]}."
    elif context is not None and context.parent is None and "No such command" in said:
        named = next((each for each in arguments if not each.startswith("-")), "")
        if Path(named).suffix in {".yaml", ".yml"} or Path(named).exists():
            said = f"A command comes first: lagcli solve {named}"
    UsageError(within_a_terminal(f"Error: {said}").removeprefix("Error: "), context).show()


def _option_meant(written: str, known: set[str], arguments: Sequence[str]) -> str:
    """The option of the command that another word stands for; nothing where none is."""
    for each in arguments:  # -show
        long = "-" + each.partition("=")[0]
        if each.startswith(written) and not each.startswith("--") and long in known:
            return long
    return next((o for o, words in _MEANT.items() if o in known and written in words.split()), "")
