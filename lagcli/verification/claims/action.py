"""S = sum of W_i(q_i) - E t as it is printed, and what the Hamilton-Jacobi equation asks of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from random import Random

from flint import arb

from lagcli.expression import Expression
from lagcli.record import replace
from lagcli.statements.motions import Above, HamiltonJacobiSection
from lagcli.verification.claims.rest import conditions
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, dot, rank, solve
from lagcli.verification.newton import settled
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues, column

_STEPS = 30
_NEAR = 1e-20
#: States with moved constants until a condition holds at two; Kepler's with E < 0 takes some 10.
_ATTEMPTS, _WANTED = 300, 2


class Action:
    """The formulas of a section as steps.

    Attributes
    ----------
    names
        The coordinates that are left where constraints are solved.
    """

    def __init__(self, x: Examination, section: HamiltonJacobiSection) -> None:
        self.x, self.section = x, section
        program, what = x.reference.program, "the Hamilton-Jacobi equation"
        derivatives = section.derivatives or {}
        H = x.places(what, [section.hamiltonian] if section.hamiltonian is not None else [])
        left = derivatives or {name.removeprefix("p_") for name, _ in program.symbols(H or [])}
        whole = not derivatives and not x.reference.rows
        self.names = [n for n in x.reference.names if whole or n in left]
        self.q = [program.symbol(n) for n in self.names]
        self.p = [program.symbol(f"p_{n}") for n in self.names]
        equations = x.places(what, list(section.equations.values()))
        slopes = x.places(what, [derivatives[n] for n in self.names] if derivatives else [])
        self.readable = bool(H) and equations is not None and slopes is not None
        self.H = H[0] if H else 0
        self.equations, self.slopes = equations or [], slopes or []
        self.constants = [(name, 0) for name in section.constants]
        self.energy = (section.energy, 0)

    @property
    def lacks_a_coordinate(self) -> bool:
        """Whether H depends on a coordinate, or its momentum, by which S has no derivative."""
        used = {name.removeprefix("p_") for name, _ in self.x.reference.program.symbols([self.H])}
        return not used & {*self.x.reference.names} <= {*self.names}

    # -- H -------------------------------------------------------------------------------------

    def momenta(self, s: State) -> list[arb] | None:
        """p_i = sum_j p_j dq_j'/dq_i', the momenta of the coordinates that are left."""
        names = list(self.x.reference.names)
        p = [s.phase.at(place) for place in self.x.reference.p]
        kept = [names.index(n) for n in self.names]
        gone = [j for j in range(len(names)) if j not in kept]
        if not gone:
            return p
        rows = [[row[j] for j in gone] for row in s.laws.jacobian]
        found = []
        for i in kept:
            try:
                rates = solve(rows, [-row[i] for row in s.laws.jacobian], len(gone))
            except Unclear:
                return None
            if rates.kernel or not rates.consistent:
                return None
            found.append(p[i] + dot([p[j] for j in gone], rates.x))
        return found

    def environment(self, s: State) -> Environment | None:
        """A state with these momenta."""
        p = self.momenta(s)
        if p is None:
            return None
        named = {(f"p_{n}", 0): value for n, value in zip(self.names, p, strict=True)}
        return {**s.phase.environment, **named}

    def energy_of(self, s: State) -> arb:
        """sum p_i q_i' - L of the coordinates that are left."""
        p = self.momenta(s)
        if p is None or not self.x.reference.rows:
            return s.phase.energy
        names = list(self.x.reference.names)
        rates = [s.laws.velocities[names.index(n)] for n in self.names]
        return dot(p, rates) - s.laws.lagrangian

    def energies(self, s: State) -> tuple[list[arb], list[arb]] | None:
        """H as printed, and the energy."""
        known = self.environment(s)
        if known is None:
            return None
        return [self.x.reference.values(known)(self.H)], [self.energy_of(s)]

    def levi_civita(self) -> bool:
        """Whether the pairs of coordinates pass the test, all or up to the obstacle."""
        x, section = self.x, self.section
        pairs = list(combinations(range(len(self.names)), 2))
        if section.separable:
            return x.decide("that the equation separates", lambda s: self._tests(s, pairs))
        obstacle = tuple(self.names.index(n) for n in section.obstacle if n in self.names)
        claim = "that the equation does not separate"

        def gap(s: State) -> arb:
            tests = self._tests(s, [obstacle] if obstacle in pairs else pairs)
            return sum(((a - b) ** 2 for a, b in zip(*tests, strict=True)), arb(0))

        return x.constant(claim, claim=False, value=gap)

    def _tests(self, s: State, pairs: Sequence[tuple[int, int]]) -> tuple[list[arb], list[arb]]:
        """H^i H^j H_ij + H_i H_j H^ij - H_i H^j H^i_j - H^i H_j H_i^j; 0 relative to its terms."""
        known = self.environment(s)
        if known is None:
            return [arb(0)] * len(pairs), [arb(0)] * len(pairs)
        at = self.x.reference.values(known)
        by = at.gradient(self.H)
        left, right = [], []
        for i, j in pairs:
            di, dj, ui, uj = (
                by.get(k, arb(0)) for k in (self.q[i], self.q[j], self.p[i], self.p[j])
            )
            along_q = at.gradient_rates(self.H, by, {self.q[j]: arb(1)})
            along_p = at.gradient_rates(self.H, by, {self.p[j]: arb(1)})
            first = [
                ui * uj * along_q.get(self.q[i], arb(0)),
                di * dj * along_p.get(self.p[i], arb(0)),
            ]
            second = [
                di * uj * along_q.get(self.p[i], arb(0)),
                ui * dj * along_p.get(self.q[i], arb(0)),
            ]
            left.append(first[0] + first[1])
            right.append(second[0] + second[1])
        return left, right

    # -- S ---------------------------------------------------------------------------------------

    def solves(self) -> bool:
        """Whether the W' belong to the energy and momenta of random states."""
        x, what = self.x, "the parts of Hamilton's principal function"
        symbols = x.reference.program.symbols
        allowed = {key for key, _ in self.constants}
        moving = set(self.names)
        for name, place in zip(self.names, self.slopes, strict=True):
            others = {key for key, _ in symbols([place])} & (moving - {name})
            if others - allowed:
                x.refute(what, "a derivative depends on another coordinate")
                return False
        return x.decide(what, self._nearby) and x.decide(what, self._complete)

    def _nearby(self, s: State) -> tuple[list[arb], list[arb]] | None:
        known = self.with_constants(s)
        if known is None:
            return None
        E = known.get(self.energy, self.energy_of(s))
        left, right = [E], [self.energy_of(s)]
        for there in self._moved(known):
            at = self.x.reference.values(there)
            slopes = [at(place) for place in self.slopes]
            if all(p.is_finite() for p in slopes):
                named = {(f"p_{n}", 0): p for n, p in zip(self.names, slopes, strict=True)}
                left.append(self.x.reference.values({**there, **named})(self.H))
                right.append(E)
        return (left, right) if len(left) > 1 else None

    def independent(self) -> bool:
        """Whether the separated equations determine the constants, at some state."""
        known = next(filter(None, map(self.environment, self.x.states())), None)
        if known is None or not self.equations:
            return True
        sought = [key for key in self.constants if key not in known]
        symbols = [self.x.reference.program.symbol(*key) for key in sought]
        at = self.x.reference.values(
            {**known, **{key: arb(5 + 3 * k) / 8 for k, key in enumerate(sought)}}
        )
        rows = [column(at.gradient(place), symbols) for place in self.equations]
        try:
            return rank(rows, len(symbols)) == len(symbols)
        except Unclear:
            return True

    def _complete(self, s: State) -> tuple[list[arb], list[arb]] | None:
        """The number of constants on which the W' depend independently: one for each."""
        known = self.with_constants(s)
        if known is None:
            return None
        at = self.x.reference.values(known)
        symbols = [self.x.reference.program.symbol(*key) for key in self.constants]
        rows = [column(at.gradient(place), symbols) for place in self.slopes]
        if not all(e.is_finite() for row in rows for e in row):
            return None
        return [arb(rank(rows, len(symbols)))], [arb(len(self.names))]

    def with_constants(self, s: State) -> Environment | None:
        """The state with the constants that the separated equations give there."""
        known = self.environment(s)
        if known is None:
            return None
        sought = [key for key in self.constants if key not in known]
        known |= {key: self.energy_of(s) if key == self.energy else arb(1) for key in sought}
        if self.equations and sought:
            found = settled(
                self.x.reference, known, self.equations, sought, steps=_STEPS, near=_NEAR
            )
            return known if found else None
        return known

    def _moved(self, known: Environment) -> Iterator[Environment]:
        """Places near a state."""
        random = Random(7)
        for reach in (0, 40, 20, 10, 5):
            yield {
                **known,
                **{(n, 0): known[n, 0] * (1 + arb(random.randint(-reach, reach)) / 1024)
                   for n in self.names},
            }  # fmt: skip

    # -- W ---------------------------------------------------------------------------------------

    def with_functions(self) -> HamiltonJacobiSection:
        """The section with those W whose derivative is W', where the conditions hold."""
        section = self.section
        functions = {n: W for n, W in section.functions.items() if self._integrates(n, W, ())}
        cases = {
            name: tuple(e for e in parts if self._integrates(name, e.function, e.where))
            for name, parts in section.cases.items()
        }
        return replace(section, functions=functions, cases={n: c for n, c in cases.items() if c})

    def _integrates(self, name: str, W: Expression, where: Sequence[Above]) -> bool:
        x, what = self.x, f"the part W_{name} of Hamilton's principal function"
        places = x.places(what, [W])
        if places is None:
            return False
        k = self.names.index(name)
        above = conditions(x, what, where)

        def sides(s: State) -> tuple[list[arb], list[arb]] | None:
            known = self.with_constants(s)
            if known is None:
                return None
            values: tuple[list[arb], list[arb]] = [], []
            for at in self._tried(known, _ATTEMPTS if above else 0):
                if len(values[0]) == _WANTED:
                    break
                slope = at.gradient(places[0]).get(self.q[k], arb(0))
                if all(at(c) > 0 for c in above) and slope.is_finite():
                    values[0].append(slope**2)
                    values[1].append(at(self.slopes[k]) ** 2)
            return values if values[0] else None

        before = len(x.unchecked)
        holds = x.decide(what, sides)
        if above and len(x.unchecked) > before:
            del x.unchecked[before:]
            x.refute(what, "no state was found where its conditions hold")
            return False
        return holds

    def _tried(self, known: Environment, attempts: int) -> Iterator[StepValues]:
        """The constants of a state, other energies, and all constants and coordinates moved."""
        values, random = self.x.reference.values, Random(17)
        for scale in (1, -1, 3):
            yield values({**known, self.energy: known.get(self.energy, arb(1)) * scale})
        moved = [key for key in (*self.constants, *((n, 0) for n in self.names)) if key in known]
        for _ in range(attempts):
            scales = [arb(random.choice((2, 3, 5)) ** random.randint(-2, 2)) for _ in moved]
            there = {key: known[key] * scale for key, scale in zip(moved, scales, strict=True)}
            signs = {
                key: there[key] * random.choice((1, -1)) for key in self.constants if key in there
            }
            yield values({**known, **there, **signs})
