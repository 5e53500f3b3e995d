"""Products of two vectors, `r × v` and `cross(v, B)`, as their Cartesian components."""

from __future__ import annotations

import re
from collections.abc import Set as AbstractSet

from lagcli.reader.foreign.lengths import components
from lagcli.reader.foreign.words import UnclearText, Vocabulary
from lagcli.reader.regex import regex

#: A vector by its letter, or by its components.
_VECTOR = (
    r"(?:\\?(?:vec|mathbf|boldsymbol|bm)?\s*\{?\s*(?P<letter_N>[^\W\d]\w*)\s*\}?(?![\w'(])"
    r"|(?P<list_N>\[[^\[\]]*,[^\[\]]*\]|\([^()]*,[^()]*\)|\{[^{}]*,[^{}]*\}))"
)
_TIMES = r"(?:\s*(?:×|⨯|\\times(?!\w))\s*|\s+x\s+)"


def _vector(number: int) -> str:
    return _VECTOR.replace("_N", f"_{number}")


#: `(r × v)`, `cross(r, v)`.
_CLOSED = (
    rf"\(\s*{_vector(1)}{_TIMES}{_vector(2)}\s*\)"
    rf"|(?P<module>\w+\.)?[cC]ross\s*[(\[]\s*{_vector(5)}\s*,\s*{_vector(6)}\s*[)\]]"
)
#: A product with a factor before it.
_CROSS = regex(
    r"(?P<factor>[-+]?\s*(?:[\w./^]+(?:\s*[*·]\s*|\s+)){0,4}?)\s*"
    rf"(?:{_CLOSED}|(?<![\w)]){_vector(3)}{_TIMES}{_vector(4)})"
)
#: One of its components: `(r × p)_z`, `Cross[r, p][[3]]`, `np.cross(r, p)[2]`.
_ONE = regex(
    rf"(?<![\w.])(?:{_CLOSED})\s*"
    r"(?:\[(?P<pair>\[)?\s*(?P<index>\d)\s*\]{1,2}|[._]\{?(?P<axis>[xyz])\}?(?!\w))"
)
_SIGN = regex(r"[×⨯]|\\times|[cC]ross|\sx\s")
_LONGEST = 200
_AXES_OF = ("x", "y", "z")


def vector_product(text: str, coordinates: tuple[str, ...], known: AbstractSet[str]) -> list[str]:
    """The components of `q*(v × B)`: of a product along z alone in a plane, its only one.

    It is taken in Cartesian coordinates; empty for other texts, and where a vector is not known.
    """
    has_product = _SIGN.search(text[:_LONGEST])
    found = _CROSS.fullmatch(text.strip()) if has_product and not text[_LONGEST:] else None
    parts = _components(found, coordinates, known) if found else []
    if len(coordinates) == 2 and parts[:2] == ["0", "0"]:
        return parts[2:]
    return [part for axis, part in zip(_AXES_OF, parts, strict=False) if axis in coordinates]


def with_single_components(text: str, names: Vocabulary) -> str:
    """`x*p_y - y*p_x` for `(r × p)_z`; unclear where its index may count from 0 or from 1."""

    def written(found: re.Match[str]) -> str:
        parts = _components(found, names.coordinates, {*names.known})
        place = _AXES_OF.index(found["axis"]) if found["axis"] else int(found["index"])
        if found["pair"] or (place == 3 and not found["module"]):
            place -= 1
        elif place and not found["axis"] and not found["module"]:
            raise UnclearText
        if not 0 <= place < len(parts):
            raise UnclearText
        return parts[place] if found[0] == text.strip() else f"({parts[place]})"

    return _ONE.sub(written, text) if _SIGN.search(text[:_LONGEST]) else text


def _components(
    found: re.Match[str], coordinates: tuple[str, ...], known: AbstractSet[str]
) -> list[str]:
    """The three components of a product; empty where a vector has no known ones."""
    if len(coordinates) < 2 or not {*coordinates} <= {*_AXES_OF}:
        return []
    groups = found.groupdict()
    given = [v for name, v in groups.items() if v and name.partition("_")[0] in {"letter", "list"}]
    one, other = (_components_of(each, coordinates, known) for each in given)
    if not one or not other or not any((*one[:2], *other[:2])):
        return []  # of two numbers
    factor = groups.get("factor", "").strip().rstrip("*·").strip()
    parts = []
    for axis in range(3):
        j, k = (axis + 1) % 3, (axis + 2) % 3
        terms = [_product(one[j], other[k]), _product(one[k], other[j])]
        minus = " - " if terms[0] else "-"
        inner = terms[0] + (minus + terms[1] if terms[1] else "")
        sign = "-" if re.fullmatch(r"-[^-+]*", inner) else ""
        whole = f"({inner})" if re.search(r"[-+]", inner) and not sign else inner[len(sign) :]
        parts.append(f"{sign}{factor}*{whole}" if factor and inner else inner or "0")
    return [part.replace("--", "") for part in parts]


def along_z(text: str, known: AbstractSet[str]) -> str:
    """The vector of a product that has one component in the file; nothing for others."""
    found = _CROSS.fullmatch(text.strip())
    letters = [v for k, v in found.groupdict().items() if v and "letter" in k] if found else []
    alone = [x for x in letters if x in known and f"{x}_x" not in known and f"{x}x" not in known]
    return alone[0] if len(alone) == 1 else ""


def _components_of(
    given: str, coordinates: tuple[str, ...], known: AbstractSet[str]
) -> list[str] | None:
    """The three components of a vector: r, v and p, or others with names; None for unknown ones."""
    if given[0] not in "[({":
        names = Vocabulary(coordinates, frozenset(known - {*coordinates}))
        if any(found := components(given, names)):
            return found
        return ["", "", given] if given in known - {*coordinates} else None
    parts = [part.strip() for part in given[1:-1].split(",")]
    parts = [f"({part})" if re.search(r"\w\s*[-+]", part) else part for part in parts]
    return ["" if part == "0" else part for part in [*parts, "0"][:3]] if len(parts) <= 3 else None


def _product(one: str, other: str) -> str:
    return f"{one}*{other}" if one and other else ""
