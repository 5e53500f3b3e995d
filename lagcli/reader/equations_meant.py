"""Equations of motion of a file as the energies, the dissipation and the forces that give them."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from lagcli.expression import FUNCTIONS
from lagcli.reader.expressions import signed_terms
from lagcli.reader.text import as_sum


def energies_of(
    equations: Sequence[str], coordinates: Collection[str], constants: Collection[str]
) -> str:
    """`T: m*x'^2/2; V: k*x^2/2` for `m*x'' + k*x = 0`; nothing without one q'' in each equation.

    Each equation is that of one coordinate, a*q'' + c*q' + k*q = Q, with constants a, c and k and
    a force Q of whatever is left.
    """
    parts: dict[str, list[str]] = {"T": [], "V": [], "dissipation": []}
    keys = {"''": ("T", "'"), "'": ("dissipation", "'"), "": ("V", "")}
    forces: dict[str, str] = {}
    known = {*constants, *coordinates, *FUNCTIONS, "t", "pi"}
    for text in equations:
        left, _, right = text.partition("=")
        own = {*re.findall(r"([^\W\d]\w*)''", text)} & {*coordinates} - forces.keys()
        sides = signed_terms(left), signed_terms(right)
        words = {*re.findall(r"[^\W\d]\w*", text)}
        if len(own) != 1 or text.count("''") != 1 or not (all(sides) and words <= known):
            return ""
        q, force = own.pop(), []
        linear = rf"((?:[\w.^]+[*/])*|\(.*\)\*)(?<!/)({q})('{{0,2}})((?:[*/][\w.^]+)*)"
        for is_negative, term in [*sides[0], *((not minus, each) for minus, each in sides[1])]:
            moving = re.fullmatch(linear, term)  # on the left side
            factors = f"{moving[1]} {moving[4]}" if moving else ""
            if moving and {*re.findall(r"[^\W\d]\w*", factors)} <= {*constants}:
                key, prime = keys[moving[3]]
                if key == "T" and is_negative:
                    return ""
                parts[key].append(f"{'-' * is_negative}{moving[1]}{q}{prime}^2{moving[4]}/2")
            elif "''" in term:
                return ""
            elif term != "0":
                force.append("-" * (not is_negative) + term)
        forces[q] = as_sum(force)
    lines = [f"{key}: {' + '.join(terms)}" for key, terms in parts.items() if terms]
    driven = ", ".join(f"{q}: {force}" for q, force in forces.items() if force)
    lines += [f"forces: {{{driven}}}"] if driven else []
    return "; ".join(lines).replace("+ -", "- ") if {*forces} == {*coordinates} else ""
