"""Formulas of phase space, of the action and units, made wrong: they are withheld."""

from __future__ import annotations

from fractions import Fraction

import pytest

from lagcli.expression import Number, Sum
from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.reader import read_problem
from lagcli.record import replace
from lagcli.rewriting import rewritten
from lagcli.statements.answers import QuantityUnit
from lagcli.units import Unit, read_unit
from lagcli.verification import verified
from tests.marks import mostly_long

from .sheets import derived, each_spoiled

SECTIONS = {
    "hamiltonian/brackets-of-angular-momentum": "brackets",
    "hamiltonian/exchange-of-coordinates-and-momenta": "canonical",
    "hamiltonian/oscillator-by-generating-function": "canonical",
    "hamilton-jacobi/kepler-polar": "hamilton_jacobi",
    "hamilton-jacobi/force-growing-with-time": "hamilton_jacobi",
    "reduction/pendulum-period": "reduction",
}


@pytest.mark.long
@pytest.mark.parametrize(
    "name", mostly_long(SECTIONS, *(n for n in SECTIONS if "angular-momentum" not in n))
)
def test_every_formula_is_examined(name: str) -> None:
    section = SECTIONS[name]
    problem, answers = derived(name, (section,))
    assert verified(problem, answers) is answers
    texts: list[str] = []
    rewritten(answers.sections[section], lambda e: texts.append(to_grammar(e)) or e)  # type: ignore[func-returns-value]
    given = {to_grammar(e) for b in problem.brackets for e in (b.left, b.right)}
    missed = {
        texts[place]
        for place, wrong in each_spoiled(answers, section)
        if verified(problem, wrong).complete
    }
    # the sides of a bracket are those of the file; F = 0 with a constant and a condition as 0 > E
    # or p_phi^2 > 0, of which one side is changed, are as good
    assert missed <= {"0", "E", "p_phi^2", *given}


@pytest.mark.parametrize("kind", ["canonical", "extended canonical", "not canonical"])
def test_the_kind_of_a_transformation_is_examined(kind: str) -> None:
    problem, answers = derived("hamiltonian/oscillator-by-generating-function", ("canonical",))
    section = answers.sections["canonical"]
    for place, each in enumerate(section.transformations):
        other = replace(each, kind=kind)
        changed = (*section.transformations[:place], other, *section.transformations[place + 1 :])
        sheet = replace(answers, sections={"canonical": replace(section, transformations=changed)})
        found = verified(problem, sheet).sections["canonical"].transformations[place]
        assert found.kind == (kind if kind == each.kind else None)


@pytest.mark.parametrize("name", ["angular-momentum", "henon-heiles"])
def test_whether_the_equation_separates_is_examined(name: str) -> None:
    problem, answers = derived(f"hamilton-jacobi/{name}", ("hamilton_jacobi",))
    section = answers.sections["hamilton_jacobi"]
    other = replace(
        section, separable=not section.separable, obstacle=section.obstacle or problem_pair(problem)
    )
    found = verified(problem, replace(answers, sections={"hamilton_jacobi": other}))
    assert found.sections["hamilton_jacobi"].separable is None


def problem_pair(problem: object) -> tuple[str, ...]:
    return tuple(c.name for c in problem.coordinates[:2])  # type: ignore[attr-defined]


def test_each_unit_is_examined() -> None:
    problem, answers = derived("hoop", ("dimensions",))
    section = answers.sections["dimensions"]
    assert verified(problem, answers) is answers
    length = read_unit("m")
    for group in ("momenta", "forces", "multipliers", "charges"):
        for name, each in getattr(section, group).items():
            if each.unit is None:
                continue
            unit = Unit((*each.unit.factors, ("m", Fraction(1))))
            wrong = {**getattr(section, group), name: QuantityUnit(unit=unit, source="inferred")}
            sheet = replace(answers, sections={"dimensions": replace(section, **{group: wrong})})
            assert not verified(problem, sheet).complete, (group, name, length)


@pytest.mark.long
@pytest.mark.parametrize(
    "change",
    [{"dimension": 4}, {"independent": 3}, {"name": "so(3)"}, {"in_involution": 1}],
)
def test_the_algebra_is_examined(change: dict[str, object]) -> None:
    problem, answers = derived("particles/isotropic-oscillator", ("discovered", "algebra"))
    assert verified(problem, answers) is answers
    section = replace(answers.sections["algebra"], **change)
    found = verified(problem, replace(answers, sections={**answers.sections, "algebra": section}))
    left = found.sections.get("algebra")
    assert "algebra" in found.absent if left is None else getattr(left, next(iter(change))) is None
    assert not found.complete


HORIZONS = {  # Bañados, Teitelboim and Zanelli, Phys. Rev. Lett. 69 (1992) 1849; de Sitter
    "1 - r^2/l^2": "sl(2,R) + R",
    "r^2/l^2 - M": "sl(2,R) + R",
    "M - 4*r^2/l^2": "sl(2,R) + R",
}


@pytest.mark.long
@pytest.mark.parametrize("f", HORIZONS)
def test_an_algebra_is_examined_on_the_side_of_a_horizon_where_its_charges_are_real(f: str) -> None:
    """f u'^2 - r'^2/f: the charges hold sqrt(f) of one side, while the equations hold on both."""
    text = f"""{{coordinates: {{u: {{}}, r: {{assume: positive}}}},
        parameters: {{M: {{assume: positive}}, l: {{assume: positive}}}},
        L: "(-({f})*u'^2 + r'^2/({f}))/2"}}"""
    derivation = derive(read_problem("test.yaml", text.encode()).checked())
    problem = derivation.problem
    answers = statements(derivation).answers(("discovered", "algebra"))
    found = verified(problem, answers)
    assert not found.warnings
    assert found.sections["algebra"].name == HORIZONS[f]
    wrong = replace(answers.sections["algebra"], independent=2)
    sheet = replace(answers, sections={**answers.sections, "algebra": wrong})
    assert not verified(problem, sheet).complete


LISTED = ("particles/isotropic-oscillator", "central/kepler", "discovery/smorodinsky-winternitz")


@pytest.mark.long
@pytest.mark.parametrize("name", LISTED)
def test_a_symmetry_that_is_not_listed_is_noticed(name: str) -> None:
    problem, answers = derived(name, ("discovered", "algebra"))
    listed = answers.sections["discovered"]
    sought = [c for c in listed.charges if "*t)" not in to_grammar(c.charge)]  # not sin(2 w t)
    assert len(sought) > 2
    for charge in sought:
        others = tuple(each for each in listed.charges if each is not charge)
        wrong = {**answers.sections, "discovered": replace(listed, charges=others)}
        found = verified(problem, replace(answers, sections=wrong))
        assert any("no other" in w for w in found.warnings), charge.name
        assert "algebra" in found.absent, charge.name


GAUGED = {  # L, the change of x and of y, whose boundary terms the file does not give
    "velocity": ("m*(x'^2 + y'^2)/2 + b*(x*y' - y*x')/2", "1", "0"),
    "time": ("m*(x'^2 + y'^2)/2 + x'*exp(x*t)*t", "t", "0"),
    "rotated": ("m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 + x'*y^2", "-y", "x"),
    "mass that depends on the place": ("m*(x'^2 + x^2*y'^2)/2", "cos(y)", "-sin(y)/x"),
    "velocities in the change": ("m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2", "x'", "0"),
}


@pytest.mark.long
@pytest.mark.parametrize("of", GAUGED)
def test_brackets_of_charges_are_examined_without_a_given_boundary_term(of: str) -> None:
    L, dx, dy = GAUGED[of]
    text = (
        f'coordinates: [x, y]\nparameters: [m, b, k]\nL: "{L}"\n'
        f'symmetries:\n  one: {{x: "{dx}", y: "{dy}"}}\n'
        '  other: {x: "y", y: "-x"}\n  shift: {x: 0, y: 1}\n  energy: {t: 1}\n'
    )
    derivation = derive(read_problem(of, text.encode()).checked())
    problem, answers = derivation.problem, statements(derivation).answers(("brackets",))
    section = answers.sections["brackets"]
    assert len(section.brackets) == 6
    assert verified(problem, answers) is answers  # neither refuted nor "not verified"
    for place, each in enumerate(section.brackets):
        wrong = replace(each, value=Sum((each.value, Number(Fraction(1, 100)))))
        changed = (*section.brackets[:place], wrong, *section.brackets[place + 1 :])
        sheet = replace(answers, sections={"brackets": replace(section, brackets=changed)})
        assert verified(problem, sheet).sections["brackets"].brackets[place].value is None
