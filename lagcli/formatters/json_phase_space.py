"""Poisson brackets and canonical transformations for machines."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, Value
from lagcli.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    GeneratingFunction,
    PoissonBracket,
    TransformationsSection,
)


def of_phase_space(section: BracketsSection | TransformationsSection) -> Value:
    """Give the value of the key of such a section."""
    if isinstance(section, TransformationsSection):
        return [_transformation(each) for each in section.transformations]
    return {
        "observables": _by_name(section.observables),
        "brackets": [_bracket(each) for each in section.brackets],
        "rates": None if section.rates is None else _by_name(section.rates),
    }


def _by_name(expressions: Mapping[str, Expression]) -> dict[str, str]:
    return {name: to_grammar(each) for name, each in expressions.items()}


def _string(expression: Expression | None) -> str | None:
    return None if expression is None else to_grammar(expression)


def _bracket(each: PoissonBracket) -> Object:
    return {
        "name": each.name,
        "left": to_grammar(each.left),
        "right": to_grammar(each.right),
        "value": _string(each.value),
        "named": _string(each.named),
    }


def _transformation(each: ExaminedTransformation) -> Object:
    return {
        "name": each.name,
        "variables": _by_name(each.variables),
        "kind": each.kind,
        "valence": _string(each.valence),
        "failing": [
            {
                "left": bracket.left,
                "right": bracket.right,
                "value": to_grammar(bracket.value),
                "expected": to_grammar(bracket.expected),
            }
            for bracket in each.failing
        ],
        "generator": None if each.generator is None else _generator(each.generator),
        "hamiltonian": _string(each.hamiltonian),
        "reason": each.reason,
    }


def _generator(generator: GeneratingFunction) -> Object:
    return {
        "kind": generator.kind,
        "function": to_grammar(generator.function),
        "generates": generator.generates,
        "failing": [
            f"{to_grammar(left)} = {to_grammar(right)}" for left, right in generator.failing
        ],
    }
