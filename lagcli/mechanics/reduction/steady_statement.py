"""The section `steady_motions` in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.algebra.build import free_of
from lagcli.algebra.equations import written
from lagcli.expression import Expression
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.oscillations.equilibria import at
from lagcli.mechanics.oscillations.family import Family
from lagcli.mechanics.oscillations.family_statement import relation_sides, shown, untied
from lagcli.mechanics.oscillations.feeding import cannot_feed
from lagcli.mechanics.oscillations.linearization import Linearization, Matrix
from lagcli.mechanics.reduction.readable import conditions, without_moduli
from lagcli.mechanics.reduction.rolling import RollingMotions
from lagcli.mechanics.reduction.rolling_statement import rolling_section
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.statement import Missing
from lagcli.mechanics.reduction.steady import Steady, SteadyMotions
from lagcli.mechanics.reduction.verdict import Verdict, curvature, verdict
from lagcli.motions import Above, SteadyMotion, SteadySection
from lagcli.record import replace


def steady_motions(derivation: Derivation) -> tuple[SteadySection, Missing]:
    """The steady motions with their stability, and what was not found."""
    if RollingMotions.applies(derivation):
        rolling = RollingMotions(derivation)
        if rolling.motions is not None:
            return rolling_section(rolling), []
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
        motion = replace(
            motion,
            values={
                x: without_moduli(value, motion.positive) for x, value in motion.values.items()
            },
            rates=None
            if motion.rates is None
            else {j: without_moduli(rate, motion.positive) for j, rate in motion.rates.items()},
        )
        matrices: tuple[Matrix, ...] = ()
        judged = Verdict(None, None, False, (), "the equations of motion are singular there")
        try:
            if motion.curvature is None:
                linear = Linearization(self.steady.rest, self.steady.point(motion))
                judged, matrices = verdict(linear), (linear.M, linear.C, linear.K)
                if motion.family is not None:
                    judged, matrices = self._on_all(motion.family, judged, matrices)
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
        point = self.steady.point(motion)
        fixed = shown(point)
        coordinates = {q.name: fixed[q] for q in system.q if q in fixed}
        momenta = {
            names[j]: self._whole(motion.values.get(p, p), motion)
            for j, p in zip(self.routh.cyclic, self.routh.momenta, strict=True)
        }
        return SteadyMotion(
            at={name: self._shape(value) for name, value in coordinates.items()},
            free=self._free(motion),
            rates=None
            if rates is None
            else {names[j]: self._shape(self._whole(rate, motion)) for j, rate in rates.items()},
            momenta={name: self._shape(value) for name, value in momenta.items()},
            where=self._conditions(motion.positive, motion, given=True) or (),
            mirrored=motion.mirrored,
            stable=True if minimum == () else False if judged.unstable else None,
            minimum=minimum,
            spectrum=self._conditions(judged.spectrum, motion),
            frequencies_squared=tuple(
                self._shape(without_moduli(w, motion.positive)) for w in judged.squares
            ),
            mass=self._matrix(matrices[0]) if matrices else (),
            velocity=self._matrix(matrices[1]) if matrices else (),
            stiffness=self._matrix(matrices[2]) if matrices else (),
            reason=judged.reason,
            on=relation_sides(point, system.q, self.order),
        )

    def _conditions(
        self, expressions: Sequence[Expr] | None, motion: Steady, *, given: bool = False
    ) -> tuple[Above, ...] | None:
        if expressions is None:
            return None
        if given:
            shortest = sorted(expressions, key=lambda e: int(e.count_ops()))
            return conditions(shortest, self.order)
        found = conditions(expressions, self.order, motion.positive)
        turning = [v**2 for v in self.steady.full.qdot if v in motion.free_rates]
        if found and turning:
            short = conditions(expressions, self.order, (*motion.positive, *turning))
            if short != found:
                return (*conditions(turning, self.order), *short)
        return found

    def _free(self, motion: Steady) -> tuple[str, ...]:
        """Coordinates, rates and momenta that the state is a function of."""
        full = self.steady.full
        values = [*motion.values.values(), *(motion.rates or {}).values()]
        used = {s for value in values for s in value.free_symbols}
        places = untied(self.steady.point(motion), self.steady.system.q)
        others = [s for s in (*full.qdot, *self.routh.momenta) if s in used]
        return tuple(s.name for s in (*places, *others))

    def _on_all(
        self, family: Family, judged: Verdict, matrices: Sequence[Matrix]
    ) -> tuple[Verdict, tuple[Matrix, ...]]:
        """What was found on a branch, as far as it holds on the whole family."""
        squares = [family.written_back(square) for square in judged.squares]
        if not squares or any(s is None or not free_of(s, self.steady.system.q) for s in squares):
            judged = Verdict(None, None, False, (), "the motion near it differs along the family")
        whole = [[[family.written_back(e) for e in row] for row in m] for m in matrices]
        if any(e is None for m in whole for row in m for e in row):
            return judged, ()
        return judged, tuple([[e for e in row if e is not None] for row in m] for m in whole)

    def _whole(self, value: Expr, motion: Steady) -> Expr:
        """A rate or a momentum, of a family in all coordinates where it can be."""
        back = None if motion.family is None else motion.family.written_back(value)
        return value if back is None else back

    def _matrix(self, matrix: Matrix) -> tuple[tuple[Expression, ...], ...]:
        return tuple(tuple(map(self._shape, row)) for row in matrix)

    def _shape(self, expression: Expr) -> Expression:
        return written(expression, self.order)
