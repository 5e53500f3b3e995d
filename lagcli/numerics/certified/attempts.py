"""Which methods are tried in which order, and the first that is possible."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.methods import AUTO, METHODS, MORE_DIGITS, SHARP, SHARPER
from lagcli.numerics.certified.prepared import Precision, outcome_of
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import NotPossible

#: Doubles claim nothing better: the parameters are rounded too, alike in all runs.
_LEAST_DOUBLE = 1e-13


def groups(request: RunRequest) -> Sequence[Sequence[str]]:
    """The methods, each group for what those before it do not reach."""
    if request.method != "auto":
        return ((request.method,),)
    return AUTO[1:] if request.accuracy < _LEAST_DOUBLE else AUTO


def attempt(
    setup: Setup, group: Sequence[str], modes: Modes, first: float = 1.0
) -> tuple[Outcome | None, Precision]:
    """What the first method gives that is possible, and its digits; why others are not.

    Its first tolerance is no coarser than `first`.
    """
    remark, names = "", list(group)
    while names:
        name = names.pop(0)
        made = METHODS[name].prepare(setup, modes)
        if not isinstance(made, str):
            try:
                found = outcome_of(setup, modes, made, first)
            except NotPossible as reason:
                made = str(reason)
                if setup.is_long:
                    setup.remark += f"; not {name}: {made}"
                    return None, nullcontext
                if names and reason.needs_digits and MORE_DIGITS not in names:
                    names[:0] = SHARPER
                    first = SHARP
            else:
                setup.remark += remark
                return found, made.precision
        remark += f"; not {name}: {made}"
    if len(groups(setup.request)) == 1:
        setup.remark += remark
    return None, nullcontext
