"""A foreign formula cut into pieces."""

from __future__ import annotations

import re
import unicodedata
from html import unescape
from typing import NamedTuple

from lagcli.notation.greek import BY_LETTER, BY_NAME
from lagcli.reader.foreign.indexed_sums import written_out
from lagcli.reader.foreign.vector_products import vector_product
from lagcli.reader.foreign.words import UnclearText, Vocabulary, meant, parts_of, polar_speed
from lagcli.reader.habits import REMARK, foreign_function, unit_behind
from lagcli.reader.regex import regex

RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻½⅓⅔¼¾⅛"
_LETTER = rf"[^\W\d{RAISED}]"
_TOKEN = regex(
    r"(?P<skip>(?:\s|\$|\\[,;:! ]"
    r"|\\(?:left|right|[bB]igg?[lr]?|q?quad|displaystyle|limits)(?![A-Za-z]))+)"
    r"|(?P<number>(?:\d{1,3}(?:\.\d{3})+,\d+|\d{1,3}(?:,\d{3})+\.\d+"
    r"|\d{1,3}(?:[' _]\d{3})+(?![\w.])|\d+(?:\.\d+)?|\.\d+|\d+\.)"
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
    **dict.fromkeys(["−", "–", "—", "‐", "‑"], "-"),
    **dict.fromkeys(["**", ".^"], "^"),
    **dict.fromkeys(["==", ":="], "="),
    **dict.fromkeys(["≥", "\\ge", "\\geq", "\\geqslant"], ">="),
    **dict.fromkeys(["≤", "\\le", "\\leq", "\\leqslant"], "<="),
    "\\{": "(", "\\}": ")", "[": "(", "]": ")", "{": "(", "}": ")", "\\|": "|",
}  # fmt: skip
_SUM_IN_WORDS = regex(r"\b[sS]um(?:me)?\s+(?:over\s+(?:all\s+)?([i-n])\s+)?(?:of|von|de)\s+")
#: v², |v|^2, \\vec{v}^2, v.v and v·v.
_SPEED = regex(
    r"(?<!\w)(?P<v>\|?(?:\\(?:vec|mathbf)\s*\{?)?v\}?\|?)(?:\s*(?:\^|\*\*)\s*\{?2\}?|\s*²"
    r"|\s*(?:\.|·|\\cdot)\s*(?P=v))(?![\w.])"
)
#: The square of a position: \\vec{r}^2, |\\mathbf{r}|^2.
_DISTANCE = regex(r"\|?\\(?:vec|mathbf)\s*\{?r\}?\|?\s*(?:(?:\^|\*\*)\s*\{?2\}?|²)(?!\w)")
_RATE_OF_VECTOR = regex(r"\\dot\s*\{?\s*\\(?:vec|mathbf)\s*\{?r\}?\s*\}?(?=\s*[\^²*])")
#: A remark behind a formula, a row of a matrix, the brackets of a mean, lines without a sign.
_NO_FORMULA = regex(
    r"[\w)']\s*\n\s*[\w(]|"
    r"(?<!\w)\(\s*[^\W\d]{3,}(?:\s+[^\W\d]+)+\s*\)\s*$|\[\s*[\w'.]+(?:\s+[-\w'.]+)+\s*\]|<[^<>=]+>"
)
#: The length of a position: |r|, ||r||, |\\vec{r}|.
_LENGTH = regex(
    r"\b(?:\w+\.)*(?:norm|abs|length|mag)\(\s*r\s*\)|(?:\\?\|){1,2}\s*(?:\\(?:vec|mathbf)\s*)?\{?r\}?\s*(?:\\?\|){1,2}"
)
_SPEED_LENGTH = regex(
    r"(?:\\?\|){1,2}\s*(?:\\(?:vec|mathbf)\s*)?\{?v\}?\s*(?:\\?\|){1,2}"
    r"|\b(?:abs|norm|(?:np\.)?linalg\.norm)\(\s*v\s*\)"
)
#: The distance of two bodies, and of one from the origin: |r1 - r2|, |\\vec{r}_1|.
_VECTOR = r"(?:\\(?:vec|mathbf)\s*)?\{?r\}?_?\{?"
_BETWEEN = regex(
    rf"(?:\\?\|){{1,2}}\s*{_VECTOR}(?P<one>\d)\}}?"
    rf"(?:\s*[-−,]\s*{_VECTOR}(?P<two>\d)\}}?)?\s*(?:\\?\|){{1,2}}"
)
#: norm(r1 - r2), and of one body from the origin.
_LENGTH_OF_DIFFERENCE = regex(
    r"\b(?:\w+\.)*(?:norm|abs|length|mag|dist|distance)\(\s*(r_?\d(?:\s*[-−,]\s*r_?\d)?)\s*\)"
)
#: A product of vectors in brackets.
_PRODUCT_OF_VECTORS = regex(
    r"[(\[]([^()\[\]]+,[^()\[\]]+)[)\]]\s*[.·]\s*[(\[]([^()\[\]]+,[^()\[\]]+)[)\]]"
)
#: A product of two vectors by their letters: A·v, dot(A, v), \\vec{A}\\cdot\\vec{v}.
_LETTER_OF_VECTOR = r"\\?(?:(?:vec|mathbf|boldsymbol|bm)\s*)?\{?\s*([^\W\d_]'*)\s*\}?"
_LETTERS_OF_VECTORS = regex(
    rf"(?<![\w.}}]){_LETTER_OF_VECTOR}\s*(?:[·⋅∙•]|\\cdot(?![a-z])|\s\.\s|(?<=[vr])\.(?=[A-Z]\b)|(?<=[A-Z])\.(?=[vr]\b))\s*{_LETTER_OF_VECTOR}(?![\w'(])"
    rf"|(?<![\w.])(?:\w+\.)?dot\(\s*{_LETTER_OF_VECTOR}\s*,\s*{_LETTER_OF_VECTOR}\s*\)"
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
)
#: What other programs do with a formula: `.simplify()`, `// FullSimplify`.
_DONE_WITH = regex(
    r"\.(?:simplify|trigsimp|expand|factor|evalf|doit|n)\(\w*\)|\s*//\s*(?:Full)?[A-Z]\w+\s*$"
)
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
    text = _DONE_WITH.sub("", text)
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
    along_z = vector_product(text, names.coordinates, {*names.known})
    text = along_z[0] if len(along_z) == 1 else text
    text = _products_of_vectors(written_out(text, names), names)
    text = re.sub(r"->|→|⇒", "=", text) if names.related else text
    if names.related and not {"d", "dt"} & {*names.known} and re.search(r"\bd[^\W\dt]", text):
        text = re.sub(r"(?<=[\w)'])\s*\*?\s*\bdt\b|\bdt\s*\*\s*", "", text)
    text = text if {"i", "j"} & {*names.known} else _COMPLEX.sub(r"cos(\1)", text)
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
    text = _DOT_BEFORE.sub(
        lambda m: _dotted(m, names), _PRODUCT_OF_VECTORS.sub(_by_components, text)
    )
    if "x" not in names.known:
        text = re.sub(r"(?<=[\w)'²])\s+[xX]\s+(?=[\w(\\])", " * ", text)
    text = re.sub(r"(?<=\w)//(?=\w)", "/", re.sub(r"\s\.\s", " * ", text).strip(" =").rstrip(";,"))
    text = re.sub(r"\bDerivative\[(\d)\]\[(\w+)\]", lambda m: m[2] + "'" * int(m[1]), text)
    text = _leibniz(_distance(_square_of_speed(text, names), names), names)
    for name, component in names.components.items():
        point, axis = name.split(".")
        forms = [name, *({f"{axis}_{point}", f"{axis}{point}", f"{point}_{axis}"} - {*names.known})]
        spelled = "|".join(map(re.escape, forms))
        text = re.sub(rf"(?<![\w.])(?:{spelled})(?!\w)", f"({component})", text)

    def without_owner(found: re.Match[str]) -> str:
        is_name = meant(found[2], names)[0] in names.known
        return "" if is_name and found[1] not in names.known else found[0]

    return _OWNER.sub(without_owner, text)


def _numbered(found: re.Match[str], names: Vocabulary) -> str:
    """`x1'` for `x'1`, where x1 is a name."""
    word, primes, index = found.groups()
    return word + index + primes if word + index in names.dependent else found[0]


def _by_components(found: re.Match[str]) -> str:
    """`(a*c + b*d)` for `(a, b).(c, d)`."""
    left, right = (each.split(",") for each in found.groups())
    if len(left) != len(right):
        return found[0]
    return (
        f"({' + '.join(f'({a.strip()})*({b.strip()})' for a, b in zip(left, right, strict=True))})"
    )


def _products_of_vectors(text: str, names: Vocabulary) -> str:
    """`(A_x*x' + A_y*y')` for A·v, where A has components in the file."""
    axes = [x for x in names.coordinates if x in {"x", "y", "z"}]

    def components(letter: str) -> list[str]:
        bare = letter.rstrip("'")
        primes = letter[len(bare) :]
        if bare in {"v", "r"} - {*names.known} and axes == [*names.coordinates]:
            return [x + "'" * (bare == "v") + primes for x in axes]
        listed = [f"{bare}_{x}" for x in axes if f"{bare}.{x}" in names.components]
        named = listed or [
            next((each for each in (f"{bare}_{x}", f"{bare}{x}") if each in names.known), "0")
            for x in axes
        ]
        return [each + primes * (each != "0") for each in named]

    def written(found: re.Match[str]) -> str:
        one, two = (components(each) for each in found.groups() if each)
        pairs = [pair for pair in zip(one, two, strict=False) if "0" not in pair]
        if not pairs and {each for each in found.groups() if each} & {"r", "v", "r'"} - {
            *names.known
        }:
            raise UnclearText  # E·r, where E has no components
        return f"({' + '.join(map('*'.join, pairs))})" if pairs else found[0]

    return _LETTERS_OF_VECTORS.sub(written, text)


def _dotted(found: re.Match[str], names: Vocabulary) -> str:
    """`x'` for `dot x`."""
    name = found["name"]
    known = name in names.dependent and "dot" not in names.known
    return name + "'" * (2 if found[1] else 1) if known else found[0]


def _on_the_keyboard(character: str) -> str:
    """`*` for its full-width form, m for the italic 𝑚 of formulas, `^` for the accent."""
    is_wide = "！" <= character <= "～" or "\U0001d400" <= character <= "\U0001d7ff"
    return unicodedata.normalize("NFKC", character) if is_wide else character.replace("ˆ", "^")


def _square_of_speed(text: str, names: Vocabulary) -> str:
    """The sum of squares for v², in Cartesian coordinates."""
    if len(names.coordinates) < 2 or "v" in names.known:
        return text
    if squares := polar_speed(names.coordinates):
        text = _SPEED.sub(f" ({squares}) ", text)
        return _SPEED_LENGTH.sub(f" sqrt({squares}) ", text)
    if not {*names.coordinates} <= {*"xyz"}:
        return text
    for pattern, prime in ((_SPEED, "'"), (_DISTANCE, "")):
        squares = " + ".join(f"{x}{prime}^2" for x in names.coordinates)
        text = pattern.sub(f" ({squares}) ", text)
    squares = " + ".join(f"{x}'^2" for x in names.coordinates)
    text = _SPEED_LENGTH.sub(f" sqrt({squares}) ", text)
    if "r" not in names.known:
        squares = " + ".join(f"{x}^2" for x in names.coordinates)
        text = _LENGTH.sub(f" sqrt({squares}) ", text)
    return text


def _distance(text: str, names: Vocabulary) -> str:
    """`sqrt((x1 - x2)^2 + (y1 - y2)^2)` for |r1 - r2|, with the coordinates of two bodies."""

    def written(found: re.Match[str]) -> str:
        parts = []
        for axis in "xyz":
            ends = [_axis(axis, found[index], names) for index in ("one", "two") if found[index]]
            if all(ends):
                parts.append(f"({' - '.join(ends)})^2" if len(ends) > 1 else f"{ends[0]}^2")
        return f" sqrt({' + '.join(parts)}) " if len(parts) > 1 else found[0]

    text = _LENGTH_OF_DIFFERENCE.sub(r"|\1|", text)
    known = {*names.known} & {found[0] for found in re.finditer(r"r_?\d", text)}
    return text if known else _BETWEEN.sub(written, text)


def _axis(axis: str, index: str, names: Vocabulary) -> str:
    return next((x for x in (f"{axis}{index}", f"{axis}_{index}") if x in names.coordinates), "")


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
