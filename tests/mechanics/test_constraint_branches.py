"""Constraints with a common factor, and charges that a constraint alone makes constant."""

from __future__ import annotations

import random

import pytest

from lagcli.algebra import is_zero
from lagcli.diagnostics import ProblemError
from lagcli.formatters.json_values import plain
from lagcli.mechanics.statements import Statements

from .derived import derive, printed

FREE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
FACTORS = ("y", "x", "sin(x)", "(x - y)", "x*y", "y^2*x", "(1 + y)", "cos(y)", "x*(y - 1)")
SLOPES = ("x", "y", "2", "x*y", "cos(x)", "(1 + x^2)", "exp(y)")


@pytest.mark.long
@pytest.mark.parametrize("seed", range(10))
def test_a_factor_of_a_velocity_constraint_changes_only_the_multiplier(seed):
    """f (x' + g y') = 0 is x' + g y' = 0 where f is not 0: the same motion, lambda divided by f."""
    source = random.Random(seed)
    f, g = source.choice(FACTORS), source.choice(SLOPES)
    text = FREE + "T: m*(x'^2 + y'^2)/2\nV: k*x\nconstraints:\n  c: "
    with_factor = derive(f"{text}{f}*(x' + {g}*y') = 0")
    without = derive(f"{text}x' + {g}*y' = 0")
    relations = without.dynamics.constraints.relations
    motions = with_factor.dynamics.motion, without.dynamics.motion
    assert None not in motions
    for one, other in zip(motions[0].accelerations, motions[1].accelerations, strict=True):
        assert is_zero(one - other, relations) is True
    verdicts = [{c.name: c.conserved for c in d.noether.charges} for d in (with_factor, without)]
    assert verdicts[0] == verdicts[1]
    assert verdicts[0]["p_y"] is False
    warnings = Statements(with_factor).answers(["charges"]).warnings
    assert any("does not restrict the velocities where" in each for each in warnings)


@pytest.mark.parametrize("seed", range(10))
def test_what_holds_on_one_branch_only_is_not_claimed(seed):
    """y (x - a y) = 0: p_y is constant on y = 0 and has the rate -k a/(1 + a^2) on x = a y."""
    source = random.Random(seed)
    a = source.choice(("2", "-3", "1/2", "5"))
    order = source.choice((f"y*(x - {a}*y)", f"(x - {a}*y)*y", f"y^2*{a} - x*y"))
    d = derive(FREE + f"T: m*(x'^2 + y'^2)/2\nV: k*x\nconstraints: {{c: \"{order} = 0\"}}")
    conserved = {c.name: c.conserved for c in d.noether.charges}
    assert conserved["p_y"] is False
    assert conserved["energy"] is True
    warnings = Statements(d).answers(["charges"]).warnings
    assert any("the answers hold on each" in each for each in warnings)


@pytest.mark.parametrize("a", ["2", "-3", "1/2"])
def test_where_the_gradient_of_a_constraint_vanishes_no_answer_holds(a):
    """x² (y - a x) = 0 has the gradient 0 at x = 0: λ is 0/0 there."""
    d = derive(FREE + f"T: m*(x'^2 + y'^2)/2\nV: k*x\nconstraints: {{c: \"x^2*y = {a}*x^3\"}}")
    [warning, *_] = Statements(d).answers(["charges"]).warnings
    assert "do not hold where x = 0, since its gradient vanishes" in warning


@pytest.mark.parametrize("constraint", ["x = k", "x' = 0", "2*x - k = k^2", "x = k + t - t"])
def test_a_momentum_that_a_constraint_alone_makes_constant_is_no_result(constraint):
    d = derive(FREE + f"T: m*(x'^2 + y'^2)/2\nconstraints: {{c: \"{constraint}\"}}")
    assert [c.name for c in d.noether.charges] == ["p_y", "energy"]


@pytest.mark.parametrize(
    "V",
    ["x^2*sign(x)", "abs(x)*x*sign(y)", "sign(sin(x))*x^2", "abs(x^2 - 1)*sign(x)", "sign(x)*y"],
)
def test_no_answer_has_a_jump_that_the_grammar_cannot_say(V):
    d = derive(
        FREE + f"T: m*(x'^2 + y'^2)/2\nV: {V}\nforces: {{x: -sign(x')}}\ndissipation: abs(x')^3"
    )
    lagrange = d.dynamics.lagrange
    formulas = [*lagrange.left_sides, *lagrange.forcing, *d.dynamics.motion.accelerations]
    formulas += [c.rate for c in d.noether.charges if c.rate is not None]
    assert not any("irac" in printed(d, formula) for formula in formulas)


POSITIVE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, a: {assume: positive}, l: {assume: positive}}\n"


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_constraints_that_hold_for_some_parameters_only_are_no_contradiction(seed):
    """x = n a on x^2 + y^2 = l^2: for l > n a, however large n is."""
    source = random.Random(seed)
    n = source.choice((4, 7, 30, 200))
    line, curve = source.choice(
        [
            (f"x = {n}*a", "x^2 + y^2 = l^2"),
            (f"x = {n}*l", "x^2 + 3*y^2 = a^2"),
            (f"y - x = {n}*a", "x^2 + y^2 = l^2"),
            (f"x = {n}*a*cos(1)", "sqrt(x^2 + y^2) = l"),
            (f"x = {n}*t + {n}*a", "x^2 + y^2 = l^2"),
        ]
    )
    first, second = source.sample((line, curve), 2)
    text = f"T: m*(x'^2 + y'^2)/2\nconstraints: {{c: {first}, d: {second}}}"
    d = derive(POSITIVE + text)
    assert d.dynamics.degrees_of_freedom == 0
    assert d.dynamics.motion is not None


@pytest.mark.long
@pytest.mark.parametrize(
    ("first", "second", "proved"),
    [
        ("x = a", "x = l", True),
        ("x^2 + y^2 = l^2", "x^2 + y^2 = a^2", True),
        ("x + y = a", "2*x + 2*y = 3*a", True),
        ("y = sin(x)", "y = a + sin(x)", True),
        ("y*cos(x) = l", "y*cos(x) = a", True),
        ("x = a", "x^2 + y^2 = -l^2", True),
        ("y = 1", "cos(x) = 1 + y", False),
    ],
)
def test_only_what_is_proved_is_called_a_contradiction(first, second, proved):
    text = f"T: m*(x'^2 + y'^2)/2\nconstraints: {{c: {first}, d: {second}}}"
    with pytest.raises(ProblemError) as found:
        derive(POSITIVE + text).dynamics.degrees_of_freedom  # noqa: B018
    [mistake] = found.value.diagnostics
    assert ("cannot be satisfied" in mistake.message) is proved
    assert ("no state was found" in mistake.message) is not proved


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_where_the_rank_is_another_the_answers_do_not_hold(seed):
    """(x - a z) y = 0 and (x - a z) (z - k) = 0: rank 1 on x = a z, 2 on y = 0, z = k."""
    source = random.Random(seed)
    a = source.choice(("2", "-3", "1/2", "5"))
    factors = [f"(x - {a}*z)*y = 0", f"(x - {a}*z)*(z - k) = 0"]
    source.shuffle(factors)
    text = FREE.replace("[x, y]", "[x, y, z]") + "T: m*(x'^2 + y'^2 + z'^2)/2\nV: k*(x + y)\n"
    d = derive(f'{text}constraints: {{c1: "{factors[0]}", c2: "{factors[1]}"}}')
    assert d.dynamics.degrees_of_freedom == 1
    assert d.dynamics.redundant == ()
    assert is_zero(d.dynamics.motion.accelerations[1]) is not False
    [told] = [w for w in Statements(d).answers(["charges"]).warnings if "rank" in w]
    assert "the constraints have rank 1, not 2: the answers do not hold there" in told


@pytest.mark.long
@pytest.mark.parametrize("power", [2, 3, 4])
def test_beside_another_constraint_a_power_is_refused_too(power):
    text = FREE + 'T: m*(x\'^2 + y\'^2)/2\nconstraints: {c1: "x = k", c2: "(x - y)^%d = 0"}'
    with pytest.raises(ProblemError) as refused:
        _ = derive(text % power).dynamics.independent_constraints
    assert "the derivatives of constraint 'c2' vanish" in str(refused.value.diagnostics)


@pytest.mark.long
@pytest.mark.parametrize("a", ["2", "-3", "3/2", "5/2"])
def test_points_that_few_draws_reach_are_met(a):
    """z (z - u) = 0 and sin(z) (z - a u) = 0: rank 1 on z = 0, rank 2 at z = u = n pi."""
    text = FREE.replace("[x, y]", "[x, z, u]") + "T: m*(x'^2 + z'^2 + u'^2)/2\nV: k*x\n"
    d = derive(f'{text}constraints: {{c1: "z^2 - z*u = 0", c2: "sin(z)*(z - ({a})*u) = 0"}}')
    assert d.dynamics.redundant == ()
    [told] = [w for w in Statements(d).answers(["charges"]).warnings if "rank" in w]
    assert "the constraints have rank 1, not 2: the answers do not hold there" in told


CROSSINGS = {  # f, V, coordinates; a family of rest on one surface, and what is 0 where others cross
    "z*(z - a*x) = 0": ("z^2/2", "z", "x^2 > 0"),
    "x*y = 0": ("x", "x", "y^2 > 0"),
    "z*(z - x*y) = 0": ("a*z", "z", "x^2 > 0 and y^2 > 0"),
    "(z + a)*(z - x) = 0": ("z", "z", "(x + a)^2 > 0"),
    "sin(x) = sin(y)": ("-cos(x) - cos(y)", "x", "cos(y)^2 > 0"),
}


@pytest.mark.parametrize("constraint", CROSSINGS)
def test_a_family_of_rest_ends_where_another_surface_crosses_its_own(constraint):
    """On z (z - x y) = 0 with V = z a body at x = z = 0 falls along z = x y, with the slope y."""
    potential, at, condition = CROSSINGS[constraint]
    names = [n for n in "xyz" if n in constraint + potential + "x"]
    T = " + ".join(f"{n}'^2" for n in names)
    d = derive(
        f"{{coordinates: [{', '.join(names)}], parameters: {{a: {{assume: positive}}}}, "
        f'T: "({T})/2", V: "{potential}", constraints: {{c: "{constraint}"}}}}'
    )
    section = Statements(d).answers(["equilibria"]).sections["equilibria"]
    [family] = [each for each in section.equilibria if each.free and at in each.at]
    assert " and ".join(plain(family.where)) == condition
    assert "gradient of the constraint is not 0" in section.where


@pytest.mark.parametrize("factor", ["t", "(1 + t^2)", "exp(-t)", "t^2*(3 + t)", "1/t"])
@pytest.mark.parametrize("form", ["(x' - 2*y')", "(x - 2*y)", "x*(x' - 2*y')"])
def test_a_factor_of_the_time_alone_is_in_no_acceleration(factor, form):
    """t (x' - 2 y') = 0 is x' = 2 y': m (x'' , y'') = -(4, 2) k/5."""
    d = derive(FREE + f"T: m*(x'^2 + y'^2)/2\nV: k*x\nconstraints: {{c: \"{factor}*{form} = 0\"}}")
    found = [printed(d, a) for a in d.dynamics.motion.accelerations]
    assert found == ["-4*k/(5*m)", "-2*k/(5*m)"]


@pytest.mark.parametrize("first", [True, False])
@pytest.mark.parametrize("rest", ["(y - 2)", "(z - 5*a)", "(2 + x*y)"])
def test_a_redundant_constraint_forbids_no_displacement(first, rest):
    """z = a x^2 with (z - a x^2)(y - 2) = 0 leaves x and y free: V = m g z + k (y - 1)^2/2."""
    given = ["c: z = a*x^2", f"more: (z - a*x^2)*{rest} = 0"]
    d = derive(
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "g: {assume: positive}, a: {assume: positive}}\nT: m*(x'^2 + y'^2 + z'^2)/2\n"
        f"V: m*g*z + k*(y - 1)^2/2\nconstraints:\n  {given[not first]}\n  {given[first]}\n"
    )
    answers = Statements(d).answers(["equilibria", "multipliers"])
    [point] = answers.sections["equilibria"].equilibria
    assert plain(point.at) == {"x": "0", "y": "1", "z": "0"}
    assert point.verdict.stable
    assert not [w for w in answers.warnings if "holds where" in w]
    assert [w for w in answers.warnings if w.startswith("redundant: ")]


@pytest.mark.parametrize("rest", ["(y^2 + 1)", "(y - 2)", "y"])
def test_a_redundant_constraint_leaves_a_minimum_even_along_a_family(rest):
    """x^2 + z^2 = a^2 with V = m g z: stable up to y at z = -a, whatever is multiplied by it."""
    d = derive(
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        "a: {assume: positive}}\nT: m*(x'^2 + y'^2 + z'^2)/2\nV: m*g*z\nconstraints:\n"
        f"  c: x^2 + z^2 = a^2\n  more: (x^2 + z^2 - a^2)*{rest} = 0\n"
    )
    found = Statements(d).answers(["equilibria"]).sections["equilibria"].equilibria
    assert {plain(e.at)["z"]: e.verdict.stable for e in found} == {"a": False, "-a": True}


def refused(given):
    rows = "".join(f'  {n}: "{c}"\n' for n, c in zip("abc", given, strict=False))
    d = derive(f"coordinates: [x, y, z]\nT: (x'^2 + y'^2 + z'^2)/2\nconstraints:\n{rows}")
    with pytest.raises(ProblemError) as error:
        d.dynamics.independent_constraints  # noqa: B018 - asks whether they agree
    return error


@pytest.mark.parametrize(
    ("given", "name"),
    [
        (["z^2 = 0", "z = 0"], "a"),
        (["z*(z - x) = 0", "x = 0"], "a"),
        (["x = 1", "(x - 1)^2 + x*y - y = 0", "y = 0"], "b"),
        (["x + z = 0", "(x + z)^2 - y^2*(x + z) = 0", "y = 0"], "b"),
    ],
)
def test_constraints_that_hold_together_are_not_said_to_contradict(given, name):
    """z (z - x) = 0 holds at x = z = 0, where its gradient is 0."""
    [found] = refused(given).value.diagnostics
    assert f"derivatives of constraint '{name}' vanish where all constraints hold" in found.message


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (["z = x^2 + y^2", "z = 2*x*y"], "'a', 'b' hold together only where they touch"),
        (["x^2 + y^2 = 4", "y = 2", "z = x"], "'a', 'b' hold together only where they touch"),
        (["x^2 + y^2 + z^2 = 4", "z = 2"], "no state was found at which constraint 'b' holds"),
        (["x = y", "1 + x^2 + z^2 = 0"], "constraint 'b' cannot be satisfied"),
        (["x = 5", "x^2 + y^2 = 1"], "no state was found at which constraint 'b' holds"),
        (["x*y' = 0", "y' = 1", "x = 2"], "constraint 'b' cannot be satisfied with 'a', 'c'"),
    ],
)
def test_surfaces_that_touch_are_no_contradiction(given, said):
    """A sphere and a tangent plane share a point, where no motion can be derived from them."""
    [found] = refused(given).value.diagnostics
    assert said in found.message


def test_of_two_constraints_with_factors_one_restricts_everywhere():
    """y (x' - z') = 0 and (y - 1) (x' - z') = 0: rest at x = -z for all y, y = 0 among them."""
    d = derive(
        "coordinates: [x, y, z]\nT: (x'^2 + y'^2 + z'^2)/2\nV: x^2 + z^2\nconstraints:\n"
        "  a: y*(x' - z') = 0\n  b: (y - 1)*(x' - z') = 0\n"
    )
    section = Statements(d).answers(["equilibria"]).sections["equilibria"]
    [family] = section.equilibria
    assert plain(family.at) == {"x": "-z"}
    assert not family.where


@pytest.mark.long
def test_no_basis_is_sought_beyond_its_bounds():
    """A Gröbner basis of four forms of degree 4 in six coordinates would take hours."""
    text = """
coordinates: [x, y, z, u, v, w]
parameters: {m: {assume: positive}, l: {assume: positive}, b: {assume: positive}}
T: m*(x'^2 + y'^2 + z'^2 + u'^2 + v'^2 + w'^2)/2
constraints:
  c1: (x^2 + y^2)^2 + z^2*u^2 = l^4
  c2: x + y = b + 3*l
  c3: (x - u)^2 + (y - v)^2 + (z - w)^2 = l^2
  c4: x^3*u + y^3*v + z^3*w - l^4 = 0
"""
    with pytest.raises(ProblemError) as refused:
        _ = derive(text).dynamics.independent_constraints
    assert "no state was found" in str(refused.value.diagnostics)
