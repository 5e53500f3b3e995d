"""Words and names of an explanation: lists, counts, and letters that the file leaves free."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from lagcli.document import Equations, Formula, Label, Paragraph, Row
from lagcli.expression import Call, Expression, Name, Negative, Sum
from lagcli.notation.given_formulas import names_of, symbols_of
from lagcli.notation.letters import names_in
from lagcli.notation.naming import free
from lagcli.problem_data import Problem
from lagcli.statements.answers import EquilibriaSection
from lagcli.statements.explanation import Explanation, ExplanationStep
from lagcli.statements.motions import Above, SteadySection
from lagcli.statements.wording import capitalized, conditions, constraints_named

Part = str | Formula

_COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def counted(number: int, noun: str, plural: str = "") -> str:
    """One constraint, two constraints."""
    word = _COUNTS[number] if number < len(_COUNTS) else str(number)
    return f"{word} {noun if number == 1 else plural or noun + 's'}"


def listed(parts: Sequence[Part | Sequence[Part]]) -> list[Part]:
    """Parts with commas between them, and "and" before the last."""
    result: list[Part] = []
    for position, part in enumerate(parts):
        if position:
            result.append(" and " if position == len(parts) - 1 else ", ")
        if isinstance(part, (str, Expression)) or not isinstance(part, Sequence):
            result.append(part)
        else:
            result += part
    return result


def quoted(names: Iterable[str]) -> str:
    """'rod' and 'floor'."""
    parts = listed([f"'{name}'" for name in names])
    return "".join(part for part in parts if isinstance(part, str))


def names(words: Iterable[str], primes: int = 0) -> list[Part]:
    """The names as formulas, listed."""
    return listed([Name(word, primes) for word in words])


def says(*parts: Part | Sequence[Part]) -> Paragraph:
    """A paragraph of parts and lists of parts."""
    flat: list[Part] = []
    for part in parts:
        if isinstance(part, (list, tuple)):
            flat += part
        else:
            flat.append(part)  # type: ignore[arg-type]
    return Paragraph(tuple(flat))


def shows(left: Formula, right: Expression, note: str = "") -> Equations:
    """One displayed equation."""
    return Equations((Row(left, right, note),))


def constraints_allow(number: int) -> str:
    """That of one constraint, or of more."""
    return "the constraint allows" if number == 1 else "the constraints allow"


def displacements(
    constraints: int,
    free: Sequence[str],
    where: Sequence[Above],
    *,
    closed: Sequence[str] = (),
    lost: Sequence[str] = (),
    pole: tuple[str, str] | None = None,
) -> Iterator[Paragraph]:
    """Which displacements linear equations are about, and where these are finite.

    The contacts `closed` stay so, the one-sided constraints `lost` do not act.  At a `pole` of a
    distance r and an angle φ they are those of r cos φ and r sin φ.
    """
    parts: list[Part] = []
    allowed = [constraints_allow(constraints)] if constraints else []
    allowed += [f"keep {constraints_named('the contact', closed)} closed"] if closed else []
    if allowed:
        parts += [f"restricted to the displacements that {' and that '.join(allowed)}"]
        parts += [", in terms of those of ", *names(free)] if free else []
    if lost:
        verb = "is" if len(lost) == 1 else "are"
        parts += [", " * bool(parts), f"while {constraints_named('the contact', lost)} {verb} open"]
    if pole is not None:
        r, phi = map(Name, pole)
        first, second = Call("cos", (phi,)), Call("sin", (phi,))
        parts += [", "] if parts else []
        parts += ["in the displacement of ", r, " times ", first, " and, in the last row, times "]
        parts += [second]
    if where:
        parts += [", for " if parts else "for ", *conditions(where)]
    if parts:
        yield says(*parts, ".")


def no_solution(lead: str, found: EquilibriaSection | SteadySection) -> str:
    """That there is none: in general, where special values were not excluded."""
    general = "in general " * (found.unless is None)
    return capitalized(f"{general}{lead} solution")


def difference(first: Expression, second: Expression) -> Expression:
    """First − second."""
    return Sum((first, Negative(second)))


def matrix_law(*, constrained: bool) -> tuple[str | Label, ...]:
    """M q'' = F + A^T lambda and A q'' + b = 0, in words."""
    M, F = Label("M", matrix=True), Label("F", matrix=True)
    if not constrained:
        return (M, " · accelerations = ", F)
    A, b = Label("A", matrix=True), Label("b", matrix=True)
    return (
        M, " · accelerations = ", F, " + ", A, " transposed · multipliers and ",
        A, " · accelerations + ", b, " = 0",
    )  # fmt: skip


_PAIRS = ("AB", "fg", "uv", "XY", "FG")


class Letters:
    """The letters of mechanics, with `_sys` added where the file means something else by them."""

    def __init__(self, problem: Problem) -> None:
        self._taken = names_of(problem)
        self._observables = tuple(problem.observables)
        self.L, self.T, self.V, self.D, self.h, self.Q, self.G = map(self.free, "LTVDhQG")
        #: any one of the coordinates, where there are several
        self.several = len(problem.coordinates) > 1
        self.q = self.free("q_j") if self.several else Name(problem.coordinates[0].name)
        self.velocity = Name(self.q.name, 1)
        self.force = self.free(f"Q_{'j' if self.several else self.q.name}")

    def moved(self, steps: Sequence[ExplanationStep]) -> Iterator[Paragraph]:
        """That another letter stands for what has one of these, where the steps have it."""
        used = names_in(steps)
        moved = [x for x in "LTVDhQG" if x in self._taken and self.free(x).name in used]
        if moved:
            one = len(moved) == 1
            yield says(
                *names(moved),
                f" {'means' if one else 'mean'} something else in this file, so the usual "
                f"{'quantity has' if one else 'quantities have'} the index 'sys' here.",
            )

    @property
    def pair(self) -> str:
        """Letters of any two functions: A and B, or others where the file has one of these."""
        taken = {*self._taken, *self._observables}
        return next((p for p in _PAIRS if taken.isdisjoint(p)), _PAIRS[0])

    def free(self, letter: str) -> Name:
        """The letter, or another one where the file has it."""
        return Name(free(self._taken, letter))

    def f(self, constraint: str) -> Name:
        """Left side minus right side of a constraint."""
        return self.free(f"f_{constraint}")


def explained(
    problem: Problem,
    degrees_of_freedom: int,
    steps: Sequence[ExplanationStep],
    missing: tuple[str, ...],
) -> Explanation:
    """The steps for a problem, with a warning for each part that is missing."""
    return Explanation(
        title=problem.title,
        coordinates=tuple(q.name for q in problem.coordinates),
        parameters=tuple(p.name for p in problem.parameters),
        degrees_of_freedom=degrees_of_freedom,
        steps=tuple(steps),
        symbols=symbols_of(problem),
        warnings=missing,
        complete=not missing,
    )
