"""Equilibria that are not isolated; the verdicts are those of the theorem and of counterexamples.

A family on which V is least is stable as a whole only where V rises evenly across it: with
V = x^2/(1 + y^2) a motion that starts near x = 0 escapes along y and swings ever wider, for
x^2 omega is an adiabatic invariant (Landau, Lifshitz, Mechanics, section 49).
"""

from __future__ import annotations

import random
from math import acos, asin, atan, cos, pi, sin

import pytest
import sympy

from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.reader import parse_text, read_problem

_PLANE = """
coordinates: [x, y]
parameters: {m: {assume: positive}, k: {assume: positive}, a: {assume: positive}}
T: m*(x'^2 + y'^2)/2
"""
_SPACE = _PLANE.replace("[x, y]", "[x, y, z]").replace("y'^2)", "y'^2 + z'^2)")
_ANGLES = """
coordinates: [theta, phi]
parameters: {I: {assume: positive}, k: {assume: positive}}
T: I*(theta'^2 + phi'^2)/2
"""


def derivation(text: str) -> Derivation:
    return Derivation(read_problem("test.yaml", text.encode()).checked())


def states(text: str) -> list[tuple[str, dict[str, str], tuple[str, ...], bool | None]]:
    found = equilibria(derivation(text).dynamics).equilibria
    assert found is not None
    return [
        (
            "" if e.on is None else " = ".join(map(to_grammar, e.on)),
            {name: to_grammar(value) for name, value in e.at.items()},
            e.free,
            e.verdict.stable,
        )
        for e in found
    ]


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            _PLANE + "V: k*(x^2 + y^2 - a^2)^2/4",
            [("", {"x": "0", "y": "0"}, (), False), ("x^2 + y^2 = a^2", {}, (), True)],
        ),
        (
            _PLANE + "V: -k*(x^2 + y^2 - a^2)^2/4",
            [("", {"x": "0", "y": "0"}, (), True), ("x^2 + y^2 = a^2", {}, (), False)],
        ),
        (
            _SPACE + "V: k*(x^2 + y^2 - a^2)^2/4 + k*(z - x)^2/2",
            [
                ("", {"x": "0", "y": "0", "z": "0"}, (), False),
                ("y^2 + z^2 = a^2", {"x": "z"}, (), None),
            ],
        ),
        (
            _SPACE + "V: k*(x^2 + y^2 + z^2 - a^2)^2/4",
            [
                ("", {"x": "0", "y": "0", "z": "0"}, (), False),
                ("x^2 + y^2 + z^2 = a^2", {}, (), True),
            ],
        ),
        (
            _SPACE + "V: k*(x^2 + y^2 - a^2)^2/4",
            [
                ("", {"x": "0", "y": "0"}, ("z",), False),
                ("x^2 + y^2 = a^2", {}, ("z",), True),
            ],
        ),
        # the branches of a hyperbola have no bound
        (
            _PLANE + "V: k*(x*y - a^2)^2/2",
            [("", {"x": "0", "y": "0"}, (), False), ("x*y = a^2", {}, (), None)],
        ),
        (_PLANE + "V: k*x^2/(1 + y^2)", [("", {"x": "0"}, ("y",), None)]),
        (_PLANE + "V: k*(x - y)^2/2", [("", {"x": "y"}, ("y",), True)]),
        # across this circle V rises on all of it but at x = 0
        (
            _PLANE + "V: k*x^2*(x^2 + y^2 - a^2)^2/4",
            [("", {"x": "0"}, ("y",), None), ("x^2 + y^2 = a^2", {}, (), None)],
        ),
        (
            _ANGLES + "V: -k*cos(theta - phi)",
            [
                ("", {"theta": "phi"}, ("phi",), True),
                ("", {"theta": "phi + pi"}, ("phi",), False),
            ],
        ),
    ],
)
def test_a_family_is_one_state_and_not_some_of_its_points(text, expected):
    found = states(text)
    for each in expected:
        assert each in found
    assert sum(bool(e[0]) for e in found) == sum(bool(e[0]) for e in expected)


def test_no_point_of_a_sphere_without_forces_is_told_alone():
    sphere = _SPACE + "V: 0\nconstraints: {sphere: x^2 + y^2 + z^2 = a^2}"
    assert states(sphere) == [("x^2 + y^2 + z^2 = a^2", {}, (), True)]


def test_the_modes_of_a_ring_are_along_it_and_across_it():
    found = modes(derivation(_PLANE + "V: k*(x^2 + y^2 - a^2)^2/4").dynamics).modes
    assert found is not None
    along, across = found
    assert all(m.on is not None and tuple(map(to_grammar, m.on)) == ("x^2 + y^2", "a^2")
               for m in found)  # fmt: skip
    assert to_grammar(along.frequency) == "0"
    assert {n: to_grammar(v) for n, v in along.shape.items()} == {"x": "y", "y": "-x"}
    assert to_grammar(across.frequency_squared) == "2*k*a^2/m"
    assert {n: to_grammar(v) for n, v in across.shape.items()} == {"x": "x", "y": "y"}


def test_steady_motions_on_a_ring_and_beside_it():
    text = _SPACE + "V: k*(x^2 + y^2 - a^2)^2/4"
    section, _ = steady_motions(derivation(text))
    assert section.motions is not None
    top, ring = section.motions
    assert top.verdict.stable is False
    assert tuple(map(to_grammar, ring.on)) == ("x^2 + y^2", "a^2")
    assert (
        ring.verdict.stable is True
    )  # the momentum is the same all along the ring, which is compact
    # K = V'' at any place of the ring, by hand: 2 k x_i x_j
    assert to_grammar(ring.stiffness[0][1]) == "2*k*x*y"


@pytest.mark.parametrize(
    ("potential", "ring", "place", "slope"),
    [
        # K_xy = d²V/dx dy at a place of the ring with k = 1, a = 1, by hand
        ("-a*(x^2 + y^2)/2 + k*(x^2 + y^2)^2/4", "x^2 + y^2 = 1", (-0.6, 0.8), -0.96),
        ("-a*(x^2 + y^2)/2 + k*(x^2 + y^2)^2/4", "x^2 + y^2 = 1", (0.6, 0.8), 0.96),
        ("(k*x^2 + 3*y^2 - 7*a)^2/2", "x^2 + 3 y^2 = 7", (-2.0, 1.0), -24.0),
    ],
)  # fmt: skip
def test_stiffness_on_a_ring_holds_on_both_branches(potential, ring, place, slope):
    section, _ = steady_motions(derivation(_PLANE + "V: " + potential))
    found = [m for m in section.motions or () if m.on is not None]
    values = {"x": place[0], "y": place[1], "k": 1.0, "a": 1.0, "m": 1.0, "pi": 3.14}
    left, right = (evaluated(side, values, FUNCTIONS) for m in found for side in m.on)
    assert left == pytest.approx(right), ring
    for motion in found:
        assert motion.stiffness == () or evaluated(
            motion.stiffness[0][1], values, FUNCTIONS
        ) == pytest.approx(slope, rel=1e-9)


@pytest.mark.long
def test_a_point_of_a_family_of_steady_motions_is_not_told_beside_it():
    text = _SPACE.replace("z'^2)", "(x^2 + y^2)*z'^2)") + "V: k*(x^2 + y^2 - a^2)^2/4"
    section, _ = steady_motions(derivation(text))
    assert section.motions is not None
    assert [motion.free for motion in section.motions] == [("x", "y")]


@pytest.mark.parametrize("seed", range(4))
def test_a_translation_that_changes_no_force_moves_an_equilibrium_that_is_seen(seed):
    """V of three combinations of four coordinates, without a closed solution: V = sum cosh + V4."""
    source = random.Random(seed)
    a, b, c = (source.choice([-3, -2, -1, 1, 2, 3]) for _ in range(3))
    u, v, w = f"(x - {a}*s)", f"(y - {b}*s)", f"(z - {c}*s)"
    [state] = states(
        "coordinates: [x, y, z, s]\nT: (x'^2 + y'^2 + z'^2 + s'^2)/2\n"
        f"V: exp({u} + {v}) - {u} - {v} + cosh({v} - 2*{w}) + {u}^2*{w}^2 + {u}^2\n"
    )
    assert state[2] == ("s",)
    assert state[1] == {
        n: {1: "s", -1: "-s"}.get(k, f"{k}*s") for n, k in zip("xyz", (a, b, c), strict=True)
    }
    assert state[3] is True


def test_a_pole_of_a_sphere_is_not_judged_apart_from_all_other_places_of_rest():
    text = "coordinates: [theta, phi]\nT: (theta'^2 + sin(theta)^2*phi'^2)/2\nV: 0*theta\n"
    section, _ = steady_motions(derivation(text))
    assert section.motions is not None
    assert all(motion.rates is not None for motion in section.motions)


@pytest.mark.long
def test_an_equilibrium_in_decimals_is_kept_where_one_is_worked_out_of_another():
    """One of three, all found in Cartesian coordinates: x = u + v²/2 in a turning trap."""
    found = states(
        "coordinates: [u, v]\n"
        "T: ((u' + v*v' - v/4)^2 + (v' + (u + v^2/2)/4)^2)/2\n"
        "V: -2*(u + v^2/2)^2 + 7*v^2/10 + ((u + v^2/2)^2 + v^2)^2\n"
        "dissipation: 3*((u' + v*v' - v/4)^2 + (v' + (u + v^2/2)/4)^2)/4\n"
    )
    assert [stable for _, _, _, stable in found] == [False, True, True]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_a_spring_between_free_bodies_is_at_rest_at_its_length(seed):
    """The family is compact up to translations; the modes are those in relative coordinates."""
    names = ["x", "y"] if seed else ["y", "x"]
    a, b = ([f"{name}{body}" for name in names] for body in "12")
    square = " + ".join(f"({p} - {q})^2" for p, q in zip(a, b, strict=True))
    text = (
        (
            f"coordinates: [{', '.join(a + b)}]\n"
            "parameters: {m1: P, m2: P, k: P, l: P}\n"
            f"points: {{a: {{position: [{', '.join(a)}], mass: m1}}, "
            f"b: {{position: [{', '.join(b)}], mass: m2}}}}\n"
            f"V: k*(sqrt({square}) - l)^2/2\n"
        )
        .replace("P,", "{assume: positive},")
        .replace("P}", "{assume: positive}}")
    )
    [state] = states(text)
    assert state[3] is True
    found = modes(derivation(text).dynamics).modes
    assert found is not None
    assert [(mode.multiplicity, len(mode.more_shapes)) for mode in found] == [(3, 2), (1, 0)]
    source = random.Random(seed)
    angle, m1, m2 = source.uniform(0, 6), source.uniform(1, 2), source.uniform(1, 2)
    values = {"k": 1.3, "l": 0.8, "m1": m1, "m2": m2, a[0]: 0.8 * cos(angle) + 2.0,
              a[1]: 0.8 * sin(angle) - 1.0, b[0]: 2.0, b[1]: -1.0}  # fmt: skip
    shape = {n: evaluated(e, values, FUNCTIONS) for n, e in (found[1].shape or {}).items()}
    for one, other, way in zip(a, b, (cos(angle), sin(angle)), strict=True):
        assert m1 * shape[one] == pytest.approx(-m2 * shape[other])
        assert shape[one] * way == pytest.approx(shape[a[0]] / cos(angle) * way**2)


@pytest.mark.parametrize(
    "potential",
    [
        "g*(cos(x)*cos(y) - cos(x) - cos(y))",
        "g*(3*cos(x) - cos(y) - 3*cos(x)*cos(y))",
        "k*x^2*y^2",
        "k*x^2*(x - 1)^2*sin(y)^2",
        "g*sin(x)^2*sin(y)^2",
    ],
)
def test_no_equilibrium_is_listed_that_is_one_of_a_family(potential):
    text = (
        "coordinates: [x, y]\nparameters: {g: {assume: positive}, k: {assume: positive}}\n"
        f"T: (x'^2 + y'^2)/2\nV: {potential}\n"
    )
    places = [dict(point.values) for point in RestPoints(derivation(text).dynamics).points]
    assert any(len(place) == 1 for place in places)
    for one in places:
        assert not any(other.items() < one.items() for other in places)


_ON_A_CURVE = """
coordinates: [x, y]
parameters: [a, b, k, m]
T: {T}
V: {V}
constraints: {{c: "{A}*x' + {B}*y' = 0"}}
"""


@pytest.mark.parametrize(
    ("T", "V", "A", "B"),
    [
        ("tan(a)*x'*y'", "sin(x)*a*(b + k)*a/(y + a)", "cos(x)", "(x - y)"),
        ("(x - a)*x'^2/2 + y'^2/2 + y*x'", "cos(x)*y + a*x^2", "m*x", "y"),
        ("(x'^2 + y'^2)/2", "k*(x^2 + y^4)/2 + b*x*y", "(1 + y^2)", "(x + a)"),
    ],
)
def test_the_stiffness_is_the_change_of_the_force_along_the_curve(
    T: str, V: str, A: str, B: str
) -> None:
    """K = -d(F . u)/ds with dq/ds = u(q), A u = 0, by differences, on a branch with a long root."""
    dynamics = derivation(_ON_A_CURVE.format(T=T, V=V, A=A, B=B)).dynamics
    rest = RestPoints(dynamics)
    point = next(p for p in rest.points or () if p.free)
    linear = Linearization(rest, point)
    (independent,) = linear.independent
    K, h = linear.K[0][0], 1e-4
    x, y = dynamics.system.q
    ((unknown, root),) = point.values.items()
    parameters = sorted((K.free_symbols | root.free_symbols) - {x, y}, key=str)
    known = {s: 0.7 + 0.2 * n for n, s in enumerate(parameters)} | {point.free[0]: 1.3}
    here = {**known, unknown: complex(root.evalf(subs=known))}
    names = {s.name: s for s in (x, y, *parameters)} | {"sqrt": sympy.sqrt}
    V_, A_, B_ = (sympy.sympify(text, names) for text in (V, A, B))
    number = {s: v for s, v in known.items() if s in parameters}
    velocity = [1, -A_ / B_] if independent == x else [-B_ / A_, 1]
    force = -(V_.diff(x) * velocity[0] + V_.diff(y) * velocity[1]).xreplace(number)
    u = [sympy.sympify(v).xreplace(number) for v in velocity]

    def work(step: float) -> complex:
        """F . u after a step of Runge and Kutta's third order along the curve."""

        def slope(q: list[complex]) -> list[complex]:
            return [complex(v.evalf(subs=dict(zip((x, y), q, strict=True)))) for v in u]

        q = [complex(here[x]), here[y]]
        k1 = slope(q)
        k2 = slope([a + step * v / 2 for a, v in zip(q, k1, strict=True)])
        k3 = slope([a + step * (2 * w - v) for a, v, w in zip(q, k1, k2, strict=True)])
        q = [a + step * (p + 4 * r + s) / 6 for a, p, r, s in zip(q, k1, k2, k3, strict=True)]
        return complex(force.evalf(subs=dict(zip((x, y), q, strict=True))))

    assert abs(work(0)) < 1e-9
    by_differences = -(work(h) - work(-h)) / (2 * h)
    assert complex(K.evalf(subs=known)) == pytest.approx(by_differences, rel=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_where_a_root_or_a_logarithm_in_L_is_not_real_there_is_no_equilibrium(seed: int) -> None:
    """On m x x' + y y' = 0 the force cos(x) along y balances at y = 0, x = -pi/2 and pi/2."""
    random_ = random.Random(seed)
    term = random_.choice(("a*x*sqrt(x)", "a*log(x)", "a*x^2*log(3*x)", "a*sqrt(x)"))
    shift = random_.choice(("0", "x'*y"))
    text = _ON_A_CURVE.format(
        T=f"(x'^2 + y'^2)/2 + {shift}", V=f"cos(x)*y + {term}", A="m*x", B="y"
    )
    found = [place for _, place, *_ in states(text)]
    assert {"x": "pi/2", "y": "0"} in found
    assert {"x": "-pi/2", "y": "0"} not in found


def sine(u: float) -> tuple[float, float]:
    """Both angles with this sine."""
    return asin(u), pi - asin(u)


@pytest.mark.parametrize(
    ("relation", "angles"),
    [
        ("r*sin(a) = l*sin(b)", lambda u, _v: sine(u)),
        ("r*cos(a) = l*sin(b)", lambda u, _v: (acos(u), -acos(u))),
        ("r*sin(a) = l*cos(b) + h", lambda _u, v: sine(v)),
        ("r*tan(a) = l*sin(b)", lambda u, _v: (atan(u), pi + atan(u))),
        ("r*sin(2*a) = l*sin(b)", lambda u, _v: [a / 2 for a in sine(u)]),
    ],
)
def test_a_linkage_at_rest_anywhere_moves_as_its_loop_demands_on_both_branches(relation, angles):
    """Of f(a, b) = 0 the displacements obey f_a a' + f_b b' = 0."""
    text = (
        "coordinates: [a, b]\nparameters: {J: P, K: P, r: P, l: P, h: {}}\n"
        f"T: (J*a'^2 + K*b'^2)/2\nconstraints: {{loop: {relation}}}\n"
    ).replace("P", "{assume: positive}")
    [mode] = modes(derivation(text).dynamics).modes or ()
    left, right = (parse_text(side) for side in relation.split(" = "))
    values = {"r": 1.1, "l": 0.6, "h": 0.2, "pi": pi}

    def gap(a: float, b: float) -> float:
        here = {**values, "a": a, "b": b}
        return evaluated(left, here, FUNCTIONS) - evaluated(right, here, FUNCTIONS)

    for a in angles(0.6 * sin(0.4) / 1.1, (0.6 * cos(0.4) + 0.2) / 1.1):
        assert gap(a, 0.4) == pytest.approx(0, abs=1e-12)
        shape = mode.shape or {}
        u, v = (evaluated(shape[n], {**values, "a": a, "b": 0.4}, FUNCTIONS) for n in "ab")
        step = 1e-5 / (abs(u) + abs(v))
        change = gap(a + step * u, 0.4 + step * v) - gap(a - step * u, 0.4 - step * v)
        assert change == pytest.approx(0, abs=1e-12)
