"""What a verdict on stability claims, put to the motion itself.

Near each equilibrium and steady motion the whole problem is run from states a little beside it, with
all its forces, contacts and constraints, each run with its certificate.  What is called stable
must stay: the distance stays below a multiple of the first one.  What is called unstable must be
left: by a distance that is a large multiple of the first one.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from sympy import Expr, Symbol

from lagcli.diagnostics import ProblemError
from lagcli.expression import Expression, Name, Negative, Number, Power, Sum
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.parameter_values import parameter_values, random_parameter
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.problem_data import Problem
from lagcli.reader.columns import usual_columns
from lagcli.record import replace
from lagcli.statements.answers import Equilibrium
from lagcli.statements.motions import Above, SteadyMotion, Verdict

#: First distance of the runs.
BESIDE = 1e-5
#: What is called stable stays within this multiple of the first distance …
STAYS = 300.0
#: … and what is called unstable is left by more than this one, at the latest at the last time.
LEAVES = 50.0
TIMES = (25.0, 200.0)
#: A fall from the height d ends with sqrt(2 g d): with contacts it stays within this multiple.
STAYS_IN_CONTACT = 3000.0
#: Impacts take long to compute.
WITH_IMPACTS = (6.0, 30.0)
#: A condition is taken to hold, or to fail, where it does so by this part of its sides.
MARGIN = 0.05
TRIES = 40
#: Beyond this distance the state is left, and the run ends.
FAR = 0.25


@dataclass(frozen=True)
class Claim:
    """One state of a problem with numbers for its parameters, and what is said about it."""

    title: str
    problem: Problem
    state: Mapping[str, float]  # q and q' by name
    drifting: frozenset[str]  # what may change along a family
    stable: bool


class Numbers:
    """Numbers for the parameters and for what is free."""

    def __init__(self, derivation: Derivation, source: random.Random) -> None:
        self.system, self.source = derivation.system, source
        given = parameter_values(self.system)
        self.values: dict[Symbol, Expr] = {}
        for p in self.system.parameters:
            value = given.get(p) or random_parameter(source, p, wide=False)
            self.values[p] = self.system.build(_number(float(value)))

    def of(self, name: str) -> None:
        """Choose a value for what is free."""
        symbol = self.system.symbol_of(name)
        if symbol not in self.values:
            sign = 1 if symbol.is_positive else self.source.choice((1, -1))
            self.values[symbol] = self.system.build(
                _number(sign * self.source.uniform(0.6, 1.6) * self.source.choice((1, 1, 3, 5)))
            )

    def __call__(self, expression: Expression) -> float | None:
        value = self.system.build(expression).subs(self.values).evalf(30)
        return float(value) if value.is_Float or value.is_Rational else None

    def holds(self, each: Above) -> bool | None:
        """Whether an inequality holds with those beside it, or fails, by a margin."""
        if each.besides:
            found = {self.holds(part) for part in (replace(each, besides=()), *each.besides)}
            return False if False in found else None if None in found else True
        left, right = self(each.left), self(each.right)
        if left is None or right is None:
            return None
        room = MARGIN * (abs(left) + abs(right))
        return True if left - right > room else False if right - left > room else None

    def all_hold(self, where: Sequence[Above]) -> bool:
        return all(self.holds(each) is True for each in where)


def claims(derivation: Derivation, seed: int = 0) -> Iterator[Claim]:
    """Every state about which something definite is said, at random numbers."""
    source = random.Random(seed)
    for state in equilibria(derivation.dynamics).equilibria or ():
        found = _claim(derivation, state, source)
        if found is not None:
            yield found
    for motion in steady_motions(derivation)[0].motions or ():
        found = _claim(derivation, motion, source)
        if found is not None:
            yield found


def _claim(
    derivation: Derivation, stated: Equilibrium | SteadyMotion, source: random.Random
) -> Claim | None:
    if stated.on is not None or (isinstance(stated, SteadyMotion) and stated.rates is None):
        return None
    if isinstance(stated, Equilibrium) and _released(derivation.problem, stated):
        return None
    for _ in range(TRIES):
        numbers = Numbers(derivation, source)
        for name in stated.free:
            numbers.of(name)
        state = _state(stated, numbers)
        if state is None or not numbers.all_hold(stated.where):
            continue
        stable = _says(stated.verdict, numbers)
        if stable is not None:
            problem = replace(
                derivation.problem,
                parameters=tuple(
                    replace(p, value=_number(float(numbers.values[s])))
                    for p, s in zip(
                        derivation.problem.parameters, derivation.system.parameters, strict=True
                    )
                ),
            )
            return Claim(derivation.problem.title, problem, state, _drifting(stated), stable)
    return None


def _released(problem: Problem, state: Equilibrium) -> bool:
    """Whether a constraint is open there: runs begin with all of them closed."""
    return any(c.on_loss == "release" and c.name not in state.touching for c in problem.constraints)


def _says(verdict: Verdict, numbers: Numbers) -> bool | None:
    if verdict.rapid is not None:
        return None  # of the averaged motion, where the drive is rapid and its amplitude small
    if verdict.stable is not None:
        return verdict.stable
    if any(numbers.holds(each) for each in verdict.unstable):
        return False
    enough = (verdict.minimum, verdict.hurwitz, verdict.spectrum)
    return any(each is not None and numbers.all_hold(each) for each in enough) or None


def _state(stated: Equilibrium | SteadyMotion, numbers: Numbers) -> dict[str, float] | None:
    state = {name: numbers(value) for name, value in stated.at.items()}
    places = [name for name in stated.free if "'" not in name and not name.startswith("p_")]
    state |= {name: numbers(Name(name)) for name in places}
    if isinstance(stated, SteadyMotion):
        for name, rate in (stated.rates or {}).items():
            state |= {name: 0.0, name + "'": numbers(rate)}
    state |= {
        name + "'": 0.0 for name in list(state) if "'" not in name and name + "'" not in state
    }
    return None if None in state.values() else {k: v for k, v in state.items() if v is not None}


def _drifting(stated: Equilibrium | SteadyMotion) -> frozenset[str]:
    if isinstance(stated, Equilibrium):
        return frozenset(stated.free)
    along = [n for n in stated.free if "'" not in n] if stated.verdict.across else []
    return frozenset([*along, *(stated.rates or {})])


def contradiction(claim: Claim, seed: int = 0) -> str:
    """What the motion says against a claim; empty where it agrees or cannot be run."""
    source = random.Random(seed)
    ratio = 0.0
    times = WITH_IMPACTS if claim.problem.contacts else TIMES
    for until in times[: 1 if claim.stable else 2]:
        for _ in range(1):
            found = _farthest(claim, until, source)
            if found is None:
                continue
            ratio = max(ratio, found)
        if claim.stable and ratio > (STAYS_IN_CONTACT if claim.problem.contacts else STAYS):
            return f"called stable, and left by {ratio:.0f} times the first distance"
        if not claim.stable and ratio > LEAVES:
            return ""
    if claim.stable or not ratio:
        return ""
    return f"called unstable, and left by {ratio:.0f} times the first distance only"


def _farthest(claim: Claim, until: float, source: random.Random) -> float | None:
    """The largest distance over the first one; None where the run was refused."""
    beside = {k: v + BESIDE * source.uniform(-1, 1) for k, v in claim.state.items()}
    beside |= {k: v for k, v in claim.state.items() if k in claim.drifting}
    problem = replace(
        claim.problem,
        initial={
            Name(k.rstrip("'"), 1 if k.endswith("'") else 0): _number(v) for k, v in beside.items()
        },
    )
    columns = tuple(usual_columns(problem))
    asked = RunRequest(
        until=until,
        accuracy=1e-6,
        samples=101,
        columns=columns,
        project=True,
        stop_when=_left(claim),
    )
    try:
        result = simulate(problem, asked)
    except (Refusal, ProblemError):
        return None
    watched = [
        (k, result.columns.index(k), v) for k, v in claim.state.items() if k not in claim.drifting
    ]
    first = max(BESIDE, *(abs(result.rows[0][j] - v) for _, j, v in watched))
    return max(abs(row[j] - v) for row in result.rows for _, j, v in watched) / first


def _left(claim: Claim) -> Expression:
    """What changes its sign at the distance FAR from the state: the run may end there."""
    parts: list[Expression] = [Negative(_number(FAR**2))]
    for name, value in claim.state.items():
        if name not in claim.drifting:
            here = Name(name.rstrip("'"), 1 if name.endswith("'") else 0)
            parts.append(Power(Sum((here, _number(-value))), Number(Fraction(2))))
    return Sum(tuple(parts))


def _number(value: float) -> Expression:
    found = Number(Fraction(abs(value)).limit_denominator(10**12))
    return Negative(found) if value < 0 else found
