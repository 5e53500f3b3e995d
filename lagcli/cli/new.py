"""`lagcli new`."""

from __future__ import annotations

import sys
from pathlib import Path
from shlex import quote
from typing import Annotated

from lagcli.cli.choices import templates
from lagcli.cli.error_output import report_line
from lagcli.cli.files import reason
from lagcli.cli.motion_commands import is_known
from lagcli.cli.options import argument, option
from lagcli.cli.status import Status
from lagcli.templates import TEMPLATES, template

Name = Annotated[str, argument("NAME", "Name of the file, without .yaml.")]
Template = Annotated[
    str,
    option(
        "--template -t",
        "NAME",
        "pendulum, constrained, rolling, symmetry, driven or contact.",
        templates,
    ),
]


def new(name: Name, template_name: Template = "pendulum") -> int:
    """Write a first problem, to change into your own.

    A file that exists is never overwritten.

    \b
    Examples:
      lagcli new swing
      lagcli new cart --template constrained
    """  # noqa: D301 - click reads the control character \b
    if not is_known("--template", template_name, tuple(TEMPLATES)):
        return Status.USAGE
    path = Path(name if name.endswith((".yaml", ".yml")) else f"{name}.yaml")
    if path.stem in {"", ".yaml", ".yml"}:
        report_line(f"lagcli: error: '{name}' is not a name: for example lagcli new swing")
        return Status.USAGE
    title = path.stem.replace("-", " ").replace("_", " ").strip().capitalize() or "Problem"
    text = template(template_name).replace("{title}", _quoted(title))
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        report_line(f"{path}: error: {reason(error)}")
        return Status.USAGE
    typed = quote(str(path))
    steps = "".join(f"  lagcli {command} {typed}\n" for command in ("solve", "explain", "plot"))
    sys.stdout.write(f"{path} written: {TEMPLATES[template_name]}.  Now:\n{steps}")
    return Status.WELL


def _quoted(title: str) -> str:
    """The title as a scalar of YAML."""
    plain = title.replace(" ", "").isalnum()
    return title if plain else "'" + title.replace("'", "''") + "'"
