"""The members of an ensemble: `--vary theta=0:3.14:200 --vary m=1,2,4`, or random draws."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from random import Random
from typing import TYPE_CHECKING

from lagcli.diagnostics import ProblemError
from lagcli.evaluation import value_of
from lagcli.problem_data import Problem
from lagcli.reader.columns import read_number
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record, replace

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import RunRequest

#: More members are a mistake rather than a request: a row takes 100 bytes at least.
MOST = 10_000_000


class WrongPlan(Exception):
    """What is wrong with the options, one sentence each."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("; ".join(lines))
        self.lines = tuple(lines)


@record
class SweptRange:
    """What one quantity takes.

    Attributes
    ----------
    name : str
        A parameter, a coordinate or a velocity.
    values : tuple of float
        All of them; of a random plan its two ends.
    """

    name: str
    values: tuple[float, ...]


@record(kw_only=True)
class Plan:
    """The ensemble.

    Attributes
    ----------
    parameters, state : tuple of Range
        In the order of the command line; the last varies fastest.
    random : int or None
        How many are drawn uniformly between the ends of each range.
    seed : int
    """

    parameters: tuple[SweptRange, ...]
    state: tuple[SweptRange, ...]
    random: int | None = None
    seed: int = 0

    @property
    def names(self) -> tuple[str, ...]:
        """What is varied."""
        return tuple(each.name for each in (*self.parameters, *self.state))

    @property
    def columns(self) -> tuple[str, ...]:
        """The headings of what is varied; `theta(0)` is an initial value."""
        of_state = (f"{each.name}(0)" for each in self.state)
        return (*(each.name for each in self.parameters), *of_state)

    @property
    def count(self) -> int:
        """How many members there are."""
        if self.random is not None:
            return self.random
        return math.prod(len(each.values) for each in (*self.parameters, *self.state))

    def members(self) -> Iterator[tuple[float, ...]]:
        """The values of each member, in the order of `names`; parameters vary slowest."""
        ranges = [each.values for each in (*self.parameters, *self.state)]
        if self.random is None:
            yield from product(*ranges)
            return
        draw = Random(self.seed)
        for _ in range(self.random):
            yield tuple(draw.uniform(values[0], values[-1]) for values in ranges)


def plan_of(problem: Problem, vary: Sequence[str], random: int | None, seed: int) -> Plan:
    """Read the options.

    Parameters
    ----------
    problem : Problem
        Its parameters, coordinates and velocities can be varied.
    vary : sequence of str
        Each `name=first:last:count`, `name=first:last:count:log` or `name=a,b,c`; of a random
        plan `name=first:last`.
    random : int or None
        How many members are drawn.
    seed : int
        Of the draws.

    Raises
    ------
    WrongPlan
        With all that is wrong.
    """
    parameters = [one.name for one in problem.parameters]
    state = [name for one in problem.coordinates for name in (one.name, f"{one.name}'")]
    found: dict[str, SweptRange] = {}
    wrong: list[str] = []
    for text in vary:
        try:
            each = _range(text, [*parameters, *state], random=random is not None)
        except ValueError as error:
            wrong.append(f"--vary {text}: {error}")
            continue
        if each.name in found:
            wrong.append(f"--vary {text}: {each.name} is varied twice")
        found[each.name] = each
    if not vary:
        wrong.append("what varies? give --vary NAME=FIRST:LAST:COUNT or --vary NAME=A,B,C")
    plan = Plan(
        parameters=tuple(each for each in found.values() if each.name in parameters),
        state=tuple(each for each in found.values() if each.name in state),
        random=random,
        seed=seed,
    )
    if not wrong and plan.count > MOST:
        wrong.append(f"{plan.count:,} members are too many: at most {MOST:,}")
    if wrong:
        raise WrongPlan(wrong)
    return plan


def times_of(text: str) -> tuple[float, ...]:
    """The times of rows, as `first:last:count` or `a,b,c`.

    Raises
    ------
    WrongPlan
        When they do not increase, or one is not after 0.
    """
    try:
        parts = [part.strip() for part in text.split(":")]
        times = _spaced(parts) if len(parts) > 1 else tuple(map(_number, text.split(",")))
    except ValueError as error:
        raise WrongPlan([f"--times {text}: {error}"]) from None
    if any(a >= b for a, b in pairwise((0.0, *times))):
        raise WrongPlan([f"--times {text}: times increase, and all are after 0"])
    return times


def at_times(request: RunRequest, times: Sequence[float]) -> RunRequest:
    """The same run with rows at these times, the last of which is its end."""
    if not times:
        return request
    given = (0.0, *times)
    return replace(request, times=given, until=given[-1], samples=len(given))


def _range(text: str, names: Sequence[str], *, random: bool) -> SweptRange:
    name, equals, rest = text.partition("=")
    name = name.strip()
    if not equals or not rest.strip():
        raise ValueError("write NAME=FIRST:LAST:COUNT or NAME=A,B,C")
    if name not in names:
        hint = did_you_mean(name, names) or f"known are {', '.join(names)}"
        raise ValueError(f"there is no parameter, coordinate or velocity {name!r}: {hint}")
    parts = [part.strip() for part in rest.split(":")]
    if random:
        if len(parts) != 2:
            raise ValueError("a random plan draws between two ends: write NAME=FIRST:LAST")
        return SweptRange(name, (_number(parts[0]), _number(parts[1])))
    if len(parts) == 1 and ".." in rest:
        raise ValueError("a range is FIRST:LAST:COUNT")
    if len(parts) == 1:
        return SweptRange(name, tuple(_number(part) for part in rest.split(",")))
    return SweptRange(name, _spaced(parts))


def _spaced(parts: Sequence[str]) -> tuple[float, ...]:
    """`first:last:count`, evenly, or in equal ratios with `:log`."""
    logarithmic = len(parts) == 4 and parts[3] == "log"
    if len(parts) != 3 and not logarithmic:
        raise ValueError("a range is FIRST:LAST:COUNT, or FIRST:LAST:COUNT:log")
    first, last = _number(parts[0]), _number(parts[1])
    if not parts[2].isdecimal() or not 1 <= int(parts[2]) <= MOST:
        raise ValueError(f"the count is a whole number from 1 to {MOST:,}, not {parts[2]!r}")
    count = int(parts[2])
    if logarithmic and not (first > 0 and last > 0):
        raise ValueError("equal ratios need ends above 0")
    if count == 1:
        return (first,)
    steps = [k / (count - 1) for k in range(count)]
    if logarithmic:
        return (*(first * (last / first) ** step for step in steps[:-1]), last)
    return (*(first + (last - first) * step for step in steps[:-1]), last)


def _number(text: str) -> float:
    """A number, also an expression such as `pi/2`."""
    try:
        value = value_of(read_number(text, "--vary"))
    except ProblemError as error:
        raise ValueError(error.diagnostics[0].message) from None
    except ArithmeticError:
        value = None
    if value is None or not math.isfinite(float(value)):
        raise ValueError(f"{text!r} is not a number")
    return float(value)
