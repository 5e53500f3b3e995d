"""Vectors in the notation of books and other programs, as a list of their components."""

from __future__ import annotations

import re
from collections.abc import Container

from lagcli.reader.assignments import levels
from lagcli.reader.foreign.functions import bare_text
from lagcli.reader.regex import balanced, regex
from lagcli.reader.text import as_sum

#: One axis by its index, its letter or i, j, k.
_AXES = {"1": 0, "2": 1, "3": 2, "x": 0, "y": 1, "z": 2, "i": 0, "j": 1, "k": 2}
_HATS = str.maketrans({"î": "i", "ĵ": "j", "ẑ": "z", "ŷ": "y"})
_UNIT = (
    r"(?:[A-Z]\.(?P<frame>[xyz])|\\(?:hat|vec|mathbf)\s*\{?\\?(?P<hat>[xyzijk])(?:math)?\}?"
    r"|(?:\\?(?:vec|hat|mathbf)?\{?\\?)?(?:e|u|unit)_?\{?(?P<e>[xyz123])\}?\}?|(?P<word>[xyzijk])_?hat"
    r"|(?P<letter>[ijk]))"
)
_BEHIND = regex(rf"(?P<rest>.*?)\s*\*?\s*(?<![\w.]){_UNIT}\s*")
_BEFORE = regex(rf"(?P<sign>[-+]?)\s*{_UNIT}(?:\s*\*\s*|\s+)(?P<rest>.+)")
_TERMS = r"(?<=[\w)\]}])\s*(?=[-+])"
#: A blank between two closed expressions, of which the second may have a sign.
_GAP = r"(?<=[\w)'²³]) (?=[-+−]?[\w(])"
#: A constructor with its components, and brackets of a vector.
_MADE = regex(
    r"(?:(?:\w+\.)?(?:array|Matrix|[vV]ector|vec|[pP]oint|list|tuple|Vec[23]d?)\s*\(\s*(.*)\))"
    r"|<(.*)>|⟨(.*)⟩|\\begin\{\w*(?:matrix|array)\}(.*)\\end\{\w*(?:matrix|array)\}",
    re.DOTALL,
)
#: `F in x direction`, `-m*g along y`.
_IN_WORDS = regex(
    r"(?P<rest>[^,]+?)\s+(?:in|along|to)\s+(?:the\s+)?(?:direction\s+(?:of\s+)?)?(?P<axis>[xyz])"
    r"(?:[- ]?(?:direction|axis))?"
)
#: `m*g down`, `F (nach links)`: along the first axis, or the last one, with its sign.
_DIRECTIONS = {
    "down(?:wards?)?|unten|abwärts|bas|abajo": (-1, "-"),
    "up(?:wards?)?|oben|aufwärts|haut|arriba": (-1, ""),
    "left(?:wards?)?|links|gauche|izquierda": (0, "-"),
    "right(?:wards?)?|rechts|droite|derecha": (0, ""),
}
_DIRECTION = (
    r"(?:(?:directed|pointing|acting|straight|vertically|horizontally|to\s+the|nach"
    r"|vers\s+l[ea]|à|hacia|a\s+la)\s+)*(?:{})"
)


def _directed(text: str, known: Container[str], length: int) -> list[str]:
    """`0` and `-m*g` for `m*g down` in a plane; empty for other texts."""
    for words, (axis, sign) in _DIRECTIONS.items():
        named = _DIRECTION.format(words)
        found = re.fullmatch(
            rf"(?P<law>.*?[^\s,(])[\s,]+\(?{named}\)?|{named}\s+(?P<behind>.+)", text
        )
        law = (found["law"] or found["behind"]) if found else ""
        told = re.findall(r"[^\W\d]+", text.replace(law, "")) if law else []
        if law and not any(word in known for word in told):
            law = law.lstrip("-− ")
            law = f"({law})" if sign and re.search(r"\S\s*[-+]", law) else law
            axes = ["0"] * (length or 2)
            axes[axis] = sign + law
            return axes
    return []


def components(text: str, known: Container[str], length: int = 0) -> list[str]:
    """The components of `a*N.x + b*N.y`, `a i + b j`, `<a, b>`, `l*(a, b)`, `np.array([a, b])`.

    Those that are not written are 0 where the `length` is known.  No name that is `known` is a unit
    vector.  Empty where the text is no vector.
    """
    text = " ".join(text.translate(_HATS).replace("x\u0302", "xhat").split())
    if told := _IN_WORDS.fullmatch(text):
        axis = _AXES[told["axis"]]
        return [told["rest"] if k == axis else "0" for k in range(max(length, axis + 1, 2))]
    if directed := _directed(text, known, length):
        return directed
    if made := _MADE.fullmatch(text):
        inside = next(each for each in made.groups() if each is not None)
        listed = re.sub(r"^[\[(](.*)[\])]$", r"\1", inside.strip())
        return [re.sub(r"^\[(.*)\]$", r"\1", each) for each in _split(listed, r",|;|&|\\\\")]
    if scaled := _scaled_list(text):
        return scaled
    return _of_unit_vectors(text, known, length)


def with_commas(text: str, coordinates: Container[str]) -> str:
    """What is written for `x -l*cos(a)`, in which blanks separate components.

    They do where each part has a sign, or is no factor of a product: `x y`.  Empty for one part.
    """
    text = bare_text(" ".join(text.split()))
    parts = _split(text, _GAP)
    signed = [re.match("[-+−]", each) is not None for each in parts[1:]]
    whole = [each in coordinates or re.search(r"[*\d]", each) for each in parts]
    if "," in text or not signed:
        return ""
    if (all(signed) or all(whole)) and not parts[3:]:
        listed = ", ".join(each.removeprefix("+") for each in parts)
        return f"a comma stands between components: write [{listed}]"
    return "a comma stands between components, as in [x, y]"


def of_listed(texts: list[str], known: Container[str]) -> list[str]:
    """The components of `[a i, b j]`, each with its unit vector; empty for others."""
    found = [_term(text, known) for text in texts]
    if len(texts) > 1 and [each[0] if each else None for each in found] == [*range(len(texts))]:
        return [each[1] for each in found if each]
    return []


def _scaled_list(text: str) -> list[str]:
    """The components of `l*(a, b)` and `l*[a, b]`."""
    for product in re.finditer(r"\s*\*\s*(?:\((?=.*\)$)|\[(?=.*\]$))", text):
        factor, inside = text[: product.start()], text[product.end() : -1]
        if balanced(factor) and balanced(inside) and len(_split(factor, _TERMS)) == 1:
            parts = _split(inside, ",")
            return [_scaled(factor, part) for part in parts] if len(parts) > 1 else []
    return []


def _of_unit_vectors(text: str, known: Container[str], length: int) -> list[str]:
    terms = [re.sub(r"^([-+])\s+", r"\1", each) for each in _split(text, _TERMS)]
    found: dict[int, list[str]] = {}
    for term in terms:
        part = _term(term, known)
        if part is None or 0 < length <= part[0]:
            return []
        found.setdefault(part[0], []).append(part[1])
    if len(terms) < 2 and not length:
        return []
    size = max(length, *(axis + 1 for axis in found))
    return [as_sum(found.get(axis, ["0"])) for axis in range(size)]


def _term(text: str, known: Container[str]) -> tuple[int, str] | None:
    """The axis of `-l*cos(theta) j` and what stands before it."""
    text = text.strip()
    found = _BEHIND.fullmatch(text) or _BEFORE.fullmatch(text)
    if found is None:
        return None
    groups = found.groupdict()
    if groups["letter"] in known:
        return None
    axis = next(v for k, v in groups.items() if k not in {"rest", "sign"} and v is not None)
    rest = (groups.get("sign") or "").replace("+", "") + groups["rest"].strip().removeprefix("+")
    rest = bare_text(rest) if re.fullmatch(r"\([^-+]*\)", rest) else rest
    return _AXES[axis], (rest + "1" if rest in {"", "-"} else rest)


def _scaled(factor: str, part: str) -> str:
    part = part.strip()
    if part == "0":
        return part
    sign = "-" if re.fullmatch(r"-[^-+]*", part) else ""
    part = part.removeprefix(sign)
    return f"{sign}{factor}*{part}" if not re.search(r"[-+]", part) else f"{factor}*({part})"


def _split(text: str, between: str) -> list[str]:
    """At what stands between, outside of parentheses."""
    parts, begin, open_ = [], 0, levels(text)
    for found in re.finditer(between, text):
        if 0 < found.end() < len(text) and open_[max(0, found.start() - 1)] == 0:
            parts.append(text[begin : found.start()])
            begin = found.end()
    return [part.strip() for part in [*parts, text[begin:]]]
