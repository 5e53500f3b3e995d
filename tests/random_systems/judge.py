"""What an answer in JSON claims, against brute force: the equations of motion and what follows."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mpmath import mpf

from . import linear, phase, rest
from .grammar import Undefined, Unreadable, read, sides
from .motion import H, Motion, State, rate, slope
from .system import System

TOLERANCE = mpf(10) ** -10


@dataclass(frozen=True)
class Finding:
    """`verdict` is "wrong" (a false claim), "missing" (an answer that there is) or "trivial" (a charge
    that is a constant because of the constraints)."""

    verdict: str
    section: str
    what: str


class Judge:
    """One system, its answer, and what was found."""

    def __init__(self, system: System, sheet: dict, count: int = 3) -> None:
        self.system, self.sheet = system, sheet
        self.motion = Motion(system, system.seed)
        self.found: list[Finding] = []
        self.states = self._states(count)

    def _states(self, count):
        """Each with q'', lam, the kernel of the equations for them, and M."""
        found = []
        for _ in range(count):
            state = self.motion.draw()
            if state is not None:
                found.append(self.motion.solve(state))
        self.stuck = [each for each in found if not each[2]]
        return [each for each in found if each[2]]

    def say(self, verdict, section, what):
        if len(self.found) < 12:
            self.found.append(Finding(verdict, section, what))

    def value(self, section, text, names):
        """The value of a printed formula; None, and a finding, where it has none."""
        try:
            return read(text)(names)
        except Undefined as error:
            self.say("wrong", section, f"{text}: {error}")
        except Unreadable as error:
            self.say("wrong", section, f"cannot be read back: {error}")
        return None

    def same(self, section, text, expected, names, label=""):
        """A formula has the value that it must have."""
        if text is None:
            self.say("missing", section, label)
            return
        value = self.value(section, text, names)
        if value is not None and not close(value, expected):
            self.say("wrong", section, f"{label} {text} = {short(value)}, not {short(expected)}")

    def names(self, solved):
        """Name -> number, with momenta and multipliers."""
        state = solved[0]
        table = self.motion.names(state)
        for name, p in zip(self.motion.coordinates, self.motion.p(state), strict=True):
            table[f"p_{name}"] = p
        for name, lam in zip(self.motion.constraints, state.lam, strict=False):
            table[self.motion.names_of_multipliers[name]] = lam
        return table

    def examine(self) -> list[Finding]:
        """Everything that the sheet claims."""
        for solved in self.stuck:
            names = self.names(solved)
            for section in ("lagrangian", "equations", "momenta"):
                if section in self.sheet:
                    getattr(self, section)(self.sheet[section], solved, names)
            if self.sheet.get("accelerations"):
                self.say("wrong", "accelerations", "the equations have no solution there")
        if not self.states:
            return self.found
        for solved in self.states:
            names = self.names(solved)
            for section in (
                "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
                "constraint_forces", "momenta", "energy", "hamiltonian", "canonical_equations",
            ):  # fmt: skip
                if section in self.sheet:
                    getattr(self, section)(self.sheet[section], solved, names)
        self.freedom()
        if "charges" in self.sheet:
            self.charges(self.sheet["charges"], "charges")
            self.evident(self.sheet["charges"])
        if self.sheet.get("discovered") is not None:
            self.charges(self.sheet["discovered"], "discovered")
            self.all_discovered(self.sheet["discovered"])
        if "equilibria" in self.sheet:
            rest.equilibria(self, self.sheet["equilibria"])
        if "modes" in self.sheet:
            rest.modes(self, self.sheet["modes"])
        for section in (
            "brackets", "canonical", "reduction", "steady_motions", "hamilton_jacobi", "forces",
        ):  # fmt: skip
            if self.sheet.get(section) is not None:
                getattr(phase, section)(self, self.sheet[section])
        return self.found

    # -- the equations ------------------------------------------------------------------

    def lagrangian(self, text, solved, names):
        self.same("lagrangian", text, self.motion.L(solved[0]), names, "L")

    def equations(self, equations, solved, names):
        state = solved[0]
        left = self.motion.euler_lagrange(state)
        right = self._right(state)
        for i, each in enumerate(equations or []):
            try:
                value = [side(names) for side in sides(each["equation"])]
            except (Undefined, Unreadable) as error:
                self.say("wrong", "equations", f"{each['equation']}: {error}")
                continue
            # off the solution, where they are not 0 = 0
            shaken = dict(names)
            state_ = State(state.q, state.v, state.t, [a + 1 for a in state.a], state.lam)
            for name, a in zip(self.motion.coordinates, state_.a, strict=True):
                shaken[name + "''"] = a
            other = read(each["equation"])(shaken)
            expected = self.motion.euler_lagrange(state_)[i] - right[i]
            on = close(value[0], value[1]) or not solved[2]
            if not on or not close(other, expected):
                self.say("wrong", "equations", f"{each['equation']}; left {short(left[i])}")

    def _right(self, state):
        forces = linear.times(linear.transposed(self.motion.rows(state)), state.lam)
        forces = forces or [mpf(0)] * self.motion.n
        return [q + f for q, f in zip(self.motion.applied(state), forces, strict=True)]

    def matrix_form(self, form, solved, names):
        state, _, _, M = solved
        if form is None:
            self.say("missing", "matrix_form", "")
            return
        table = dict(names)
        for name, text in form["shared"].items():
            table[name] = self.value("matrix_form", text, table)
        A, b = self.motion.rows(state), form["constraint_bias"]
        forcing = [
            m - f
            for m, f in zip(
                linear.times(M, state.a),
                linear.times(linear.transposed(A), state.lam) or [mpf(0)] * len(M),
                strict=True,
            )
        ]
        for printed, numbers in ((form["mass_matrix"], M), (form["constraint_jacobian"], A)):
            for i, row in enumerate(printed):
                for j, text in enumerate(row):
                    self.same("matrix_form", text, numbers[i][j], table, f"[{i}, {j}]")
        for i, text in enumerate(form["forcing"]):
            self.same("matrix_form", text, forcing[i], table, f"forcing {i}")
        for name, text in zip(self.motion.constraints, b, strict=False):
            self.same("matrix_form", text, self.motion.bias(name, state), table, f"bias {name}")

    def accelerations(self, printed, solved, names):
        state, kernel, _, _ = solved
        free = any(abs(v[i]) > linear.SMALL for v in kernel for i in range(self.motion.n))
        if printed is None:
            if not free:
                self.say("missing", "accelerations", "they are determined")
            return
        if free:
            self.say("wrong", "accelerations", f"{printed}: they are not determined")
            return
        for name, a in zip(self.motion.coordinates, state.a, strict=True):
            self.same("accelerations", printed[name], a, names, f"{name}'' =")

    def multipliers(self, printed, solved, names):
        state, kernel, _, _ = solved
        kinds = self.system.known.get("constraint_kinds", {})
        for k, name in enumerate(self.motion.constraints):
            free = any(abs(vector[self.motion.n + k]) > linear.SMALL for vector in kernel)
            each = printed[name]
            if free:
                if each["value"] is not None:
                    self.say("wrong", "multipliers", f"{name} is not determined: {each}")
            else:
                self.same("multipliers", each["value"], state.lam[k], names, f"{name}:")
            kind = "nonholonomic" if self.motion.on_velocities[name] else "holonomic"
            kind = kinds.get(name, None if kind == "nonholonomic" else kind)
            if kind and each["kind"] != kind:
                self.say("wrong", "multipliers", f"{name} is {kind}, not {each['kind']}")

    def constraint_forces(self, printed, solved, names):
        state, kernel = solved[:2]
        rows = self.motion.rows(state)
        for k, name in enumerate(self.motion.constraints):
            for i, q in enumerate(self.motion.coordinates):
                text = (printed.get(name) or {}).get(q)
                if text is not None:
                    force = state.lam[k] * rows[k][i]
                    self.same("constraint_forces", text, force, names, f"{name}.{q}")
        total = self.sheet.get("total_constraint_force")
        free = any(abs(v[i]) > linear.SMALL for v in kernel for i in range(self.motion.n))
        if total and not free:
            forces = linear.times(linear.transposed(rows), state.lam)
            for q, force in zip(self.motion.coordinates, forces, strict=True):
                if total.get(q) is not None:
                    self.same("constraint_forces", total[q], force, names, f"total {q}")

    def freedom(self):
        ranks = [linear.rank(self.motion.rows(solved[0])) for solved in self.states]
        expected = {self.motion.n - rank for rank in ranks}
        if self.sheet["degrees_of_freedom"] not in expected:
            said = self.sheet["degrees_of_freedom"]
            self.say("wrong", "degrees_of_freedom", f"{said}, not {sorted(expected)}")

    # -- momenta, energy, Hamiltonian -----------------------------------------------------

    def momenta(self, printed, solved, names):
        for name, p in zip(self.motion.coordinates, self.motion.p(solved[0]), strict=True):
            self.same("momenta", (printed or {}).get(name), p, names, f"p_{name}")

    def h(self, state):
        """The Jacobi function."""
        return linear.dot(state.v, self.motion.p(state)) - self.motion.L(state)

    def energy(self, printed, solved, names):
        state = solved[0]
        h = self.h(state)
        self.same("energy", printed["function"], h, names, "h =")
        total = printed["is_total_energy"]
        if total is not None and self.motion._L is None:
            is_total = close(h, self.motion.kinetic(state) + self.motion.potential(state))
            if total and not is_total:
                self.say("wrong", "energy", "it is not T + V")
        if self._free(solved):
            return
        change = rate(self.h, state)
        if printed["conserved"] and not close(change, mpf(0)):
            self.say("wrong", "energy", f"called conserved, dh/dt = {short(change)}")

    def _free(self, solved):
        return any(abs(v[i]) > linear.SMALL for v in solved[1] for i in range(self.motion.n))

    def hamiltonian(self, text, solved, names):
        if text is None:
            if linear.rank(solved[3]) == self.motion.n:
                self.say("missing", "hamiltonian", "")
            return
        table = {k: v for k, v in names.items() if not k.endswith("'")}
        self.same("hamiltonian", text, self.h(solved[0]), table, "H =")

    def canonical_equations(self, printed, solved, names):
        state = solved[0]
        if printed is None:
            if linear.rank(solved[3]) == self.motion.n:
                self.say("missing", "canonical_equations", "")
            return
        table = {k: v for k, v in names.items() if not k.endswith("'")}
        for i, name in enumerate(self.motion.coordinates):
            change = rate(lambda s, i=i: slope(self.motion.L, s, "v", i), state)
            self.same("canonical_equations", printed[name]["q"], state.v[i], table, f"{name}' =")
            self.same("canonical_equations", printed[name]["p"], change, table, f"p_{name}' =")

    # -- charges --------------------------------------------------------------------------

    def charges(self, printed, section):
        for each in printed:
            label = f"{each['name']}:"
            if each["conserved"] and each["charge"] is None:
                continue  # a charge that is 0: no result
            if each["conserved"] is None or each["charge"] is None:
                self.say("missing", section, f"{label} undecided")
                continue
            if self.holds(each):
                self._charge(each, section, label)

    def holds(self, each):
        """Whether the conditions under which a charge is real hold for these numbers."""
        names = dict(self.motion.constants)
        for text in each.get("where", []):
            left, _, right = text.partition(">")
            if self.value("charges", f"({left}) - ({right})", names) <= 0:
                return False
        return True

    def _charge(self, each, section, label):
        try:
            Q = read(each["charge"])
            rates = [rate(lambda s: Q(self.motion.names(s)), s[0]) for s in self.states]
            values = [Q(self.motion.names(s[0])) for s in self.states]
        except (Undefined, Unreadable) as error:
            self.say("wrong", section, f"{label} {each['charge']}: {error}")
            return
        conserved = all(close(change, mpf(0)) for change in rates)
        if each["conserved"] != conserved:
            self.say("wrong", section, f"{label} {each['charge']} conserved is {conserved}")
        if not each["conserved"] and each["rate"] is not None:
            for solved, change in zip(self.states, rates, strict=True):
                self.same(section, each["rate"], change, self.names(solved), f"{label} rate")
        if len(values) > 1 and all(close(value, values[0]) for value in values):
            self.say("trivial", section, f"{label} {each['charge']} is a constant")
        self._noether(each, section, label)

    def _noether(self, each, section, label):
        """Q = sum p (Dq - q' Dt) + L Dt - G for the transformation that is printed."""
        if not each["transformation"]:
            return
        off = []
        for solved in self.states:
            state, names = solved[0], self.names(solved)
            change = each["transformation"]
            dt = self.value(section, change.get("t", "0"), names)
            G = self.value(section, each["gauge"] or "0", names)
            Q = self.value(section, each["charge"], names)
            if dt is None or G is None or Q is None:
                return
            N = self.motion.L(state) * dt - G
            for i, name in enumerate(self.motion.coordinates):
                dq = self.value(section, change.get(name, "0"), names)
                if dq is None:
                    return
                N += slope(self.motion.L, state, "v", i) * (dq - state.v[i] * dt)
            off.append((Q, N))
        if not self._proportional(*zip(*off, strict=True), exactly=each["source"] == "candidate"):
            self.say("wrong", section, f"{label} is not that of its transformation and gauge")

    @staticmethod
    def _proportional(Q, N, *, exactly):
        """Q = c N + const, with c = 1 for what the file asks about."""
        if exactly:
            return all(close(q - n, Q[0] - N[0]) for q, n in zip(Q, N, strict=True))
        pairs = [(q - Q[0], n - N[0]) for q, n in zip(Q, N, strict=True)][1:]
        return all(close(a[0] * b[1], a[1] * b[0]) for a in pairs for b in pairs)

    def evident(self, printed):
        """What is known by construction, and that no cyclic coordinate is forgotten."""
        by_name = {each["name"]: each for each in printed}
        for name, conserved in self.system.known.get("conserved", {}).items():
            said = by_name.get(name, {}).get("conserved")
            if said != conserved:
                verdict = "missing" if said is None else "wrong"
                self.say(verdict, "charges", f"{name} conserved: {said}, not {conserved}")
        for name in self.system.symmetries:
            if by_name.get(name, {}).get("conserved") is False and self._has_gauge(name):
                self.say("wrong", "charges", f"{name} is conserved: its K is a total derivative")
        if any(self._free(solved) for solved in self.states):
            return
        energy = all(close(rate(self.h, solved[0]), mpf(0)) for solved in self.states)
        said = (self.sheet.get("energy") or {}).get("conserved")
        if energy and said is not True and "energy" in self.sheet:
            verdict = "missing" if said is None else "wrong"
            self.say(verdict, "energy", f"it is conserved, not {said}")
        if not energy and said is None and "energy" in self.sheet:
            self.say("missing", "energy", "it is not conserved")

    def _has_gauge(self, name):
        """Whether Euler's operator takes K to 0, where nothing acts beside L."""
        change, motion = self.system.symmetries[name], self.motion
        if motion.constraints or motion.forces or motion.D is not None or "gauge" in change:
            return False
        if any("'" in text for text in change.values()):
            return False
        moves = [read(change.get(q, "0")) for q in motion.coordinates]
        clock = read(change.get("t", "0"))

        def K(state):
            still = replace(state, a=[mpf(0)] * motion.n)
            stretch = rate(lambda s: clock(motion.names(s)), still)
            total, dt = mpf(0), clock(motion.names(state))
            for i, dq in enumerate(moves):
                Dq = rate(lambda s, dq=dq: dq(motion.names(s)), still)
                total += slope(motion.L, state, "q", i) * dq(motion.names(state))
                total += slope(motion.L, state, "v", i) * (Dq - state.v[i] * stretch)
            later, earlier = (motion.L(replace(state, t=state.t + h)) for h in (H, -H))
            return total + (later - earlier) / (2 * H) * dt + motion.L(state) * stretch

        state = replace(self.states[0][0], a=[mpf(7) / 5 - i for i in range(motion.n)])
        return all(
            abs(rate(lambda s, i=i: slope(K, s, "v", i), state) - slope(K, state, "q", i))
            < mpf(10) ** -8
            for i in range(motion.n)
        )

    def all_discovered(self, printed):
        """Charges that must be found: each is a function of the printed ones, by gradients."""
        wanted = self.system.known.get("discovered", [])
        if not wanted:
            return
        functions = [read(each["charge"]) for each in printed if each["conserved"]]
        for text in wanted:
            for solved in self.states[:1]:
                rows = [self._gradient(function, solved[0]) for function in functions]
                more = [*rows, self._gradient(read(text), solved[0])]
                if linear.rank(more) > linear.rank(rows):
                    self.say("missing", "discovered", text)

    def _gradient(self, function, state):
        f = lambda s: function(self.motion.names(s))  # noqa: E731
        return [slope(f, state, what, i) for what in "qv" for i in range(self.motion.n)]


def close(a, b):
    """Equal up to rounding."""
    return abs(a - b) <= TOLERANCE * max(1, abs(a), abs(b))


def short(value):
    return f"{float(value):.8g}"
