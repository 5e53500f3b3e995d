"""What somebody probably meant by a unit that is not known."""

from __future__ import annotations

from difflib import get_close_matches

from lagcli.units.table import known_names, meaning

#: Units by the names that people use and the table does not have.
_ELSEWHERE = {
    **dict.fromkeys(
        "none null nil no number dimensionless unitless nondimensional adimensional "
        "einheitenlos dimensionslos ratio pure scalar one".split(),
        "1",
    ),
    "radians": "rad",
    **dict.fromkeys(("degrees", "°", "º"), "deg"),
    "rev": "turn",
    "ton": "t",
    "sq": "^2",
    "c": "m/s",
    "lbs": "lb",
    "gauß": "gauss",
    **dict.fromkeys(("kilos", "kilogramm", "kilogramme"), "kg"),
    "kg": "kg",  # Kg, KG
}


def suggestion(name: str) -> str:
    """`did you mean 'N m'?`, or how units are written."""
    best = _ELSEWHERE.get(name.lower()) or _apart(name) or _other_case(name) or _near(name)
    return f"did you mean '{best}'?" if best else "units are written as in kg m^2/s"


def _apart(name: str) -> str:
    """`Nm` -> `N m`, `m2` -> `m^2`, `rads` -> `rad`."""
    letters = name.rstrip("0123456789")
    digits = name[len(letters) :]
    if digits and not meaning(letters) and (two := _apart(letters)):
        return f"{two}^{digits}"
    if name[-1:] == "s" and meaning(name[:-1]) and name[:-1] not in {"N", "J", "Pa", "W"}:
        return name[:-1]
    if digits and letters and meaning(letters):
        return f"{letters}^{digits}"
    for size in range(1, len(name)):
        first, second = name[:size], name[size:]
        if first in _SYMBOLS and second in _SYMBOLS:
            return f"{first} {second}"
    return ""


_SYMBOLS = "kg g m cm mm km s N J W C V A T rad K Pa".split()


#: Symbols by their names, for names that are misspelled.
_FULL = {"hertz": "Hz", "Hertz": "Hz", "newton": "N", "Newton": "N", "joule": "J", "Joule": "J"}


def _other_case(name: str) -> str:
    known = [*_SYMBOLS, *known_names()]
    return next((other for other in known if other.lower() == name.lower()), "")


def _near(name: str) -> str:
    long_names = [known for known in known_names() if len(known) > 2]
    long_names = [*long_names, *_FULL]
    near = get_close_matches(name, long_names, n=1, cutoff=0.7)
    return _FULL.get(near[0], near[0]) if near else ""
