"""One quantity, one shape: what the file has is not expanded, split or doubled in the answer."""

from __future__ import annotations

import pytest

from lagcli.expression import Sum, walk
from lagcli.formatters import Options
from lagcli.pipeline import Request, derive, explain, render, state
from lagcli.reader import read_problem
from lagcli.rewriting import expressions_in
from tests.solved import solve


def text(coordinates: str, parameters: str, physics: str, *sections: str) -> str:
    positive = ", ".join(f"{name}: {{assume: positive}}" for name in parameters.split())
    file = f"coordinates: [{coordinates}]\nparameters: {{{positive}}}\n{physics}"
    return render(
        [solve(read_problem("t.yaml", file.encode()).checked(), sections)], "text", Options()
    )


@pytest.mark.parametrize("n", [2, 3, 5])
def test_a_drive_keeps_its_angle_in_the_canonical_equations(n: int) -> None:
    """The frequency of the file, of which the algebra knows sin(W t) alone."""
    physics = f"T: m*(l^2*q'^2 + 2*A*l*W*q'*sin(q)*sin({n}*W*t))/2\nV: -m*g*l*cos(q)"
    found = text("q", "m l g A W", physics, "canonical_equations")
    assert f"sin({n} W t)" in found
    assert "sin(W t)" not in found


@pytest.mark.parametrize("argument", ["2*pi*z/h", "pi*z/h", "4*pi*z/(3*h)"])
def test_a_wave_has_its_places_of_rest_in_one_period_once(argument: str) -> None:
    found = text("z", "m h k", f"T: m*z'^2/2\nV: k*cos({argument})", "equilibria")
    assert found.count("z = ") == 2


@pytest.mark.parametrize(("a", "b"), [("k", "m"), ("m", "k")])
def test_squared_and_unsquared_frequencies_have_one_shape(a: str, b: str) -> None:
    """The oscillator in a turning frame: |W - sqrt(a/b)| in `modes`, its square here."""
    physics = f"T: {b}*((x' - W*y)^2 + (y' + W*x)^2)/2\nV: {a}*(x^2 + y^2)/2"
    assert f"ω² = (W ± √({a}/{b}))²" in text("x, y", "m k W", physics, "steady_motions")


@pytest.mark.parametrize("power", ["", "^2", "^3", "^(3/2)", "^(1/2)"])
def test_a_difference_of_squares_of_the_file_is_not_split(power: str) -> None:
    physics = f"T: m*x'^2/2\nV: m*g*x*(R^2 - l^2){power} + k*x^2/2"
    found = text("x", "m g k R l", physics, "equilibria", "reduction")
    assert "R² − l²" in found
    assert "R + l" not in found
    assert "R⁴" not in found


@pytest.mark.parametrize(
    ("physics", "name"),
    [
        ("T: m*x'^2/2\nV: k*x^4/4", "V"),
        ("T: m*x'^2/2 + m*W^2*x^2/2\nV: k*x^4/4", "V_eff"),
        ("T: m*(x'^2 + y'^2)/2\nV: k*x^4/4", "U_eff"),
        ("T: m*(x'^2 + y'^2)/2\nV: k*x^4/4\nconstraints: {c: y = b*x^2}", "V"),
    ],
)
def test_a_potential_has_the_name_of_what_it_is(physics: str, name: str) -> None:
    """U_eff at given momenta (Goldstein, section 3.3), V_eff = V - T_0, else V of the file."""
    coordinates = "x, y" if "y" in physics else "x"
    found = text(coordinates, "m k W b", physics, "reduction", "steady_motions")
    assert {n for n in ("U_eff", "V_eff", "V") if f" {n} " in found} - {"V"} == {name} - {"V"}
    assert f"{name} has " in found


@pytest.mark.parametrize("terms", ["a*y' - p_x", "a*sin(y) - p_x + b"])
def test_a_rate_has_its_own_momentum_first(terms: str) -> None:
    """x' = (p_x − …)/m of a cyclic x whose momentum has other terms."""
    others = terms.replace(" - p_x", "")
    physics = f"T: m*x'^2/2 + x'*({others}) + M*y'^2/2\nV: -k*cos(y)"
    found = text("x, y", "m M k a b", physics, "reduction")
    assert "ẋ = (p_x − " in found


@pytest.mark.parametrize("factor", ["", "Q*", "2*Q*"])
def test_the_logarithm_of_a_ratio_is_not_parted(factor: str) -> None:
    """The cylindrical capacitor of Jackson: ln(b/a), and b > a for ln b > ln a."""
    physics = f"T: m*x^2*x'^2/2\nV: {factor}k*log(x/a)/log(b/a) + m*g/x"
    found = text("x", "m g k a b Q", physics, "equilibria", "modes", "reduction")
    assert "ln(b/a)" in found
    assert "ln(b)" not in found
    assert "ln(a)" not in found


@pytest.mark.parametrize(("turned", "free"), [("q - a", "a"), ("a - q", "q")])
def test_sums_of_angles_of_the_file_are_not_turned_into_others(turned: str, free: str) -> None:
    """A pendulum on a sliding carriage has sin(a - q) as the file does, no sin(a - 2 q)."""
    physics = (
        f"T: M*s'^2/2 + m*(s'^2 + l^2*q'^2 + 2*l*s'*q'*cos({turned}))/2\n"
        "V: -(M + m)*g*s*sin(a) - m*g*l*cos(q)"
    )
    found = text("s, q", "M m l g a", physics, "accelerations")
    assert "2 q" not in found.replace("sin(2 (q − a))", "").replace("sin(2 (a − q))", "")
    assert free in found


@pytest.mark.parametrize(
    ("T", "V", "radicand"),
    [
        (  # Fetter and Walecka, section 22: two masses and three springs
            "(m1*x'^2 + m2*y'^2)/2", "a*x^2/2 + b*(y - x)^2/2 + c*y^2/2",
            "(m₁ (b + c) − m₂ (a + b))² + 4 m₁ m₂ b²",
        ),
        ("(m1*x'^2 + m2*y'^2)/2", "a*x^2/2 + b*x*y + c*y^2/2", "(m₁ c − m₂ a)² + 4 m₁ m₂ b²"),
        ("(m1*x'^2 + m2*y'^2)/2 + b*x'*y'", "(a*x^2 + c*y^2)/2", "(m₁ c − m₂ a)² + 4 a b² c"),
    ],
)  # fmt: skip
def test_the_radicand_of_two_oscillators_has_the_square_of_their_difference(
    T: str, V: str, radicand: str
) -> None:
    found = text("x, y", "m1 m2 a b c", f"T: {T}\nV: {V}", "modes")
    assert radicand in " ".join(found.split())


def test_a_momentum_with_a_constant_is_written_by_its_terms() -> None:
    """The canonical momentum m R² θ' + q B R²/2 of a charge on a cylinder, squared as p − …."""
    physics = "L: m*(R^2*y'^2 + z'^2)/2 + q*B*R^2*y'/2 - k*z^2/2"
    found = text("y, z", "m R q B k", physics, "momenta", "reduction")
    assert "p_y = m R² ẏ + q B R²/2" in found
    assert "(p_y − q B R²/2)²" in found


@pytest.mark.parametrize("V", ["k*x^2/2", "F*x", "k*x^4", "g*cosh(x)"])
def test_a_relativistic_time_is_written_with_the_potential_of_the_file(V: str) -> None:
    """Goldstein, section 7.9: dt = (E − V) dx/(c sqrt((E − V)² − m² c⁴))."""
    found = text("x", "m c k F g", f"L: -m*c^2*sqrt(1 - x'^2/c^2) - {V}", "reduction")
    shown = V.replace("*", " ").replace("^2", "²").replace("^4", "⁴")
    assert f"∫ ((E − {shown})/(c √((E − {shown})² − m² c⁴))) dx" in found


def test_shapes_of_modes_have_no_root_in_a_denominator() -> None:
    """A pendulum on the rim of a disk: both modes are one pair of rows."""
    physics = (
        "T: M*a^2*y'^2/4 + m*(a^2*y'^2 + l^2*x'^2 + 2*a*l*y'*x'*cos(x-y))/2\n"
        "V: m*g*(a*(1-cos(y)) + l*(1-cos(x)))"
    )
    found = text("x, y", "M m l a g", physics, "modes")
    assert found.count("a_y = ") == 1
    assert "∓ √" in found


@pytest.mark.parametrize("square", ["sin(q)^2", "cos(q)^2"])
@pytest.mark.parametrize("fraction", ["1/3", "1/4", "2/5"])
def test_a_number_and_a_square_have_no_fraction(fraction: str, square: str) -> None:
    """The rod that falls on a smooth floor: m a² (1 + 3 sin² θ)/3, not m a² (1/3 + sin² θ)."""
    physics = f"T: {fraction}*m*a^2*q'^2/2 + m*a^2*{square}*q'^2/2\nV: m*g*a*cos(q)"
    found = text("q", "m g a", physics, "accelerations", "canonical_equations")
    assert fraction not in found


def test_a_decimal_stays_beside_its_square() -> None:
    physics = "T: m*a^2*(0.4 + sin(q)^2)*q'^2/2\nV: m*g*a*cos(q)"
    assert "0.4" in text("q", "m g a", physics, "momenta", "hamiltonian")


@pytest.mark.parametrize(("one", "other"), [("sin", "cos"), ("cos", "sin")])
def test_squares_are_added_not_subtracted(one: str, other: str) -> None:
    """1 + 2 cos² θ for 3 − 2 sin² θ."""
    T = f"m*a^2*(4 - {one}(q)^2)*q'^2/2 + m*a^2*(1 - {one}(q)^2)*q'^2"
    found = text("q", "m g a", f"T: {T}\nV: m*g*a*cos(q)", "momenta")
    assert f"− 3 {one}²" not in found
    assert f"{other}²" in found


@pytest.mark.parametrize(
    ("V", "turning"),
    [
        ("k*x^2/2 - F*x", "x = (F ± √(F² + 2 k E))/k"),
        ("k*(x - b)^2/2 - F*x^2/2", "x = (k b ± √(k b² F + 2 (k - F) E))/(k - F)"),
        ("F^2/(2*m*x^2) - k/x", "x = (−k ± √(k² + 2 F² E/m))/(2 E)"),
        ("F*x^4/4 - k*x^2/2", "x = ±√((k + √(k² + 4 F E))/F)"),
        ("k/x^12 - F/x^6", "x = ±((√(F² + 4 k E) − F)/(2 E))^(1/6)"),
    ],
)
def test_a_turning_point_has_the_energy_last_under_its_root(V: str, turning: str) -> None:
    """sqrt(b² + 4 a c) as in every book, and the sign that the equilibrium has."""
    found = text("x", "m b k F", f"T: m*x'^2/2\nV: {V}", "reduction")
    assert turning.replace("-", "−") in found


@pytest.mark.parametrize(
    ("V", "frequency"),
    [
        ("k*(x^2 + (y - x)^2 + (z - y)^2 + z^2)/2 + K*(x^2 + y^2 + z^2)/2", "((2 ± √2) k + K)/m"),
        ("k*(x^2 + (y - x)^2 + (z - y)^2)/2 + k*y^2/2 + K*(x^2 + y^2 + z^2)/2", ""),
    ],
)
def test_frequencies_that_differ_in_the_root_of_a_number_are_one_row(V: str, frequency: str):
    found = text("x, y, z", "m k K", f"T: m*(x'^2 + y'^2 + z'^2)/2\nV: {V}", "modes")
    assert frequency in found
    assert "k √" not in found


def test_several_coefficients_may_have_the_two_signs_at_once() -> None:
    """A double pendulum with equal springs: one row for both modes."""
    physics = (
        "T: m*l^2*(2*x'^2 + y'^2 + 2*x'*y'*cos(x - y))/2\n"
        "V: -m*g*l*(2*cos(x) + cos(y)) + k*(x^2 + (y - x)^2)/2"
    )
    found = text("x, y", "m l g k", physics, "modes")
    assert "√((2 ± √2) g/l + (3 ± 2 √2) k/(m l²))" in found


@pytest.mark.parametrize("power", [2, 3])
def test_an_even_power_does_not_stay_under_a_root_with_a_sum(power: int) -> None:
    """√(m (k r − 2 h)) for r² √(m (k r − 2 h)/r⁴), whatever the sign of r."""
    physics = f"T: m*(r'^2 + r^2*p'^2)/2\nV: -k/r + h/r^{power}"
    found = text("r, p", "m k h", physics, "steady_motions")
    assert "r⁴)" not in found
    assert ")/m)/r²" in found or power == 3


def test_a_sum_of_letters_before_a_function_has_no_fraction() -> None:
    """The spin of a heavy top: (A − C) φ' cos θ/C, not (A/C − 1) φ' cos θ."""
    physics = "T: A*(y'^2 + x'^2*sin(y)^2)/2 + C*(z' + x'*cos(y))^2/2\nV: m*g*l*cos(y)"
    found = text("x, y, z", "A C m g l", physics, "steady_motions")
    assert "(A − C) ẋ cos(y)/C" in found


@pytest.mark.parametrize("f", ["sin", "tan"])
def test_an_angle_is_written_by_the_function_that_its_neighbour_has(f: str) -> None:
    """Two pendulums and a spring: b = −a, both by arccos."""
    physics = f"T: m*l^2*(x'^2 + y'^2)/2\nV: -m*g*l*(cos(x) + cos(y)) + k*d^2*({f}(x) - {f}(y))^2/2"
    found = text("x, y", "m g l k d", physics, "equilibria")
    assert "arcsin" not in found
    assert f == "tan" or "y = ∓arccos(−m g l/(2 k d²))" in found


def test_a_family_that_moves_several_coordinates_is_no_displacement_of_one() -> None:
    """Three masses on a line with springs between them rest anywhere."""
    springs = "k*(y - x - b)^2/2 + k*(z - y - b)^2/2"
    found = text("x, y, z", "m b k", f"T: m*(x'^2 + y'^2 + z'^2)/2\nV: {springs}", "equilibria")
    assert "Stable up to displacements along the family" in found


@pytest.mark.parametrize(
    ("V", "written"),
    [
        ("a/r^2 + b*r", "(b/a)^(4/3)"),
        ("a*r^4 + b/r^2", ""),
    ],
)
def test_letters_with_one_fractional_exponent_have_it_together(V: str, written: str) -> None:
    found = text("r", "m a b", f"T: m*r'^2/2\nV: {V}", "reduction")
    assert "^(4/3) b^(4/3)" not in found
    assert written in found


def test_a_whole_number_goes_under_the_root() -> None:
    """φ' = √(3 g/(2 l cos θ)) of a rod, not √(6 g/(l cos θ))/2."""
    physics = "T: m*l^2*(x'^2 + y'^2*sin(x)^2)/6 + J*y'^2/2\nV: -m*g*l*cos(x)/2"
    assert "ẏ   = √(3 g/(2 l cos(x)))" in text("x, y", "m l g J", physics, "steady_motions")


def test_steady_motions_that_differ_in_the_sign_of_a_root_are_one() -> None:
    """A spherical pendulum with a charge in a magnetic field: both rates at any angle."""
    physics = "L: m*l^2*(x'^2 + y'^2*sin(x)^2)/2 + q*B*l^2*y'*sin(x)^2/2 + m*g*l*cos(x)"
    found = text("x, y", "m l g q B", physics, "steady_motions")
    assert "ẏ   = −q B/(2 m) ± √(" in found
    assert "p_y = ±" in found
    assert "Steady motion 4" not in found


@pytest.mark.parametrize(("a", "b"), [("L", "M"), ("J", "I")])
def test_a_determinant_of_squares_begins_with_what_the_file_has_first(a: str, b: str) -> None:
    """Two coils: x'' and H over L² − M², the kinetic energy over one determinant."""
    physics = f"T: {a}*(x'^2 + y'^2)/2 + {b}*x'*y'\nV: k*(x^2 + y^2)/2"
    found = text("x, y", f"{a} {b} k", physics, "hamiltonian", "accelerations")
    assert f"({a} (p_x² + p_y²) − 2 {b} p_x p_y)/(2 ({a}² − {b}²))" in found
    assert f"/({a}² − {b}²)" in found
    assert f"({b}² − {a}²)" not in found


@pytest.mark.parametrize(
    ("coordinates", "physics", "root"),
    [
        # two of three are coupled to each other
        ("x, y, z", "T: a*x'^2/2 + m*y'^2/2 + z'^2/2\nV: k*x^2/2 + b*y^2/2 + c*x*y + z^2",
         "√((a b − k m)² + 4 m a c²)"),
        # Landau and Lifshitz, section 24, problem 3: the molecule A B C
        ("x, y, z", "T: a*x'^2/2 + b*y'^2/2 + c*z'^2/2\nV: k*(x - y)^2/2 + m*(y - z)^2/2",
         "√((m a (b + c) − k c (a + b))² + 4 k m a² c²)"),
    ],
)  # fmt: skip
def test_the_root_of_two_coupled_ones_has_the_square_of_a_difference(
    coordinates: str, physics: str, root: str
) -> None:
    found = text(coordinates, "k m a b c", physics, "modes")
    assert root in " ".join(found.split())


@pytest.mark.parametrize("slope", ["r^2/a^2", "a^2/r^2"])
def test_the_inertia_of_a_surface_keeps_its_one(slope: str) -> None:
    """m (1 + r²/a²) r'²/2 on a paraboloid, in the energy and under the root of the time."""
    physics = f"T: m*(r'^2*(1 + {slope}) + r^2*p'^2)/2\nV: m*g*r^2/(2*a)"
    found = text("r, p", "m g a", physics, "reduction")
    shown = slope.replace("^2", "²")
    assert f"E = m (1 + {shown}) ṙ²/2" in found
    assert f"√(m (1 + {shown})/(2 (" in found


@pytest.mark.parametrize("n", [1, 2, 3])
def test_squares_come_out_of_a_root_with_several_fractions(n: int) -> None:
    """The period of Weber's electrodynamics: √(c² p² + n k²)/(m k² c)."""
    V = f"p0^2/(2*m*r^2)*(1 + {n}*k^2/(p0^2*c^2)) - k/r"
    found = text("r", "m k c p0", f"T: m*r'^2/2\nV: {V}", "reduction")
    assert "/k⁴" not in found


@pytest.mark.parametrize("sign", ["-", "+"])
def test_a_letter_stands_before_a_fraction(sign: str) -> None:
    """r = l + m g/k of a spring pendulum at rest, beside l − m g/k."""
    physics = f"T: m*(r'^2 + r^2*p'^2)/2\nV: k*(r - l)^2/2 {sign} m*g*r*cos(p)"
    found = text("r, p", "m g k l", physics, "equilibria")
    assert "r = l + m g/k" in found
    assert "r = l − m g/k" in found


@pytest.mark.parametrize("n", [2, 3, 4])
@pytest.mark.parametrize("function", ["cos", "sin"])
def test_heights_with_letters_are_put_in_and_collected(n: int, function: str) -> None:
    """(m1 + m2) g l1 cos θ1 + m2 g l2 cos θ2 (Landau, Lifshitz, Mechanics, section 5, problem 1)."""
    q, places = "abcd"[:n], range(1, n + 1)
    heights = [f"y1: -l1*{function}(a)"]
    heights += [f"y{k}: y{k - 1} - l{k}*{function}({q[k - 1]})" for k in places[1:]]
    V = " + ".join(f"m{k}*g*y{k}" for k in places)
    T = " + ".join(f"{x}'^2/2" for x in q)
    physics = f"definitions: {{{', '.join(heights)}}}\nT: {T}\nV: {V}"
    letters = [f"{letter}{k}" for letter in "ml" for k in places]
    found = " ".join(text(", ".join(q), " ".join([*letters, "g"]), physics, "lagrangian").split())
    indices = "₁₂₃₄"[:n]
    for k, x in enumerate(q):
        masses = " + ".join(f"m{i}" for i in indices[k:])
        masses = f"({masses})" if k < n - 1 else masses
        assert f"+ {masses} g l{indices[k]} {function}({x})" in found


def test_a_period_has_one_sign_of_a_difference():
    """sqrt(m/(k − m g l)) (1 − m g l a²/(16 (k − m g l)) + …), where k > m g l."""
    physics = "T: m*l^2*x'^2/2\nV: m*g*l*cos(x) + k*x^2/2"
    found = text("x", "m l g k", physics, "reduction").split("Oscillations about")[1]
    assert "1 − m g l a²/(16 (k − m g l))" in found
    assert "m g l − k" not in found


@pytest.mark.parametrize("V", ["s", "-s", "2*s", "s^2", "k*s"])
def test_a_potential_of_one_term_is_no_sum(V: str) -> None:
    """Nor are the coordinate and other formulas that are this term."""
    read = read_problem(
        "p.yaml",
        f"title: p\ncoordinates: {{s: {{assume: positive}}}}\nparameters: [k]\nT: s'^2/2\nV: {V}".encode(),
    )
    account = explain(derive(read.problem), ("equilibria", "reduction", "steady_motions"))
    trees = [tree for step in account.steps for tree in expressions_in(step.blocks)]
    assert not [n for t in trees for n in walk(t) if isinstance(n, Sum) and len(n.terms) < 2]


@pytest.mark.parametrize("root", ["sqrt(x^2 + y^2)", "sqrt(b^2 + x^2)"])
def test_a_root_stands_once(root: str) -> None:
    """The force of a spring: k (1 − l/r) x, not k x (r − l)/r with r written out."""
    found = text("x, y", "m k b l", f"L: m*(x'^2 + y'^2)/2 - k*({root} - l)^2/2", "accelerations")
    shown = root.replace("sqrt", "√").replace("^2", "²")
    assert f"ẍ = −k x (1 − l/{shown})/m" in found


@pytest.mark.parametrize("power", [1, 2])
def test_momenta_are_not_subtracted_in_one_row_of_those_that_have_them_first(power: int) -> None:
    """A charge in the plane of a dipole (Störmer)."""
    physics = f"L: m*(r'^2 + r^2*s'^2)/2 + k*s'/r^{power}"
    found = text("r, s", "m k", physics, "canonical_equations", "reduction", "steady_motions")
    assert "p_s − k" in found
    assert "k − r" not in found


def test_squared_brackets_of_a_potential_keep_their_symmetry() -> None:
    """Two loops with a common condenser: q₁² + q₂² + (q₁ − q₂)², not 2 (q₁ (q₁ − q₂) + q₂²)."""
    physics = "T: A*(q1'^2 + q2'^2)/2\nV: q1^2/(2*C) + q2^2/(2*C) + (q1 - q2)^2/(2*C)"
    found = text("q1, q2", "A C", physics, "energy", "hamiltonian")
    assert found.count("+ q₁²/(2 C) + q₂²/(2 C) + (q₁ − q₂)²/(2 C)") == 2


@pytest.mark.parametrize("V", ["a*x^2/2 + b*y^2/2", "(a*x^2 + b*y^2)/2"])
def test_a_multiple_of_the_lagrangian_has_no_halves(V: str) -> None:
    """Neumann's oscillator: λ is -L/R^2, written as -(m v^2 - a x^2 - b y^2)/(2 R^2)."""
    physics = f"T: m*(x'^2 + y'^2)/2\nV: {V}\nconstraints: {{c: x^2 + y^2 = R^2}}"
    found = text("x, y", "m a b R", physics, "multipliers")
    assert "/(2 R²)" in found
    assert "/2" not in found


@pytest.mark.parametrize(("n", "k"), [(12, 6), (4, 2), (6, 3)])
def test_a_power_of_a_ratio_in_a_potential_stays(n: int, k: int) -> None:
    """(s/r)¹² − (s/r)⁶ of Lennard and Jones, not s¹²/r¹² − s⁶/r⁶."""
    physics = f"T: m*(r'^2 + r^2*u'^2)/2\nV: 4*q*((s/r)^{n} - (s/r)^{k})"
    found = text("r, u", "m q s", physics, "lagrangian", "energy", "hamiltonian", "reduction")
    assert found.count("4 q ((s/r)") >= 4


@pytest.mark.parametrize("parameters", ["I m k", "m k I"])
@pytest.mark.parametrize(
    ("given", "inertia"), [("I + m*r^2", "I + m r²"), ("m*r^2 + I", "m r² + I")], ids=["I m", "m I"]
)
def test_an_inertia_stands_as_the_file_has_it(parameters: str, given: str, inertia: str) -> None:
    physics = f"T: ({given})*u'^2/2 + m*r'^2/2\nV: k*r^2/2"
    found = text("r, u", parameters, physics, "equations", "momenta", "accelerations")
    other = {"I + m r²": "m r² + I", "m r² + I": "I + m r²"}[inertia]
    assert f"p_u = ({inertia}) u̇" in found
    assert other not in found


def test_a_hamiltonian_has_the_angles_in_the_order_of_the_coordinates() -> None:
    """A rod that hangs from a string, whose file has no difference of its angles."""
    physics = (
        "definitions: {X: l*sin(u) + b*sin(v), Y: l*cos(u) + b*cos(v)}\n"
        "T: m*(X'^2 + Y'^2)/2 + m*b^2*v'^2/6\nV: -m*g*Y"
    )
    found = text("u, v", "m l b g", physics, "accelerations", "hamiltonian")
    assert "v − u" not in found
    assert "u − 2 v" not in found
    assert "4 sin(u) − 3 sin(v) cos(u − v)" in found


def test_no_half_of_a_doubled_angle_where_the_file_has_the_angle() -> None:
    physics = (
        "definitions: {X: x + r*sin(u), Y: -r*cos(u)}\n"
        "T: M*x'^2/2 + m*(X'^2 + Y'^2)/2\nV: k*(r - l)^2/2 + m*g*Y"
    )
    found = text("x, r, u", "M m k l g", physics, "accelerations")
    assert "k (r − l) sin(u) cos(u)/(M r)" in found
    assert "2 u" not in found


def test_the_root_of_an_equation_comes_last() -> None:
    """An inverted pendulum between two springs; its squared frequencies are in LL, section 23."""
    physics = "T: m*l^2*u'^2/2\nV: k*a^2*sin(u)^2 + m*g*l*cos(u)"
    found = text("u", "m l a k g", physics, "reduction")
    assert "arccos((m g l − √(" in found
    assert "arccos((m g l + √(" in found


def test_a_time_is_written_with_the_potential_as_it_stands_in_the_energy() -> None:
    """An Atwood machine with a heavy rope, Symon, Mechanics, 3rd ed., chapter 9."""
    potential = "m₁ g x {0} m₂ g (l − x) {0} s g x²/2 {0} s g (l − x)²/2"
    physics = "T: (m1 + m2 + s*l)*x'^2/2\nV: -m1*g*x - m2*g*(l - x) - s*g*x^2/2 - s*g*(l - x)^2/2"
    found = text("x", "m1 m2 s l g", physics, "reduction")
    assert "− " + potential.format("−") in found
    assert "∫ √((m₁ + m₂ + s l)/(2 (E − V))) dx" in found  # the same one, so it is known by V


ROTORS = "T: (A*u'^2 + B*v'^2 + C*w'^2)/2\nV: c*(v - u)^2/2 + d*(w - v)^2/2"


def test_frequencies_have_one_radicand_in_modes_and_steady_motions() -> None:
    """Three rotors on a shaft, Thomson, Theory of Vibration with Applications, section 5."""
    found = text("u, v, w", "A B C c d", ROTORS, "modes", "steady_motions")
    root = "(A d (B + C) − (A + B) C c)² + 4 A² C² c d"
    assert " ".join(found.split()).count(root) == 4


def test_a_root_in_many_results_is_named() -> None:
    file = "coordinates: [u, v, w]\nparameters: {" + ", ".join(
        f"{name}: {{assume: positive}}" for name in "ABCcd"
    ) + "}\n" + ROTORS  # fmt: skip
    problem = read_problem("t.yaml", file.encode()).checked()
    answers = state(derive(problem), Request(sections=("modes",), abbreviate=True))
    found = render([answers], "text", Options())
    assert "Δ = (A d (B + C) − (A + B) C c)² + 4 A² C² c d" in found
    assert found.count("√Δ") == 3


@pytest.mark.parametrize("definition", ["R - R*cos(u)", "R*(1 - cos(u))"])
def test_a_height_has_its_length_before_the_bracket(definition: str) -> None:
    physics = f"definitions: {{Y: {definition}}}\nT: m*R^2*u'^2/2\nV: m*g*Y"
    found = text("u", "m g R", physics, "lagrangian", "energy", "hamiltonian", "reduction")
    assert found.count("m g R (1 − cos(u))") >= 5
    assert "R − R" not in found


def test_potentials_with_one_function_are_together_in_h() -> None:
    """A rod with a disk at its end, Goldstein, Classical Mechanics, 3rd ed., exercise 5.20."""
    physics = "T: (m/3 + M)*l^2*u'^2/2\nV: -m*g*l*cos(u)/2 - M*g*l*cos(u)"
    found = text("u", "m M l g", physics, "hamiltonian", "reduction")
    assert found.count("(m/2 + M) g l cos(u)") >= 3


@pytest.mark.parametrize("factor", ["1 - 2*M/r", "1 - M/r", "1 + M/r"])
def test_a_denominator_of_the_file_stays(factor: str) -> None:
    """Schwarzschild's metric, Hartle, Gravity, section 9.3."""
    physics = f"L: (-({factor})*u'^2 + r'^2/({factor}) + r^2*v'^2)/2"
    shown = factor.replace("2*M", "2 M").replace("-", "−")
    found = text("u, r, v", "M", physics, "lagrangian", "momenta", "hamiltonian")
    assert f"p_r = ṙ/({shown})" in found
    assert f"− p_u²/(2 ({shown}))" in found
    assert f"ṙ²/(2 ({shown}))" in found


def test_a_lagrangian_has_squared_velocities_and_no_components() -> None:
    """A load on an elastic rope under a trolley: M + m together, r'² + r² u'²."""
    physics = (
        "definitions: {X: x + r*sin(u), Y: -r*cos(u)}\n"
        "T: M*x'^2/2 + m*(X'^2 + Y'^2)/2\nV: k*(r - l)^2/2 + m*g*Y"
    )
    found = text("x, r, u", "M m k l g", physics, "lagrangian", "energy")
    assert found.count("(M + m) ẋ²/2") == 2
    assert found.count("m (ṙ² + r² u̇²)/2") == 2


@pytest.mark.parametrize(
    ("physics", "letters", "energy"),
    [
        # two hinged rods, Landau and Lifshitz, section 23; T as a user adds it up
        ("T: m*l^2*u'^2/6 + m*(l^2*u'^2 + l^2*u'*v'*cos(u - v) + l^2*v'^2/3)/2\nV: -m*g*l*cos(v)",
         "m l g", "m l² (4 u̇² + 3 u̇ v̇ cos(u − v) + v̇²)/6 − m g l cos(v)"),
        # a drum and what hangs from it: one inertia
        ("T: M*R^2*u'^2/4 + m*R^2*u'^2/2 + m*v'^2/2\nV: m*g*R*u",
         "M m R g", "(M + 2 m) R² u̇²/4 + m v̇²/2 + m g R u"),
        # a point in spherical coordinates: one mass before all squares
        ("points: {p: {position: [l*sin(u)*cos(v), l*sin(u)*sin(v), -l*cos(u)], mass: m}}",
         "m l", "m l² (u̇² + v̇² sin²(u))/2"),
        ("points: {p: {position: [u*cos(v), u*sin(v)], mass: m}}\nV: k*u^2/2",
         "m k", "m (u̇² + u² v̇²)/2 + k u²/2"),
        # what rests in a turning frame stands behind V
        ("T: m*(u'^2 + w^2*u^2)/2 + M*(v'^2 + w^2*v^2)/2\nV: k*(v - u - l)^2/2", "m M k l w",
         "m u̇²/2 + M v̇²/2 + k (v − u − l)²/2 − m w² u²/2 − M w² v²/2"),
    ],
)  # fmt: skip
def test_an_energy_has_one_term_for_one_kind(physics: str, letters: str, energy: str) -> None:
    assert f"h = {energy}\n" in text("u, v", letters, physics, "energy")


def test_a_momentum_has_a_bracket_of_parameters_once() -> None:
    """Two masses on a rod, thrown, about a point of it that is not their centre."""
    physics = (
        "points: {one: {position: [x + a*cos(u), y + a*sin(u)], mass: m1},"
        " two: {position: [x - b*cos(u), y - b*sin(u)], mass: m2}}"
    )
    found = text("x, y, u", "m1 m2 a b", physics, "momenta")
    assert "p_u = (m₁ a − m₂ b) (ẏ cos(u) − ẋ sin(u)) + (m₁ a² + m₂ b²) u̇" in found


def test_what_follows_one_mass_follows_all() -> None:
    """A cylinder drawn over a table by a hanging mass, with M R² and m g in the file."""
    physics = (
        "T: M*x'^2/2 + M*R^2*u'^2/4 + m*y'^2/2\nV: -m*g*y\n"
        "constraints: {rolling: x - R*u = 0, string: y - x = 0}"
    )
    found = text("x, u, y", "M R m g", physics, "constraint_forces", "reduction")
    assert "M m g R/(3 M + 2 m)" in found
    assert "R m" not in found


def test_momenta_over_one_denominator_stay_together() -> None:
    """A pendulum with a reaction wheel."""
    physics = "T: m*l^2*u'^2/2 + J*(u' + v')^2/2\nV: m*g*l*cos(u)"
    found = text("u, v", "m l J g", physics, "canonical_equations")
    assert "(p_v − p_u)/(m l²) + p_v/J" in found


def test_a_number_beside_a_letter_is_first() -> None:
    found = text("x", "m k g", "T: (1 + k)*m*x'^2/2\nV: -m*g*x", "accelerations", "momenta")
    assert "ẍ = g/(1 + k)" in found
    assert "p_x = (1 + k) m ẋ" in found


@pytest.mark.parametrize("stiff", ["k", "K", "3*k"])
@pytest.mark.parametrize("mass", ["", "m*"])
def test_like_coordinates_have_like_accelerations(stiff: str, mass: str) -> None:
    """Two oscillators joined by a spring, whose extension the file has in both rows."""
    physics = f"T: {mass}(x'^2 + y'^2)/2\nV: (k*x^2 + k*y^2 + {stiff}*(x - y)^2)/2"
    found = text("x, y", "m k K", physics, "accelerations")
    assert found.count("(x − y)") == (2 if stiff == "K" else 0)  # k (y − 2 x) is shorter


@pytest.mark.parametrize("place", ["x - a", "x + a", "x - 2*a"])
def test_a_spring_has_its_length_in_one_bracket(place: str) -> None:
    """k (x − a) (1 − s/l) with l² = (x − a)² + b²."""
    physics = f"T: m*x'^2/2\nV: k*(sqrt(({place})^2 + b^2) - s)^2/2"
    found = text("x", "m k a b s", physics, "equations", "accelerations", "canonical_equations")
    assert found.count("(1 − s/√(") == 3


@pytest.mark.parametrize("name", ["l", "a", "z"])
def test_a_bracket_of_one_term_stays_in_the_others(name: str) -> None:
    """r k (l + r) (1 − s/√…) sin q, not r k ((l + r) s/√… − r − l) sin q (Landau, section 21)."""
    length = f"sqrt(r^2 + ({name} + r)^2 - 2*r*({name} + r)*cos(q))"
    physics = f"T: m*r^2*q'^2/2\nV: k*({length} - s)^2/2"
    found = text("q", f"m r {name} s k", physics, "equations", "canonical_equations")
    assert found.count("(1 − s/√(") == 2


@pytest.mark.parametrize("inertia", ["I/R^2", "2*I/R^2", "I/(a*R)"])
def test_a_sum_of_masses_stays_where_every_row_can_have_it(inertia: str) -> None:
    physics = f"T: (M + {inertia})*x'^2/2\nV: -M*g*x"
    found = text("x", "M I R a g", physics, "accelerations", "hamiltonian")
    assert found.count(f"M + {inertia.replace('*', ' ').replace('^2', '²')}") == 2


@pytest.mark.parametrize("power", ["x^1", "x^(1)", "(x)^(2/2)"])
def test_a_first_power_is_no_power(power: str) -> None:
    assert "¹" not in text("x", "m g", f"T: m*x'^2/2\nV: m*g*{power}", "lagrangian", "energy")


@pytest.mark.parametrize("inertia", ["M + 2*m*sin(x)^2", "M + m*x^2", "m*cosh(x)^2"])
def test_an_explanation_has_the_hamiltonian_and_the_momenta_of_the_answers(inertia: str) -> None:
    """V stands apart in both, not over the denominator of T."""
    file = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, M: {assume: positive}, "
        f"a: {{assume: positive}}, g: {{assume: positive}}}}\nT: ({inertia})*x'^2/2\n"
        "V: -(m + M)*g*a*cos(x) - m*a*x^2/2"
    )
    read = read_problem("t.yaml", file.encode()).checked()
    stated = state(derive(read), Request(sections=("momenta", "hamiltonian"))).sections
    account = explain(derive(read), ("canonical_equations",))
    (step,) = (step for step in account.steps if step.title == "Canonical equations")
    assert {*expressions_in(stated)} <= {*expressions_in(step.blocks)}
