"""What a word of a foreign formula stands for, given the names of the file."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from lagcli.expression import FUNCTIONS
from lagcli.notation.greek import BY_NAME
from lagcli.reader.habits import instead, is_angle, meanings
from lagcli.reader.regex import regex
from lagcli.reader.suggest import alike, spelled_out

_DOTS = {"\u0307": 1, "\u0308": 2}
#: Before a coordinate; the speed along an angle is r theta', where there is an r.
_SPEEDS = ("v", "v_")
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
#: Letters that are a velocity of the only coordinate: v of x, ω of an angle.
VELOCITIES = frozenset({"v", "velocity", "speed", "omega", "ω"})
#: A longer word is no product; one of Latin letters without a function is none that is as long.
_LONGEST, _LETTERS = 40, 8
_GREEK = regex(r"^[A-Za-z]+")
#: A dot in the words of other languages, behind its coordinate.
_DOT_WORDS = ("punkt", "point", "punto", "ponto", "kropka", "punt", "tochka", "vel", "rate")


class UnclearText(Exception):
    """The text means nothing that is known, or may mean two things."""


class Vocabulary(NamedTuple):
    """The names of a file."""

    coordinates: tuple[str, ...]
    others: frozenset[str]  #: parameters, definitions, multipliers, t and pi
    functions: frozenset[str] = frozenset()
    momenta: bool = False
    components: Mapping[str, str] = {}  #: of points: what `bob.x` is written as
    moving: tuple[str, ...] = ()  #: definitions that depend on coordinates or on the time
    related: bool = False  #: in an equation, where v = ω R relates the velocities
    turning: str = ""  #: in an energy, the angle that has no velocity yet, whose is ω

    @property
    def known(self) -> tuple[str, ...]:
        """Everything that may stand alone."""
        momenta = [f"p_{each}" for each in self.coordinates] if self.momenta else []
        return (*self.coordinates, *self.others, *momenta)

    @property
    def dependent(self) -> tuple[str, ...]:
        """What has a velocity."""
        return (*self.coordinates, *self.moving)


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
        if same and (len(same) > 2 or same.casefold() != spelled.casefold()):
            return same, primes  # M is another mass than m
    if plain in meanings("functions") and meanings("functions")[plain] == "pi":
        return "pi", primes
    return rate_meant(plain, names) or (plain, primes)


def parts_of(word: str, names: Vocabulary) -> list[str]:
    """The letters of `mgl` and of `mlẋθ̇cosθ`; the word itself where it is no product of them."""
    if word in {*names.known, *names.functions} or function_named(word, names):
        return [word]
    apart = re.sub("([\u0307\u0308]+)([₀-₉]+)", r"\2\1", unicodedata.normalize("NFD", word))
    letters = {_GREEK.sub(lambda m: BY_NAME.get(m[0], m[0]), each) for each in names.known}
    lowered = {each.replace("_", "").translate(_LOWERED) for each in names.known}
    spelled = {*names.known, *letters, *lowered, *FUNCTIONS} - {""}  # of the name _
    longest_first = sorted(spelled, key=len, reverse=True)

    def split(text: str) -> list[str] | None:
        if not text:
            return []
        for each in (unicodedata.normalize("NFD", name) for name in longest_first):
            end = len(each)
            while text.startswith(each) and text[end : end + 1] in _DOTS and end < len(text):
                end += 1
            if text.startswith(each) and (rest := split(text[end:])) is not None:
                return [unicodedata.normalize("NFC", text[:end]), *rest]
        return None

    letter = word.removesuffix("t")
    if len(letter) == 1 and not letter.isascii() and len(word) == 2:
        return [letter, "t"]  # ωt
    found = split(apart) if len(apart) <= _LONGEST else None
    is_long = word.isascii() and len(word) > _LETTERS and not any(map(word.__contains__, FUNCTIONS))
    return [word] if found is None or is_long else found


def function_named(word: str, names: Vocabulary) -> str:
    """The function of the format that a word stands for: `asin` for ArcSin."""
    if word in names.known or instead(word):
        return ""
    usual = meanings("functions")
    for spelled in (word, word.casefold(), word.casefold().replace("arc", "a", 1)):
        if (name := usual.get(spelled, spelled)) in FUNCTIONS:
            return name
    return ""


def rate_meant(word: str, names: Vocabulary) -> tuple[str, int] | None:
    """`x` and 1 for xdot, dx, vx, v_x, omega and the like."""
    apart = unicodedata.normalize("NFD", word)
    dots = sum(_DOTS.get(each, 0) for each in apart)
    plain = "".join(each for each in apart if each not in _DOTS)
    if dots and plain in names.dependent:
        return plain, dots
    word = spelled_out(word)
    radial = any(x.partition("_")[0] in {"r", "rho", "ρ", "s"} for x in names.coordinates)
    found = {
        (x, order)
        for x in names.dependent
        for order, forms in enumerate(_rates(spelled_out(x)), start=1)
        if word in forms
        and not (radial and is_angle(x) and word.removesuffix(spelled_out(x)) in _SPEEDS)
    }
    alone = len(names.coordinates) == 1
    if word in VELOCITIES and (names.related or alone):
        turns = word in {"omega", "ω"}
        alike = [x for x in names.coordinates if is_angle(x) == turns]
        polar = radial and not ({"s", *alike} == {"s"} and "z" not in names.coordinates)
        found |= {(x, 1) for x in alike if len(alike) == 1 and (alone or turns or not polar)}
    if names.turning and word in {"omega", "Omega", "w"}:
        found.add((names.turning, 1))
    if alone and names.coordinates[0] in {"q", "Q"} and word in {"i", "I"}:  # a current
        found.add((names.coordinates[0], 1))
    if names.momenta and alone and word in {"p", "P"}:
        found.add((f"p_{names.coordinates[0]}", 0))
    if names.momenta and alone and word in {"q", "Q"}:
        found.add((names.coordinates[0], 0))
    if names.momenta:
        found |= {(f"p_{x}", 0) for x in names.coordinates if word in _momenta(spelled_out(x))}
    return found.pop() if len(found) == 1 else None


def square_of_speed(coordinates: tuple[str, ...]) -> str:
    """The square of the speed in Cartesian or polar coordinates; else nothing."""
    cartesian = {*coordinates} <= {*"xyz"}
    return " + ".join(f"{x}'^2" for x in coordinates) if cartesian else polar_speed(coordinates)


def polar_speed(coordinates: tuple[str, ...]) -> str:
    """The square of the speed in polar, cylindrical or spherical coordinates; else nothing."""
    r, *others = coordinates
    angles = [x for x in others if is_angle(x)]
    if r not in {"r", "rho", "ρ"} or len(others) - len(angles) > 1 or not angles:
        return ""
    if len(angles) == 2 == len(others) and angles[0] in {"theta", "θ"}:
        return f"{r}'^2 + {r}^2*{angles[0]}'^2 + {r}^2*sin({angles[0]})^2*{angles[1]}'^2"
    if len(angles) == 1 and {*others} <= {*angles, "z"}:
        return f"{r}'^2 + {r}^2*{angles[0]}'^2" + " + z'^2" * ("z" in others)
    return ""


def momentum_meant(word: str, coordinates: Sequence[str]) -> str:
    """The coordinate whose momentum is called px, p_1 or, of the only one, p; else nothing."""
    found = [x for x in coordinates if spelled_out(word) in {f"p_{x}", *_momenta(spelled_out(x))}]
    found += [*coordinates] if word in {"p", "P"} and len(coordinates) == 1 else []
    return found[0] if len(found) == 1 else ""


def _momenta(x: str) -> set[str]:
    """How others write p_x: px, and p1 for p_q1."""
    index = re.sub(r"^\D*", "", x)
    return {f"p{x}", *({f"p{index}", f"p_{index}"} if index else ())}


def _rates(x: str) -> tuple[set[str], set[str]]:
    """How others write x' and x''."""
    stem, _, index = x.partition("_")
    numbered = re.fullmatch(r"(\D+?)_?(\d+)", x)
    first = {f"{x}{dot}" for dot in ("dot", "_dot", "_d", "d", "p", "_t", "Dot", "_prime")}
    first |= {
        f"{dot}{x}" for dot in ("d", "D", "d_", "δ", "delta", "delta_", "dot_", "dot", *_SPEEDS)
    }
    first |= {f"{x}{gap}{word}" for word in _DOT_WORDS for gap in ("", "_")}
    second = {f"{x}{dot}" for dot in ("ddot", "_ddot", "dd", "_dd", "pp", "_tt")}
    second |= {f"{dot}{x}" for dot in ("dd", "a", "a_", "ddot_", "ddot")}
    if numbered:
        first |= {f"{numbered[1]}{dot}{numbered[2]}" for dot in ("d", "_d", "dot", "_dot")}
        other = "i" if stem.rstrip("0123456789") == "q" else "v"  # of a charge, of a length
        letters = ("omega", "w") if is_angle(x) else (other,)
        first |= {f"{letter}{gap}{numbered[2]}" for letter in letters for gap in ("", "_")}
    if index:
        first |= {f"{stem}dot_{index}", f"{stem}dot{index}", f"{stem}_dot_{index}"}
    return first, second
