"""Equations of motion of a file as the energies, the dissipation and the forces that give them."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from lagcli.expression import FUNCTIONS
from lagcli.reader.expressions import signed_terms


def energies_of(
    equations: Sequence[str], coordinates: Collection[str], constants: Collection[str]
) -> str:
    """`T: m*x'^2/2, V: k*x^2/2` for `m*x'' + k*x = 0`; nothing for what is not linear.

    Each equation is that of one coordinate: a*q'' + c*q' + k*q = Q(t) with constants.
    """
    parts: dict[str, list[str]] = {"T": [], "V": [], "dissipation": []}
    keys = {"''": ("T", "'"), "'": ("dissipation", "'"), "": ("V", "")}
    forces: dict[str, str] = {}
    known = {*constants, *FUNCTIONS, "t", "pi"}
    for text in equations:
        left, _, right = text.partition("=")
        own = {*re.findall(r"[^\W\d]\w*", text)} & {*coordinates}
        terms = [*signed_terms(left), *((not minus, each) for minus, each in signed_terms(right))]
        if len(own) != 1 or own & forces.keys() or not (signed_terms(left) and signed_terms(right)):
            return ""
        q, force, masses = own.pop(), [], len(parts["T"])
        for is_negative, term in terms:  # on the left side
            moving = re.fullmatch(
                rf"((?:[\w.^]+[*/])*(?<!/))({q})('{{0,2}})((?:[*/][\w.^]+)*)", term
            )
            words = re.findall(r"[^\W\d]\w*", term)
            if moving:
                words.remove(q)
                key, prime = keys[moving[3]]
                if key == "T" and is_negative:
                    return ""
                parts[key].append(f"{'-' * is_negative}{moving[1]}{q}{prime}^2{moving[4]}/2")
            elif term != "0":
                force.append("-" * (not is_negative) + term)
            if not {*words} <= ({*constants} if moving else known):
                return ""
        if len(parts["T"]) == masses:
            return ""
        forces[q] = " + ".join(force).replace("+ -", "- ")
    lines = [f"{key}: {' + '.join(terms)}" for key, terms in parts.items() if terms]
    driven = ", ".join(f"{q}: {force}" for q, force in forces.items() if force)
    lines += [f"forces: {{{driven}}}"] if driven else []
    return "; ".join(lines).replace("+ -", "- ") if {*forces} == {*coordinates} else ""
