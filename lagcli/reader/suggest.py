"""What somebody probably meant by a name that is not known."""

from __future__ import annotations

import unicodedata
from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

#: What other programs call the functions of the format.
_ELSEWHERE = {
    "ln": "log",
    "fabs": "abs",
    "Abs": "abs",
    "sgn": "sign",
    "pow": "^",
    "Pi": "pi",
    "PI": "pi",
    "π": "pi",
    **{f"arc{name}": f"a{name}" for name in ["sin", "cos", "tan"]},
    **{f"ar{name}": f"a{name}" for name in ["sinh", "cosh", "tanh"]},
    **{f"arc{name}": f"a{name}" for name in ["sinh", "cosh", "tanh"]},
}

#: Dots for velocities, as others write them.
_VELOCITY_ENDINGS = ("_dot", "dot", "_ddot", "ddot", "_d")


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """`did you mean 'theta'?`, or nothing when no known name is near."""
    best = closest(name, known)
    return f"did you mean '{best}'?" if best else ""


def closest(name: str, known: Iterable[str]) -> str:
    """The known name nearest to `name`, or nothing."""
    names = list(known)
    if _ELSEWHERE.get(name) in names:
        return _ELSEWHERE[name]
    for alike in names:
        if _folded(alike) == _folded(name):
            return alike
    for ending in _VELOCITY_ENDINGS:
        stem = name.removesuffix(ending)
        if stem != name and stem in names:
            return stem + ("''" if ending.endswith("ddot") else "'")
    if len(name) > 60:
        return ""
    near = get_close_matches(name, names, n=1, cutoff=0.6)
    return near[0] if near else ""


def _folded(name: str) -> str:
    """Look-alikes in one form: µ and μ, X and x."""
    return unicodedata.normalize("NFKC", name).casefold()
