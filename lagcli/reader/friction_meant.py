"""Friction under another key than `dissipation`, or not as one function of all velocities."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagcli.expression import FUNCTIONS
from lagcli.reader.foreign.translation import translated
from lagcli.reader.foreign.words import UnclearText, Vocabulary, rate_meant
from lagcli.reader.misshapen import as_rayleigh
from lagcli.reader.nodes import DocumentNode, Scalar
from lagcli.reader.regex import regex

FRICTION_WORD = regex(
    r"(?P<dry>fri[ck]|reib|frott|attrit|atrit|roz|roce|coulomb|wrijv|тре|tarcie)"
    r"|brems|damp|dämpf|demp|dashpot|absorber|amort|smorz|drag|dissip|rayleigh|visc",
    re.IGNORECASE,
)
#: Quantities of friction that are no factor of a velocity.
_OTHER = regex(r"ratio|factor|matrix|viscosity", re.IGNORECASE)
_NORMAL = ", with the normal force N written out, m*g on a level floor"
_SQUARE = regex(r"['’]\s*\)?\s*(?:(?:\^|\*\*)\s*2|²)|²")


def friction_meant(word: str, value: DocumentNode, coordinates: Sequence[str]) -> str:
    """`write dissipation: …`, or `write forces: …`, for the value of a key about friction.

    Laws are forces or their Rayleigh functions, a number or name is a coefficient.  Nothing where
    it is not clear what is meant.
    """
    about = FRICTION_WORD.search(word)
    if about is None or not coordinates or _OTHER.search(word):
        return ""
    lost: list[str] = []
    forces: dict[str, str] = {}
    remark = ""
    for name, written in _laws(value):
        law = _translated(written, coordinates)
        moving = [x for x in coordinates if re.search(rf"(?<!\w){re.escape(x)}['’]", law)]
        along = name if name in coordinates else (*moving, *coordinates)[0]
        is_alone = re.fullmatch(r"[\d.]+|[^\W\d]\w{0,3}(?:_\w+)?", law)
        is_by_name = name == along and law.startswith("-")
        size = law.lstrip("-− ")
        if re.fullmatch(r"[^\W\d]{5,}", law) or ("'" in law and not moving):
            return ""
        if moving and not is_by_name and (whole := as_rayleigh(law)):
            lost.append(whole)
        elif moving and _SQUARE.search(law) and "drag" in word.casefold():
            forces[along] = "-" + _SQUARE.sub(f"'*abs({along}')", size)
        elif moving and _SQUARE.search(law) and not re.search(r"abs|\||sign", law):
            lost.append(law)
        elif len(moving) == 1:
            forces[along] = law
        elif moving or (len(coordinates) > 1 and not about["dry"] and name != along):
            return ""
        elif re.search(r"(?<!\w)(?:mu|μ)", law) or (about["dry"] and not law.isidentifier()):
            forces[along] = f"-{size}{'*N' * bool(is_alone)}*sign({along}')"
            remark = _NORMAL * bool(is_alone)
            if is_alone and "m" not in law:
                remark += f"; viscous friction is dissipation: {law}*{along}'^2/2"
        elif is_alone:
            lost.append(f"{law}*{along}'^2/2")
            remark = f": its force is -{law}*{along}'"
        else:
            return ""
    if forces and lost:
        return ""
    if forces:
        written = ", ".join(f"{x}: {law}" for x, law in forces.items())
        return f"write forces: {{{written}}}{remark}"
    return f"write dissipation: {' + '.join(lost)}{remark if not lost[1:] else ''}" if lost else ""


def _translated(law: str, coordinates: Sequence[str]) -> str:
    """`-c*abs(x')*x'` for `-c |v| v`; other laws as they are."""
    names = Vocabulary((*coordinates,), frozenset())
    words = {each for each in re.findall(r"[^\W\d]\w*", law) if not rate_meant(each, names)}
    try:
        return translated(law, names._replace(others=frozenset(words - {*FUNCTIONS})))
    except UnclearText:
        return law


def _laws(value: DocumentNode, name: str = "") -> Iterator[tuple[str, str]]:
    """The texts in a value, each with the innermost key above it that may be a coordinate."""
    if isinstance(value, Scalar):
        yield name, value.value.strip()
    for key, inner in value.pairs:
        yield from _laws(inner, key.label)
    for item in value.parts:
        yield from _laws(item, name)
