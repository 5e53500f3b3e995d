"""`lagcli solve`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import formats, problems, sections
from lagcli.cli.options import BY_ENDING, Latex, Output, WithMotion, argument, flag, option

Files = Annotated[
    list[str],
    argument(
        "FILE...", "Problems, folders with problems, names of the library; - is stdin.", problems
    ),
]
Format = Annotated[
    str | None,
    option("--format -f", "NAME", "See: lagcli formats." + BY_ENDING.format("text"), formats),
]
Show = Annotated[
    list[str] | None,
    option(
        "--show",
        "A,B,C",
        "Only these sections.  There are: {sections}.  Without it: those that a first look needs.",
        sections,
    ),
]
Set = Annotated[
    list[str] | None,
    option("--set", "NAME=VALUE", "Put a value (also an expression) in for a parameter."),
]
Numeric = Annotated[bool, flag("--numeric", "Put in the file's values and give decimal numbers.")]
Expand = Annotated[bool, flag("--expand", "Write out the abbreviations of long formulas.")]
Standalone = Annotated[
    bool, flag("--standalone", "A whole LaTeX or HTML document, not a fragment.")
]
Width = Annotated[
    int | None, option("--width", "N", "Columns.  [default: the terminal's, or 80]", min=20)
]
Watch = Annotated[bool, flag("--watch", "Answer again whenever a file changes, until Ctrl-C.")]
NoCache = Annotated[
    bool, flag("--no-cache", "Neither look up the answer nor keep it.  See: lagcli cache.")
]


def solve(
    files: Files,
    format_name: Format = None,
    output: Output = None,
    show: Show = None,
    settings: Set = None,
    numeric: Numeric = False,
    expand: Expand = False,
    standalone: Standalone = False,
    latex: Latex = None,
    with_motion: WithMotion = False,
    width: Width = None,
    watch: Watch = False,
    no_cache: NoCache = False,
) -> int:
    """Derive the equations of motion, multipliers and charges.

    The exit status is 0 when all was answered, 1 when an answer was not found, and 2 when
    the command line or a file is wrong; the other files are answered all the same.

    \b
    Examples:
      lagcli solve hoop
      lagcli solve hoop --show accelerations,multipliers -f latex
      lagcli solve hoop --set R=1/2 --set "alpha=pi/6" -f json -o hoop.json
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.cached_answers import CommandOptions, solve_or_repeat
    from lagcli.cli.endings import PAGES, format_of
    from lagcli.cli.printing import printing_of

    form = format_of(format_name, output, PAGES, "text")
    printing = printing_of(
        form, output, standalone=standalone, width=width, latex=latex, motion=with_motion
    )
    options = CommandOptions(tuple(show or ()), tuple(settings or ()), numeric, expand=expand)

    def answer() -> int:
        return solve_or_repeat(files, options, printing, cached=not no_cache)

    if not watch:
        return answer()
    from lagcli.cli.watching import watch as again

    return again(files, answer)
