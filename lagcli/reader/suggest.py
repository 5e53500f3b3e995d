"""What somebody probably meant by a name that is not known."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

from lagcli.notation.greek import BY_LETTER
from lagcli.reader.habits import meanings

#: Names longer than this, and more names than these, are not compared.
_LONGEST, _MOST = 60, 300

#: Cyrillic and Greek letters, which look like Latin ones.
_LATIN = str.maketrans(
    "асеорхуіјкмтнАВЕКМНОРСТУХΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "aceopxyijkmthabekmhopctyxabezhikmnoptyx"
)


def did_you_mean(name: str, known: Iterable[str], near: float = 0.6) -> str:
    """`did you mean 'theta'?`, or nothing when no known name is as `near`."""
    best = closest(name, known, near)
    letters = [pair for pair in zip(best, name, strict=False) if pair[0] != pair[1]]
    is_alike = unicodedata.normalize("NFKC", name) == best or _LATIN.keys() & {
        *map(ord, best + name)
    }
    named = [unicodedata.name(ours, "") for ours, _ in letters] if is_alike else []
    shown = f", with the letter {named[0].capitalize()}" if named else ""
    return f"did you mean '{best}'{shown}?" if best else ""


def alike(name: str, known: Iterable[str]) -> str:
    """The known name that looks or sounds the same, such as θ for theta; else nothing."""
    return next((each for each in known if _folded(each) == _folded(name)), "")


def closest(name: str, known: Iterable[str], cutoff: float = 0.6) -> str:
    """The known name nearest to `name`, or nothing.

    The likeness is twice the number of letters in common over that of both, from 0 to 1.
    """
    names = list(known)
    if (usual := meanings("functions").get(name)) in names:
        return usual
    if same := alike(name, names):
        return same
    from difflib import get_close_matches

    if len(name) > _LONGEST:
        return ""
    spelled = {spelled_out(known): known for known in reversed(names) if len(known) <= _LONGEST}
    if len(name) > 1:  # m is not near to mu
        spelled = {spelling: known for spelling, known in spelled.items() if len(spelling) > 1}
    if len(name) == 1:  # one letter is near to those that begin with it
        spelled = {spelling: known for spelling, known in spelled.items() if spelling[0] == name}
    near = get_close_matches(name, list(spelled)[-_MOST:], n=1, cutoff=cutoff)
    return spelled[near[0]] if near else ""


def spelled_out(name: str) -> str:
    """Greek letters by their names: `theta` for θ, and `theta_1` for θ_1."""
    return "".join(BY_LETTER.get(letter, letter) for letter in name).replace("ħ", "hbar")


def _folded(name: str) -> str:
    """Look-alikes in one form: µ and μ, X and x, ϕ and φ and phi, w and ω, a Cyrillic х and x."""
    folded = spelled_out(unicodedata.normalize("NFKC", name).translate(_LATIN).casefold())
    folded = re.sub(r"^ell(?![a-z])", "l", re.sub("^epsilon", "eps", folded))
    return "omega" if folded == "w" else folded
