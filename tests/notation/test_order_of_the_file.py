"""Letters, functions and terms in the order of the file, also where other ones were eliminated."""

from __future__ import annotations

from itertools import permutations

import pytest

from lagcli.formatters import Options
from lagcli.pipeline import render
from lagcli.reader import read_problem
from tests.solved import solve

from .test_one_shape import text

SLOPES = "T: (a1*x1'^2 + a2*x2'^2)/2\nV: -a1*g*x1*sin(u) - a2*g*x2*sin(w)\n"


@pytest.mark.parametrize("names", [("m1", "m2"), ("k", "e"), ("b", "m")])
def test_letters_keep_their_order_where_a_constraint_is_put_in(names: tuple[str, str]) -> None:
    physics = SLOPES.replace("a1", names[0]).replace("a2", names[1])
    found = text("x1, x2", f"{' '.join(names)} g d u w", physics + "constraints: {c: x1 + x2 = d}",
                 "reduction")  # fmt: skip
    assert "g m" not in found
    for name in names:
        shown = f"{name[0]}{'₀₁₂'[int(name[1:])]}" if name[1:] else name
        assert f"g {shown}" not in found
        assert f"{shown} g" in found


@pytest.mark.parametrize("order", [*permutations(("sin(u)", "cos(w)", "sin(q)"))])
def test_functions_of_parameters_stand_before_those_of_coordinates(order: tuple[str, ...]) -> None:
    physics = f"T: m*q'^2/2\nV: -m*g*d*{'*'.join(order).replace('sin(q)', 'cos(q)')}"
    assert "sin(u) cos(w) sin(q)" in text("q", "m g d u w", physics, "accelerations")


def test_gravity_stands_after_the_mass_wherever_it_is_declared() -> None:
    """No product of the file has both g and R."""
    physics = "T: M*R^2*q'^2 + M*x'^2/2\nV: -M*g*x\nconstraints: {c: x = R*q}"
    assert "M g R" in text("x, q", "M R g", physics, "reduction")


@pytest.mark.parametrize("V", [*permutations(("k*y^2/2", "m*g*y", "K*(x - y)^2/2"))])
def test_the_hamiltonian_has_the_terms_of_the_potential_in_their_order(V: tuple[str, ...]) -> None:
    found = text("x, y", "m g k K", f"T: m*(x'^2 + y'^2)/2\nV: {' + '.join(V)}", "hamiltonian")
    shown = " + ".join(V).replace("*", " ").replace("^2", "²").replace("-", "−")
    assert f"H = (p_x² + p_y²)/(2 m) + {shown}" in found


@pytest.mark.parametrize(
    ("physics", "section", "written"),
    [
        # a bracket with a fraction takes the number that is before it
        ("T: b*q'^2/4\nV: -(a/2 + b)*g*q^2/2", "accelerations", "q̈ = (a + 2 b) g q/b"),
        ("T: b*q'^2/12\nV: -(a/3 + b)*g*q^2/2", "accelerations", "q̈ = 2 (a + 3 b) g q/b"),
        # forms in rates and momenta are not half factored, angular momenta are brackets
        ("T: 2*b*q'^2 + 3*b*(q' - s')^2/2 + b*(q' + s')^2/2", "energy",
         "h = 4 b q̇² − 2 b q̇ ṡ + 2 b ṡ²"),
        ("L: b*(q*s' - s*q')*q'/2 + b*(q'^2 + s'^2)/2", "energy", "h = b q̇ (q ṡ − s q̇)/2"),
        ("T: b*(4*q'^2 + 3*s'^2 + 6*q'*s'*cos(s))/2", "hamiltonian",
         "H = (3 p_q² − 6 p_q p_s cos(s) + 4 p_s²)/"),
        # what moves stands before what is at rest, roots too
        ("L: -b*c^2*sqrt(1 - q'^2/c^2) - a*q^2/2", "energy",
         "h = b c²/√(1 − q̇²/c²) + a q²/2"),
        # (2 a q')² is not written out, nor does it come before the mass
        ("T: b*(2*a*q*q')^2/2 + b*q'^2/2\nV: g*q", "energy", "h = b (1 + 4 a² q²) q̇²/2 + g q"),
        # a polynomial rises or falls in its powers: Landau and Lifshitz, section 28
        ("T: b*q'^2/2\nV: b*g^2*q^2/2 + b*a*q^3/3 + b*c*q^4/4", "accelerations",
         "q̈ = −q (g² + a q + c q²)"),
        # what is not coupled has a fraction of its own
        ("T: c^2*(a*q'^2 + b*s'^2)/2", "hamiltonian", "p_q²/(2 c² a) + p_s²/(2 c² b)"),
        # what is subtracted stands behind what is added
        ("T: a*(q'^2 + g^2*q^2)/2 + b*(s'^2 + g^2*s^2)/2\nV: c*(q - s)^2/2", "modes",
         "√(c/a + c/b − g²)"),
        # no number before the root, which twice the integral would cancel
        ("T: 3*b*q'^2/4\nV: a*q^2/2", "reduction", "T = 2 ∫ √(3 b/(4 (E − a q²/2))) dq"),
        # a long potential by its letter: Landau and Lifshitz, section 11
        ("T: b*q'^2/2 + b*s'^2*sin(q)^2/2\nV: -b*g*c*cos(q) + a*sin(q)^2", "reduction",
         "T = 2 ∫ √(b/(2 (E − U_eff))) dq"),
    ],
)  # fmt: skip
def test_shapes_as_books_have_them(physics: str, section: str, written: str) -> None:
    coordinates = "q, s" if "s'" in physics else "q"
    assert written in text(coordinates, "a b c g", physics, section)


@pytest.mark.parametrize(("a", "b"), [(2, 1), (3, 1), (5, 2)])
def test_one_angle_where_its_other_functions_have_that_angle(a: int, b: int) -> None:
    """a + b cos 2 q = (a − b) + 2 b cos² q beside sin q."""
    physics = f"T: m*q'^2/2\nV: k*sin(q)*({a} + {b}*cos(2*q))"
    found = text("q", "m k", physics, "hamiltonian")
    assert "cos(2 q)" not in found


@pytest.mark.parametrize("c", ["b", "2*b", "a/b"])
def test_each_row_has_its_own_coordinate(c: str) -> None:
    physics = f"T: m*x'^2/2 + I*s'^2/2\nV: k*x^2/2\nconstraints: {{c: x = {c}*s}}"
    rows = text("x, s", "m I k a b", physics, "accelerations").splitlines()
    assert " s/" not in next(row for row in rows if "ẍ =" in row)
    assert " x/" not in next(row for row in rows if "s̈ =" in row)


def test_of_two_equal_coordinates_the_later_one_is_eliminated() -> None:
    physics = "T: m*(z'^2 + a'^2)/2\nV: k*z^4\nconstraints: {c: a = z}"
    assert "z is used" not in (found := text("z, a", "m k", physics, "reduction"))
    assert "eliminate a" in found


@pytest.mark.parametrize("inertia", ["m", "a"])
def test_differences_of_the_file_stay_where_a_body_hangs_between_two(inertia: str) -> None:
    physics = f"T: {inertia}*(x'^2 + y'^2 + z'^2)/2\nV: k*(y - x)^2/2 + b*(z - y)^2/2"
    rows = text("x, y, z", "m a k b", physics, "accelerations")
    assert f"ÿ = (b (z − y) − k (y − x))/{inertia}" in rows


@pytest.mark.parametrize("name", ["V", "V_eff", "U_eff"])
def test_a_potential_without_a_minimum_is_named_by_a_formula(name: str) -> None:
    physics = {
        "V": "T: m*x'^2/2\nV: m*g*x",
        "V_eff": "L: m*x'^2/2 - m*g*x",
        "U_eff": "T: m*(x'^2 + y'^2)/2\nV: m*g*x",
    }[name]
    coordinates = "x, y" if "y" in physics else "x"
    file = f"coordinates: [{coordinates}]\nparameters: [m, g]\n{physics}"
    answers = solve(read_problem("t.yaml", file.encode()).checked(), ["reduction"])
    shown = name.replace("_eff", r"_{\mathrm{eff}}")
    assert f"${shown}$ has no minimum" in render([answers], "latex", Options())


@pytest.mark.parametrize("root", ["sqrt(2)", "sqrt(3)", "sqrt(7)"])
@pytest.mark.parametrize("inside", ["{}*q", "q*{}", "{}*(a + b)*q", "(a + b)*{}*q", "{}*pi*q"])
def test_a_root_of_a_number_stands_with_the_numbers(root: str, inside: str) -> None:
    """In the energy, with the products of the file, as in the momenta."""
    angle = inside.format(root)
    physics = f"L: q'^2/2 + exp(q)*(cos({angle})*s'^2 - 2*sin({angle})*q'*s')/2"
    found = text("q, s", "a b", physics, "energy", "momenta")
    shown = f"√{root[5]} "
    assert f"cos({shown}" in found
    assert f"sin({shown}" in found
    assert found.count("cos(") == found.count(f"cos({shown}")
