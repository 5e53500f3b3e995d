"""The machine's view: a stable contract, every expression in the problem format's grammar.

One object for one file, an array for several.  The keys and their order are those of the
manual's page on output; a section that was not asked for has no key.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from lagcli.answers import (
    SECTIONS,
    AccelerationsSection,
    AlgebraSection,
    Answers,
    CanonicalSection,
    Charge,
    ChargesSection,
    ConstraintForcesSection,
    DimensionsSection,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    Equilibrium,
    HamiltonianSection,
    LagrangeEquation,
    LagrangianSection,
    MatrixFormSection,
    Mode,
    ModelSection,
    ModesSection,
    MomentaSection,
    MultipliersSection,
    QuantityUnit,
    ReductionSection,
    Section,
)
from lagcli.expression import Expression
from lagcli.forces import ForcesSection
from lagcli.formatters.findings import bounds_of
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_action import above, of_action
from lagcli.formatters.json_forces import of_forces
from lagcli.formatters.json_phase_space import of_phase_space
from lagcli.formatters.json_values import SCHEMA, Object, Value
from lagcli.formatters.options import Options
from lagcli.motions import (
    Above,
    HamiltonJacobiSection,
    OneFreedom,
    PeriodSeries,
    SteadyMotion,
    SteadySection,
)
from lagcli.phase_space import (
    BracketsSection,
    TransformationsSection,
)
from lagcli.questions import Answer, FindSection, Range, Ranges, Rewritten, Solutions

_Some = TypeVar("_Some")


def render(answers: Sequence[Answers], options: Options) -> str:
    """JSON for machines: a stable contract."""
    objects = [to_object(each) for each in answers]
    value: Value = objects[0] if len(objects) == 1 and not options.several else objects
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"


def to_object(answers: Answers) -> Object:
    """Put the answers to one file into a JSON object."""
    result: Object = {
        "schema": SCHEMA,
        "title": answers.title,
        "coordinates": answers.coordinates,
        "parameters": answers.parameters,
        "degrees_of_freedom": answers.degrees_of_freedom,
    }
    for name in SECTIONS:
        if name in answers.sections:
            result |= _section(name, answers.sections[name])
        elif name in answers.absent:
            result[name] = None
    if answers.where:
        result["where"] = _by_name(answers.where)
    return result | {"warnings": answers.warnings}


def _section(name: str, section: Section) -> Object:
    """Give the keys of one section: its own, and those that stand beside it."""
    match section:
        case AccelerationsSection():
            return _accelerations(section)
        case MultipliersSection():
            return _multipliers(section)
        case ConstraintForcesSection():
            return _constraint_forces(section)
        case _:
            return {name: _value(section)}


def _value(section: Section) -> Value:
    match section:
        case LagrangianSection():
            return _string(section.lagrangian)
        case EquationsSection():
            return _unless_none(section.equations, lambda each: [_equation(e) for e in each])
        case MatrixFormSection(mass_matrix=()):
            return None
        case MatrixFormSection():
            return {
                "mass_matrix": [_strings(row) for row in section.mass_matrix],
                "constraint_jacobian": [_strings(row) for row in section.constraint_jacobian],
                "forcing": _strings(section.forcing),
                "constraint_bias": _strings(section.constraint_bias),
                "shared": _by_name(section.shared),
            }
        case ForcesSection():
            return of_forces(section)
        case MomentaSection():
            return _unless_none(section.momenta, _by_name)
        case EnergySection():
            return {
                "function": _string(section.function),
                "conserved": section.conserved,
                "is_total_energy": section.is_total_energy,
                "reason": section.reason,
            }
        case HamiltonianSection():
            return _string(section.hamiltonian)
        case CanonicalSection():
            return _unless_none(
                section.equations,
                lambda pairs: {
                    coordinate: {"q": to_grammar(pair.q), "p": to_grammar(pair.p)}
                    for coordinate, pair in pairs.items()
                },
            )
        case BracketsSection() | TransformationsSection():
            return of_phase_space(section)
        case ChargesSection():
            return [_charge(each) for each in section.charges] if section.sought else None
        case AlgebraSection():
            return {
                "ansatz": section.ansatz,
                "dimension": section.dimension,
                "dimension_counts": section.dimension_counts,
                "name": section.name,
                "independent": section.independent,
                "in_involution": section.in_involution,
                "integrable": section.integrable,
                "special": [
                    {
                        "parameter": case.parameter,
                        "value": to_grammar(case.value),
                        "number": case.number,
                        "charges": {n: to_grammar(Q) for n, Q in case.charges.items()},
                    }
                    for case in section.special
                ],
            }
        case FindSection():
            return {name: _answer(answer) for name, answer in section.answers.items()}
        case EquilibriaSection():
            return _unless_none(section.equilibria, lambda each: [_equilibrium(e) for e in each])
        case ModesSection():
            return _unless_none(section.modes, lambda each: [_mode(m) for m in each])
        case ReductionSection():
            return _unless_none(section.routhian, lambda _: _reduction(section))
        case HamiltonJacobiSection():
            return of_action(section)
        case SteadySection():
            return _unless_none(section.motions, lambda each: [_steady(m) for m in each])
        case ModelSection():
            return (
                None
                if section.kept is None
                else {
                    "kept": section.kept,
                    "eliminated": _by_name(section.eliminated),
                    "ignorable": section.ignorable,
                    "dropped": section.dropped,
                    "reason": dict(section.reason),
                }
            )
        case DimensionsSection():
            return _dimensions(section)
        case _:
            raise TypeError(f"{type(section).__name__} has no place in the JSON")


def _equation(equation: LagrangeEquation) -> Object:
    sides = f"{to_grammar(equation.left)} = {to_grammar(equation.right)}"
    return {"coordinate": equation.coordinate, "equation": sides}


def _accelerations(section: AccelerationsSection) -> Object:
    result: Object = {"accelerations": _unless_none(section.accelerations, _by_name)}
    if not section.regular:
        result |= {"regular": False, "degenerate": section.degenerate}
    return result


def _multipliers(section: MultipliersSection) -> Object:
    multipliers: Object = {
        constraint: {"symbol": each.symbol, "value": _string(each.value), "kind": each.kind}
        for constraint, each in section.multipliers.items()
    }
    redundant: Object = {"redundant": section.redundant} if section.redundant else {}
    return {"multipliers": multipliers, **redundant}


def _constraint_forces(section: ConstraintForcesSection) -> Object:
    forces: Object = {
        constraint: _unless_none(by_coordinate, _by_name)
        for constraint, by_coordinate in section.forces.items()
    }
    result: Object = {"constraint_forces": forces}
    if section.forces:
        result["total_constraint_force"] = _unless_none(section.total, _by_name)
    if section.on_points:
        result["point_forces"] = {
            constraint: {point: _strings(force) for point, force in by_point.items()}
            for constraint, by_point in section.on_points.items()
        }
    return result


def _charge(charge: Charge) -> Object:
    where: Object = {"where": [above(each) for each in charge.where]} if charge.where else {}
    return where | {
        "name": charge.name,
        "source": charge.source,
        "transformation": _by_name(charge.transformation),
        "gauge": _string(charge.gauge),
        "conserved": charge.conserved,
        "charge": _string(charge.charge),
        "rate": _string(charge.rate),
    }


def _answer(answer: Answer) -> Object:
    match answer:
        case Solutions(solutions=solutions):
            return {"solutions": _unless_none(solutions, _strings)}
        case Ranges(unknown=unknown, ranges=ranges):
            return {"ranges": _unless_none(ranges, lambda each: [_range(unknown, r) for r in each])}
        case Rewritten(value=value):
            both = {"values": _strings(answer.values)} if answer.values else {}
            return {"value": _string(value), **both}


def _range(unknown: str, range_: Range) -> list[str]:
    return [f"{unknown} {how} {to_grammar(bound)}" for how, bound in bounds_of(range_)]


def _equilibrium(equilibrium: Equilibrium) -> Object:
    verdict = equilibrium.verdict
    result = _place(equilibrium) | {"stable": verdict.stable}
    if equilibrium.where:
        result["condition"] = " and ".join(map(above, equilibrium.where))
    if verdict.asymptotic:
        result["asymptotic"] = True
    for name in ("minimum", "hurwitz", "spectrum"):
        conditions = getattr(verdict, name)
        if conditions is not None and not (name == "minimum" and verdict.stable):
            result[name] = _inequalities(conditions)
    if verdict.unstable:
        result["unstable"] = _inequalities(verdict.unstable)
    if equilibrium.free:
        result["free"] = equilibrium.free
    if equilibrium.touching:
        result["touching"] = equilibrium.touching
    if equilibrium.indeterminate:
        result["indeterminate"] = equilibrium.indeterminate
    if equilibrium.sticking:
        result["sticking"] = True
    return result


def _place(place: Equilibrium | Mode | SteadyMotion) -> Object:
    result: Object = {"at": _by_name(place.at)}
    if place.on is not None:
        result["on"] = " = ".join(map(to_grammar, place.on))
    return result


def _mode(mode: Mode) -> Object:
    result = _place(mode) | {"frequency": _string(mode.frequency)}
    if mode.frequency is None:
        result["frequency_squared"] = _string(mode.frequency_squared)
    result["shape"] = _unless_none(mode.shape, _by_name)
    if mode.more_shapes:
        result["more_shapes"] = [_by_name(shape) for shape in mode.more_shapes]
    return result | {"multiplicity": mode.multiplicity}


def _reduction(section: ReductionSection) -> Object:
    return {
        "momenta": _by_name(section.momenta),
        "routhian": _string(section.routhian),
        "equations": [_equation(each) for each in section.equations],
        "reconstruction": _by_name(section.reconstruction),
        "effective_potential": _string(section.effective_potential),
        "gyroscopic": _by_name(section.gyroscopic),
        "one_freedom": _unless_none(section.one_freedom, _one_freedom),
    }


def _one_freedom(motion: OneFreedom) -> Object:
    return {
        "coordinate": motion.coordinate,
        "constant": motion.constant,
        "energy": to_grammar(motion.energy),
        "turning_points": _unless_none(motion.turning_points, _strings),
        "rate": to_grammar(motion.rate),
        "periods": [_period(each) for each in motion.periods],
    }


def _period(period: PeriodSeries) -> Object:
    place: Object = {"at": _by_name(period.at)}
    if period.root_of is not None:
        place = {"root_of": to_grammar(period.root_of)}
    return place | {
        "amplitude": period.amplitude or None,
        "order": period.order,
        "period": to_grammar(period.period),
        "where": [above(each) for each in period.where],
    }


def _steady(motion: SteadyMotion) -> Object:
    return _place(motion) | {
        "free": motion.free,
        "rates": _unless_none(motion.rates, _by_name),
        "momenta": _by_name(motion.momenta),
        "where": [above(each) for each in motion.where],
        "mirrored": motion.mirrored,
        "stable": motion.verdict.stable,
        "asymptotic": motion.verdict.asymptotic,
        "minimum": _unless_none(motion.verdict.minimum, _inequalities),
        "hurwitz": _unless_none(motion.verdict.hurwitz, _inequalities),
        "spectrum": _unless_none(motion.verdict.spectrum, _inequalities),
        "unstable": _inequalities(motion.verdict.unstable),
        "frequencies_squared": _strings(motion.frequencies_squared),
        "mass": [_strings(row) for row in motion.mass],
        "velocity": [_strings(row) for row in motion.velocity],
        "stiffness": [_strings(row) for row in motion.stiffness],
        "reason": motion.verdict.reason.replace("{V}", motion.verdict.potential),
    }


def _inequalities(where: Sequence[Above]) -> list[str]:
    return [above(each) for each in where]


def _dimensions(section: DimensionsSection) -> Object:
    return {
        "coordinates": _units(section.coordinates),
        "parameters": _units(section.parameters),
        "functions": _units(section.functions),
        "definitions": _units(section.definitions),
        "energy": _unit(section.energy),
        "momenta": _units(section.momenta),
        "forces": _units(section.forces),
        "multipliers": _units(section.multipliers),
        "charges": _units(section.charges),
    }


def _units(quantities: Mapping[str, QuantityUnit]) -> Object:
    return {name: _unit(quantity) for name, quantity in quantities.items()}


def _unit(quantity: QuantityUnit) -> Object:
    return {"unit": _unless_none(quantity.unit, str), "source": quantity.source}


def _unless_none(value: _Some | None, shown: Callable[[_Some], Value]) -> Value:
    return None if value is None else shown(value)


def _string(expression: Expression | None) -> Value:
    return _unless_none(expression, to_grammar)


def _strings(expressions: Sequence[Expression]) -> list[str]:
    return [to_grammar(each) for each in expressions]


def _by_name(expressions: Mapping[str, Expression | None]) -> Object:
    return {name: _string(expression) for name, expression in expressions.items()}
