"""The name of an algebra that depends on the signs of parameters is not printed for all of them.

Free motion with a quadratic form of signature (2, 0) or (1, 1): rotations so(2), or boosts so(1,1)
(Niederer, Helv. Phys. Acta 45 (1972) 802).
"""

from __future__ import annotations

from random import Random

import pytest
from flint import arb, arb_mat, ctx

from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.verification import verified
from lagcli.verification.claims.algebra import signs
from lagcli.verification.examination import Examination
from tests.solved import solve

ROTATIONS = "Schrödinger sch(2): sl(2,R) + so(2) with Heisenberg h(2), modulo constants"
BOOSTS = "sl(2,R) + so(1,1) with Heisenberg h(2), modulo constants"
POSITIVE = "{a: {assume: positive}, b: {assume: positive}, c: {assume: positive}}"


def _solved(form: str, parameters: str):
    text = f"coordinates: [x, y]\nparameters: {parameters}\nL: ({form})/2\n"
    problem = read_problem("test.yaml", text.encode()).checked()
    return problem, solve(problem, ["discovered", "algebra"])


@pytest.mark.parametrize(
    ("form", "parameters", "name"),
    [
        ("a*x'^2 + c*y'^2", POSITIVE, ROTATIONS),
        ("a*(x' + b*y')^2 + c*y'^2", POSITIVE, ROTATIONS),
        ("a*(x' + b*y')^2 - c*y'^2", POSITIVE, BOOSTS),
        ("a*x'*y' + c*y'^2", POSITIVE, BOOSTS),
        ("a*x'^2 + c*y'^2", "[a, c]", None),
        ("a*x'^2 + 2*b*x'*y' + c*y'^2", "[a, b, c]", None),
        ("a*x'^2 + 2*b*x'*y' + c*y'^2", POSITIVE, None),
        ("(a - b)*x'^2 + c*y'^2", POSITIVE, None),
    ],
)
def test_the_signs_of_parameters_decide_the_name(
    form: str, parameters: str, name: str | None
) -> None:
    problem, answers = _solved(form, parameters)
    assert answers.complete, answers.warnings
    section = answers.sections["algebra"]
    assert (section.dimension, section.name) == (8, name)
    for other in {ROTATIONS, BOOSTS} - {name}:
        wrong = {**answers.sections, "algebra": replace(section, name=other)}
        found = verified(problem, replace(answers, sections=wrong))
        assert found.sections["algebra"].name is None
        assert not found.complete


def test_velocities_in_abbreviations_are_seen() -> None:
    """A displacement k_1 sin(w t) with k_1 = x' is none of a point symmetry."""
    problem, _ = _solved("x'^2 + y'^2", "[a]")
    examination = Examination(problem)
    examination.define("abbreviations", {"k": parse_text("x'*y"), "s": parse_text("k + y")})
    assert examination.has_velocities(parse_text("2*s"))
    assert not examination.has_velocities(parse_text("2*y"))


@pytest.mark.parametrize("seed", range(12))
def test_the_signature_of_a_form_is_that_in_any_basis(seed: int) -> None:
    """Sylvester's law of inertia, with equal squares as those of two so(3) side by side."""
    random = Random(seed)
    n = random.randint(3, 15)
    squares = [arb(random.choice([-5, -1, 0, 0, 1, 2])) for _ in range(n)]
    with ctx.workprec(200):
        basis = arb_mat([[arb(random.randint(-9, 9)) / 7 for _ in range(n)] for _ in range(n)])
        rows = [[x if i == j else arb(0) for j in range(n)] for i, x in enumerate(squares)]
        found = signs((basis * arb_mat(rows) * basis.transpose()).tolist())
    assert found == (sum(x > 0 for x in squares), sum(x < 0 for x in squares))


def test_two_bodies_have_a_name_whatever_they_are_called() -> None:
    text = (
        "coordinates: [a, b, c, x, y, z]\n"
        "parameters: {M: {assume: positive}, m: {assume: positive}, k: {assume: positive}}\n"
        "T: M*(a'^2 + b'^2 + c'^2)/2 + m*(x'^2 + y'^2 + z'^2)/2\n"
        "V: -k/sqrt((a - x)^2 + (b - y)^2 + (c - z)^2)\n"
    )
    problem = read_problem("test.yaml", text.encode()).checked()
    found = solve(problem, ["discovered", "algebra"])
    assert found.sections["algebra"].name == "Galilei in 3 dimensions + so(3), modulo constants"
    assert not found.warnings


def test_a_centre_among_the_charges_is_counted() -> None:
    """Geodesics of the group of Heisenberg: {A, B} = p_z, a turn and the energy: dimension 5."""
    text = "coordinates: [x, y, z]\nL: (x'^2 + y'^2 + (z' - x*y')^2)/2\n"
    problem = read_problem("test.yaml", text.encode()).checked()
    answers = solve(problem, ["discovered", "algebra"])
    section = answers.sections["algebra"]
    assert (section.dimension, section.name) == (5, "oscillator algebra + R")
    for wrong in ("oscillator algebra + R, modulo constants", "oscillator algebra + R^2"):
        beside = {**answers.sections, "algebra": replace(section, name=wrong)}
        assert verified(problem, replace(answers, sections=beside)).sections["algebra"].name is None


AT = ("where the energy is negative", "where it is 0", "where it is positive")


@pytest.mark.parametrize(
    ("n", "right"), [(2, ("so(3)", "e(2)", "sl(2,R)")), (3, ("so(4)", "e(3)", "so(3,1)"))]
)
def test_a_name_for_each_sign_of_the_energy_is_tried(n: int, right: tuple[str, ...]) -> None:
    """Kepler's problem: {A_i, A_j} = -2 m E epsilon_ijk L_k."""
    names = "xyz"[:n]
    square = " + ".join(f"{x}^2" for x in names)
    text = (
        f"coordinates: [{', '.join(names)}]\n"
        "parameters: {m: {assume: positive}, k: {assume: positive}}\n"
        f"T: m*({square.replace('^', chr(39) + '^')})/2\nV: -k/sqrt({square})\n"
    )
    problem = read_problem("test.yaml", text.encode()).checked()
    answers = solve(problem, ["discovered", "algebra"])
    assert answers.complete, answers.warnings
    section = answers.sections["algebra"]

    def named(kinds: tuple[str, ...]) -> str:
        return "the energy and " + ", ".join(map(" ".join, zip(kinds, AT, strict=True)))

    assert section.name == named(right)
    for wrong in (named(right[::-1]), named((right[0],) * 3), f"{right[0]} + R", "a great one"):
        spoiled = {**answers.sections, "algebra": replace(section, name=wrong)}
        found = verified(problem, replace(answers, sections=spoiled))
        assert found.sections["algebra"].name is None


@pytest.mark.parametrize(
    ("surface", "name"),
    [("x^2 + y^2 + z^2 = R^2", "so(3)"), ("z = b", "Schrödinger")],
)
def test_a_name_is_tried_on_constraints(surface: str, name: str) -> None:
    """{L_x, L_y} = L_z with Dirac's bracket of a sphere; a plane is free of its z."""
    text = (
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, R: {assume: positive}, b: {}}\n"
        f"T: m*(x'^2 + y'^2 + z'^2)/2\nconstraints: {{s: {surface}}}\n"
    )
    problem = read_problem("test.yaml", text.encode()).checked()
    answers = solve(problem, ["discovered", "algebra"])
    section = answers.sections["algebra"]
    assert section.name.startswith(name)
    for wrong in ("sl(2,R)", "e(2)", "R^3", "sl(2,R) + so(1,1) with Heisenberg h(2)"):
        spoiled = {**answers.sections, "algebra": replace(section, name=wrong)}
        found = verified(problem, replace(answers, sections=spoiled))
        assert found.sections["algebra"].name is None
