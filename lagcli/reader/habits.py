"""What people write from the habit of a book or another program, and what it is here.

Each table has one kind of habit, those of single words in `habits.json`; the reader looks into
it before it searches for names that are spelled alike.
"""

from __future__ import annotations

import json
import re
import unicodedata
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

from lagcli.reader.assignments import assigned
from lagcli.reader.regex import regex

#: The keys of a problem.
KEYS = (
    "title", "source", "description", "coordinates", "parameters", "functions", "definitions",
    "points", "T", "V", "L", "H", "forces", "dissipation", "constraints", "contacts", "symmetries",
    "observables", "brackets", "canonical_transformations", "initial", "find", "simulation",
    "picture", "expect",
)  # fmt: skip
#: Keys whose value is a map or a list.
MAPS = frozenset(
    "coordinates parameters functions definitions points forces constraints contacts symmetries "
    "initial find simulation expect".split()
)
#: The keys whose value is a list.
LISTS = frozenset("position force in_terms_of columns".split())
DERIVED = "the equations of motion are derived: give T and V, or L"
#: An assumption by the relation to zero that it is.
SIGNS = {">": "positive", "<": "negative", ">=": "nonnegative", "≥": "nonnegative",
         "!=": "nonzero", "≠": "nonzero"}  # fmt: skip
#: The relations of Fortran.
RELATIONS = {rf"\.(?i:{word})\.": sign for word, sign in
             (("ge", ">="), ("gt", ">"), ("le", "<="), ("lt", "<"), ("eq", "="))}  # fmt: skip
_AND = regex(r"\s*(?:\.(?i:and)\.|&&|(?<=\s)(?i:and|und)(?=\s))\s*")
#: `0 <= x < 1`, and the relation of both sides exchanged.
_BETWEEN = regex(r"^([^<>≤≥]+?)\s*([<>]=?|[≤≥])\s*([^<>≤≥]+?)\s*([<>]=?|[≤≥])\s*([^<>≤≥]+)$")
TURNED = str.maketrans("<>≤≥", "><≥≤")
COMMENT = "a comment begins with '#'"
PROGRAM = "a problem has keys with their values, as in coordinates: [x], and no program"
CASES = frozenset("if for when where else otherwise piecewise Piecewise".split())
#: At least three words with one that is no quantity, at the end of a formula.
REMARK = regex(
    r"[-+*/^)\d'’]\s+(?=.*\b(?:of|the|for|in|with|is|energy|force|der|die|das|des|von|und|de|la|le|du|et)\b)"
    r"(?:[-–—:]\s+)?[^\W\d]{2,}(?:\s+[^\W\d]+){2,}\.?\s*$"
    r"|(?<=[\w)'’])\s+in\s+[\[(]?[^\W\d][^\s()]*[\])]?\s*$"
)
CASE = "(1 + sign(x))/2 is 1 for x > 0, else 0"
_NUMBER = regex(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(/\d+)?")
#: A number with a unit behind it, as in `10 kg` and `9.81 m/s^2`.
_WITH_UNIT = regex(
    r"[-+]?[\d.]+(?:[eE][-+]?\d+|/\d+)?\s*(?:[,;]\s+)?"
    r"(?P<unit>(?:[kmcµunp]?(?:m|g|s|N|J|W|Hz|A|V|K|C|T|Pa|F|H|Wb|Ω|ohm)"
    r"|rad|deg|rpm|min|h|mol|1/min|1/s|turn)(?:[ \^*/·⋅²³].*)?)"
)
#: Symbols of units with their powers, strung together: `ms-2`, `kg m2 s-2`.
_SYMBOL = regex(r"(kg|mol|rad|Pa|Hz|[mgsNJWKAVC])(-?)(\d?)")
_STRUNG = regex(rf"(?=.*[A-Za-z]-\d)(?:(?:{_SYMBOL.pattern})[ ·.]?)+")
#: A value that is left open.
_OPEN = regex(
    r"(?i:[?¿…_.*–—-]+|none|any|arbitrary|const|constant|free|given|null|open|symbolic|tb[ad]|true"
    r"|unknown|wanted|yes|gesucht|gegeben|unbekannt|beliebig|frei|inconnue?|libre|quelconque"
    r"|desconocid[oa]|dad[oa]|incognit[oa]|not[oa])"
)
_ANGLES = frozenset("theta th phi ph psi alpha beta gamma varphi angle θ φ ϕ ψ α β γ".split())
_SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
#: How often a function differentiates.
RATES = {**dict.fromkeys("Derivative derivative D ddt dt Dt der deriv diff dot".split(), 1),
         "ddot": 2}  # fmt: skip
POWERS = frozenset("POWER POTENZ PUISSANCE pow power Pow Power".split())
SQUARES = frozenset("square sqr sq".split())
FOREIGN = RATES.keys() | POWERS | SQUARES | {"norm", "hypot"}
VULGAR = "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
#: `12½` and `1 1/2`.
_MIXED = regex(rf"(?<![\w.^*/'])(\d+)\s*(?:([{VULGAR}])|(?<=\s)(\d/\d\d?)(?![\w.^]))")


@cache
def habits() -> dict[str, Any]:
    """The tables in `habits.json`: words by what is meant, and rows of forms with their advice."""
    text = Path(__file__).with_name("habits.json").read_text("utf-8")
    tables: dict[str, Any] = json.loads(text)
    return tables


@cache
def spellings(table: str, part: str = "") -> dict[str, str]:
    """What each word of a table means here, by its letters.

    With `part`, of the tables in it whose names have that word.
    """
    found = habits()[table]
    tables = [each for names, each in found.items() if part in names.split()] or [found]
    pairs = (pair for each in tables for pair in each.items())
    return {letters(word): meant for meant, words in pairs for word in words}


@cache
def meanings(table: str) -> dict[str, str]:
    """What each word of a table means here."""
    return {word: meant for meant, words in habits()[table].items() for word in words}


def advised(table: str, text: str) -> str:
    """The advice in the first row of a table whose form a text has; nothing without one."""
    rows = ((re.fullmatch(form, text, re.DOTALL), advice) for form, advice in habits()[table])
    return next((found.expand(advice) for found, advice in rows if found), "")


def instead(function: str) -> str:
    """What is done where a function of other programs has no formula here; empty for others."""
    return meanings("instead").get(function, "")


def key_meant(word: str, known: tuple[str, ...]) -> str | None:
    """The key of a problem that a word stands for elsewhere, also with arguments: `V(x)`."""
    word = re.sub(
        r"^(?:\d+[.)]|[•·▪–—])\s*|\s*(?<!=)=[^=].*$|\s*\(.*\)$|^[$*_]+|[$*_]+$|\\math\w+|[{}]",
        "",
        word,
    )
    if word in known:
        return word
    keys = habits()["keys"]
    spelled = word.casefold().replace(" ", "_").replace("-", "_")
    if spelled in known:
        return spelled
    for written in (word, spelled):
        for key in known:
            if written in keys.get(key, ()):
                return key
    plain = letters(spelled)
    alike = (key for key in known if plain in map(letters, keys.get(key, ())))
    return next(alike, None) if len(plain) > 3 else None


def letters(word: str) -> str:
    """`parametros` for parámetros, `stoptime` for stop_time and StopTime; one letter as it is."""
    plain = unicodedata.normalize("NFD", re.sub("[_ -]", "", word))
    plain = "".join(each for each in plain if not unicodedata.combining(each))
    return plain.casefold() if len(plain) > 1 else plain


def key_of_stem(word: str, known: tuple[str, ...]) -> str | None:
    """The key whose stem is in a word: T for `E_kin`."""
    found = [key for stem, key in habits()["stems"].items() if stem in word.casefold()]
    return found[0] if found and found[0] in known else None


def colon_advice(line: str, around: str = "") -> str:
    """`write V: k*x` for a line such as `V k*x`, `V = k*x`, `V:k*x` or `V：k*x`.

    Words are a comment, or the title where they begin a text that has none.
    """
    found = re.match(
        r"\s*([^\W\d]\w*)(?:\s*(?:<-|←|[-=]>|→|[=:]?[=:：])\s*(?=[^+*/^<>])|\s+(?![-+*/^<>]))(.+)",
        line,
    )
    values = assigned(line.strip(" ;")) if re.match(r"\w+\s*=", line) else []
    if values and all(re.fullmatch(r"[-\d.e/]+", value) for _, value in values):
        return f"write parameters: {{{', '.join(map(': '.join, values))}}}"
    for pattern, advice in habits()["begins"]:
        if begun := re.match(pattern, line):
            return begun.expand(advice)
    if _is_prose(line):
        begins = re.match(rf"(?:\s*#.*\n|\s*\n)*{re.escape(line)}\n", around)
        is_title = begins and " " in line.strip() and not re.search("^title:", around, re.MULTILINE)
        written = line.strip()
        return f"write title: {written}" if is_title else f"a comment begins with '#': # {written}"
    if "''" in line:
        return DERIVED
    if found:
        number, unit = number_and_unit(found[2])
        if unit and found[1] not in habits()["keys"]:
            return f"write parameters: {{{found[1]}: {{value: {number}, unit: {unit}}}}}"
        value = re.sub(r"^\{([^:{}]*)\}$", r"[\1]", found[2].strip(" ;"))
        value = re.sub(r"^T\s*[-−]\s*V\s*=\s*", "", value)
        value = re.sub(r"\s*[;,]\s*([TVLH])\s*:?=\s*", r"; \1: ", value)  # T = a; V = b
        named = re.match(r"([^\W\d]+)\s*[:=]?\s*(.+)", value)  # kinetic energy m*x'^2/2
        if named and (key := key_meant(f"{found[1]} {named[1]}", KEYS)):
            return f"write {key}: {named[2]}"
        return f"write {found[1]}: {value}"
    if re.search(r"[\w)][*/^+-]", line):
        return f"write L: {line.strip()}"
    if line.strip() in MAPS:
        return f"write {line.strip()}: with its entries below it"
    return f"write {line.strip() or 'key'}: value"


def _is_prose(line: str) -> bool:
    """Whether a line is one word, or words most of which are long, and begins with no key."""
    words = re.findall(r"[^\W\d_]+", line)
    begun = (" ".join(words[:k]) for k in (1, 2))
    are_words = re.fullmatch(r"\s*[^\W\d]\w*(?:[ ,-]+\w+)*[.!]?\s*", line)
    is_long = len(words) == 1 or sum(len(each) > 2 for each in words) > 1
    return bool(are_words) and is_long and not any(key_meant(each, KEYS) for each in begun)


def is_constant(word: str, value: str) -> bool:
    """Whether a key with its value is a name with its number, which may have a unit."""
    named = re.fullmatch(r"[^\W\d]\w*", word) and word not in meanings("parts")
    return bool(named and (_NUMBER.fullmatch(value.strip()) or unit_behind(value)))


def name_meant(name: str, *, one: bool = False) -> str:
    """A valid name for one with raised or lowered digits, LaTeX or blanks; `theta_1` for θ₁.

    With `one`, words with blanks between them are no list of names.
    """
    if counted := names_among(name):
        return ", ".join(counted)
    if said := advised("declared", name):
        return said
    words = re.findall(r"[^\W\d]\w*", name)
    letters = [each for each in words if len(each.partition("_")[0]) == 1 and each != "a"]
    of_time = re.fullmatch(r"\w+\(t\)|\w+(?:[-.]\w+)+", name.strip())
    if not of_time and len(words) > 1 and len(letters) == 1 and max(map(len, words)) > 2:  # mass m
        return str(letters[0])
    if typed := advised("typed", name):
        return typed
    related = re.fullmatch(r"\s*(\w+)\s*(\W+?)\s*0\s*", name)
    if related and related[2] in SIGNS:
        return f"{related[1]}: {{assume: {SIGNS[related[2]]}}}"
    if re.fullmatch(r"[^\W\d]\w*(\s*(\s-|\s|;)\s*[^\W\d]\w*)+", name) and not one:
        return ", ".join(re.findall(r"\w+", name))
    called = re.sub(r"\([^\W\d].*\)$", "", name)
    plain = "".join(map(_on_the_line, called)).lstrip("\\$").rstrip("$")
    found = re.sub(r"[\W_]+", "_", plain).strip("_")
    return found if re.fullmatch(r"[^\W\d]\w*", found) and found != name else ""


def _on_the_line(character: str) -> str:
    plain = unicodedata.normalize("NFKC", character)
    return f"_{plain}" if plain != character and plain.isdigit() else plain


def unit_behind(text: str) -> str:
    """The unit in `10 kg` or `9.81 m/s^2`; nothing where a number stands alone."""
    if named := _named_unit(text):
        return named[1]
    text = _with_powers(text).replace("°/", " deg/")
    found = _WITH_UNIT.fullmatch(
        re.sub(r"\s*(?:\[([^][]*)\]|\(([^()]*)\))$", r" \1\2", text.strip())
    )
    return found["unit"] if found and is_unit(found["unit"]) else ""


def _named_unit(text: str) -> tuple[str, str] | None:
    """`10` and `kg` of `10 Kilogramm`; None for units by their symbols."""
    found = re.fullmatch(
        r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(?![eE][-+]?\d)([^\W\d_].*)", text.strip()
    )
    if found is None:
        return None
    unit = spoken_unit(found[2])
    is_spoken = unit != found[2] and is_unit(unit)
    return (found[1], unit) if is_spoken else None


def spoken_unit(text: str) -> str:
    """`kg*m/s^2` for `Kilogramm Meter pro Sekunde quadrat` and `kgms-2`; others as they are."""
    if _STRUNG.fullmatch(text):
        parts = [f"{'*/'[sign == '-']}{name}{f'^{power}' if power not in {'', '1'} else ''}"
                 for name, sign, power in _SYMBOL.findall(text)]  # fmt: skip
        return re.sub(r"^/", "1/", "".join(parts).lstrip("*"))
    text = re.sub(r"^(?:U|Umdr\.?|r)(?=/min$)|^U(?=/s$)", "turn", text)
    table = meanings("units")
    words = re.sub(
        r"[^\W\d_²³]+", lambda m: table.get(m[0].casefold(), m[0]), " ".join(text.split())
    )
    spoken = re.sub(r"\s*\b(?:per|pro|par|por|al|na)\b\s*", "/", words)
    spoken = re.sub(r"\b(?:square|squared)\s+(\w+)", r"\1^2", spoken)
    spoken = re.sub(r"\b(?:cubic|cubed)\s+(\w+)", r"\1^3", spoken)
    squared = re.sub(r"\s+(?:squared|quadrat|hoch 2|au carré|al cuadrado)\b", "^2", spoken)
    return re.sub(r"(?<=\w)\s+(?=\w)", "*", squared) if squared != text else text


def number_and_unit(text: str) -> tuple[str, str]:
    """`10` and `kg` of `10 kg`, `9.81 [m/s^2]`; the text and nothing where no unit is behind it."""
    if named := _named_unit(text):
        return named
    unit, text = unit_behind(text), _with_powers(text)
    return (text.partition(unit)[0].strip(" [(,;") if unit else text.strip()), unit


def _with_powers(text: str) -> str:
    """`9.81 m/s^2` for `9.81 m/s2`."""
    return re.sub(r"(?<=[A-Za-z])(?<!\d[eE])-?[1-9](?![\w.])", r"^\g<0>", text)


def is_unit(text: str) -> bool:
    """Whether a text is a unit as a file writes it."""
    from lagcli.units import UnitMistake, read_unit

    try:
        read_unit(text)
    except UnitMistake:
        return False
    return True


def unit_at_end(text: str) -> str:
    """The unit in `k*x^2/2 J`, with a blank before it; nothing where there is none."""
    found = re.search(
        r"[\w)']\s+([^\W\d][^()']*)$", re.sub(r"\(([A-Z][^()]*)\)$", r"\1", text.strip())
    )
    return found[1] if found and unit_behind(f"1 {found[1]}") == found[1] else ""


def superscript(text: str) -> str:
    """The power that raised digits mean: `^2` for `²`; nothing for other characters."""
    digits = [str(_SUPERSCRIPTS.index(c)) for c in text if c in _SUPERSCRIPTS]
    return "^" + "".join(digits) if text and len(digits) == len(text) else ""


def is_open(text: str) -> bool:
    """Whether a value is left open: `?`, `unknown`."""
    return _OPEN.fullmatch(text.strip()) is not None


def fraction(character: str) -> str:
    """`1/2` for ½; nothing for other characters."""
    return unicodedata.normalize("NFKC", character).replace("⁄", "/") if character in VULGAR else ""


def with_mixed_numbers(text: str) -> str:
    """`12.5` for `12½` and `12 1/2`, `4/3` for `1⅓`."""

    def one(found: re.Match[str]) -> str:
        part = Fraction(fraction(found[2] or "") or found[3])
        total = int(found[1]) + part
        written = f"{float(total)}" if 1000 % part.denominator == 0 else f"({total})"
        return written if part < 1 else found[0]

    return re.sub(r"^\((\d+/\d+)\)$", r"\1", _MIXED.sub(one, text))


def comparisons_in(text: str) -> list[str]:
    """`y >= 0` and `y <= 10` for `y .ge. 0 .and. y .le. 10` and for `0 <= y <= 10`."""
    for form, sign in RELATIONS.items():
        text = re.sub(rf"\s*{form}\s*", f" {sign} ", text)
    text = re.sub("=([<>])", r"\1=", text)
    parts = [each.strip() for each in _AND.split(text)]
    return [each for part in parts for each in _BETWEEN.sub(_both, part).split("\n")]


def _both(found: re.Match[str]) -> str:
    low, sign, name, other, high = found.groups()
    return f"{name} {sign.translate(TURNED)} {low}\n{name} {other} {high}"


def names_among(text: str) -> list[str]:
    """`x_1`, `x_2`, `x_3` for `x_1..x_3`; nothing for other texts."""
    text = re.sub(r"^(\w+)\[(\d)\s*(\.\.|:)\s*(\d)\]$", r"\1_\2..\1_\4", text.strip())
    among = re.fullmatch(r"(\D+)(\d)\s*(?:\.{2,}|…|-|to)\s*\1(\d)", text)
    places = range(int(among[2]), int(among[3]) + 1) if among else ()
    return [f"{among[1]}{k}" for k in places] if among else []


def is_angle(name: str) -> bool:
    """Whether a name is that of an angle in most books."""
    return name.partition("_")[0].rstrip("0123456789") in _ANGLES


def foreign_function(name: str) -> bool:
    """Whether it is a function of other programs that the format writes otherwise."""
    return name in FOREIGN or bool(written_out(name))


def written_out(name: str) -> str:
    """The form of a foreign function: `{0}*pi/180` for radians and the RADIANS of spreadsheets."""
    forms: dict[str, str] = habits()["written_out"]
    is_loud = name.isupper() and len(name) > 1
    return forms.get(name) or forms.get(name.casefold() if is_loud else "", "")
