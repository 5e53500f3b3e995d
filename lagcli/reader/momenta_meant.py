"""A function of velocities as one on phase space: `x*p_y - y*p_x` for `m*(x*y' - y*x')`.

The momenta are p = ∂T/∂q', where T is a sum of squares of single velocities.
"""

from __future__ import annotations

import re

from lagcli.diagnostics import Source
from lagcli.expression import (
    ZERO,
    Expression,
    Name,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    name_nodes,
    terms_of,
)
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.regex import regex
from lagcli.reader.text import SourceText

#: Factors above and below of the square of a velocity.
_Factors = tuple[list[str], list[str]]
#: `p_r^2/(2*m)`, a kinetic energy by a momentum.
_SQUARE = regex(r"p_(?P<name>\w+)\^2/\(?(?P<below>(?:\w+(?:\^\d)?\*)*\w+(?:\^\d)?)\)?")
_HALF = regex(r"0\.5|\(\w+/2\)")


def with_momenta(text: str, kinetic: Expression, source: SourceText) -> str:
    """The text with momenta for velocities; nothing where T mixes velocities or lacks one.

    The places of T point into the `source`.
    """
    squares: dict[str, _Factors] = {}
    used = {*re.findall(r"([^\W\d]\w*)'(?!')", text)}
    if not _squares(kinetic, ([], []), squares, source) or not used or not used <= squares.keys():
        return ""
    inertia = {name: _inertia(squares[name]) for name in used}
    if len({*inertia.values()}) == 1:
        letters = next(iter(inertia.values())).replace(" ", "")
        common = r"\s*".join(map(re.escape, letters))
        if whole := re.fullmatch(rf"\s*{common}\s*\*\s*(?:\(([^()]*)\)|(\w+'))\s*", text):
            text = whole[1] or whole[2]
            inertia = dict.fromkeys(used, "1")

    def momentum(found: re.Match[str]) -> str:
        divisor = inertia[found[1]]
        grouped = divisor if re.fullmatch(r"\w+|\([^()]*\)", divisor) else f"({divisor})"
        return f"(p_{found[1]}/{grouped})" if divisor != "1" else f"p_{found[1]}"

    return re.sub(r"([^\W\d]\w*)'", momentum, text)


def with_velocities(text: str) -> str:
    """`m*x'^2/2` for `p_x^2/(2*m)`; nothing where a term has no single square of a momentum.

    T = p^2/(2 a) with p = a q' is a q'^2/2; terms without momenta stay as they are.
    """
    source, changed, formula = SourceText.of(Source("", text)), text, formula_or_none(text)
    for term in reversed(terms_of(formula) if formula is not None else ()):
        start, end = source.offsets(term.span)
        if not re.search(r"(?<!\w)p_", text[start:end]):
            continue
        found = _SQUARE.fullmatch(text[start:end])
        divisors = [] if found is None else found["below"].split("*")
        if found is None or "2" not in divisors:
            return ""
        divisors.remove("2")
        whole = "*".join([*divisors, f"{found['name']}'^2/2"])
        changed = changed[:start] + whole + changed[end:]
    return changed if changed != text else ""


def rate_of(name: str, text: str) -> str:
    """`p_phi/(m*r^2)` for the velocity of phi; nothing where the file does not say it plainly."""
    energies: dict[str, str] = dict(re.findall(r"^([HTL]):\s*(\S.*?)\s*$", text, re.MULTILINE))
    squares = [each for each in _SQUARE.finditer(energies.get("H", "")) if each["name"] == name]
    divisors = squares[0]["below"].split("*") if squares else []
    if "2" in divisors[:-1] and len(re.findall(rf"(?<!\w)p_{name}(?!\w)", energies["H"])) == 1:
        divisors.remove("2")
        return f"p_{name}/" + (f"({'*'.join(divisors)})" if divisors[1:] else divisors[0])
    law = energies.get("T") or energies.get("L", "")
    source = SourceText.of(Source("", law))
    moving = [each for each in terms_of(formula_or_none(law) or ZERO) if has_velocity(each)]
    found = with_momenta(f"{name}'", Sum(tuple(moving)), source)
    return re.sub(r"^\((.*)\)$", r"\1", found)


def _inertia(factors: _Factors) -> str:
    """`m*l^2` for the factors of `m*l^2*theta'^2/2`: twice them, p = 2 a q' where T = a q'^2."""
    above, below = [*factors[0]], [*factors[1]]
    half = next((each for each in above if _HALF.fullmatch(each)), None)
    if "2" in below:
        below.remove("2")
    elif half is not None:
        above[above.index(half)] = half.strip("()").removesuffix("/2")
        above = [each for each in above if each not in {"0.5", "1"}]
    else:
        above.insert(0, "2")
    return "*".join(above or ["1"]) + "".join(f"/{each}" for each in below)


def _squares(
    node: Expression, around: _Factors, found: dict[str, _Factors], source: SourceText
) -> bool:
    """Whether a term is a sum of squares of single velocities, whose factors are noted."""
    above, below = around
    match node:
        case Sum(terms=terms):
            return all(_squares(term, around, found, source) for term in terms)
        case Product(factors=factors):
            moving = [each for each in factors if has_velocity(each)]
            others = [_written(each, source) for each in factors if not has_velocity(each)]
            inner = ([*above, *others], below)
            return len(moving) == 1 and _squares(moving[0], inner, found, source)
        case Quotient(numerator=over, denominator=under) if not has_velocity(under):
            return _squares(over, (above, [*below, _written(under, source)]), found, source)
        case Power(base=Name(name=name, primes=1), exponent=Number(value=power)) if power == 2:
            is_new = name not in found
            found[name] = around
            return is_new
    return False


def has_velocity(node: Expression) -> bool:
    """Whether a name with a prime stands in a formula."""
    return any(each.primes for each in name_nodes(node))


def _written(node: Expression, source: SourceText) -> str:
    """The text of a factor, in parentheses where it is not one name or number."""
    text = source.written(node.span).strip()
    return text if re.fullmatch(r"[\w.]+(?:\^\w+)?", text) or text[:1] == "(" else f"({text})"
