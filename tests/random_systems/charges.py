"""Charges by brute force: dQ/dt along the motion, Noether's formula, Euler's operator on K."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

from mpmath import mpf

from . import linear
from .comparison import close
from .grammar import Undefined, Unreadable, read
from .motion import H, rate, slope


class Charges:
    """What a judge says of the charges; `motion`, `states`, `sheet` and `say` are its own."""

    def all_charges(self, printed):
        """Those of the file and the evident ones."""
        self.charges(printed, "charges")
        self.evident(printed)

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
        conserved = all(close(v + c, v) for v, c in zip(values, rates, strict=True))
        if conserved and not each["conserved"]:
            conserved = self._everywhere(Q)  # the rate may be 0 on some branches only
        if each["conserved"] != conserved:
            self.say("wrong", section, f"{label} {each['charge']} conserved is {conserved}")
        if not each["conserved"] and each["rate"] is not None:
            for solved, change in zip(self.states, rates, strict=True):
                self.same(section, each["rate"], change, self.names(solved), f"{label} rate")
        asked = each["source"] == "candidate"
        if not asked and len(values) > 1 and self._constant(Q):
            self.say("wrong", section, f"{label} {each['charge']} is a constant")
        self._noether(each, section, label)

    def _everywhere(self, Q):
        """Whether a charge is kept on other branches as well."""
        changes = (rate(lambda s: Q(self.motion.names(s)), s[0]) for s in self.on_branches)
        return all(close(change, mpf(0)) for change in changes)

    def _constant(self, Q):
        """Whether a charge has the same value at all states."""
        states = [s[0] for s in self.states]
        values = [Q(self.motion.names(s)) for s in states]
        if all(close(value, values[0]) for value in values) and self.motion.constraints:
            values += [Q(self.motion.names(s[0])) for s in self.on_branches]
        return all(close(value, values[0]) for value in values)

    @cached_property
    def on_branches(self):
        """More states, from afar as well."""
        drawn = filter(None, (self.motion.draw(wide=i) for i in (1, 4) * 48))
        return [solved for solved in map(self.motion.solve, drawn) if solved[2]]

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
        energy = all(
            close(self.h(solved[0]) + rate(self.h, solved[0]), self.h(solved[0]))
            for solved in self.states
        )
        said = (self.sheet.get("energy") or {}).get("conserved")
        jumps = "sign" in self.system.text
        if energy and said is False:  # it may be kept on some branches only
            energy = all(close(rate(self.h, each[0]), mpf(0)) for each in self.on_branches)
        if energy and said is not True and "energy" in self.sheet and not jumps:
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
        self.charges(printed, "discovered")
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
