"""Sentences that sections and explanations share: inequalities, and what is stable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagcli.answers import Equilibrium, QuantityUnit
from lagcli.document import Formula, Label, Row
from lagcli.expression import ZERO, Expression, Name, operation_count
from lagcli.motions import Above, SteadyMotion

Part = str | Formula

#: The effective potential.
POTENTIAL = Label("U", ("eff",))
#: A condition of more operations is not written beside the frequency that it says of.
_LONG = 24
_THEOREM = "(Kelvin, Tait and Chetaev)"
_REVERSED = "; unstable where one of these is reversed. "


def conditions(where: Sequence[Above]) -> list[Part]:
    """Inequalities within a sentence."""
    parts: list[Part] = []
    for position, each in enumerate(where):
        below = each.left == ZERO
        sides: list[Part] = (
            [each.right, " < ", each.left] if below else [each.left, " > ", each.right]
        )
        parts += [" and " if position else "", *sides]
    return parts


def place_rows(
    at: Mapping[str, Expression], on: tuple[Expression, Expression] | None
) -> tuple[Row, ...]:
    """A state, or a family of them: what ties its coordinates, and their values."""
    ties = () if on is None else (Row(*on),)
    return (*ties, *(Row(Name(name), value) for name, value in at.items()))


def unit_rows(
    labels: Mapping[str, Label], quantities: Mapping[str, QuantityUnit], source: str = ""
) -> tuple[Row, ...]:
    """The units that are known; those of one source where it is named."""
    return tuple(
        Row(labels[name], each.unit)
        for name, each in quantities.items()
        if each.unit is not None and source in {"", each.source}
    )


def stability(equilibrium: Equilibrium) -> list[Part]:
    """Whether a state of rest is stable, and by which conditions, in sentences."""
    reason = equilibrium.reason
    stable = "Asymptotically stable" if equilibrium.asymptotic else "Stable"
    if equilibrium.stable is not None:
        words: list[Part] = [stable if equilibrium.stable else "Unstable"]
        if equilibrium.stable:
            words += _up_to(equilibrium)
        return [*words, f": {reason}." if reason else "."]
    parts: list[Part] = []
    spectrum = equilibrium.spectrum
    if equilibrium.minimum:
        parts += [f"{stable} where ", *conditions(equilibrium.minimum), ", a minimum of V"]
        parts += [". " if spectrum is not None else _reversed(equilibrium.minimum)]
    if equilibrium.hurwitz:
        parts += [f"{stable} where ", *conditions(equilibrium.hurwitz), " (Hurwitz)"]
        parts += [_reversed(equilibrium.hurwitz)]
    if spectrum is not None:
        parts += ["Stable to first order, all frequencies being real and distinct"]
        parts += [", where ", *conditions(spectrum), _reversed(spectrum)] if spectrum else [". "]
        if equilibrium.gyroscopic:
            parts += [f"Where V has no minimum, damping of all motions destroys this {_THEOREM}. "]
    if not parts:
        return ["Stability undecided" + (f": {reason}." if reason else ".")]
    if reason:
        parts += [f"{reason[0].upper()}{reason[1:]}."]
    elif isinstance(parts[-1], str):
        parts[-1] = parts[-1].rstrip()
    return parts


def _up_to(equilibrium: Equilibrium) -> list[Part]:
    """The displacements along a family, which nothing restores."""
    if equilibrium.on is not None:
        return [" up to displacements along the family"]
    parts: list[Part] = []
    for position, name in enumerate(equilibrium.free):
        parts += [", " if position else " up to displacements of ", Name(name)]
    return parts


def _is_long(condition: Above) -> bool:
    return operation_count(condition.left) + operation_count(condition.right) > _LONG


def _reversed(where: Sequence[Above]) -> str:
    return "; unstable where this is reversed. " if len(where) == 1 else _REVERSED


def steady_stability(motion: SteadyMotion) -> list[Part]:
    """Whether a steady motion is stable, and by which conditions, in sentences."""
    if motion.rolling and motion.spectrum is not None:
        parts: list[Part] = ["Stable to first order"]
        if not motion.frequencies_squared:
            parts += [", all roots beside those along the family having negative real parts"]
        where = motion.spectrum
        if len(motion.frequencies_squared) == 1 and any(map(_is_long, where)):
            return [*parts, " where this is positive, unstable where it is negative:"]
        return [*parts, *([" where ", *conditions(where), _reversed(where)] if where else ["."])]
    if motion.stable and ZERO in motion.frequencies_squared:
        parts = ["Stable up to displacements along the family: ", POTENTIAL]
        return [*parts, " has a minimum across it (Lagrange and Dirichlet)."]
    if motion.stable:
        return ["Stable: ", POTENTIAL, " has a minimum (Lagrange and Dirichlet)."]
    if motion.stable is False:
        return ["Unstable: a root of the characteristic equation has a positive real part."]
    parts = []
    spectrum = motion.spectrum
    if motion.minimum:
        parts += ["Stable, with a minimum of ", POTENTIAL, ", where "]
        parts += [*conditions(motion.minimum), ". "]
    if spectrum is not None:
        parts += ["Stable to first order by gyroscopic terms, without a minimum of ", POTENTIAL]
        parts += [", where ", *conditions(spectrum), _reversed(spectrum)] if spectrum else [". "]
        parts += [f"Damping of all these coordinates destroys that {_THEOREM}."]
    elif len(motion.minimum or ()) == 1 and not motion.reason:
        parts += ["Unstable where this is reversed."]
    if motion.reason or not parts:
        lead = "Otherwise undecided" if parts else "Stability undecided"
        parts += [f"{lead}: {motion.reason}." if motion.reason else f"{lead}."]
    return parts
