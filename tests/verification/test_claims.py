"""Each formula that is printed, made wrong: it is not printed, and a warning says so."""

from __future__ import annotations

import json
from math import pi, sin
from random import Random

import pytest

from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import Expression, Name, Product, opposite
from lagcli.formatters.built_in.json import to_object
from lagcli.formatters.options import Options
from lagcli.pipeline import Request, derive, render, state
from lagcli.pipeline import _statements as statements
from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.rewriting import rebuilt, rewritten
from lagcli.statements.answers import Answers, Charge, ChargesSection
from lagcli.statements.motions import Above, HamiltonJacobiSection, Verdict
from lagcli.statements.questions import Rewritten
from lagcli.verification import verified

from .sheets import derived, each_spoiled, number

SECTIONS = {
    "hoop": (
        "lagrangian",
        "equations",
        "accelerations",
        "multipliers",
        "constraint_forces",
        "momenta",
        "energy",
        "charges",
    ),
    "pendulums/double-pendulum": ("accelerations", "hamiltonian", "canonical_equations"),
    "pendulums/pendulum-cartesian": ("matrix_form", "multipliers", "constraint_forces", "forces"),
    "central/kepler": ("charges", "energy", "momenta"),
    "nonholonomic/chaplygin-sleigh": ("equations", "accelerations", "constraint_forces"),
    "central/two-bodies": ("accelerations", "charges"),
    "oscillations/damped-oscillator": ("equations", "charges", "energy"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", SECTIONS)
def test_every_formula_is_examined(name: str) -> None:
    problem, answers = derived(name, SECTIONS[name])
    assert verified(problem, answers) is answers
    for section in answers.sections:
        for place, wrong in each_spoiled(answers, section):
            found = verified(problem, wrong)
            where = f"{section}, formula {place}"
            assert found.sections[section] != wrong.sections[section], where
            assert not found.complete, where
            assert found.warnings[len(answers.warnings) :], where
            for format_name in ("json", "text", "latex"):
                assert render([found], format_name, Options())
            json.dumps(to_object(found))


PLACES = {
    "chains/coupled-pendulums": ("equilibria", "modes"),
    "classics/spherical-pendulum": ("steady_motions",),
}


@pytest.mark.long
@pytest.mark.parametrize("name", PLACES)
def test_places_frequencies_and_shapes_are_examined(name: str) -> None:
    problem, answers = derived(name, PLACES[name])
    assert verified(problem, answers) is answers
    for section in answers.sections:
        noticed = [
            not verified(problem, each).complete for _, each in each_spoiled(answers, section)
        ]
        assert sum(noticed) >= 0.3 * len(noticed), section


@pytest.mark.long
@pytest.mark.parametrize("name", ["chains/coupled-pendulums", "classics/spherical-pendulum"])
def test_a_verdict_of_stability_turned_round_is_withheld(name: str) -> None:
    problem, answers = derived(name, ("equilibria", "steady_motions"))
    for section in ("equilibria", "steady_motions"):
        listed = getattr(answers.sections[section], "equilibria", None) or getattr(
            answers.sections[section], "motions", ()
        )
        for each in listed:
            singular = getattr(each, "rates", each) is None or getattr(each, "indeterminate", ())
            if each.verdict.stable is None or singular:
                continue
            other = replace(each, verdict=Verdict(stable=not each.verdict.stable))
            key = "equilibria" if section == "equilibria" else "motions"
            wrong = replace(answers.sections[section], **{key: (other,)})
            found = verified(problem, replace(answers, sections={section: wrong}))
            [left] = getattr(found.sections[section], key)
            assert left.verdict.stable is None
            assert not found.complete


REDUCED = {"classics/spherical-pendulum": "reduction", "hoop": "model"}


@pytest.mark.long
@pytest.mark.parametrize("name", REDUCED)
def test_the_formulas_of_a_reduced_system_are_examined(name: str) -> None:
    section = REDUCED[name]
    problem, answers = derived(name, (section,))
    assert verified(problem, answers) is answers
    noticed = [not verified(problem, wrong).complete for _, wrong in each_spoiled(answers, section)]
    assert sum(noticed) >= 0.6 * len(noticed)


RANGES = {
    "contact/car-in-loop": ("kept", "loop"),
    "contact/particle-inside-sphere": ("kept",),
    "contact/stone-on-string-released": ("taut",),
    "pendulums/pendulum-over-the-top": ("horizontal", "top"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", RANGES)
def test_ranges_that_hold_too_much_are_withheld(name: str) -> None:
    problem, answers = derived(name, ("find",))
    assert verified(problem, answers) is answers
    section = answers.sections["find"]
    for question in RANGES[name]:
        answer = section.answers[question]
        for k, each in enumerate(answer.ranges):
            for side, factor in (("lower", (4, 5)), ("upper", (5, 4))):
                if getattr(each, side) is None:
                    continue
                wider = Product((number(*factor), getattr(each, side)))
                ranges = list(answer.ranges)
                ranges[k] = replace(each, **{side: wider})
                wrong = {**section.answers, question: replace(answer, ranges=tuple(ranges))}
                sheet = replace(answers, sections={"find": replace(section, answers=wrong)})
                found = verified(problem, sheet)
                assert found.sections["find"].answers[question].ranges is None, (k, side)
                assert not found.complete


FALL = """
coordinates: [x, y]
parameters: {g: {assume: positive}, u: {assume: positive}, w: {assume: positive}, k: {assume: positive}}
L: (x'^2 + y'^2)/2 - g*y
dissipation: k*x'^2/2
initial: {x': u, y': w}
find:
  landing: {where: y = 0, for: y'}
  flight: {where: y = 0, for: t}
  height: {value: y, in_terms_of: [t]}
  speed: {value: x', in_terms_of: [x]}
  stop: {where: x' = 0, for: x}
"""


@pytest.mark.parametrize("name", ["landing", "flight", "height", "speed", "stop"])
def test_what_holds_along_the_motion_alone_is_examined_on_it(name: str) -> None:
    problem = read_problem("fall.yaml", FALL.encode()).checked()
    answers = statements(derive(problem)).answers(("find",))
    assert verified(problem, answers) is answers
    section = answers.sections["find"]
    answer = section.answers[name]
    if isinstance(answer, Rewritten):
        wrong = replace(answer, value=Product((number(101, 100), answer.value)))
    else:
        spoiled = tuple(Product((number(101, 100), each)) for each in answer.solutions)
        wrong = replace(answer, solutions=spoiled)
    sheet = replace(answers, sections={"find": replace(section, answers={name: wrong})})
    assert not verified(problem, sheet).complete


@pytest.mark.parametrize("R", ["2", "3"])
def test_what_is_for_the_values_of_the_file_is_examined_with_these(R: str) -> None:
    """Of a mass without a sign the contact would hold elsewhere."""
    text = f"""
coordinates: {{r: {{assume: positive}}, phi: }}
parameters: {{m: 1, g: 10, R: {R}, v: {{value: 10, assume: positive}}}}
T: m*(r'^2 + r^2*phi'^2)/2
V: -m*g*r*cos(phi)
constraints: {{track: {{equation: R = r, multiplier: N, holds_while: N >= 0}}}}
initial: {{r: R, phi: 0, r': 0, phi': v/R}}
find: {{top: {{reaches: phi = pi, for: v}}}}
"""
    problem = read_problem("loop.yaml", text.encode()).checked()
    answers = statements(derive(problem)).answers(("find",))
    assert verified(problem, answers) is answers
    answer = answers.sections["find"].answers["top"]
    [only] = answer.ranges
    assert evaluated(only.lower, {}, FUNCTIONS) == pytest.approx(
        (50 * float(R)) ** 0.5
    )  # v^2 = 5 g R
    lower = replace(only, lower=Product((number(4, 5), only.lower)))
    wrong = {"top": replace(answer, ranges=(lower,))}
    sheet = replace(answers, sections={"find": replace(answers.sections["find"], answers=wrong)})
    assert not verified(problem, sheet).complete


def text_of(
    L: str, coordinates: str, symmetries: str, parameters: str = "m: {assume: positive}"
) -> str:
    return (
        f"coordinates: {coordinates}\nparameters: {{{parameters}}}\nL: {L}\n"
        f"symmetries:\n  candidate: {symmetries}\n"
    )


def checked(text: str, charge: Charge) -> Charge:
    problem = read_problem("problem.yaml", text.encode()).problem
    assert problem is not None
    sheet = Answers(
        title="", coordinates=(), parameters=(), degrees_of_freedom=1,
        sections={"charges": ChargesSection(charges=(charge,))},
    )  # fmt: skip
    section = verified(problem, sheet).sections["charges"]
    assert isinstance(section, ChargesSection)
    return section.charges[0]


GAUGES = {
    "x*x'*exp(-x^2)": ("1", "x*exp(-x^2)"),
    "x'*cos(x)": ("1/(1 + x^2)", "cos(x)/(1 + x^2)"),
    "x^3*x'": ("x", "x^4"),
}


@pytest.mark.parametrize("term", GAUGES)
def test_a_boundary_term_that_was_not_found_is_not_called_a_broken_symmetry(term: str) -> None:
    """A term f(x) x' of L changes nothing: what is said to be broken by it is withheld."""
    change, gauge = GAUGES[term]
    text = text_of(f"m*y'^2/2 + {term}", "[x, y]", f"{{x: {change}}}")
    charge = Charge(
        name="candidate", source="candidate", transformation={"x": parse_text(change)},
        gauge=None, conserved=False, charge=parse_text(f"({gauge})"), rate=parse_text("0"),
        broken_by="the Lagrangian",
    )  # fmt: skip
    assert checked(text, charge).charge is None
    assert not checked(text, charge).broken_by.endswith("the Lagrangian")


@pytest.mark.parametrize(
    ("gauge", "kept"), [("m*g*t", True), ("m*g*t + m", True), ("-m*g*t", False), ("0", False)]
)
def test_a_boundary_term_has_the_rate_of_the_change_of_L(gauge: str, kept: bool) -> None:
    text = text_of("m*x'^2/2 + m*g*x", "[x]", "{x: 1}", "m: {assume: positive}, g: {}")
    charge = Charge(
        name="candidate", source="candidate", transformation={"x": parse_text("1")},
        gauge=parse_text(gauge), conserved=kept or None, charge=parse_text(f"m*x' - ({gauge})"),
        rate=None,
    )  # fmt: skip
    assert (checked(text, charge).charge is not None) is kept


@pytest.mark.long
@pytest.mark.parametrize("name", ["hoop", "symmetry/projectile"])
def test_the_answers_to_questions_are_examined(name: str) -> None:
    problem, answers = derived(name, ("charges", "find"))
    assert verified(problem, answers) is answers
    for place, wrong in each_spoiled(answers, "find"):
        found = verified(problem, wrong)
        assert place != 0 or found.warnings  # a root off the motion: no state is found to try it


def test_equal_frequencies_may_grow_in_proportion_to_the_time() -> None:
    """A free particle in a rotating frame: what is at rest there leaves as v t."""
    problem, answers = derived("particles/free-particle-in-rotating-frame", ("equilibria",))
    assert verified(problem, answers) is answers


@pytest.mark.parametrize(
    "name",
    [
        "classics/spherical-pendulum",
        pytest.param("chains/coupled-pendulums", marks=pytest.mark.long),
    ],
)
def test_an_equilibrium_that_is_left_out_is_found(name: str) -> None:
    """Those of the spherical pendulum are both at poles."""
    problem, answers = derived(name, ("equilibria",))
    section = answers.sections["equilibria"]
    assert section.complete
    kept = replace(section, equilibria=section.equilibria[1:])
    found = verified(problem, replace(answers, sections={"equilibria": kept}))
    assert not found.sections["equilibria"].complete
    assert not found.complete
    assert "completeness of the equilibria could not be confirmed" in found.warnings[-1]


def test_modes_about_an_equilibrium_that_are_left_out_are_missed() -> None:
    """V has minima at 0 and at pi; those of a maximum are not missed, in a turning frame, too."""
    text = """
coordinates: [theta]
parameters: {a: {assume: positive}, b: {assume: positive}, w: {assume: positive}}
points: {bob: {position: [a*cos(w*t) + b*cos(w*t + theta), a*sin(w*t) + b*sin(w*t + theta)], mass: 1}}
V: POTENTIAL
"""
    for potential, count in (("0", 1), ("-w^2*a*b*cos(theta)^2", 2)):
        problem = read_problem("m", text.replace("POTENTIAL", potential).encode()).checked()
        answers = statements(derive(problem)).answers(("modes",))
        assert verified(problem, answers) is answers
        section = answers.sections["modes"]
        assert len({str(mode.at) for mode in section.modes}) == count
        if count == 1:
            continue
        kept = replace(section, modes=section.modes[1:])
        found = verified(problem, replace(answers, sections={"modes": kept}))
        assert not found.sections["modes"].complete
        assert "all stable equilibria" in found.warnings[-1]


@pytest.mark.parametrize("assume", ["positive", "negative", "nonzero"])
@pytest.mark.parametrize("potential", ["k*r^2", "k*(cosh(r) - 1)", "k*r^2 - k*r^4/(r^2 + 1)"])
def test_rest_on_the_border_of_what_a_coordinate_may_be_is_not_left_out(assume, potential):
    """V has its only stationary point at r = 0, which is no place of a coordinate that is not 0."""
    text = f"""
coordinates: {{r: {{assume: {assume}}}}}
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
T: m*(1 + r^2)*r'^2/2
V: {potential}
"""
    problem = read_problem("border", text.encode()).problem
    answers = state(derive(problem), Request(sections=("equilibria",)))
    assert not answers.sections["equilibria"].equilibria
    assert not answers.warnings


@pytest.mark.parametrize(("b", "c"), [(2, -1), (1, 1), (3, -2)])
def test_where_coordinates_fold_a_force_of_the_springs_is_no_equilibrium(b, c):
    """dL/dq = J^T F vanishes there by J alone: F^T F is that of the springs, which is not 0."""
    first, second = "(x - y)", f"({b}*x + y + {c}*y^2)"
    problem = read_problem(
        "folded",
        f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}}}
T: m*((x' - y')^2 + ({b}*x' + y' + 2*{c}*y*y')^2)/2
V: k*({first}^2 + 3*{second}^2)/2
""".encode(),
    ).problem
    answers = state(derive(problem), Request(sections=("equilibria",)))
    assert len(answers.sections["equilibria"].equilibria) == 2
    assert answers.complete


ROLLING = """
coordinates: [x, phi, theta]
parameters: {M: {assume: positive}, m: {assume: positive}, R: {assume: positive},
             g: {assume: positive}}
T: M*x'^2/2 + M*R^2*phi'^2/2 + m*(x'^2 + R^2*theta'^2 + 2*R*x'*theta'*cos(theta))/2
V: -m*g*R*cos(theta)
constraints: {rolling: "%s"}
"""


@pytest.mark.long
@pytest.mark.parametrize("rolling", ["x = R*phi", "phi = x/R", "2*x - 2*R*phi = 0", "x' = R*phi'"])
def test_the_momentum_of_a_coordinate_that_rolls_is_that_of_the_reduced_lagrangian(rolling):
    """p = dL/dphi' + R dL/dx' after x = R phi; half of it, or that of L alone, is refuted."""
    problem = read_problem("rolling", (ROLLING % rolling).encode()).problem
    answers = state(derive(problem), Request(sections=("reduction", "steady_motions")))
    if rolling != "x' = R*phi'":  # what rolls only so keeps its multiplier
        assert answers.sections["reduction"].routhian is not None
        assert len(answers.sections["steady_motions"].motions) == 2
    assert not any("confirmed" in warning for warning in answers.warnings)
    section = answers.sections["reduction"]
    for name in section.momenta:
        for text in ("m*R*theta'", "M*x'", f"M*R^2*{name}'"):
            momenta = {**section.momenta, name: parse_text(text)}
            wrong = replace(section, momenta=momenta)
            found = verified(problem, replace(answers, sections={"reduction": wrong}))
            assert found.sections["reduction"].routhian is None


def test_a_defective_frequency_has_one_shape() -> None:
    """x'' = -k x + c y, y'' = -k y: both frequencies are sqrt(k), and only x moves alone."""
    text = (
        "coordinates: [x, y]\nparameters: {k: {assume: positive}, c: {assume: positive}}\n"
        "T: (x'^2 + y'^2)/2\nV: k*(x^2 + y^2)/2\nforces: {x: c*y}\n"
    )
    derivation = derive(read_problem("test.yaml", text.encode()).checked())
    answers = state(derivation, Request(sections=("modes",)))
    assert answers.complete
    [mode] = answers.sections["modes"].modes
    assert (mode.multiplicity, mode.shape["y"]) == (2, parse_text("0"))


@pytest.mark.long
@pytest.mark.parametrize("name", ["classics/spherical-pendulum", "steady/sleeping-top"])
def test_frequencies_and_verdicts_at_a_pole_are_examined(name: str) -> None:
    problem, answers = derived(name, ("steady_motions",))
    assert verified(problem, answers) is answers
    section = answers.sections["steady_motions"]
    for each in (m for m in section.motions if m.rates is None):
        square = each.frequencies_squared[0]
        spoiled = [replace(each, frequencies_squared=(Product((number(2, 1), square)),))]
        if each.verdict.stable is not None:
            other = Verdict(stable=not each.verdict.stable)
            spoiled.append(replace(each, verdict=other))
        for wrong in spoiled:
            sheet = {"steady_motions": replace(section, motions=(wrong,))}
            assert not verified(problem, replace(answers, sections=sheet)).complete


@pytest.mark.parametrize(
    ("name", "changed"),
    [
        ("pulleys/atwood-tension", {"allowed": -1}),
        ("contact/mass-sliding-off-sphere", {"allowed": -1}),
        ("contact/mass-sliding-off-sphere", {"away_from": None, "towards": ""}),
    ],
)
def test_how_a_force_acts_on_a_point_is_examined(name: str, changed: dict[str, object]) -> None:
    problem, answers = derived(name, ("forces",))
    assert verified(problem, answers) is answers
    section = answers.sections["forces"]
    wrong = tuple(replace(each, **changed) for each in section.forces)
    sheet = {"forces": replace(section, forces=wrong)}
    assert not verified(problem, replace(answers, sections=sheet)).complete


def test_a_force_that_is_not_confirmed_is_not_called_redundant() -> None:
    problem, answers = derived("pulleys/atwood-tension", ("forces",))
    section = answers.sections["forces"]
    turned = tuple(replace(each, force=opposite(each.force)) for each in section.forces)
    sheet = {"forces": replace(section, forces=turned)}
    found = verified(problem, replace(answers, sections=sheet))
    assert found.sections["forces"].forces is None
    assert "redundant" not in render([found], "text", Options())


@pytest.mark.parametrize("name", ["modes", "equilibria", "hamiltonian"])
def test_a_section_with_a_name_that_means_nothing_is_withheld(name: str) -> None:
    problem, answers = derived("oscillations/coupled-oscillators", (name,))

    def renamed(node: Expression) -> Expression:
        return Name("kk") if node == Name("k") else rebuilt(node, renamed)

    wrong = replace(answers, sections=rewritten(answers.sections, renamed))
    if wrong.sections == answers.sections:  # rest is at 0
        section = answers.sections[name]
        moved = replace(section.equilibria[0], at={"x1": Name("kk"), "x2": Name("kk")})
        wrong = replace(answers, sections={name: replace(section, equilibria=(moved,))})
    found = verified(problem, wrong)
    assert not found.complete
    assert "kk" not in json.dumps({k: v for k, v in to_object(found).items() if k != "warnings"})


@pytest.mark.parametrize("name", ["hoop", "pendulums/pendulum-cartesian", "central/two-bodies"])
def test_the_number_of_degrees_of_freedom_is_examined(name: str) -> None:
    problem, answers = derived(name, ("equations",))
    assert verified(problem, answers) is answers
    found = verified(problem, replace(answers, degrees_of_freedom=answers.degrees_of_freedom + 1))
    assert found.degrees_of_freedom is None
    assert not found.complete
    assert "of freedom." not in render([found], "text", Options())


def test_the_momentum_under_its_name_has_its_sign() -> None:
    problem, answers = derived("nonholonomic/chaplygin-sleigh", ("charges",))
    section = answers.sections["charges"]
    momentum = next(each for each in section.charges if each.source == "cyclic")
    turned = replace(
        momentum,
        transformation={name: opposite(step) for name, step in momentum.transformation.items()},
        charge=opposite(momentum.charge),
        rate=opposite(momentum.rate),
    )
    charges = tuple(turned if each is momentum else each for each in section.charges)
    sheet = replace(answers, sections={"charges": replace(section, charges=charges)})
    found = verified(problem, sheet).sections["charges"].charges
    assert next(each for each in found if each.name == momentum.name).charge is None


@pytest.mark.parametrize("name", ["hoop", "nonholonomic/chaplygin-sleigh", "central/kepler"])
def test_a_charge_whose_formula_is_left_out_is_missed(name: str) -> None:
    """With its boundary term a charge is known."""
    problem, answers = derived(name, ("charges",))
    section = answers.sections["charges"]
    given = [place for place, each in enumerate(section.charges) if each.gauge is not None]
    assert given
    for place in given:
        charge = section.charges[place]
        short = replace(charge, charge=None)
        charges = (*section.charges[:place], short, *section.charges[place + 1 :])
        sheet = replace(answers, sections={"charges": replace(section, charges=charges)})
        found = verified(problem, sheet)
        assert any(f"the charge '{charge.name}'" in each for each in found.warnings)
        assert not found.complete


def test_a_charge_that_moves_is_not_called_constant() -> None:
    problem, answers = derived("symmetry/projectile", ("charges",))
    section = answers.sections["charges"]
    moving = next(each for each in section.charges if each.source == "candidate")
    wrong = replace(moving, charge=None, trivial=True)
    sheet = {"charges": replace(section, charges=(wrong,))}
    found = verified(problem, replace(answers, sections=sheet))
    assert not found.complete


@pytest.mark.long
def test_a_steady_motion_that_is_left_out_is_found() -> None:
    """Of the bead on the hoop, which has no cyclic coordinate."""
    problem, answers = derived("steady/bead-on-rotating-hoop", ("steady_motions",))
    assert verified(problem, answers) is answers
    section = answers.sections["steady_motions"]
    kept = tuple(each for each in section.motions if each.where)
    sheet = {"steady_motions": replace(section, motions=kept)}
    assert not verified(problem, replace(answers, sections=sheet)).complete


def test_that_no_place_is_reached_is_examined() -> None:
    """From rest on top of the sphere the mass leaves it, at cos(theta) = 2/3."""
    problem, answers = derived("contact/mass-sliding-off-sphere", ("find",))
    section = answers.sections["find"]
    none = {**section.answers, "lift_off": replace(section.answers["lift_off"], solutions=())}
    found = verified(problem, replace(answers, sections={"find": replace(section, answers=none)}))
    assert found.sections["find"].answers["lift_off"].solutions is None
    assert not found.complete


def test_that_nothing_is_reached_is_kept_where_it_is_so() -> None:
    """x = a cos(w t) never comes to 2 a."""
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "a: {assume: positive}}\nT: m*x'^2/2\nV: k*x^2/2\ninitial: {x: a, x': 0}\n"
        "find: {far: {where: x = 2*a, for: x}, back: {where: 2*x = -a, for: x}}\n"
    )
    derivation = derive(read_problem("test.yaml", text.encode()).checked())
    answers = state(derivation, Request(sections=("find",)))
    found = answers.sections["find"].answers
    nothing = {name: replace(each, solutions=()) for name, each in found.items()}
    wrong = replace(answers.sections["find"], answers=nothing)
    printed = verified(derivation.problem, replace(answers, sections={"find": wrong}))
    assert printed.sections["find"].answers["far"].solutions == ()
    assert printed.sections["find"].answers["back"].solutions is None


def test_frequencies_that_are_real_for_some_ratios_are_not_called_real_always() -> None:
    problem, answers = derived("stability/ziegler-pendulum", ("equilibria",))
    section = answers.sections["equilibria"]
    [only] = section.equilibria
    always = replace(only, verdict=replace(only.verdict, spectrum=(), unstable=()))
    sheet = {"equilibria": replace(section, equilibria=(always,))}
    found = verified(problem, replace(answers, sections=sheet))
    assert found.sections["equilibria"].equilibria[0].verdict.stable is None
    assert not found.complete


@pytest.mark.long
def test_the_hamiltonian_of_an_equation_that_was_not_separated_is_examined() -> None:
    problem, answers = derived("hamilton-jacobi/anisotropic-oscillator", ("hamilton_jacobi",))
    section = answers.sections["hamilton_jacobi"]
    wrong = HamiltonJacobiSection(
        hamiltonian=parse_text("p_x^2/(2*m) + kx*x^2/2"), energy=section.energy, separable=None
    )
    found = verified(problem, replace(answers, sections={"hamilton_jacobi": wrong}))
    assert found.sections["hamilton_jacobi"].hamiltonian is None


@pytest.mark.parametrize("seed", range(2))
def test_conditions_that_no_parameters_satisfy(seed: int) -> None:
    """x^2 = (a g - b h)/k needs a g > b h; with b h > a g as well it is nowhere."""
    a, b = (Random(f"{seed} {side}").randint(1, 9) for side in "ab")
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "g: {assume: positive}, h: {assume: positive}}\n"
        f"T: m*x'^2/2\nV: k*x^4/4 + ({b}*h - {a}*g)*x^2/2\n"
    )
    problem = read_problem("void", text.encode()).problem
    answers = state(derive(problem), Request(sections=("equilibria",)))
    section = answers.sections["equilibria"]
    assert section.equilibria
    assert verified(problem, answers).sections["equilibria"] == section
    void = tuple(
        replace(e, where=(*e.where, *(Above(left=c.right, right=c.left) for c in e.where)))
        for e in section.equilibria
    )
    assert void != section.equilibria
    wrong = replace(answers, sections={"equilibria": replace(section, equilibria=void)})
    found = verified(problem, wrong)
    left = found.sections["equilibria"]
    assert left.equilibria == tuple(e for e in section.equilibria if not e.where)
    assert not left.complete
    assert any("no parameters were found" in each for each in found.warnings)


@pytest.mark.parametrize("a", [2, 5])
def test_a_sine_that_is_never_below_minus_one_hides_no_other(a: int) -> None:
    """a k sin x = 2 k cos 2x: sin x = (-a ± sqrt(a² + 32))/8, of which - gives no angle."""
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "g: {assume: positive}}\n"
        f"T: m*x'^2/2\nV: k*({a}*cos(x) + sin(2*x)) + g*cos(x)\n"
    )
    problem = read_problem("sines", text.encode()).problem
    answers = state(derive(problem), Request(sections=("equilibria",)))
    section = verified(problem, answers).sections["equilibria"]
    assert section.equilibria is not None
    sine = (((a + 1) ** 2 + 32) ** 0.5 - (a + 1)) / 8
    at = dict.fromkeys(("m", "k", "g"), 1.0) | {"pi": pi}
    found = {round(sin(evaluated(e.at["x"], at, FUNCTIONS)), 9) for e in section.equilibria}
    assert found == {round(sine, 9)}
    assert [e.verdict.stable for e in section.equilibria] == [False, True]


@pytest.mark.parametrize("wave", ["-m*g*l*cos(phi)", "m*g*l*sin(phi)", "-m*g*l*cos(phi)^2"])
def test_a_period_is_kept_where_letters_may_have_any_sign(wave: str) -> None:
    """With negative masses the motion is about a maximum; the period is that of minima."""
    text = f"coordinates: [phi]\nparameters: [m, g, l]\nT: m*l^2*phi'^2/2\nV: {wave}\n"
    problem = read_problem("signs", text.encode()).checked()
    answers = statements(derive(problem)).answers(("reduction",))
    found = verified(problem, answers).sections["reduction"]
    assert found.one_freedom is not None
    assert len(found.one_freedom.periods) == len(answers.sections["reduction"].one_freedom.periods)


def test_a_period_by_the_energy_that_is_another_function_is_refuted() -> None:
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        "T: m*x'^2/2\nV: -k/cosh(x)^2\n"
    )
    problem = read_problem("wells", text.encode()).problem
    answers = state(derive(problem), Request(sections=("reduction",)))
    section = answers.sections["reduction"]
    [period] = section.one_freedom.periods
    assert period.by_energy is not None
    assert verified(problem, answers).sections["reduction"].one_freedom is not None
    small = replace(period, by_energy=parse_text("2*pi*sqrt(m/(2*k))"), energies=())
    false = replace(section, one_freedom=replace(section.one_freedom, periods=(small,)))
    found = verified(problem, replace(answers, sections={"reduction": false}))
    assert found.sections["reduction"].one_freedom is None
    assert any("not that function of the energy" in each for each in found.warnings)


@pytest.mark.parametrize("squared", [False, True])
@pytest.mark.parametrize("V", ["-k*cos(x - 1)", "k*((x - 1)^2 + (x - 1)^4)", "k*cosh(x - 1)"])
def test_a_period_that_grows_is_not_kept_as_isochronous(V: str, squared: bool) -> None:
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        f"T: m*x'^2/2\nV: {V}\n"
    )
    problem = read_problem("wells", text.encode()).problem
    answers = state(derive(problem), Request(sections=("reduction",)))
    section = answers.sections["reduction"]
    periods = tuple(
        replace(each, isochronous=True, squared=squared) for each in section.one_freedom.periods
    )
    false = replace(section, one_freedom=replace(section.one_freedom, periods=periods))
    found = verified(problem, replace(answers, sections={"reduction": false}))
    assert found.sections["reduction"].one_freedom is None
    assert any("depends on the amplitude" in each for each in found.warnings)
