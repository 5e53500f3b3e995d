"""Lists that lack an entry, and claims that nothing was compared with, are noticed."""

from __future__ import annotations

import pytest

from lagcli.expression import Product
from lagcli.formatters.grammar import to_grammar
from lagcli.reader import parse_text
from lagcli.record import replace
from lagcli.verification import verified

from .sheets import derived as of_library
from .test_conditions_and_lists import HOOPS, after, derived

BALL = "T: m*(x'^2 + sin(x)^2*y'^2)/2\nV: -k*cos(x)"


@pytest.mark.parametrize("V", ["k*x^2/2", "-k*cos(x)", "k*x^4 + b*x^2", "b*cosh(x)", "k*abs(x)"])
def test_a_turning_point_that_is_left_out_is_missed(V: str) -> None:
    problem, answers, section = derived("x", f"T: m*x'^2/2\nV: {V}", "reduction")
    one = section.one_freedom
    noticed = 0
    for left_out in one.turning_points:
        kept = tuple(each for each in one.turning_points if each != left_out)
        short = replace(one, turning_points=kept)
        _, warnings = after(problem, answers, replace(section, one_freedom=short))
        noticed += any("turning points" in each for each in warnings)
    assert noticed == min(2, len(one.turning_points))  # at random energies two are real


@pytest.mark.parametrize("left_out", range(3))
def test_a_steady_motion_that_is_left_out_is_missed(left_out: int) -> None:
    problem, answers, section = derived("x, y", BALL, "steady_motions")
    assert len(section.motions) == 3
    assert section.complete
    motions = tuple(m for k, m in enumerate(section.motions) if k != left_out)
    found, warnings = after(problem, answers, replace(section, motions=motions))
    assert not found.complete
    assert any("no other steady motion" in each for each in warnings)


@pytest.mark.parametrize("section", ["equilibria", "steady_motions"])
@pytest.mark.parametrize("turns", ["{}", "{} + 2*pi", "{} - 4*pi"])
@pytest.mark.parametrize("twice", range(3))
def test_a_place_that_is_listed_twice_is_left_out(section: str, turns: str, twice: int) -> None:
    T, V = HOOPS[0].split("|")
    problem, answers, found = derived("x", f"T: {T}\nV: {V}", section)
    field = "motions" if section == "steady_motions" else "equilibria"
    listed = getattr(found, field)
    x = parse_text(turns.format(f"({to_grammar(listed[twice].at['x'])})"))
    whole = (*listed, replace(listed[twice], at={"x": x}))
    after_it, warnings = after(problem, answers, replace(found, **{field: whole}))
    assert getattr(after_it, field) == listed
    assert any("listed twice" in each for each in warnings)


def test_a_family_that_is_listed_twice_is_left_out() -> None:
    problem, answers, found = derived("x, y", BALL, "steady_motions")
    [turning] = [each for each in found.motions if each.rates is not None]
    whole = replace(found, motions=(*found.motions, turning))
    after_it, _ = after(problem, answers, whole)
    assert after_it.motions == found.motions


def test_rolling_motions_of_other_velocities_are_not_the_same() -> None:
    """A homogeneous ball on a level plane spins about the normal, or rolls about a fixed axis."""
    spin = "phi' + psi'*cos(theta)"
    wx, wy = (
        f"theta'*{a} {s} psi'*sin(theta)*{b}"
        for a, s, b in (("cos(phi)", "+", "sin(phi)"), ("sin(phi)", "-", "cos(phi)"))
    )
    _, _, section = derived(
        "x, y, phi, theta, psi",
        f"T: m*(x'^2 + y'^2)/2 + k*(({wx})^2 + ({wy})^2 + ({spin})^2)/5\n"
        f"constraints: {{roll_x: x' = b*({wy}), roll_y: y' = -b*({wx})}}",
        "steady_motions",
    )
    assert section.motions


def test_places_half_a_turn_apart_are_two_also_where_the_laws_repeat() -> None:
    physics = "T: m*(x'^2 + x^2*y'^2 + x^2*sin(y)^2*z'^2)/2\nV: k*x^2/2"
    positive = "{x: {assume: positive}, y: {}, z: {}}"
    _, _, found = derived(positive, physics, "steady_motions")
    places = {to_grammar(each.at["y"]) for each in found.motions if "y" in each.at}
    assert {"pi/2", "-pi/2"} <= places


@pytest.mark.parametrize("factor", ["1.02", "0.98", "1.3", "0.5"])
@pytest.mark.parametrize("hoop", HOOPS)
def test_a_bound_of_stability_that_is_a_little_off_is_missed(hoop: str, factor: str) -> None:
    T, V = hoop.split("|")
    problem, answers, section = derived("x", f"T: {T}\nV: {V}", "equilibria")

    def moved(each):
        wrong = [replace(c, left=Product((parse_text(factor), c.left))) for c in each]
        return tuple(wrong)

    verdicts = [e.verdict for e in section.equilibria]
    assert any(v.minimum for v in verdicts)
    false = tuple(
        replace(e, verdict=replace(e.verdict, minimum=moved(e.verdict.minimum)))
        if e.verdict.minimum
        else e
        for e in section.equilibria
    )
    found, warnings = after(problem, answers, replace(section, equilibria=false))
    assert any("stability" in each for each in warnings)
    assert not any(e.verdict.minimum for e in found.equilibria)


@pytest.mark.parametrize("V", ["k*abs(x^2 - b^2)", "k*x*abs(x)", "k*abs(x) + b*x^2"])
def test_a_kink_has_no_frequency_that_could_be_left_out(V: str) -> None:
    _, _, section = derived("x", f"T: m*x'^2/2\nV: {V}", "steady_motions")
    assert section.motions


@pytest.mark.parametrize("power", [-1, 1, 2])
def test_a_steady_motion_at_a_rate_that_stays_free_is_complete(power: int) -> None:
    """dy/dz of circular orbits in the metric -f dz² + dx²/f + x² dy², f = 1 - k x^power."""
    metric = f"L: (-(1 - k*x^({power}))*z'^2 + x'^2/(1 - k*x^({power})) + x^2*y'^2)/2"
    problem, answers, section = derived("x, y, z", metric, "steady_motions")
    assert section.motions
    found, warnings = after(problem, answers, section)
    assert found == section
    assert not warnings


@pytest.mark.parametrize("drag", ["k*x'^2/8", "w*(x' - y')^2/2 + b*y'^2"])
def test_modes_of_a_damped_system_that_are_left_out_are_missed(drag: str) -> None:
    physics = f"T: m*(x'^2 + y'^2)/2\nV: k*(x^2 + y^2 + x*y)/2\ndissipation: {drag}"
    problem, answers, section = derived("x, y", physics, "modes")
    found, warnings = after(problem, answers, replace(section, modes=()))
    assert not found.complete
    assert any("normal modes about all stable equilibria" in each for each in warnings)


def test_modes_about_no_equilibrium_are_refuted() -> None:
    physics = "T: m*(x'^2 + y'^2)/2\nV: k*(x^2 + y^2)/2"
    problem, answers, section = derived("x, y", physics, "modes")
    zero, [first, *_] = parse_text("0"), section.modes
    drifting = replace(first, at={}, frequency=zero, frequency_squared=None, multiplicity=2)
    found, warnings = after(problem, answers, replace(section, modes=(drifting,)))
    assert found.modes is None
    assert any("stay there" in each for each in warnings)


@pytest.mark.long
@pytest.mark.parametrize("left_out", ["Δt = cos", "Δt = sin"])
@pytest.mark.parametrize("V", ["k*x^2/2", "-k*x^2/2", "k*x^2/2 - b*x"])
def test_conformal_symmetries_of_an_oscillator_that_are_left_out_are_missed(
    V: str, left_out: str
) -> None:
    problem, answers, section = derived("x", f"T: m*x'^2/2\nV: {V}", "discovered")
    timed = [c for c in section.charges if len(c.transformation) == 2]
    gone = timed[left_out.endswith("sin")]
    charges = tuple(c for c in section.charges if c is not gone)
    _, warnings = after(problem, answers, replace(section, charges=charges))
    assert any("point transformations" in each for each in warnings)


def test_separated_equations_without_the_energy_are_refuted() -> None:
    physics = "T: m*(x'^2 + x^2*y'^2)/2\nV: -k/x"
    problem, answers, section = derived("{x: {assume: positive}, y: }", physics, "hamilton_jacobi")
    no_energy = parse_text("sqrt(2*m*k/x - p_y^2/x^2)")
    false = replace(
        section,
        equations={"x": parse_text("p_x^2/(2*m) + p_y^2/(2*m*x^2) - k/x")},
        derivatives={**section.derivatives, "x": no_energy},
        functions={},
        cases={},
    )
    found, _ = after(problem, answers, false)
    assert found.derivatives is None


@pytest.mark.parametrize("surface", ["x^2 + y^2 = 4", "y = x^3", "x*y = w*t + 1"])
def test_a_symmetry_of_a_surface_without_a_charge_is_compared(surface: str) -> None:
    """K = -m g Δy is no total derivative along the surface."""
    physics = (
        f"T: m*(x'^2 + y'^2)/2\nV: k*y\nconstraints: {{c: {surface}}}\n"
        "symmetries: {turn: {x: -y, y: x}}"
    )
    problem, answers, section = derived("x, y", physics, "charges")
    charges = tuple(
        replace(c, charge=None, gauge=None, rate=None, conserved=True, broken_by="")
        if c.name == "turn"
        else c
        for c in section.charges
    )
    found, warnings = after(problem, answers, replace(section, charges=charges))
    assert any("'turn' is conserved" in each for each in warnings)
    assert not any(c.conserved for c in found.charges if c.name == "turn")


def test_rates_of_observables_that_are_left_out_are_missed() -> None:
    physics = "T: m*x'^2/2\nV: k*x^2/2\nobservables: {A: x*p_x, B: x^2}\nbrackets: {AB: [A, B]}"
    problem, answers, section = derived("x", physics, "brackets")
    for name in section.rates:
        found, _ = after(problem, answers, replace(section, rates={name: section.rates[name]}))
        assert found.rates is None


CIRCUITS = "T: m*(x'^2 + y'^2)/2\nV: (x^2 + y^2)/(2*k)\ndissipation: w*(x' - y')^2/2"


def test_a_wrong_shape_of_a_damped_mode_is_refuted() -> None:
    problem, answers, section = derived("x, y", CIRCUITS, "modes")
    kept, _ = after(problem, answers, section)
    assert kept.modes is not None
    assert len(kept.modes) == 2
    one, other = section.modes
    turned = (replace(one, shape=other.shape), other)
    found, warnings = after(problem, answers, replace(section, modes=turned))
    assert found.modes is None
    assert any("not that of its exponents" in each for each in warnings)


@pytest.mark.parametrize("factor", ["2", "1/2"])
def test_a_wrong_frequency_of_a_damped_mode_is_refuted_in_any_shape(factor: str) -> None:
    problem, answers, section = derived("x, y", CIRCUITS, "modes")
    for k, mode in enumerate(section.modes):
        product = Product((parse_text(factor), mode.frequency))
        wrong = replace(mode, frequency=product, shape=None)
        changed = [wrong if j == k else each for j, each in enumerate(section.modes)]
        found, warnings = after(problem, answers, replace(section, modes=tuple(changed)))
        assert found.modes is None
        assert any("an exponent is not" in each for each in warnings)


@pytest.mark.parametrize(
    ("name", "section", "field"),
    [
        ("symmetry/free-particle", "discovered", "charges"),
        ("hamiltonian/brackets-of-angular-momentum", "brackets", "brackets"),
        ("pulleys/atwood-tension", "forces", "forces"),
        ("oscillations/coupled-oscillators", "modes", "modes"),
    ],
)
def test_no_list_has_an_entry_twice(name: str, section: str, field: str) -> None:
    problem, answers = of_library(name, (section,))
    assert verified(problem, answers) is answers
    whole = answers.sections[section]
    for each in getattr(whole, field):
        twice = replace(whole, **{field: (*getattr(whole, field), each)})
        found = verified(problem, replace(answers, sections={section: twice}))
        assert not found.complete
        assert twice not in found.sections.values()
