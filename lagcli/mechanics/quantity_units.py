"""The section `dimensions`: the unit of every quantity, given or inferred."""

from __future__ import annotations

from lagcli.dimensions.demands import ACTION, LAGRANGIAN, small_parameter
from lagcli.dimensions.forms import Form, minus, unknown
from lagcli.dimensions.inference import Inference, gives_units, quantities
from lagcli.problem_data import Problem
from lagcli.statements.answers import DimensionsSection, QuantityUnit
from lagcli.units import Unit, read_unit

_ENERGY, _TORQUE = read_unit("J"), read_unit("N m")


def dimensions_section(problem: Problem) -> DimensionsSection:
    """Units as the file gives them, and what follows from them for everything else."""
    inference = Inference(problem)
    names, known = inference.demands.names, gives_units(problem)
    given = {q.name: read_unit(q.unit) for q in quantities(problem) if q.unit is not None}

    def unit(form: Form) -> QuantityUnit:
        return _stated(inference.unit(form) if known else None)

    def force(form: Form) -> QuantityUnit:
        """A torque is in N m, which an energy is not said to be."""
        found = unit(form)
        return _stated(_TORQUE) if found.unit == _ENERGY else found

    def quantity(name: str) -> QuantityUnit:
        if name in given:
            return QuantityUnit(unit=given[name], source="given")
        return unit(names[name])

    coordinates = [coordinate.name for coordinate in problem.coordinates]
    return DimensionsSection(
        units_given=known,
        coordinates={name: quantity(name) for name in coordinates},
        parameters={parameter.name: quantity(parameter.name) for parameter in problem.parameters},
        functions={name: unit(unknown("function", name)) for name in problem.functions},
        definitions={name: unit(names[name]) for name in problem.definitions},
        energy=unit(LAGRANGIAN),
        momenta={name: unit(names[f"p_{name}"]) for name in coordinates},
        forces={name: force(minus(LAGRANGIAN, names[name])) for name in coordinates},
        multipliers={c.multiplier: force(names[c.multiplier]) for c in problem.constraints},
        charges={each.name: unit(minus(ACTION, small_parameter(each)))
                 for each in problem.symmetries},
    )  # fmt: skip


def _stated(unit: Unit | None) -> QuantityUnit:
    return QuantityUnit(unit=unit, source="undetermined" if unit is None else "inferred")
