"""The request of a run."""

from __future__ import annotations

from collections.abc import Callable

from lagcli.expression import Expression
from lagcli.reader.columns import Column
from lagcli.record import record

#: Called with the part of a work that is done, where somebody looks.
Progress = Callable[[float], None] | None


@record(kw_only=True)
class RunRequest:
    """A run as the user wants it.

    Attributes
    ----------
    until, accuracy, samples
        The span of time, the bound on the global error of every column, the rows.
    end : Expression or None
        `until` as it is written; None where it is that double.
    times : tuple of float
        The rows, from 0 to `until`, where they are not evenly spread.
    columns : tuple of Column
        What is shown; the first is the time.
    project : bool
        Take the nearest consistent initial state for one off the constraints.
    stop_when : Expression or None
        The run stops where it changes its sign.
    method : str
        `auto`, or one by its name.
    digits : int or None
        How many may be carried where doubles do not suffice; None leaves it at doubles,
        and at what lies within their rounding.
    whole : bool
        Integrate the model as the file has it, nothing eliminated and nothing left out.
    furthest : bool
        Where the accuracy is not reached to the end, run shorter spans to find how long it holds.
    beyond : bool
        Keep the rows after those that are within the accuracy, apart from these.
    written : function
        Writes a formula of the cut model as text of the grammar.
    """

    until: float
    accuracy: float
    samples: int
    columns: tuple[Column, ...]
    end: Expression | None = None
    times: tuple[float, ...] = ()
    project: bool = False
    stop_when: Expression | None = None
    stop_name: str = ""
    method: str = "auto"
    digits: int | None = None
    whole: bool = False
    furthest: bool = True
    beyond: bool = False
    written: Callable[[Expression], str] = str
