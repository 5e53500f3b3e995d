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
from lagcli.mechanics.reduction.separation import levi_civita
from lagcli.mechanics.theorems import THEOREMS
from lagcli.reader import parse_text

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


# -- Noether, Frobenius, Levi-Civita: both answers, on systems made to have one ---------------------


@pytest.mark.parametrize("seed", range(6))
def test_noether_applies_where_the_action_changes_by_a_boundary_term(seed):
    """L + dF/dt of a translation in x, once with a force along x and once without."""
    source = random.Random(seed)
    F = source.choice(["x^2*t", "x*sin(t)", "x^3", "x*y"])
    gauge = {"x^2*t": "2*x*t", "x*sin(t)": "sin(t)", "x^3": "3*x^2", "x*y": "y"}[F]
    total = {
        "x^2*t": "2*x*t*x' + x^2",
        "x*sin(t)": "x'*sin(t) + x*cos(t)",
        "x^3": "3*x^2*x'",
        "x*y": "x'*y + x*y'",
    }[F]
    for force, expected in (("0", True), (f"-{source.randint(1, 4)}*x", False)):
        noether = derive(f"""
coordinates: [x, y]
L: x'^2*(1 + y^2)/2 + y'^2/2 - y^4 + {total}
forces: {{x: {force}}}
symmetries: {{shift: {{x: 1, gauge: {gauge}}}, wrong: {{x: 1, gauge: {gauge} + x}}}}
""").noether
        shift, wrong = noether.charges[:2]
        assert noether.applies(shift) is expected
        assert noether.applies(wrong) is False
        assert shift.conserved is expected


@pytest.mark.parametrize("seed", range(6))
def test_frobenius_finds_the_integrable_part(seed):
    """f dg is integrable with any f; with the contact form dz - y dx beside it one form is."""
    source = random.Random(seed)
    f = source.choice(["(1 + x^2)", "exp(y)", "(2 + z^2)"])
    g = source.choice([("2*x", "1", "0"), ("y", "x", "2*z"), ("0", "1", "z^2")])
    disguised = " + ".join(f"{f}*({a})*{v}'" for a, v in zip(g, "xyz", strict=True))
    head = "coordinates: [x, y, z]\nL: (x'^2 + y'^2 + z'^2)/2\n"
    constraints = derive(f"{head}constraints: {{one: {disguised} = 0}}\n").dynamics.constraints
    assert len(constraints.integrable_forms()) == 1
    assert constraints.kinds == {"one": "integrable"}
    contact = derive(f"{head}constraints: {{two: z' = y*x'}}\n").dynamics.constraints
    assert contact.integrable_forms() == []
    assert contact.kinds == {"two": "nonholonomic"}


@pytest.mark.parametrize("seed", range(6))
def test_levi_civita_separates_a_liouville_system_and_no_other(seed):
    """(p_x²/2 + p_y²/2 + U(x) + V(y))/(A(x) + B(y)) separates, an added x y² does not."""
    source = random.Random(seed)
    A, U = (source.choice(["x^2", "cosh(x)", "2 + sin(x)"]) for _ in range(2))
    B, V = (source.choice(["y^4", "1 + y^2", "exp(y)"]) for _ in range(2))
    system = derive("{coordinates: [x, y], L: x'^2 + y'^2 + x*y}").system

    def build(text):
        return system.build(parse_text(text))

    H = build(f"(p_x^2/2 + p_y^2/2 + {U} + {V})/({A} + {B})")
    assert levi_civita(H, system.q, system.momenta) == (True, None)
    assert levi_civita(H + build("x*y^2"), system.q, system.momenta) == (False, (0, 1))
