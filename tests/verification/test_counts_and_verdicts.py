"""What stands beside formulas, made wrong: signs, verdicts, lists that lack one, numbers."""

from __future__ import annotations

import pytest

from lagcli.expression import Negative
from lagcli.pipeline import Request, derive, state
from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.statements.answers import AlgebraSection, Charge, ChargesSection, SpecialValue
from lagcli.statements.motions import Above
from lagcli.verification import verified

PARAMETERS = "parameters: {m: {assume: positive}, k: {assume: positive}, c: {assume: positive}}\n"
PLANE = f"coordinates: [x, y]\n{PARAMETERS}T: m*(x'^2 + y'^2)/2\n"
POLAR = f"coordinates: {{r: {{assume: positive}}, phi: }}\n{PARAMETERS}"


def sheet(text, section):
    """A problem, and its answers with one section."""
    problem = read_problem("test.yaml", text.encode()).checked()
    answers = state(derive(problem), Request(sections=(section,)))
    return problem, answers, answers.sections[section]


def printed(problem, answers, **sections):
    return verified(problem, replace(answers, sections=sections))


def above(left, right):
    return (Above(parse_text(left), parse_text(right)),)


@pytest.mark.parametrize(
    ("verdict", "kept"),
    [
        ({}, True),
        ({"asymptotic": True}, False),
        ({"stable": None, "minimum": above("m", "c"), "unstable": above("c", "m")}, False),
        ({"stable": False}, False),
    ],
)
def test_the_verdict_on_a_family_is_examined(verdict, kept):
    problem, answers, section = sheet(f"{PLANE}V: k*(x - y)^2/2\n", "equilibria")
    [only] = section.equilibria
    changed = replace(only, verdict=replace(only.verdict, **verdict))
    wrong = replace(section, equilibria=(changed,))
    found = printed(problem, answers, equilibria=wrong)
    assert found.complete is kept
    assert (found.sections["equilibria"].equilibria[0].verdict == changed.verdict) is kept


@pytest.mark.parametrize("frequency", ["-sqrt(k/m)", "sqrt(-k/m)", "sqrt(-k*(2 - sqrt(2))/m)"])
def test_a_frequency_is_real_and_not_negative(frequency):
    problem, answers, section = sheet(f"{PLANE}V: k*x^2/2 + c*y^2/2\n", "modes")
    first, *rest = section.modes
    wrong = replace(first, frequency=parse_text(frequency))
    assert printed(problem, answers, modes=section).complete
    found = printed(problem, answers, modes=replace(section, modes=(wrong, *rest)))
    assert found.sections["modes"].modes is None


@pytest.mark.parametrize(
    "text",
    [
        "L: m*((x' - w*y)^2 + (y' + w*x)^2)/2 - k*(x^2 + y^2)/2 - c*x\n",
        "L: w*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2\n",
        "L: w*x'^2/2 + m*y'^2/2 - k*(x^2 + x*y + y^2)/2\n",
    ],
)
def test_bounded_solutions_of_linear_equations_are_more_than_first_order(text):
    """A turning frame, and masses of open sign: no minimum of V is needed to say so."""
    section = "equilibria"
    given = f"coordinates: [x, y]\n{PARAMETERS.replace('}}', '}, w: {}}')}{text}"
    problem, answers, found = sheet(given, section)
    [only] = found.equilibria
    assert only.verdict.exact
    assert printed(problem, answers, equilibria=found).complete
    assert (only.verdict.stable, only.verdict.spectrum) != (None, None)


@pytest.mark.parametrize("gyroscopic", ["", " + c*(x*y' - y*x')/2"])
def test_a_frequency_is_not_listed_twice(gyroscopic):
    """Each of the two that are listed is one of the motion, and the other one is missing."""
    text = f"{PLANE.replace('T:', 'L:').strip()} - k*(x^2 + y^2)/2 - m*y^2/2{gyroscopic}\n"
    problem, answers, section = sheet(text, "modes")
    first, _ = section.modes
    assert printed(problem, answers, modes=section).complete
    found = printed(problem, answers, modes=replace(section, modes=(first, first)))
    assert found.sections["modes"].modes is None


@pytest.mark.parametrize("field", ["", " + c*r^2*phi'"])
def test_a_magnetic_field_tells_a_turn_from_its_mirror_image(field):
    text = f"{POLAR}L: m*(r'^2 + r^2*phi'^2)/2 - k*r^2/2{field}\n"
    problem, answers, section = sheet(text, "steady_motions")
    both = tuple(replace(each, mirrored=each.rates is not None) for each in section.motions)
    found = printed(problem, answers, steady_motions=replace(section, motions=both))
    assert found.complete is not bool(field)


@pytest.mark.parametrize("name", ["equation", "rate"])
def test_what_is_left_of_a_reduced_system_is_examined(name):
    text = f"{POLAR}T: m*(r'^2 + r^2*phi'^2)/2\nV: k*r^2/2\n"
    problem, answers, section = sheet(text, "reduction")
    one = section.one_freedom
    if name == "equation":
        wrong = replace(section, equations=())
    else:
        wrong = replace(section, one_freedom=replace(one, rate=Negative(one.rate)))
    assert printed(problem, answers, reduction=section).complete
    assert not printed(problem, answers, reduction=wrong).complete


def listed(**charges):
    """A section with these charges."""
    return ChargesSection(
        charges=tuple(
            Charge(
                name=name,
                source="discovered",
                transformation={},
                gauge=None,
                conserved=True,
                charge=parse_text(charge),
                rate=None,
            )
            for name, charge in charges.items()
        ),
        sought=False,
    )


@pytest.mark.parametrize(
    ("value", "number", "charge", "kept"),
    [
        ("k", 3, "x*y' - y*x'", True),
        ("4*k", 3, "x*y' - y*x'", False),
        ("-k", 3, "x*y' - y*x'", False),
        ("k", 4, "x*y' - y*x'", False),
        ("k", 3, "x*y' + y*x'", False),
        ("k", 3, "m*x'^2 + k*x^2", False),
    ],
)
def test_a_special_value_is_examined(value, number, charge, kept):
    problem, answers, _ = sheet(f"{PLANE}V: k*x^2/2 + c*y^2/2\n", "energy")
    known = listed(a="m*x'^2/2 + k*x^2/2", b="m*y'^2/2 + c*y^2/2")
    special = SpecialValue(
        parameter="c",
        value=parse_text(value),
        degree=2,
        number=number,
        charges={"n": parse_text(charge)},
    )
    section = AlgebraSection(
        ansatz="", dimension=2, name="R^2", independent=2, in_involution=2, integrable=True,
        number=2, special=(special,),
    )  # fmt: skip
    found = printed(problem, answers, discovered=known, algebra=section)
    assert found.complete is kept
    assert bool(found.sections["algebra"].special) is kept


@pytest.mark.parametrize(
    ("numbers", "kept"),
    [
        ((3, 3, 2), True),
        ((3, 2, 2), False),
        ((4, 3, 2), False),
        ((3, 3, 1), False),
        ((3, 3, 3), False),
    ],
)
def test_charges_on_a_sphere_are_counted(numbers, kept):
    """L_x, L_z and the energy: {L_x, L_z} is not 0, each commutes with the energy."""
    dimension, independent, in_involution = numbers
    text = (
        f"coordinates: [x, y, z]\n{PARAMETERS}T: m*(x'^2 + y'^2 + z'^2)/2\n"
        "constraints: {sphere: x^2 + y^2 + z^2 = c^2}\n"
    )
    problem, answers, _ = sheet(text, "energy")
    known = listed(L_x="y*z' - z*y'", L_z="x*y' - y*x'", h="x'^2 + y'^2 + z'^2")
    section = AlgebraSection(
        ansatz="", dimension=dimension, name=None, independent=independent,
        in_involution=in_involution, integrable=None, number=dimension,
    )  # fmt: skip
    assert printed(problem, answers, discovered=known, algebra=section).complete is kept


@pytest.mark.parametrize("number", [2, 3, 4])
def test_charges_give_the_state_where_there_are_as_many_as_dimensions_of_states(number):
    problem, answers, _ = sheet(f"{PLANE}V: 0\n", "energy")
    charges = {"a": "x'", "b": "y'", "c": "x - t*x'", "d": "y - t*y'"}
    section = AlgebraSection(
        ansatz="", dimension=number, name=None, independent=number, in_involution=2,
        integrable=True, number=number, determines="state",
    )  # fmt: skip
    known = listed(**dict(list(charges.items())[:number]))
    found = printed(problem, answers, discovered=known, algebra=section)
    assert found.complete is (number == 4)


@pytest.mark.parametrize("last", ["x*y' - y*x'", "x - t*x'"])
def test_charges_give_the_orbit_where_all_but_one_are_without_the_time(last):
    problem, answers, _ = sheet(f"{PLANE}V: 0\n", "energy")
    section = AlgebraSection(
        ansatz="", dimension=3, name=None, independent=3, in_involution=2,
        integrable=True, number=3, determines="orbit",
    )  # fmt: skip
    found = printed(problem, answers, discovered=listed(a="x'", b="y'", c=last), algebra=section)
    assert found.complete is ("t" not in last)


ROD = "rod: (x - u)^2 + (y - w)^2 = c^2, blade: (x' + u')*(y - w) = (y' + w')*(x - u)"
STATES = [  # the text, what as many charges as are found give
    ("[x]", "", "T: x'^2/2\nV: m*x^2/2\ndissipation: c*x'^2/2", "state"),
    ("[x, y]", "", "T: (x'^2 + y'^2)/2\nV: -m*y\ndissipation: c*(x'^2 + y'^2)/2", "state"),
    ("[x]", "", "T: x'^2/2\nV: m*x^4/2\ndissipation: c*x'^2/2", ""),
    ("[x, y, phi]", "blade: x'*sin(phi) = y'*cos(phi)", "T: m*(x'^2 + y'^2)/2 + c*phi'^2/2", "state"),
    ("[x, y, phi]", "blade: x'*sin(phi) = y'*cos(phi) - phi'", "T: m*(x'^2 + y'^2) + c*phi'^2", ""),
    ("[x, y, u, w]", ROD, "T: m*(x'^2 + y'^2 + u'^2 + w'^2)/2", "orbit"),
    ("[u, x, y, w]", ROD, "T: 3*m*(x'^2 + y'^2 + u'^2 + w'^2)", "orbit"),
]  # fmt: skip


@pytest.mark.parametrize(("coordinates", "constraint", "rest", "determines"), STATES)
def test_without_brackets_the_number_of_charges_alone_makes_a_motion_integrable(
    coordinates, constraint, rest, determines
):
    """Linear drag; the motions of a knife edge on a table are circles (Neimark and Fufaev, II.2)."""
    held = f"constraints: {{{constraint}}}\n" if constraint else ""
    text = f"coordinates: {coordinates}\n{PARAMETERS}{held}{rest}\n"
    problem, answers, algebra = sheet(text, "algebra")
    assert (algebra.in_involution or 0, algebra.integrable) == (0, bool(determines) or None)
    assert algebra.determines == determines
    assert not answers.warnings
    assert verified(problem, answers).complete


@pytest.mark.parametrize("V", ["-k/sqrt(x^2 + y^2) + a/x^2", "k/x^2 + a/y^2", "k*x^4 + a*y^4"])
def test_two_special_values_have_the_charges_of_each(V):
    """Without both forces the particle is free; the charges without one are known by then."""
    text = f"coordinates: [x, y]\nparameters: [k, a]\nT: (x'^2 + y'^2)/2\nV: {V}\n"
    _, answers, algebra = sheet(text, "algebra")
    assert not answers.warnings
    free = [s for s in algebra.special if set(s.values) == {"k", "a"}]
    assert [s.number for s in free] == [8]


@pytest.mark.parametrize("length", ["l", "2*l", "l + 1"])
def test_charges_at_a_special_value_are_examined_on_the_constraints(length):
    """Two oscillators, one of them on a string: L_z is constant for equal springs."""
    text = f"""
coordinates: [x, y, z]
parameters: {{m: {{assume: positive}}, n: {{assume: positive}}, l: {{assume: positive}}}}
T: (x'^2 + 2*y'^2 + z'^2)/2
V: m*(x^2 + ({length} - z)^2)/2 + n*y^2
constraints: {{string: x + z = {length}}}
"""
    problem = read_problem("a.yaml", text.encode()).checked()
    answers = state(derive(problem), Request(sections=("algebra",)))
    assert not answers.warnings
    special = {s.parameter for s in answers.sections["algebra"].special}
    assert special & {"m", "n"}
