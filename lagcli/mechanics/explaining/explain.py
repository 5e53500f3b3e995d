"""The steps in order, and the answers that were not found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.explaining.conservation import charges, energy
from lagcli.mechanics.explaining.elimination import elimination
from lagcli.mechanics.explaining.equations import equations
from lagcli.mechanics.explaining.forces import check, meaning
from lagcli.mechanics.explaining.lagrangian import lagrangian
from lagcli.mechanics.explaining.large import UNSOLVED
from lagcli.mechanics.explaining.scene import scene
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import explained
from lagcli.statements.explanation import Explanation, ExplanationStep


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
    teller = Teller(derivation)
    dynamics = teller.dynamics
    motion = dynamics.motion
    constrained = bool(dynamics.constraints.equations)
    steps = [
        ExplanationStep("The system", tuple(scene(teller))),
        ExplanationStep("The Lagrangian", tuple(lagrangian(teller))),
        ExplanationStep("Lagrange's equations", tuple(equations(teller))),
        ExplanationStep(
            "The multipliers are eliminated" if constrained else "The accelerations",
            tuple(elimination(teller)),
        ),
    ]
    if motion is not None:
        steps.append(ExplanationStep("The verification", tuple(check(teller, motion))))
        if constrained:
            steps.append(
                ExplanationStep("What the multipliers mean", tuple(meaning(teller, motion)))
            )
    steps.append(ExplanationStep("The energy", tuple(energy(teller))))
    found = tuple(charges(teller))
    if found:
        steps.append(ExplanationStep("Conserved quantities", found))
    missing = tuple(_missing(teller))
    if also:
        from lagcli.mechanics.explaining.further import further

        more, unfound = further(teller, also)
        steps += more
        missing = (*missing, *unfound)
    return explained(teller.problem, dynamics.degrees_of_freedom, steps, missing)


def _missing(teller: Teller) -> Iterator[str]:
    if teller.dynamics.motion is None:
        yield UNSOLVED
    for charge in teller.derivation.noether.charges:
        if charge.conserved is None:
            yield f"whether '{charge.name}' is conserved was not decided"
