"""A body slides off a cylinder: in Cartesian coordinates the constraint is a distance."""

from __future__ import annotations

import pytest

from lagcli.mechanics.statements import Statements
from lagcli.reader import parse_text
from tests.mechanics.derived import derive, same

SURFACES = {
    "a - sqrt(x^2 + z^2) = 0": "N <= 0",
    "sqrt(x^2 + z^2) = a": "N >= 0",
    "sqrt(x^2 + z^2)/a = 1": "N >= 0",
    "3*a = 3*sqrt(z^2 + x^2)": "N <= 0",
    "x^2 + z^2 = a^2": "N >= 0",
}


def text(surface: str, holds: str, start: str) -> str:
    return f"""
coordinates: [x, z]
parameters:
  m: {{assume: positive, value: 1}}
  g: {{assume: positive, value: 9.81}}
  a: {{assume: positive, value: 2}}
  v: {{assume: positive, value: 1}}
T: m*(x'^2 + z'^2)/2
V: m*g*z
constraints:
  surface: {{equation: "{surface}", multiplier: N, holds_while: {holds}}}
initial: {{{start}}}
find:
  leaves: {{where: N = 0, for: z}}
  force: {{value: N, in_terms_of: [z]}}
"""


@pytest.mark.long
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize(
    ("start", "place"), [("x: 0, z: a", "2*a/3"), ("x: 0, z: a, x': v", "2*a/3 + v^2/(3*g)")]
)
def test_it_leaves_where_the_force_of_the_surface_ends(surface, start, place):
    """Two thirds of the height, from rest (Goldstein, Poole, Safko, 3rd ed., section 2.4)."""
    derivation = derive(text(surface, SURFACES[surface], start))
    found = Statements(derivation).answers(["find"]).sections["find"].answers
    [root] = found["leaves"].solutions
    assert same(derivation, derivation.system.build(root), place)
    force = derivation.system.build(found["force"].value)
    at = derivation.system.build(parse_text(place))
    assert force.xreplace({derivation.system.q[1]: at}).simplify() == 0
