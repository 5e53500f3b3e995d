"""The values of a program in balls, and its derivatives of first and second order.

Forward sweeps carry values and rates, backward sweeps gradients and their rates along one
direction d (the product of the Hessian with d); see Griewank, Walther, *Evaluating
Derivatives*, 2nd ed. (SIAM, 2008), section 5.1.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Protocol

from flint import arb

from lagcli.verification.functions import ELEMENTARY, Instance, ball, power
from lagcli.verification.program import Key, VerificationProgram
from lagcli.verification.quadrature import quadrature


class Environment(Protocol):
    """What the symbols are: name with primes -> value."""

    def get(self, key: Key, /) -> arb | None:
        """The value; None where there is none."""


class Inside:
    """The symbols inside an integral: the variable has a value of its own."""

    def __init__(self, outer: Environment, key: Key, value: arb) -> None:
        self.outer, self.key, self.value = outer, key, value

    def get(self, key: Key, /) -> arb | None:
        """The value; None where there is none."""
        return self.value if key == self.key else self.outer.get(key)


class Unknown(Exception):
    """A formula has a name that nothing declares."""


class StepValues:
    """The values of steps where each symbol has a value, computed when needed.

    Parameters
    ----------
    program
        The steps.
    instances
        What the unspecified functions are.
    environment
        What the symbols are.
    """

    def __init__(
        self,
        program: VerificationProgram,
        instances: Mapping[str, Instance],
        environment: Environment,
    ) -> None:
        self.program = program
        self.instances = instances
        self.environment = environment
        self._known: dict[int, arb] = {}

    def __call__(self, place: int) -> arb:
        """The value of a step.

        Raises
        ------
        Unknown
            When it needs a symbol without a value.
        """
        known = self._known
        if place not in known:
            for each in self._missing(place):
                known[each] = self._value(each)
        return known[place]

    def _missing(self, root: int) -> list[int]:
        steps, known = self.program.steps, self._known
        seen: set[int] = set()
        stack = [root]
        while stack:
            place = stack.pop()
            if place not in seen and place not in known:
                seen.add(place)
                stack.extend(steps[place].parts)
        return sorted(seen)

    def _value(self, place: int) -> arb:
        kind, what, parts = self.program.steps[place]
        known = self._known
        if kind == "product":
            return known[parts[0]] * known[parts[1]]
        if kind == "sum":
            total = known[parts[0]]
            for part in parts[1:]:
                total = total + known[part]
            return total
        if kind == "number":
            assert isinstance(what, Fraction)
            return ball(what)
        if kind == "symbol":
            return self._symbol(what)  # type: ignore[arg-type]
        if kind == "power":
            assert isinstance(what, Fraction)
            return power(known[parts[0]], what)
        if kind == "integral":
            return self._integral(what, known[parts[0]], known[parts[1]])  # type: ignore[arg-type]
        arguments = [known[part] for part in parts]
        if kind == "call":
            return ELEMENTARY[str(what)](*arguments)
        name, by = what  # type: ignore[misc]
        return self.instances[name](arguments, by)  # type: ignore[has-type]

    def _integral(self, what: tuple[int, int], start: arb, end: arb) -> arb:
        inner, inside = what
        key = self.program.steps[inner].what

        def value(x: arb) -> arb:
            given = Inside(self.environment, key, x)  # type: ignore[arg-type]
            return StepValues(self.program, self.instances, given)(inside)

        return quadrature(value, start, end)

    def _symbol(self, key: Key) -> arb:
        value = self.environment.get(key)
        if value is not None:
            return value
        if key == ("pi", 0):
            return arb.pi()
        raise Unknown(key[0] + "'" * key[1])

    # -- derivatives ------------------------------------------------------------------------

    def rates(self, roots: Iterable[int], direction: Mapping[int, arb]) -> dict[int, arb]:
        """The derivative of each step below the roots along a direction of symbols.

        Steps that do not change are left out.
        """
        changing = dict(direction)
        slopes = self.program.slopes
        for place in self.program.order(roots):
            if place in changing:
                continue
            total = None
            for part, slope in slopes(place):
                rate = changing.get(part)
                if rate is not None:
                    term = rate if slope == self.program.one else self(slope) * rate
                    total = term if total is None else total + term
            if total is not None:
                changing[place] = total
        return changing

    def gradient(self, root: int) -> dict[int, arb]:
        """The derivative of the root by each step below it."""
        found = {root: arb(1)}
        for place in reversed(self.program.order([root])):
            weight = found.get(place)
            if weight is None:
                continue
            for part, slope in self.program.slopes(place):
                term = weight if slope == self.program.one else weight * self(slope)
                found[part] = found[part] + term if part in found else term
        return found

    def gradient_rates(
        self, root: int, gradient: Mapping[int, arb], direction: Mapping[int, arb]
    ) -> dict[int, arb]:
        """The derivative of the gradient along a direction: by each symbol, row times d.

        Parameters
        ----------
        root
            A step f.
        gradient
            What `gradient` gives for it.
        direction
            d, by the steps of symbols.

        Returns
        -------
        dict
            For a symbol s: sum_r d_r d^2 f/(dr ds); 0 where left out.
        """
        program, order = self.program, self.program.order([root])
        pairs = {place: program.slopes(place) for place in order}
        slopes = {slope for each in pairs.values() for _, slope in each}
        changing = self.rates(slopes, direction)
        found: dict[int, arb] = {}
        for place in reversed(order):
            own = found.get(place)
            for part, slope in pairs[place]:
                term = None
                if own is not None:
                    term = own if slope == program.one else own * self(slope)
                rate = changing.get(slope)
                if rate is not None:
                    other = gradient[place] * rate
                    term = other if term is None else term + other
                if term is not None:
                    found[part] = found[part] + term if part in found else term
        return found


def column(found: Mapping[int, arb], places: Sequence[int]) -> list[arb]:
    """The entries of a sweep at these steps, 0 where it has none."""
    return [found.get(place, _ZERO) for place in places]


_ZERO = arb(0)
