"""Vectors by their letters within a formula, by Cartesian components: v², |r1 - r2|, A·v."""

from __future__ import annotations

import re

from lagcli.reader.foreign.words import UnclearText, Vocabulary, polar_speed
from lagcli.reader.near import Near, near
from lagcli.reader.regex import regex

_BOLD = r"\\(?:vec|mathbf|boldsymbol|bm)\s*"
#: A vector with its primes, and the difference of two.
_LETTER = rf"(?:{_BOLD})?\{{?\s*([^\W\d]\w*?)\s*\}}?_?\{{?(\d?)\}}?\s*\}}?('*)"
_VECTORS = regex(rf"\s*{_LETTER}(?:\s*[-−,]\s*{_LETTER})?\s*")
_SQUARED = r"\s*(?:(?:\^|\*\*)\s*\{?2\}?|²)(?!\w)"
#: The length of a vector, or the square of it: |r|, ||v||^2, norm(r1 - r2).
_LENGTH = regex(
    r"(?:(?:\\?\||‖){1,2}(?P<bars>[^|‖()+*/]+?)(?:\\?\||‖){1,2}"
    r"|\b(?:\w+\.)*(?:norm|abs|length|mag|dist|distance)\((?P<called>[^()+*/]+)\))"
    rf"(?P<square>{_SQUARED})?"
)
#: The square of a vector or of a speed: v², ṙ², \vec{r}^2, v.v; the word for a speed alone.
_SQUARE = regex(
    rf"(?<![\w.|\\])(?:{_BOLD}\{{?(?P<bold>[a-z])\}}?|(?:v|speed|(?P<rate>ṙ|r['’′])))(?:{_SQUARED}|\s*\.\s*v(?!\w))"
    r"|(?<![\w.])(?P<speed>speed)(?!\w)"
)
#: A product of vectors in brackets.
_IN_BRACKETS = regex(
    r"[(\[]([^()\[\]]+,[^()\[\]]+)[)\]]\s*[.·]\s*[(\[]([^()\[\]]+,[^()\[\]]+)[)\]]"
)
_ONE = rf"\\?(?:{_BOLD[2:]})?\{{?\s*([^\W\d_]'*)\s*\}}?"
#: A product of two vectors by their letters: A·v, dot(A, v), \vec{A}\cdot\vec{v}.
_DOT = r"(?:[·⋅∙•]|\\cdot(?![a-z])|\s\.\s|(?<=[vr])\.(?=[A-Z]\b)|(?<=[A-Z])\.(?=[vr]\b))"
_PRODUCT = regex(
    rf"(?<![\w.}}]){_ONE}\s*{_DOT}\s*{_ONE}(?![\w'(])"
    rf"|(?<![\w.])(?:\w+\.)?dot\(\s*{_ONE}\s*,\s*{_ONE}\s*\)"
)
#: The components of a position, a velocity and a momentum.
_USUAL = {"r": "{}", "v": "{}'", "p": "p_{}"}


def components(word: str, names: Vocabulary) -> list[str]:
    """The components of r and v, of r1, of a point of the file, and of A beside A_x and A_y.

    One that the file does not have is empty; all are where the word is no vector.
    """
    word = word.replace("ṙ", "r'")
    bare = word.rstrip("'")
    primes = word[len(bare) :]
    stem, index = re.sub(r"_?\d*$", "", bare), re.sub(r"^\D*", "", bare)
    if f"{bare}.x" in names.components:
        places = [f"{bare}.{x}" for x in "xyz"]
        found = [names.components.get(at, "") for at in places]
        named = [at.replace(".", "_") for at in places]  # of a vector of the file
        found = [x if x in names.known else each for x, each in zip(named, found, strict=True)]
        return [component(each, primes, names) if each else "" for each in found]
    is_cartesian = len(names.coordinates) > 1 and {*names.coordinates} <= {*"xyz"}
    if stem in _USUAL and bare not in names.known and (index or is_cartesian):
        spelled = [(f"{x}{index}", f"{x}_{index}" if index else x) for x in "xyz"]
        axes = [next((x for x in each if x in names.coordinates), "") for each in spelled]
        return [_USUAL[stem].format(x) + primes if x else "" for x in axes]
    spelled = [(f"{bare}_{x}", f"{bare}{x}") for x in "xyz"]
    axes = [next((x for x in each if x in names.known), "") for each in spelled]
    return [(x + primes) * bool(x) for x in axes]


def component(formula: str, primes: str, names: Vocabulary) -> str:
    """A component of a point, in parentheses; its total time derivative where it has a prime."""
    if not primes or formula.isidentifier():
        return formula + primes if formula.isidentifier() else f"({formula})"
    values = {x: Near(x) for x in re.findall(r"[^\W\d]\w*", formula)}
    values |= {x: Near(x, f"{x}'") for x in names.coordinates} | {"t": Near("t", "1")}
    if len(primes) > 1 or {*names.moving} & values.keys():
        raise UnclearText
    try:
        return f"({near(formula, values).rate})"
    except (KeyError, ArithmeticError, ValueError):
        raise UnclearText from None


def _squares(text: str, names: Vocabulary) -> str:
    """The sum of squares of a vector, or of the difference of two; nothing for other texts."""
    found = _VECTORS.fullmatch(text)
    if found is None:
        return ""
    one, other = ("".join(each or "" for each in found.groups()[k : k + 3]) for k in (0, 3))
    is_speed = one == "v" and not other and "v" not in names.known and names.coordinates[1:]
    if is_speed and (squares := polar_speed(names.coordinates)):
        return squares
    ends = [components(each, names) for each in (one, other) if each]
    pairs = [each for each in zip(*ends, strict=True) if all(each)]
    parts = [f"({' - '.join(each)})^2" if each[1:] else f"{each[0]}^2"
             for each in pairs if {*each} != {"0"}]  # fmt: skip
    return " + ".join(parts) if len(pairs) > 1 else ""


def with_components(text: str, names: Vocabulary) -> str:
    """The text with the lengths and the squares of vectors by their components."""

    def length(found: re.Match[str]) -> str:
        squares = _squares(found["bars"] or found["called"], names)
        root = "" if found["square"] else "sqrt"
        return f" {root}({squares}) " if squares else found[0]

    def square(found: re.Match[str]) -> str:
        squares = _squares(found["bold"] or ("r'" if found["rate"] else "v"), names)
        root = "sqrt" if found["speed"] else ""
        return f" {root}({squares}) " if squares else found[0]

    text = _IN_BRACKETS.sub(_by_components, text)
    return _SQUARE.sub(square, _LENGTH.sub(length, text))


def _by_components(found: re.Match[str]) -> str:
    """`(a*c + b*d)` for `(a, b).(c, d)`."""
    left, right = (each.split(",") for each in found.groups())
    if len(left) != len(right):
        return found[0]
    terms = (f"({a.strip()})*({b.strip()})" for a, b in zip(left, right, strict=True))
    return f"({' + '.join(terms)})"


def with_products(text: str, names: Vocabulary) -> str:
    """`(A_x*x' + A_y*y')` for A·v, where A has components in the file."""

    def written(found: re.Match[str]) -> str:
        letters = [each for each in found.groups() if each]
        one, two = (components(each, names) for each in letters)
        pairs = [pair for pair in zip(one, two, strict=True) if all(pair)]
        if not pairs and {*letters} & {"r", "v", "r'"} - {*names.known}:
            raise UnclearText  # E·r, where E has no components
        return f"({' + '.join(map('*'.join, pairs))})" if pairs else found[0]

    return _PRODUCT.sub(written, text)
