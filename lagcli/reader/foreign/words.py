"""What a word of a foreign formula stands for, given the names of the file."""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

from lagcli.expression import FUNCTIONS
from lagcli.notation.greek import BY_LETTER
from lagcli.reader.habits import is_angle, meanings, product_meant
from lagcli.reader.suggest import alike

_DOTS = {"\u0307": 1, "\u0308": 2}
#: Letters that are a velocity of the only coordinate: v of x, ω of an angle.
VELOCITIES = frozenset({"v", "velocity", "speed", "omega", "ω"})


class Unclear(Exception):
    """The text means nothing that is known, or may mean two things."""


class Vocabulary(NamedTuple):
    """The names of a file."""

    coordinates: tuple[str, ...]
    others: frozenset[str]  #: parameters, definitions, multipliers, t and pi
    functions: frozenset[str] = frozenset()
    momenta: bool = False

    @property
    def known(self) -> tuple[str, ...]:
        """Everything that may stand alone."""
        momenta = [f"p_{each}" for each in self.coordinates] if self.momenta else []
        return (*self.coordinates, *self.others, *momenta)


def meant(word: str, names: Vocabulary) -> tuple[str, int]:
    """The name of the file that a word stands for, and the primes that belong to it."""
    known = names.known
    plain = word
    primes = 0
    if word not in known:
        apart = unicodedata.normalize("NFD", word)
        primes = sum(_DOTS.get(each, 0) for each in apart)
        plain = unicodedata.normalize("NFC", "".join(e for e in apart if e not in _DOTS))
        plain = re.sub(r"[₀-₉]+", lambda m: "_" + unicodedata.normalize("NFKC", m[0]), plain)
    numbered = re.sub(r"(\D)(\d+)$", r"\1_\2", plain)
    for spelled in (plain, plain.replace("_", ""), numbered, plain.removeprefix("var")):
        if spelled in known:
            return spelled, primes
        same = alike(spelled, known)
        if same and same.casefold() != spelled.casefold():  # M is another mass than m
            return same, primes
    if plain in meanings("functions") and meanings("functions")[plain] == "pi":
        return "pi", primes
    rate = rate_meant(plain, names)
    in_full = "".join(BY_LETTER.get(letter, letter) for letter in plain)
    short = plain if len(plain) < 9 else ""
    product = product_meant(short, known) or (product_meant(in_full, known) if short else "")
    if rate and product:
        raise Unclear
    return rate or (product or plain, primes)


def function_named(word: str, names: Vocabulary) -> str:
    """The function of the format that a word stands for: `asin` for ArcSin."""
    if word in names.known:
        return ""
    usual = meanings("functions")
    for spelled in (word, word.casefold(), word.casefold().replace("arc", "a", 1)):
        if (name := usual.get(spelled, spelled)) in FUNCTIONS:
            return name
    return ""


def rate_meant(word: str, names: Vocabulary) -> tuple[str, int] | None:
    """`x` and 1 for xdot, dx, vx, v_x, omega and the like."""
    found = {
        (x, order)
        for x in names.coordinates
        for order, forms in enumerate(_rates(x), start=1)
        if word in forms
    }
    if len(names.coordinates) == 1:
        (x,) = names.coordinates
        if word in VELOCITIES and (word in {"omega", "ω"}) == is_angle(x):
            found.add((x, 1))
        if names.momenta and word in {"p", "P"}:
            found.add((f"p_{x}", 0))
    if names.momenta:
        found |= {(f"p_{x}", 0) for x in names.coordinates if word in _momenta(x)}
    return found.pop() if len(found) == 1 else None


def _momenta(x: str) -> set[str]:
    """How others write p_x: px, and p1 for p_q1."""
    index = re.sub(r"^\D*", "", x)
    return {f"p{x}", *({f"p{index}", f"p_{index}"} if index else ())}


def _rates(x: str) -> tuple[set[str], set[str]]:
    """How others write x' and x''."""
    stem, _, index = x.partition("_")
    first = {f"{x}{dot}" for dot in ("dot", "_dot", "_d", "d", "p", "_t", "Dot", "_prime")}
    first |= {f"{dot}{x}" for dot in ("d", "v", "v_", "D", "d_", "dot_", "dot")}
    second = {f"{x}{dot}" for dot in ("ddot", "_ddot", "dd", "_dd", "pp", "_tt")}
    second |= {f"{dot}{x}" for dot in ("dd", "a", "a_", "ddot_", "ddot")}
    if index:
        first |= {f"{stem}dot_{index}", f"{stem}dot{index}", f"{stem}_dot_{index}"}
    return first, second
