"""A new problem file from a template."""

from __future__ import annotations

import sys
from pathlib import Path
from shlex import quote

from lagcli.cli.error_output import report_line
from lagcli.cli.files import reason
from lagcli.cli.motion_commands import is_known
from lagcli.cli.status import Status
from lagcli.templates import TEMPLATES, template


def write_problem(name: str, template_name: str) -> Status:
    """Write `NAME.yaml` where no such file is; the next commands are proposed."""
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
