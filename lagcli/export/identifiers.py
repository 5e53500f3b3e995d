"""Names of a problem as identifiers of programming languages."""

from __future__ import annotations

import keyword
import unicodedata
from collections.abc import Iterable

#: Words that are taken in one of the languages, or by the exported code itself.
_TAKEN = frozenset(
    "t y p out pi e i j N E I S Q O C D auto break case char const continue default do double else "
    "enum extern float for goto if inline int long register restrict return short signed sizeof "
    "static struct switch typedef union unsigned void volatile while end function begin local "
    "global model equation parameter algorithm der time true false call stop real integer "
    "subroutine module program use implicit none intent in gamma beta zeta erf sin cos tan exp log "
    "sqrt abs sign min max y0 y1 yn j0 j1 jn".split()
)
_LETTERS = {"ϕ": "varphi", "ϑ": "vartheta", "ϵ": "varepsilon", "ϱ": "varrho"}


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """An identifier for each name: `theta_dot` for θ', `lambda_` for a keyword.

    Identifiers differ also where letters of both cases are the same, as in Fortran.

    Examples
    --------
    >>> identifiers(["θ", "θ'", "lambda", "m", "M"])
    {'θ': 'theta', "θ'": 'theta_dot', 'lambda': 'lambda_', 'm': 'm', 'M': 'M_'}
    """
    found: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        letters = name.rstrip("'")
        primes = len(name) - len(letters)
        word = "".join(map(_spelled, letters)) + ("", "_dot", "_ddot", "_dddot")[min(primes, 3)]
        while word in _TAKEN or keyword.iskeyword(word) or word.casefold() in taken:
            word += "_"
        taken.add(word.casefold())
        found[name] = word
    return found


def _spelled(character: str) -> str:
    if character.isascii():
        return character
    if character in _LETTERS:
        return _LETTERS[character]
    words = unicodedata.name(character, "").split()
    if words[:2] in (["GREEK", "SMALL"], ["GREEK", "CAPITAL"]) and len(words) == 4:
        return words[3].lower() if words[1] == "SMALL" else words[3].capitalize()
    return f"u{ord(character):x}"
