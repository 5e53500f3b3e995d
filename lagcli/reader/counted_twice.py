"""A warning of a force that V gives already, such as a weight in V and on a point."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from random import Random

from lagcli.diagnostics import Diagnostic
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import Expression, name_nodes, terms_of
from lagcli.problem_data import Problem
from lagcli.reader.text import SourceText

#: Terms of V times coordinates times definitions; larger problems are not looked at.
_MOST = 3000
_STEP = 1e-4


def counted_twice(problem: Problem) -> Iterator[Diagnostic]:
    """A warning for each force Q = -∂U/∂q, where U is V or a term of it."""
    potential, points = problem.potential, [one for one in problem.points if one.force]
    if potential is None or not (points or problem.forces):
        return
    names = [one.name for one in problem.coordinates]
    moving = [*names, *(f"{x}'" for x in names), "t", *(one.name for one in problem.parameters)]
    states = [{x: Random(f"{x}{k}").uniform(0.3, 0.9) for x in moving} for k in range(2)]

    def values(formula: Expression, x: str = "", step: float = 0) -> list[float]:
        found = []
        for state in states:
            known = {**state, "pi": math.pi, x: state.get(x, 0) + step}
            for name, definition in problem.definitions.items():
                known[name] = evaluated(definition, known, FUNCTIONS)
            found.append(float(evaluated(formula, known, FUNCTIONS)))
        return found

    def rates(formula: Expression, x: str) -> list[float]:
        both = zip(values(formula, x, _STEP), values(formula, x, -_STEP), strict=True)
        return [(after - before) / (2 * _STEP) for after, before in both]

    energies = [*terms_of(potential), potential]
    if len(energies) * len(names) * (1 + len(problem.definitions)) > _MOST:
        return
    acting = [
        [({x: values(each)}, each) for each in dict.fromkeys([force, *terms_of(force)])]
        for x, force in problem.forces.items()
    ]
    for one in points:
        axes = [*zip(one.position, one.force or (), strict=True)]
        along = {x: [0.0] * len(states) for x in names}
        for x, (position, force) in product(names, axes):  # Q = Σ F ∂r/∂q
            work = zip(along[x], values(force), rates(position, x), strict=True)
            along[x] = [total + f * rate for total, f, rate in work]
        largest = max((force for _, force in axes), key=lambda force: len(name_nodes(force)))
        acting.append([(along, largest)])
    slopes = [({x: rates(energy, x) for x in names}, energy) for energy in energies]
    written = SourceText.of(problem.source).written_sum
    for parts in acting:
        for (forces, force), (slope, energy) in product(parts, slopes):
            if _opposite(forces, slope):
                message = "this force acts twice: it follows from V as well"
                hint = f"leave it out, or {written([energy.span])} in V"
                yield Diagnostic(message, force.span, hint, severity="warning")
                break


def _opposite(forces: dict[str, list[float]], slopes: dict[str, list[float]]) -> bool:
    """Whether forces, which are not all 0, are the negative slopes."""
    pairs = [pair for x in forces for pair in zip(forces[x], slopes[x], strict=True)]
    alike = (math.isclose(force, -slope, rel_tol=1e-6, abs_tol=1e-7) for force, slope in pairs)
    return any(abs(force) > 1e-5 for force, _ in pairs) and all(alike)
