"""The steps in order, and the answers that were not found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.explaining.conservation import charges, energy
from lagcli.mechanics.explaining.elimination import elimination
from lagcli.mechanics.explaining.equations import equations
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.forces import check, meaning
from lagcli.mechanics.explaining.lagrangian import lagrangian
from lagcli.mechanics.explaining.large import UNSOLVED
from lagcli.mechanics.explaining.scene import scene
from lagcli.mechanics.explaining.words import explained
from lagcli.record import replace
from lagcli.statements.explanation import Explanation, ExplanationStep

_LAGRANGIAN = 1  # the step in which the letters are introduced


def explanation(derivation: Derivation, also: Sequence[str] = ()) -> Explanation:
    """The derivation as a teacher writes it.

    Parameters
    ----------
    derivation
        That of a system of readable size; for a large one see `large`.
    also
        Names of sections that have a step, explained after the rest.

    Raises
    ------
    ProblemError
        When the constraints cannot be used.
    """
    explainer = Explainer(derivation)
    dynamics = explainer.dynamics
    motion = dynamics.motion
    constrained = bool(dynamics.constraints.equations)
    steps = [
        ExplanationStep("The system", tuple(scene(explainer))),
        ExplanationStep("The Lagrangian", tuple(lagrangian(explainer))),
        ExplanationStep("Lagrange's equations", tuple(equations(explainer))),
        ExplanationStep(
            "The multipliers are eliminated" if constrained else "The accelerations",
            tuple(elimination(explainer)),
        ),
    ]
    if motion is not None:
        steps.append(ExplanationStep("The verification", tuple(check(explainer, motion))))
        if constrained:
            steps.append(
                ExplanationStep("What the multipliers mean", tuple(meaning(explainer, motion)))
            )
    steps.append(ExplanationStep("The energy", tuple(energy(explainer))))
    found = tuple(charges(explainer))
    if found:
        steps.append(ExplanationStep("Conserved quantities", found))
    missing = tuple(_missing(explainer))
    if also:
        from lagcli.mechanics.explaining.further import further

        more, unfound = further(explainer, also)
        steps += more
        missing = (*missing, *unfound)
    told = (*explainer.letters.moved(steps), *steps[_LAGRANGIAN].blocks)
    steps[_LAGRANGIAN] = replace(steps[_LAGRANGIAN], blocks=told)
    return explained(explainer.problem, dynamics.degrees_of_freedom, steps, missing)


def _missing(explainer: Explainer) -> Iterator[str]:
    if explainer.dynamics.motion is None:
        yield UNSOLVED
    for charge in explainer.derivation.noether.charges:
        if charge.conserved is None:
            yield f"whether '{charge.name}' is conserved was not decided"
