"""Letters of ours give way to letters of the file: ω, L, h, H, Q, R, T, S, …

A page has letters that no file declares: L for the Lagrangian, ω for a frequency.  Where the file
uses one for itself, ours gets the index "sys" (L_sys), and a sentence says the word instead.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import Any, TypeVar, cast
from unicodedata import normalize

from lagcli.document import Formula, Items, Label, Paragraph, Sentence
from lagcli.expression import FUNCTIONS, Call, Expression, Name, PartialCall, Sum, walk
from lagcli.notation.naming import INDEX, free
from lagcli.record import field_names, replace
from lagcli.rewriting import expressions_in, rebuilt

Page = TypeVar("Page")
#: The formula that a text is, if it is one.
Reading = Callable[[str], Expression | None]

#: What stands before a letter of ours until it is known whether the file has it.
_OWN = "&"
#: What a sentence says where a letter is the file's; the first that fits counts.  In T' and
#: T = 0 it is the file's.
_WORDS = (
    (r"\bT \+ V\b", "TV", "the sum of the kinetic and the potential energy"),
    (r"\bL\b(?!['(]| [=><≠])", "L", "the Lagrangian"),
    (r"\bH\b(?!['(]| [=><≠])", "H", "the Hamiltonian"),
    (r"\bV\b(?!['(]| [=><≠])", "V", "the potential energy"),
    (r"\bT\b(?!['(]| [=><≠])", "T", "the kinetic energy"),
    (r"\bU_eff\b", "U_eff", "the effective potential"),
    (r"^S = ", "S", "S_sys = "),
    (r"\bthe derivative of S\b", "S", "the derivative of the action"),
)
#: Names there are those of the file.
_OF_THE_FILE = re.compile(
    r"(\bthe functions? .*? (?:is|are) not specified"
    r"|\bsines and cosines of (?:\w+, )*\w+(?: and \w+)?)"
)
_OF_FUNCTIONS = re.compile(
    r"(the functions? |sines and cosines of )(.*?)( (?:is|are) not specified|$)"
)
_OPERATION = re.compile(r"\w\(|[*/^]| [-+] ")
_LETTERS = re.compile(
    r"(?<![\w'])(T \+ V|[LH]|T(?= is | plus )|V(?= depends | without )|t(?= explicitly))(?![\w'])"
)


def own(letter: str, primes: int = 0) -> Name:
    """A letter of the page itself, as a formula."""
    return Name(_OWN + letter, primes)


def names_in(value: object) -> set[str]:
    """The names and functions that the formulas of a value use."""
    parts = [part for tree in expressions_in(value) for part in walk(tree)]
    called = {part.function for part in parts if isinstance(part, (Call, PartialCall))}
    return {part.name for part in parts if isinstance(part, Name)} | called - FUNCTIONS.keys()


def with_names(
    text: str, names: Collection[str], read: Reading = lambda _: None
) -> tuple[str | Formula, ...]:
    """The sentence with names and formulas of the file as they are set: θ in "at theta = 0".

    One letter may be a word: it is a name with primes, before a relation, or in a formula.
    What is a formula, `read` says.
    """
    if isinstance(text, Sentence):
        return text.parts
    ordered = sorted((re.escape(n) for n in names), key=len, reverse=True)
    if not ordered:
        return (text,)
    parts: list[str | Formula] = []
    end = 0
    for start, stop, node in _formulas(text, ordered, read):
        parts += [*_single_names(text[end:start], ordered), node]
        end = stop
    return tuple(part for part in (*parts, *_single_names(text[end:], ordered)) if part != "")


def _single_names(text: str, ordered: Sequence[str]) -> Iterator[str | Name]:
    long, short = ("|".join(n for n in ordered if (len(n) > 1) == several) for several in (1, 0))
    either = [f"({long})('*)"] * bool(long) + [f"({short})('+|(?= [=<>≠] ))"] * bool(short)
    end = 0
    for found in re.finditer(rf"(?<![\w'])(?:{'|'.join(either)})(?![\w'(])", text):
        name, primes = (g for g in found.groups() if g is not None)
        yield text[end : found.start()]
        yield Name(name, len(primes))
        end = found.end()
    yield text[end:]


def _formulas(
    text: str, ordered: Sequence[str], read: Reading
) -> Iterator[tuple[int, int, Expression]]:
    """The longest parts that read as sums, products, powers or calls of the names, and where."""
    if not _OPERATION.search(text):
        return
    names = "|".join((*ordered, *(rf"{function}(?=\()" for function in FUNCTIONS)))
    token = rf"(?:(?:{names})'*(?![\w'])|\d+(?![\w.])|[-+*/^()])"
    end = 0
    for run in re.finditer(rf"(?<![\w'.]){token}(?: ?{token})+", text):
        marks = [found.span() for found in re.finditer(token, run[0])]
        for first, last in ((a, b) for a, _ in marks for _, b in reversed(marks)):
            start, stop = run.start() + first, run.start() + last
            if end <= start < stop and (node := _read(run[0][first:last], ordered, read)):
                yield start, stop, node
                end = stop


def _read(text: str, names: Collection[str], read: Reading) -> Expression | None:
    node = read(text) if _OPERATION.search(text) else None
    used = names_in(node)
    return node if used and used <= {*names} else None


def settled(page: Page, taken: Collection[str]) -> Page:
    """The page with every letter of its own free of those that are taken."""
    return cast(Page, _settled(page, taken))


def sentence(text: str, taken: Collection[str]) -> str:
    """The sentence with words for the letters that are taken."""
    parts = _OF_THE_FILE.split(text)
    for pattern, letters, words in _WORDS:
        clash = letters in taken or (len(letters) == 2 and any(x in taken for x in letters))
        if clash:
            parts[::2] = (re.sub(pattern, words, part) for part in parts[::2])
    said = "".join(parts)
    return text if said == text else said  # with the formulas that it knows


def _settled(value: Any, taken: Collection[str]) -> Any:
    match value:
        case Label():
            return _label(value, taken)
        case Name(name=name) if name.startswith(_OWN):
            return replace(value, name=free(taken, name.removeprefix(_OWN)))
        case Expression():
            if not any(isinstance(p, Name) and p.name.startswith(_OWN) for p in walk(value)):
                return value
            return rebuilt(value, lambda part: _settled(part, taken))
        case Paragraph(parts=parts):
            return Paragraph(_said(parts, taken))
        case Items(items=items):
            return Items(tuple(_said(parts, taken) for parts in items))
        case tuple():
            return tuple(_settled(part, taken) for part in value)
        case _ if names := field_names(value):
            return replace(value, **{n: _settled(getattr(value, n), taken) for n in names})
        case _:
            return value


def _said(parts: tuple[Any, ...], taken: Collection[str]) -> tuple[Any, ...]:
    found: list[Any] = []
    for part in parts:
        if isinstance(part, str):
            found += _typeset(sentence(part, taken))
        else:
            found.append(_settled(part, taken))
    return tuple(found)


def _typeset(text: str) -> list[Any]:
    """The sentence with its letters as formulas: L, H, T, V, t, and functions of the file."""
    found: list[Any] = []
    for k, piece in enumerate(_OF_THE_FILE.split(text)):
        found += _functions(piece) if k % 2 else _letters(piece)
    return found


def _functions(text: str) -> list[Any]:
    """What has names in "the functions U and Phi are not specified" as formulas."""
    lead, names, end = _OF_FUNCTIONS.split(text)[1:4]
    parts = re.split(r"(, | and )", names)
    return [lead, *(part if k % 2 else Name(part) for k, part in enumerate(parts)), end]


def _letters(text: str) -> list[Any]:
    found: list[Any] = []
    for position, piece in enumerate(_LETTERS.split(text)):
        if position % 2 == 0:
            found += [piece] if piece else []
        elif piece == "T + V":
            found.append(Sum((Name("T"), Name("V"))))
        else:
            found.append(Name(piece))
    return found


def bold(letter: str) -> str:
    """A letter in mathematical bold, such as 𝐌."""
    first = ord("𝐀") - ord("A") if letter.isupper() else ord("𝐚") - ord("a")
    return chr(ord(letter) + first) if letter.isascii() else letter


def in_ascii(letter: str) -> str:
    """The letter itself; M_sys of a bold 𝐌, where the file has an M of its own."""
    return letter if letter == (plain := normalize("NFKC", letter)) else f"{plain}_{INDEX}"


def _label(label: Label, taken: Collection[str]) -> Label:
    if label.matrix and label.letter in taken:
        return replace(label, letter=bold(label.letter))
    spelled, index = "_".join((label.letter, *label.index)), label.index
    if label.matrix or label.change or label.unit:
        return label
    while spelled in taken:
        spelled, index = f"{spelled}_{INDEX}", (*index, INDEX)
    return replace(label, index=index)
