"""Systems of the literature: their integrals, algebras and integrability.

Winternitz, Smorodinsky, Uhlir, Fris, Sov. J. Nucl. Phys. 4 (1967) 444 (superintegrable potentials
of the plane); Landau and Lifshitz, *Mechanics*, section 15 (b/r^2 beside a central potential);
Avron, Herbst, Simon, Ann. Phys. 114 (1978) 431 (the momentum of two charges in a magnetic field).
"""

import random

import pytest

from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.discovery.summary import summary
from lagcli.mechanics.states import is_real
from tests.oracle.constancy import digits_of

from .derived import derive

POS = "{assume: positive}"


def problem(L, coordinates="[x, y]", parameters="", more=""):
    """A problem file; parameters are positive, those after a bar have either sign."""
    positive, _, others = parameters.partition("|")
    given = [f"{p}: {POS}" for p in positive.split()] + [f"{p}: {{}}" for p in others.split()]
    return (f"{{coordinates: {coordinates}, parameters: {{{', '.join(given)}}}, "
            f'L: "{L}"{more}}}')  # fmt: skip


R = "sqrt(x^2 + y^2)"
PARABOLIC = (
    f"m*(x'^2 + y'^2)/2 + k/{R} - b*sqrt({R} + x)/{R}",
    f"m*(x'^2 + y'^2)/2 + k/{R} - b*sqrt({R} - y)/{R}",
    f"m*(x'^2 + y'^2)/2 + k/{R} - b*sqrt({R} + x)/{R} - c*sqrt({R} - x)/{R}",
    f"m*(x'^2 + y'^2)/2 - b*sqrt({R} + x)/{R}",
)


@pytest.mark.parametrize("L", PARABOLIC)
@pytest.mark.long
def test_a_root_of_r_and_x_leaves_two_integrals_of_second_degree(L):
    text = problem(L, parameters="m k b c")
    derivation = derive(text)
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (3, True)
    assert min(digits_of(derivation).values()) > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("x", "name", "algebra"),
    [("x y", "L_z", "sl(2,R) + R"), ("x y z", "L_x L_y L_z", "so(3) + sl(2,R)")],
)
def test_an_inverse_square_leaves_the_oscillators_conformal_integrals(x, name, algebra):
    square = " + ".join(f"{q}^2" for q in x.split())
    rates = " + ".join(f"{q}'^2" for q in x.split())
    text = problem(f"m*({rates})/2 - k*({square})/2 - b/({square})",
                   f"[{', '.join(x.split())}]", "m k b")  # fmt: skip
    derivation = derive(text)
    names = {c.name for c in derivation.discovery.charges}
    assert names == {"energy", *name.split(), "conformal_cos", "conformal_sin"}
    assert summary(derivation.discovery).name == algebra


@pytest.mark.long
def test_a_cone_over_the_plane_is_a_direct_sum():
    found = summary(derive(problem("m*z^2*(x'^2 + y'^2)/2 + m*z'^2/2",
                                   f"{{x: {{}}, y: {{}}, z: {POS}}}", "m")).discovery)  # fmt: skip
    assert (found.dimension, found.name) == (6, "sl(2,R) + e(2)")


@pytest.mark.parametrize("V", ["k/sqrt((x1-x2)^2 + (y1-y2)^2)", "k*((x1-x2)^2 + (y1-y2)^2)/2"])
@pytest.mark.long
def test_two_like_charges_in_a_magnetic_field_are_integrable(V):
    free = "m*(x1'^2 + y1'^2 + x2'^2 + y2'^2)/2 + B*(x1*y1' - y1*x1' + x2*y2' - y2*x2')/2"
    found = summary(derive(problem(f"{free} - {V}", "[x1, y1, x2, y2]", "m k B")).discovery)
    assert (found.in_involution, found.integrable) == (4, True)


@pytest.mark.parametrize("L", ["x'^2/2 + sqrt(-1 - x^2)", "sqrt(-1 - x^2)*x'^2/2 + y'^2/2"])
def test_a_lagrangian_that_is_never_real_has_no_answer(L):
    found = derive(problem(L, "[x, y]" if "y" in L else "[x]")).discovery
    assert found.stopped == ["no state was found at which the Lagrangian is real"]
    known = summary(found)
    assert (known.independent, known.in_involution, known.integrable) == (None, None, None)


@pytest.mark.parametrize("seed", range(4))
def test_goldfish_of_any_orientation_have_states(seed):
    """Calogero, Physica D 152 (2001) 78: L = sum x_i' ln |x_i' prod (x_i - x_k)|."""
    source = random.Random(seed)
    letters = "xyzu"[: 2 + seed % 3]
    terms = []
    for x in letters:
        factors = [f"({x} - {y})" if source.random() < 0.5 else f"({y} - {x})"
                   for y in letters if y != x]  # fmt: skip
        terms.append(f"{x}'*log({'*'.join([x + chr(39), *factors])})")
    found = summary(derive(problem(" + ".join(terms), f"[{', '.join(letters)}]")).discovery)
    assert found.notes == ()
    assert (found.dimension, found.independent, found.in_involution) == (3, 3, 2)


@pytest.mark.parametrize("L", [
    "(x'^2 + y'^2)/2 - log(x - 5)", "x'^2/2 + y'^2*sqrt(x - y - 7)",
    "-sqrt(1 - x'^2 - y'^2) + sqrt(x' - y' - 1)", "x'*log(-x') + y'*log(y'*(x - 4))*log(9 - x - y)",
])  # fmt: skip
def test_states_are_found_where_roots_and_logarithms_are_real(L):
    derivation = derive(problem(L))
    assert not derivation.discovery.stopped
    evaluate = Evaluator([derivation.system.L])
    assert all(is_real(evaluate(s)[0]) for s in derivation.dynamics.states.take(8))


SPACE = "sqrt(x^2 + y^2 + z^2)"
MONOPOLE = f"m*(x'^2 + y'^2 + z'^2)/2 + g*z*(x*y' - y*x')/({SPACE}*(x^2 + y^2))"


@pytest.mark.long
def test_keplers_problem_of_a_monopole_has_its_runge_lenz_vector():
    """McIntosh, Cisneros, J. Math. Phys. 11 (1970) 896; Zwanziger, Phys. Rev. 176 (1968) 1480."""
    V = f"g^2/(2*m*{SPACE}^2) - k/{SPACE}"
    derivation = derive(problem(f"{MONOPOLE} - ({V})", "[x, y, z]", "m k | g"))
    names = {c.name for c in derivation.discovery.charges}
    assert names == {"energy", *(f"{kind}_{x}" for kind in ("L", "runge_lenz") for x in "xyz")}
    found = summary(derivation.discovery)
    assert (found.independent, found.integrable) == (5, True)
    assert found.name.startswith("the energy and so(4) where the energy is negative")


@pytest.mark.long
def test_without_the_inverse_square_it_has_none():
    derivation = derive(problem(f"{MONOPOLE} + k/{SPACE}", "[x, y, z]", "m k | g"))
    assert {c.name for c in derivation.discovery.charges} == {"energy", "L_x", "L_y", "L_z"}


LIOUVILLE = (
    ("x^2", "y^4", "x^6", "y^2"),
    ("exp(a*x)", "y^2", "k*x", "b*y^4"),
    ("a + x^2", "b*sin(y)", "k/x^2", "cos(y)"),
    ("cosh(x)^2", "-cos(y)^2", "a*x^4", "b*y^6"),  # the plane in elliptic coordinates
    ("exp(2*x)", "exp(2*y)", "a*x", "b*y^2"),
)


@pytest.mark.parametrize(
    ("F", "G", "U", "W"),
    [LIOUVILLE[0], *(pytest.param(*each, marks=pytest.mark.long) for each in LIOUVILLE[1:])],
)
def test_systems_of_liouvilles_form_have_an_integral_of_second_degree(F, G, U, W):
    """Whittaker, *Analytical Dynamics*, section 43; Perelomov, vol. I, section 2.2."""
    text = problem(f"({F} + {G})*(x'^2 + y'^2)/2 - ({U} + {W})/({F} + {G})", parameters="a b k")
    derivation = derive(text)
    assert {c.name for c in derivation.discovery.charges} == {"energy", "charge_1"}
    assert summary(derivation.discovery).in_involution == 2


@pytest.mark.parametrize("L", ["x'^4/4", "exp(x')", "x'^6"])
def test_a_dilation_of_momentum_and_energy_by_different_powers_is_no_poincare_algebra(L):
    """[D, p] = p, [D, h] = c h: Killing's form is that of iso(1,1), where c = -1."""
    found = summary(derive(problem(L, "[x]")).discovery)
    assert (found.dimension, found.name) == (3, None)


@pytest.mark.long
def test_three_cyclic_charges_beside_rotations_are_no_euclidean_algebra():
    """so(3) + R^3 has the dimension and Killing's form of e(3)."""
    sphere = "r^2*(theta'^2 + sin(theta)^2*phi'^2)"
    found = summary(derive(problem(
        f"m*(r'^2 + {sphere})/2 + exp(r)*u'^2/2 + r^4*w'^2/2 - 1/r",
        f"{{r: {POS}, theta: {{}}, phi: {{}}, u: {{}}, w: {{}}}}", "m")).discovery)  # fmt: skip
    assert (found.dimension, found.name, found.in_involution) == (6, "so(3) + R^3", 5)


@pytest.mark.long
def test_three_bodies_in_a_plane_have_six_independent_charges():
    """Whittaker, *Analytical Dynamics*, section 155: those of Galilei.

    The angular momentum about the centre of mass is a charge of its own, and a function of them.
    """
    pairs = [("1", "2"), ("2", "3"), ("1", "3")]
    V = " + ".join(f"k/sqrt((x{a} - x{b})^2 + (y{a} - y{b})^2)" for a, b in pairs)
    free = " + ".join(f"{m}*(x{a}'^2 + y{a}'^2)/2" for m, a in zip("mbc", "123", strict=True))
    found = summary(derive(problem(f"{free} + {V}", "[x1, y1, x2, y2, x3, y3]",
                                   "m b c k")).discovery)  # fmt: skip
    assert (found.dimension, found.independent, found.integrable) == (7, 6, None)
    assert found.name == "Galilei in 2 dimensions + R, modulo constants"


@pytest.mark.long
def test_two_bodies_of_kepler_in_space_have_eleven_independent_charges():
    """Goldstein, Poole, Safko, 3rd ed., sections 3.1 and 3.9: A of the relative motion is found."""
    distance = "sqrt((x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2)"
    free = "m*(x1'^2 + y1'^2 + z1'^2)/2 + b*(x2'^2 + y2'^2 + z2'^2)/2"
    derivation = derive(problem(f"{free} + k/{distance}", "[x1, y1, z1, x2, y2, z2]", "m b k"))
    found = summary(derivation.discovery)
    assert (found.independent, found.in_involution, found.integrable) == (11, 6, True)


@pytest.mark.long
def test_three_separated_isotonic_oscillators_have_their_own_conformal_integrals():
    """Evans, Phys. Rev. A 41 (1990) 5666: with E_x, E_y and three more of second degree."""
    V = "k*(x^2 + y^2 + z^2)/2 + a/x^2 + b/y^2 + c/z^2"
    derivation = derive(problem(f"m*(x'^2 + y'^2 + z'^2)/2 - ({V})", "[x, y, z]", "m k a b c"))
    assert len(derivation.discovery.charges) == 12
    assert summary(derivation.discovery).independent == 6


@pytest.mark.long
def test_three_frequencies_are_special_where_one_is_the_sum_or_the_difference_of_two():
    """Jauch and Hill, Phys. Rev. 57 (1940) 641: commensurate frequencies have integrals of their own."""
    V = "(a*x^2 + b*y^2 + c*z^2)/2"
    derivation = derive(problem(f"m*(x'^2 + y'^2 + z'^2)/2 - {V}", "[x, y, z]", "m a b c"))
    cases = {str(c.value): len(c.charges) for c in derivation.special_cases}
    assert cases["(sqrt(a) - sqrt(b))**2"] == cases["(sqrt(a) + sqrt(b))**2"] == 1


@pytest.mark.long
@pytest.mark.parametrize(
    ("q", "V", "many"),
    [
        ("x y z u", "R^3", 4),
        ("s x y z u", "R^2", 5),
        ("x y z u", "exp(-R)/R", 4),
        ("x y z u", "R^2 + u", 3),  # so(3) and the energy: not enough
        ("s x y z u", "R^2 + x^4", 4),  # so(4) and the energy
    ],
)
def test_a_central_force_in_any_dimension_is_integrable(q, V, many):
    """k - r/2 = 2 n - 2 - (n - 2): Nekhoroshev, Trans. Moscow Math. Soc. 26 (1972) 180."""
    squares = " + ".join(f"{x}^2" for x in q.split())
    kinetic = " + ".join(f"{x}'^2" for x in q.split())
    L = f"m*({kinetic})/2 - k*({V.replace('R', f'({squares})')})"
    found = summary(derive(problem(L, f"[{', '.join(q.split())}]", "m k")).discovery)
    assert (found.in_involution, found.integrable) == (many, many == len(q.split()) or None)
