"""What an answer in JSON claims, against brute force: the equations of motion and what follows."""

from __future__ import annotations

from dataclasses import dataclass

from mpmath import mpf

from . import linear, modes, phase, reduced, rest
from .charges import Charges
from .comparison import close, short
from .grammar import Undefined, Unreadable, read, sides
from .motion import Motion, State, rate, slope
from .system import System

#: How often other numbers are drawn for the parameters where no state is found.
NUMBERS = 4


@dataclass(frozen=True)
class Finding:
    """`verdict` is "wrong" (a false claim) or "missing" (an answer that there is)."""

    verdict: str
    section: str
    what: str


class Judge(Charges):
    """One system, its answer, and what was found."""

    def __init__(self, system: System, sheet: dict, count: int = 3) -> None:
        self.system, self.sheet = system, sheet
        self.found: list[Finding] = []
        for again in range(NUMBERS):  # a chain of random lengths may not close
            self.motion = Motion(system, system.seed + again * 7919)
            self.motion.shared = {k: read(text) for k, text in sheet.get("where", {}).items()}
            self.states = self._states(count)
            if self.states or self.stuck:
                break

    def _states(self, count):
        """Each with q'', lam, the kernel of the equations for them, and M."""
        found = []
        for _ in range(count):
            state = self.motion.draw()
            if state is not None:
                found.append(self.motion.solve(state))
        self.stuck = [each for each in found if not each[2]]
        return self._of_the_stated_rank([each for each in found if each[2]])

    def _of_the_stated_rank(self, found):
        """Without the states where the sheet says that the constraints have another rank."""
        if not any("do not hold there" in each for each in self.sheet["warnings"]):
            return found
        rank = self.motion.n - self.sheet["degrees_of_freedom"]
        drawn = filter(None, (self.motion.draw() for _ in range(24)))
        more = (self.motion.solve(state) for state in drawn)
        kept = [s for s in (*found, *more) if s[2] and linear.rank(self.motion.rows(s[0])) == rank]
        return kept[:3]

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
            self._at(solved, ("lagrangian", "equations", "momenta"))
            if self.sheet.get("accelerations") and self._have_values(solved):
                self.say("wrong", "accelerations", "the equations have no solution there")
        if self.states:
            for solved in self.states:
                self._at(solved, AT_EACH_STATE)
            self.freedom()
            for section, examine in TOGETHER.items():
                self._together(section, examine)
        return self.found

    def _have_values(self, solved):
        """Whether the accelerations are finite there: 1/sin(a - b) claims nothing at a = b.

        Nor does 0/0, which rounding makes a number: a value beside it is then another one.
        """
        names = self.names(solved)
        beside = names | {q: names[q] + 1e-8 for q in self.motion.coordinates}
        try:
            formulas = [read(text) for text in self.sheet["accelerations"].values() if text]
            found = [(formula(names), formula(beside)) for formula in formulas]
        except Undefined:
            return False
        return all(abs(a) < 1e12 and abs(a - b) < 1e-3 * (1 + abs(a)) for a, b in found)

    def _at(self, solved, sections):
        names = self.names(solved)
        for section in sections:
            if section in self.sheet:
                self.reading(section, getattr(self, section), self.sheet[section], solved, names)

    def _together(self, section, examine):
        if section not in self.sheet:
            return
        if self.sheet[section] is None and section not in MAY_BE_NULL:
            self.say("missing", section, str(self.sheet["warnings"])[:200])
        elif self.sheet[section] is not None or section in ("equilibria", "modes"):
            self.reading(section, examine, self, self.sheet[section])

    def reading(self, section, examine, *arguments):
        """Examine; a formula that cannot be read or has no value is wrong."""
        try:
            examine(*arguments)
        except (Undefined, Unreadable) as error:
            self.say("wrong", section, str(error))

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
            if self._have_values(solved):
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
        if printed is None:
            self.say("missing", "energy", "")
            return
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
        if printed["conserved"] and not close(h + change, h):
            self.say("wrong", "energy", f"called conserved, dh/dt = {short(change)}")

    def questions(self, printed):
        """The values and the roots, where they are known by construction."""
        for name, known in self.system.known.get("answers", {}).items():
            given = printed[name]
            texts = given.get("solutions", given.get("values", [given.get("value")]))
            if texts is None or None in texts:
                self.say("missing", "find", f"{name}: {given}")
                continue
            for solved in self.states:
                names = self.names(solved)
                values = [self.value("find", text, names) for text in texts]
                true = [read(text)(names) for text in known]
                if None not in values and not _same_set(values, true):
                    self.say("wrong", "find", f"{name}: {texts}, not {known}")

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


def _same_set(values, true):
    return len(values) == len(true) and all(
        any(close(value, each) for value in values) for each in true
    )


AT_EACH_STATE = (
    "lagrangian", "equations", "matrix_form", "accelerations", "multipliers", "constraint_forces",
    "momenta", "energy", "hamiltonian", "canonical_equations",
)  # fmt: skip

#: What examines the sections that are not true or false at one state.
TOGETHER = {
    "charges": Judge.all_charges,
    "discovered": Judge.all_discovered,
    "equilibria": rest.equilibria,
    "modes": modes.modes,
    "brackets": phase.brackets,
    "canonical": phase.canonical,
    "reduction": reduced.reduction,
    "steady_motions": reduced.steady_motions,
    "hamilton_jacobi": reduced.hamilton_jacobi,
    "forces": reduced.forces,
    "find": Judge.questions,
}
MAY_BE_NULL = {"equilibria", "modes", "steady_motions", "hamilton_jacobi", "forces"}
