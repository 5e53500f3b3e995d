"""Units in every notation: upright, products by spaces, powers raised."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from lagcli.formatters.latex_text import latex_text
from lagcli.formatters.latex_width import SCRIPT, text_width
from lagcli.units import Unit

_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_THIN_SPACE = 3  # points


def unicode_unit(unit: Unit) -> str:
    """Show a unit as `kg m²/s`."""
    return _written(unit, _unicode_power, " ", str)


def latex_unit(unit: Unit) -> tuple[str, float]:
    r"""Set a unit as `\mathrm{kg}\,\mathrm{m}^{2}/\mathrm{s}`, with its width in points."""
    width = sum(text_width(name) + SCRIPT * 6 + _THIN_SPACE for name, _ in unit.factors)
    return _written(unit, _latex_power, r"\,", str), width + 6


def mathml_unit(unit: Unit) -> str:
    """Set a unit with upright letters."""
    space = "<mspace width='0.17em'/>"
    return f"<mrow>{_written(unit, _mathml_power, space, _mathml_mark)}</mrow>"


def _unicode_power(name: str, power: Fraction) -> str:
    if power == 1:
        return name
    if power.denominator == 1:
        return name + str(power).translate(_SUPERSCRIPTS)
    return f"{name}^({power})"


def _latex_power(name: str, power: Fraction) -> str:
    plain = name.isascii() and name.isalpha()
    shown = rf"\mathrm{{{name}}}" if plain else rf"\text{{{latex_text(name)}}}"
    return shown if power == 1 else f"{shown}^{{{power}}}"


def _mathml_power(name: str, power: Fraction) -> str:
    from html import escape

    shown = f"<mi mathvariant='normal'>{escape(name)}</mi>"
    return shown if power == 1 else f"<msup>{shown}<mn>{power}</mn></msup>"


def _mathml_mark(mark: str) -> str:
    if mark[0].isdigit():
        return f"<mn>{mark}</mn>"
    return f"<mo stretchy='false' lspace='0' rspace='0'>{mark}</mo>"


def _written(
    unit: Unit, raised: Callable[[str, Fraction], str], between: str, mark: Callable[[str], str]
) -> str:
    """Numerator and denominator; several units below the line are in brackets."""
    above = [raised(name, power) for name, power in unit.factors if power > 0]
    below = [raised(name, -power) for name, power in unit.factors if power < 0]
    if unit.number != 1:
        above.insert(0, mark(f"{unit.number:.6g}"))
    shown = between.join(above) or mark("1")
    if not below:
        return shown
    under = between.join(below)
    return shown + mark("/") + (f"{mark('(')}{under}{mark(')')}" if len(below) > 1 else under)
