r"""Names in LaTeX, each with its width: `theta_1` is \theta_{1}, its velocity \dot{\theta}_{1}."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from unicodedata import normalize

from lagcli.document import Label
from lagcli.formatters.latex_text import latex_text
from lagcli.formatters.latex_width import SCRIPT, text_width
from lagcli.notation.greek import BY_NAME, LATEX, latex_of_name
from lagcli.notation.naming import name_parts
from lagcli.record import replace

_DOTS = {1: r"\dot", 2: r"\ddot"}
_PLAIN_WORD = re.compile(r"[A-Za-z]+")
_BASE_AND_REST = re.compile(r"(\\[A-Za-z]+|[A-Za-z])\s*([_^].*)")


class LatexNames:
    """How the names of one file are set.

    Parameters
    ----------
    coordinates : collection of str
        Their momenta `p_x` carry the whole coordinate as a subscript.
    symbols : mapping of str to str
        LaTeX that the file itself gives; the reader has let only harmless macros pass.
    variants : collection of str
        `varphi` where `phi` is to have that shape, and so on.
    """

    def __init__(
        self,
        coordinates: Collection[str] = (),
        symbols: Mapping[str, str] | None = None,
        variants: Collection[str] = (),
    ) -> None:
        self.coordinates = coordinates
        self.symbols = symbols or {}
        self.variants = variants

    def name(self, name: str, primes: int = 0) -> str:
        """Set a name with its time derivatives as dots."""
        base, subscripts = self._parts(name)
        if primes in _DOTS:
            base = f"{_DOTS[primes]}{{{base}}}"
        index = f"_{{{subscripts}}}" if subscripts else ""
        shown = base + index
        if name in self.symbols or (index and primes > 2):
            shown = f"{{{shown}}}"
        return shown + "'" * primes if primes > 2 else shown

    def width(self, name: str, primes: int = 0) -> float:
        """Estimate the width of a name in points."""
        if name in self.symbols:
            return text_width(re.sub(r"\\[A-Za-z]+", "m", self.symbols[name])) + 3 * primes
        if self._is_momentum(name):
            return text_width("p") + SCRIPT * self.width(name[2:]) + 3 * primes
        parts = name_parts(name)
        size = text_width(_as_wide(parts.base))
        indices = [_as_wide(each) for each in parts.subscripts]
        return size + SCRIPT * text_width(",".join(indices)) + 3 * max(0, primes - 2)

    def bare(self, name: str) -> bool:
        """Whether a function may stand before the name without brackets."""
        return name not in self.symbols

    def label(self, label: Label) -> tuple[str, float]:
        """Set a symbol of the page; with its width."""
        if label.unit:
            inner, size = self.label(replace(label, unit=False))
            return f"{{[{inner}]}}", size + 6  # a bare [ behind \\\\ would be its argument
        width = self.width(label.letter) + 2
        if label.change:
            return rf"\Delta {self.name(label.letter)}", width + 9
        plain = normalize("NFKC", label.letter)  # of a 𝐌 that stands for M
        letter = rf"\mathbf{{{plain}}}" if label.matrix else self.name(label.letter)
        if not label.index:
            return letter, width
        index = ",".join(self.subscript(each) for each in label.index)
        size = SCRIPT * sum(self.width(each) + 3 for each in label.index)
        return f"{letter}_{{{index}}}", width + size

    def subscript(self, text: str) -> str:
        """Set one subscript: a number, a letter, or a word upright."""
        if text in self.coordinates:
            return self.name(text)
        if text.isascii() and text.isdigit():
            return text
        letter = self._letter(text) or LATEX.get(text)
        if letter or _PLAIN_WORD.fullmatch(text):
            return letter or (text if len(text) == 1 else rf"\mathrm{{{text}}}")
        parts = name_parts(text)
        if parts.subscripts and parts.base != text:
            inner = "".join(parts.subscripts)
            return f"{self.subscript(parts.base)}_{{{self.subscript(inner)}}}"
        return rf"\text{{{latex_text(text)}}}"

    def _parts(self, name: str) -> tuple[str, str]:
        """Set the letter or word, and its subscripts."""
        symbol = self.symbols.get(name)
        if symbol is not None:
            symbol = _ascii(symbol)
            match = _BASE_AND_REST.fullmatch(symbol)
            if match and match[2].startswith("_") and not match[1].startswith(r"\math"):
                return match[1], _unbraced(match[2][1:])
            return symbol, ""
        if self._is_momentum(name):
            return "p", self.name(name[2:])
        parts = name_parts(name)
        word = parts.base == "lambda"  # a multiplier carries the name of its constraint
        shown = [self._multiplier(s) if word else self.subscript(s) for s in parts.subscripts]
        return self._base(parts.base), ",".join(shown)

    def _letter(self, name: str) -> str | None:
        """The macro of a spelled letter."""
        return latex_of_name(f"var{name}" if f"var{name}" in self.variants else name)

    def _is_momentum(self, name: str) -> bool:
        return name.startswith("p_") and name[2:] in self.coordinates

    def _multiplier(self, constraint: str) -> str:
        if len(constraint) > 1 and _PLAIN_WORD.fullmatch(constraint):
            return self._letter(constraint) or rf"\text{{{constraint}}}"
        return self.subscript(constraint)

    def _base(self, base: str) -> str:
        letter = self._letter(base) or LATEX.get(base)
        if letter or (len(base) == 1 and base.isascii() and base.isalpha()):
            return letter or base
        if _PLAIN_WORD.fullmatch(base):
            return rf"\mathit{{{base}}}"
        return rf"\text{{{latex_text(base)}}}"


def _as_wide(word: str) -> str:
    """Latin letters as wide as a word is set: a Greek letter is one of them."""
    letter = BY_NAME.get(word, word)
    if letter not in LATEX:
        return word
    return "m" if letter.isupper() else "J"


def _ascii(symbol: str) -> str:
    """Put the file's own LaTeX with letters beyond ASCII into macros."""
    return "".join(
        c if c.isascii() else LATEX[c] + " " if c in LATEX else rf"\text{{{latex_text(c)}}}"
        for c in symbol
    )


def _unbraced(index: str) -> str:
    inner = index.strip()
    whole = inner.startswith("{") and inner.endswith("}") and inner.count("{") == 1
    return inner[1:-1] if whole else inner
