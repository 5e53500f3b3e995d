"""Symmetries of one space, and of one system, in whatever coordinates it is written.

Landau and Lifshitz, *Mechanics*, section 48 (parabolic and elliptic coordinates); Goldstein, Poole,
Safko, *Classical Mechanics*, 3rd ed., section 3.9 (Kepler); do Carmo, *Differential Geometry of
Curves and Surfaces*, sections 4-4 and 5-11 (pseudosphere, hyperbolic plane); Niederer, Helv. Phys.
Acta 45 (1972) 802 (free particles).
"""

import random

import pytest

from lagcli.mechanics.discovery.summary import summary
from lagcli.pipeline import explain
from tests.marks import mostly_long
from tests.oracle.constancy import digits_of

from .derived import derive
from .test_discovery_literature import POS, problem
from .test_explanation import words

RADIAL = f"{{r: {POS}, phi: {{}}}}"
PLANES = {
    "parabolic": ("[u, v]", "(u^2 + v^2)*(u'^2 + v'^2)", "2/(u^2 + v^2)"),
    "parabolic, stretched": ("[u, v]", "(u^2 + 4*v^2)*(u'^2 + 4*v'^2)", "2/(u^2 + 4*v^2)"),
    "logarithmic": ("[s, phi]", "exp(2*s)*(s'^2 + phi'^2)", "exp(-s)"),
    "a cone unrolled": (RADIAL, "r'^2/sin(a)^2 + r^2*phi'^2", "1/r"),
    "bipolar": (
        "[u, v]",
        "(u'^2 + v'^2)/(cosh(u) - cos(v))^2",
        "sqrt((cosh(u) - cos(v))/(cosh(u) + cos(v)))",
    ),
    "elliptic": ("[u, v]", "(cosh(u)^2 - cos(v)^2)*(u'^2 + v'^2)", "1/(cosh(u) - cos(v))"),
    "by any power": (RADIAL, "a^2*r^(2*a - 2)*r'^2 + r^(2*a)*phi'^2", "1/r^a"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", PLANES)
def test_a_flat_plane_has_the_eight_of_a_free_particle(name):
    coordinates, rates, _ = PLANES[name]
    found = summary(derive(problem(f"m*({rates})/2", coordinates, "m a")).discovery)
    assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
    assert found.name.startswith("Schrödinger sch(2)")


CONES = {"r": (17, "Schrödinger sch(4)"), "sinh(r)": (11, "so(4,1)"), "2*sin(r/2)": (11, "so(5)")}


@pytest.mark.parametrize("f", mostly_long(CONES, "r"))
def test_what_stands_over_a_sphere_in_eulers_angles_has_constant_curvature(f):
    """dr^2 + f^2 dl^2: flat, hyperbolic and a sphere, of four dimensions."""
    sphere = "(theta'^2 + sin(theta)^2*phi'^2 + (psi' + cos(theta)*phi')^2)/4"
    coordinates = f"{{r: {POS}, theta: {{}}, phi: {{}}, psi: {{}}}}"
    found = summary(derive(problem(f"(r'^2 + ({f})^2*{sphere})/2", coordinates)).discovery)
    dimension, name = CONES[f]
    assert found.dimension == dimension
    assert found.name.startswith(name)


@pytest.mark.long
@pytest.mark.parametrize("V", ["0", "b*a^3"])
def test_a_universe_with_a_scalar_field_is_a_flat_plane_of_powers(V):
    """Whether or not a is said to be positive, though a^(3/2) is real for no other one.

    Piedipalumbo, Scudellaro, Esposito, Rubano, Gen. Relativ. Gravit. 44 (2012) 2611.
    """
    for a in ("{}", POS):
        L = f"-3*a*a'^2 + a^3*phi'^2/2 - {V}"
        found = summary(derive(problem(L, f"{{a: {a}, phi: {{}}}}", "|b")).discovery)
        assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
        assert found.name.startswith("sl(2,R) + so(1,1) with Heisenberg h(2)")


@pytest.mark.parametrize("seed", mostly_long(range(8), 1, 2))
def test_a_plane_whose_coordinates_stretch_has_the_eight_of_a_free_particle(seed):
    """x^p y^q times any form in x'/x and y'/y: flat, as p log(x) + q log(y) is harmonic.

    Its Cartesian coordinates are powers with square roots, or turn with the logarithms.
    """
    draw = random.Random(seed)
    p, q, A, C = (draw.choice((-3, -2, -1, 1, 2, 3)) for _ in range(4))
    B = draw.choice([k for k in range(-3, 4) if k * k != A * C])
    if A > 0 and seed % 2 == 0:
        C = B * B // A + draw.randint(1, 3)  # definite
    form = f"{A}*x'^2/x^2 + 2*{B}*x'*y'/(x*y) + {C}*y'^2/y^2"
    text = problem(f"x^({p})*y^({q})*({form})/2", f"{{x: {POS}, y: {POS}}}", "")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("w", ["w", "2", "12"])
def test_a_universe_of_brans_and_dicke_is_a_plane_of_powers(w):
    """Capozziello and others, Int. J. Mod. Phys. D 5 (1996) 85: a repulsion from one point."""
    L = f"6*a*f*a'^2 + 6*a^2*a'*f' - {w}*a^3*f'^2/f + 2*k*a^3*f"
    derivation = derive(problem(L, f"{{a: {POS}, f: {POS}}}", "w k"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("F", ["", " - b/(x^2 + y^2)"])
def test_a_flux_line_changes_no_bracket_away_from_it(F):
    """L_z + flux and L_z have the same brackets (Aharonov, Bohm, Phys. Rev. 115 (1959) 485)."""
    free = f"m*(x'^2 + y'^2)/2 + k/sqrt(x^2 + y^2){F}"
    flux = f"{free} + c*(x*y' - y*x')/(x^2 + y^2)"
    with_, without = (
        summary(derive(problem(L, parameters="m k b c")).discovery) for L in (flux, free)
    )
    assert (with_.dimension, with_.name) == (without.dimension, without.name)


@pytest.mark.long
@pytest.mark.parametrize("name", PLANES)
def test_kepler_keeps_its_runge_lenz_vector(name):
    coordinates, rates, inverse = PLANES[name]
    text = problem(f"m*({rates})/2 + k*{inverse}", coordinates, "m a k")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (3, True)
    assert found.name == ("the energy and so(3) where the energy is negative, e(2) where it is 0, "
                          "sl(2,R) where it is positive")  # fmt: skip
    digits = digits_of(derivation)
    assert len(digits) == 4
    assert min(digits.values()) > 20


CYLINDER = (f"{{r: {POS}, phi: {{}}, z: {{}}}}", "r'^2 + r^2*phi'^2 + z'^2")


@pytest.mark.long
def test_space_in_cylindrical_coordinates_has_twelve():
    found = summary(derive(problem(f"m*({CYLINDER[1]})/2", CYLINDER[0], "m")).discovery)
    assert (found.dimension, found.independent) == (12, 6)
    assert found.name.startswith("Schrödinger sch(3)")


@pytest.mark.long
def test_a_magnetic_field_along_the_axis_has_no_galilei_algebra():
    field = problem(f"m*({CYLINDER[1]})/2 + B*r^2*phi'/2", CYLINDER[0], "m B")
    found = summary(derive(field).discovery)
    assert (found.dimension, found.name, found.integrable) == (
        8,
        "R^2 with Heisenberg h(3), modulo constants",
        True,
    )


HYPERBOLIC = {
    "m*(cosh(x)^2*y'^2 + x'^2)/2": "[x, y]",
    "m*(R^2*sinh(s/R)^2*phi'^2 + s'^2)/2": "[s, phi]",
    "m*(x'^2 + y'^2)/(2*sinh(y)^2)": "[x, y]",
    "m*(tanh(x)^2*x'^2 + y'^2/cosh(x)^2)/2": "[x, y]",
    "m*(r'^2/(1 + r^2/R^2) + r^2*phi'^2)/2": RADIAL,
    "m*(r'^2/(r^2 - R^2) + r^2*phi'^2/R^2)/2": RADIAL,
    "m*(r'^2/(1 - r^2/R^2) - (1 - r^2/R^2)*x'^2)/2": f"{{r: {POS}, x: {{}}}}",
    "m*(x'^2 + y'^2)/(2*(1 - x^2 - y^2)^2)": "[x, y]",
}
SPHERE = {
    "m*(x'^2 + y'^2)/(2*cosh(y)^2)": "[x, y]",
    "m*(r'^2/(1 - r^2/R^2) + r^2*phi'^2)/2": RADIAL,
    "m*R^2*(sin(a*s)^2*phi'^2 + a^2*s'^2)/2": "[s, phi]",
    "m*(a^2*r^(2*a - 2)*r'^2 + r^(2*a)*phi'^2)/(1 + r^(2*a))^2": RADIAL,
    "m*(x'^2 + y'^2)/(2*(1 + x^2 + y^2)^2)": "[x, y]",
}


@pytest.mark.parametrize("name", ["sl(2,R) + R", "so(3) + R"])
@pytest.mark.long
def test_surfaces_of_constant_curvature_have_three_isometries(name):
    for L, coordinates in (HYPERBOLIC if "sl" in name else SPHERE).items():
        found = summary(derive(problem(L, coordinates, "m R a")).discovery)
        assert (found.dimension, found.name, found.independent) == (4, name, 3), L


@pytest.mark.parametrize(
    ("L", "name"),
    [
        ("A*(theta'^2 + phi'^2 + psi'^2 + 2*cos(theta)*phi'*psi')/2", "so(4) + R"),
        ("m*(r'^2 + sinh(r)^2*(theta'^2 + sin(theta)^2*phi'^2))/2", "so(3,1) + R"),
        ("m*(x'^2 + cosh(x)^2*(y'^2 + cosh(y)^2*z'^2))/2", "so(3,1) + R"),
    ],
)
@pytest.mark.long
def test_spaces_of_constant_curvature_have_six(L, name):
    coordinates = [q for q in "theta phi psi r x y z".split() if f"{q}'" in L]
    found = summary(derive(problem(L, f"[{', '.join(coordinates)}]", "m A")).discovery)
    assert (found.dimension, found.name, found.independent) == (7, name, 5)


@pytest.mark.long
@pytest.mark.parametrize("sin", ["sin", "sinh"])
def test_a_monopole_in_a_curved_space_keeps_the_runge_lenz_vector(sin):
    """Where c = g^2/2, as in flat space (McIntosh, Cisneros, J. Math. Phys. 11 (1970) 896)."""
    cos = sin.replace("sin", "cos")
    derivation = derive(problem(
        f"(x'^2 + {sin}(x)^2*(theta'^2 + sin(theta)^2*phi'^2))/2 + g*cos(theta)*phi' "
        f"+ k*{cos}(x)/{sin}(x) - g^2/(2*{sin}(x)^2)", "[x, theta, phi]", "|k g"
    ))  # fmt: skip
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (4, 5, True)
    assert len(derivation.discovery.hidden_charges) == 3
    assert min(digits_of(derivation).values()) > 20


DAMPED = {
    "polar": ("exp(c*t)*(r'^2 + r^2*phi'^2 - k*r^2)/2", RADIAL, 8),
    "parabolic": ("exp(c*t)*(u^2 + v^2)*(u'^2 + v'^2)/2", "[u, v]", 8),
    "polar, a mass that grows": ("t^2*(r'^2 + r^2*phi'^2)/2", RADIAL, 8),
    "Gompertz": ("exp(c*t)*(x'^2/x^2 - k*log(x)^2)/2", f"{{x: {POS}}}", 5),
    "a square": ("exp(c*t)*(x^2*x'^2 - k*x^4)/2", f"{{x: {POS}}}", 5),
    "a hyperbolic sine": ("exp(c*t)*(cosh(x)^2*x'^2 - k*sinh(x)^2)/2", "[x]", 5),
    "an inverse tangent": ("exp(c*t)*(x'^2/(1 + x^2)^2 - k*atan(x)^2)/2", "[x]", 5),
    "a sphere": ("exp(c*t)*(theta'^2 + sin(theta)^2*phi'^2)/2", "[theta, phi]", 4),
}


@pytest.mark.long
@pytest.mark.parametrize("name", DAMPED)
def test_a_factor_of_time_leaves_the_isometries(name):
    """Caldirola, Nuovo Cimento 18 (1941) 393 (damping as exp(c t)), in other coordinates."""
    L, coordinates, dimension = DAMPED[name]
    derivation = derive(problem(L, coordinates, "c k"))
    assert summary(derivation.discovery).dimension == dimension
    assert derivation.discovery.stopped == []
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("slope", "X"), [("cosh(x)", "sinh(x)"), ("exp(x)", "exp(x)"), ("1", "x"), ("1/x^2", "1/x")]
)
def test_a_power_of_the_arc_length_has_its_special_exponents(slope, X):
    """None, a constant force, the oscillator's, and n = -2 (Landau, Lifshitz, section 23, problem)."""
    L = f"({slope})^2*x'^2/2 - k*({X})^n"
    cases = derive(problem(L, f"{{x: {POS}}}", "k|n")).special_cases
    values = {int(c.value) for c in cases if c.parameter.name == "n"}
    assert values == {-2, 0, 1, 2}


@pytest.mark.long
@pytest.mark.parametrize(
    "L", ["(1 + a*x)^2*x'^2 - k*(x + b*x^2/2)^2", "(1 + a*x)*x'^2 - k*(1 + b*x)^3"]
)
def test_where_the_force_is_linear_in_the_arc_length_there_are_five(L):
    cases = derive(problem(L, "[x]", "|k a b")).special_cases
    numbers = {(c.parameter.name, str(c.value)): c.number for c in cases}
    assert numbers["b", "a"] == 5


@pytest.mark.long
@pytest.mark.parametrize("u", [
    "cos(theta)", "sin(theta)*cos(phi)", "sin(theta)*sin(phi)",
    "(4*cos(theta) + 3*sin(theta)*cos(phi))/5",
])  # fmt: skip
def test_kepler_on_a_sphere_has_two_integrals_about_any_axis(u):
    """Killing, J. Reine Angew. Math. 98 (1885) 1; Higgs, J. Phys. A 12 (1979) 309."""
    L = f"(theta'^2 + sin(theta)^2*phi'^2)/2 + k*{u}/sqrt(1 - ({u})^2)"
    derivation = derive(problem(L, "[theta, phi]", "k"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.independent, found.integrable) == (4, 3, True)
    assert derivation.discovery.stopped == []
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("L", [
    "m*((R + a*cos(theta))^2*phi'^2 + a^2*theta'^2)/2", "m*cosh(theta)^2*(theta'^2 + phi'^2)/2",
    "m*((1 + theta^2)*phi'^2 + theta'^2)/2", "m*(exp(theta^2)*phi'^2 + theta'^2)/2",
])  # fmt: skip
def test_a_surface_of_revolution_whose_curvature_varies_has_one(L):
    found = summary(derive(problem(L, "[theta, phi]", "m R a")).discovery)
    assert (found.dimension, found.independent, found.integrable) == (2, 2, True)


POLAR = "m*(r'^2 + r^2*phi'^2)/2 + b*(s'^2 + s^2*psi'^2)/2"
APART = {
    "polar": ("{r: POS, phi: {}, s: POS, psi: {}}", POLAR, "r^2 + s^2 - 2*r*s*cos(phi - psi)"),
    "one polar": ("{x: {}, y: {}, s: POS, psi: {}}", "m*(x'^2 + y'^2)/2 + b*(s'^2 + s^2*psi'^2)/2",
                  "(x - s*cos(psi))^2 + (y - s*sin(psi))^2"),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", APART)
@pytest.mark.parametrize("V", ["k*D", "-k/sqrt(D)"])
def test_two_bodies_have_total_momentum_in_polar_coordinates(name, V):
    """Each has a flat T of its own: 7 charges as in Cartesian coordinates, with L_rel among them."""
    coordinates, T, distance = APART[name]
    text = f'{{coordinates: {coordinates}, parameters: {{m: POS, b: POS, k: POS}}, T: "{T}", V: "{V}"}}'
    text = text.replace("POS", "{assume: positive}").replace("D", f"({distance})")
    derivation = derive(text)
    found = summary(derivation.discovery)
    linear = [c for c in derivation.discovery.point_charges if c.transformation.time == 0]
    if V == "-k/sqrt(D)":
        assert found.name == "Galilei in 2 dimensions + R, modulo constants"
        assert (len(linear), found.dimension) == (6, 7)
        assert len(derivation.discovery.hidden_charges) == 2  # the Runge-Lenz vector
        assert derivation.discovery.stopped == []
    assert (found.in_involution, found.integrable) == (4, True)
    assert min(digits_of(derivation).values()) > 20


RAPID = {
    "sqrt(a^2*x^2 - x'^2)": ("{x: {assume: positive}}", "iso(1,1)"),
    "sqrt((3 + a*x)^2 - 4*x'^2)": ("{x: {assume: positive}}", "iso(1,1)"),
    "sqrt(a^2*x^2 - x'^2 - y'^2)": ("{x: {assume: positive}, y: {}}", "iso(2,1)"),
    "sqrt(1 - r'^2 - r^2*(phi' + a)^2)": (RADIAL, "iso(2,1)"),
    "sqrt(exp(2*x) - x'^2*exp(2*x))": ("[x]", "iso(1,1)"),
    "sqrt(1 - cosh(a*t)^2*x'^2)": ("[x]", "sl(2,R)"),
    "sqrt(1 + y'^2)/y": ("{y: {assume: positive}}", "sl(2,R)"),
}


@pytest.mark.parametrize("root", RAPID)
def test_a_length_has_the_isometries_of_space_and_time(root):
    """Rindler's frame, one that turns, de Sitter's universe; light where n = 1/y.

    Rindler, *Relativity*, 2nd ed., sections 3.8 and 16.4; Landau, Lifshitz, *The Classical Theory of
    Fields*, section 87.
    """
    coordinates, name = RAPID[root]
    derivation = derive(problem(f"-m*{root}", coordinates, "m a"))
    n = len(derivation.system.q)
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent) == ((n + 1) * (n + 2) // 2, 2 * n)
    assert name in found.name
    assert min(digits_of(derivation).values()) > 20


IN_A_FIELD = {
    "-m*sqrt(1 + a^2*x^2 - x'^2/(1 + a^2*x^2)) + F*x": "[x]",
    "-m*sqrt(1 - cosh(a*t)^2*x'^2) + F*sinh(a*t)*x'": "[x]",
    "-m*sqrt(a^2*x^2 - x'^2) + F*x^2/2": "{x: {assume: positive}}",
}


@pytest.mark.parametrize("L", IN_A_FIELD)
def test_a_field_as_strong_everywhere_leaves_the_three_isometries_of_a_line(L):
    """Comtet, Ann. Phys. 173 (1987) 185, of the half plane: dA is a multiple of the area."""
    derivation = derive(problem(L, IN_A_FIELD[L], "m a F"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent) == (3, 2)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("mass", ["m", "M"])
def test_coordinates_are_called_cartesian_where_their_masses_are_equal(mass):
    """T = m (r'² + r² φ'²)/2 + M z'²/2: z has another scale than r cos φ."""
    text = (
        "{coordinates: {r: {assume: positive}, phi: , z: }, parameters: {m: {assume: positive}, "
        "M: {assume: positive}}, functions: {V: [r, z]}, "
        f'T: "m*(r\'^2 + r^2*phi\'^2)/2 + {mass}*z\'^2/2", V: "V(r, z)"}}'
    )
    found = words(explain(derive(text), ("discovered",)), "Discovered symmetries")
    assert ("The Cartesian coordinates are" in found) == (mass == "m")
    assert ("constant multiples of" in found) == (mass == "M")


@pytest.mark.long
@pytest.mark.parametrize(("names", "n"), [("m M", 1), ("b a", 2), ("p q", 3)])
def test_a_swinging_atwood_machine_is_special_at_three_to_one(names, n):
    """Tufillaro, Am. J. Phys. 54 (1986) 142: integrable at M = 3 m, here with theta = n psi."""
    m, M = names.split()
    text = (
        f"{{coordinates: {{r: {{assume: positive}}, psi: {{}}}}, parameters: "
        f"{{{m}: {{assume: positive}}, {M}: {{assume: positive}}}}, "
        f"T: ({M} + {m})*r'^2/2 + {n**2}*{m}*r^2*psi'^2/2, V: r*({M} - {m}*cos({n}*psi))}}"
    )
    [case] = derive(text).special_cases
    relation = case.parameter - case.value
    named = {s.name: s for s in relation.free_symbols}
    assert case.number == 2
    assert relation.subs(named[M], 3 * named[m]).expand() == 0


@pytest.mark.long
@pytest.mark.parametrize(("U", "n", "found"), [
    ("-1/r", "1/2", {"1": 3}), ("-1/r", "3/2", {"1/3": 3}), ("-1/r", "2", {"1/4": 3}),
    ("w^2*r^2", "1", {"1": 7, "1/2": 6}), ("w^2*r^2", "1/3", {"3": 7, "3/2": 6}),
])  # fmt: skip
def test_waves_of_half_the_angle_are_special(U, n, found):
    """2/cos^2 + 3/sin^2 of n k phi: Smorodinsky and Winternitz at k n = 1/2 (parabolic) and 1.

    Beside Kepler's force there is an integral at 1/2, with the energy and that of the angle; the
    oscillator has three more with its conformal ones, at 1/2 two with the time, at 1 three.
    """
    V = f"{U} + (2/cos({n}*k*phi)^2 + 3/sin({n}*k*phi)^2)/r^2"
    text = problem(f"(r'^2 + r^2*phi'^2)/2 - ({V})", f"{{r: {POS}, phi: {{}}}}", "k w")
    cases = derive(text).special_cases
    assert {str(c.value): c.number for c in cases if not c.given} == found


@pytest.mark.parametrize("n", [6, 7, 20])
def test_an_angle_many_times_leaves_the_energy(n):
    text = problem(
        f"(r'^2 + r^2*phi'^2)/2 + 1/r - 1/(r*cos({n}*phi))^2", f"{{r: {POS}, phi: {{}}}}"
    )
    assert [c.name for c in derive(text).discovery.charges] == ["energy", "L_z_squared"]


@pytest.mark.parametrize("n", [2, 3])
def test_a_saddle_on_a_cone_is_special_where_the_cone_is_a_plane(n):
    """V = k (x² - y²) of a plane with phi = n psi: energies of x and y, and four waves, 6."""
    text = problem(
        f"(r'^2 + (a*{n})^2*r^2*psi'^2)/2 - k*r^2*cos({2 * n}*psi)",
        f"{{r: {POS}, psi: {{}}}}",
        "a k",
    )
    found = {str(c.value): c.number for c in derive(text).special_cases}
    assert found["1"] == 6


@pytest.mark.long
def test_a_flat_cone_whose_cartesian_coordinates_are_not_found_is_said_to_be_one():
    found = derive("""
coordinates: [x, y, z]
parameters: {c: {assume: positive}}
T: (x'^2 + y'^2 + z'^2)/2
V: -1/sqrt(x^2 + y^2 + z^2)
constraints: {cone: z = c*sqrt(x^2 + y^2)}
""").discovery
    assert {charge.name for charge in found.charges} == {"energy", "L_z"}
    assert found.unconstrained is not None
    assert "the kinetic energy is flat, but no Cartesian coordinates were found" in found.ansatz


@pytest.mark.long
@pytest.mark.parametrize(("V", "linear"), [("cosh", 4), ("sinh", 4), ("0*cosh", 5)])
def test_a_potential_in_hyperbolic_functions_is_seen_in_exponential_coordinates(V, linear):
    """Basilakos and Lukes-Gerakopoulos, Phys. Rev. D 78 (2008) 083509: V0 x^2, nothing by y."""
    text = (
        "coordinates: {a: {assume: positive}, f: {}}\nparameters: {V0: {assume: positive}}\n"
        f"L: -3*a*a'^2 + a^3*(f'^2/2 - V0*{V}(sqrt(6)*f/4)^2)\n"
    )
    derivation = derive(text)
    v = derivation.system.qdot
    assert sum(c.charge.diff(*v[:1], 2) == 0 for c in derivation.discovery.charges) >= linear
    assert summary(derivation.discovery).independent == 4
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("waves", "number", "independent"),
    [
        ("cos(u)^2*x'^2 + cosh(u)^2*y'^2", 9, 8),  # of vacuum: Rosen's coordinates
        ("cos(u)^2*x'^2 + y'^2", 9, 8),
        ("exp(u)*x'^2 + cos(u)^2*y'^2", 9, 8),
    ],
)
def test_a_plane_wave_has_six_isometries(waves, number, independent):
    """Bondi, Pirani, Robinson, Proc. R. Soc. A 251 (1959) 519; with E, u in the time, a dilation."""
    derivation = derive(f"{{coordinates: [u, v, x, y], L: u'*v' + ({waves})/2}}")
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.point_charges), found.independent) >= (number, independent)
    assert min(digits_of(derivation).values()) > 20
