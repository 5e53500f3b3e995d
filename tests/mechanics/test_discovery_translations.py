"""Algebras in which linear functions of q and p are an ideal: what acts on it is named beside it.

Folland, *Harmonic Analysis in Phase Space*, section 4.1: quadratic forms act on linear ones as
matrices of sp(2 d), and the commutators with the constants are those of h(d).
"""

from itertools import combinations_with_replacement
from random import Random

import pytest
import sympy
from mpmath import mpf

from lagcli.mechanics.discovery.brackets import Structure
from lagcli.mechanics.discovery.lie_algebra import name_of
from lagcli.mechanics.discovery.summary import summary

from .derived import derive

Q, P = sympy.symbols("x y z"), sympy.symbols("p q r")
X, Y, Z, U, V, W = (*Q, *P)
TURNS = [X * V - Y * U, Y * W - Z * V, Z * U - X * W]


def structure(functions):
    """C and K of polynomials whose brackets are combinations of them and of 1."""

    def bracket(f, g):
        return sum(f.diff(a) * g.diff(b) - f.diff(b) * g.diff(a) for a, b in zip(Q, P, strict=True))

    n = len(functions)
    unknowns = sympy.symbols(f"c:{n + 1}")
    C, K = [], []
    for f in functions:
        rows, constants = [], []
        for g in functions:
            difference = bracket(f, g) - sum(
                c * h for c, h in zip(unknowns, [*functions, 1], strict=True)
            )
            [found] = sympy.linsolve(
                sympy.Poly(difference, *Q, *P).coeffs(), unknowns
            ) if difference != 0 else [(0,) * (n + 1)]  # fmt: skip
            rows.append([mpf(x.p) / x.q for x in map(sympy.Rational, found[:n])])
            constants.append(mpf(found[n].p) / found[n].q if found[n] else mpf(0))
        C.append(rows)
        K.append(constants)
    return Structure(C, K)


FAMILIES = {
    "R": ([X**2 + 2 * U**2 + 3 * Y**2 - V**2], 2),
    "R^2": ([X**2 + U**2, 3 * Y**2 + V**2 + Y * V], 2),
    "so(3)": (TURNS, 3),
    "so(3) + R": ([*TURNS, U**2 + V**2 + W**2 + 5 * (X**2 + Y**2 + Z**2)], 3),
    "sl(2,R) + R": ([U**2, X**2, X * U, Y**2 + V**2], 2),
}


@pytest.mark.parametrize("name", FAMILIES)
@pytest.mark.parametrize("seed", range(2))
def test_what_acts_on_linear_functions_is_named_beside_them(name, seed):
    """Whatever linear terms and constants the generators have, and in whatever order they come."""
    acting, d = FAMILIES[name]
    random = Random(f"{name} {seed}")
    linear = [*Q[:d], *P[:d]]
    moved = [f + sum(random.randint(-2, 2) * x for x in [*linear, 1]) for f in acting]
    sums = [x + sum(random.randint(-1, 1) * y for y in linear[:k]) for k, x in enumerate(linear)]
    functions = [*moved, *sums]
    random.shuffle(functions)
    assert name_of(structure(functions)) == f"{name} with Heisenberg h({d}), modulo constants"


def test_a_schroedinger_algebra_dilates_all_coordinates():
    everywhere = [U**2 + V**2, X**2 + Y**2, X * U + Y * V, TURNS[0], X, Y, U, V]
    assert name_of(structure(everywhere)).startswith("Schrödinger sch(2)")
    hyperbolic = [U * V, X * Y, X * U + Y * V, X * U - Y * V, X, Y, U, V]
    assert name_of(structure(hyperbolic)).startswith("sl(2,R) + so(1,1) with Heisenberg h(2)")
    in_a_part = [U**2, X**2, X * U, V**2 - Y**2, X, Y, U, V]
    name = "sl(2,R) + R with Heisenberg h(2), modulo constants"
    assert name_of(structure(in_a_part)) == name


PARTS = {  # of a coordinate a and its momentum b: generators, and what they are beside h(1)
    "h(1)": ([], ()),
    "Galilei": (["b^2"], ("R",)),
    "oscillator": (["b^2 + a^2"], ("R",)),
    "hyperbolic": (["a*b"], ("R",)),
    "sch(1)": (["b^2", "a^2", "a*b"], ("sl(2,R)",)),
}
ACTING = {
    (): "", ("R",): "R with ", ("R", "R"): "R^2 with ", ("sl(2,R)",): "sl(2,R) with ",
    ("R", "sl(2,R)"): "sl(2,R) + R with ", ("sl(2,R)", "sl(2,R)"): "so(2,2) with ",
}  # fmt: skip


@pytest.mark.parametrize(("one", "other"), [*combinations_with_replacement(PARTS, 2)])
def test_parts_with_constants_share_one_centre(one, other):
    """h(1) of x beside h(1) of y is h(2), of dimension 5, and not h(1) + h(1), of dimension 6."""
    planes = ((one, {"a": X, "b": U}), (other, {"a": Y, "b": V}))
    functions = [sympy.sympify(f).subs(at) for part, at in planes for f in PARTS[part][0]]
    acting = ACTING[tuple(sorted(PARTS[one][1] + PARTS[other][1]))]
    linear = [X, U, Y, V]
    name = f"{acting}Heisenberg h(2)"
    assert name_of(structure([*functions, *linear])) == f"{name}, modulo constants"
    # the same with W^2, a charge, for the constant
    scaled = [f * W if f in linear else f for f in [*functions, *linear]]
    assert name_of(structure([*scaled, W**2])) == name


def test_a_radical_that_does_not_commute_is_no_translation():
    """sl(2,R) acts on R^3 in iso(2,1) and on h(1) in sch(1): dimension and signature are the same."""
    assert name_of(structure([U**2, X**2, X * U, X * W, U * W, W**2])).startswith("Schrödinger")
    x, y, z = TURNS[0], X * W + Z * U, Y * W + Z * V  # boosts and a turn of (x, y, z)
    assert name_of(structure([x, y, z, U, V, W])) == "Poincaré iso(2,1)"


def test_without_the_boosts_the_momenta_are_no_heisenberg_algebra():
    """Rotations and momenta of the plane are e(2); with p_z and z beside them h(1) stands apart."""
    assert name_of(structure([TURNS[0], U, V])) == "e(2)"
    assert name_of(structure([X * U - Y * V, U, V])) == "Poincaré iso(1,1)"


LEFT, RIGHT = U - Y * W / 2, V + X * W / 2  # on the group of Heisenberg, {LEFT, RIGHT} = -W
OF_CHARGES = {
    "Heisenberg h(1)": [LEFT, RIGHT, W],
    "oscillator algebra": [LEFT, RIGHT, W, TURNS[0]],
    "oscillator algebra + R": [LEFT, RIGHT, W, TURNS[0], LEFT**2 + RIGHT**2 - 2 * W * TURNS[0]],
    "Galilei in 1 dimension": [U**2, U * W, X * W, W**2],
}


@pytest.mark.parametrize("name", OF_CHARGES)
def test_a_charge_may_be_what_the_constants_are_elsewhere(name):
    """Thurston's geometry of nil: the brackets of two translations are the third (Scott, 1983)."""
    assert name_of(structure(OF_CHARGES[name])) == name


@pytest.mark.parametrize("seed", range(3))
def test_a_centre_need_not_be_among_the_charges(seed):
    """The energy beside that of one coordinate: their difference is the other's."""
    random = Random(seed)
    one, other = [U**2, X**2, X * U], [Y**2 + V**2, W**2 + Z**2]
    mixed = [f + random.randint(1, 3) * one[random.randint(0, 2)] for f in other]
    functions = [*one, *mixed]
    random.shuffle(functions)
    assert name_of(structure(functions)) == "sl(2,R) + R^2"


LINEAR = {  # two springs in a uniform field, a Penning trap with its energy and L_z, crossed fields
    "(x'^2 + y'^2 + z'^2 - a*x^2 - b*y^2 - c*z^2)/2 + x": "R with Heisenberg h(3)",
    "(x'^2 + y'^2 + z'^2)/2 + c*(x*y' - y*x') + a^2*(x^2 + y^2 - 2*z^2)/4":
        "R^2 with Heisenberg h(3)",
    "(x'^2 + y'^2 + z'^2)/2 + c*(x*y' - y*x') + a*x": "R^2 with Heisenberg h(3)",
}  # fmt: skip


@pytest.mark.parametrize(("L", "name"), LINEAR.items())
def test_energy_and_rotations_act_on_the_solutions_of_linear_equations(L, name):
    given = ", ".join(f"{each}: {{assume: positive}}" for each in "abc")
    text = f"coordinates: [x, y, z]\nparameters: {{{given}}}\nL: {L}\n"
    found = summary(derive(text).discovery)
    assert found.name == f"{name}, modulo constants"
