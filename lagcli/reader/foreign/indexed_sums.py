r"""Sums over an index, each term written out: Σ_i m*x_i'^2, sum(m*x_i'^2, i=1..3)."""

from __future__ import annotations

import itertools
import re
from functools import partial

from lagcli.reader.assignments import levels
from lagcli.reader.foreign.words import UnclearText, Vocabulary, meant
from lagcli.reader.regex import outside, regex

#: The limits behind the term, in the call of a function: i=1..3, (i, 1, 3), i, 1, 3.
_CALL = regex(r"(?<![\w.])(?:\w+\.)?[sS]um\s*[(\[]")
_BEHIND = regex(
    r"(?P<term>.*?)\s*(?:,|\bfor\b)\s*[({]?\s*(?P<index>[^\W\d_])\s*"
    r"(?:[=,]|in(?P<python>\s+range)?\s*\(?)\s*(?P<first>\d+)\s*(?:\.{2,3}|…|:|,|to)\s*(?P<last>\d+)\s*\)?[)}]?",
    re.DOTALL,
)
#: The limits below and above the sign of a sum.
_SIGN = regex(
    r"(?:Σ|∑|\\sum|(?<![\w.])[sS]um(?=_))\s*(?:\\limits)?\s*"
    r"_\{?\s*(?P<index>[^\W\d_])\s*(?:=\s*(?P<first>\d+)\s*\}?\s*\^?\{?\s*(?P<last>\d+))?\s*\}?"
)
_BARE = regex(r"[Σ∑](?!\s*_)\s*")
#: An index of a name: x_i, x[i].
_INDEXED = regex(r"(?<=[^\W_])(?:_\{?|\[)(?P<index>[i-n])(?![\w])(?P<first>)")
#: One or two indices of a name: x_i, M_ij.
_LETTERS = regex(
    r"(?<![\w.\\])(?P<stem>[^\W\d_]+)_\{?(?P<index>(?=[i-n\d]*[i-n])[i-n\d]{1,2})\}?(?!\w)"
)
_SQUARED = regex(r"['’′]*\s*(?:\^\s*2|\*\*\s*2|²)")
_MOST = 12


def written_out(text: str, names: Vocabulary) -> str:
    """The text with the terms of each sum over an index in its place.

    `UnclearText` where the range of an index is neither given nor that of names with it.
    """
    text = re.sub(r"(?<=_[i-n])_dot\b", "'", text)
    if re.search(r"[Σ∑]|\b[sS]um\b", text):  # m*xi'^2 beside x1
        text = re.sub(
            r"(?<!\w)([^\W\d_]+)([i-n])(?!\w)",
            lambda m: f"{m[1]}_{m[2]}" if f"{m[1]}1" in names.known else m[0],
            text,
        )
    while called := _CALL.search(text):
        end = _closing(text, called.end())
        within = text[called.end() : end]
        inside = _BEHIND.fullmatch(within) or _INDEXED.search(within)
        if inside is None or ("term" not in inside.groupdict() and "," in within):
            return text
        terms = _terms(inside.groupdict().get("term", within), inside, names)
        text = text[: called.start()] + terms + text[end + 1 :]
    while signed := ("Σ" not in names.known and _BARE.search(text)) or _SIGN.search(text):
        end = _end_of_product(text, signed.end())
        index = (
            _INDEXED.search(text, signed.end(), end)
            if "index" not in signed.groupdict()
            else signed
        )
        if index is None:
            return text
        terms = _terms(text[signed.end() : end].strip(" *"), index, names)
        text = f"{text[: signed.start()]}{terms} {text[end:]}".rstrip()
    return _repeated(text, names) if _LETTERS.search(text) else text


def _repeated(text: str, names: Vocabulary) -> str:
    """`(1/2 M11 q1' q1' + …)` for `1/2 M_ij q_i' q_j'`: over each index that stands twice.

    A name of the file, and one of which the file has none with a number, has no index: mu_k.
    """
    counted = (re.search(r"\d+$", x) for x in names.coordinates)
    places = sorted({found[0] for found in counted if found})
    parts = re.split(r"(?<=[\w)'}²])(\s*[-+]\s*)(?![^(]*\))", text)
    for place, part in enumerate(parts[::2]):
        given = [each for each in _LETTERS.finditer(part) if each[0] not in names.known]
        written = [letter for each in given for letter in each["index"] if letter.isalpha()]
        letters = sorted({*written})
        squares = {each["index"] for each in given if _SQUARED.match(part, each.end())}
        if any(written.count(letter) < 2 and letter not in squares for letter in letters):
            continue
        if not letters or not 0 < len(places) ** len(letters) <= _MOST:
            continue
        ways = itertools.product(places, repeat=len(letters))
        chosen = [dict(zip(letters, way, strict=True)) for way in ways]
        try:
            terms = [_LETTERS.sub(partial(_numbered, way, names), part).strip() for way in chosen]
        except UnclearText:
            continue
        parts[2 * place] = f"({' + '.join(terms)})"
    return "".join(parts)


def _numbered(places: dict[str, str], names: Vocabulary, found: re.Match[str]) -> str:
    """The name of the file for M_ij; M12 also for M21."""
    index = "".join(places.get(each, each) for each in found["index"])
    spelled = [
        f"{found['stem']}{gap}{order}" for order in (index, index[::-1]) for gap in ("_", "")
    ]
    if not (named := [each for each in spelled if each in names.known]):
        raise UnclearText
    return named[0]


def _terms(term: str, limits: re.Match[str], names: Vocabulary) -> str:
    """`(m_1*x_1'^2 + m_2*x_2'^2)` for `m_i*x_i'^2`."""
    index = limits["index"]
    used = re.compile(
        rf"(?P<stem>[^\W\d_](?:\w*[^\W_])??[\u0307\u0308]?)(?:_{index}|(?:_\{{|\[)\s*{index}\s*(?P<step>[-+]\s*\d+)?\s*[\]}}])(?!\w)"
        rf"|(?<![\w.]){index}(?!\w)"
    )
    stems = {found["stem"] for found in used.finditer(term) if found["stem"]}
    if limits["first"]:
        beyond = 0 if limits.groupdict().get("python") else 1
        places = [*range(int(limits["first"]), int(limits["last"]) + beyond)]
    else:
        counted = [
            {int(n[1]) for x in names.known if (n := re.fullmatch(rf"{stem}_?(\d+)", x))}
            for stem in stems
        ]
        places = sorted(set.intersection(*filter(None, counted))) if any(counted) else []
    if not stems or not 0 < len(places) <= _MOST:
        raise UnclearText

    def at(place: int) -> str:
        def named(found: re.Match[str]) -> str:
            if not found["stem"]:
                return str(place)
            here = place + int((found["step"] or "0").replace(" ", ""))
            spelled = (f"{found['stem']}_{here}", f"{found['stem']}{here}")
            found_names = [each for each in (*spelled, found["stem"]) if each in names.known]
            name, primes = meant(f"{found['stem']}_{here}", names)
            if not found_names and primes and name in names.coordinates:
                return name + "'" * primes
            if not found_names or found_names[0] in {*names.coordinates} - {*spelled}:
                raise UnclearText
            return found_names[0]

        written = used.sub(named, term)
        return f"({written})" if re.search(r"(?<=[\w)'])\s*[-+]", outside(written)) else written

    return f"({' + '.join(map(at, places))})"


def _closing(text: str, start: int) -> int:
    """The place of the bracket that ends a call."""
    if (places := levels(text[start:])).count(-1) == 0:
        raise UnclearText
    return start + places.index(-1)


def _end_of_product(text: str, start: int) -> int:
    """Where the product ends that begins there: before + or -, or a bracket that is closed."""
    for place, level in enumerate(levels(text[start:]), start):
        begun = text[start:place].strip()
        ends = begun and text[place] in "+-−=" and begun[-1] not in "*/^_{"
        if level < 0 or (level == 0 and ends):
            return place
    return len(text)
