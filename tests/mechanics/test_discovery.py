"""Systems whose symmetry algebras are known.

The numbers of Noether symmetries and the algebras: Niederer, Helv. Phys. Acta 45 (1972) 802
and 46 (1973) 191 (free particle and oscillator in n dimensions: 3 + n(n-1)/2 + 2n + the
centre); Lutzky, J. Phys. A 11 (1978) 249; Prince and Eliezer, J. Phys. A 14 (1981) 587
(Kepler); de Alfaro, Fubini and Furlan, Nuovo Cim. A 34 (1976) 569 (inverse square);
Jackiw, Ann. Phys. 129 (1980) 183 (monopole); Levy-Leblond, in Loebl, Group Theory and its
Applications II (1971) 221 (Galilei); Arnold, Mathematical Methods, sections 49 and 26.
Every charge on a trajectory: tests/oracle/test_discovered.py.
"""

import time
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
import sympy

from lagcli import load
from lagcli.algebra import is_zero
from lagcli.formatters import Options
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.discovery import limits
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.reality import real_where
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.special_search import _beyond_products
from lagcli.mechanics.discovery.summary import summary
from lagcli.pipeline import render
from lagcli.reader import parse_text, read_problem
from tests.solved import solve

from .derived import derive

LIBRARY = Path(__file__).parents[2] / "problems"

# file -> number of point symmetries, names that are there, algebra, integrable
KNOWN = {
    "symmetry/free-particle": (5, "energy p_x boost_x dilation conformal", "sch(1)", True),
    "discovery/free-particle-plane": (8, "energy p_x p_y L_z boost_x boost_y", "sch(2)", True),
    "symmetry/free-particle-space": (12, "L_x L_y L_z boost_z conformal", "sch(3)", True),
    "discovery/three-free-particles": (12, "p_x1 boost_x3 dilation", "sch(3)", True),
    "discovery/oscillator-five-symmetries": (5, "energy conformal_sin", "sch(1)", True),
    "particles/isotropic-oscillator": (8, "energy L_z fradkin_xy energy_x", "sch(2)", True),
    "particles/kepler-runge-lenz": (2, "energy L_z runge_lenz_x runge_lenz_y", "so(3)", True),
    "canonical/central-force-polar": (2, "energy p_phi runge_lenz_x", "so(3)", True),
    "discovery/kepler-space": (4, "L_x L_y L_z runge_lenz_x runge_lenz_z", "so(4)", True),
    "particles/inverse-square-potential": (3, "energy dilation conformal", "sl(2,R)", True),
    "discovery/calogero-moser": (5, "energy momentum boost dilation conformal", "sl(2,R)", True),
    "particles/charge-in-uniform-magnetic-field": (
        8,
        "energy translation_x translation_y L_z",
        "sch(2)",
        True,
    ),
    "discovery/uniform-magnetic-field-space": (
        8,
        "energy translation_x translation_y p_z L_z boost_z",
        None,
        True,
    ),
    "rigid/heavy-symmetric-top": (3, "energy p_phi p_psi", "R^3", True),
    "driven/caldirola-kanai-oscillator": (5, "conformal_sin", "sch(1)", True),
    "discovery/bateman-oscillator": (8, "energy", "Heisenberg h(2)", True),
    "particles/anisotropic-oscillator": (5, "energy energy_x", None, True),
    "discovery/oscillator-equal-frequencies": (8, "energy rotation_x_y fradkin_xy", "sch(2)", True),
    "discovery/smorodinsky-winternitz": (
        3,
        "energy conformal_cos energy_x L_z_squared conformal_x_cos conformal_x_sin",
        None,
        True,
    ),
    "particles/oscillator-one-to-two": (5, "energy energy_x L_z_p_x", None, True),
    "discovery/oscillator-three-to-two": (5, "energy energy_x", None, True),
    "classics/spherical-pendulum": (2, "energy p_phi", "R^2", True),
    "classics/spherical-pendulum-cartesian": (2, "energy L_z", "R^2", True),
    "central/central-potential-cartesian": (4, "energy L_x L_y L_z", "so(3)", True),
    "canonical/particle-spherical": (4, "energy L_x L_y p_phi", "so(3)", True),
    "central/two-bodies": (7, "energy momentum_x L_z L_z_relative boost_y", "Galilei", True),
    "discovery/relativistic-free-particle": (10, "boost_x boost_z L_y", "iso(3,1)", True),
    "relativity/lorentz-group-plane": (6, "boost_x L_z p_x", "iso(2,1)", True),
    "discovery/toda-lattice": (3, "energy momentum boost charge_1", None, True),
    "particles/free-particle-in-rotating-frame": (8, "energy L_z conformal", "sch(2)", True),
    "particles/charge-and-magnetic-monopole": (6, "L_x L_y dilation", "so(3) + sl(2,R)", True),
    "classics/swinging-atwood-machine-integrable": (1, "energy charge_1", "R^2", True),
    "rigid/free-asymmetric-top": (4, "energy p_phi L_x L_y", "so(3)", True),
    "particles/henon-heiles": (1, "energy", "R", None),
    "oscillations/damped-oscillator": (5, "translation_x_cos", None, None),
}


# Jauch and Hill, Phys. Rev. 57 (1940) 641; Bertrand, C. R. Acad. Sci. 77 (1873) 849.
SPECIAL = {
    "particles/anisotropic-oscillator": {
        ("k2", "k1"): (10, "L_z fradkin_xy"),
        ("k2", "k1/4"): (7, "L_z_p_y"),
        ("k2", "4*k1"): (7, "L_z_p_x"),
        ("k2", "k1/9"): (7, "charge_1"),
        ("k2", "9*k1"): (7, "charge_1"),
    },
    # Chang, Tabor and Weiss, J. Math. Phys. 23 (1982) 531: D/C = -1/6 for any A and B; D/C = -1 for
    # A = B (Aizawa and Saito, J. Phys. Soc. Japan 32 (1972) 1636)
    "discovery/henon-heiles-any-cubic": {
        ("epsilon", "6"): (2, "charge_1"),
        ("epsilon", "1"): (2, "p_x_p_y"),
    },
    "discovery/power-law-potential": {
        ("n", "2"): (10, "fradkin_xy conformal_sin"),
        ("n", "-1"): (4, "runge_lenz_x runge_lenz_y"),
        ("n", "-2"): (4, "dilation conformal"),
    },
    # Larmor's theorem: an isotropic oscillator at half the cyclotron frequency
    "discovery/charge-in-turning-frame": {("omega", "Omega/2"): (10, "energy_x fradkin_xy")},
}


@pytest.mark.long
@pytest.mark.parametrize("name", SPECIAL)
def test_special_parameters_are_told_with_the_charges_they_add(name):
    cases = {(c.parameter.name, str(c.value)): c for c in derived(name).special_cases}
    assert set(SPECIAL[name]) == set(cases)
    for key, (number, names) in SPECIAL[name].items():
        assert cases[key].number == number
        assert set(names.split()) <= {c.name for c in cases[key].charges}


@pytest.mark.parametrize("offset", [0, 3])
def test_at_a_special_value_a_product_of_known_charges_is_not_new(offset):
    """P² + 2 E + c has nothing in it that P and E have not; a mode of y has."""
    free = derive("{coordinates: [x, y], L: (x'^2 + y'^2)/2 - y^2}").discovery
    by_name = {c.name: c for c in free.charges}
    P, E, other = by_name["p_x"], by_name["energy"], by_name["translation_y_cos"]
    square = replace(other, name="charge_1", charge=P.charge**2 + 2 * E.charge + offset)
    left = _beyond_products([P.charge, E.charge], [square, other], free, Allowance(10**7))
    assert left == (other,)


@pytest.mark.long
@pytest.mark.parametrize(
    ("parameters", "coordinates", "L", "value", "number", "names"),
    [
        # Kohn, Phys. Rev. 123 (1961) 1242: the centre of mass of equal masses oscillates freely
        (
            "{m1: POS, m2: POS, k: POS, c: POS}",
            "[x1, x2]",
            "m1*x1'^2/2 + m2*x2'^2/2 - k*(x1^2 + x2^2)/2 - c/(x2 - x1)",
            ("m2", "m1"), 4, "translation_cos translation_sin",
        ),
        # in the frame of Larmor an isotropic oscillator in space: 12 symmetries, three integrals
        (
            "{m: POS, O: POS, w: POS}",
            "[x, y, z]",
            "m*(x'^2 + y'^2 + z'^2)/2 + m*O*(x*y' - y*x')/2 - m*w^2*z^2/2",
            ("w", "O/2"), 15, "conformal_cos conformal_sin",
        ),
    ],
)  # fmt: skip
def test_special_values_of_other_systems(parameters, coordinates, L, value, number, names):
    text = f"coordinates: {coordinates}\nparameters: {parameters}\nL: {L}\n"
    cases = derive(text.replace("POS", "{assume: positive}")).special_cases
    [case] = [c for c in cases if (c.parameter.name, str(c.value)) == value]
    assert case.number == number
    assert set(names.split()) <= {c.name for c in case.charges}


def derived(name):
    return Derivation(load(LIBRARY / f"{name}.yaml"))


def test_what_is_left_out_does_not_depend_on_the_machine(monkeypatch):
    """The limit is a count: a slower clock, or another run, stops at the same place."""
    monkeypatch.setattr(limits.Allowance.__init__, "__defaults__", (120_000,))
    found = []
    for seconds in (0.0, 1e6):
        monkeypatch.setattr(time, "process_time", lambda seconds=seconds: seconds)
        discovery = Derivation(load(LIBRARY / "discovery/kepler-space.yaml")).discovery
        found.append(([c.name for c in discovery.charges], discovery.stopped))
    assert found[0] == found[1]
    assert any("too much work" in reason for reason in found[0][1])


@pytest.mark.long
def test_charges_say_where_they_are_real():
    """exp(nu t) on a rotating saddle: nu^2 = k/m - w^2 (Kirillov, section 1.2), of either sign."""
    problem = load(LIBRARY / "steady/rotating-saddle.yaml")
    charges = solve(problem, ["discovered"]).sections["discovered"].charges
    timed = [c for c in charges if "exp(" in to_grammar(c.charge)]
    assert len(timed) == 2
    for charge in charges:
        where = [(to_grammar(w.left), to_grammar(w.right)) for w in charge.where]
        assert where == ([("k", "m*w^2")] if charge in timed else [])


@pytest.mark.long
@pytest.mark.parametrize("name", KNOWN)
def test_known_algebras_are_found_within_the_work_allowed(name):
    count, names, algebra, integrable = KNOWN[name]
    derivation = derived(name)
    discovery = derivation.discovery
    found = summary(discovery)
    assert not discovery.stopped
    assert all(c.conserved and c.verified == "exact" for c in discovery.charges)
    assert len(discovery.point_charges) == count
    assert set(names.split()) <= {charge.name for charge in discovery.charges}
    assert (algebra or "") in (found.name or "")
    assert found.integrable is integrable


def test_an_oscillator_of_unknown_signs_has_its_five_symmetries():
    d = derive("coordinates: [x]\nparameters: [m, k]\nT: m*x'^2/2\nV: k*x^2/2")
    assert len(d.discovery.point_charges) == 5


@pytest.mark.parametrize("seed", range(4))
def test_a_scaled_solution_has_no_factor_of_constants_left(seed: int):
    rng = Random(seed)
    a, b, c = constants = sympy.symbols("a b c", positive=True)
    x, t = sympy.symbols("x t")
    values = [rng.choice([x, t, x * t, x**2 + t]) for _ in range(2)] + [a * x + b]
    factor = rng.choice([a + b, (a * c**2 + b) ** 3 * c, (a - b) * sympy.sqrt(a + c), a**2])
    found = scaled([sympy.expand(v * factor) for v in values], set(constants))
    assert all(is_zero(f - v) is True for f, v in zip(found, values, strict=True))


@pytest.mark.long
@pytest.mark.parametrize("inertia", ["L, M", "M, L"])
@pytest.mark.parametrize("coupling", ["(x - y)^2/(2*C)", "x*y/C"])
def test_like_circuits_have_both_amplitudes_of_both_modes(inertia: str, coupling: str):
    """L x'' + M y'' …: the frequencies of x + y and x - y, real for L > M or for M > L alone."""
    own, shared = inertia.split(", ")
    derivation = derive(
        "{coordinates: [x, y], parameters: {L: {assume: positive}, M: {assume: positive}, "
        f"C: {{assume: positive}}}}, T: {own}*(x'^2 + y'^2)/2 + {shared}*x'*y', "
        f"V: (x^2 + y^2)/(2*C) + {coupling}}}"
    )
    charges = derivation.discovery.charges
    moves = [c.transformation for c in charges if c.transformation.time == 0]
    state = {*derivation.system.q, *derivation.system.qdot}
    assert sum(not any(x.free_symbols & state for x in move.changes) for move in moves) == 4


@pytest.mark.parametrize("force", ["f(t)", "1/(1 + t^2)", "sin(t^2)"])
@pytest.mark.parametrize("spring", ["0", "w^2*x"])
def test_a_force_without_an_antiderivative_leaves_both_linear_charges(force: str, spring: str):
    """m (x' u - x u') - int F u dt with u'' = -w^2 u (Duhamel's integral)."""
    d = derive(
        "coordinates: [x]\nparameters: {m: {assume: positive}, w: {assume: positive}}\n"
        f'functions: {{f: [t]}}\nL: "m*x\'^2/2 - m*({spring})*x/2 + x*{force}"'
    )
    (x,), (v,), t = d.system.q, d.system.qdot, d.system.t
    acceleration = d.system.build(parse_text(f"({force})/m - {spring}"))
    charges = [c.charge for c in d.discovery.charges if c.charge.diff(v, 2) == 0]
    slopes = sympy.Matrix([[Q.diff(v), Q.diff(x)] for Q in charges])
    assert slopes.shape == (2, 2)
    assert is_zero(slopes.det()) is False
    for Q in charges:
        assert is_zero(Q.diff(t) + v * Q.diff(x) + acceleration * Q.diff(v)) is True


#: Of which the exponents may be real or complex, for some values of the parameters.
OF_EITHER_SIGN = (
    "parameters: {{m: {{assume: positive}}, k: }}\nT: {n}*m*x'^2/2\nV: k*x^2/2",
    (
        "parameters: {{m: {{assume: positive}}, k: , c: {{assume: positive}}}}\n"
        "T: m*x'^2/2\nV: k*x^2/2\ndissipation: {n}*c*x'^2/2"
    ),
    (
        "parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}\n"
        "T: m*x'^2/2\nV: {n}*m*k*x^2/(8*t^2)"
    ),
    "parameters: {{m: {{assume: positive}}, k: , w: }}\nT: m*x'^2/2\nV: (k - {n}*m*w^2)*x^2/2",
)


@pytest.mark.parametrize("n", [1, 3])
@pytest.mark.parametrize("text", OF_EITHER_SIGN)
def test_a_charge_is_real_exactly_where_it_is_said_to_be(text, n):
    """cos(sqrt(k) t) is cosh(sqrt(-k) t) where k < 0: even in the root, it is real there, too."""
    d = derive("coordinates: [x]\n" + text.format(n=n))
    draw, seen = Random(n), set()
    for charge in d.discovery.charges:
        where = real_where(charge, d.system)
        build = d.system.build
        for _ in range(30):
            letters = sorted(charge.charge.free_symbols, key=str)
            values = {s: sympy.Float(10 ** draw.uniform(-1, 0.5)) for s in letters}
            values |= {
                s: -x for s, x in values.items() if not s.is_positive and draw.random() < 0.5
            }
            values |= {d.system.t: sympy.Float(draw.uniform(0.3, 2))}
            bounds = [(build(w.left) - build(w.right)).xreplace(values) for w in where]
            found = complex(sympy.N(charge.charge.xreplace(values)))
            real = abs(found.imag) < 1e-9 * max(abs(found), 1e-9)
            assert real == all(bound > 0 for bound in bounds), (charge.charge, values)
            seen.add(real)
    assert seen == {True, False}


@pytest.mark.parametrize("drive", ["W*cos(w*t)", "W*t"])
def test_charges_at_special_values_say_where_they_are_real(drive):
    """Without the drive an oscillator is left, of which k may be negative."""
    read = read_problem(
        "p.yaml",
        f"""title: p
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, k: , W: , w: {{assume: positive}}}}
T: m*(x'^2 + y'^2)/2
V: (k + {drive})*(x^2 + y^2)/2
""".encode(),
    )
    section = solve(read.problem, ["algebra"]).sections["algebra"]
    [case] = [each for each in section.special if each.parameter == "W"]
    assert [(to_grammar(w.left), to_grammar(w.right)) for w in case.where] == [("k", "0")]
    for each in section.special:
        rooted = any("sqrt(k" in to_grammar(value) for value in each.charges.values())
        assert bool(each.where) == rooted


@pytest.mark.parametrize(
    ("spring", "wave"), [("w^2", "cos(n*t)"), ("w^2", "sin(2*n*t)"), ("9", "1")]
)
def test_a_charge_says_where_it_divides_by_zero(spring, wave):
    """Beside its resonance: a drive with the own frequency is another formula."""
    head = "title: p\ncoordinates: [x]\n"
    head += "parameters: {w: {assume: positive}, n: {assume: positive}, F: {}}\n"
    problem = read_problem("p.yaml", f"{head}L: x'^2/2 - {spring}*x^2/2 + F*x*{wave}\n".encode())
    answers = solve(problem.checked(), ["discovered"])
    build = Derivation(problem.checked()).system.build
    w, n = (build(parse_text(x)) for x in "wn")
    number = 2 if "2*n" in wave else 1
    charges = answers.sections["discovered"].charges
    for charge in charges:
        gaps = [build(c.left) - build(c.right) for c in charge.where]
        below = sympy.denom(sympy.together(build(charge.charge))).xreplace({w: number * n})
        assert bool(gaps) == (below == 0)
        assert all(is_zero(gap.xreplace({w: number * n})) is True for gap in gaps)
    assert any(charge.where for charge in charges) is (spring != "9")
    assert ("This is for" in render([answers], "text", Options())) is (spring != "9")
