"""Which methods are tried in which order, and the first that is possible."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.machine_code import FIRST_OF_LONG, RoundingAddsUp
from lagcli.numerics.certified.methods import AUTO, METHODS, MORE_DIGITS, SHARP, SHARPER
from lagcli.numerics.certified.prepared import Precision, RunsDone, outcome_of
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import NotPossible
from lagcli.record import record

#: Doubles claim nothing better: the parameters are rounded too, alike in all runs.
_LEAST_DOUBLE = 1e-13


@record
class Attempt:
    """What the first method of a group gives that is possible.

    Attributes
    ----------
    outcome : Outcome or None
        None where none is possible.
    precision
        The digits of its runs.
    remark : str
        Why other methods are not possible, as far as it is told.
    first : float
        The first tolerance of the next group is no coarser.
    """

    outcome: Outcome | None
    precision: Precision = nullcontext
    remark: str = ""
    first: float = 1.0


def groups(request: RunRequest) -> Sequence[Sequence[str]]:
    """The methods, each group for what those before it do not reach."""
    if request.method != "auto":
        return ((request.method,),)
    return AUTO[1:] if request.accuracy < _LEAST_DOUBLE else AUTO


def attempt(
    setup: Setup,
    group: Sequence[str],
    modes: Modes,
    done: RunsDone,
    *,
    first: float = 1.0,
    most: int | None = None,
) -> Attempt:
    """What the first method of a group gives that is possible.

    Its first tolerance is no coarser than `first`, its runs with more digits than doubles have
    `most` steps.
    """
    remark, names = "", list(group)
    while names:
        name = names.pop(0)
        made = METHODS[name].prepare(setup, modes)
        if not isinstance(made, str):
            try:
                outcome = outcome_of(setup, modes, made, done, first=first, most=most)
                return Attempt(outcome, made.precision, remark)
            except RoundingAddsUp as reason:
                return Attempt(None, remark=f"; not {name}: {reason}", first=FIRST_OF_LONG)
            except NotPossible as reason:
                made = str(reason)
                if names and reason.needs_digits and MORE_DIGITS not in names:
                    names[:0] = SHARPER
                    first = SHARP
        remark += f"; not {name}: {made}"
    is_only = len(groups(setup.request)) == 1
    return Attempt(None, remark=remark if is_only else "")
