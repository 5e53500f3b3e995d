"""The verification notices what is left out, and conditions that are not those of the motions."""

from __future__ import annotations

import pytest

from lagcli.expression import ZERO, Name, Sum
from lagcli.problem_data import Problem
from lagcli.reader import read_problem
from lagcli.record import replace
from tests.solved import solve

from .omissions import derived, refuted, silent

PROMISED = (
    ("pendulums/pendulum-cartesian", ("accelerations", "multipliers", "constraint_forces")),
    ("pulleys/atwood-tension", ("accelerations", "multipliers", "forces")),
    ("reactions/round-body-on-incline", ("forces", "constraint_forces")),
    ("hoop", ("equations", "momenta", "constraint_forces", "canonical_equations", "find")),
    ("oscillations/damped-oscillator", ("equations", "charges")),
    ("classics/spherical-pendulum", ("equilibria",)),
    ("hamiltonian/brackets-of-angular-momentum", ("brackets",)),
    ("hamiltonian/oscillator-by-generating-function", ("canonical",)),
)


@pytest.mark.parametrize(("name", "sections"), PROMISED)
def test_what_a_section_promises_is_not_left_out_in_silence(
    name: str, sections: tuple[str, ...]
) -> None:
    problem, answers = derived(name, sections)
    assert set(sections) <= set(answers.sections)
    found = [path for section in sections for path in silent(problem, answers, section)]
    assert found == []


@pytest.mark.parametrize(
    "name", ["steady/conical-pendulum", "steady/circular-orbits", "steady/rolling-hoop"]
)
def test_conditions_of_steady_motions_hold_for_those_listed(name: str) -> None:
    problem, answers = derived(name, ["steady_motions"])
    section = answers.sections["steady_motions"]
    assert section.conditions
    assert not refuted(problem, answers, "steady_motions", section)
    for key, condition in section.conditions.items():
        changed = {**section.conditions, key: Sum((condition, Name(problem.parameters[0].name)))}
        other = replace(section, conditions=changed)
        assert refuted(problem, answers, "steady_motions", other)


@pytest.mark.parametrize("name", ["impact/ladder-leaves-wall", "rigid/rod-sliding-down-wall"])
def test_where_a_contact_just_touches_no_frequency_is_missed(name: str) -> None:
    """At theta = 0 the rod stands at the wall, which does not push."""
    problem, answers = derived(name, ["steady_motions"])
    section = answers.sections["steady_motions"]
    assert [motion.frequencies_squared for motion in section.motions] == [()]
    assert not refuted(problem, answers, "steady_motions", section)


@pytest.mark.parametrize("name", ["steady/bead-on-rotating-hoop", "classics/spherical-pendulum"])
def test_a_frequency_that_is_left_out_is_missed(name: str) -> None:
    problem, answers = derived(name, ["steady_motions"])
    section = answers.sections["steady_motions"]
    assert section.motions
    without = {"frequencies_squared": ()}
    for place, motion in enumerate(section.motions):
        for gone in (without, {**without, "mass": (), "velocity": (), "stiffness": ()}):
            motions = [*section.motions]
            motions[place] = replace(motion, **gone)
            other = replace(section, motions=tuple(motions))
            assert refuted(problem, answers, "steady_motions", other)


def test_the_one_degree_of_freedom_that_is_left_is_missed() -> None:
    problem, answers = derived("steady/bead-on-rotating-hoop", ["reduction"])
    section = answers.sections["reduction"]
    assert not refuted(problem, answers, "reduction", section)
    assert refuted(problem, answers, "reduction", replace(section, one_freedom=None))


def test_a_coordinate_without_a_part_of_the_principal_function_is_missed() -> None:
    problem, answers = derived("hamilton-jacobi/kepler-polar", ["hamilton_jacobi"])
    section = answers.sections["hamilton_jacobi"]
    assert not refuted(problem, answers, "hamilton_jacobi", section)
    only = {name: W for name, W in section.derivatives.items() if name != "r"}
    constants = tuple(c for c in section.constants if c != section.energy)
    other = replace(
        section, derivatives=only, equations={}, functions={}, cases={}, constants=constants
    )
    assert refuted(problem, answers, "hamilton_jacobi", other)


def test_what_nothing_damps_is_not_called_damped() -> None:
    problem, answers = derived("chains/coupled-pendulums", ["modes"])
    section = answers.sections["modes"]
    damped = [replace(mode, damped=True, decay=ZERO) for mode in section.modes]
    assert not refuted(problem, answers, "modes", section)
    assert refuted(problem, answers, "modes", replace(section, modes=tuple(damped)))


@pytest.mark.parametrize("force", ["cos(w*t)", "t^2", "cos(w*t)*x"])
def test_a_search_that_finds_none_promises_none(force: str) -> None:
    """The candidates of the file, and h with its rate, are among its own charges only."""
    text = f"""title: t
coordinates: [x]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}, w: {{assume: positive}}}}
T: m*x'^2/2
V: k*x^4/4 + x^3*{force}
symmetries: {{time: {{t: 1}}, shift: {{x: 1}}}}
"""
    problem = read_problem("t.yaml", text.encode()).problem
    assert problem is not None
    answers = solve(problem, ["charges", "discovered"])
    assert answers.sections["discovered"].charges == ()
    assert len(answers.sections["charges"].charges) == 2
    for name in "charges", "discovered":
        assert not refuted(problem, answers, name, answers.sections[name])
    without = replace(answers.sections["charges"], charges=answers.sections["charges"].charges[:1])
    assert refuted(problem, answers, "charges", without)


@pytest.mark.parametrize("section", ["equilibria", "steady_motions"])
def test_a_minimum_is_not_called_stable_to_first_order_only(section: str) -> None:
    problem, answers = derived("steady/bead-on-rotating-hoop", [section])
    whole = answers.sections[section]
    listed = "equilibria" if section == "equilibria" else "motions"
    places = getattr(whole, listed)
    weaker = [
        replace(each, verdict=replace(each.verdict, minimum=None, spectrum=each.verdict.minimum))
        if each.verdict.minimum and each.verdict.stable is None
        else each
        for each in places
    ]
    assert weaker != list(places)
    assert not refuted(problem, answers, section, whole)
    assert refuted(problem, answers, section, replace(whole, **{listed: tuple(weaker)}))


WITHOUT_A_SIGN = "m: {assume: positive}, g: {}, a: {}, b: {}, c: {assume: nonnegative}"


def in_the_plane(V: str) -> Problem:
    text = f"""title: t
coordinates: [x, y]
parameters: {{{WITHOUT_A_SIGN}}}
T: m*(x'^2 + y'^2)/2
V: {V}
"""
    return read_problem("t.yaml", text.encode()).checked()


@pytest.mark.parametrize(
    "V",
    ["m*g*y + a*x^2", "exp(x)*(a + b*c)", "b*x + c*y + (x - y)^2", "a*b*x + y^2", "(a^2 - c)*exp(x)",
     "(a + b)*x + (a - b)*y"],
)  # fmt: skip
@pytest.mark.parametrize("name", ["equilibria", "steady_motions"])
def test_special_values_of_parameters_are_not_left_out(name: str, V: str) -> None:
    """ "There is none unless a = 0" without the "unless", or with another condition."""
    problem = in_the_plane(V)
    answers = solve(problem, [name])
    section = answers.sections[name]
    assert section.unless
    assert not refuted(problem, answers, name, section)
    assert refuted(problem, answers, name, replace(section, unless=()))
    wrong = Sum((*section.unless, Name("m")))
    assert refuted(problem, answers, name, replace(section, unless=(wrong,)))


@pytest.mark.parametrize("V", ["exp(x) + y", "m*exp(x)*(c + 1) + (y - a)^2", "(a - b)*exp(x) + y"])
def test_where_no_values_of_parameters_are_special_none_are_missed(V: str) -> None:
    problem = in_the_plane(V)
    for name in ("equilibria", "steady_motions"):
        answers = solve(problem, [name])
        assert answers.sections[name].unless == ()
        assert not refuted(problem, answers, name, answers.sections[name])


@pytest.mark.parametrize("V", ["a*sign(x - 2*y)*x + k*y^2/2", "k*sign(x)*(1 + y^2)"])
def test_an_energy_that_jumps_is_undecided_and_not_missed(V: str) -> None:
    text = f"title: t\ncoordinates: [x, y]\nparameters: [m, k, a]\nT: m*(x'^2 + y'^2)/2\nV: {V}\n"
    problem = read_problem("t.yaml", text.encode()).checked()
    answers = solve(problem, ["charges"])
    energy = next(c for c in answers.sections["charges"].charges if c.name == "energy")
    assert energy.conserved is None
    assert not refuted(problem, answers, "charges", answers.sections["charges"])
    none = replace(answers.sections["charges"], charges=())
    assert refuted(problem, answers, "charges", none)
