"""The answer of an earlier run is printed again; any other is derived, and kept."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from lagcli.cli.error_output import report_line, report_text
from lagcli.cli.files import read_input
from lagcli.cli.output import deliver, has_place
from lagcli.cli.printing import Printing
from lagcli.cli.status import Status
from lagcli.platform.cache import Cache, KeptAnswer, folder, key

if TYPE_CHECKING:
    from lagcli.cli.solving import Input, SolvingOutcome


class CommandOptions(NamedTuple):
    """The options of `solve` or `explain` that change the answer."""

    show: tuple[str, ...]
    settings: tuple[str, ...]
    numeric: bool
    command: str = "solve"
    expand: bool = False


def solve_or_repeat(
    files: Sequence[str], options: CommandOptions, printing: Printing, *, cached: bool
) -> Status:
    """Answer the files, from the cache where it has the answer."""
    inputs = [_input(name) for path in files for name in _files_of(path)]
    cache = _cache() if cached else None
    place = _key(inputs, options, printing) if cache else None
    if cache is None or place is None:
        return _solved(inputs, options, printing)[0]
    entry = cache.find(place)
    if entry is not None:
        return _repeated(entry, inputs, printing)
    status, outcome = _solved(inputs, options, printing)
    if outcome.repeatable:
        said = tuple(text for text in outcome.said if text)
        cache.keep(place, KeptAnswer(outcome.status, outcome.text, said))
    return status


def _files_of(path: str) -> list[str]:
    """The file itself, or the problem files under a folder."""
    if not os.path.isdir(path):  # noqa: PTH112 - pathlib is not needed for this
        return [path]
    from lagcli.library import files_in

    try:
        return files_in(Path(path))
    except FileNotFoundError:
        return [path]  # answered as a file that cannot be read


def _input(name: str) -> Input:
    try:
        return name, read_input(name)
    except IsADirectoryError as error:  # without a problem, see above
        return name, type(error)(error.errno, "no problem (*.yaml) in this folder")
    except OSError as error:
        return name, error


def _cache() -> Cache | None:
    if os.environ.get("LAGCLI_NO_CACHE"):
        return None
    found = folder(os.environ)
    return None if found is None else Cache(found)


def _key(inputs: Sequence[Input], options: CommandOptions, printing: Printing) -> str | None:
    """What the answer depends on; None where a file cannot be read."""
    contents = [(name, data) for name, data in inputs if isinstance(data, bytes)]
    if len(contents) < len(inputs):
        return None
    form = [printing.format_name, printing.columns, printing.encoding, printing.standalone,
            printing.latex, printing.motion]  # fmt: skip
    try:
        return key({"options": options, "form": form}, contents)
    except (OSError, ImportError, ValueError):  # a program without a recognisable version
        return None


def _repeated(entry: KeptAnswer, inputs: Sequence[Input], printing: Printing) -> Status:
    possible = has_place(printing.output, *(name for name, _ in inputs))
    for text in entry.said:
        report_text(text)
    if not possible:
        return Status.USAGE
    return _ended(Status(entry.status), entry.text, printing)


def _solved(
    inputs: Sequence[Input], options: CommandOptions, printing: Printing
) -> tuple[Status, SolvingOutcome]:
    from lagcli.cli.command_work import WORKS
    from lagcli.cli.section_options import read_section_options
    from lagcli.cli.solving import solve_files
    from lagcli.platform.stack import with_deep_stack

    work = WORKS[options.command]
    mistakes = work.mistakes(printing.format_name)
    request = read_section_options(
        options.show,
        options.settings,
        numeric=options.numeric,
        expand=options.expand,
        named=printing.format_name != "json",
        mistakes=mistakes,
        option=work.option,
        known=work.sections,
    )
    for mistake in request.mistakes:
        report_line(f"lagcli: error: {mistake}")
    possible = has_place(printing.output, *(name for name, _ in inputs)) and not request.mistakes
    outcome = with_deep_stack(
        lambda: solve_files(inputs, request, printing, work, only_read=not possible)
    )
    if not possible:
        return Status.USAGE, outcome
    return _ended(outcome.status, outcome.text, printing), outcome


def _ended(status: Status, text: str | None, printing: Printing) -> Status:
    if text is None or deliver(text, printing):
        return status
    return Status.USAGE
