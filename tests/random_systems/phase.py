"""Phase space by brute force: brackets, canonical transformations, reduction, steady motions."""

from __future__ import annotations

from dataclasses import replace

from mpmath import mpf

from . import linear
from .grammar import STEP, Undefined, Unreadable, read
from .motion import rate

SMALL = mpf(10) ** -10


def near(a, b):
    """Equal up to rounding."""
    return abs(a - b) <= SMALL * max(1, abs(a), abs(b))


class Phase:
    """A system as functions of q, p, t."""

    def __init__(self, judge) -> None:
        self.judge, self.motion = judge, judge.motion
        self.n, self.coordinates = judge.motion.n, judge.motion.coordinates
        self.p_names = [f"p_{name}" for name in self.coordinates]
        self.observables = {name: read(t) for name, t in judge.system.observables.items()}

    def table(self, state, p=None):
        """Name -> number: q, p, t and the observables."""
        names = {k: v for k, v in self.motion.names(state).items() if not k.endswith("'")}
        names |= dict(zip(self.p_names, self.motion.p(state) if p is None else p, strict=True))
        return names | {k: f(names) for k, f in self._ordered(names)}

    def _ordered(self, names):
        for name, formula in self.observables.items():
            names[name] = formula(names)
            yield name, formula

    def slope(self, formula, names, by):
        """The partial derivative of a formula of q, p, t; observables move along."""
        values = []
        for h in (STEP, -STEP):
            moved = names | {by: names[by] + h}
            if by in self.coordinates + self.p_names:
                for name, each in self.observables.items():
                    moved[name] = each(moved)
            values.append(formula(moved))
        return (values[0] - values[1]) / (2 * STEP)

    def bracket(self, f, g, names):
        """{f, g} with {q, p} = 1."""
        return sum(
            self.slope(f, names, q) * self.slope(g, names, p)
            - self.slope(f, names, p) * self.slope(g, names, q)
            for q, p in zip(self.coordinates, self.p_names, strict=True)
        )

    def along(self, formula, state):
        """df/dt on the motion."""
        return rate(lambda s: formula(self.table(s)), state)

    def energy_at(self, state, p):
        """H(q, p, t) of an L that is quadratic in q', or of the file's H."""
        if self.judge.system.H:
            return read(self.judge.system.H)(self.table(state, p))
        v = self.velocities(state, p, range(self.n))
        return self.judge.h(replace(state, v=v))

    def velocities(self, state, p, which):
        """The q' of `which` that give these momenta, the others as they are."""
        which = list(which)
        v = list(state.v)
        for j in which:
            v[j] = mpf(0)
        base = self.motion.p(replace(state, v=v))
        columns = []
        for j in which:
            moved = list(v)
            moved[j] = mpf(1)
            one = self.motion.p(replace(state, v=moved))
            columns.append([one[i] - base[i] for i in which])
        x, _, _ = linear.solve(linear.transposed(columns), [p[i] - base[i] for i in which])
        for j, value in zip(which, x, strict=True):
            v[j] = value
        return v


def brackets(judge, printed):
    """Each bracket and rate."""
    phase = Phase(judge)
    for solved in judge.states:
        names = phase.table(solved[0])
        for each in printed["brackets"]:
            left, right = read(each["left"]), read(each["right"])
            if "H" in (each["left"], each["right"]):
                continue
            expected = phase.bracket(left, right, names)
            judge.same("brackets", each["value"], expected, names, each["name"])
        for name, text in (printed["rates"] or {}).items():
            expected = phase.along(phase.observables[name], solved[0])
            judge.same("brackets", text, expected, names, f"d{name}/dt")


def canonical(judge, printed):
    """The kind of each transformation, and Hamilton's equations of its new Hamiltonian."""
    phase = Phase(judge)
    for each in printed:
        given = judge.system.canonical[each["name"]]
        formulas = {k: read(v) for k, v in given.items() if k not in ("F1", "F2", "F3", "F4")}
        Q = [name for name in formulas if not name.startswith("p_")]
        pairs = [(q, f"p_{q}") for q in Q]
        valences, off = [], False
        for solved in judge.states:
            names = phase.table(solved[0])
            valence = [phase.bracket(formulas[q], formulas[p], names) for q, p in pairs]
            valences += valence
            flat = [name for pair in pairs for name in pair]
            for i, a in enumerate(flat):
                for b in flat[i + 1 :]:
                    if (a, b) not in pairs:
                        off |= not near(phase.bracket(formulas[a], formulas[b], names), mpf(0))
        constant = all(near(value, valences[0]) for value in valences) and not off
        kind = "not canonical"
        if constant and not near(valences[0], mpf(0)):
            kind = "canonical" if near(valences[0], mpf(1)) else "extended canonical"
        if each["kind"] != kind:
            judge.say("wrong", "canonical", f"{each['name']} is {kind}, not {each['kind']}")
        elif kind != "not canonical":
            judge.same("canonical", each["valence"], valences[0], judge.motion.constants, "valence")
            _new_equations(judge, phase, each, formulas, pairs, valences[0])


def _new_equations(judge, phase, each, formulas, pairs, valence):
    del valence
    if each["hamiltonian"] is None:
        return
    K = read(each["hamiltonian"])
    for solved in judge.states:
        state = solved[0]
        names = phase.table(state)
        table = dict(judge.motion.constants) | {"t": state.t}
        table |= {name: formula(names) for name, formula in formulas.items()}
        try:
            for q, p in pairs:
                first = phase.along(formulas[q], state) - phase.slope(K, table, p)
                second = phase.along(formulas[p], state) + phase.slope(K, table, q)
                if not near(first, mpf(0)) or not near(second, mpf(0)):
                    judge.say("wrong", "canonical", f"{each['name']}: K {each['hamiltonian']}")
                    return
        except (Undefined, Unreadable) as error:
            judge.say("wrong", "canonical", f"{each['hamiltonian']}: {error}")
