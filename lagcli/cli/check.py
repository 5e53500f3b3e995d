"""`lagcli check`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import REPORTS, problems
from lagcli.cli.options import Jobs, argument, option

Paths = Annotated[
    list[str],
    argument(
        "PATH...", "Problems, folders with problems, names of the library; - is stdin.", problems
    ),
]
Format = Annotated[
    str, option("--format -f", "NAME", "text, json, junit, github or sarif.", REPORTS)
]
Timeout = Annotated[float, option("--timeout", "SECONDS", "For each problem.", min=0.01)]


Shard = Annotated[
    str | None, option("--shard", "I/N", "Only every N-th problem from the I-th: for N machines.")
]


def check(
    paths: Paths,
    format_name: Format = "text",
    jobs: Jobs = None,
    timeout: Timeout = 60.0,
    shard: Shard = None,
) -> int:
    """Check problems against their known answers and against the mathematics.

    Every answer is compared with the `expect` block of its file.  The solved accelerations
    are put back into the equations, the constraints and the charges are differentiated
    along the motion.

    The exit status is 0 when all holds, 1 when an answer is wrong, undecided or late, and 2
    when a file is not a problem.

    \b
    Examples:
      lagcli check hoop kepler
      lagcli check problems/ --format junit > report.xml
      lagcli check problems/ --shard 1/4
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.checking import check_paths

    return check_paths(paths, format_name, jobs, timeout, shard)
