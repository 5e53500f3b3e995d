"""Warnings of forces that look like friction and are none: of the wrong sign, or along another x.

Friction along x has the sign of -x' and takes power, x' F < 0.  A force along x that depends on y'
does so in magnetic fields and rotating frames, with the opposite sign along y.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import NamedTuple

from lagcli.diagnostics import Diagnostic, Source
from lagcli.expression import Call, Expression, name_nodes, terms_of, walk
from lagcli.reader.plain_sign import plain_sign
from lagcli.reader.regex import balanced, regex
from lagcli.reader.text import SourceText, as_sum

#: What dry friction is proportional to.
_NORMAL = frozenset({"g", "N", "F_N"})
_COEFFICIENT = regex(r"(?:mu|μ)(?:_?\w{1,2})?")
_warning = partial(Diagnostic, severity="warning")


def friction_slips(
    forces: Mapping[str, Expression],
    coordinates: tuple[str, ...],
    signs: Mapping[str, int],
    source: Source,
) -> Iterator[Diagnostic]:
    """A warning for each force that drives where friction would brake, or brakes another motion."""
    text = SourceText.of(source)
    laws = {x: [*_laws(force, coordinates, signs)] for x, force in forces.items()}
    for x, found in laws.items():
        for law in found if not _rates(forces[x]) else ():
            message = f"this friction along {x} does not change its sign with {x}'"
            yield _warning(
                message, law.term.span, f"write {text.written(law.term.span)}*sign({x}')"
            )
        own = [law for law in found if law.along == x]
        is_alone = len(own) == 1 and _rates(forces[x]) == {x}
        for law in own if is_alone else ():
            if law.sign > 0:
                message = f"this force along {x} drives the motion: it has the sign of {x}'"
                whole = opposite(law.term, text)
                whole = f": {whole}" if whole else f", as in -c*{x}'"
                yield _warning(message, law.term.span, f"friction is opposite to it{whole}")
        others = [law for law in found if law.along not in {"", x}]
        for law in others if not own and len(others) == 1 and _rates(forces[x]) != {x} else ():
            back = [each for each in laws.get(law.along, ()) if each.along == x]
            is_swapped = bool(back) and back[0].sign == law.sign == -1
            if is_swapped or (law.is_dry and not back):
                message = f"this force along {x} is against the velocity {law.along}'"
                hint = f"friction along {x} depends on {x}'"
                yield _warning(message, law.term.span, hint)


def opposite(formula: Expression, text: SourceText) -> str:
    """The terms with the other sign: `-mu*m*g*sign(x')`; nothing where a parenthesis is cut."""
    terms = [text.written(term.span) for term in terms_of(formula)]
    turned = [each[1:].strip() if each[0] == "-" else f"-{each}" for each in terms]
    return as_sum(turned) if all(map(balanced, terms)) else ""


class _Law(NamedTuple):
    """A term that is odd in one velocity, times constants, or the friction -mu*m*g."""

    term: Expression
    along: str  #: the coordinate with that velocity, if any
    sign: int  #: of the term where the velocity is positive
    is_dry: bool  #: with sign(x')


def _laws(
    force: Expression, coordinates: tuple[str, ...], signs: Mapping[str, int]
) -> Iterator[_Law]:
    for term in terms_of(force):
        names = name_nodes(term)
        rates = {each.name for each in names if each.primes}
        constants = {each.name for each in names if not each.primes}
        known = constants <= signs.keys()
        is_dry = constants & _NORMAL and any(map(_COEFFICIENT.fullmatch, constants))
        if not rates and known and is_dry and plain_sign(term, signs, {}, 1) == -1:
            yield _Law(term, "", -1, True)
        if len(rates) != 1 or not known or not rates <= {*coordinates}:
            continue
        [along] = rates
        forward, backward = (plain_sign(term, signs, {}, rate) for rate in (1, -1))
        if forward and forward == -backward:
            dry = any(isinstance(node, Call) and node.function == "sign" for node in walk(term))
            yield _Law(term, along, forward, dry)


def _rates(force: Expression) -> set[str]:
    return {node.name for node in name_nodes(force) if node.primes}
