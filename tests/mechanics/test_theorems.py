"""The theorems that answers name: a source each, and a place where the hypotheses are checked."""

from __future__ import annotations

import random
import re
from fractions import Fraction
from importlib import import_module
from pathlib import Path

import pytest

import lagcli
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.theorems import THEOREMS

from .derived import derive

SOURCES = Path(lagcli.__file__).parent
_NAMED = re.compile(r"\((Lagrange|Routh|Kelvin|Hurwitz|Lyapunov|Liouville)[^)]*\)")


@pytest.mark.parametrize("theorem", THEOREMS, ids=lambda theorem: theorem.name)
def test_a_theorem_has_its_check(theorem):
    module, _, path = theorem.checked_by.partition(":")
    found = import_module(module)
    for part in path.split(".") if path else ():
        found = getattr(found, part)
    assert theorem.hypotheses
    assert re.search(r"\d", theorem.source)


def test_no_other_theorem_is_named_by_the_judge():
    names = {theorem.name for theorem in THEOREMS}
    for path in (SOURCES / "mechanics" / "stability").glob("*.py"):
        for match in _NAMED.finditer(path.read_text().split('"""', 2)[-1]):
            assert match.group(0)[1:-1] in names


def _number(source: random.Random, least: int = -6, most: int = 6) -> str:
    return f"({Fraction(source.randint(least, most) or 1, source.choice((1, 2, 3)))})"


def _system(source: random.Random) -> tuple[str, str, str, str]:
    """T, V, D and a gyroscopic term in X, Y and their rates."""
    a, b, c = _number(source), _number(source), _number(source)
    V = f"({a}*X^2 + {b}*Y^2)/2 + X*Y/{source.randint(2, 9)} + {c}*X^2*Y"
    if source.random() < 0.5:
        V = V.replace("(-", "(")
    D = source.choice(("0", "X'^2", "X'^2 + Y'^2", "(X' - Y')^2"))
    return f"({_number(source, 1, 6)}*X'^2 + Y'^2)/2", V, D, source.choice(("0", "2*(X*Y' - Y*X')"))


PLAIN = """
coordinates: [X, Y]
L: {T} - ({V}) + {G}
dissipation: {D}

"""
CURVED = """
coordinates: [u, v]
definitions: {{X: u + u*v/4, Y: v - u^2/3}}
L: {T} - ({V}) + {G}
dissipation: {D}
"""
SURFACE = """
coordinates: [X, Y, z]
L: {T} - ({V}) + {G} + (z - X*Y)*X/2
dissipation: {D}
constraints: {{surface: z = X*Y}}
"""


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_no_verdict_changes_with_the_coordinates(seed):
    """The same system in Cartesian and in curved coordinates, and with a multiplier."""
    T, V, D, G = _system(random.Random(seed))
    verdicts = []
    for text in (PLAIN, CURVED, SURFACE):
        found = equilibria(derive(text.format(T=T, V=V, D=D, G=G)).dynamics).equilibria
        origin = [
            e.verdict
            for e in found or ()
            if all(getattr(value, "value", None) == 0 for value in e.at.values())
        ]
        assert len(origin) == 1
        verdicts.append(origin[0])
    stable = [v.stable for v in verdicts]
    first_order = [v.stable is None and v.spectrum == () for v in verdicts]
    assert len(set(stable)) == 1 or (any(first_order) and False not in stable)
    assert len({v.asymptotic for v in verdicts}) == 1
