r"""Text from a file in LaTeX: nothing in it can be a command, and all of it is ASCII.

Accented letters become accents, Greek letters formulas, Cyrillic ones Latin; a letter for
which pdfLaTeX has no type is shown by its name.
"""

from __future__ import annotations

import unicodedata

from lagcli.formatters.plain import harmless
from lagcli.notation.greek import CYRILLIC, LATEX, PUNCTUATION

_MACROS = (
    r"\le \ge \ne \approx \pm \times \div \infty \surd \int \partial \nabla \to \leftarrow "
    r"\Rightarrow \in \propto \cdot \cdot \ast {}^\circ ' '' ''' \dots \bullet \perp \parallel"
)
_SIGNS = dict(zip("≤≥≠≈±×÷∞√∫∂∇→←⇒∈∝⋅∙∗°′″‴…•⟂∥", _MACROS.split(), strict=True))
_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"$\mathdollar$",  # \$ would ask for another font
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    "`": r"\`{}",
    '"': "''",
    "-": r"-{}",  # two of them are no dash
    "·": r"$\cdot$",
    "−": "$-$",
    "‐": "-{}",
    "‑": "-{}",
    "∕": "/",
    "⁄": "/",
    **{sign: f"${macro}$" for sign, macro in _SIGNS.items()},
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
}
_ACCENTS = dict(zip(
    "\u0300\u0301\u0302\u0303\u0304\u0306\u0307\u0308\u030a\u030b\u030c\u0327",
    r"""\` \' \^ \~ \= \u \. \" \r \H \v \c""".split(),
    strict=True,
))  # fmt: skip

#: A longer word may be broken after this number of characters.
_LONG_WORD = 16


def latex_text(text: str) -> str:
    """Escape a text for the running text of a LaTeX document."""
    shown = harmless(unicodedata.normalize("NFC", text))
    return " ".join(_word(word) for word in shown.split(" "))


def _word(word: str) -> str:
    if word.startswith("'") and "'" in word[2:]:
        return "`" + _word(word[1:])
    if len(word) <= _LONG_WORD:
        return "".join(map(_character, word))
    parts = [word[i : i + _LONG_WORD // 2] for i in range(0, len(word), _LONG_WORD // 2)]
    return r"\allowbreak{}".join("".join(map(_character, part)) for part in parts)


def _character(character: str) -> str:
    if character in _SPECIAL:
        return _SPECIAL[character]
    if character.isascii():
        return character
    if character in LATEX:
        return f"${LATEX[character]}$"
    if character in PUNCTUATION:
        return PUNCTUATION[character]
    if character.lower() in CYRILLIC:
        latin = CYRILLIC[character.lower()]
        return latin.capitalize() if character.isupper() else latin
    if unicodedata.decomposition(character).startswith("<su"):
        return _spelled_out(character)  # a superscript or a subscript
    plain, *marks = [*unicodedata.normalize("NFKD", character)]
    if all(mark in _ACCENTS for mark in marks) and (plain.isascii() or plain in LATEX):
        shown = _character(plain)
        for mark in marks if plain.isascii() else ():
            dotless = {"i": r"\i{}", "j": r"\j{}"}.get(shown, shown)
            shown = f"{_ACCENTS[mark]}{{{dotless}}}"
        return shown
    return _spelled_out(character)


def _spelled_out(character: str) -> str:
    """½ as 1/2, ² raised; of a letter without a type its name, of what has none nothing."""
    plain = unicodedata.normalize("NFKD", character)
    kind = unicodedata.decomposition(character).partition(">")[0]
    if plain != character and all(c.isascii() or c in _SPECIAL for c in plain):
        shown = "".join(map(_character, plain))
        raised = {"<super": "^", "<sub": "_"}.get(kind)
        return rf"${raised}{{\text{{{shown}}}}}$" if raised else shown
    if unicodedata.category(character) in {"Cf", "Mn"}:
        return ""
    name = unicodedata.name(character, "a sign without a name").lower()
    return f"({name})"
