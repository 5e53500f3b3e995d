"""What is concluded of a system does not depend on its coordinates, origin and letters.

The numbers of symmetries: a linear equation of one coordinate has five, however it is driven or
damped (Lutzky, J. Phys. A 11 (1978) 249; Caldirola, Nuovo Cim. 18 (1941) 393 for drag), a
charge in crossed fields has the eight of the oscillator in a frame that drifts with E x B
(Jackson, *Classical Electrodynamics*, 3rd ed., section 12.3).  Hyperbolic space: Ratcliffe,
*Foundations of Hyperbolic Manifolds*, 2nd ed., chapter 4.  Kepler: Goldstein, Poole, Safko,
3rd ed., section 3.9; two bodies: Landau and Lifshitz, *Mechanics*, section 13.
"""

import re
from random import Random

import pytest
import sympy

from lagcli.algebra import is_zero
from lagcli.mechanics.discovery.summary import summary
from lagcli.reader import read_problem
from tests.oracle.constancy import digits_of
from tests.solved import solve

from .derived import derive
from .test_discovery_literature import problem

POS = "{assume: positive}"
TURNING = "(x^2 - y^2)*cos(2*W*t) + 2*x*y*sin(2*W*t)"


def one_coordinate(L, force="", letter="x", positive="m k c g b Omega"):
    parameters = "".join(f"  {p}: {POS}\n" for p in positive.split())
    forces = f"forces: {{x: {force}}}\n" if force else ""
    return (f"parameters:\n{parameters}  F: {{}}\n"
            + re.sub(r"\bx\b", letter, f"coordinates: [x]\nL: {L}\n{forces}"))  # fmt: skip


LINEAR = {
    "drag": ("m*x'^2/2", "-c*x'"),
    "falling with drag": ("m*x'^2/2 - m*g*x", "-c*x'"),
    "driven": ("m*x'^2/2 - k*x^2/2 + F*x*cos(Omega*t)", ""),
    "driven by a sum": ("m*x'^2/2 - k*x^2/2 + F*x*(sin(Omega*t) - g)", ""),
    "driven and dying out": ("m*x'^2/2 - k*x^2/2 + F*x*exp(-b*t)", ""),
    "driven by what fades": ("m*x'^2/2 - k*x^2/2 + F*x*exp(-b*t)*cos(Omega*t)", ""),
    "driven without a spring": ("m*x'^2/2 + F*x*sin(Omega*t)", ""),
    "repelled and driven": ("m*x'^2/2 + k*x^2/2 + F*x*cos(Omega*t)", ""),
    "growing mass": ("m*exp(c*t)*x'^2/2", ""),
    "growing mass that falls": ("exp(c*t)*(m*x'^2/2 - m*g*x)", ""),
    "overdamped": ("exp(5*t)*(m*x'^2/2 - 3*m*x^2)", ""),
}


@pytest.mark.long
@pytest.mark.parametrize("letter", ["x", "s"])
@pytest.mark.parametrize("name", LINEAR)
def test_a_linear_equation_of_one_coordinate_has_five(name, letter):
    L, force = LINEAR[name]
    found = derive(one_coordinate(L, force, letter)).discovery
    assert len(found.charges) == 5, [c.name for c in found.charges]
    assert found.stopped == []


@pytest.mark.long
@pytest.mark.parametrize("name", LINEAR)
def test_with_constants_of_either_sign_their_charges_stay_on_an_independent_motion(name):
    L, force = LINEAR[name]
    kept = digits_of(derive(one_coordinate(L, force).replace(POS, "{}")))
    assert len(kept) == 5
    assert {n: digits for n, digits in kept.items() if digits < 20} == {}


# x as a function of u, of which T = m x'^2/2, V and the dissipation c x'^2/2 are made
LENGTHS = {"sine": "2*sin(u/2)", "cycloid": "4*b*cos(u/2)", "growth": "exp(u)", "cube": "u^3 + u"}


@pytest.mark.parametrize("V", ["k*(X)^2/2", "m*g*(X)"])
@pytest.mark.parametrize("name", LENGTHS)
def test_an_arc_length_under_drag_has_five(name, V):
    X = LENGTHS[name]
    rate = re.sub(r"\*\*", "^", str(sympy.sympify(X.replace("^", "**")).diff("u")))
    square = f"(({rate})*u')^2/2"
    head = "".join(f"  {p}: {POS}\n" for p in "mkcgb")
    text = f"parameters:\n{head}coordinates: {{u: {POS}}}\nT: m*{square}\nV: {V.replace('X', X)}\n"
    derivation = derive(f"{text}dissipation: c*{square}\n")
    assert len(derivation.discovery.charges) == 5
    assert derivation.discovery.stopped == []
    kept = digits_of(derivation)
    assert len(kept) == 5
    assert min(kept.values()) > 20


@pytest.mark.parametrize("stiffness", ["g/(4*b)", "k - g - b"])
def test_what_is_real_for_few_parameters_is_tried_there(stiffness):
    L = f"exp(2*c*t/m)*(m*x'^2/2 - m*({stiffness})*x^2/2)"
    answers = solve(
        derive(one_coordinate(L, positive="m g b c k")).problem, ["discovered", "algebra"]
    )
    charges = answers.sections["discovered"].charges
    assert len(charges) == 5
    assert all(c.conserved and c.verified == "exact" for c in charges)
    assert answers.sections["algebra"].dimension == 5
    assert answers.warnings == ()


@pytest.mark.long
@pytest.mark.parametrize("L", ["(m + b - c*t)*x'^2/2", "(m - c*t)*(x'^2/2 - g*x)"])
def test_a_mass_that_is_lost_leaves_five(L):
    """Free motion has x = log(m - c t), of the mass that is left."""
    derivation = derive(one_coordinate(L))
    assert len(derivation.discovery.charges) == 5
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("L", [
    "m*(x'^2 + y'^2)/2 + q*B*(x*y' - y*x')/2 + q*E*x",
    "m*(x'^2 + y'^2)/2 + q*B*x*y' + q*E*y",
    "m*(x'^2 + y'^2)/2 - q*B*y*x' + q*E*(x + 2*y)",
])  # fmt: skip
def test_crossed_fields_have_the_eight_of_the_drifting_frame(L):
    derivation = derive(f"{{parameters: {{m: {POS}, q: {{}}, B: {{}}, E: {{}}}}, "
                        f"coordinates: [x, y], L: {L}}}")  # fmt: skip
    found = summary(derivation.discovery)
    assert (found.dimension, found.integrable) == (8, True)
    assert found.name.startswith("Schrödinger sch(2)")


@pytest.mark.long
@pytest.mark.parametrize(
    ("coordinates", "L"),
    [
        (f"{{x: {{}}, y: {{}}, z: {POS}}}", "m*(x'^2 + y'^2 + z'^2)/(2*z^2)"),
        (f"{{u: {{}}, v: {{}}, h: {POS}}}", "m*(u'^2 + 9*v'^2 + a^2*h'^2)/(2*h^2)"),
        ("[x, y, z]", "m*(exp(2*z/a)*(x'^2 + y'^2) + z'^2)/2"),
        ("[s, x, y]", "m*(exp(-s)*(x'^2 + a*y'^2) + s'^2)/2"),
    ],
)
def test_hyperbolic_space_has_its_name_in_other_coordinates(coordinates, L):
    found = summary(derive(f"{{parameters: {{m: {POS}, a: {POS}}}, "
                           f"coordinates: {coordinates}, L: {L}}}").discovery)  # fmt: skip
    assert (found.dimension, found.name) == (7, "so(3,1) + R")
    assert (found.independent, found.integrable) == (5, True)


@pytest.mark.long
@pytest.mark.parametrize(
    ("L", "names"),
    [
        ("m*z^2*(x'^2 + y'^2)/2 + m*z'^2/2", "energy p_x p_y L_z dilation conformal"),
        ("m*z^2*(x'^2 + y'^2)/2 + m*z'^2/2 - k/z^2", "energy p_x p_y L_z dilation conformal"),
        ("m*z^4*(x'^2 + y'^2)/2 + m*z'^2/2", "energy p_x p_y L_z dilation"),
        ("m*(1 + z^2)*(x'^2 + y'^2)/2 + m*z'^2/2 - k*z^4", "energy p_x p_y L_z"),
    ],
)
def test_two_cyclic_coordinates_of_one_inertia_are_lengths(L, names):
    text = f"{{parameters: {{m: {POS}, k: {POS}}}, coordinates: {{x: {{}}, y: {{}}, z: {POS}}}, "
    found = derive(f"{text}L: {L}}}").discovery
    assert {c.name for c in found.point_charges} == set(names.split())


@pytest.mark.long
@pytest.mark.parametrize(
    ("x", "y", "z"), [("x - a", "y", ""), ("x - a", "y + b", ""), ("x + 2", "y - a*b", ""),
                      ("x - a", "y", "z + b"), ("x", "y + a", "z - b"), ("x - a", "y - b", "z - 1")]
)  # fmt: skip
def test_kepler_about_any_point_is_keplers(x, y, z):
    places = [p for p in (x, y, z) if p]
    q = "xyz"[: len(places)]
    squares = " + ".join(f"({p})^2" for p in places)
    kinetic = " + ".join(f"{c}'^2" for c in q)
    found = derive(
        f"{{parameters: {{m: {POS}, k: {POS}, a: {{}}, b: {{}}}}, "
        f"coordinates: [{', '.join(q)}], L: m*({kinetic})/2 + k/sqrt({squares})}}"
    )
    turns = {"L_z"} if len(q) == 2 else {"L_x", "L_y", "L_z"}
    names = {"energy", *turns, *(f"runge_lenz_{c}" for c in q)}
    assert {c.name for c in found.discovery.charges} == names
    told = summary(found.discovery)
    assert told.name.startswith("the energy and so(3)" if len(q) == 2 else "the energy and so(4)")
    assert told.integrable is True
    for c in found.discovery.charges:
        if c.name in turns:  # L = r x p, in this order
            one, other = {"L_x": "yz", "L_y": "zx", "L_z": "xy"}[c.name]
            position = {s.name: s for s in found.system.q}
            rate = dict(zip(position, found.system.qdot, strict=True))
            slope = c.charge.diff(rate[other], position[one])
            assert slope.is_positive, c.charge


@pytest.mark.long
@pytest.mark.parametrize("V", ["k*R^3", "-k/R", "-k*exp(-R)"])
def test_two_bodies_in_space_are_integrable(V):
    """E, P, L_rel^2 and L_rel,z: six in involution."""
    R = "sqrt((x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2)"
    found = summary(
        derive(f"""
parameters: {{m1: {POS}, m2: {POS}, k: {POS}}}
coordinates: [x1, y1, z1, x2, y2, z2]
T: m1*(x1'^2 + y1'^2 + z1'^2)/2 + m2*(x2'^2 + y2'^2 + z2'^2)/2
V: {V.replace("R", R).replace("kexp", "k*exp")}
""").discovery
    )
    assert (found.in_involution, found.integrable) == (6, True)
    if V == "k*R^3":
        assert found.name == "Galilei in 3 dimensions + so(3), modulo constants"
        assert found.dimension == 13


@pytest.mark.long
@pytest.mark.parametrize(
    ("parameters", "coordinates", "L", "values"),
    [
        # in the arc length the power 2; Ermakov; space and time without curvature
        ("{a: POS, b: {}}", "[x]", "exp(2*a*x)*x'^2/2 - exp(b*x)", "b=2*a b=a b=-2*a"),
        ("{n: {}}", f"{{x: {POS}}}", "(1 + x)^2*x'^2/2 - (1 + x)^n", "n=4 n=2 n=-4"),
        ("{a: POS, n: {}}", f"{{x: {POS}}}", "x'^2/2 - a*x^2/2 - x^n", "n=-2 n=1 n=2"),
        ("{m: POS, g: POS, h: {}}", "[x]", "-m*sqrt(1 + 2*g*x + h*x^2 - x'^2)", "h=g**2"),
        # damped with x^3, x^2 and x^5: Leach, J. Math. Phys. 26 (1985) 2510
        ("{c: POS, a: POS}", "[x]", "exp(c*t)*(x'^2/2 - a*x^2/2 - x^4/4)", "a=2*c**2/9"),
        ("{c: POS, a: POS}", "[s]", "exp(-2*c*t)*(s'^2/2 - a*s^2/2 + s^3)", "a=24*c**2/25"),
        ("{c: POS, a: POS}", "[x]", "exp(c*t)*(x'^2/2 - a*x^2/2 - x^6)", "a=3*c**2/16"),
        # about its other position of rest -a
        ("{c: POS, a: {}}", "[x]", "exp(c*t)*(x'^2/2 - a*x^2/2 + x^3/3)",
         "a=6*c**2/25 a=-6*c**2/25"),
        # without a drive, or with one that stays: Mathieu, and a saddle that turns
        ("{a: {}, q: {}}", "[x]", "x'^2/2 - (a - 2*q*cos(2*t))*x^2/2", "q=0"),
        ("{k: {}, n: {}}", "[x, y]",
         "(x'^2 + y'^2)/2 + k*((x^2 - y^2)*cos(2*n*t)/2 + x*y*sin(2*n*t))", "k=0 n=0"),
        # another time: tau' = 1/f, or -1/tau with x = tau y (Emden and Fowler; Kepler at s = -1)
        ("{s: {}}", "[x]", "t^2*x'^2/2 - t^s*x^4/4", "s=-2 s=1 s=4"),
        ("{k: POS, s: {}}", "[x, y]", "t^2*(x'^2 + y'^2)/2 + k*t^s/sqrt(x^2 + y^2)", "s=-2 s=-1"),
        ("{c: POS, d: {}}", "[x]", "exp(c*t)*x'^2/2 - exp(d*t)*x^4/4", "d=-c d=5*c d=2*c"),
        # in the arc length x^(n + 1) the power 2 or -2; damped, with any power
        ("{n: POS, m: {}}", f"{{x: {POS}}}", "x^(2*n)*x'^2/2 - x^m", "m=2*n+2 m=-2*n-2 m=n+1"),
        ("{c: POS, a: POS, n: POS}", f"{{x: {POS}}}", "exp(c*t)*(x'^2 - a*x^2)/2 - exp(c*t)*x^n",
         "a=2*c**2*n/(n+2)**2"),
        # Larmor's frame turns it into Kepler's problem; a quadratic integral beside a quartic one
        ("{k: POS, B: POS, w: {}}", "[x, y]",
         "(x'^2 + y'^2)/2 + B*(x*y' - y*x')/2 + k/sqrt(x^2 + y^2) - w*(x^2 + y^2)/2", "w=-B**2/4"),
        ("{A: POS, c: {}}", f"{{x: {POS}, y: {{}}}}",
         "(x'^2 + y'^2)/2 - A*(x^2 + y^2)/2 - x^2*y - y^3/3 - c/x^2", "c=0"),
        # of the inertia: Bianchi's groups, a plane in place of a sphere, squares of sines
        ("{a: POS, b: {}}", "[x, y, z]", "(exp(2*a*z)*x'^2 + exp(2*b*z)*y'^2 + z'^2)/2", "b=a b=0"),
        ("{w: POS, l: {}}", "[x, y]",
         "(x'^2 + y'^2 + l*(x*y' - y*x')^2 - w^2*(x^2 + y^2))/(2*(1 + l*(x^2 + y^2)))", "l=0"),
        ("{a: POS, b: {}}", "[x, y]", "(a + b*cos(2*x))*(x'^2 + y'^2)/sin(2*x)^2", "b=a b=-a b=0"),
        # a fibre of AdS3, and a flat plane in null coordinates a^2, a R^(n - 1)
        ("{a: {assume: nonzero}}", f"{{x: {{}}, y: {POS}, z: {{}}}}",
         "(x'^2 + y'^2)/(2*y^2) + a*(z' + x'/y)^2/2", "a=-1"),
        ("{n: {}}", f"{{a: {POS}, R: {POS}}}",
         "6*n*R^(n-2)*(a*R*a'^2 + (n-1)*a^2*a'*R') + (n-1)*a^3*R^n", "n=3/2 n=7/8 n=1/3 n=4/3"),
        # a power is linear at n = 2, constant at n = 1; -2: Jackiw, Physics Today 25 (1972) 23
        ("{m: POS, k: POS, n: {}}", f"{{x: {POS}}}", "m*x'^2/2 - k*x^n", "n=0 n=1 n=2 n=-2"),
        ("{m: POS, k: POS, j: {}}", f"{{s: {POS}}}", "m*s'^2/2 - k*s^(2*j)", "j=0 j=1/2 j=1 j=-1"),
        # frequencies w and sqrt(w^2 + 2 c) in the ratio 1, 2 and 1/2: Jauch and Hill (1940)
        ("{w: POS, c: {}}", "[x, y]", "(x'^2 + y'^2)/2 - w^2*(x^2 + y^2)/2 - c*(x - y)^2/2",
         "c=0 c=3*w**2/2 c=-3*w**2/8"),
        ("{w: POS, c: {}}", "[x, y]", "(x'^2 + y'^2)/2 - w^2*(x^2 + y^2)/2 - c*x*y",
         "c=0 c=3*w**2/5"),
    ],
)  # fmt: skip
def test_special_values_are_those_of_the_family(parameters, coordinates, L, values):
    text = f"{{parameters: {parameters}, coordinates: {coordinates}, L: {L}}}"
    cases = derive(text.replace("POS", POS)).special_cases
    found = {(str(c.parameter), sympy.simplify(c.value)) for c in cases}
    named = (each.split("=") for each in values.split())
    locals_ = {str(s): s for c in cases for s in (c.parameter, *c.value.free_symbols)}
    assert {(p, sympy.simplify(sympy.sympify(v, locals_))) for p, v in named} <= found


def test_without_a_term_the_exponent_has_values_of_its_own():
    """A uniform force has the Schroedinger algebra, which d/x^2 beside it does not leave."""
    x = f"{{x: {POS}}}"
    text = f"{{parameters: [k, d, n], coordinates: {x}, L: x'^2/2 - k*x^n - d/x^2}}"
    cases = derive(text).special_cases
    numbers = {str(sorted(map(str, [(c.parameter, c.value), *c.given]))): c.number for c in cases}
    assert numbers["['(d, 0)', '(n, 1)']"] == 5
    assert numbers["['(d, -k)', '(n, -2)']"] == 5  # free
    assert "['(n, 1)']" not in numbers


@pytest.mark.long
def test_two_terms_of_V_are_missing_together():
    """T is flat in parabolic coordinates, and free where both terms of V are missing."""
    V, T = "(a*u^6 + b*cos(v))/(u^2 + v^2)", "(u^2 + v^2)*(u'^2 + v'^2)/2"
    cases = derive(f"{{coordinates: [u, v], parameters: [a, b], T: {T}, V: {V}}}").special_cases
    assert [c.number for c in cases if len(c.given) == 1 and c.value == 0] == [8]


@pytest.mark.long
@pytest.mark.parametrize("force", ["", "forces: {y: -2}"])
def test_growths_are_commensurate_as_frequencies_are(force):
    """x = exp(-a t) and y = exp(-b t), where one is the other, its inverse or its square."""
    D = "(a*x'^2 + b*y'^2)/2"
    text = f"{{coordinates: [x, y], parameters: [a, b], T: (x'^2 + y'^2)/2, dissipation: {D}"
    found = derive(f"{text}, {force}}}")
    cases = {str(c.value): c for c in found.special_cases if not c.given}
    assert {value: c.number for value, c in cases.items()} == {"-a": 6, "a/2": 6, "a": 8, "2*a": 6}
    t, *moving = found.system.t, *found.system.q, *found.system.qdot
    for case in cases.values():
        [a] = case.value.free_symbols
        x, y = 2 + 3 * sympy.exp(-a * t), 5 - 7 * sympy.exp(-case.value * t)
        y -= 2 * t / case.value if force else 0
        motion = dict(zip(moving, (x, y, x.diff(t), y.diff(t)), strict=True))
        for charge in case.charges:
            assert sympy.simplify(charge.charge.subs(motion).diff(t)) == 0


@pytest.mark.parametrize("seed", range(4))
def test_a_saddle_that_turns_has_four_linear_ones_in_its_axes(seed):
    """Thompson, Harmon, Ball, Can. J. Phys. 80 (2002) 1433; also with a field and a bowl."""
    source = Random(seed)
    angle = source.choice(["2*W*t", "-W*t", "W*t + pi/3"])
    field = source.choice(["", " + B*(x*y' - y*x')/2"])
    bowl = source.choice(["", " - g*(x^2 + y^2)/2"])
    saddle = f"k*((x^2 - y^2)*cos({angle}) + 2*x*y*sin({angle}))/2"
    derivation = derive(
        problem(f"m*(x'^2 + y'^2)/2 - {saddle}{field}{bowl}", parameters="m k W B g")
    )
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (5, 4, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("L", "forces"),
    [
        # a turning saddle with a drag, one in the field of a magnet; a drag that dies out
        (f"(x'^2 + y'^2)/2 - k*({TURNING})/2", "{x: -c*x', y: -c*y'}"),
        (f"(x'^2 + y'^2)/2 - k*({TURNING})/2", "{x: c*y', y: -c*x'}"),
        ("(x'^2 + y'^2)/2 - k*y^2/2", "{x: -x'/t, y: -c*y'}"),
        # circulatory: Merkin, *Introduction to the Theory of Stability*, chapter 6
        ("(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2", "{x: -b*y, y: b*x}"),
        ("(x'^2 + y'^2)/2", "{x: -b*y - c*x', y: b*x - c*y'}"),
    ],
)
def test_linear_forces_have_four_linear_integrals(L, forces):
    """Their factors solve the adjoint equation, which is another one where forces do work."""
    text = f"parameters: {{k: {POS}, c: {POS}, W: {POS}, b: }}\ncoordinates: [x, y]\n"
    derivation = derive(f"{text}L: {L}\nforces: {forces}\n")
    assert summary(derivation.discovery).independent == 4
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
def test_frequencies_are_compared_under_one_damping():
    text = "{coordinates: [x, y], parameters: [a, b, c], T: (x'^2 + y'^2)/2, "
    found = derive(f"{text}V: (a*x^2 + b*y^2)/2, dissipation: c*(x'^2 + y'^2)/2}}")
    assert {str(c.value): c.number for c in found.special_cases}["a"] == 8


@pytest.mark.parametrize(
    ("term", "free"),
    [
        ("a*(x^2*y + 2*y^3)", "x y"),  # Henon and Heiles' oscillators apart
        ("a/x^2 + 3/y^2", "x"),
        ("a/x^2 + 2*y/5", "x"),
        ("a*(x^2 + y^2)^2", "x y"),
        ("a*exp(-x)", "x"),
    ],
)
def test_without_a_term_what_is_linear_has_the_phases_of_an_oscillator(term, free):
    """The time is in the new charges as the linear part has it: powers of t do not show them."""
    V = f"w^2*(x^2 + 3*y^2)/2 + {term}"
    head = f"parameters: {{w: {POS}, a: {{}}}}\ncoordinates: [x, y]\nT: (x'^2 + y'^2)/2\n"
    [case] = [c for c in derive(f"{head}V: {V}\n").special_cases if c.value == 0]
    new = {charge.name for charge in case.charges}
    wanted = {f"translation_{x}_{part}" for x in free.split() for part in ("cos", "sin")}
    assert wanted <= new
    assert wanted & {c.name for c in derive(f"{head}V: {V}\n").discovery.charges} == set()


@pytest.mark.parametrize(("field", "E"), [("B", "E"), ("2*B", "E/3"), ("B^2", "E")])
def test_a_value_by_which_charges_are_divided_is_special_too(field, E):
    """The drift E/B has no value without a field: falling then, with the projectile's charges."""
    head = f"parameters: {{m: {POS}, B: {{}}, E: {POS}}}\ncoordinates: [x, y]\n"
    text = f"{head}L: m*(x'^2 + y'^2)/2 - ({field})*y*x' + ({E})*y\n"
    [case] = [c for c in derive(text).special_cases if str(c.parameter) == "B"]
    falling = derive(f"{head}L: m*(x'^2 + y'^2)/2 + ({E})*y\n")
    assert case.value == 0
    assert case.number == len(falling.discovery.charges)
    assert {"boost_x", "conformal", "dilation"} <= {c.name for c in case.charges}


CHANGING = {
    "m*t^2*x'^2/2": "a growing mass",
    "t^2*(x'^2 - k*x^2)/2": "Lane and Emden, index 1",
    "t^2*(x'^2/2 - k*x)": "Lane and Emden, index 0",
    "m*(x'^2/2 - 3*x^2/(32*t^2))": "Euler",
    "t^4*x'^2/2 - 35*t^2*x^2/32": "Euler, with a growing mass",
    "m*(x'^2/2 + 5*x^2/(2*(2*t + 3)^2))": "Euler, irrational powers",
    "t^3*(m*x'^2/2 - k*x^2/(2*t^2))": "Euler, any strength",
    "m*x'^2/2 - k*x^2/(2*t^4)": "inverted time",
    "t*(m*x'^2/2 - k*x^2/(2*t^4) + m*x^2/(8*t^2))": "the same, with a growing mass",
    "t^4*(m*x'^2 - k*x^2)/2": "spherical Bessel functions of order 1",
    "m*x'^2/2 - k*x^2/2 + 3*m*x^2/t^2": "of order 2",
    "cos(b*t)^2*(m*x'^2 - k*x^2)/2": "a mass that pulsates",
}


@pytest.mark.parametrize("L", CHANGING)
def test_linear_equations_whose_coefficients_change_have_five(L):
    """Kamke, *Differentialgleichungen*, vol. I, part A, section 25.1."""
    found = derive(one_coordinate(L)).discovery
    assert len(found.charges) == 5, CHANGING[L]
    assert found.stopped == []
    assert summary(derive(one_coordinate(L)).discovery).name.startswith("Schrödinger sch(1)")


@pytest.mark.parametrize("r", ["t", "-t/2 + 1", "t^2 - 3", "2*t^2 + t", "-3*t"])
def test_one_solution_of_a_linear_equation_gives_two_charges(r):
    """u = exp of the integral of r solves x'' = (r' + r^2) x: u x' - u' x, and its square."""
    own = sympy.sympify(r.replace("^", "**"))
    stiffness = str(sympy.expand(own.diff("t") + own**2)).replace("**", "^")
    made = derive(f"coordinates: [x]\nL: (x'^2 + ({stiffness})*x^2)/2\n")
    kept = digits_of(made)
    assert len(kept) == 2
    assert min(kept.values()) > 20
    assert made.discovery.stopped != []  # the other solution is not elementary


@pytest.mark.long
def test_kepler_with_a_mass_that_changes_linearly_has_the_vector_of_runge_and_lenz():
    """Mestschersky, Astr. Nachr. 132 (1893) 129: with b = a^2 the root is that of a square."""
    V = "-k/(sqrt(1 + 2*a*t + b*t^2)*sqrt(x^2 + y^2))"
    text = f"{{coordinates: [x, y], parameters: [k, a, b], L: (x'^2 + y'^2)/2 - ({V})}}"
    [case] = (c for c in derive(text).special_cases if not c.given and c.value != 0)
    assert (str(case.parameter), str(case.value), case.number) == ("b", "a**2", 4)


@pytest.mark.long
@pytest.mark.parametrize("sign", ["-", "+"])
@pytest.mark.parametrize("changing", ["/t^4", "/t^2", "/(t + 1)^4", "/(1 + b*t)^2"])
def test_the_square_of_a_strength_of_either_sign_serves_as_a_positive_one(sign, changing):
    """k and -k are the same file: sin(k/t) needs no |k|."""
    made = derive(f"coordinates: [x]\nparameters: [k, b]\nL: x'^2/2 {sign} k^2*x^2{changing}/2\n")
    assert made.discovery.stopped == []
    kept = digits_of(made)
    assert len(kept) == 5
    assert min(kept.values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("B", ["b/t", "b/(2*c + t)"])
@pytest.mark.parametrize("V", ["0", "k*(x^2 + y^2)/(2*t^2)"])
def test_a_field_that_falls_as_the_time_leaves_eight(B, V):
    """In log(t) the coefficients are constant; Lewis and Riesenfeld, J. Math. Phys. 10 (1969) 1458."""
    if V != "0" and "c" in B:
        V = V.replace("t^2", "(2*c + t)^2")
    given = ", ".join(f"{p}: {POS}" for p in "mbkc")
    derivation = derive(f"{{coordinates: [x, y], parameters: {{{given}}}, "
                        f'L: "m*(x\'^2 + y\'^2)/2 + {B}*(x*y\' - y*x\')/2 - {V}"}}')  # fmt: skip
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("B", "V"),
    [
        ("b/t^2", "0"), ("b/(c + t)^2", "0"),
        ("b/(1 + t^2)", "0"), ("b/(1 + t^2)", "k*(x^2 + y^2)/(2*(1 + t^2)^2)"),
        ("b/(1 + t)", "k*(x^2 + y^2)/(2*(1 + t)^4) - b^2*(x^2 + y^2)/(8*m*(1 + t)^2)"),
    ],
)  # fmt: skip
def test_axes_that_turn_with_half_of_a_changing_field_leave_eight(B, V):
    """Larmor's theorem; Lewis and Riesenfeld, J. Math. Phys. 10 (1969) 1458."""
    L = f"m*(x'^2 + y'^2)/2 + {B}*(x*y' - y*x')/2 - ({V})"
    derivation = derive(problem(L, parameters="m b k c"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (8, 4, True)
    assert derivation.discovery.stopped == []
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("L", [
    "(1 + t^2)*(x'^2/2 - m*x)", "(1 + t^2)*x'^2/2 - m*x", "(k + c*t^2)*x'^2/2", "t^2*x'^2/2 - m*x"
])  # fmt: skip
def test_an_inverse_tangent_solves_a_mass_that_grows_as_the_square_of_time(L):
    """Five as of any linear equation; the forced motion by variation of constants."""
    derivation = derive(one_coordinate(L))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent) == (5, 2)
    assert derivation.discovery.stopped == []
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("V", ["0", "k*(x^2 + y^2 + z^2)/2"])
def test_space_in_a_turning_frame_keeps_its_twelve(V):
    """Niederer, Helv. Phys. Acta 45 (1972) 802; 46 (1973) 191: sch(3) of both."""
    L = f"((x' - c*y)^2 + (y' + c*x)^2 + z'^2)/2 - {V}"
    derivation = derive(problem(L, "[x, y, z]", "k c"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (12, 6, True)
    assert found.name.startswith("Schrödinger sch(3)")
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    "V", ["k*x*y", "k*(y^2 - x^2)/2", "(c*y^2 - k*x^2)/2", "k*(x^2 - y^2 + 2*x*y)"]
)
def test_a_saddle_in_a_field_has_an_exponent_and_a_frequency_of_nested_roots(V):
    """lambda^4 + b lambda^2 - c^2 = 0 (Thomson and Tait, *Natural Philosophy*, section 345)."""
    L = f"(x'^2 + y'^2)/2 + B*(x*y' - y*x')/2 - ({V})"
    derivation = derive(problem(L, parameters="k c|B"))
    found = summary(derivation.discovery)
    assert (found.dimension, found.independent, found.integrable) == (5, 4, True)
    assert derivation.discovery.stopped == []
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("L", ["x'^2 - t*x^2", "x'^2 - cosh(t)*x^2", "t*x'^2 - (t - 1/t)*x^2"])
def test_symmetries_that_no_formula_is_known_for_are_said_not_to_have_been_sought(L):
    """Airy's, Mathieu's and Bessel's equations have five as any linear equation."""
    found = derive(one_coordinate(L)).discovery
    assert len(found.charges) < 5
    assert any("no elementary formula was found" in reason for reason in found.stopped)


@pytest.mark.long
def test_an_oscillator_driven_at_resonance_is_searched_without_a_function_twice():
    """sin(2 w t) and sin(w t) cos(w t) are one: apart, they made a symmetry that is 0."""
    derivation = derive(one_coordinate("x'^2/2 - 2*x^2 + m*x*cos(2*t)"))
    moves = [c.transformation for c in derivation.discovery.point_charges]
    assert moves
    assert all(any(move.changes) or move.time != 0 for move in moves)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
def test_lane_and_emden_have_special_indices():
    """Chandrasekhar, *Stellar Structure*, chapter IV: 0, 1 and 5 in closed form."""
    text = (f"{{parameters: {{n: {{}}}}, coordinates: {{x: {POS}}}, "
            "L: t^2*(x'^2/2 - x^(n + 1)/(n + 1))}")  # fmt: skip
    cases = {str(c.value): c.number for c in derive(text).special_cases}
    assert cases == {"0": 5, "1": 5, "5": 1}


@pytest.mark.long
@pytest.mark.parametrize("Q", ["1 + t^2", "2 + 2*t + t^2", "1 + 3*t^2"])
@pytest.mark.parametrize(("more", "number"), [("", 5), (" - k/(2*x^2)", 3)])
def test_an_oscillator_that_fades_as_a_square_of_second_degree(Q, more, number):
    """Lewis and Leach, J. Math. Phys. 23 (1982) 165: rho^2 = Q."""
    given = f"coordinates: {{x: {{assume: positive}}}}, parameters: {{k: {POS}}}"
    found = derive(f'{{{given}, L: "x\'^2/2 - x^2/({Q})^2{more}"}}').discovery
    assert len(found.charges) == number


@pytest.mark.parametrize(("force", "number"), [("", 5), (" + m*g*x", 5), (" - k*x^2/2", 1)])
def test_drag_with_the_square_of_the_velocity(force, number):
    """m exp(2 c x/m) x'^2/2 is a Lagrangian: with u = exp(c x/m), u'' = c g u/m, or 0 without g."""
    given = "coordinates: [x], parameters: {m: %s, c: %s, g: %s, k: %s}" % ((POS,) * 4)
    made = derive(f'{{{given}, L: "m*x\'^2/2{force}", forces: {{x: "-c*x\'^2"}}}}')
    kept = digits_of(made)
    assert len(kept) == number
    assert min(kept.values()) > 20


@pytest.mark.parametrize(
    ("V", "c", "name"),
    [("x^2 + x^4/4", "3", "conformal_exp"), ("3*x^2 + x^3/3", "5", "conformal_exp"),
     ("3*x^2 - x^3", "-5", "conformal_exp"), ("x^2 + x^4/4", "4", None)],
)  # fmt: skip
def test_damping_at_which_an_anharmonic_oscillator_is_integrable(V, c, name):
    """9 b = 2 c^2 with x^3, 25 b = 6 c^2 with x^2: Leach, J. Math. Phys. 26 (1985) 2510."""
    derivation = derive(f'{{coordinates: [x], L: "exp({c}*t)*(x\'^2/2 - ({V}))"}}')
    assert [c.name for c in derivation.discovery.charges] == ([name] if name else [])
    assert min(digits_of(derivation).values(), default=30) > 20


@pytest.mark.parametrize("k", ["k", "2"])
def test_a_point_transformation_hides_free_motion(k):
    """L = 1/(x' + k x^2) has x'' + 3 k x x' + k^2 x^3 = 0, Phys. Rev. E 72 (2005) 066203."""
    found = derive(f'{{coordinates: [x], parameters: {{k: {POS}}}, L: "1/(x\' + {k}*x^2)"}}')
    assert len(found.discovery.charges) == 5


@pytest.mark.long
@pytest.mark.parametrize("letter", ["lambda", "s", "W"])
def test_no_letter_of_the_file_is_an_unknown_of_ours(letter):
    """A charge in a magnetic field and a harmonic well keeps its 8 symmetries by any letter."""
    found = summary(
        derive(f"""
coordinates: [x, y]
parameters: {{{letter}: , g: {{assume: positive}}}}
L: (x'^2 + y'^2)/2 + {letter}*(x*y' - y*x') - g*(x^2 + y^2)/2
""").discovery
    )
    assert (found.dimension, found.independent) == (8, 4)


OBLIQUE = ["5 1 1", "3 2 4", "0 1 0", "2 -1 3"]


@pytest.mark.parametrize("inertia", OBLIQUE)
def test_free_motion_in_oblique_coordinates_has_the_eight_of_rectangular_ones(inertia):
    """The rotation is a combination of two dilations, whose charges depend on the time."""
    a, b, c = map(int, inertia.split())
    L = f"({a}*x'^2 + ({2 * b})*x'*y' + {c}*y'^2)/2"
    found = derive(f"{{coordinates: [x, y], L: {L}}}").discovery
    assert len(found.charges) == 8, [charge.name for charge in found.charges]
    assert len(found.fixed_charges) == 4
    assert summary(found).closed


def test_a_damped_pair_has_no_charge_twice_where_its_damping_is_critical():
    """Bateman, Phys. Rev. 38 (1931) 815; in u = e^(g t) x and v = e^(-g t) y it is free."""
    L = "x'*y' + g*(x*y' - y*x') - g^2*x*y"
    found = derive(f"{{coordinates: [x, y], parameters: {{g: {POS}}}, L: {L}}}").discovery
    assert len(found.charges) == 8, [charge.name for charge in found.charges]
    assert summary(found).dimension == 8


TOGETHER = {  # what the quartic and the cubic of Henon and Heiles need of two parameters
    "(x'^2 + y'^2 - a*x^2 - b*y^2)/2 - (x^4 + 2*c*x^2*y^2 + y^4)/4": {"b": "a", "c": "3"},
    "(x'^2 + y'^2 - a*x^2 - b*y^2)/2 - x^2*y - c*y^3/3": {"b": "a", "c": "1"},
    "(x'^2 + y'^2 - 4*a*x^2 - b*y^2)/2 - x^2*y - c*y^3/3": {"b": "4*a", "c": "1"},
}


@pytest.mark.long
@pytest.mark.parametrize("L", TOGETHER)
def test_two_parameters_may_have_to_have_their_values_together(L):
    """Ramani, Grammaticos, Bountis, Phys. Rep. 180 (1989) 159, sections 3.3 and 3.4: separable."""
    text = f"coordinates: [x, y]\nparameters: {{a: {POS}, b: {POS}, c: {{}}}}\nL: {L}\n"
    derivation = derive(text)
    # beside it, L_z at c = 1 and b = a of the quartic
    [case] = [
        c for c in derivation.special_cases
        if {str(p): str(v) for p, v in ((c.parameter, c.value), *c.given)} == TOGETHER[L]
    ]  # fmt: skip
    assert case.number == 2
    [charge] = case.charges
    H = derivation.noether.energy.function.xreplace(
        dict(((case.parameter, case.value), *case.given))
    )
    assert is_zero(charge.charge - H) is False
    answers = solve(derivation.problem, ["discovered", "algebra"])
    assert not answers.warnings
    assert any(special.given for special in answers.sections["algebra"].special)


def test_what_holds_at_one_value_is_not_listed_for_two():
    """For c = 6 any a and b do, so for b = 4 a, too."""
    L = list(TOGETHER)[1]
    text = f"coordinates: [x, y]\nparameters: {{a: {POS}, b: {POS}, c: {{}}}}\nL: {L}\n"
    cases = derive(text).special_cases
    assert [str(c.value) for c in cases if not c.given] == ["6"]
    assert len(cases) == 2


@pytest.mark.parametrize(
    ("power", "rho", "x"), [("-1/2", 2, "x"), ("1/2", -1, "u"), ("-3/2", 3, "x")]
)
def test_a_value_of_an_integral_with_the_time_is_found_alone(power, rho, x):
    """y'' = F(x) + G(x) y, x'' = c x^p: without a both are of one degree, which is a dilation.

    Drach's potential (l) with p = -1/2: Tsiganov, J. Phys. A 33 (2000) 7407.
    """
    L = f"x'*y' - a*(y - {rho}*x/3) - b*x^p - 2*(y - {rho}*x)*x^p".replace("^p", f"^({power})")
    L = re.sub(r"\bx\b", x, L)
    derivation = derive(problem(L, f"{{{x}: {POS}, y: {{}}}}", "|a b"))
    [case] = [c for c in derivation.special_cases if not c.given]
    assert (str(case.parameter), case.value) == ("a", 0)
    there = derive(problem(L.replace("a*", "0*"), f"{{{x}: {POS}, y: {{}}}}", "|b")).discovery
    assert case.number == len(there.charges) == len(derivation.discovery.charges) + 1
    [charge] = case.charges
    assert derivation.system.t in charge.charge.free_symbols


SURFACES = {  # with what is said of signs: powers that are odd are of another surface
    "x^2/a^2 + y^2/b^2 + z^2 - 1": {"b"},
    "x^2/a + y^2/b + z^2 - 1": set(),
    "a*x^2 + b*y^2 + z^2 - 1": set(),
    "x^2/a^4 + y^2/b^4 + z^2/3 - 1": {"b"},
}


@pytest.mark.long
@pytest.mark.parametrize("sign", ["{}", POS])
@pytest.mark.parametrize("surface", SURFACES)
def test_a_sign_of_a_parameter_is_exchanged_where_the_constraint_allows_it(surface, sign):
    given = f"coordinates: [x, y, z]\nparameters: {{a: {sign}, b: {sign}}}\n"
    derivation = derive(f"{given}L: (x'^2 + y'^2 + z'^2)/2\nconstraints: {{s: {surface}}}\n")
    assert "a" in {str(c.value) for c in derivation.special_cases}
    exchanged = {x for x in "ab" if f"of {x} and -{x}, which" in derivation.discovery.ansatz}
    assert exchanged == (SURFACES[surface] if sign == "{}" else set())


@pytest.mark.long
def test_a_list_of_special_values_is_not_called_whole_without_those_of_quartic_integrals():
    """Grammaticos, Dorizzi, Padjen, Phys. Lett. A 89 (1982) 111: c = 16 and b = 16 a, of degree 4."""
    L = "(x'^2 + y'^2 - a*x^2 - b*y^2)/2 - x^2*y - c*y^3/3"
    at = L.replace("b*", "16*a*").replace("c*", "16*")
    known = derive(f"coordinates: [x, y]\nparameters: {{a: {POS}}}\nL: {at}\n")
    assert len(known.discovery.charges) == 2
    derivation = derive(
        f"coordinates: [x, y]\nparameters: {{a: {POS}, b: {POS}, c: {{}}}}\nL: {L}\n"
    )
    assert "16" not in {str(value) for c in derivation.special_cases for _, value in c.given}
    assert "not all special values of the parameters were tried" in derivation.discovery.ansatz


BOTH_0 = {  # terms of which one is as bad as both: Kepler's problem, the free particle, a sphere
    "[x, y]": "(x'^2 + y'^2)/2 + (1 + b*sqrt(R + x) + c*sqrt(R - x))/R",
    "[x]": "x'^2/2 - b/sin(x)^2 - c/cos(x)^2",
    "[theta, phi]": "(theta'^2 + sin(theta)^2*phi'^2)/2 - 1/cos(theta)^2"
    " - (b/cos(phi)^2 + c/sin(phi)^2)/sin(theta)^2",
}


@pytest.mark.long
@pytest.mark.parametrize("coordinates", BOTH_0)
def test_two_terms_may_have_to_be_absent_together(coordinates):
    L = BOTH_0[coordinates].replace("R", "sqrt(x^2 + y^2)")
    text = f"coordinates: {coordinates}\nparameters: {{b: {{}}, c: {{}}}}\nL: {L}\n"
    derivation = derive(text)
    [case] = [c for c in derivation.special_cases if c.given]
    assert {(str(p), v) for p, v in ((case.parameter, case.value), *case.given)} == {
        ("b", 0),
        ("c", 0),
    }
    assert case.number > len(derivation.discovery.charges)


@pytest.mark.long
@pytest.mark.parametrize("sign", "+-")
def test_powers_in_the_inertia_are_dilated_and_turn_where_they_are_equal(sign):
    """Kasner's metrics: homothetic for all exponents, with a rotation for two equal ones.

    Stephani, Kramer, MacCallum, Hoenselaers, Herlt, *Exact Solutions*, 2nd ed., section 13.3.2.
    """
    given = f"coordinates: {{u: {POS}, x: {{}}, y: {{}}}}\nparameters: {{p: {{}}, q: {{}}}}\n"
    derivation = derive(f"{given}L: ({sign}u'^2 + u^(2*p)*x'^2 + u^(2*q)*y'^2)/2\n")
    assert [c.name for c in derivation.discovery.charges] == ["energy", "p_x", "p_y", "dilation"]
    found = derivation.special_cases
    cases = {(str(c.parameter), str(c.value)): c.charges for c in found if not c.given}
    assert set(cases) == {("p", "0"), ("q", "0"), ("q", "p")}
    assert [c.name for c in cases["q", "p"]] == ["L_z"]
    # flat where one of them is 0 and the other 0 or 1: 12 symmetries; where both are 1 a cone
    # over a plane, with the dilation's conformal partner
    for case in (c for c in found if c.given):
        both_1 = {case.value, *(v for _, v in case.given)} == {1}
        assert case.number == (6 if both_1 else 12)


CHARTS_OF_SPACE = {
    "[x, y, z]": ("x'^2 + y'^2 + z'^2", "sqrt(x^2 + y^2 + z^2)"),
    f"{{r: {POS}, phi: {{}}, z: {{}}}}": ("r'^2 + r^2*phi'^2 + z'^2", "sqrt(r^2 + z^2)"),
    f"{{r: {POS}, theta: {{}}, phi: {{}}}}": (
        "r'^2 + r^2*(theta'^2 + sin(theta)^2*phi'^2)",
        "r",
    ),
    f"{{u: {POS}, v: {POS}, phi: {{}}}}": (
        "(u^2 + v^2)*(u'^2 + v'^2) + u^2*v^2*phi'^2",
        "(u^2 + v^2)",
    ),
}


@pytest.mark.long
@pytest.mark.parametrize("coordinates", CHARTS_OF_SPACE)
def test_bertrands_exponents_are_found_in_any_coordinates(coordinates):
    rates, r = CHARTS_OF_SPACE[coordinates]
    given = f"{{m: {POS}, k: {POS}, n: {{assume: nonzero}}}}"
    text = f"coordinates: {coordinates}\nparameters: {given}\nL: m*({rates})/2 - k*{r}^n/n\n"
    cases = {str(c.value): c.number for c in derive(text).special_cases}
    assert cases == {"-2": 6, "-1": 7, "2": 17}


COUNTED = {  # text: how many charges, whatever the signs of parameters without one
    "parameters: [l], coordinates: [x], L: x'^2/(2*(1 + l*x^2))": 5,
    "parameters: [a, b], coordinates: [x], L: (a + b*x)*x'^2/2": 5,
    f"parameters: {{m: {POS}, c: {POS}, g: {POS}}}, coordinates: [x], "
    "T: m*x'^2/2, V: m*g*x, forces: {x: -m*c*x'^2}": 5,
    f"parameters: {{g: {POS}}}, coordinates: [x], L: -sqrt((1 + g*x)^2 - x'^2)": 3,
    f"parameters: {{a: {POS}, b: {POS}}}, coordinates: [x, y, u, v], T: x'^2 + y'^2 "
    "+ (x' - a*u'*sin(u))^2 + (y' + a*u'*cos(u))^2 "
    "+ (x' - b*v'*sin(v))^2 + (y' + b*v'*cos(v))^2": 7,  # Galilei, and the inner energy
    "parameters: [b], coordinates: [x, y, z], T: (x'^2 + y'^2 + z'^2)/2, V: sqrt(b^2)": 12,
    f"parameters: {{m: {POS}, H: {POS}}}, coordinates: [r, phi], "
    "L: -m*sqrt(1 - H^2*r^2 - r'^2/(1 - H^2*r^2) - r^2*phi'^2)": 6,
    f"parameters: {{g: {POS}, k: {{}}}}, coordinates: {{r: {POS}, theta: {{}}, phi: {{}}}}, "
    "L: (r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2 + g*cos(theta)*phi' + k/r - g^2/(2*r^2)":
    7,
}  # fmt: skip


@pytest.mark.parametrize("text", COUNTED)
def test_all_are_found_and_real_where_the_motion_is(text):
    """Arc lengths, space and time, two rods with a hinge, a monopole (McIntosh and Cisneros)."""
    made = derive(f"{{{text}}}")
    kept = digits_of(made)
    assert len(kept) == COUNTED[text]
    assert min(kept.values()) > 20
    assert made.discovery.stopped == []


@pytest.mark.parametrize(
    "mass", ["m + k/sqrt(x^2 + y^2)", "m + k*sqrt(x^2 + y^2)", "m + k*(x^2 + 2*y^2)"]
)
def test_the_lagrangian_of_a_mass_that_depends_on_the_place_is_negative(mass):
    """H = sqrt(p^2 + M^2) gives L = -M sqrt(1 - v^2), M > 0 (Landau and Lifshitz II, section 8)."""
    head = f"parameters: {{m: {POS}, k: {POS}}}\ncoordinates: [x, y]\n"
    L = derive(f"{head}H: sqrt(p_x^2 + p_y^2 + ({mass})^2)\n").system.L
    known = derive(f"{head}L: -({mass})*sqrt(1 - x'^2 - y'^2)\n").system
    values = dict(zip(sorted(L.free_symbols, key=str), (3, 5, 2, 0.3, 7, 0.4), strict=True))
    assert abs(sympy.N((L - known.L).xreplace(values))) < 1e-12


@pytest.mark.long
@pytest.mark.parametrize(
    ("factor", "spring"),
    [
        ("(1 + a*t)^2", "w^2*(x^2 + y^2)/2 - c*x*y"),
        ("(1 + a*t)^2", "w^2*x^2 + (x - 2*y)^2*c/2"),
        ("1/(1 + a*t)^2", "w^2*(x^2 + y^2)/2 - c*x*y"),
        ("t^4", "w^2*(x^2 + y^2)/2 + 2*c*x*y"),
    ],
)
def test_two_coupled_oscillators_of_one_changing_mass_have_their_phases(factor, spring):
    """By the normal modes each has u'' + (f'/f) u' + k u = 0: two solutions for each of two."""
    found = derive(
        f"{{coordinates: [x, y], parameters: {{a: {POS}, w: {POS}, c: {POS}}}, "
        f"L: \"{factor}*((x'^2 + y'^2)/2 - ({spring}))\"}}"
    )
    assert summary(found.discovery).independent == 4
    assert not found.discovery.stopped


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_without_a_core_a_fading_spring_in_space_has_its_phases(seed):
    """u/t of x = t u(1/t) oscillates: Kamke, *Differentialgleichungen*, 2.14; 3 (3 + 1) in all."""
    random = Random(seed)
    letters, time = random.choice(["xyz", "uvw"]), random.choice(["t", "(1 + b*t)", "(2 - t)"])
    R = "(" + " + ".join(f"{x}^2" for x in letters) + ")"
    v = " + ".join(f"{x}'^2" for x in letters)
    derivation = derive(
        f"{{coordinates: [{', '.join(letters)}], parameters: {{k: {POS}, b: {POS}, g: {{}}}}, "
        f'L: "({v})/2 - k*{R}/(2*{time}^4) - g/{R}"}}'
    )
    [case] = derivation.special_cases
    assert (str(case.parameter), case.value, case.number) == ("g", 0, 12)


@pytest.mark.parametrize(
    ("parts", "names"),
    [
        ("-m*sqrt(1 - x'^2) - k*sqrt(1 - y'^2) - c*(x - y)", "energy energy_x"),  # two quarks
        ("-m*sqrt(1 - x'^2) - x^4, u'^2*v'^2 - u*v, y'^4 - y*sin(t)", "energy_x energy_u_v"),
        ("y'^2/2 - k*y^6 + x'^4 + x'*x^3 - c*x^2", "energy energy_x"),
    ],
)
def test_each_part_of_a_lagrangian_has_its_energy(parts, names):
    L = " + ".join(f"({part})" for part in parts.split(", "))
    coordinates = [x for x in "xyuv" if f"{x}'" in L]
    derivation = derive(problem(L, f"[{', '.join(coordinates)}]", "m k c"))
    found = [c.name for c in derivation.discovery.charges]
    assert {*names.split()} == {name for name in found if name.startswith("energy")}
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize("power", [2, 3])
def test_what_is_new_at_two_values_is_new_beside_what_is_shown(power):
    """Garnier's integral is 0 at g = 0, b = a, where the energy of x was known and not shown."""
    text = (
        "coordinates: [x, y]\nparameters: {a: {}, b: {}, g: {}}\n"
        f"L: (x'^2 + y'^2)/2 - (a*x^2 + b*y^2)/2 - g*(x^2 + y^2)^{power}\n"
    )
    answers = solve(read_problem("p.yaml", text.encode()).checked(), ["algebra"])
    assert answers.complete, answers.warnings
    special = answers.sections["algebra"].special
    [isotropic] = [s for s in special if s.number == 10]
    assert ("energy_x" in isotropic.charges) is (power == 2)  # else it is new at g = 0
