"""`lagcli schema`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import SCHEMAS
from lagcli.cli.options import Output, argument

What = Annotated[str, argument("[WHAT]", "problem or answers.", SCHEMAS)]


def schema(what: What = "problem", output: Output = None) -> int:
    """Print the JSON Schema of problem files, or of answers.

    An editor with a YAML language server completes and underlines problem files whose first
    line is

      # yaml-language-server: $schema=problem.schema.json

    \b
    Examples:
      lagcli schema -o problem.schema.json
      lagcli schema answers
    """  # noqa: D301 - click reads the control character \b
    import json

    from lagcli.cli.choices import SCHEMAS
    from lagcli.cli.endings import JSON, format_of
    from lagcli.cli.motion_commands import is_known
    from lagcli.cli.output import has_place, place
    from lagcli.cli.status import Status
    from lagcli.formatters.schema import answers_schema
    from lagcli.reader.schema import problem_schema

    format_of(None, output, JSON, "json")
    if not is_known("the schema", what, SCHEMAS) & has_place(output):
        return Status.USAGE
    made = problem_schema() if what == "problem" else answers_schema()
    text = json.dumps(made, indent=1, ensure_ascii=False) + "\n"
    return Status.WELL if place(text.encode(), output) else Status.USAGE
