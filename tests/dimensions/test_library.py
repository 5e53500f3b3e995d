"""The library's units against its textbook answers, and against themselves.

The dimension of a multiplier is inferred from the constraint; that of its value in `expect`,
which stands in a book, is counted from the units of the parameters.  They must agree.
"""

from fractions import Fraction

import pytest

from lagcli.dimensions.check import check_dimensions
from lagcli.dimensions.demands import ACTION, LAGRANGIAN, small_parameter
from lagcli.dimensions.forms import TIME, minus, plus, unknown, unknowns
from lagcli.dimensions.inference import Inference, gives_units, quantities
from lagcli.dimensions.terms import Reader
from lagcli.problem_data import Where
from lagcli.record import replace
from tests.read import library

LIBRARY = [problem for problem in library().values() if gives_units(problem)]
by_title = pytest.mark.parametrize("problem", LIBRARY, ids=lambda problem: problem.source.name)


def textbook_answers(problem, names):
    """(name, answer, dimension it must have)."""
    expect = problem.expect
    for constraint in problem.constraints:
        if constraint.name in expect.multipliers:
            symbol = constraint.multiplier
            yield symbol, expect.multipliers[constraint.name], names[symbol]
        for q, force in expect.constraint_forces.get(constraint.name, {}).items():
            yield f"{constraint.name}.{q}", force, minus(LAGRANGIAN, names[q])
    for q, acceleration in expect.accelerations.items():
        yield f"{q}''", acceleration, plus(names[q], TIME, -2)
    for q, momentum in expect.momenta.items():
        yield f"p_{q}", momentum, minus(ACTION, names[q])
    for what, energy in (("energy", expect.energy), ("hamiltonian", expect.hamiltonian)):
        if energy is not None:
            yield what, energy, LAGRANGIAN
    for frequency in expect.modes or ():
        yield "mode", frequency, {"s": Fraction(-1)}
    for question in problem.find:
        if isinstance(question, Where):
            unknown_ = question.unknown
            for root in expect.find.get(question.name, ()):
                yield question.name, root, plus(names[unknown_.name], TIME, -unknown_.primes)


@by_title
def test_textbook_answers_have_the_inferred_dimensions(problem):
    inference = Inference(problem)
    names = inference.demands.names
    reader = Reader(dict(names) | {"energy": LAGRANGIAN})
    for what, answer, wanted in textbook_answers(problem, names):
        found = reader.form(answer)
        if found is not None:
            assert inference.form(found) == inference.form(wanted), what
    for group in reader.groups:  # and so do the terms within them
        assert len({frozenset(inference.form(t.form).items()) for t in group.terms}) == 1


def test_textbook_charges_have_the_inferred_dimensions_up_to_a_mass():
    """A charge is stated up to a constant factor, which may be the mass."""
    exact = up_to_mass = 0
    for problem in LIBRARY:
        inference = Inference(problem)
        reader = Reader(inference.demands.names)
        for symmetry in problem.symmetries:
            charge = problem.expect.charges.get(symmetry.name)
            if charge is None or isinstance(charge, str):
                continue
            wanted = inference.form(minus(ACTION, small_parameter(symmetry)))
            ratio = minus(inference.form(reader.form(charge)), wanted)
            if not unknowns(wanted):
                exact += not ratio
                up_to_mass += set(ratio) == {"kg"}
                assert set(ratio) <= {"kg"}, (problem.source.name, symmetry.name)
    assert exact > 60
    assert up_to_mass < exact / 4


def changed(problem, name, **attributes):
    """The problem with another unit of one quantity."""
    return replace(
        problem,
        coordinates=tuple(
            replace(q, **attributes) if q.name == name else q for q in problem.coordinates
        ),
        parameters=tuple(
            replace(p, **attributes) if p.name == name else p for p in problem.parameters
        ),
    )


@pytest.mark.first_quick
@by_title
def test_a_unit_that_the_others_determine_is_inferred_and_a_wrong_one_is_found(problem):
    for quantity in quantities(problem):
        if quantity.unit is None:
            continue
        without = changed(problem, quantity.name, unit=None)
        if not gives_units(without):
            continue
        inference = Inference(without)
        found = inference.form(inference.demands.names[quantity.name])
        if unknowns(found):
            continue
        assert found == Inference(problem).demands.names[quantity.name]
        wrong = changed(problem, quantity.name, unit=f"({quantity.unit}) kg^2 m/s")
        assert check_dimensions(wrong, 100), quantity.name


def test_the_library_has_units_of_every_kind():
    assert len(LIBRARY) > 100
    texts = {q.unit for problem in LIBRARY for q in quantities(problem) if q.unit}
    assert {"kg m^2", "N m", "C", "T", "V", "rad/s", "kg/s", "N/m", "m/s"} <= texts


def test_the_dimension_of_an_unspecified_function_is_inferred():
    problem = next(p for p in LIBRARY if p.functions)
    inference = Inference(problem)
    assert any(
        not unknowns(inference.form(unknown("function", name))) for name in problem.functions
    )
