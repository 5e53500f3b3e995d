"""Kinds of systems in which searches had missed a charge, a gauge, a name or a special value.

Driven at resonance: Landau and Lifshitz, *Mechanics*, section 22; the numbers of symmetries of
linear equations: Lutzky, J. Phys. A 11 (1978) 249, and Niederer, Helv. Phys. Acta 45 (1972) 802.
Gnomonic coordinates: Higgs, J. Phys. A 12 (1979) 309; Zernike's oscillator: Pogosyan, Wolf and
Yakhno, J. Math. Phys. 58 (2017) 072901.  Tops: Landau and Lifshitz, section 35.  Jacobi's geodesics
and Neumann's motion on a sphere: Moser, *Geometry of Quadrics and Spectral Theory* (1980).
"""

from random import Random

import pytest
import sympy

from lagcli.mechanics.discovery.summary import summary
from tests.oracle.constancy import digits_of

from .derived import derive

POS = "{assume: positive}"


def text_of(coordinates, L, positive="", constraint=""):
    parameters = ", ".join(f"{p}: {POS}" for p in positive.split())
    more = f', constraints: {{s: "{constraint}"}}' if constraint else ""
    head = f"coordinates: [{', '.join(coordinates)}]"
    return f'{{{head}, parameters: {{{parameters}}}, L: "{L}"{more}}}'


def kinetic(letters):
    return "(" + " + ".join(f"{x}'^2" for x in letters) + ")/2"


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_at_resonance_none_is_missed(seed):
    random = Random(seed)
    x, w = random.choice("xqs"), random.choice(["w", "2", "3*w"])
    wave = random.choice(["cos", "sin"])
    L = f"{kinetic(x)} - ({w})^2*{x}^2/2 + F*{x}*{wave}({w}*t)"
    derivation = derive(text_of(x, L, "w F"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.independent) == (5, 2)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(("letters", "number"), [("xy", 8), ("xyz", 12), ("uvw", 12)])
def test_a_force_that_swings_at_a_given_frequency_keeps_them_all(letters, number):
    pushed = Random(letters).choice(letters)
    derivation = derive(text_of(letters, f"{kinetic(letters)} + {pushed}*cos(2*t)"))
    found = summary(derivation.discovery)
    assert (len(derivation.discovery.charges), found.dimension) == (number, number)
    assert found.independent == 2 * len(letters)
    assert min(digits_of(derivation).values()) > 20


PLANES = {
    "gnomonic": ("(x'^2 + y'^2 + l*(x*y' - y*x')^2)/(2*(1 + l*(x^2 + y^2))^2)", "so(3) + R"),
    "gnomonic, hyperbolic": (
        "(x'^2 + y'^2 - l*(x*y' - y*x')^2)/(2*(1 - l*(x^2 + y^2))^2)", "sl(2,R) + R"),
    "Zernike": (
        "(x'^2 + y'^2 - l*(x*x' + y*y')^2/(1 + l*(x^2 + y^2)))/2", "sl(2,R) + R"),
    "from above": (
        "(x'^2 + y'^2 + l*(x*x' + y*y')^2/(1 - l*(x^2 + y^2)))/2", "so(3) + R"),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", PLANES)
def test_projected_spheres_and_hyperboloids_have_three_isometries(name):
    L, algebra = PLANES[name]
    found = summary(derive(text_of("xy", L, "l")).discovery)
    assert (found.dimension, found.independent, found.name) == (4, 3, algebra)


@pytest.mark.parametrize("change", ["s*p'", "s*r*r'", "s*r'*cos(p) - s*r*p'*sin(p)"])
def test_terms_of_l_that_change_nothing_are_in_the_gauge_alone(change):
    """Q = p.eta - G with p = dL/dq' for the Runge-Lenz vector, whatever L has added."""
    L = f"(r'^2 + r^2*p'^2)/2 + k/r + {change}"
    text = f'{{coordinates: {{r: {POS}, p: {{}}}}, parameters: {{k: {POS}, s: {POS}}}, L: "{L}"}}'
    derivation = derive(text)
    found = {c.name: c for c in derivation.discovery.charges}
    for name in ("runge_lenz_x", "runge_lenz_y"):
        charge, system = found[name], derivation.system
        momenta = [system.L.diff(v) for v in system.qdot]
        moved = sum(p * e for p, e in zip(momenta, charge.transformation.changes, strict=True))
        assert sympy.simplify(moved - charge.gauge - charge.charge) == 0
    assert summary(derivation.discovery).name.startswith("the energy and so(3)")


NAMES = {
    "drifting in crossed fields": (
        "xyz", "B*x*y' + E*x", {"L_z_moving": "B*x*y' - (B*y + E*t)*x' "
                                              "+ B^2*(x^2 + y^2)/2 + E*x + E*B*t*y + E^2*t^2/2"}),
    "falling": ("xy", "-a*y", {"L_z_moving": "(a*t^2 + 2*y)*x' - 2*x*y' - 2*a*t*x"}),
    "repelled": ("x", "a^2*x^2/2", {"translation_x_exp": "(x' - a*x)*exp(a*t)"}),
    "walls": ("xy", "-a/x^2 - E/y^2", {"L_z_squared": "(x*y' - y*x')^2 "
                                                      "+ 2*a*y^2/x^2 + 2*E*x^2/y^2"}),
    "one to two": ("xy", "-a*(x^2 + 4*y^2)/2", {"L_z_p_x": "x'*(x*y' - y*x') + a*x^2*y"}),
    "in an electric field": (
        "xy", "a/sqrt(x^2 + y^2) + E*x",
        {"runge_lenz_x": "y'*(x*y' - y*x') - a*x/sqrt(x^2 + y^2) + E*y^2/2"}),
}  # fmt: skip


@pytest.mark.parametrize("case", NAMES)
def test_charges_are_named_by_what_they_are(case):
    letters, more, expected = NAMES[case]
    derivation = derive(text_of(letters, f"{kinetic(letters)} + {more}", "a B E"))
    charges = {c.name: c.charge for c in derivation.discovery.charges}
    system = derivation.system
    rates = dict(zip(letters, system.qdot, strict=True))
    symbols = {str(s): s for s in (system.t, *system.q, *system.parameters)}
    for name, known in expected.items():
        for x, rate in rates.items():
            known, symbols[f"v_{x}"] = known.replace(f"{x}'", f"v_{x}"), rate
        value = sympy.sympify(known.replace("^", "**"), symbols)
        ratio = sympy.simplify(charges[name] / value)
        assert ratio.is_number or not ratio.free_symbols & {system.t, *system.q, *system.qdot}


@pytest.mark.parametrize("letters", ["x", "xy"])
def test_the_energy_of_a_damped_oscillator_is_named(letters):
    """Caldirola, Nuovo Cimento 18 (1941) 393: exp(a t) (x'^2 + a x x' + B x^2)."""
    r2 = " + ".join(f"{x}^2" for x in letters)
    derivation = derive(text_of(letters, f"exp(a*t)*({kinetic(letters)} - B*({r2})/2)", "a B"))
    found = {c.name: c.charge for c in derivation.discovery.charges}["damped_energy"]
    system = derivation.system
    a, B = system.parameters
    terms = (v**2 + a * x * v + B * x**2 for x, v in zip(system.q, system.qdot, strict=True))
    ratio = sympy.simplify(found / sympy.exp(a * system.t) / sympy.Add(*terms))
    assert ratio.is_number
    assert ratio > 0
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize(
    ("c", "name"), [("a", "damped_energy"), ("-a", "energy_exp"), ("B", "energy_exp")]
)
def test_an_energy_is_damped_where_its_factor_grows(c, name):
    text = text_of("x", f"exp({c}*t)*(x'^2/2 - a*x^2/2)", "a").replace("{a:", "{B: {}, a:")
    assert name in {charge.name for charge in derive(text).discovery.charges}


@pytest.mark.parametrize(("letters", "drag", "rate"), [("xy", "B", 2), ("x", "3*B", 6)])
def test_a_kinetic_energy_that_a_drag_takes_is_no_conformal_charge(letters, drag, rate):
    given = text_of(letters, f"m*({kinetic(letters)})", "m B")
    loss = f'"{drag}*({kinetic(letters)})"'
    derivation = derive(given.rstrip().removesuffix("}") + f", dissipation: {loss}}}")
    found = {c.name: c.charge for c in derivation.discovery.charges}["damped_energy"]
    m, B = derivation.system.parameters
    wanted = sympy.exp(rate * B * derivation.system.t / m)
    ratio = sympy.simplify(found / wanted / sympy.Add(*(v**2 for v in derivation.system.qdot)))
    assert not ratio.free_symbols - {m}


@pytest.mark.parametrize(
    "V", ["a/u", "a*(4*u^2 + v^2)/u + B/u", "a/(u*v^2) - B/u", "(a + B*v^2)/u"]
)
def test_no_charge_has_a_constant_of_its_own(V):
    """Of Darboux's first surface, where K and V u have constants: u (u'^2 + v'^2)."""
    text = (f"{{coordinates: {{u: {POS}, v: {POS}}}, parameters: {{a: {POS}, B: {{}}}}, "
            f'L: "u*(u\'^2 + v\'^2) - ({V})"}}')  # fmt: skip
    derivation = derive(text)
    system = derivation.system
    for charge in derivation.discovery.charges:
        terms = sympy.Add.make_args(sympy.expand(charge.charge))
        assert all(x.free_symbols & {*system.q, *system.qdot} for x in terms)
    assert min(digits_of(derivation).values()) > 20


def test_the_energy_in_an_expanding_space_is_no_damped_one():
    text = text_of("x", "-a*sqrt(1 - exp(2*B*t)*x'^2)", "a B")
    names = [charge.name for charge in derive(text).discovery.charges]
    assert names == ["p_x", "charge_1", "charge_2"]


@pytest.mark.long
@pytest.mark.parametrize(
    ("a", "c", "b"), [(4, -1, 1), (-4, -1, 1), (3, 1, 1), (2, -3, 1), (-5, 2, 2)]
)
def test_modes_of_numbers_are_found_stable_or_not(a, c, b):
    """Frequencies such as sqrt(6 + 2 sqrt(29)) and growth rates sqrt(2 sqrt(29) - 6)."""
    derivation = derive(text_of("xy", f"{kinetic('xy')} - {a}*x^2/2 - {c}*y^2/2 - {b}*x*y"))
    found = summary(derivation.discovery)
    assert derivation.discovery.stopped == []
    assert (found.independent, found.in_involution) == (4, 2)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.parametrize("stiffness", ["k", "k + 2*n", "5*k + n"])
def test_a_damped_frequency_has_one_root(stiffness):
    """sqrt(4 m k - c^2)/(2 m) in the transformation as in the charge: not sqrt((k - c^2/4m)/m)."""
    T, V = "m*x'^2/2", f"({stiffness})*x^2/2"
    text = text_of("x", "", "m k n c").replace('L: ""', f"T: {T}, V: {V}, dissipation: c*x'^2/2")
    roots = {
        root
        for charge in derive(text).discovery.charges
        for e in (charge.charge, *charge.transformation.changes)
        for root in e.atoms(sympy.Pow)
        if root.exp == sympy.S.Half
    }
    assert len(roots) == 1


SURFACES = {
    "elliptic paraboloid": ("z - a*x^2 - b*y^2", "", {"b = a": "L_z"}),
    "Neumann": ("x^2 + y^2 + z^2 - 1", " - (a*x^2 + b*y^2 + c*z^2)/2",
                {"b = a": "L_z", "c = a": "L_y", "c = b": "L_x"}),
    "Jacobi": ("x^2/a^2 + y^2/b^2 + z^2/c^2 - 1", "",
               {"b = a": "L_z", "c = a": "L_y", "c = b": "L_x"}),
    "a sphere, a harmonic force": ("x^2 + y^2 + z^2 - a^2", " - b*z^2/2", {}),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", SURFACES)
def test_equal_axes_under_constraints_are_special(name):
    constraint, more, expected = SURFACES[name]
    letters = [p for p in "abc" if p in constraint + more]
    text = text_of("xyz", f"{kinetic('xyz')}{more}", " ".join(letters), constraint)
    special = derive(text).special_cases
    found = {f"{s.parameter} = {s.value}": " ".join(c.name for c in s.charges) for s in special}
    assert found == expected


@pytest.mark.long
def test_each_pair_of_equal_moments_makes_a_top_symmetric():
    L = ("A*(u'*sin(v)*sin(w) + v'*cos(w))^2/2 + B*(u'*sin(v)*cos(w) - v'*sin(w))^2/2"
         " + C*(w' + u'*cos(v))^2/2")  # fmt: skip
    special = derive(text_of("uvw", L, "A B C")).special_cases
    assert {f"{s.parameter} = {s.value}" for s in special} == {"B = A", "C = A", "C = B"}
    assert [s.number for s in special] == [5, 5, 5]


#: Lamb, *Hydrodynamics*, 6th ed., section 124: the energy, the impulse and its moment.
BODY_IN_A_FLUID = "a*(x'*cos(q) + y'*sin(q))^2/2 + b*(y'*cos(q) - x'*sin(q))^2/2 + J*q'^2/2"


@pytest.mark.parametrize("seed", range(3))
def test_a_plane_body_with_two_masses_has_the_moment_of_its_impulse(seed):
    random = Random(seed)
    a, b = random.sample(range(1, 9), 2)
    L = BODY_IN_A_FLUID.replace("a*", f"{a}*", 1).replace("b*", f"{b}*", 1)
    if seed:  # its centre is not its origin
        L += f" + {random.randint(1, 3)}*(y'*cos(q) - x'*sin(q))*q'/4"
    derivation = derive(text_of("xyq", L, "J"))
    kept = digits_of(derivation)
    assert len(kept) == 4
    assert min(kept.values()) > 20
    assert summary(derivation.discovery).independent == 4


def test_a_plane_body_with_one_mass_moves_freely_in_three_coordinates():
    equal = derive(text_of("xyq", BODY_IN_A_FLUID.replace("b*", "a*"), "a J"))
    assert len(equal.discovery.charges) == 12


@pytest.mark.parametrize("power", ["2", "3/2"])
def test_a_value_without_a_force_has_all_of_free_motion(power):
    """H = p^4/4 + k r^n: n = 0 leaves the energy, the momenta, L_z and a dilation, as k = 0 does."""
    text = "{coordinates: [x, y], parameters: [k, n], "
    derivation = derive(f"{text}H: (p_x^2 + p_y^2)^({power})/4 + k*(x^2 + y^2)^n}}")
    numbers = {str(case.value): case.number for case in derivation.special_cases if not case.given}
    at_zero = [case.number for case in derivation.special_cases if case.value == 0]
    assert at_zero == [5, 5]
    assert numbers["-2" if power == "2" else "-3/2"] == 3


@pytest.mark.parametrize(
    ("L", "at", "number"),
    [
        ("(x'^2 + y'^2)/2 - a*x'*exp(y) - b*exp(y)", "a b", 8),
        (f"{BODY_IN_A_FLUID.replace('J', '2')} + c*(x*y' - y*x')", "c b", 12),
    ],
    ids=["both terms", "equal inertias without a field"],
)
def test_beside_a_value_that_is_found_another_term_may_be_missing(L, at, number):
    """Free motion, which neither value alone leaves: Niederer, Helv. Phys. Acta 45 (1972) 802."""
    parameters = (
        "a: {assume: positive}, b: {assume: positive}, c: {}" if "q" in L else "a: {}, b: {}"
    )
    q = ", ".join("xyq" if "q" in L else "xy")
    cases = derive(f'{{coordinates: [{q}], parameters: {{{parameters}}}, L: "{L}"}}').special_cases
    [case] = (c for c in cases if c.given)
    named = {case.parameter.name, *(p.name for p, _ in case.given)}
    assert named in ({*at.split()}, {"a" if p == "b" else p for p in at.split()})
    assert case.number == number


@pytest.mark.parametrize(
    ("T", "moment"),
    [
        ("A*(s'^2 + f'^2*sin(s)^2)/2 + C*(y' + f'*cos(s))^2/2", "C*(y' + f'*cos(s))"),
        ("m*s'^2/2 + (C + m*s^2)*y'^2/2", "(C + m*s^2)*y'"),
        ("m*(s'^2 + f'^2)/2 + C*(1 + s^2 + f^4)*(y' + s*f')^2/2", "C*(1 + s^2 + f^4)*(y' + s*f')"),
    ],
    ids=["top", "on a turntable", "in a gauge field"],
)
@pytest.mark.parametrize("drag", ["c", "c*t^2"])
def test_a_momentum_decays_under_a_force_in_proportion_to_it(T, moment, drag):
    """p' = -a(t) p: p exp(integral of a) is constant, whatever the other equations are."""
    names = [x for x in "sfy" if f"{x}'" in T]
    derivation = derive(
        f"{{coordinates: [{', '.join(names)}], "
        f"parameters: {{A: {POS}, C: {POS}, c: {POS}, m: {POS}, k: {POS}}}, "
        f'T: "{T}", V: k*cos(s), forces: {{y: "-({drag})*({moment})"}}}}'
    )
    system = derivation.system
    p = derivation.dynamics.lagrange.momenta[-1]
    [c] = (x for x in system.parameters if x.name == "c")
    expected = p * sympy.exp(c * (system.t if drag == "c" else system.t**3 / 3))
    found = [x.charge / expected for x in derivation.discovery.charges]
    assert any(sympy.simplify(ratio).is_number for ratio in found)


# name -> text, charges in all, independent ones, integrable
LINEAR_INSIDE = {
    # Chandrasekar, Senthilvelan, Lakshmanan, Phys. Rev. E 72 (2005) 066203
    "modified Emden": (
        f"{{coordinates: [x], parameters: {{k: {POS}, w: {POS}}}, L: 1/(k*x' + k^2*x^2/3 + 3*w^2)}}",
        5, 2, True),
    # Bloch, *Nonholonomic Mechanics and Control*, 2nd ed., section 1.8: the multiplier is 0
    "Heisenberg's constraint under a spring": (
        (f"{{coordinates: [x, y, z], parameters: {{k: {POS}}}, T: (x'^2 + y'^2 + z'^2)/2, "
        "V: k*(x^2 + y^2)/2, constraints: {flat: z' = x*y' - y*x'}}"), 7, 5, None),
    # Sutherland, Phys. Rev. Lett. 80 (1998) 3678: two of second degree contain no time
    "Calogero's three in a trap that fades": (
        (f"{{coordinates: [x, y, z], parameters: {{k: {POS}, g: {POS}}}, L: (x'^2 + y'^2 + z'^2)/2 "
        "- k*(x^2 + y^2 + z^2)/(2*t^2) - g/(x - y)^2 - g/(y - z)^2 - g/(z - x)^2}"), 7, 5, True),
}  # fmt: skip


@pytest.mark.parametrize("name", LINEAR_INSIDE)
def test_what_the_linear_part_suggests_is_found_in_every_setting(name):
    text, number, independent, integrable = LINEAR_INSIDE[name]
    discovery = derive(text).discovery
    found = summary(discovery)
    assert all(c.conserved is True and c.verified == "exact" for c in discovery.charges)
    assert len(discovery.charges) == number
    assert (found.independent, found.integrable) == (independent, integrable)


@pytest.mark.parametrize("c", ["c", "2*c"])
def test_roots_that_are_imaginary_at_a_value_hide_none_there(c):
    """Modes of w^2 +- l - c^2: alike at l = 0, where sch(2) is that of one frequency."""
    derivation = derive(
        f"{{coordinates: [x, y], parameters: {{c: {POS}, w: {POS}, l: {{}}}}, "
        f"L: exp(2*{c}*t)*((x'^2 + y'^2)/2 - w^2*(x^2 + y^2)/2 - l*x*y)}}"
    )
    [found] = (case for case in derivation.special_cases if case.value == 0)
    assert (found.parameter.name, found.number, found.given) == ("l", 8, ())
    assert {"L_z", "conformal_cos", "conformal_sin"} == {c.name for c in found.charges}
