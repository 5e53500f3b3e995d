"""`lagcli new`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import templates
from lagcli.cli.options import argument, option

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
    from lagcli.cli.new_problem import write_problem

    return write_problem(name, template_name)
