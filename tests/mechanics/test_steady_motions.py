"""Steady motions and their stability against textbooks and against numeric spectra."""

from __future__ import annotations

import mpmath
import pytest
from sympy import Matrix, Symbol, symbols

from lagcli.algebra.signs import sign
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.options import Options
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import render
from lagcli.reader import read_problem
from lagcli.statements.motions import SteadyMotion
from tests.solved import solve

from .derived import derive
from .formulas import formula, normal


def motions(text: str) -> tuple[SteadyMotion, ...]:
    section, missing = steady_motions(derive(text.replace("POSITIVE", "{assume: positive}")))
    assert not missing
    assert section.motions is not None
    return section.motions


def conditions(found: tuple) -> list[str]:
    return [f"{to_grammar(each.left)} > {to_grammar(each.right)}" for each in found]


TOP = """
coordinates: [phi, theta, psi]
parameters: {I1: POSITIVE, I3: POSITIVE, k: POSITIVE}
T: I1*(theta'^2 + phi'^2*sin(theta)^2)/2 + I3*(psi' + phi'*cos(theta))^2/2
V: k*cos(theta)
"""


@pytest.mark.long
def test_the_sleeping_top():
    """Landau and Lifshitz, section 35, problem 1(c)."""
    upright = next(m for m in motions(TOP) if m.rates is None and to_grammar(m.at["theta"]) == "0")
    assert upright.verdict.stable is None
    assert conditions(upright.verdict.minimum or ()) == ["p_psi^2 > 4*I1*k"]


@pytest.mark.long
@pytest.mark.parametrize("k", ["POSITIVE", ""])
def test_every_regular_precession_is_stable(k):
    """Whittaker, section 71: A² Ω⁴ - 2 A k Ω² cos + k² > 0 for k of either sign, as sin is not 0."""
    precession = motions(TOP.replace("k: POSITIVE", f"k: {k}"))[0]
    assert precession.free == ("theta", "phi'")
    assert precession.verdict.stable is True


@pytest.mark.long
def test_the_nutation_of_a_regular_precession():
    """Whittaker, section 71: the small nutation by the numeric curvature of U_eff."""
    precession = motions(TOP)[0]
    assert precession.free == ("theta", "phi'")
    assert precession.verdict.stable is True
    I1, k, theta, rate = (mpmath.mpf(x) for x in ("1.3", "0.7", "0.9", "1.6"))
    p_psi = I1 * rate * mpmath.cos(theta) + k / rate
    p_phi = I1 * rate * mpmath.sin(theta) ** 2 + p_psi * mpmath.cos(theta)

    def U(x):
        return (p_phi - p_psi * mpmath.cos(x)) ** 2 / (
            2 * I1 * mpmath.sin(x) ** 2
        ) + k * mpmath.cos(x)

    with mpmath.workdps(30):
        assert abs(mpmath.diff(U, theta)) < 1e-12
        expected = mpmath.diff(U, theta, 2) / I1
    values = {"I1": I1, "k": k, "theta": theta, "phi'": rate}
    [square] = precession.frequencies_squared
    from lagcli.algebra.build import Builder, symbol

    names = {n: symbol(n) for n in ("I1", "k", "theta", "phi")}
    built = Builder(names, {}, lambda e: Symbol(e.name + "'", real=True))(square)
    found = built.subs({s: values[s.name] for s in built.free_symbols})
    assert abs(found - expected) < 1e-10


def test_a_maximum_of_the_potential_held_by_a_magnetic_field():
    """Gyroscopic stabilization: m x'' = a x + q B y', stable to first order for q² B² > 4 m a."""
    [found] = motions("""
coordinates: [x, y]
parameters: {m: POSITIVE, a: POSITIVE, b: POSITIVE}
L: m*(x'^2 + y'^2)/2 + b*(x*y' - y*x')/2 + a*(x^2 + y^2)/2
""")
    assert found.verdict.stable is None
    assert found.verdict.minimum is None
    assert conditions(found.verdict.spectrum or ()) == ["b^2 > 4*m*a"]
    for b, stable in ((mpmath.mpf("1.9"), False), (mpmath.mpf("2.1"), True)):
        flow = mpmath.matrix([[0, 0, 1, 0], [0, 0, 0, 1], [1, 0, 0, b], [0, 1, -b, 0]])
        roots = mpmath.eig(flow, left=False, right=False)
        assert all(abs(r.real) < 1e-10 for r in roots) is stable


def test_a_field_shifts_both_frequencies_by_larmors():
    """omega = sqrt(k + w^2) ± w (Goldstein, Poole, Safko, 3rd ed., section 5.9), and squared."""
    [rest] = motions("""
coordinates: [x, y]
parameters: {k: {assume: positive}, w: }
L: (x'^2 + y'^2)/2 + w*(x*y' - y*x') - k*(x^2 + y^2)/2
""")
    found = {to_grammar(square) for square in rest.frequencies_squared}
    assert found == {"(w + sqrt(k + w^2))^2", "(sqrt(k + w^2) - w)^2"}


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_a_field_on_a_turntable_that_turns_freely(seed):
    """At the axis m^2 s^2 - (m K1 + m K2 + 4 w^2) s + K1 K2 = 0 for s = omega^2, at any rate."""
    a, b, c = [(2, 3, 5), (3, 5, 1)][seed]
    found = motions(f"""
coordinates: [x, y, phi]
parameters: {{m: POSITIVE, k: POSITIVE, w: POSITIVE}}
L: "m*(x'^2 + y'^2)/2 + m*(1 + x^2 + {a}*y^2)*phi'^2/2 + w*(x*y' - y*x') - k*({b}*x^2 + {c}*y^2)/2"
""")
    [axis] = [each for each in found if {str(q): to_grammar(x) for q, x in each.at.items()}
              == {"x": "0", "y": "0"}]  # fmt: skip
    m, k, w, rate = mpmath.mpf(13) / 11, mpmath.mpf(17) / 7, mpmath.mpf(5) / 9, mpmath.mpf(2) / 5
    one, other = m * (b * k / m - rate**2), m * (c * k / m - a * rate**2)
    values = {"m": m, "k": k, "w": w, "phi": rate}
    for square in axis.frequencies_squared:
        expression = normal(square)
        s = mpmath.mpf(expression.subs({x: values[x.name] for x in expression.free_symbols}))
        residue = m**2 * s**2 - (m * one + m * other + 4 * w**2) * s + one * other
        assert abs(residue) < 1e-10
    assert len(axis.frequencies_squared) == 2


def test_a_saddle_with_one_falling_direction_is_never_held():
    """det K < 0: gyroscopic terms cannot help (Chetaev, chapter V)."""
    [found] = motions("""
coordinates: [x, y]
parameters: {a: POSITIVE, c: POSITIVE, b: POSITIVE}
L: (x'^2 + y'^2)/2 + b*(x*y' - y*x')/2 + a*x^2/2 - c*y^2/2
""")
    assert found.verdict.stable is False


def test_with_dissipation_the_gyroscopic_terms_are_of_no_use():
    """Chetaev, chapter V: complete dissipation, and U_eff has no minimum."""
    [found] = motions("""
coordinates: [x, y]
parameters: {a: POSITIVE, b: POSITIVE, d: POSITIVE}
L: (x'^2 + y'^2)/2 + b*(x*y' - y*x')/2 + a*(x^2 + y^2)/2
dissipation: d*(x'^2 + y'^2)/2
""")
    assert found.verdict.stable is False
    assert found.verdict.spectrum is None


def test_parameters_without_a_sign_leave_the_verdict_open():
    [found] = motions("{coordinates: [x], parameters: [m, k], L: m*x'^2/2 - k*x^2/2 - k*x^4}")
    assert found.verdict.stable is None
    assert "the kinetic energy is not known to be positive definite" in found.verdict.reason
    assert "{assume: positive}" in found.verdict.reason


def test_nothing_is_said_of_a_parametric_drive():
    section, missing = steady_motions(
        derive("{coordinates: [x], parameters: [w], L: x'^2/2 - (1 + cos(w*t))*x^2/2}")
    )
    assert section.motions is None
    assert missing == [("the steady motions", "the equations depend explicitly on the time")]


def test_a_state_that_is_given_is_taken_when_it_is_steady():
    text = """
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, k: POSITIVE, R: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k/r
initial: {r: R, phi': RATE}
"""
    first = motions(text.replace("RATE", "sqrt(k/(m*R^3))"))[0]
    assert normal(first.rates["phi"]) == formula("sqrt(k/(m*R^3))")
    assert [normal(x) for x in first.frequencies_squared] == [formula("k/(m*R^3)")]
    assert first.verdict.stable is True
    [only] = motions(text.replace("RATE", "2*sqrt(k/(m*R^3))"))
    assert only.free == ("r",)


def test_a_constraint_stays_in_the_reduced_system():
    found = motions("""
coordinates: [x, y, z]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(x'^2 + y'^2 + z'^2)/2
V: m*g*y
constraints: {rod: x^2 + y^2 = l^2}
""")
    assert {to_grammar(m.at["y"]): m.verdict.stable for m in found} == {"-l": True, "l": False}
    assert all(to_grammar(m.rates["z"]) == "p_z/m" for m in found)


@pytest.mark.parametrize(
    ("expression", "positive", "expected"),
    [
        ("3*cos(x)**2 + 1", [], 1),
        ("3*cos(x)**2", [], None),
        ("a + b*sin(x)**2", [], 1),
        ("b*cos(x)", ["cos(x)/sin(x)**2"], 1),
        ("-b/cos(x)", ["b/cos(x)"], -1),
        ("a - b*sin(x)**2", [], None),
    ],
)
def test_signs(expression, positive, expected):
    a, b = symbols("a b", positive=True)
    from sympy import sympify

    names = {"a": a, "b": b, "x": Symbol("x", real=True)}
    built = [sympify(e, locals=names) for e in (expression, *positive)]
    assert sign(built[0], built[1:]) == expected


@pytest.mark.long
def test_a_spring_and_a_rotation():
    """The linearised equations of a family against the Hessian of U_eff by finite differences."""
    text = """
coordinates: {r: POSITIVE, theta: {}, phi: {}}
parameters: {m: POSITIVE, g: POSITIVE, k: POSITIVE, l: POSITIVE}
T: m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2
V: k*(r - l)^2/2 - m*g*r*cos(theta)
"""
    family = next(m for m in motions(text) if "theta" in m.free)
    numbers = {"m": 1.2, "g": 0.9, "k": 3.0, "l": 1.1, "theta": 0.6}
    from lagcli.algebra.build import Builder, symbol

    names = {n: symbol(n) for n in (*numbers, "r", "phi")}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'", real=True))

    def value(tree):
        return float(build(tree).subs({symbol(n): v for n, v in numbers.items()}))

    r, rate = value(family.at["r"]), value(family.rates["phi"])
    p = numbers["m"] * (r * mpmath.sin(numbers["theta"])) ** 2 * rate
    assert abs(p - value(family.momenta["phi"])) < 1e-10

    def U(a, b):
        m, g, k, length = (numbers[n] for n in "mgkl")
        wall = p**2 / (2 * m * (a * mpmath.sin(b)) ** 2)
        return wall + k * (a - length) ** 2 / 2 - m * g * a * mpmath.cos(b)

    place = (r, numbers["theta"])
    with mpmath.workdps(30):
        orders = [[(2, 0), (1, 1)], [(1, 1), (0, 2)]]
        hessian = Matrix(2, 2, lambda i, j: mpmath.diff(U, place, orders[i][j]))
    stiffness = Matrix(2, 2, lambda i, j: value(family.stiffness[i][j]))
    assert max(abs(x) for x in hessian - stiffness) < 1e-8


@pytest.mark.parametrize(
    ("potential", "stable", "minimum"),
    [("w^2*x^2/2", None, ["w^2 > 0"]), ("-w^2*x^2/2", None, None), ("k*x^2/2", True, [])],
)
def test_a_square_that_may_vanish_proves_nothing(potential, stable, minimum):
    parameters = "parameters: {w: {}, k: POSITIVE}"
    [found] = motions(f"{{coordinates: [x], {parameters}, L: x'^2/2 - ({potential})}}")
    assert found.verdict.stable is stable
    assert (None if found.verdict.minimum is None else conditions(found.verdict.minimum)) == minimum
    assert [f"{to_grammar(e.left)} > {to_grammar(e.right)}" for e in found.verdict.unstable] == (
        ["w^2 > 0"] if minimum is None else []
    )


@pytest.mark.long
def test_the_collinear_points_by_numbers():
    """Szebehely, Theory of Orbits, section 4.2: the zeros of the force along the axis."""
    found = motions("""
coordinates: [x, y]
T: ((x' - y)^2 + (y' + x)^2)/2
V: -9/10/sqrt((x + 1/10)^2 + y^2) - 1/10/sqrt((x - 9/10)^2 + y^2)
""")
    collinear = [m for m in found if to_grammar(m.at["y"]) == "0"]
    triangular = [m for m in found if m not in collinear]
    assert sorted(to_grammar(m.at["y"]) for m in triangular) == ["-sqrt(3)/2", "sqrt(3)/2"]

    def force(x):
        near, far = x - mpmath.mpf("0.9"), x + mpmath.mpf("0.1")
        return (
            x - mpmath.mpf("0.9") * far / abs(far) ** 3 - mpmath.mpf("0.1") * near / abs(near) ** 3
        )

    with mpmath.workdps(30):
        roots = sorted(mpmath.findroot(force, start) for start in (-1.04, 0.6, 1.25))
        places = sorted(mpmath.mpf(to_grammar(m.at["x"])) for m in collinear)
        assert all(abs(a - b) < 1e-14 for a, b in zip(places, roots, strict=True))
    assert [m.verdict.stable for m in found] == [False] * 5  # 27 mu (1 - mu) = 2.43


@pytest.mark.long
def test_three_coupled_coordinates_against_their_numeric_spectrum():
    [motion] = motions("""
coordinates: [x, y, z]
parameters: {b: POSITIVE, c: POSITIVE}
L: (x'^2 + y'^2 + z'^2)/2 + b*(x*y' - y*x')/2 + c*(y*z' - z*y')/2 + (x^2 + 2*y^2 - 3*z^2)/2
""")
    assert motion.verdict.spectrum
    b, c = symbols("b c", positive=True)
    s = Symbol("s")
    whole = Matrix([[s**2 - 1, -b * s, 0], [b * s, s**2 - 2, -c * s], [0, c * s, s**2 + 3]]).det()
    sides = [
        formula(f"{to_grammar(e.left)} - ({to_grammar(e.right)})") for e in motion.verdict.spectrum
    ]
    verdicts = set()
    for value in [{b: i / 2, c: j / 2} for i in (1, 3, 4, 5, 7) for j in (1, 2, 4, 6)]:
        said = all(side.subs(value) > 0 for side in sides)
        numbers = [float(x) for x in whole.subs(value).as_poly(s).all_coeffs()]
        roots = mpmath.polyroots(numbers, maxsteps=200)
        assert said == all(abs(root.real) < 1e-7 for root in roots)
        verdicts.add(said)
    assert verdicts == {True, False}


def test_a_particle_in_a_cone_of_any_angle():
    """Goldstein, 3rd ed., chapter 1 and 3 (methods): omega^2 = 3 g sin(alpha) cos(alpha)/r.

    1/sin(alpha)^2 in the kinetic energy is positive, whatever the angle.
    """
    [circle] = motions("""
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, g: POSITIVE, alpha: POSITIVE}
T: m*(r'^2/sin(alpha)^2 + r^2*phi'^2)/2
V: m*g*r*cot(alpha)
""")
    assert circle.verdict.stable is True
    assert circle.verdict.theorem == "Routh"
    [square] = circle.frequencies_squared
    assert to_grammar(square) == "3*g*sin(alpha)*cos(alpha)/r"


@pytest.mark.parametrize("factor", ["1", "r^2", "(2 + r^2)"])
def test_drag_in_a_turning_medium_lets_turn_with_it(factor):
    """No momentum is constant, and yet k (r - a) = m r w² with phi' = w is steady."""
    [motion] = motions(
        f"""
coordinates: [r, phi]
parameters: {{m: POSITIVE, k: POSITIVE, a: POSITIVE, c: POSITIVE, w: POSITIVE}}
T: m*(r'^2 + r^2*phi'^2)/2
V: k*(r - a)^2/2
forces: {{phi: -c*{factor}*(phi' - w)}}
"""
    )
    assert motion.rates is not None
    assert to_grammar(motion.rates["phi"]) == "w"
    assert to_grammar(motion.at["r"]) == "k*a/(k - m*w^2)"
    assert conditions(motion.verdict.hurwitz)[0] == "k > m*w^2"


def test_a_mass_that_circles_on_a_table_and_one_that_hangs_and_may_swing():
    """m φ'² r = M g; the string holds M, which swings with ω² = g/(l - r) (Goldstein, 1.8)."""
    text = """
coordinates: [r, phi, theta]
parameters: {m: POSITIVE, M: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2 + M*(r'^2 + (l - r)^2*theta'^2)/2
V: -M*g*(l - r)*cos(theta)
"""
    below = next(m for m in motions(text) if to_grammar(m.at["theta"]) == "0")
    assert "r" not in below.at
    [rate] = (below.rates or {}).values()
    assert normal(rate) ** 2 == formula("M*g/(m*r)")
    squares = {normal(each) for each in below.frequencies_squared}
    assert squares == {formula("g/(l - r)"), formula("3*M*g/((m + M)*r)")}


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_the_distance_is_given_where_the_rate_is_short_by_it(turns):
    """An elastic string over a hole with M in the bight of `turns` pulleys: m φ'² r = M g/turns."""
    text = f"""
coordinates: {{r: POSITIVE, phi: {{}}, z: {{}}}}
parameters: {{m: POSITIVE, M: POSITIVE, g: POSITIVE, l: POSITIVE, k: POSITIVE}}
T: m*(r'^2 + r^2*phi'^2)/2 + M*z'^2/2
V: k*(r + {turns}*z - l)^2/2 - M*g*z
"""
    [circling] = motions(text)
    assert set(circling.at) == {"z"}
    [rate] = (circling.rates or {}).values()
    assert normal(rate) ** 2 == formula(f"M*g/({turns}*m*r)")
    assert circling.verdict.stable
    assert circling.verdict.minimum == ()


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_a_body_that_spins_about_its_axis_at_a_crest_of_the_potential(seed):
    """V = k sin(theta): at pi/2 the axis rests at any spin p, and I1 w^2 = p^2/I1 - k there."""
    I1, I3 = [("1", "2"), ("3", "1"), ("2", "5")][seed]
    text = TOP.replace("k*cos(theta)", "k*sin(theta)")
    text = text.replace("I1: POSITIVE, I3: POSITIVE, ", "").replace("I1", I1).replace("I3", I3)
    text = text.replace("[phi, theta, psi]", "{phi: {}, theta: POSITIVE, psi: {}}")
    spinning = [each for each in motions(text) if to_grammar(each.rates["phi"]) == "0"]
    assert [to_grammar(each.at["theta"]) for each in spinning] == ["pi/2"]
    [square] = spinning[0].frequencies_squared
    assert normal(square) == formula(f"p_psi^2/{I1}^2 - k/{I1}")


@pytest.mark.parametrize("potential", ["-1/r", "r^2", "r^4 - 3*r"])
def test_more_motions_may_be_steady_along_a_contact_that_is_closed(potential):
    """Inside p^2 = m r^3 V'(r) the body slides around the wall, pressed against it."""
    text = "{coordinates: {r: {assume: positive}, u: {}}, T: (r'^2 + r^2*u'^2)/2, V: V0 CONTACT}"
    for contact, sought in (
        (", contacts: {wall: {gap: r >= 1}}", " while the contact is open"),
        ("", ""),
    ):
        made = derive(text.replace("CONTACT", contact).replace("V0", potential))
        section, _ = steady_motions(made)
        assert section.motions
        assert section.complete
        assert section.where == sought


@pytest.mark.parametrize("gap", ["x >= v*t", "x >= sin(v*t) - 1", "x >= -t^2"])
def test_no_motion_is_called_steady_that_a_moving_contact_may_reach(gap):
    """Its condition depends on the time, as the one of rest there does."""
    text = "{coordinates: [x], parameters: [v], T: x'^2/2, V: x^2/2, contacts: {c: {gap: G}}}"
    section, missing = steady_motions(derive(text.replace("G", gap)))
    assert section.motions is None
    assert "a contact moves" in str(missing)


CONICAL = """
coordinates: {r: POSITIVE, phi: , z: }
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(r'^2 + r^2*phi'^2 + z'^2)/2
V: m*g*z
"""


@pytest.mark.parametrize("string", ["sqrt(r^2 + z^2) = l", "r^2 + z^2 = l^2", "l - z^2/l = r^2/l"])
def test_a_conical_pendulum_on_a_constraint(string):
    """Landau and Lifshitz, section 14, problem 1: about theta, omega^2 = (g/l)(1/cos + 3 cos)."""
    [conical] = motions(CONICAL + f"constraints: {{string: {string}}}")
    assert conical.verdict.stable is True
    assert conical.rates is not None
    values = {"g": 9.1, "l": 0.7, "m": 2.0, "z": -0.7 * 0.6}
    rate = evaluated(conical.rates["phi"], values, FUNCTIONS)
    assert rate**2 == pytest.approx(9.1 / (0.7 * 0.6))
    [square] = (evaluated(e, values, FUNCTIONS) for e in conical.frequencies_squared)
    assert square == pytest.approx(9.1 / 0.7 * (1 / 0.6 + 3 * 0.6))


@pytest.mark.parametrize("damped", [True, False])
def test_a_squared_frequency_that_is_not_real_says_so(damped):
    """Bateman, Phys. Rev. 38 (1931) 815: m x'' + c x' + k x = 0 with its mirror image."""
    turning = " + c*(x*y' - y*x')/2" if damped else ""
    [rest] = motions(
        "coordinates: [x, y]\nparameters: {m: POSITIVE, k: POSITIVE, c: POSITIVE}\n"
        f"L: m*x'*y' - k*x*y{turning}\n"
    )
    assert rest.may_be_complex is damped


@pytest.mark.long
@pytest.mark.parametrize("potential", ["sin(psi)", "cos(psi)"])
def test_what_grows_at_every_spin_is_unstable(potential):
    """Kowalevski's top with its centre of mass above: ω² = −k/(2 C) does not depend on the spin."""
    top = TOP.replace("I1", "2*I3").replace("2*I3: POSITIVE, ", "")
    found = motions(top.replace("k*cos(theta)", f"k*sin(theta)*{potential}"))
    growing = [m for m in found if any(to_grammar(w) == "-k/(2*I3)" for w in m.frequencies_squared)]
    assert growing
    assert all(m.verdict.stable is False for m in growing)


@pytest.mark.parametrize(
    ("file", "plane"),
    [
        ("V: k*z\nconstraints: {bowl: x^2 + y^2 = k^2*z^2}", ("x", "y")),
        ("V: k*z\nconstraints: {bowl: z = x^2/k + y^2}", ()),
        ("V: -k/sqrt(x^2 + y^2) + k*z^2", ("x", "y")),
        ("V: k*(y^2 + z^2)", ("y", "z")),
        ("V: k*(y^2 + z^2)\nforces: {x: k}", ()),
        ("V: k*(y^2 + z^2)\nforces: {x: -k*x}", ("y", "z")),
        ("V: k*(y^2 + z^2)\nforces: {x: -k*x*y}", ()),
        ("V: k*(y^2 + z^2)\nforces: {y: -k*y', z: -k*z'}", ()),
        ("V: k*(y^2 + z^2)\nforces: {y: -k*y^3, z: -k*z^3}", ()),
        ("V: k*x^2\nforces: {y: -k*y, z: -k*z}", ("y", "z")),
        ("forces: {z: -k}\nconstraints: {bowl: z = x^2 + y^2}", ("x", "y")),
        ("V: k*z", ()),
    ],
)
def test_where_rotations_change_nothing_steady_ones_are_not_denied(file, plane):
    head = "coordinates: [x, y, z]\nparameters: {k: POSITIVE}\nT: (x'^2 + y'^2 + z'^2)/2\n"
    text = f"{head}{file}".replace("POSITIVE", "{assume: positive}")
    assert steady_motions(derive(text))[0].plane == plane


@pytest.mark.parametrize(
    ("also", "repeated"), [(["equilibria", "modes"], False), (["equilibria"], True), ([], True)]
)
@pytest.mark.parametrize("cyclic", [False, True])
def test_equilibria_that_stand_with_their_modes_are_not_listed_again(also, repeated, cyclic):
    potential = "k*x^2/2" if cyclic else "k*x^2/2 + k*y^2"
    text = f"coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: {potential}\nparameters: "
    problem = read_problem("a.yaml", (text + "{k: {assume: positive}}").encode()).checked()
    answers = solve(problem, [*also, "steady_motions"])
    assert ("Steady motion 1" in render([answers], "text", Options())) == (repeated or cyclic)


@pytest.mark.parametrize("power", ["-k/r", "k*r", "-k/sqrt(r)"])
def test_a_routhian_that_is_not_quadratic_has_conditions(power):
    """γ m r φ'² = V'(r), Goldstein, section 7.9: with p_φ = γ m r² φ' it is 0 on the circle."""
    section, _ = steady_motions(
        derive(f"""
coordinates: {{r: {{assume: positive}}, phi: }}
parameters: {{k: {{assume: positive}}}}
L: -4*sqrt(1 - (r'^2 + r^2*phi'^2)/4) - ({power})
""")
    )
    [condition] = section.conditions.values()
    for r, v, k in ((0.7, 0.6, 1.1), (1.9, 1.7, 0.3)):
        gamma = (1 - v**2 / 4) ** -0.5
        pull = {"-k/r": k / r**2, "k*r": k, "-k/sqrt(r)": k / (2 * r**1.5)}[power]
        at = {"r": r, "p_phi": gamma * r * v, "k": k * gamma * v**2 / (r * pull)}
        values = {name: mpmath.mpf(x) for name, x in at.items()}
        assert evaluated(condition, values, FUNCTIONS) == pytest.approx(0, abs=1e-12)
        assert abs(evaluated(condition, {**values, "k": values["k"] + 1}, FUNCTIONS)) > 1e-3


@pytest.mark.parametrize("frame", ["0", "J*phi'^2/2"])
def test_a_precession_includes_rotation_about_a_diameter(frame):
    """A φ' = p_φ, p_ψ = A φ' cos θ: where cos θ = 0 it turns about a diameter at any rate."""
    found = motions(f"""
coordinates: {{theta: POSITIVE, phi: , psi: }}
parameters: {{A: POSITIVE, C: POSITIVE, J: POSITIVE}}
T: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2 + {frame}
""")
    [precession] = (m for m in found if set(m.free) == {"theta", "phi'"})
    values = {"theta": mpmath.pi / 2, "phi'": mpmath.mpf(2), "A": 3, "C": 2, "J": 1}
    assert evaluated(precession.momenta["psi"], values, FUNCTIONS) == pytest.approx(0)
    assert evaluated(precession.momenta["phi"], values, FUNCTIONS) > 5


@pytest.mark.parametrize("k", ["b", "2*b"])
def test_a_condition_on_a_free_momentum_is_met_by_either_sign(k):
    """A relativistic charge circles with γ m φ' = -2 k, p_φ = -k r²; p_φ = k r² is rest."""
    text = f"""
coordinates: {{r: {{assume: positive}}, phi: }}
parameters: {{b: {{assume: positive}}}}
L: -sqrt(1 - r'^2 - r^2*phi'^2) + {k}*r^2*phi'
"""
    problem = read_problem("a.yaml", text.encode()).checked()
    answers = solve(problem, ["steady_motions"])
    assert not answers.warnings
    assert len(answers.sections["steady_motions"].motions) == 2


@pytest.mark.parametrize(
    ("coordinates", "physics", "momentum", "rest"),
    [
        ("{r: POSITIVE, phi: }", "L: m*(r'^2 + r^2*phi'^2)/2 + q*b*r^2*phi'/2 - k*log(r)",
         "m*r^2", "k/(m*r^2)"),
        ("{r: POSITIVE, phi: }", "L: m*(r'^2 + r^2*phi'^2)/2 + q*b*r^2*phi'/2 - k*r^4/4",
         "m*r^2", "k*r^2/m"),
        ("{theta: , phi: }", ("L: m*(theta'^2 + phi'^2*sin(theta)^2)/2 + q*b*phi'*sin(theta)^2/2 "
         "+ k*cos(theta)"), "m*sin(theta)^2", "k/(m*cos(theta))"),
    ],
)  # fmt: skip
def test_two_rates_in_a_magnetic_field_have_one_root(coordinates, physics, momentum, rest):
    """Landau and Lifshitz, The Classical Theory of Fields, section 21: -q b/2 m ± sqrt(...)."""
    found = motions(
        f"coordinates: {coordinates}\nparameters: {{m: POSITIVE, q: POSITIVE, b: POSITIVE, "
        f"k: POSITIVE}}\n{physics}\n"
    )[:2]
    root = f"sqrt(q^2*b^2/(4*m^2) + {rest})"
    assert {to_grammar(m.rates["phi"]) for m in found} == {
        f"{root} - q*b/(2*m)",
        f"-{root} - q*b/(2*m)",
    }
    PHI = Symbol("PHI", positive=True)
    for motion in found:
        p = formula(to_grammar(motion.momenta["phi"]))
        rate = formula(to_grammar(motion.rates["phi"]))
        expected = formula(f"({momentum})*(PHI + q*b/(2*m))")
        difference = (p - expected.subs(PHI, rate)).subs(
            {s: 0.3 + 0.1 * k for k, s in enumerate(sorted(p.free_symbols, key=str))}
        )
        assert abs(difference.evalf()) < 1e-12


@pytest.mark.parametrize(("i", "j"), [(1, -2), (2, -1), (3, -2), (1, -4)])
def test_two_cyclic_coordinates_turn_in_either_sense_each(i, j):
    """0 = d/dr of T = (r'^2 + r^i a'^2 + s r^j b'^2)/2, with s = 1: i r^i a'^2 = -j r^j b'^2."""
    found = motions(
        "coordinates: {r: POSITIVE, a: {}, b: {}}\n"
        f"T: (r'^2 + r^({i})*a'^2 + r^({j})*b'^2)/2\nV: 0"
    )
    turning = set()
    for p_b in (0.7, -0.7):
        for each in found:
            assert each.rates is not None
            values = {"r": 1.3, "p_b": p_b, "p_a": p_b, "a'": p_b, "b'": p_b}
            a, b = (evaluated(each.rates[name], values, FUNCTIONS) for name in "ab")
            assert i * 1.3**i * a**2 == pytest.approx(-j * 1.3**j * b**2)
            for sense in (1, -1) if each.mirrored else (1,):
                turning.add((sense * a > 0, sense * b > 0))
    assert len(turning) == 4


@pytest.mark.parametrize("n", [1, 2, 5])
def test_a_circular_orbit_is_stable_where_its_inertia_is_positive_with_it(n):
    """About f = 1 - n k/r beyond 3 n k, three horizons: Hartle, Gravity, section 9.3."""
    [orbit] = motions(
        "coordinates: {r: POSITIVE, u: {}, a: {}}\nparameters: {k: POSITIVE}\n"
        f"L: (-(1 - {n}*k/r)*u'^2 + r'^2/(1 - {n}*k/r) + r^2*a'^2)/2"
    )
    assert orbit.verdict.stable is None
    assert orbit.verdict.minimum
    assert not orbit.verdict.spectrum
    for r, k in ((2, 1), (1, 1), (4, 1.1), (4.2, 1.5), (9, 0.7)):
        at = {"r": r, "k": k, "p_a": 0.6, "p_u": 0.8, "u'": 0.4, "a'": 0.3}
        holds = [
            evaluated(c.left, at, FUNCTIONS) > evaluated(c.right, at, FUNCTIONS)
            for c in orbit.verdict.minimum
        ]
        assert all(holds) == (r > 3 * n * k)
