"""Sentences on stability: a verdict with its reason, or the conditions that decide."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagcli.document import Label
from lagcli.expression import ZERO, Expression, Name, Number, Power, operation_count, walk
from lagcli.statements.answers import Equilibrium
from lagcli.statements.motions import Above, SteadyMotion, Verdict
from lagcli.statements.wording import Part, conditions, joined, with_capital

#: A condition of more operations is not written beside the frequency that it says of.
_LONG = 24
_LINEAR = ", since the equations of motion are linear and "
_BOUNDED = "all their solutions are then bounded"
_DRIFT = "apart from a slow drift along the family "
_THEOREM = "(Kelvin, Tait and Chetaev)"
_MOVING = "This does not decide whether what is set in motion stays near."


def stability(
    verdict: Verdict,
    free: Sequence[str] = (),
    on: tuple[Expression, Expression] | None = None,
    at: Mapping[str, Expression] | None = None,
    touching: Sequence[str] = (),
) -> list[Part]:
    """Whether an equilibrium or a steady motion is stable, and by which conditions, in sentences.

    It is one of a family where coordinates are `free` or tied by the equation `on`; those `at`
    formulas of free ones are displaced along with them.  The contacts `touching` may open.
    """
    if verdict.rapid is not None:
        return _on_average(verdict, verdict.rapid)
    if verdict.neutral:
        same = " with the same contacts" * bool(touching)
        return [f"Neutral: every possible position near it{same} is an equilibrium. {_MOVING}"]
    stable = "Asymptotically stable" if verdict.asymptotic else "Stable"
    names = {part for value in (at or {}).values() for part in walk(value)}
    tied = on is not None or any(Name(name) in names for name in free)
    along = _up_to(free, tied=tied) if free or on is not None else _along(verdict)
    if verdict.along:
        along = _up_to(verdict.along, tied=False)
    if verdict.released:
        along = [" up to displacements to the equilibria near it"]
    reason = _with_potential(verdict.reason, verdict.potential)
    if verdict.stable is not None:
        words: list[Part] = [stable if verdict.stable else "Unstable"]
        if verdict.stable:
            words += _along(verdict) if verdict.exact and not verdict.along else along
        return [*words, *([": ", *reason] if reason else []), "."]
    parts = [*_by_minimum(verdict, [stable, *along]), *_by_roots(verdict, stable, along)]
    if not parts and verdict.unstable:
        parts = ["Unstable where ", *joined(verdict.unstable, " or "), ". "]
    if not parts:
        return ["Stability undecided", *([": ", *reason] if reason else []), "."]
    if reason:
        parts += [*with_capital(reason), "."]
    return _trimmed(parts)


def _on_average(verdict: Verdict, frequency: Expression) -> list[Part]:
    """Of the motion averaged over a rapid drive."""
    V = Label("V", ("eff",))
    parts: list[Part] = ["For ", frequency, " large against the frequencies without the drive "]
    parts += ["and a small amplitude of the drive: "]
    if verdict.minimum is None:
        parts += ["unstable, since ", V, " has no minimum there "]
    elif not verdict.minimum:
        parts += ["stable, since ", V, " has a minimum there "]
    else:
        parts += ["stable where ", *conditions(verdict.minimum), ", a minimum of ", V]
        parts += ["; unstable where ", *joined(verdict.unstable, " or ")] * bool(verdict.unstable)
        parts += [" "]
    return [*parts, "(Landau and Lifshitz, section 30)."]


def _potential(name: str) -> Part:
    """`V`, `V_eff` or `U_eff` as it is set, in words where other forces act."""
    letter, _, index = name.partition("_")
    return Label(letter, (index,) if index else ()) if name else "the potential of all forces"


def at_the_limit(where: Sequence[Above], *, sticking: bool) -> str:
    """What holds where a condition for static friction is an equality."""
    return " At equality it rests, too, with no force to spare." if where and sticking else ""


def holding(equilibrium: Equilibrium) -> str:
    """What holds it at rest beside smooth forces."""
    taut = equilibrium.taut
    pressed = [name for name in equilibrium.touching if name not in taut]
    closed = f"In contact: {', '.join(pressed)}. " if pressed else ""
    pulling = f"Taut: {', '.join(taut)}. " if taut else ""
    return closed + pulling + ("Static friction holds it. " if equilibrium.sticking else "")


def _with_potential(reason: str, name: str) -> list[Part]:
    before, found, after = reason.partition("{V}")
    parts: list[Part] = [before, _potential(name), after] if found else [reason]
    return [part for part in parts if part != ""]


def _by_minimum(verdict: Verdict, stable: Sequence[Part]) -> list[Part]:
    if not verdict.minimum:
        return []
    alone = verdict.hurwitz is None and verdict.spectrum is None
    potential = _potential(verdict.potential)
    name = f" ({verdict.theorem})" if alone and verdict.theorem else ""
    parts: list[Part] = [*stable, " where ", *conditions(verdict.minimum)]
    parts += [", a minimum of ", potential, " across the family" * verdict.across, name]
    return [*parts, *(_opposite(verdict.unstable) if alone else [". "]), *_critical(verdict)]


def _critical(verdict: Verdict) -> list[Part]:
    """What holds at equality in the one condition."""
    if verdict.critical is None or verdict.minimum is None or len(verdict.minimum) != 1:
        return []
    [condition], potential = verdict.minimum, _potential(verdict.potential)
    equality = _at_equality(condition)
    if verdict.critical == 0:
        steady = verdict.potential == "U_eff"
        rest = "a steady motion with the same momenta" if steady else "an equilibrium"
        return [*equality, f" every position is {rest}: ", potential, " is constant then. "]
    equality.append(" it is ")
    if verdict.critical < 0:
        there = f"has a maximum of order {-verdict.critical}"
        there = "decreases to one side" if verdict.critical % 2 else there
        return [*equality, "unstable: ", potential, f" then {there}. "]
    stable = "asymptotically stable: " if verdict.asymptotic else "stable: "
    return [*equality, stable, potential, f" then has a minimum of order {verdict.critical}. "]


def _at_equality(condition: Above) -> list[Part]:
    """For φ' = 0 where φ'² > 0 is the condition, for R ω² = g where it is R ω² > g."""
    side, other = sorted((condition.left, condition.right), key=_is_number)
    squared = other == ZERO and isinstance(side, Power) and isinstance(side.exponent, Number)
    return ["For ", side.base if squared and isinstance(side, Power) else side, " = ", other]


def _is_number(side: Expression) -> bool:
    return not any(isinstance(node, Name) for node in walk(side))


def _by_roots(verdict: Verdict, stable: str, along: Sequence[Part]) -> list[Part]:
    if verdict.hurwitz:
        parts: list[Part] = [stable, *along, " where ", *conditions(verdict.hurwitz)]
        parts += [f" ({verdict.theorem})"]
        return [*parts, *_opposite(verdict.unstable)]
    spectrum = verdict.spectrum
    if spectrum is None:
        return []
    if verdict.exact:
        where: list[Part] = [" where ", *conditions(spectrum)] if spectrum else []
        drift: list[Part] = [*along] if verdict.across else []
        parts = ["Stable", *drift, *where, f"{_LINEAR}{_DRIFT * bool(drift)}{_BOUNDED}"]
    else:
        parts = ["Stable to first order, all frequencies being real and distinct"]
        parts += [", where ", *conditions(spectrum)] if spectrum else []
    parts += _opposite(verdict.unstable if spectrum else ())
    if verdict.grows_at_equality and len(spectrum) == 1 and not spectrum[0].besides:
        parts += [*_at_equality(spectrum[0]), " it is unstable, too: roots coincide, "]
        parts += ["and some displacements grow as a power of the time. "]
    if verdict.gyroscopic:
        potential = _potential(verdict.potential)
        parts += ["Where ", potential, " has no minimum, damping of all motions destroys this "]
        parts += [f"{_THEOREM}. "]
    return parts


def _along(verdict: Verdict) -> list[Part]:
    return [" up to displacements along the family"] if verdict.across else []


def _up_to(free: Sequence[str], *, tied: bool) -> list[Part]:
    """The displacements along a family, which nothing restores."""
    if tied:
        return [" up to displacements along the family"]
    parts: list[Part] = []
    for position, name in enumerate(free):
        parts += [", " if position else " up to displacements of ", Name(name)]
    return parts


def _is_long(condition: Above) -> bool:
    return operation_count(condition.left) + operation_count(condition.right) > _LONG


def _opposite(where: Sequence[Above]) -> list[Part]:
    """Where it is unstable: one of the opposite inequalities, written out."""
    if not where:
        return [". "]
    return ["; unstable where ", *joined(where, " or "), ". "]


def steady_stability(motion: SteadyMotion) -> list[Part]:
    """Whether a steady motion is stable, and by which conditions, in sentences."""
    verdict = motion.verdict
    if motion.rolling and verdict.stable is None and verdict.spectrum is not None:
        parts: list[Part] = ["Stable to first order"]
        where = verdict.spectrum
        if len(motion.frequencies_squared) == 1 and any(map(_is_long, where)):
            return [*parts, " where this is positive, unstable where it is negative:"]
        rest = [" where ", *conditions(where), *_opposite(verdict.unstable)] if where else ["."]
        return _trimmed([*parts, *rest])
    return stability(verdict)


def _trimmed(parts: list[Part]) -> list[Part]:
    if isinstance(parts[-1], str):
        parts[-1] = parts[-1].rstrip()
    return parts
