"""Reduction, steady motions, Hamilton and Jacobi, forces on points, by brute force."""

from __future__ import annotations

from dataclasses import replace

from mpmath import mp, mpf

from . import linear
from .grammar import Undefined, Unreadable, read
from .motion import State, slope
from .phase import SMALL, Phase, near
from .rest_linear import CLEAR, Linear, jacobian


def reduction(judge, printed):
    """R = L - sum p q', its equations, the velocities of the cyclic coordinates, U_eff."""
    phase = Phase(judge)
    if printed is None:
        judge.say("missing", "reduction", "")
        return
    cyclic = [judge.motion.coordinates.index(name) for name in printed["momenta"]]
    for solved in judge.states:
        state = solved[0]
        p = judge.motion.p(state)
        names = judge.motion.names(state) | dict(zip(phase.p_names, p, strict=True))
        for i in cyclic:
            name = judge.motion.coordinates[i]
            judge.same("reduction", printed["momenta"][name], p[i], names, f"p_{name}")
        for i in cyclic:
            del names[judge.motion.coordinates[i] + "'"]
        R = judge.motion.L(state) - sum(p[i] * state.v[i] for i in cyclic)
        judge.same("reduction", printed["routhian"], R, names, "R")
        for each in printed["equations"]:
            judge.same("reduction", each["equation"], mpf(0), names, "equation")
        for name, text in printed["reconstruction"].items():
            v = state.v[judge.motion.coordinates.index(name)]
            judge.same("reduction", text, v, names, f"{name}'")
        if printed["effective_potential"]:
            _effective(judge, phase, printed["effective_potential"], state, p, cyclic, names)
        if printed["one_freedom"]:
            _one_freedom(judge, printed["one_freedom"], state, names)


def _effective(judge, phase, text, state, p, cyclic, names):
    still = replace(state, v=[v if i in cyclic else mpf(0) for i, v in enumerate(state.v)])
    still = replace(still, v=phase.velocities(still, p, cyclic))
    U = sum(p[i] * still.v[i] for i in cyclic) - judge.motion.L(still)
    judge.same("reduction", text, U, names, "U_eff")


def _one_freedom(judge, one, state, names):
    h = judge.h(state)
    judge.same("reduction", one["energy"], h, names, "energy")
    table = names | {one["constant"]: h}
    v = state.v[judge.motion.coordinates.index(one["coordinate"])]
    if v:  # at rest dt/dq has no value
        judge.same("reduction", one["rate"], 1 / abs(v), table, "dt/dq")
    for text in one["turning_points"] or []:
        try:
            there = table | {one["coordinate"]: read(text)(table), one["coordinate"] + "'": mpf(0)}
            E = read(one["energy"])(there)
        except (Undefined, ZeroDivisionError):
            continue
        if not near(E, h):
            judge.say("wrong", "reduction", f"{text} is no turning point")


def steady_motions(judge, printed):
    """With the rates that are printed nothing else is accelerated; the frequencies about it."""
    for each in printed or []:
        motion = judge.motion
        names = dict(motion.constants)
        for name in motion.coordinates:
            names[name] = mpf(motion.rng.randint(200, 1500)) / 777
            names[f"p_{name}"] = mpf(motion.rng.randint(200, 1500)) / 777
            names[f"{name}'"] = mpf(motion.rng.randint(200, 1500)) / 777
        if "on" in each or each["rates"] is None:
            continue
        try:
            if any(
                read(left)(names) <= read(right)(names)
                for left, _, right in (text.partition(">") for text in each["where"])
            ):
                continue
            q = [read(each["at"].get(name, name))(names) for name in motion.coordinates]
            at = names | dict(zip(motion.coordinates, q, strict=True))
            v = [read(each["rates"].get(name, "0"))(at) for name in motion.coordinates]
        except Undefined:
            judge.say("wrong", "steady_motions", f"{each['at']} {each['rates']} is not real")
            continue
        except Unreadable as error:
            judge.say("wrong", "steady_motions", str(error))
            continue
        _steady(judge, each, State(q, v, mpf(1) / 3, [mpf(0)] * motion.n), at)


def _steady(judge, each, state, names):
    motion = judge.motion
    if motion.constraints:
        return
    off = [
        abs(e - f) for e, f in zip(motion.euler_lagrange(state), motion.applied(state), strict=True)
    ]
    if max(off) > SMALL:
        judge.say("wrong", "steady_motions", f"{each['at']} {each['rates']} is none")
        return
    momenta = dict(zip(motion.coordinates, motion.p(state), strict=True))
    for name, text in each["momenta"].items():
        judge.same("steady_motions", text, momenta[name], names, f"p_{name}")

    def left(s):
        pairs = zip(motion.euler_lagrange(s), motion.applied(s), strict=True)
        return [e - f for e, f in pairs]

    about = Linear(*(jacobian(left, state, what) for what in "avq"), [])
    if not about.regular:
        return
    roots = about.spectrum
    if each["stable"] is True and max(mp.re(s) for s in roots) > CLEAR:
        judge.say("wrong", "steady_motions", f"{each['at']} is called stable: {roots}")
    squares = [-s * s for s in roots]
    for text in each["frequencies_squared"] or []:
        try:
            value = read(text)(names)
        except Undefined:
            continue
        if min(abs(value - other) for other in squares) > CLEAR * max(1, abs(value)):
            judge.say("wrong", "steady_motions", f"frequency^2 {text} of {each['at']}")


def hamilton_jacobi(judge, printed):
    """H(q, W') = E for any constants; dW/dq = W'."""
    if printed is None or not printed["derivatives"] or "time_rate" in printed:
        return
    phase, motion, checked = Phase(judge), judge.motion, 0
    for solved in judge.states * 8:
        names = motion.names(solved[0])
        E = judge.h(solved[0])
        for name in printed["constants"]:
            names[name] = mpf(motion.rng.randint(-900, 2000)) / 631
        names["E"] = E + abs(names["E"])
        try:
            p = [read(printed["derivatives"][q])(names) for q in motion.coordinates]
        except Undefined:
            continue
        except Unreadable as error:
            judge.say("wrong", "hamilton_jacobi", str(error))
            return
        checked += 1
        if not near(phase.energy_at(solved[0], p), names["E"]):
            judge.say("wrong", "hamilton_jacobi", f"H(q, W') is not E: {printed['derivatives']}")
            return
        _quadratures(judge, phase, printed, names, p)
        if checked > 2:
            return


def _quadratures(judge, phase, printed, names, p):
    for name, slope_ in zip(judge.motion.coordinates, p, strict=True):
        forms = [(printed["functions"].get(name), [])]
        forms += [(c["function"], c["where"]) for c in printed["cases"].get(name, [])]
        for text, where in forms:
            if text is None:
                continue
            try:
                if any(
                    read(a)(names) <= read(b)(names)
                    for a, _, b in (each.partition(">") for each in where)
                ):
                    continue
                found = phase.slope(read(text), names, name)
            except Undefined:
                continue
            if not near(found, slope_):
                judge.say("wrong", "hamilton_jacobi", f"dW/d{name} of {text}")


def forces(judge, printed):
    """The virtual work of the forces on the points is that of the multiplier."""
    if printed is None:
        return
    motion = judge.motion
    for solved in judge.states:
        state, names = solved[0], judge.names(solved)
        rows = motion.rows(state)
        for k, constraint in enumerate(motion.constraints):
            some = [each for each in printed["on_points"] if each["constraint"] == constraint]
            if not some or any(each["force"] is None for each in some):
                continue
            work = [mpf(0)] * motion.n
            for each in some:
                F = judge.value("forces", each["force"], names)
                e = [judge.value("forces", text, names) for text in each["direction"]]
                if F is None or None in e:
                    return
                if not near(linear.dot(e, e), mpf(1)):
                    judge.say("wrong", "forces", f"{each['direction']} is no unit vector")
                position = motion.positions[each["point"]][0]
                for i in range(motion.n):
                    for x, component in zip(position, e, strict=True):
                        f = lambda s, x=x: x(motion.names(s))  # noqa: E731
                        work[i] += F * component * slope(f, state, "q", i)
            torques = printed["torques"].get(constraint, {})
            for i, name in enumerate(motion.coordinates):
                if name in torques:
                    work[i] += judge.value("forces", torques[name], names) or mpf(0)
                if not near(work[i], state.lam[k] * rows[k][i]):
                    judge.say("wrong", "forces", f"virtual work of {constraint} along {name}")
