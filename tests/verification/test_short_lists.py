"""Lists that lack an entry, and claims that nothing was compared with, are noticed."""

from __future__ import annotations

import pytest

from lagcli.expression import Product
from lagcli.reader import parse_text
from lagcli.record import replace

from .test_conditions_and_lists import after, derived

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
