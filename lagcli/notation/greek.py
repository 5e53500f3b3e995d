"""Greek letters: by their names in formulas, by their characters, by their LaTeX macros."""

from __future__ import annotations

import unicodedata

_SMALL = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron "
    "pi rho sigma tau upsilon phi chi psi omega"
)

#: Letter by spelled name.  `phi` and `varphi` stay two letters, as do the other pairs.
BY_NAME: dict[str, str] = {
    **dict(zip(_SMALL.split(), "αβγδεζηθικλμνξοπρστυφχψω", strict=True)),
    **dict(zip(_SMALL.title().split(), "ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ", strict=True)),
    "varepsilon": "ϵ",
    "vartheta": "ϑ",
    "varpi": "ϖ",
    "varrho": "ϱ",
    "varsigma": "ς",
    "varphi": "ϕ",
}

#: Spelled name by letter, for terminals with ASCII only.
BY_LETTER: dict[str, str] = {letter: name for name, letter in BY_NAME.items()} | {"ϰ": "kappa"}

#: Letters of LaTeX with a second shape.
VARIANTS = tuple(name for name in BY_NAME if name.startswith("var"))

# LaTeX has no macros for the capitals that look Latin, nor for omicron.
_LATIN_SHAPES = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΧο", "ABEZHIKMNOPTXo", strict=True))

#: LaTeX by letter.  The shape that Unicode calls φ is \varphi, and likewise ε.
LATEX: dict[str, str] = {
    letter: (rf"\mathrm{{{_LATIN_SHAPES[letter]}}}" if letter in _LATIN_SHAPES else rf"\{name}")
    for letter, name in BY_LETTER.items()
} | {
    "φ": r"\varphi",
    "ϕ": r"\phi",
    "ε": r"\varepsilon",
    "ϵ": r"\epsilon",
    "ο": "o",
    "ϰ": r"\kappa",
}


def latex_of_name(name: str) -> str | None:
    r"""LaTeX of a spelled letter as it is known there: `phi` is \phi, `varphi` is \varphi."""
    letter = BY_NAME.get(name)
    if letter is None:
        return None
    return LATEX[letter] if letter in _LATIN_SHAPES else rf"\{name}"


def romanized(text: str) -> str:
    r"""Put the text in ASCII: Greek letters by name, accents dropped, the rest as \u escapes."""
    return "".join(_romanized(character) for character in unicodedata.normalize("NFC", text))


def _romanized(character: str) -> str:
    if character.isascii():
        return character
    if character in PUNCTUATION:
        return PUNCTUATION[character]
    plain = "".join(c for c in unicodedata.normalize("NFKD", character) if c not in _ACCENTS)
    if plain in BY_LETTER:
        return BY_LETTER[plain]
    if plain.isascii() and plain:
        return plain
    return CYRILLIC.get(character.lower()) or f"\\u{{{ord(character):x}}}"


_ACCENTS = "".join(chr(code) for code in range(0x300, 0x370))

_SIGNS = "– - — -- − - ‘ ' ’ ' ′ ' ″ '' “ \" ” \" „ \" · * × x ß ss æ ae ø o Ø O ł l Ł L".split()
#: Typographic signs in plain ASCII.
PUNCTUATION: dict[str, str] = dict(zip(_SIGNS[::2], _SIGNS[1::2], strict=True))

_CYRILLIC = "абвгдеёжзийклмнопрстуфхцчшщъыьэюя"
_SCIENTIFIC = "a b v g d e e zh z i j k l m n o p r s t u f kh ts ch sh shch '' y ' e yu ya"

#: Cyrillic letters in Latin ones, for where there is no Cyrillic type.
CYRILLIC: dict[str, str] = dict(zip(_CYRILLIC, _SCIENTIFIC.split(), strict=True))
