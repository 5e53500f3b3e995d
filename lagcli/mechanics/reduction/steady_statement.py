"""The section `steady_motions` in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.algebra.equations import written
from lagcli.expression import Expression
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.oscillations.equilibria import at
from lagcli.mechanics.oscillations.feeding import cannot_feed
from lagcli.mechanics.oscillations.linearization import Linearization, Matrix
from lagcli.mechanics.reduction.readable import conditions
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.statement import Missing
from lagcli.mechanics.reduction.steady import Steady, SteadyMotions
from lagcli.mechanics.reduction.verdict import Verdict, curvature, verdict
from lagcli.motions import Above, SteadyMotion, SteadySection


def steady_motions(derivation: Derivation) -> tuple[SteadySection, Missing]:
    """The steady motions with their stability, and what was not found."""
    routh = Routh(derivation)
    if routh.reduced is None:
        return (
            SteadySection(conditions={}, motions=None, reason=routh.reason),
            [("the steady motions", routh.reason)],
        )
    return _Statement(SteadyMotions(routh)).section()


class _Statement:
    def __init__(self, steady: SteadyMotions) -> None:
        self.steady = steady
        self.routh = steady.routh
        momenta = tuple(p.name for p in self.routh.momenta)
        names = tuple(n for n in steady.full.order if n not in momenta)
        self.order = names + momenta

    def section(self) -> tuple[SteadySection, Missing]:
        steady = self.steady
        found = steady.motions
        conditions = (
            {
                q.name: self._shape(c)
                for q, c in zip(steady.system.q, steady.conditions, strict=True)
            }
            if self.routh.quadratic
            else {}
        )
        if found is None:
            return (
                SteadySection(
                    conditions=conditions, motions=None, complete=False, reason=steady.reason
                ),
                [("the steady motions", steady.reason)],
            )
        return (
            SteadySection(
                conditions=conditions,
                motions=tuple(map(self._motion, found)),
                complete=steady.complete,
            ),
            [],
        )

    def _motion(self, motion: Steady) -> SteadyMotion:
        linear = None
        judged = Verdict(None, None, False, (), "the equations of motion are singular there")
        try:
            if motion.curvature is None:
                linear = Linearization(self.steady.rest, self.steady.point(motion))
                judged = verdict(linear)
            else:
                [[mass]] = self.steady.dynamics.lagrange.mass_matrix
                judged = curvature(motion.curvature, at(mass, motion.values), motion.positive)
                if not cannot_feed(self.steady.system):
                    reason = "a force without a potential acts"
                    judged = Verdict(None, None, False, judged.squares, reason)
        except ZeroDivisionError:
            pass
        system, names = self.steady.system, self.steady.full.names
        rates = motion.rates
        minimum = self._conditions(judged.minimum, motion)
        coordinates = {q.name: motion.values[q] for q in system.q if q in motion.values}
        momenta = {
            names[j]: motion.values.get(p, p)
            for j, p in zip(self.routh.cyclic, self.routh.momenta, strict=True)
        }
        return SteadyMotion(
            at={name: self._shape(value) for name, value in coordinates.items()},
            free=self._free(motion),
            rates=None
            if rates is None
            else {names[j]: self._shape(rate) for j, rate in rates.items()},
            momenta={name: self._shape(value) for name, value in momenta.items()},
            where=self._conditions(motion.positive, motion, given=True) or (),
            mirrored=motion.mirrored,
            stable=True if minimum == () else False if judged.unstable else None,
            minimum=minimum,
            spectrum=self._conditions(judged.spectrum, motion),
            frequencies_squared=tuple(map(self._shape, judged.squares)),
            mass=self._matrix(linear.M) if linear else (),
            velocity=self._matrix(linear.C) if linear else (),
            stiffness=self._matrix(linear.K) if linear else (),
            reason=judged.reason,
        )

    def _conditions(
        self, expressions: Sequence[Expr] | None, motion: Steady, *, given: bool = False
    ) -> tuple[Above, ...] | None:
        if expressions is None:
            return None
        return conditions(expressions, self.order, () if given else motion.positive)

    def _free(self, motion: Steady) -> tuple[str, ...]:
        """Coordinates, rates and momenta that the state is a function of."""
        full = self.steady.full
        values = [*motion.values.values(), *(motion.rates or {}).values()]
        used = {s for value in values for s in value.free_symbols}
        places = [q for q in self.steady.system.q if q not in motion.values]
        others = [s for s in (*full.qdot, *self.routh.momenta) if s in used]
        return tuple(s.name for s in (*places, *others))

    def _matrix(self, matrix: Matrix) -> tuple[tuple[Expression, ...], ...]:
        return tuple(tuple(map(self._shape, row)) for row in matrix)

    def _shape(self, expression: Expr) -> Expression:
        return written(expression, self.order)
