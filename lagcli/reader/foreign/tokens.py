"""A foreign formula cut into pieces."""

from __future__ import annotations

import re
import unicodedata
from functools import partial
from html import unescape
from typing import NamedTuple

from lagcli.notation.greek import BY_LETTER, BY_NAME
from lagcli.reader.foreign.indexed_sums import written_out
from lagcli.reader.foreign.lengths import component, with_components, with_products
from lagcli.reader.foreign.vector_products import vector_product, with_single_components
from lagcli.reader.foreign.words import UnclearText, Vocabulary, meant, parts_of
from lagcli.reader.habits import (
    RELATIONS,
    REMARK,
    VULGAR,
    advised,
    foreign_function,
    unit_behind,
    with_mixed_numbers,
)
from lagcli.reader.regex import regex

RAISED = f"⁰¹²³⁴⁵⁶⁷⁸⁹⁻{VULGAR}"
_LETTER = rf"[^\W\d{RAISED}]"
_TOKEN = regex(
    r"(?P<skip>(?:\s|\$|\\[,;:! ]"
    r"|\\(?:left|right|[bB]igg?[lr]?|q?quad|displaystyle|limits)(?![A-Za-z]))+)"
    r"|(?P<number>(?:\d{1,3}(?:\.\d{3})+,\d+|\d{1,3}(?:,\d{3})+\.\d+"
    r"|\d{1,3}(?:[' _]\d{3})+(?![\w.])|\d+(?:\.\d+|\.(?![\w.]))?|\.\d+)"
    r"(?:(?:[eEdD]|\*\^)[-+]?\d+)?(?:[fF](?!\w))?)"
    r"|(?P<macro>\\[A-Za-z]+)"
    rf"|(?P<name>(?:(?:np|numpy|math|Math|sp|sympy|cmath|std|jnp)(?:\.linalg)?(?:\.|::))?{_LETTER}"
    rf"(?:[\w\u0300-\u036f](?<![{RAISED}]))*(?:(?<=_)\{{\\?\w+\}})?)"
    rf"|(?P<raised>[⁻{RAISED}]+)"
    r"|(?P<primes>['’′″‴`´]+)"
    r"|(?P<sign>\*\*|\.\^|\.\*|\./|==|:=|>=|<=|\\[{}|]|\S)"
)  # fmt: skip
SIGNS = {
    **dict.fromkeys(["·", "×", "∙", "⋅", "∗", "•", ".*", "\\cdot", "\\times", "\\ast"], "*"),
    **dict.fromkeys(["÷", "∕", "⁄", "./", "\\div"], "/"),
    **dict.fromkeys([*"−–—‐‑‒―﹣－"], "-"),
    **dict.fromkeys(["**", ".^"], "^"),
    **dict.fromkeys(["==", ":="], "="),
    **dict.fromkeys(["≥", "\\ge", "\\geq", "\\geqslant"], ">="),
    **dict.fromkeys(["≤", "\\le", "\\leq", "\\leqslant"], "<="),
    "\\{": "(", "\\}": ")", "[": "(", "]": ")", "{": "(", "}": ")", "\\|": "|", "‖": "|",
}  # fmt: skip
_SUM_IN_WORDS = regex(r"\b[sS]um(?:me)?\s+(?:over\s+(?:all\s+)?([i-n])\s+)?(?:of|von|de)\s+")
_RATE_OF_VECTOR = regex(r"\\dot\s*\{?\s*\\(?:vec|mathbf)\s*\{?r\}?\s*\}?(?=\s*[\^²*])")
#: A remark behind a formula, a row of a matrix, the brackets of a mean, lines without a sign.
_NO_FORMULA = regex(
    r"[\w)']\s*\n\s*[\w(]|"
    r"(?<!\w)\(\s*[^\W\d]{3,}(?:\s+[^\W\d]+)+\s*\)\s*$|\[\s*[\w'.]+(?:\s+[-\w'.]+)+\s*\]|<[^<>=]+>"
)
#: A force in the complex plane: exp(i*omega*t), e^{iωt}.
_COMPLEX = regex(
    r"(?<!\w)(?:exp\s*\(|e\s*\^\s*[({])\s*[-+]?\s*[ij]\s*\*?\s*((?:\w+\s*\*\s*)?\w*t)\s*[)}]"
)
#: A coordinate behind the word for its rate.
_DOT_BEFORE = regex(r"(?<![\\\w.])(d)?dot\s+(?P<name>[^\W\d]\w*)")
#: Relations in words: y is 0, N is positive, x is less than l.
_RELATIONS = (
    (re.compile(r"(?<=[\w)'])\s+plus\s+(?=[\w(])"), "+"),
    (re.compile(r"(?<=[\w)'])\s+minus\s+(?=[\w(])"), "-"),
    (re.compile(r"(?<=[\w)'])\s+times\s+(?=[\w(])"), "*"),
    (re.compile(r"\s+(?:is\s+|stays\s+|remains\s+)?(?:positive|nonnegative)\s*$"), ">= 0"),
    (re.compile(r"\s+(?:is\s+)?(?:greater|larger|bigger|more)\s+than\s+"), ">"),
    (re.compile(r"\s+(?:is\s+)?(?:less|smaller)\s+than\s+"), "<"),
    (re.compile(r"\s+(?:is\s+equal\s+to|is|equals?)\s+(?=[-\w(])"), "="),
    *((re.compile(rf"\s*{form}\s*"), sign) for form, sign in RELATIONS.items()),
)
#: A word that may be a number of other programs: M_PI_2, %pi, math.e.
_CONSTANT = regex(r"(?<![\w.\\])(?:%|\w+\.|std::numbers::)?[^\W\d]\w*(?![\w.'(])")
#: What other programs do with a formula: `.simplify()`, `// FullSimplify`.
_DONE_WITH = regex(
    r"\.(?:simplify|trigsimp|expand|factor|evalf|doit|n)\(\w*\)|\s*//\s*(?:Full)?[A-Z]\w+\s*$"
)
#: A component by its place and by its letter: A[1], A[[1]] and A.x.
_INDEXED = r"(?<![\w.])([^\W\d]\w*)\[{1,2}\s*(\d)\s*\]{1,2}"
_AXIS = regex(r"(?<![\w.])([^\W\d]\w*)\.([xyz])(?!\w)")
#: `self.` before a name.
_OWNER = regex(r"\b([A-Za-z]\w*)\.(?=(?!diff\b)([A-Za-z_]\w*))")


class Token(NamedTuple):
    """A piece: a number, a name, a macro of LaTeX, raised digits, primes or a sign."""

    kind: str
    text: str
    apart: bool  # a blank stands before it


def prepared(text: str, names: Vocabulary) -> str:
    """With the marks of web pages, v² and Leibniz' derivatives in the notation of a file."""
    text = re.sub(r"^\s*[rfbu]?(['\"])(.*)\1\s*$", r"\2", unescape(text))
    text = with_mixed_numbers(_DONE_WITH.sub("", text))
    text = re.sub(r"\b([pP]i|PI)\(\s*\)", "pi", text)
    text = _CONSTANT.sub(
        lambda m: m[0] if m[0] in names.known else advised("constants", m[0]) or m[0], text
    )
    text = re.sub(r"\bSubscript\[(\w+),\s*(\w+)\]", r"\1_\2", text)
    if "half" not in names.known:
        text = re.sub(r"\b(?:(?:one|a)[ -])?half\b(?:\s+of\b)?", "1/2", text)
    text = _SUM_IN_WORDS.sub(lambda m: f"Σ_{m[1]} " if m[1] else "Σ ", text)
    text = re.sub(r"(\w)\u20d7", r"\\vec{\1}", text)
    text = re.sub(r"\\(?:begin|end)\s*\{\w+\*?\}|\\[()\[\]]", " ", text)
    text = re.sub(r"<su(p|b)>(\w+)</su\1>", lambda m: ("_" if m[1] == "b" else "^") + m[2], text)
    text = re.sub(r"(?<![\\\w])([^\W\d_]+)(['’′]+)_(?:\{(\w+)\}|(\w+))", r"\1_\3\4\2", text)  # x'_1
    text = re.sub(r"(?<![\\\w])([^\W\d_]+)(['’′]+)(\d+)(?!\w)", lambda m: _numbered(m, names), text)
    text = re.sub(
        r"\\(d?dot)\s*(?:\{\s*(\\?[^\W\d_]+)\s*\}|(\w))\s*_(?:\{(\w+)\}|(\w))",
        r"\\\1{\2\3_\4\5}",
        text,
    )  # \dot{x}_i
    text = with_single_components(text, names)
    along_z = vector_product(text, names.coordinates, {*names.known})
    text = along_z[0] if len(along_z) == 1 else text
    text = with_products(written_out(text, names), names)
    text = re.sub(r"->|[→⇒≈≃≅]", "=", text) if names.related else text
    text = re.sub(r"(?<=[\w)'²])\s*:\s*(?=\d)", "/", text)
    if names.related and not {"d", "dt"} & {*names.known} and re.search(r"\bd[^\W\dt]", text):
        text = re.sub(r"(?<=[\w)'])\s*\*?\s*\bdt\b|\bdt\s*\*\s*", "", text)
    is_other = {"i", "j"} & {*names.known} or re.search(r"\bIm\b", text)
    text = text if is_other else _COMPLEX.sub(r"cos(\1)", text)
    for words, sign in _RELATIONS:
        text = words.sub(f" {sign} ", text)
    behind = re.search(r"\[([^\[\]]+)\]\s*$", text)
    if behind and unit_behind(f"1 {behind[1]}"):
        raise UnclearText  # m*g*y [J]
    if _NO_FORMULA.search(text) or REMARK.search(text):
        raise UnclearText
    if "arc" not in names.known:
        text = re.sub(r"\b(ar[ck]?)\s+(?=(?:sin|cos|tan|cot)h?\b)", "arc", text)
    text = "".join(map(_on_the_keyboard, _RATE_OF_VECTOR.sub(r"\\vec{v}", text)))
    text = _DOT_BEFORE.sub(lambda m: _dotted(m, names), text)
    if "x" not in names.known:
        text = re.sub(r"(?<=[\w)'²])\s+[xX]\s+(?=[\w(\\])", " * ", text)
    text = re.sub(r"(?<=\w)//(?=\w)", "/", re.sub(r"\s\.\s", " * ", text).strip(" =").rstrip(";,"))
    text = re.sub(r"\bDerivative\[(\d)\]\[(\w+)\]", lambda m: m[2] + "'" * int(m[1]), text)
    text = _by_letters(_leibniz(with_components(text, names), names), names)
    for name, formula in names.components.items():
        point, _, axis = name.rpartition(".")
        forms = [name, *({f"{axis}_{point}", f"{axis}{point}", f"{point}_{axis}"} - {*names.known})]
        spelled = "|".join(map(re.escape, forms))
        text = re.sub(
            rf"(?<![\w.])(?:{spelled}|{re.escape(point)}['’′]\.{axis})(?!\w)['’′]*",
            partial(_component, formula, names),
            text,
        )

    def without_owner(found: re.Match[str]) -> str:
        is_name = meant(found[2], names)[0] in names.known
        return "" if is_name and found[1] not in names.known else found[0]

    return _OWNER.sub(without_owner, text)


def _by_letters(text: str, names: Vocabulary) -> str:
    """`A.x`, or the A_x of the file, for `A[0]` or `A[1]`.

    The first or the last index tells where they begin.
    """
    for vector, place in re.findall(_INDEXED, text):
        if {f"{vector}{place}", f"{vector}_{place}"} & {*names.known}:
            continue  # k_1 for k[1]
        named = [f"{vector}.{x}" for x in "xyz" if f"{vector}.{x}" in names.components]
        named = named or [f"{vector}_{x}" for x in "xyz" if f"{vector}_{x}" in names.known]
        indexed = _INDEXED.replace(r"([^\W\d]\w*)", vector)
        used = {int(each) for each in re.findall(indexed, text)}
        first = 0 if 0 in used else 1
        if used <= {*range(first, first + len(named))} and used & {0, len(named)}:
            for index, each in enumerate(named, start=first):
                text = re.sub(indexed.replace(r"\d", f"{index}"), each, text)
    return _AXIS.sub(lambda m: x if (x := f"{m[1]}_{m[2]}") in names.known else m[0], text)


def _numbered(found: re.Match[str], names: Vocabulary) -> str:
    """`x1'` for `x'1`, where x1 is a name."""
    word, primes, index = found.groups()
    return word + index + primes if word + index in names.dependent else found[0]


def _component(formula: str, names: Vocabulary, found: re.Match[str]) -> str:
    return component(formula, "'" * len(re.findall("['’′]", found[0])), names)


def _dotted(found: re.Match[str], names: Vocabulary) -> str:
    """`x'` for `dot x`."""
    name = found["name"]
    known = name in names.dependent and "dot" not in names.known
    return name + "'" * (2 if found[1] else 1) if known else found[0]


def _on_the_keyboard(character: str) -> str:
    """`*` for its full-width form, m for the italic 𝑚 of formulas, `^` for the accent."""
    is_wide = "！" <= character <= "～" or "\U0001d400" <= character <= "\U0001d7ff"
    return unicodedata.normalize("NFKC", character) if is_wide else character.replace("ˆ", "^")


def _leibniz(text: str, names: Vocabulary) -> str:
    r"""A prime for each dx/dt, d/dt x and \frac{dx}{dt}."""
    for x in sorted(names.dependent, key=len, reverse=True):
        spelled = "|".join(map(re.escape, {x, BY_NAME.get(x, x), BY_LETTER.get(x, x)}))
        d, name = r"(?:d|\\mathrm\{?d\}?|∂|\\partial)\s*", rf"\\?(?:{spelled})(?!\w)(?:\(t\))?"
        for order, above, below in ((1, "", ""), (2, r"(?:\^\{?2\}?|²)", r"(?:\^\{?2\}?|²)")):
            prime = x + "'" * order
            below_line = rf"(?:\({d}t{below}\)|{d}t{below})"
            forms = [
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*{name}\s*\}}\{{\s*{d}t{below}\s*\}}",
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*\}}\{{\s*{d}t{below}\s*\}}\s*{name}",
                rf"(?<!\w){d}{above}\s*(?:\({name}\)|{name})\s*/\s*{below_line}(?!\w)",
                rf"(?<!\w){d}{above}\s*/\s*{below_line}\s*(?:\({name}\)|{name})",
            ]
            for form in forms:
                text = re.sub(form, f" {prime} ", text)
            times = "t" * order
            text = re.sub(
                rf"(?<![\w.(,[{{])\\?(?:{spelled})_?\{{?,{times}\}}?(?![\w.)])", f" {prime} ", text
            )
    return text


def tokens(text: str, names: Vocabulary) -> list[Token]:
    """The pieces of a text."""
    found = []
    at, apart = 0, False
    while at < len(text):
        match = _TOKEN.match(text, at)
        assert match is not None
        at = match.end()
        kind = match.lastgroup or ""
        if kind == "name":
            is_called = foreign_function(match[0]) and re.match(r"\s*[(\[]", text[at:])
            first, *others = [match[0]] if is_called else parts_of(match[0], names)
            found += [Token(kind, first, apart), *(Token(kind, each, False) for each in others)]
        elif kind != "skip":
            found.append(Token(kind, match[0], apart))
        apart = kind == "skip"
    return found
