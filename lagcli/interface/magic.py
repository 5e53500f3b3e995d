"""`%%lagcli`: a problem in a notebook's cell, answered below it.

    %load_ext lagcli

    %%lagcli solve accelerations,charges
    coordinates: [x]
    T: x'^2/2

The first word is `solve`, `explain` or `simulate`, then sections or columns; `--name p` keeps
the problem under a name.
"""

from __future__ import annotations

from typing import Any

_COMMANDS = ("solve", "explain", "simulate")


def load_ipython_extension(shell: Any) -> None:
    """Register the magic; called by `%load_ext lagcli`."""
    shell.register_magic_function(lambda line, cell: _answer(shell, line, cell), "cell", "lagcli")


def _answer(shell: Any, line: str, cell: str) -> object:
    """The answer to a cell; a mistake is printed, and there is no traceback."""
    from lagcli import interface

    words = line.split()
    name = ""
    if "--name" in words[:-1]:
        place = words.index("--name")
        name = words[place + 1]
        del words[place : place + 2]
    command = words.pop(0) if words and words[0] in _COMMANDS else "solve"
    listed = [each for word in words for each in word.split(",") if each]
    try:
        problem = interface.loads(cell)
        if name:
            shell.push({name: problem})
        match command:
            case "explain":
                return interface.explain(problem, listed)
            case "simulate":
                return interface.simulate(problem, show=listed)
        return interface.solve(problem, listed or None)
    except (interface.ProblemError, ValueError) as error:
        print(error)  # noqa: T201 - a notebook shows it under the cell
        return None
