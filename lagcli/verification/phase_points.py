"""Points of phase space: q, p, t and the parameters, with the gradient of H there.

Where there is a Lagrangian, p = dL/dq' of a random state, dH/dp = q' and dH/dq = -dL/dq (the
Legendre transform needs no formula of H); otherwise p is random and H is that of the file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from random import Random

from flint import arb

from lagcli.verification.linear import dot
from lagcli.verification.reference import Reference
from lagcli.verification.sweeps import StepValues, column

#: Numbers of names, each with its primes.
Environment = dict[tuple[str, int], arb]

#: The derivatives of a function with respect to q and to p.
Slopes = tuple[list[arb], list[arb]]

_HAMILTONIAN = "H"


class PhasePoint:
    """One point of phase space.

    Attributes
    ----------
    at : Values
        Of every formula of q, p, t, the parameters, and of H and other functions by their names.
    energy : arb
        H.
    by_q, by_p : list of arb
        dH/dq and dH/dp.
    """

    def __init__(
        self,
        reference: Reference,
        environment: Mapping[tuple[str, int], arb],
        energy: arb,
        slopes: Slopes,
        functions: Mapping[str, tuple[arb, Slopes]] | None = None,
    ) -> None:
        self.reference = reference
        self.environment = environment
        self.energy = energy
        self.by_q, self.by_p = self._slopes = slopes
        known = {_HAMILTONIAN: (energy, slopes), **(functions or {})}
        self._functions = {n: f for n, f in known.items() if (n, 0) not in environment}
        self.at = self.with_values({})

    def knowing(self, functions: Mapping[str, tuple[arb, Slopes]]) -> PhasePoint:
        """The point with names that stand for functions of q, p and t: values and derivatives."""
        return PhasePoint(self.reference, self.environment, self.energy, self._slopes, functions)

    def with_values(self, more: Mapping[tuple[str, int], arb]) -> StepValues:
        """The values of formulas that have further names."""
        named = {(name, 0): value for name, (value, _) in self._functions.items()}
        return self.reference.values({**named, **self.environment, **more})

    def slopes(self, place: int) -> Slopes:
        """The derivatives of a formula with respect to q and to p."""
        found = self.at.gradient(place)
        by_q, by_p = column(found, self.reference.q), column(found, self.reference.p)
        for name, (_, (of_q, of_p)) in self._functions.items():
            weight = found.get(self.reference.program.symbol(name))
            if weight is not None:
                by_q = [a + weight * b for a, b in zip(by_q, of_q, strict=True)]
                by_p = [a + weight * b for a, b in zip(by_p, of_p, strict=True)]
        return by_q, by_p

    def bracket(self, f: int, g: int) -> arb:
        """{f, g} = sum_j (df/dq_j dg/dp_j - df/dp_j dg/dq_j)."""
        return poisson(self.slopes(f), self.slopes(g))

    def rate(self, place: int) -> arb:
        """{f, H} + the partial derivative of f with respect to t."""
        drift = self.at.gradient(place).get(self.reference.time, arb(0))
        return poisson(self.slopes(place), self._slopes) + drift


def poisson(f: Slopes, g: Slopes) -> arb:
    """The bracket of two functions by their derivatives with respect to q and p."""
    return dot(f[0], g[1]) - dot(f[1], g[0])


class PhaseState:
    """A state of a system whose H has no Lagrangian: nothing is said of its velocities.

    Attributes
    ----------
    at : Values
        Of every formula of q, p, t and the parameters.
    phase : PhasePoint
        The point.
    """

    def __init__(self, reference: Reference, environment: Environment) -> None:
        self.reference = reference
        self.environment = environment
        self.at = reference.values(environment)
        given = reference.problem.hamiltonian
        assert given is not None
        H = reference.place(given)
        found = self.at.gradient(H)
        slopes = column(found, reference.q), column(found, reference.p)
        self.phase = PhasePoint(reference, environment, self.at(H), slopes)


def with_momenta(reference: Reference, environments: Iterator[Environment]) -> Iterator[PhaseState]:
    """States with random momenta at which H has a value."""
    random = Random(17)
    for environment in environments:
        momenta = {
            (f"p_{name}", 0): arb(random.randint(-1500, 1500)) / 1024 for name in reference.names
        }
        state = PhaseState(reference, {**environment, **momenta})
        if state.phase.energy.is_finite():
            yield state
