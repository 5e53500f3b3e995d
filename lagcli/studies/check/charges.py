"""What is expected of one charge against what was derived."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.problem_data import NOT_CONSERVED
from lagcli.statements.answers import Charge
from lagcli.studies.check.findings import Finding

if TYPE_CHECKING:
    from lagcli.studies.check.expectations import Expectations


def not_conserved(
    check: Expectations, path: Sequence[str], charge: Charge | None
) -> Finding | None:
    """A momentum that is not listed belongs to a coordinate that is not cyclic."""
    verdict = None if charge is None else charge.conserved
    if charge is None and path[-1].startswith("p_"):
        verdict = _momentum_conserved(check, path[-1].removeprefix("p_"))
    negated = None if verdict is None else not verdict
    return check.judge(path, negated, f"'{NOT_CONSERVED}'", "a conserved charge")


def _momentum_conserved(check: Expectations, coordinate: str) -> bool | None:
    system, dynamics = check.derivation.system, check.derivation.dynamics
    place = system.names.index(coordinate)
    rate = system.total_derivative(dynamics.lagrange.momenta[place])
    on_motion = dynamics.on_motion(rate)
    return None if on_motion is None else check.comparison.vanishes(on_motion)


def conserved(
    check: Expectations, path: Sequence[str], charges: Mapping[str, Charge], expected: Expression
) -> Finding | None:
    """The charge of that name, or (where a candidate gives it already) the same charge."""
    name = path[-1]
    listed = [charges[name]] if name in charges else list(charges.values())
    found = [c.charge for c in listed if c.conserved and c.charge is not None]
    if not found:
        if any(c.conserved is None for c in listed):
            return check.undecided(path, "nobody knows if it is conserved")
        if any(c.trivial for c in listed):
            return check.wrong(path, "derived: constant whatever the motion is")
        return check.wrong(path, "derived: not conserved")
    verdicts = [check.comparison.same_charge(each, expected) for each in found]
    return check.judge_any(path, verdicts, to_grammar(expected), to_grammar(found[0]))
