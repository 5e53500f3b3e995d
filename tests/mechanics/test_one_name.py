"""A thing has one name on a page, and a sentence one number for what it is about."""

from __future__ import annotations

import random

import pytest

from lagcli.document import Bracket, Equations, Heading, Paragraph
from lagcli.expression import Call, Name
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

_POSITIVE = "{assume: positive}"


def blocks(explanation, title):
    return [b for step in explanation.steps if step.title == title for b in step.blocks]


@pytest.mark.parametrize(
    "text",
    [
        "{coordinates: [x1], T: x1'^2/2, V: x1^2}",
        "{coordinates: {r: {assume: positive}, phi: {}}, T: (r'^2 + r^2*phi'^2)/2, V: -1/r}",
        "{coordinates: [theta], T: (1 + cos(theta))*theta'^2, V: 1 - cos(theta)}",
    ],
)
def test_a_bracket_has_the_names_of_the_headings(text):
    told = explain(derive(text), ["discovered", "algebra"])
    listed = {b.formula for b in blocks(told, "Discovered symmetries") if isinstance(b, Heading)}
    rows = [
        row.left
        for b in blocks(told, "The algebra of the symmetries")
        if isinstance(b, Equations)
        for row in b.rows
        if isinstance(row.left, Bracket)
    ]
    assert rows
    assert {name for each in rows for name in (each.left, each.right)} <= listed


@pytest.mark.parametrize("title", ["Equilibria", "Small oscillations", "Steady motions"])
def test_a_function_of_the_file_is_set_as_in_formulas(title):
    text = "{coordinates: [x], functions: {Phi: [q]}, T: x'^2/2, V: Phi(x)}"
    sections = ["equilibria", "modes", "steady_motions"]
    said = [b.parts for b in blocks(explain(derive(text), sections), title) if hasattr(b, "parts")]
    about = next(parts for parts in said if any("not specified" in str(p) for p in parts))
    assert Name("Phi") in about
    assert not any("Phi" in part for part in about if isinstance(part, str))


@pytest.mark.parametrize("number", [1, 2])
def test_one_constraint_allows_and_two_allow(number):
    constraints = dict(list({"rod1": "x^2 + y^2 = 1", "plane": "z = x^2"}.items())[:number])
    text = (
        "{coordinates: [x, y, z], T: (x'^2 + y'^2 + z'^2)/2, V: y + z^2, constraints: {"
        + ", ".join(f"{name}: {{equation: {f}}}" for name, f in constraints.items())
        + "}}"
    )
    told = words(explain(derive(text), ["canonical_equations", "equilibria", "modes", "model"]))
    pairs = [
        ("that the constraint allows", "that the constraints allow", 2),
        ("is 0 on the constraint:", "is 0 on the constraints:", 1),
        ("into the differentiated constraint.", "into the differentiated constraints.", 1),
        ("plus the force of the constraint:", "plus the forces of the constraints:", 1),
    ]
    for *forms, times in pairs:
        wanted, other = forms if number == 1 else forms[::-1]
        assert told.count(wanted) >= times
        assert other not in told
    assert "'rod1': kept" in told


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("M", "straight"), [("1", True), ("(1 + u^2)^2", False)])
def test_the_arc_is_named_where_it_is_not_the_coordinate(seed, M, straight):
    """M q'^2/2 and w^2 s^2/2 with s = q, or s = q + q^3/3."""
    w, mass = (random.Random(seed).randint(1, 9) for _ in range(2))
    s = "u" if straight else "(u + u^3/3)"
    text = f"{{coordinates: [u], T: {mass}*{M}*u'^2/2, V: {w}*{s}^2/2}}"
    told = words(explain(derive(text), ["reduction"]), "The reduction")
    assert "The motion is that of a harmonic oscillator" in told
    assert ("oscillator in the arc" in told) is not straight


def test_at_a_pole_the_displacements_have_names():
    text = (
        f"{{coordinates: {{theta: {{}}, phi: {{}}}}, parameters: {{g: {_POSITIVE}}}, "
        "T: (theta'^2 + sin(theta)^2*phi'^2)/2, V: -g*cos(theta)}"
    )
    told = blocks(explain(derive(text), ["modes"]), "Small oscillations")
    parts = [part for b in told if isinstance(b, Paragraph) for part in b.parts]
    phi = (Name("phi"),)
    assert {Name("theta"), Call("cos", phi), Call("sin", phi)} <= {
        part for part in parts if not isinstance(part, str)
    }


def test_cartesian_coordinates_stand_in_the_order_of_the_axes_of_the_charges():
    """L_z is p_phi: the third one is that of the axis."""
    text = (
        f"{{coordinates: {{r: {_POSITIVE}, theta: {{}}, phi: {{}}}}, "
        "T: (r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2, V: r^4}"
    )
    derivation = derive(text)
    assert any(c.name == "L_x" for c in derivation.discovery.charges)
    x, y, z = map(str, derivation.discovery.cartesian)
    assert ("cos(phi)" in x, "sin(phi)" in y, "phi" in z) == (True, True, False)
