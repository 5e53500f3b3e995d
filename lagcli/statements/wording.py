"""Sentences that sections and explanations share: inequalities, and what is stable."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain

from lagcli.document import Block, Equations, Formula, Label, Matrix, Paragraph, Row, equations_of
from lagcli.expression import (
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Sum,
    added_and_subtracted,
    operation_count,
    walk,
)
from lagcli.notation.letters import names_in, own
from lagcli.statements.answers import (
    EquilibriaSection,
    ModesOfFrequency,
    QuantityUnit,
    SpecialValue,
    Verification,
)
from lagcli.statements.motions import (
    Above,
    Irreducible,
    SteadyMotion,
    SteadySection,
)
from lagcli.statements.plus_minus import turns_alike
from lagcli.statements.questions import Answer, Solutions

Part = str | Formula
#: The values of coordinates, and the equation of a family.
State = tuple[Mapping[str, Expression], tuple[Expression, Expression] | None]

#: Why h is conserved where dh/dt = -dL/dt + ... has no terms.
CONSERVED = "L does not depend on t explicitly, no applied force and no constraint does work"
#: What breaks a symmetry of the forces and the constraints that is none of L.
CHANGE_OF_L = "a change of L that is not a total time derivative"
#: What a candidate is worth whose charge is 0, or constant by the constraints alone.
TRIVIAL = "Its charge is constant whatever the motion is: no conserved quantity follows."
#: Why no symmetry is sought where no degree of freedom is left.
PRESCRIBED = "the constraints prescribe the motion"
#: The potentials whose minima and values a motion in one coordinate is read from.
POTENTIALS: Mapping[str, Formula] = {
    "U_eff": Label("U", ("eff",)),
    "V_eff": Label("V", ("eff",)),
    "V": own("V"),
}
#: Said of what was sought on a constraint surface with a cone's apex, a crossing or an edge.
INDEPENDENT = " where the gradients of the constraints are independent"
NOT_ZERO = " where the gradient of the constraint is not 0"
FINITE_MASS = " where the coefficients of the kinetic energy are finite"
#: The most operations of a value within a sentence.
_SHORT = 6
_SHORT_RELATION = 12
_SUBSTITUTED = {"exact": "exactly", "50 digits": "at random states to 50 digits"}


def not_found(reason: str = "") -> Paragraph:
    """The sentence of a section whose statement was not found."""
    return Paragraph((f"Not found{': ' + reason if reason else '.'}",))


def one_row(left: Formula, right: Expression) -> Equations:
    """One equation."""
    return Equations((Row(left, right),))


def rows_by_name(expressions: Mapping[str, Expression], primes: int = 0) -> Equations:
    """An equation for each name."""
    return equations_of((Name(name, primes), each) for name, each in expressions.items())


def with_names(text: str) -> list[Part]:
    """A sentence whose names stand between backticks."""
    return [Name(part) if k % 2 else part for k, part in enumerate(text.split("`")) if part]


def with_powers(algebra: str) -> list[Part]:
    """The name of an algebra, in which R^2 is a power."""
    parts = enumerate(re.split(r"\bR\^(\d+)", algebra))
    return [Power(Name("R"), Number(Fraction(x))) if k % 2 else x for k, x in parts if x]


def with_constraints(sides: Mapping[str, tuple[Expression, Expression]]) -> Iterator[Block]:
    """The constraints that hold besides the equations of motion."""
    if sides:
        yield Paragraph((f"with the constraint{'s' if len(sides) > 1 else ''}",))
        yield equations_of((left, right, name) for name, (left, right) in sides.items())


def listed(names: Iterable[str], primes: int = 0) -> list[Part]:
    """Names between commas."""
    parts: list[Part] = [part for name in names for part in (", ", Name(name, primes))]
    return parts[1:]


def repeating(periods: Mapping[str, Expression]) -> list[Part]:
    """In which coordinates what is listed repeats."""
    parts: list[Part] = []
    for name, period in periods.items():
        parts += [
            " and" if parts else "They repeat",
            " in ",
            Name(name),
            " with the period ",
            period,
        ]
    return [*parts, "."]


def substituted(level: Verification | None, symbols: Iterable[str] = ()) -> Iterator[Paragraph]:
    """How the solution was verified, for some symbols or for all."""
    if level is not None:
        names = listed(symbols)
        head = (*names, " substituted") if names else ("Substituted",)
        how = f" into the equations of motion: verified {_SUBSTITUTED[level]}."
        yield Paragraph((*head, how))


def constraints_named(kind: str, names: Sequence[str]) -> str:
    """The constraint 'a'; the constraints 'a' and 'b'."""
    quoted = enumerated([f"'{name}'" for name in names])
    return f"{kind}{'s' * (len(names) > 1)} {quoted}"


def enumerated(words: Sequence[str]) -> str:
    """a, b and c."""
    return " and ".join([part for part in (", ".join(words[:-1]), *words[-1:]) if part])


def real_and_positive(value: Expression) -> str:
    """What a frequency, or its square, is where a displacement oscillates."""
    rooted = any(isinstance(part, Call) and part.function == "sqrt" for part in walk(value))
    return "real and positive" if rooted else "positive"


def values_of(case: SpecialValue) -> list[Part]:
    """The values of parameters at which there are more symmetries."""
    found: list[tuple[Part, ...]] = [
        (" and ", Name(name), " = ", value) for name, value in case.values.items()
    ]
    return [part for each in found for part in each][1:]


def conditions(where: Sequence[Above]) -> list[Part]:
    """Inequalities within a sentence, all of which hold."""
    return joined(where, " and ")


def used_to_eliminate(gone: Sequence[str]) -> list[Part]:
    """That constraints are solved for these coordinates."""
    found = listed(gone)
    found[-2:-1] = [" and "] if len(gone) > 1 else []
    return [f"The constraint{' is' if len(gone) == 1 else 's are'} used to eliminate ", *found]


def none_cyclic(gone: Sequence[str]) -> str:
    """That no coordinate is, but for those that are eliminated, of which this says nothing."""
    return f"{'None of the other coordinates' if gone else 'No coordinate'} is cyclic"


def only_along_its_path(point: str, fixed: Sequence[str]) -> Iterator[Paragraph]:
    """That a force on a point that cannot move along an axis is not known along that."""
    if fixed:
        axes = enumerated(fixed)
        lead = f"{point} cannot move along {axes}: a force along {axes}"
        yield Paragraph((f"{lead} does no work on it and is not determined here.",))


def capitalized(words: str) -> str:
    """The words with a capital letter first; the others stay."""
    return words[:1].upper() + words[1:]


def naming_potential(words: str) -> tuple[Part, ...]:
    """The words with U_eff, V_eff and V as formulas."""
    parts = re.split(rf"\b({'|'.join(POTENTIALS)})\b", words)
    return tuple(POTENTIALS.get(part, part) for part in parts if part)


def with_capital(parts: Sequence[Part]) -> list[Part]:
    """The beginning of a sentence, with a capital letter unless it is a formula."""
    first, *rest = parts
    return [capitalized(first) if isinstance(first, str) else first, *rest]


def joined(where: Sequence[Above], word: str) -> list[Part]:
    """Inequalities with a word between them."""
    parts: list[Part] = []
    for position, each in enumerate(where):
        parts += [word if position else "", *_sides(each), *_order_of_three(each)]
        parts += [part for other in each.besides for part in (" and ", *_sides(other))]
    return parts


def _sides(each: Above) -> list[Part]:
    if (base := _not_zero(each)) is not None:
        return _compared(base, " ≠ ")
    match each:
        case Above(left=Negative(operand=left), right=Number(value=0)):
            return [left, " < ", ZERO]
        case Above(left=Number(value=0), right=Negative(operand=right)):
            return [right, " > ", ZERO]
        case Above(left=Number(value=0), right=Sum() as right):
            plus, minus = added_and_subtracted(right)
            return [minus, " > ", plus] if minus != ZERO else [right, " < ", ZERO]
        case Above(left=Number(value=0), right=right):
            return [right, " < ", ZERO]
    if not any(isinstance(node, Name) for node in walk(each.left)):
        return [each.right, " < ", each.left]
    return [each.left, " > ", each.right]


def _compared(difference: Expression, sign: str) -> list[Part]:
    """a = b + c of a - b - c, else that it is 0; or another sign than =."""
    plus, minus = added_and_subtracted(difference)
    match plus, minus:
        case Name(name=left), Name(name=right) if left > right:  # m1 = m2, not m2 = m1
            plus, minus = minus, plus
    if ZERO not in (plus, minus):
        named = any(isinstance(node, Name) for node in walk(plus))
        return [plus, sign, minus] if named else [minus, sign, plus]
    return [difference, f"{sign}0"]


def _not_zero(each: Above) -> Expression | None:
    """q of q² > 0; None of another condition."""
    return _squared(each.left) if each.right == ZERO else None


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


def other_places(motion: SteadyMotion, alike: Iterable[SteadyMotion]) -> Iterator[Block]:
    """Where a steady motion is alike, with the same C or the opposite one."""
    for each in alike:
        same = turns_alike(motion, each)
        C = Label("C", matrix=True)
        yield Paragraph(("or at",) if same else ("or, with the opposite sign of ", C, " below, at"))
        yield Equations(place_rows(each.at, each.on))


def state_blocks(
    at: Mapping[str, Expression],
    before: str | tuple[str | Formula, ...] = "",
    on: tuple[Expression, Expression] | None = None,
    end: str = ":",
) -> Iterator[Block]:
    """A state, or a family: on one line where its values are short, else as equations."""
    rows = place_rows(at, on)
    lead = (before,) if isinstance(before, str) else before
    short = on is None or sum(map(operation_count, on)) <= _SHORT_RELATION
    if short and all(operation_count(value) <= _SHORT for value in at.values()):
        parts: list[str | Formula] = [*lead]
        for position, row in enumerate(rows):
            parts += [", " if position else "", row.left, " = ", row.right]
        if rows:
            yield Paragraph((*parts, end))
        return
    if before:
        yield Paragraph(lead)
    yield Equations(rows)


def alike_blocks(
    states: Sequence[State], before: str | tuple[str | Formula, ...] = ""
) -> Iterator[Block]:
    """States of which the same is said, one below the other."""
    for k, (at, on) in enumerate(states, 1):
        yield from state_blocks(at, before, on, ":" if k == len(states) else "")
        before = "and "


def unit_rows(
    labels: Mapping[str, Label], quantities: Mapping[str, QuantityUnit], source: str = ""
) -> tuple[Row, ...]:
    """The units that are known; those of one source where it is named."""
    return tuple(
        Row(labels[name], each.unit)
        for name, each in quantities.items()
        if each.unit is not None and source in {"", each.source}
    )


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
    general = "in general " if vanishing is None else ""
    parts: list[Part] = [f"{general}there is no {what}"]
    for position, name in enumerate(edge):
        parts += [" and " if position else " with ", Name(name), " > 0"]
    return [*parts, *exceptions(vanishing or ())]


def exceptions(vanishing: Sequence[Expression]) -> list[Part]:
    """Unless these vanish."""
    parts: list[Part] = []
    for each in vanishing:
        parts += [" and " if parts else " unless ", *_compared(each, " = ")]
    return parts


def at_special_values(what: str, section: EquilibriaSection | SteadySection) -> Iterator[Paragraph]:
    """For which values of the parameters all positions are `what`, or more than are listed."""
    more = section.degenerate if section.complete else ()
    ends = (
        (section.void, f" every position is {what}."),
        (more, " there may be more than are listed."),
    )
    for vanishing, end in ends:
        parts = [(" or " if k else "Where ", *_compared(x, " = ")) for k, x in enumerate(vanishing)]
        if parts:
            yield Paragraph((*chain.from_iterable(parts), end))


def linear_equations(
    lead: str, *matrices: Sequence[Sequence[Expression]], end: str = " with"
) -> Iterator[Block]:
    """M x'' + C x' + K x = 0 of the matrices M, C and K, without C where it is 0."""
    given = dict(zip("MCK", matrices, strict=True))
    if not any(entry != ZERO for row in given["C"] for entry in row):
        del given["C"]
    terms = {"M": " · accelerations", "C": " · velocities", "K": " · displacements = 0"}
    parts: list[Part] = [lead]
    for letter in given:
        parts += [" + " if letter != "M" else "", Label(letter, matrix=True), terms[letter]]
    yield Paragraph((*parts, end))
    tags = tuple(str(n) for n in range(1, len(given["M"]) + 1))
    for letter, entries in given.items():
        label, rows = Label(letter, matrix=True), tuple(map(tuple, entries))
        yield one_row(label, rows[0][0]) if len(rows) == 1 else Matrix(label, rows, tags, tags)


def in_any_direction(mode: ModesOfFrequency) -> Iterator[Paragraph]:
    """That a swing through a pole is one along each meridian."""
    if mode.pole is not None and (mode.shape or {}).get(mode.pole.radius, ZERO) != ZERO:
        yield Paragraph(("in the direction of any ", Name(next(iter(mode.pole.turning))), "."))


def where_real(where: Sequence[Above], *, several: bool = False) -> Iterator[Paragraph]:
    """For which times a charge is meant, where none divides by 0, and where it is real."""
    meant = [each for each in where if "t" in names_in(each) or _not_zero(each) is not None]
    if meant:
        yield Paragraph(("These are for " if several else "This is for ", *conditions(meant), "."))
    if others := [each for each in where if each not in meant]:
        subject, their = ("All of them are", "their") if several else ("It is", "its")
        rest = f"; otherwise {their} real and {their} imaginary part{'s' * several} are conserved."
        yield Paragraph((f"{subject} real for ", *conditions(others), rest))


def constraints_give(names: Collection[str]) -> str:
    """The beginning of a sentence on the rates that constraints give, one each."""
    return f"The constraint{'s give' if len(names) > 1 else ' gives'} "


def while_open(contacts: Sequence[object]) -> str:
    """When sentences without the forces of contacts hold; empty without contacts."""
    return f" while the contact{' is' if len(contacts) == 1 else 's are'} open" if contacts else ""


def none_found(
    what: str,
    vanishing: Sequence[Expression] | None,
    *,
    complete: bool,
    edge: Sequence[str] = (),
    where: str = "",
) -> Paragraph:
    """That there is none of what was sought, or that none is known."""
    if not complete:
        return Paragraph(("None was found.",))
    return Paragraph((*with_capital(unless(what + where, vanishing, edge)), "."))


def remark(answer: Answer) -> Iterator[Paragraph]:
    """What is said beside an answer, as a sentence."""
    remarks: tuple[Part, ...] = (answer.note,) if answer.note else ()
    if isinstance(answer, Solutions) and answer.remarks:
        remarks = answer.remarks
    if remarks:
        parts = with_capital(remarks)
        if isinstance(parts[-1], str):
            parts[-1] = parts[-1].rstrip(".")
        yield Paragraph((*parts, "."))


def irreducible(name: str, each: Irreducible, L: Name) -> list[Part]:
    """Why a coordinate that does not occur in L is not eliminated by its momentum."""
    q, p = Name(name), Name(f"p_{name}")
    if each.conserved:
        return [q, " is cyclic and ", p, f" is constant, but {each.why}, so ", q,
                " is not eliminated."]  # fmt: skip
    verdict = " is not conserved" if each.conserved is False else " need not be constant"
    return [q, " does not occur in ", L, ", but ", p, f"{verdict}: {each.why}."]
