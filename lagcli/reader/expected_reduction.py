"""The expectations of the sections that name constants of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lagcli.problem_data import (
    ExpectEquilibrium,
    ExpectHamiltonJacobi,
    ExpectReduction,
    ExpectSteady,
)
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.nodes import DocumentNode, Scalar, Sequence
from lagcli.reader.scope import Role
from lagcli.reader.sections import YES_OR_NO

if TYPE_CHECKING:
    from lagcli.expression import Expression
    from lagcli.problem_data import Inequality
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.sections import Sections

#: What the answers call the constants of separation: alpha_1, alpha_2, …
SEPARATION_NAMES = tuple(f"alpha_{number}" for number in range(1, 6))
#: What the answers call the energy and the amplitude: the first that the file does not use.
ENERGY_NAMES = ("E", "h", "E_0", "h_0")
AMPLITUDE_NAMES = ("a", "A", "a_0", "A_0")

CONSTANT_NAMES = (*ENERGY_NAMES, *AMPLITUDE_NAMES, *SEPARATION_NAMES)

_REDUCED = Role(order=1, why="an answer is free of accelerations", momenta=True)
_PLACE = Role(order=0, why="an equilibrium is given by its coordinates")
_STEADY = ("at", "rates", "momenta", "frequencies_squared", "stable")
_OF_W = {
    "derivatives": "the expected derivative of W by '{}'",
    "functions": "the expected part W of the action by '{}'",
}
_SEPARATED = ("separable", *_OF_W)
_KEYS = ("routhian", "effective_potential", "reconstruction", "turning_points", "period")


def read_reduction(reader: ExpectReader, node: DocumentNode) -> ExpectReduction:
    """`expect: {reduction: {routhian, effective_potential, …}}`."""
    sections, spans = reader.sections, reader.spans
    found: dict[str, Any] = {}
    with sections.scope.also(CONSTANT_NAMES, "parameter"):
        entries = sections.attributes(node, "'reduction'", _KEYS)
        for name, (key, value) in entries.items():
            spans["reduction", name] = key.span
            what = f"the expected {name.replace('_', ' ')}"
            match name:
                case "reconstruction":
                    what = "the expected velocity of '{}'"
                    found[name] = read_by_coordinate(sections, value, f"'{name}'", what, _REDUCED)
                case "turning_points":
                    found[name] = expressions(sections, value, name, what)
                case _:
                    found[name] = sections.expression(value, what, _REDUCED)
    return ExpectReduction(**found)


def expressions(
    sections: Sections, node: DocumentNode, name: str, what: str
) -> tuple[Expression, ...]:
    """A list of expressions."""
    items = sections.items(node, f"'{name}'", "write [one, another]")
    return tuple(sections.expression(item, what, _REDUCED) for item in items)


def read_steady_motions(reader: ExpectReader, node: DocumentNode) -> tuple[ExpectSteady, ...]:
    """`expect: {steady_motions: [{at, rates, momenta, frequencies_squared, stable}]}`."""
    sections, spans = reader.sections, reader.spans
    motions = []
    with sections.scope.also(CONSTANT_NAMES, "parameter"):
        for place, item in enumerate(sections.items(node, "'steady_motions'")):
            spans["steady_motions", str(place)] = item.span
            motions.append(_steady(sections, item))
    return tuple(motions)


def read_equilibria(reader: ExpectReader, node: DocumentNode) -> tuple[ExpectEquilibrium, ...]:
    """`expect: {equilibria: [{at, on, stable}]}`."""
    sections, spans = reader.sections, reader.spans
    found = []
    for place, item in enumerate(sections.items(node, "'equilibria'")):
        spans["equilibria", str(place)] = item.span
        values: dict[str, Any] = {}
        entries = sections.attributes(item, "an equilibrium", ("at", "on", "stable"))
        for name, (_, value) in entries.items():
            if name == "stable":
                values[name] = _stable(sections, value)
            elif name == "on":
                what = "the equation of a family of equilibria"
                values[name] = sections.equation(value, what, _PLACE)
            else:
                what = "the expected place of '{}'"
                values[name] = read_by_coordinate(sections, value, "'at'", what, _REDUCED)
        found.append(ExpectEquilibrium(**values))
    return tuple(found)


def _steady(sections: Sections, node: DocumentNode) -> ExpectSteady:
    found: dict[str, Any] = {}
    for name, (_, value) in sections.attributes(node, "a steady motion", _STEADY).items():
        if name == "stable":
            found[name] = _stable(sections, value)
        elif name == "frequencies_squared":
            found[name] = expressions(sections, value, name, "an expected square of a frequency")
        else:
            what = f"the expected {name} of '{{}}'"
            found[name] = read_by_coordinate(sections, value, f"'{name}'", what, _REDUCED)
    return ExpectSteady(**found)


def _stable(sections: Sections, node: DocumentNode) -> bool | tuple[Inequality, ...] | None:
    if isinstance(node, Scalar) and node.value.strip() in YES_OR_NO:
        return YES_OR_NO[node.value.strip()]
    items = node.items if isinstance(node, Sequence) else [node]
    what = "a condition of stability"
    read = [sections.comparison(item, what, _REDUCED) for item in items]
    for item, each in zip(items, read, strict=True):
        if each is not None and each.comparison not in (">", "<"):
            sections.error(f"{what} has > or <", item.span)
    return tuple(each for each in read if each is not None)


def read_hamilton_jacobi(reader: ExpectReader, node: DocumentNode) -> ExpectHamiltonJacobi:
    """`expect: {hamilton_jacobi: {separable: yes, derivatives: {x: …}, functions: {x: …}}}`."""
    sections, spans = reader.sections, reader.spans
    found: dict[str, Any] = {}
    with sections.scope.also(CONSTANT_NAMES, "parameter"):
        entries = sections.attributes(node, "'hamilton_jacobi'", _SEPARATED)
        for name, (key, value) in entries.items():
            spans["hamilton_jacobi", name] = key.span
            if name in _OF_W:
                what = _OF_W[name]
                found[name] = read_by_coordinate(sections, value, f"'{name}'", what, _REDUCED)
            else:
                found[name] = sections.yes_or_no(value, name)
    return ExpectHamiltonJacobi(**found)
