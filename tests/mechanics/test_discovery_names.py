"""Names of invariants where the coordinates have letters of their own; products are left out.

Two bodies: Landau and Lifshitz, *Mechanics*, section 13.  Modes and their energies: Goldstein,
Poole, Safko, 3rd ed., section 6.3.  Crossed fields: Jackson, 3rd ed., section 12.3.
"""

from random import Random

import pytest
import sympy

from lagcli.algebra import is_zero
from lagcli.mechanics.discovery.brackets import ChargeBrackets
from lagcli.mechanics.discovery.lie_algebra import name_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.summary import summary
from lagcli.reader import parse_text

from .derived import derive

POS = "{assume: positive}"


def names_of(text):
    return {c.name: c for c in derive(text).discovery.charges}


@pytest.mark.parametrize(("masses", "name"), [(("m", "M"), "rotation_x_y"), (("m", "m"), "L_z")])
def test_what_mixes_unlike_masses_is_no_angular_momentum_about_an_axis(masses, name):
    """m M (x y' - y x') of two oscillators of one frequency has another unit than L_z."""
    one, other = masses
    found = names_of(
        f"{{coordinates: [x, y], parameters: {{m: {POS}, M: {POS}, w: {POS}}}, "
        f"T: \"({one}*x'^2 + {other}*y'^2)/2\", V: w^2*({one}*x^2 + {other}*y^2)/2}}"
    )
    rotations = {n for n in found if n.startswith(("L_", "angular", "rotation"))}
    assert rotations == {name}


def test_what_keeps_a_hyperbola_is_no_rotation():
    """T = (x'² - y'²)/2 - (x² - y²)²: dx = y and dy = x is a boost of the plane of signature 0."""
    found = names_of("{coordinates: [x, y], L: (x'^2 - y'^2)/2 - (x^2 - y^2)^2}")
    assert set(found) == {"energy", "charge_1"}


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_two_bodies_in_any_letters_have_total_and_relative_angular_momentum(seed):
    random = Random(seed)
    x, y, u, v = random.sample("abcduvwxyz", 4)
    r2 = f"(({x} - {u})^2 + ({y} - {v})^2)"
    potential = random.choice([f"k*{r2}^2", f"-k/{r2}^2", f"k*log{r2}"])
    given = random.sample([x, y, u, v], 4)
    found = names_of(
        f"{{coordinates: [{', '.join(given)}], parameters: {{m: {POS}, M: {POS}, k: {POS}}}, "
        f"T: \"m*({x}'^2 + {y}'^2)/2 + M*({u}'^2 + {v}'^2)/2\", V: \"{potential}\"}}"
    )
    charge = {n: sympy.expand(c.charge) for n, c in found.items()}
    assert not [n for n in found if n.startswith("charge")]
    system = derive(
        f"{{coordinates: [{', '.join(given)}], parameters: {{m: {POS}, M: {POS}}}, "
        f"T: \"m*({x}'^2 + {y}'^2)/2 + M*({u}'^2 + {v}'^2)/2\"}}"
    ).system
    q = {s.name: s for s in system.q}
    p = dict(zip((s.name for s in system.q), system.qdot, strict=True))
    m, M = sympy.symbols("m M", positive=True)
    total = m * (q[x] * p[y] - q[y] * p[x]) + M * (q[u] * p[v] - q[v] * p[u])
    between = (q[x] - q[u]) * (p[y] - p[v]) - (q[y] - q[v]) * (p[x] - p[u])
    for name, expected in (
        ("angular_momentum", total),
        ("angular_momentum_relative", m * M * between),
    ):
        ratio = sympy.cancel(charge[name] / expected)
        assert ratio in (1, -1), (name, charge[name])


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_coupled_oscillators_have_the_energies_of_their_modes(seed):
    """V of two springs and a coupling; H = E_1 + E_2 with E = mu (Q'^2 + omega^2 Q^2)/2."""
    random = Random(seed)
    k, c = random.randint(1, 6), random.randint(1, 6)
    x, y = random.choice(["xy", "ab", ("q1", "q2")])
    found = names_of(
        f"{{coordinates: [{x}, {y}], parameters: {{m: {POS}}}, "
        f'T: "m*({x}\'^2 + {y}\'^2)/2", V: "{k}*({x}^2 + {y}^2)/2 + {c}*({x} - {y})^2/2"}}'
    )
    assert not [n for n in found if n.startswith("charge")]
    assert {"mode_cos", "mode_sin", "energy_mode"} <= set(found)
    one = found["energy_mode"].charge
    other = sympy.expand(found["energy"].charge - one)
    symbols = {s.name: s for s in one.free_symbols | other.free_symbols}
    q = [symbols[x], symbols[y]]
    assert {
        sympy.factor(e.subs({q[0]: 1, q[1]: sign})) == 0 for e in (one,) for sign in (1, -1)
    } == {False}
    still = {s: 0 for n, s in symbols.items() if s not in q and n != "m"}
    sums = {sympy.expand(e.subs(still).subs({q[0]: 1, q[1]: s})) for e in (one, other)
            for s in (1, -1)}  # fmt: skip
    assert sums == {0, k, k + 2 * c}


@pytest.mark.parametrize("axes", ["xyz", "yzx", "zxy"])
def test_charges_in_crossed_fields_have_their_names(axes):
    x, y, z = axes
    found = names_of(
        f"{{coordinates: [x, y, z], parameters: {{m: {POS}, q: {POS}, B: {POS}, E: {POS}}}, "
        f"L: \"m*(x'^2 + y'^2 + z'^2)/2 + q*B*{x}*{y}' + q*E*{x}\"}}"
    )
    assert {"gyration_cos", "gyration_sin", f"boost_{z}"} <= set(found)


@pytest.mark.parametrize(
    ("constraint", "names"),
    [
        ("z = y*tan(alpha)", {"momentum_y_z", "boost_y_z"}),
        ("y*cos(alpha) = x*sin(alpha)", {"momentum_x_y", "boost_x_y"}),
    ],
)
def test_the_cosine_of_a_slope_is_no_gyration(constraint, names):
    """Along a smooth slope p + m g t sin(α) is constant: cos(α) does not turn with the time."""
    found = names_of(
        f"{{coordinates: [x, y, z], parameters: {{m: {POS}, g: {POS}, alpha: {POS}}}, "
        f"T: \"m*(x'^2 + y'^2 + z'^2)/2\", V: m*g*z, constraints: {{slope: {constraint}}}}}"
    )
    assert names <= set(found)
    assert not [name for name in found if name.startswith(("gyration", "conformal_"))]


SPHERES = {
    "in a space-time": "-(1 - 2*a/r)*s'^2/2 + r'^2/(2*(1 - 2*a/r)) + r^2*({})/2",
    "beside a plane": "r'^2/2 + r^2*s'^2/2 + b*({})/2",
}


@pytest.mark.parametrize("latitude", [False, True])
@pytest.mark.parametrize("name", SPHERES)
@pytest.mark.long
def test_the_turns_of_a_sphere_are_named_beside_other_coordinates(name, latitude):
    """L = r x p with z up: r cos(latitude) sin(phi) = y."""
    theta = "cos(u)" if latitude else "sin(u)"
    L = SPHERES[name].format(f"u'^2 + {theta}^2*phi'^2")
    text = f"{{coordinates: {{s: {{}}, r: {POS}, u: {{}}, phi: {{}}}}, "
    text += f'parameters: {{a: {POS}, b: {POS}}}, L: "{L}"}}'
    derivation = derive(text)
    charges = {c.name: c.charge for c in derivation.discovery.charges}
    build = derivation.system.build
    factor = "r^2" if name == "in a space-time" else "b"
    side, up = ("-u'", "tan(u)") if latitude else ("u'", "1/tan(u)")
    for name, along, across in (("L_x", "-sin(phi)", "cos(phi)"), ("L_y", "cos(phi)", "sin(phi)")):
        known = f"{factor}*({along}*({side}) - {across}*phi'*{up}*{theta}^2)"
        assert is_zero(charges[name] - build(parse_text(known))) is True


@pytest.mark.long
@pytest.mark.parametrize("V", ["-k/r", "k*r^2/2", "k/r^2"])
def test_free_coordinates_beside_others_are_lengths(V):
    """Landau and Lifshitz, section 13: the centre of mass moves alone."""
    L = f"M*(X'^2 + Y'^2)/2 + m*(r'^2 + r^2*phi'^2)/2 - ({V})"
    text = f"{{coordinates: {{X: {{}}, Y: {{}}, r: {POS}, phi: {{}}}}, "
    given = ", ".join(f"{p}: {POS}" for p in "mMk")
    names = names_of(f'{text}parameters: {{{given}}}, L: "{L}"}}')
    assert {"p_X", "p_Y", "boost_X", "boost_Y", "angular_momentum_X_Y"} <= set(names)
    assert ("runge_lenz_x" in names) is (V == "-k/r")


@pytest.mark.long
def test_two_bodies_about_their_centre_of_mass_have_their_runge_lenz_vector():
    """Goldstein, Poole, Safko, 3rd ed., sections 3.1 and 3.9: 11 of 12 are independent."""
    sphere = "r^2*(theta'^2 + sin(theta)^2*phi'^2)"
    L = f"M*(X'^2 + Y'^2 + Z'^2)/2 + m*(r'^2 + {sphere})/2 + k/r"
    given = ", ".join(f"{p}: {POS}" for p in "mMk")
    derivation = derive(
        f"{{coordinates: {{X: {{}}, Y: {{}}, Z: {{}}, r: {POS}, theta: {{}}, phi: {{}}}}, "
        f'parameters: {{{given}}}, L: "{L}"}}'
    )
    names = {c.name for c in derivation.discovery.charges}
    assert {"L_x", "L_y", *(f"runge_lenz_{x}" for x in "xyz")} <= names
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (11, True)


@pytest.mark.long
def test_two_bodies_in_spherical_coordinates_each_are_integrable():
    bodies = [f"r{k}'^2 + r{k}^2*(a{k}'^2 + sin(a{k})^2*f{k}'^2)" for k in (1, 2)]
    across = "cos(a1)*cos(a2) + sin(a1)*sin(a2)*cos(f1 - f2)"
    q = ", ".join(f"r{k}: {POS}, a{k}: {{}}, f{k}: {{}}" for k in (1, 2))
    derivation = derive(
        f"{{coordinates: {{{q}}}, parameters: {{m: {POS}, M: {POS}, k: {POS}}}, "
        f'L: "m*({bodies[0]})/2 + M*({bodies[1]})/2 - k*(r1^2 + r2^2 - 2*r1*r2*({across}))"}}'
    )
    found = summary(derivation.discovery)
    assert (found.in_involution, found.integrable) == (6, True)


def test_a_damping_that_turns_has_no_complex_exponents():
    """(p + c)^2 + w^2 = 0 of z'' + c z' + (k + i w) z = 0: no sample point was found."""
    found = derive(
        f"{{coordinates: [x, y], parameters: {{m: {POS}, c: {POS}, k: {POS}, w: {POS}}}, "
        "T: \"m*(x'^2 + y'^2)/2\", V: k*(x^2 + y^2)/2, "
        'forces: {x: "-c*(x\' + w*y)", y: "-c*(y\' - w*x)"}}'
    ).discovery
    assert found.stopped == []


@pytest.mark.long
@pytest.mark.parametrize(("space", "body"), [("phi", "psi"), ("psi", "phi"), ("b", "a")])
@pytest.mark.parametrize("reverse", [False, True])
def test_charges_at_a_special_value_have_names_of_their_own(space, body, reverse):
    """The spherical top turns about its own axes, too: no name of what holds for any C."""
    order = [space, "theta", body][:: -1 if reverse else 1]
    derivation = derive(
        f"{{coordinates: [{', '.join(order)}], parameters: {{A: {POS}, C: {POS}}}, "
        f"T: \"A*(theta'^2 + {space}'^2*sin(theta)^2)/2 + C*({body}' + {space}'*cos(theta))^2/2\"}}"
    )
    names = [c.name for c in derivation.discovery.charges]
    [case] = (each for each in derivation.special_cases if each.parameter.name == "C")
    assert {"L_x", "L_y"} <= {*names}
    assert [c.name for c in case.charges] == ["L_1", "L_2"]
    A = sympy.Symbol("A", real=True, positive=True)
    known, symbols = components(A, A, A)
    letters = [space, "theta", body, f"{space}'", "theta'", f"{body}'"]
    at = dict(zip(letters, (0.3, 1.1, -0.7, 0.9, -1.3, 0.4), strict=True)) | {"A": 1.5}
    values = {s: sympy.Float(at[n]) for s, n in zip(symbols, letters, strict=True)}
    for charge in case.charges:
        own = charge.charge.xreplace(
            {s: sympy.Float(at[s.name]) for s in charge.charge.free_symbols}
        )
        assert abs(own - known[charge.name[2:]].xreplace(values | {A: sympy.Float(1.5)})) < 1e-12


CYLINDERS = {"x": "yzx", "y": "zxy", "z": "xyz"}  # the plane across the axis, right-handed


@pytest.mark.long
@pytest.mark.parametrize("axis", CYLINDERS)
@pytest.mark.parametrize("V", ["0", "-k/sqrt(r^2 + {}^2)", "k*(r^2 + {}^2)/2"])
def test_a_cylinder_about_any_axis_has_the_charges_of_cartesian_coordinates(axis, V):
    one, other, _ = CYLINDERS[axis]
    text = f"{{coordinates: [r, u, {axis}], parameters: {{m: {POS}, k: {POS}}}, "
    text += f'T: "m*(r\'^2 + r^2*u\'^2 + {axis}\'^2)/2", V: "{V.format(axis)}"}}'
    found = {n: c.charge for n, c in names_of(text).items()}
    m, k, r, u, r_rate, u_rate = 1.7, 2.3, 1.2, 0.6, -0.4, 0.9
    c, s = float(sympy.cos(u)), float(sympy.sin(u))
    X = {axis: 0.8, one: r * c, other: r * s}
    P = {axis: m * 0.5, one: m * (r_rate * c - r * u_rate * s)}
    P[other] = m * (r_rate * s + r * u_rate * c)
    at = {"m": m, "k": k, "r": r, "u": u, "r'": r_rate, "u'": u_rate, axis: 0.8, f"{axis}'": 0.5}
    L = {c: X[a] * P[b] - X[b] * P[a] for c, (a, b) in zip("zxy", ("xy", "yz", "zx"), strict=True)}
    wanted = {f"L_{a}": L[a] for a in "xyz" if a != axis}
    if V == "0":
        wanted |= {f"p_{a}": P[a] for a in "xyz"}
    elif "sqrt" in V:
        length = float(sympy.sqrt(r**2 + 0.8**2))
        for a, b, c in ("xyz", "yzx", "zxy"):
            wanted[f"runge_lenz_{a}"] = P[b] * L[c] - P[c] * L[b] - m * k * X[a] / length
    else:
        wanted |= {
            f"fradkin_{a}{b}": P[a] * P[b] + m * k * X[a] * X[b] for a, b in ("xy", "xz", "yz")
        }
    assert {*wanted} <= {*found}
    for name, value in wanted.items():
        own = found[name].xreplace({s: sympy.Float(at[s.name]) for s in found[name].free_symbols})
        assert abs(own - value) < 1e-12, name


@pytest.mark.parametrize("constant", ["0", "c", "-m*c^2/2"])
def test_a_constant_in_the_potential_changes_no_name(constant):
    """L = T - V + m v²/2, as in a frame that moves along the axis."""
    found = names_of(
        f"{{coordinates: [r, u], parameters: {{m: {POS}, k: {POS}, c: {POS}}}, "
        f"T: \"m*(r'^2 + r^2*u'^2)/2\", V: k*r^2/2 + {constant}}}"
    )
    assert {"fradkin_xy", "energy_x"} <= set(found)


def test_an_axis_of_angles_may_be_the_name_of_another_coordinate():
    """x and y of r and u are none of the file's x: no name is given twice."""
    found = names_of(
        f"{{coordinates: [r, u, x, y], parameters: {{m: {POS}}}, "
        "T: \"m*(r'^2 + r^2*u'^2 + x'^2 + y'^2)/2\", V: x^4 + r^4}"
    )
    assert {"energy", "p_u", "p_y", "boost_y"} <= set(found)


def components(A, B, C):
    """L on the axes of space and on those of the body, from R = Rz(phi) Rx(theta) Rz(psi)."""
    phi, theta, psi = angles = sympy.symbols("phi theta psi", real=True)
    rates = sympy.symbols("phi' theta' psi'", real=True)

    def turn(angle):
        c, s = sympy.cos(angle), sympy.sin(angle)
        return sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    c, s = sympy.cos(theta), sympy.sin(theta)
    R = turn(phi) * sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]]) * turn(psi)
    rate = sympy.zeros(3, 3)
    for angle, speed in zip(angles, rates, strict=True):
        rate += R.diff(angle) * speed
    W = R.T * rate  # omega x on the axes of the body
    body = sympy.Matrix([A * W[2, 1], B * W[0, 2], C * W[1, 0]])
    return dict(zip("x y z 1 2 3".split(), [*(R * body), *body], strict=True)), [*angles, *rates]


@pytest.mark.parametrize(
    ("moments", "named"),
    [
        ("A B C", "x y"),
        ("A A C", "x y"),
        ("A A A", "x y 1 2"),
        ("A B A", "x y 2"),
        ("A C C", "x y 1"),
    ],
)
@pytest.mark.parametrize("order", ["phi, theta, psi", "psi, theta, phi"])
def test_the_angular_momentum_of_a_top_on_axes_of_space_and_of_the_body(moments, named, order):
    A, B, C = moments.split()
    parameters = ", ".join(f"{p}: {{assume: positive}}" for p in sorted({A, B, C}))
    T = (
        f"({A}*(phi'*sin(theta)*sin(psi) + theta'*cos(psi))^2"
        f" + {B}*(phi'*sin(theta)*cos(psi) - theta'*sin(psi))^2 + {C}*(psi' + phi'*cos(theta))^2)/2"
    )
    if A == B:
        T = f"({A}*(theta'^2 + phi'^2*sin(theta)^2) + {C}*(psi' + phi'*cos(theta))^2)/2"
    text = f"parameters: {{{parameters}}}\ncoordinates: [{order}]\nV: 0\nT: {T}\n"
    found = {c.name: c.charge for c in derive(text).discovery.charges if c.name.startswith("L_")}
    assert set(found) == {f"L_{axis}" for axis in named.split()}
    values = {p: sympy.Symbol(p, real=True, positive=True) for p in (A, B, C)}
    known, symbols = components(*(values[p] for p in (A, B, C)))
    at = dict(zip([s.name for s in symbols], (0.3, 1.1, -0.7, 0.9, -1.3, 0.4), strict=True))
    at |= {"A": 1.5, "B": 2.25, "C": 3.5}
    for name, charge in found.items():
        wanted = known[name[2:]]
        one, other = (
            e.xreplace({s: sympy.Float(at[s.name]) for s in e.free_symbols})
            for e in (charge, wanted)
        )
        assert abs(one - other) < 1e-12


def charge_at(charge, r, phi, r_rate, phi_rate, t):
    """Its value where the state is given in polar coordinates."""
    c, s = sympy.cos(phi), sympy.sin(phi)
    state = {"r": r, "phi": phi, "r'": r_rate, "phi'": phi_rate, "t": t, "x": r * c, "y": r * s}
    state |= {"x'": r_rate * c - r * phi_rate * s, "y'": r_rate * s + r * phi_rate * c}
    state |= {"m": 1.7, "k": 2.3, "a": 0.31, "c": 0.22, "F": 0.43}
    values = {name: sympy.Float(value, 30) for name, value in state.items()}
    return charge.charge.xreplace({s: values[s.name] for s in charge.charge.free_symbols})


@pytest.mark.long
@pytest.mark.parametrize(
    ("V", "all_named"),
    [
        ("0", True),
        ("-k/r", True),
        ("k*r^2/2", True),
        ("k*r^2/2 + a/x^2", True),
        ("k*r^2 + a/x^2 + c/y^2", False),
        ("-k/r + a/y^2", True),
        ("-k/r + a/y^2 + c*x/(r*y^2)", True),
        ("k*(4*x^2 + y^2)/2 + a/y^2", False),
        ("F*x", False),
    ],
)
def test_in_polar_coordinates_the_charges_are_those_of_cartesian_ones(V, all_named):
    """Smorodinsky and Winternitz, Phys. Lett. 16 (1965) 354: each name, and what it stands for."""
    head = f"parameters: {{m: {POS}, k: {POS}, a: {{}}, c: {{}}, F: {{}}}}\n"
    polar = f"({V})".replace("x", "(r*cos(phi))").replace("y", "(r*sin(phi))")
    plane = f"({V})".replace("r", "sqrt(x^2 + y^2)")
    known = names_of(f"{head}coordinates: [x, y]\nT: m*(x'^2 + y'^2)/2\nV: {plane}\n")
    found = names_of(f"{head}coordinates: [r, phi]\nT: m*(r'^2 + r^2*phi'^2)/2\nV: {polar}\n")
    named = {"L_z" if n == "p_phi" else n: c for n, c in found.items() if n[:7] != "charge_"}
    assert set(named) <= set(known)
    if all_named:
        assert {n for n in known if n[:7] != "charge_"} == set(named)
    states = (1.3, 0.7, -0.4, 0.9, 0.6), (0.8, 0.5, 0.3, -0.6, 1.1)
    # what changes from state to state: a constant of the parameters alone may be added
    for each in named:
        own, others = (
            [charge_at(charges[each], *state) for state in states] for charges in (named, known)
        )
        assert abs((own[0] - own[1]) - (others[0] - others[1])) < 1e-12, each


@pytest.mark.parametrize("seed", range(3))
def test_what_is_named_as_a_momentum_is_the_canonical_one(seed):
    """Landau, Lifshitz, *Quantum Mechanics*, section 112: p_x is conserved in one gauge, not p_y.

    In any gauge a translation conserves m v + q B × r, which is another quantity than ∂L/∂v.
    """
    random = Random(seed)
    c, fall = sympy.Rational(random.randint(-3, 4), 4), random.choice(["", " - m*g*z"])
    text = (
        f"{{coordinates: [x, y, z], parameters: {{m: {POS}, B: {POS}, g: {POS}}}, "
        f"L: \"m*(x'^2 + y'^2 + z'^2)/2 + B*({c}*x*y' - {1 - c}*y*x'){fall}\"}}"
    )
    system, found = derive(text).system, names_of(text)
    momenta = {f"p_{q.name}": system.L.diff(v) for q, v in zip(system.q, system.qdot, strict=True)}
    cyclic = {f"p_{q.name}" for q in system.q if q not in system.L.free_symbols}
    assert found.keys() & momenta == cyclic
    assert all(is_zero(found[n].charge - momenta[n]) is True for n in cyclic)
    assert found.keys() >= {f"translation_{n.removeprefix('p_')}" for n in momenta.keys() - cyclic}


@pytest.mark.parametrize(
    ("given", "q", "V", "algebra"),
    [
        ("k: {assume: positive}", "xy", "k*(x^2 + y^2)/2", (4, "so(3) + R")),
        ("k: {assume: positive}", "uv", "3*k^2*(u^2 + v^2)/2", (4, "so(3) + R")),
        ("k: {assume: negative}", "xy", "k*(x^2 + y^2)/2", (4, "sl(2,R) + R")),
        ("k: {}", "xy", "k*(x^2 + y^2)/2", None),
        ("k: {assume: positive}", "xy", "k*(x^2 + 5*y^2)/2", None),
    ],
)
def test_the_algebra_of_what_does_not_depend_on_the_time(given, q, V, algebra):
    """u(2) of the plane oscillator, u(1, 1) or sl(2,R) + R of the hill: Fradkin, Am. J. Phys. 33
    (1965) 207; which of the two it is depends on the sign of k."""
    a, b = q
    text = (
        f"{{coordinates: [{a}, {b}], parameters: {{m: {POS}, {given}}}, "
        f'T: "m*({a}\'^2 + {b}\'^2)/2", V: "{V}"}}'
    )
    assert summary(derive(text).discovery).autonomous == algebra


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("closed", [False, True])
def test_what_linear_equations_have_without_a_closed_form_is_said_not_to_be_sought(seed, closed):
    """n linear equations have 2 n integrals of first degree: those of a saddle in a field beside a
    mass on a spring have an equation of sixth degree, and without both l^2 + k and l^2 - k."""
    given = Random(seed)
    b, k = (0 if closed else given.randint(1, 9)), given.randint(1, 9)
    u, v, w = given.sample("uvwxyz", 3)
    text = (
        f"{{coordinates: [{u}, {v}, {w}], parameters: {{k: {POS}, b: {POS}}}, "
        f"L: \"({u}'^2 + {v}'^2 + {w}'^2)/2 + {b}*b*{u}*{v}' - {k}*k*({u}^2 - {v}^2)/2"
        f' + {b}*{v}*{w}"}}'
    )
    discovery = derive(text).discovery
    of_first_degree = [c for c in discovery.point_charges if c.name != "energy"]
    said = any("were not sought where no closed form" in word for word in discovery.words)
    assert (len(of_first_degree) >= 6, said) == (closed, not closed)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("turning", [False, True])
def test_what_is_linear_in_the_velocities_is_no_energy_of_a_coordinate(seed, turning):
    """m x'^2/2 + k x^2/2 of a saddle at rest; where it turns, x and y are coupled."""
    given = Random(seed)
    a, b, w = given.randint(1, 9), given.randint(1, 9), given.randint(1, 5) if turning else 0
    text = (
        f"{{coordinates: [x, y], parameters: {{k: {POS}, w: {POS}}}, "
        f"L: \"((x' - {w}*w*y)^2 + (y' + {w}*w*x)^2)/2 - k*({a}*x^2 - {b}*y^2)/2\"}}"
    )
    found = names_of(text)
    assert ("energy_x" in found) is not turning
    assert len(found) >= 2


@pytest.mark.parametrize("seed", range(3))
def test_a_constant_beside_an_angular_momentum_changes_no_name(seed):
    """{A_x, A_y} = -2 E L of Kepler's problem is -2 E (L + s) + 2 s E; L^2 + E is another thing."""
    derivation = derive(
        f"{{coordinates: [x, y], parameters: {{k: {POS}}}, T: (x'^2 + y'^2)/2, V: -k/sqrt(x^2 + y^2)}}"
    )
    of = {c.name: c.charge for c in derivation.discovery.charges}
    energy, turn = of["energy"], of["L_z"]
    axes = [of["runge_lenz_x"], of["runge_lenz_y"]]
    s = sympy.Rational(Random(seed).randint(1, 9), 4)
    for momentum, name in ((turn + s, "so(3) where the energy is negative"), (turn + energy, None)):
        brackets = ChargeBrackets([energy, momentum, *axes], derivation.dynamics, Allowance())
        structure = brackets.structure([1, 2, 3], 0)
        found = None if structure is None else name_of(structure)
        assert (found or "").startswith(name or "")
        assert (name is None) == (found is None)


# coordinates about an axis: names, m beside its factor, T/m, and x, y, z by them
ABOUT_AN_AXIS = {
    "prolate": (
        "u v f", "a^2*((u^2 - v^2)*(u'^2/(u^2 - 1) + v'^2/(1 - v^2)) + (u^2 - 1)*(1 - v^2)*f'^2)/2",
        ("a*sqrt((u^2 - 1)*(1 - v^2))*cos(f)", "a*sqrt((u^2 - 1)*(1 - v^2))*sin(f)", "a*u*v")),
    "parabolic": (
        "u v f", "((u^2 + v^2)*(u'^2 + v'^2) + u^2*v^2*f'^2)/2",
        ("u*v*cos(f)", "u*v*sin(f)", "(u^2 - v^2)/2")),
    "squares of parabolic": (
        "u v f", "(u + v)*(u'^2/u + v'^2/v)/8 + u*v*f'^2/2",
        ("sqrt(u*v)*cos(f)", "sqrt(u*v)*sin(f)", "(u - v)/2")),
    "oblate": (
        "u v f", "a^2*((sinh(u)^2 + sin(v)^2)*(u'^2 + v'^2) + cosh(u)^2*cos(v)^2*f'^2)/2",
        ("a*cosh(u)*cos(v)*cos(f)", "a*cosh(u)*cos(v)*sin(f)", "a*sinh(u)*sin(v)")),
}  # fmt: skip


@pytest.mark.parametrize("name", ABOUT_AN_AXIS)
def test_momenta_about_an_axis_are_those_of_cartesian_coordinates(name):
    """m X', m (X Y' - Y X') and m (t X' - X) of the axes x, y, z, in numbers at two states."""
    coordinates, T, axes = ABOUT_AN_AXIS[name]
    derivation = derive(
        f"{{coordinates: [{', '.join(coordinates.split())}], "
        f'parameters: {{m: {POS}, a: {POS}}}, T: "m*({T})"}}'
    )
    system = derivation.system
    X = dict(zip("xyz", (system.build(parse_text(each)) for each in axes), strict=True))
    V = {k: system.total_derivative(f) for k, f in X.items()}
    m, t = next(p for p in system.parameters if p.name == "m"), system.t
    expected = {f"p_{k}": m * V[k] for k in "xyz"} | {
        f"boost_{k}": m * (t * V[k] - X[k]) for k in "xyz"
    }
    expected |= {f"L_{i}": m * (X[j] * V[k] - X[k] * V[j]) for i, j, k in ("xyz", "yzx")}
    found = {c.name: c.charge for c in derivation.discovery.charges}
    assert {*expected} <= {*found}
    for sizes in ("19/8 3/7 4/5 1/3 2/7 5/9", "13/8 2/7 9/5 2/3 1/7 7/9"):
        numbers = dict(
            zip((*system.q, *system.qdot), map(sympy.Rational, sizes.split()), strict=True)
        )
        at = numbers | dict.fromkeys((*system.parameters, t), sympy.Rational(6, 5))
        for key, formula in expected.items():
            assert abs((found[key] - formula).subs(at).evalf(30)) < 1e-20


DYON = "m*(%s) + s*(u{p} - v{p})/(u{p} + v{p})*f' + 2*k/(u{p} + v{p}) - 2*s^2/(m*(u{p} + v{p})^2)"


@pytest.mark.parametrize(("chart", "power"), [("parabolic", "^2"), ("squares of parabolic", "")])
def test_a_dyon_in_parabolic_coordinates_has_its_runge_lenz_vector(chart, power):
    """A = m v x J - m k r/|r|, with the conserved J (McIntosh, Cisneros, J. Math. Phys. 11, 896)."""
    parameters = f"{{m: {POS}, k: {POS}, s: {POS}}}"
    L = DYON.format(p=power) % ABOUT_AN_AXIS[chart][1]
    derivation = derive(f'{{coordinates: [u, v, f], parameters: {parameters}, L: "{L}"}}')
    system = derivation.system
    X = [system.build(parse_text(each)) for each in ABOUT_AN_AXIS[chart][2]]
    V = [system.total_derivative(f) for f in X]
    m, k = (next(p for p in system.parameters if p.name == name) for name in "mk")
    found = {c.name: c.charge for c in derivation.discovery.charges}
    J = [found[name] for name in ("L_x", "L_y", "p_f")]
    r = sympy.sqrt(sympy.Add(*(x**2 for x in X)))
    sizes = map(sympy.Rational, "19/8 3/7 4/5 1/3 2/7 5/9".split())
    at = dict(zip((*system.q, *system.qdot), sizes, strict=True))
    at |= dict.fromkeys(system.parameters, sympy.Rational(6, 5))
    for i, j, n in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        expected = m * (V[j] * J[n] - V[n] * J[j]) - m * k * X[i] / r
        name = f"runge_lenz_{'xyz'[i]}"
        assert abs((found[name] - expected).subs(at).evalf(30)) < 1e-20


@pytest.mark.parametrize("F", [0, 3])
@pytest.mark.parametrize(("chart", "power"), [("parabolic", "^2"), ("squares of parabolic", "")])
def test_keplers_problem_in_parabolic_coordinates_keeps_the_textbooks_vector(chart, power, F):
    """A_z = m (v x L)_z - m k z/r, with m F (x^2 + y^2)/2 in a field with V = -F z (Redmond)."""
    z = f"(u{power} - v{power})/2"
    L = f"m*({ABOUT_AN_AXIS[chart][1]}) + 2*k/(u{power} + v{power}) + {F}*{z}"
    derivation = derive(f'{{coordinates: [u, v, f], parameters: {{m: {POS}, k: {POS}}}, L: "{L}"}}')
    system = derivation.system
    x, y, z_ = (system.build(parse_text(each)) for each in ABOUT_AN_AXIS[chart][2])
    X, Y, Z = map(system.total_derivative, (x, y, z_))
    m, k = system.parameters
    expected = m**2 * (X * (z_ * X - x * Z) - Y * (y * Z - z_ * Y))
    expected += m * F * (x**2 + y**2) / 2 - m * k * z_ / sympy.sqrt(x**2 + y**2 + z_**2)
    sizes = map(sympy.Rational, "19/8 3/7 4/5 1/3 2/7 5/9".split())
    at = dict(zip((*system.q, *system.qdot), sizes, strict=True))
    at |= dict.fromkeys(system.parameters, sympy.Rational(6, 5))
    found = {c.name: c.charge for c in derivation.discovery.charges}
    assert abs((found["runge_lenz_z"] - expected).subs(at).evalf(30)) < 1e-20


@pytest.mark.parametrize("sign", ["+", "-"])
def test_keplers_problem_on_a_curved_plane_names_its_runge_lenz_vector(sign):
    """Of curvature ±4 in stereographic coordinates, V = -k cot(chi)/2 or -k coth(chi)/2."""
    other = "-" if sign == "+" else "+"
    found = names_of(
        f"{{coordinates: [x, y], parameters: {{k: {POS}}}, "
        f"L: \"(x'^2 + y'^2)/(2*(1 {sign} x^2 {sign} y^2)^2)"
        f' + k*(1 {other} x^2 {other} y^2)/(2*sqrt(x^2 + y^2))"}}'
    )
    assert {"energy", "L_z", "runge_lenz_x", "runge_lenz_y"} == set(found)
    x, y = sympy.symbols("x y", real=True)
    still = {s: 0 for s in found["runge_lenz_x"].charge.free_symbols if s.name.endswith("'")}
    at_rest = found["runge_lenz_x"].charge.xreplace(still)
    ratio = sympy.simplify(at_rest * sympy.sqrt(x**2 + y**2) / x)
    assert ratio.subs(sympy.Symbol("k", positive=True), 1) < 0


FIELDS = {  # of the unit vectors e_3 of the body in space, and e_z of space in the body
    "L_x": "sin({phi})*sin(s)", "L_y": "-cos({phi})*sin(s)",
    "L_1": "sin({psi})*sin(s)", "L_2": "cos({psi})*sin(s)",
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize(("phi", "psi"), [("phi", "psi"), ("a", "b"), ("b", "a")])
def test_an_axis_along_a_field_is_one_of_space_whatever_the_field_turns(name, phi, psi):
    """z-x-z: Goldstein, Poole, Safko, section 4.4; the spherical top turns about those of its body.

    Of a top with C = A nothing but the letters and their order tell space and body apart.
    """
    C, field = "A" if name[2:].isdigit() else "C", FIELDS[name].format(phi=phi, psi=psi)
    q = [phi, "s", psi] if C == "A" else Random(name + phi).sample([phi, "s", psi], 3)
    found = names_of(
        f"{{coordinates: [{', '.join(q)}], "
        f"parameters: {{{', '.join(f'{p}: {POS}' for p in sorted({'A', C, 'c'}))}}}, "
        f"T: \"A*(s'^2 + {phi}'^2*sin(s)^2)/2 + {C}*({psi}' + {phi}'*cos(s))^2/2\", V: -c*{field}}}"
    )
    assert {n for n in found if n.startswith("L_")} == {name}
    of_s = {"L_x": "cos({phi})", "L_y": "sin({phi})", "L_1": "cos({psi})", "L_2": "-sin({psi})"}
    change = found[name].transformation.changes[q.index("s")]
    assert str(change) == of_s[name].format(phi=phi, psi=psi)


@pytest.mark.parametrize("axis", "xyz")
@pytest.mark.parametrize("number", ["1", "2"])
def test_a_screw_is_no_rotation(axis, number):
    """A cholesteric crystal; its components of p are turned as it goes along the axis."""
    u, w = (x for x in "xyz" if x != axis)
    wave = f"cos({number}*{axis})*({u}'^2 - {w}'^2) + 2*sin({number}*{axis})*{u}'*{w}'"
    derivation = derive(
        f"{{coordinates: [x, y, z], parameters: [], T: \"(x'^2 + y'^2 + z'^2)/2 + ({wave})/6\"}}"
    )
    found = {c.name for c in derivation.discovery.charges}
    assert found == {"energy", f"p_{u}", f"p_{w}", "charge_1"}
    assert f"with sines and cosines of {axis}, polynomial" in derivation.discovery.ansatz


ON_A_SPHERE = "(theta{k}'^2 + sin(theta{k})^2*phi{k}'^2)/2"


@pytest.mark.parametrize("number", [1, 2])
def test_rotations_of_bodies_on_spheres_are_their_total_angular_momentum(number):
    """L = sum m (X x X') of X = (sin(theta) cos(phi), sin(theta) sin(phi), cos(theta))."""
    ks = range(1, number + 1)
    T = " + ".join(f"{k + 1}*{ON_A_SPHERE.format(k=k)}" for k in ks)
    near = "cos(theta1)*cos(theta2) + sin(theta1)*sin(theta2)*cos(phi1 - phi2)"
    V = near if number == 2 else "0"
    derivation = derive(
        f'{{coordinates: [{", ".join(f"theta{k}, phi{k}" for k in ks)}], T: "{T}", V: {V}}}'
    )
    system = derivation.system
    found = {c.name: c.charge for c in derivation.discovery.charges}
    for name, i, j in (("L_x", 1, 2), ("L_y", 2, 0)):
        expected = sympy.S.Zero
        for k in ks:
            theta, phi = system.q[2 * k - 2 : 2 * k]
            axis = sympy.sin(theta)
            X = [axis * sympy.cos(phi), axis * sympy.sin(phi), sympy.cos(theta)]
            V_ = [system.total_derivative(x) for x in X]
            expected += (k + 1) * (X[i] * V_[j] - X[j] * V_[i])
        assert sympy.simplify(found[name] - expected) == 0
