"""The methods by name: what each is good for, and how it is made ready for a problem.

A module of this folder is a method, and declares it as `METHOD`.  `simulate --method`, its choice
`auto` and `tradeoff` know a method from here only.  An integrator is imported when its method is
made ready.
"""

from __future__ import annotations

from importlib import import_module

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.problem_data import METHODS as NAMES

_ENTRIES: list[MethodEntry] = [import_module(f"{__name__}.{name}").METHOD for name in NAMES[1:]]
METHODS = {entry.name: entry for entry in sorted(_ENTRIES, key=lambda entry: entry.place)}

#: What `auto` tries before all others where the motion is stiff.
STIFF = ("radau5",)
#: Its digits are as many as are needed.
MORE_DIGITS = "taylor"
#: What has more digits than doubles for a motion that turns on them, the cheaper first.
SHARPER = ("taylor128", MORE_DIGITS)
#: A tolerance at which its steps do not pass over a bend that a rounding of doubles makes.
SHARP = 1e-17
#: What `auto` tries: of each group the first that is possible, the next group where more
#: digits may reach what was not reached.
AUTO: tuple[tuple[str, ...], ...] = (
    ("taylor64", "dop853"),
    ("taylor80",),
    ("taylor128", MORE_DIGITS),
)
