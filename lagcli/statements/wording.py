"""Sentences that sections and explanations share: inequalities, and what is stable."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction

from lagcli.document import Block, Equations, Formula, Label, Paragraph, Row
from lagcli.expression import (
    ZERO,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Sum,
    operation_count,
)
from lagcli.statements.answers import QuantityUnit, Verification
from lagcli.statements.motions import (
    Above,
    Irreducible,
    OneFreedom,
    SteadyMotion,
    SteadySection,
    Verdict,
)
from lagcli.statements.questions import Answer, Solutions

Part = str | Formula

#: Why h is conserved where dh/dt = -dL/dt + ... has no terms.
CONSERVED = "L does not depend on t explicitly, no applied force and no constraint does work"
#: What breaks a symmetry of the forces and the constraints that is none of L.
CHANGE_OF_L = "a change of L that is not a total time derivative"
#: The effective potential.
POTENTIAL = Label("U", ("eff",))
#: A condition of more operations is not written beside the frequency that it says of.
_LONG = 24
#: The most operations of a value within a sentence.
_SHORT = 3
_SHORT_RELATION = 12
_BOUNDED = ", since the equations of motion are linear and all their solutions are then bounded"
_THEOREM = "(Kelvin, Tait and Chetaev)"
_SUBSTITUTED = {"exact": "exactly", "50 digits": "at random states to 50 digits"}


def not_found(reason: str = "") -> Paragraph:
    """The sentence of a section whose statement was not found."""
    return Paragraph((f"Not found{': ' + reason if reason else '.'}",))


def one_row(left: Formula, right: Expression) -> Equations:
    """One equation."""
    return Equations((Row(left, right),))


def rows_by_name(expressions: Mapping[str, Expression], primes: int = 0) -> Equations:
    """An equation for each name."""
    return Equations(tuple(Row(Name(name, primes), each) for name, each in expressions.items()))


def listed(names: Iterable[str]) -> list[Part]:
    """Names between commas."""
    parts: list[Part] = []
    for name in names:
        parts += [", ", Name(name)] if parts else [Name(name)]
    return parts


def substituted(level: Verification | None, symbols: Iterable[str] = ()) -> Iterator[Paragraph]:
    """How the solution was verified, for some symbols or for all."""
    if level is not None:
        names = listed(symbols)
        head = (*names, " substituted") if names else ("Substituted",)
        how = f" into the equations of motion: verified {_SUBSTITUTED[level]}."
        yield Paragraph((*head, how))


def enumerated(words: Sequence[str], before: str = "") -> str:
    """a, b and c; `before` stands before each but the first."""
    parts = [f"{before if k else ''}{word}" for k, word in enumerate(words)]
    return " and ".join([part for part in (", ".join(parts[:-1]), *parts[-1:]) if part])


def conditions(where: Sequence[Above]) -> list[Part]:
    """Inequalities within a sentence, all of which hold."""
    return _joined(where, " and ")


def only_along_its_path(point: str, fixed: Sequence[str]) -> Iterator[Paragraph]:
    """That a force on a point that cannot move along an axis is not known along that."""
    if fixed:
        axes = enumerated(fixed)
        lead = f"{point} cannot move along {axes}: a force along {axes}"
        yield Paragraph((f"{lead} does no work on it and is not determined here.",))


def turning_contacts(motion: OneFreedom) -> Iterator[Paragraph]:
    """For which energies one-sided contacts hold at the turning points."""
    different = {*motion.turning_where}
    if len(different) == 1 and different != {()}:
        where = motion.turning_where[0]
        yield Paragraph(("The one-sided constraints hold there for ", *conditions(where), "."))
    if len(different) < 2:
        return
    for root, where in zip(motion.turning_points or (), motion.turning_where, strict=True):
        if where:
            place = ("At ", Name(motion.coordinate), " = ", root)
            yield Paragraph(
                (*place, " the one-sided constraints hold for ", *conditions(where), ".")
            )


def _joined(where: Sequence[Above], word: str) -> list[Part]:
    parts: list[Part] = []
    for position, each in enumerate(where):
        parts += [word if position else "", *_sides(each), *_order_of_three(each)]
    return parts


def _sides(each: Above) -> list[Part]:
    base = _squared(each.left) if each.right == ZERO else None
    if base is not None:
        return _compared(base, " ≠ ")
    if each.left == ZERO:
        return [each.right, " < ", each.left]
    return [each.left, " > ", each.right]


def _compared(difference: Expression, sign: str) -> list[Part]:
    """a = b + c of a - b - c, else that it is 0; or another sign than =."""
    terms = difference.terms if isinstance(difference, Sum) else ()
    minus = [term.operand for term in terms if isinstance(term, Negative)]
    plus = [term for term in terms if not isinstance(term, Negative)]
    if minus and plus:
        sides = (side[0] if len(side) == 1 else Sum(tuple(side)) for side in (plus, minus))
        return [next(sides), sign, next(sides)]
    return [difference, f"{sign}0"]


def _squared(expression: Expression) -> Expression | None:
    """q B of q² B²; None of what is not a square."""
    if isinstance(expression, Product):
        bases = tuple(_squared(factor) for factor in expression.factors)
        known = tuple(base for base in bases if base is not None)
        return Product(known) if len(known) == len(bases) else None
    square = isinstance(expression, Power) and expression.exponent == Number(Fraction(2))
    return expression.base if square and isinstance(expression, Power) else None


def _order_of_three(condition: Above) -> list[Part]:
    """(B - A) (C - A) > 0, or with other signs, in words."""
    product = condition.right if condition.left == ZERO else condition.left
    if ZERO not in (condition.left, condition.right) or not isinstance(product, Product):
        return []
    pairs = [_signs(factor) for factor in product.factors]
    if len(pairs) != 2 or not all(sorted(pair.values()) == [-1, 1] for pair in pairs):
        return []
    shared = [name for name in pairs[0] if name in pairs[1]]
    if len(shared) != 1:
        return []
    [A] = shared
    sign = pairs[0][A] * pairs[1][A] * (-1 if condition.left == ZERO else 1)
    place = "the largest or the smallest of the three" if sign == 1 else "between the other two"
    return [" (", A, f" is {place})"]


def _signs(factor: Expression) -> dict[Expression, int]:
    """1 and -1 of a difference of two names; empty for anything else."""
    terms = factor.terms if isinstance(factor, Sum) else ()
    signs = {(t.operand if isinstance(t, Negative) else t): 1 - 2 * isinstance(t, Negative)
             for t in terms}  # fmt: skip
    return signs if all(isinstance(name, Name) for name in signs) else {}


def place_rows(
    at: Mapping[str, Expression], on: tuple[Expression, Expression] | None
) -> tuple[Row, ...]:
    """A state, or a family of them: what ties its coordinates, and their values."""
    ties = () if on is None else (Row(*on),)
    return (*ties, *(Row(Name(name), value) for name, value in at.items()))


def state_blocks(
    at: Mapping[str, Expression],
    before: str = "",
    on: tuple[Expression, Expression] | None = None,
) -> Iterator[Block]:
    """A state, or a family: on one line where its values are short, else as equations."""
    rows = place_rows(at, on)
    short = on is None or sum(map(operation_count, on)) <= _SHORT_RELATION
    if short and all(operation_count(value) <= _SHORT for value in at.values()):
        parts: list[str | Formula] = [before]
        for position, row in enumerate(rows):
            parts += [", " if position else "", row.left, " = ", row.right]
        if rows:
            yield Paragraph((*parts, ":"))
        return
    if before:
        yield Paragraph((before,))
    yield Equations(rows)


def unit_rows(
    labels: Mapping[str, Label], quantities: Mapping[str, QuantityUnit], source: str = ""
) -> tuple[Row, ...]:
    """The units that are known; those of one source where it is named."""
    return tuple(
        Row(labels[name], each.unit)
        for name, each in quantities.items()
        if each.unit is not None and source in {"", each.source}
    )


def stability(
    verdict: Verdict,
    free: Sequence[str] = (),
    on: tuple[Expression, Expression] | None = None,
) -> list[Part]:
    """Whether an equilibrium or a steady motion is stable, and by which conditions, in sentences.

    It is one of a family where coordinates are `free` or tied by the equation `on`.
    """
    if verdict.rapid is not None:
        return _on_average(verdict, verdict.rapid)
    stable = "Asymptotically stable" if verdict.asymptotic else "Stable"
    reason = _with_potential(verdict.reason, verdict.potential)
    if verdict.stable is not None:
        words: list[Part] = [stable if verdict.stable else "Unstable"]
        if verdict.stable:
            words += _up_to(free, on) if free or on is not None else _along(verdict)
        return [*words, *([": ", *reason] if reason else []), "."]
    parts = [*_by_minimum(verdict, stable), *_by_roots(verdict, stable)]
    if not parts and verdict.unstable:
        parts = ["Unstable where ", *_joined(verdict.unstable, " or "), ". "]
    if not parts:
        return ["Stability undecided", *([": ", *reason] if reason else []), "."]
    if reason:
        first = reason[0]
        lead = f"{first[0].upper()}{first[1:]}" if isinstance(first, str) else first
        parts += [lead, *reason[1:], "."]
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
        parts += ["; unstable where ", *_joined(verdict.unstable, " or "), " "]
    return [*parts, "(Landau and Lifshitz, section 30)."]


def _potential(name: str) -> Part:
    """`V`, `V_eff` or `U_eff` as it is set, in words where other forces act."""
    letter, _, index = name.partition("_")
    return Label(letter, (index,) if index else ()) if name else "the potential of all forces"


def fold(determinant: Expression | None) -> Iterator[Block]:
    """Where two branches of the Legendre transform meet; nothing where there are none."""
    if determinant is not None:
        yield Paragraph(("Two branches meet where",))
        yield Equations((Row(ZERO, determinant),))


def unless(
    what: str, vanishing: Sequence[Expression] | None, edge: Sequence[str] = ()
) -> list[Part]:
    """That there is none, but for values of the parameters for which these vanish.

    Nor where the coordinates at the `edge` of their range are positive.
    """
    general = "for general values of the parameters " if vanishing is None else ""
    parts: list[Part] = [f"{general}there is no {what}"]
    for position, name in enumerate(edge):
        parts += [" and " if position else " with ", Name(name), " > 0"]
    vanishing = vanishing or ()
    for position, each in enumerate(vanishing):
        parts += [" and " if position else " unless ", *_compared(each, " = ")]
    return parts


def there_may_be_others(section: SteadySection) -> Paragraph:
    """That not all steady motions are listed, and where none was sought."""
    parts: list[Part] = []
    for each in section.singular_where:
        parts += [" or " if parts else ", as where ", each, " = 0"]
    parts += [": the coordinates are singular there"] if parts else []
    return Paragraph(("There may be others", *parts, "."))


def none_found(
    what: str,
    vanishing: Sequence[Expression] | None,
    *,
    complete: bool,
    edge: Sequence[str] = (),
) -> Paragraph:
    """That there is none of what was sought, or that none is known."""
    if not complete:
        return Paragraph(("None was found.",))
    if vanishing == () and not edge:
        return Paragraph(("There is none.",))
    lead, *rest = unless(what, vanishing, edge)
    return Paragraph((f"{str(lead)[0].upper()}{str(lead)[1:]}", *rest, "."))


def remark(answer: Answer) -> Iterator[Paragraph]:
    """What is said beside an answer, as a sentence."""
    remarks: tuple[Part, ...] = (answer.note,) if answer.note else ()
    if isinstance(answer, Solutions) and answer.remarks:
        remarks = answer.remarks
    if remarks:
        first, *rest = remarks
        lead = f"{first[0].upper()}{first[1:]}" if isinstance(first, str) else first
        parts: list[Part] = [lead, *rest]
        if isinstance(parts[-1], str):
            parts[-1] = parts[-1].rstrip(".")
        yield Paragraph((*parts, "."))


def at_the_limit(where: Sequence[Above], *, sticking: bool) -> str:
    """What holds where a condition for static friction is an equality."""
    return " At equality it rests, too, with no force to spare." if where and sticking else ""


def holding(touching: Sequence[str], *, sticking: bool) -> str:
    """What holds it at rest beside smooth forces."""
    closed = f"In contact: {', '.join(touching)}. " if touching else ""
    return closed + ("Static friction holds it. " if sticking else "")


def _with_potential(reason: str, name: str) -> list[Part]:
    before, found, after = reason.partition("{V}")
    parts: list[Part] = [before, _potential(name), after] if found else [reason]
    return [part for part in parts if part != ""]


def _by_minimum(verdict: Verdict, stable: str) -> list[Part]:
    if not verdict.minimum:
        return []
    alone = verdict.hurwitz is None and verdict.spectrum is None
    potential = _potential(verdict.potential)
    name = f" ({verdict.theorem})" if alone and verdict.theorem else ""
    parts: list[Part] = [f"{stable} where ", *conditions(verdict.minimum)]
    parts += [", a minimum of ", potential, name]
    return [*parts, *(_opposite(verdict.unstable) if alone else [". "]), *_critical(verdict)]


def _critical(verdict: Verdict) -> list[Part]:
    """What holds at equality in the one condition."""
    if verdict.critical is None or verdict.minimum is None or len(verdict.minimum) != 1:
        return []
    [condition], potential = verdict.minimum, _potential(verdict.potential)
    equality: list[Part] = ["For ", condition.left, " = ", condition.right, " it is "]
    if verdict.critical == 0:
        return [*equality, "unstable: ", potential, " has no minimum then. "]
    return [*equality, "stable: ", potential, f" then has a minimum of order {verdict.critical}. "]


def _by_roots(verdict: Verdict, stable: str) -> list[Part]:
    if verdict.hurwitz:
        lead: list[Part] = [stable, " up to displacements along the family" * verdict.across]
        parts = [*lead, " where ", *conditions(verdict.hurwitz), f" ({verdict.theorem})"]
        return [*parts, *_opposite(verdict.unstable)]
    spectrum = verdict.spectrum
    if spectrum is None:
        return []
    if verdict.exact:
        parts = [*(["Stable where ", *conditions(spectrum)] if spectrum else ["Stable"]), _BOUNDED]
    else:
        parts = ["Stable to first order, all frequencies being real and distinct"]
        parts += [", where ", *conditions(spectrum)] if spectrum else []
    parts += _opposite(verdict.unstable if spectrum else ())
    if verdict.gyroscopic:
        potential = _potential(verdict.potential)
        parts += ["Where ", potential, " has no minimum, damping of all motions destroys this "]
        parts += [f"{_THEOREM}. "]
    return parts


def _along(verdict: Verdict) -> list[Part]:
    return [" up to displacements along the family"] if verdict.across else []


def _up_to(free: Sequence[str], on: tuple[Expression, Expression] | None) -> list[Part]:
    """The displacements along a family, which nothing restores."""
    if on is not None:
        return [" up to displacements along the family"]
    parts: list[Part] = []
    for position, name in enumerate(free):
        parts += [", " if position else " up to displacements of ", Name(name)]
    return parts


def irreducible(name: str, each: Irreducible, L: Name) -> list[Part]:
    """Why a coordinate that does not occur in L is not eliminated by its momentum."""
    q, p = Name(name), Name(f"p_{name}")
    if each.conserved:
        return [q, " is cyclic and ", p, f" is constant, but {each.why}, so ", q,
                " is not eliminated."]  # fmt: skip
    verdict = " is not conserved" if each.conserved is False else " need not be constant"
    return [q, " does not occur in ", L, ", but ", p, f"{verdict}: {each.why}."]


def _is_long(condition: Above) -> bool:
    return operation_count(condition.left) + operation_count(condition.right) > _LONG


def _opposite(where: Sequence[Above]) -> list[Part]:
    """Where it is unstable: one of the opposite inequalities, written out."""
    if not where:
        return [". "]
    return ["; unstable where ", *_joined(where, " or "), ". "]


def steady_stability(motion: SteadyMotion) -> list[Part]:
    """Whether a steady motion is stable, and by which conditions, in sentences."""
    verdict = motion.verdict
    if motion.rolling and verdict.spectrum is not None:
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
