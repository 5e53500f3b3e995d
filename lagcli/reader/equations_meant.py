"""Equations of motion of a file as the energies, the dissipation and the forces that give them."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from lagcli.expression import FUNCTIONS
from lagcli.reader.misshapen import pieces


def energies_of(
    equations: Sequence[str], coordinates: Collection[str], constants: Collection[str]
) -> str:
    """`T: m*x'^2/2, V: k*x^2/2` for `m*x'' + k*x = 0`; nothing for what is not linear.

    Each equation is that of one coordinate: a*q'' + c*q' + k*q = Q(t) with constants.
    """
    parts: dict[str, list[str]] = {"T": [], "V": [], "dissipation": []}
    forces: dict[str, str] = {}
    keys = {"''": ("T", "'"), "'": ("dissipation", "'"), "": ("V", "")}
    known = {*constants, *FUNCTIONS, "t", "pi"}
    for text in equations:
        sides = text.split("=")
        own = {*re.findall(r"[^\W\d]\w*", text)} & {*coordinates}
        if len(sides) != 2 or len(own) != 1 or own & forces.keys():
            return ""
        q, force, has_mass = own.pop(), [], False
        for place, side in enumerate(sides):
            signed = re.sub(r"(?<=[\w)'])\s*(?=-)", "+", side.replace(" ", ""))
            for term in pieces(signed, "+"):
                is_negative = term.startswith("-") != (place == 1)  # on the left side
                bare = term.lstrip("+-").replace("+-", "-")
                moving = re.fullmatch(rf"((?:[\w.^]+[*/])*)({q})('*)((?:[*/][\w.^]+)*)", bare)
                words = re.findall(r"[^\W\d]\w*", bare)
                if moving and q in words:
                    words.remove(q)
                if bare in {"", "0"}:
                    continue
                if not {*words} <= ({*constants} if moving else known):
                    return ""
                if moving is None:
                    force.append("-" * (not is_negative) + bare)
                    continue
                if moving[3] not in keys or moving[1].endswith("/"):
                    return ""
                key, prime = keys[moving[3]]
                has_mass |= key == "T" and not is_negative
                parts[key].append(f"{'-' * is_negative}{moving[1]}{q}{prime}^2{moving[4]}/2")
        if not has_mass:
            return ""
        forces[q] = " + ".join(force).replace("+ -", "- ")
    lines = [f"{key}: {' + '.join(terms)}" for key, terms in parts.items() if terms]
    driven = ", ".join(f"{q}: {force}" for q, force in forces.items() if force)
    lines += [f"forces: {{{driven}}}"] if driven else []
    return "; ".join(lines).replace("+ -", "- ") if {*forces} == {*coordinates} else ""
