"""`lagcli explain`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import page_formats, sections
from lagcli.cli.options import BY_ENDING, Latex, Output, WithMotion, option
from lagcli.cli.solve import Files, NoCache, Set, Standalone, Width

_FORMATS = "text, latex, markdown, html, json or pdf." + BY_ENDING.format("text")
Format = Annotated[str | None, option("--format -f", "NAME", _FORMATS, page_formats)]
Also = Annotated[
    list[str] | None, option("--also", "A,B", "Print these steps as well: {steps}.", sections)
]


def explain(
    files: Files,
    format_name: Format = None,
    output: Output = None,
    also: Also = None,
    settings: Set = None,
    standalone: Standalone = False,
    latex: Latex = None,
    with_motion: WithMotion = False,
    width: Width = None,
    no_cache: NoCache = False,
) -> int:
    """Print the derivation step by step, with its reasons.

    Coordinates and constraints, the Lagrangian, its partial derivatives, Lagrange's
    equations, how the multipliers are eliminated, what they mean, the check, and what is
    conserved and why.  The exit status is that of lagcli solve.

    \b
    Examples:
      lagcli explain hoop
      lagcli explain hoop --also find,modes
      lagcli explain hoop -f latex --standalone -o hoop.tex
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.cached_answers import CommandOptions, solve_or_repeat
    from lagcli.cli.endings import PAGES, format_of
    from lagcli.cli.printing import printing_of

    form = format_of(format_name, output, PAGES, "text")
    printing = printing_of(
        form, output, standalone=standalone, width=width, latex=latex, motion=with_motion
    )
    options = CommandOptions(
        tuple(also or ()), tuple(settings or ()), numeric=False, command="explain"
    )
    return solve_or_repeat(files, options, printing, cached=not no_cache)
