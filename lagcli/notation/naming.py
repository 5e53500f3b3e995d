"""The parts of a name (`theta_1` is θ with subscript 1, as `theta1`), and names that are free."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence

from lagcli.notation.greek import BY_LETTER
from lagcli.record import record

#: What a letter of ours gets where the file has the letter: L_sys.
INDEX = "sys"
#: Stems of the names of parts; χ where the file has a k, since k₁ would be taken for one more.
PART_STEMS = ("k", "chi", "shared")
_LETTERS_AND_DIGITS = re.compile(r"(?P<letters>.*[^0-9])(?P<digits>[0-9]*)", re.DOTALL)
_BEFORE_DIGITS = re.compile(r"(?<=[^\d_])(?=\d)")
#: A letter and its index written together, `Rc`; but `th` is how theta is shortened.
_LETTER_AND_INDEX = re.compile(r"^([^\W\d_])([bcdfgjknqrvwxyz])(?=_|$)")
_SETTING = re.compile(r"\\(?:math[a-z]+|text|textrm|operatorname|[,;: ])|[\\{}\s]")


@record
class NameParts:
    """A letter or word with its subscripts."""

    base: str
    subscripts: tuple[str, ...] = ()


def name_parts(name: str) -> NameParts:
    """Split a name at its underscores and before the digits or the index of its first part.

    A name whose underscores separate nothing (`_x`, `x__y`) is left whole.

    Examples
    --------
    >>> name_parts("theta_1"), name_parts("m12")
    (NameParts(base='theta', subscripts=('1',)), NameParts(base='m', subscripts=('12',)))
    >>> name_parts("Rc")
    NameParts(base='R', subscripts=('c',))
    """
    first, *others = _LETTER_AND_INDEX.sub(r"\1_\2", name).split("_")
    match = _LETTERS_AND_DIGITS.fullmatch(first)
    if match is None or not all(others):
        return NameParts(name)
    digits = match["digits"]
    return NameParts(match["letters"], (*((digits,) if digits else ()), *others))


class Names(Collection[str]):
    r"""Names, of which those that are typeset alike count as one.

    `alpha1` is typeset as `alpha_1`, a name written ω as `omega`, and so is a name whose symbol
    the file gives as `\omega`.
    """

    def __init__(self, names: Iterable[str] = ()) -> None:
        self._names = {*map(_typeset_as, names)}

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and _typeset_as(name) in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def add(self, *names: str) -> None:
        """Have these names, too."""
        self._names.update(map(_typeset_as, names))


def _typeset_as(name: str) -> str:
    spelled = "".join(BY_LETTER.get(c, c) for c in _SETTING.sub("", name).replace(",", "_"))
    return _LETTER_AND_INDEX.sub(r"\1_\2", _BEFORE_DIGITS.sub("_", spelled))


def free(taken: Collection[str], *choices: str) -> str:
    """The first of the names that is not taken; the first with an index where all of them are."""
    found = next((x for x in choices if x not in taken), choices[0])
    while found in taken:
        found += f"_{INDEX}"
    return found


def free_stem(stems: Sequence[str], taken: Collection[str]) -> str:
    """The first stem with which no name of the file begins before its digits."""
    used = {name.rstrip("0123456789_") for name in taken}
    for stem in stems:
        if stem not in used:
            return stem
    stem = stems[0]
    while stem in used:
        stem += stems[0]
    return stem
