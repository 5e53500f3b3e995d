"""Labels as Matplotlib's mathtext reads them."""

from __future__ import annotations

from lagcli.pictures.drawing import DrawnName


def tex(label: DrawnName) -> str:
    """A label as mathtext reads it; what it cannot read is written plainly."""
    return label.tex if _is_readable(label.tex) else plainly(label.plain)


def plainly(words: str) -> str:
    """Words in which nothing is a formula."""
    return words.replace("$", r"\$")


_readable: dict[str, bool] = {}


def _is_readable(text: str) -> bool:
    from matplotlib.mathtext import MathTextParser

    if text not in _readable:
        try:
            MathTextParser("path").parse(text)
        except (ValueError, RuntimeError):
            _readable[text] = False
        else:
            _readable[text] = True
    return _readable[text]
