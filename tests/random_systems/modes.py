"""Frequencies and shapes of small oscillations, against the roots of the linear equations."""

from __future__ import annotations

from mpmath import mp

from . import linear
from .grammar import Undefined, read
from .rest_linear import CLEAR, KINK, NEAR, about, symmetric


def modes(judge, printed):
    """The frequencies at each place are all there are, each shape one of them."""
    motion = judge.motion
    if printed is None:
        if "frequencies_squared" in judge.system.known:
            judge.say("missing", "modes", "there are some")
        return
    by_place = {}
    for mode in printed:
        if "on" in mode or set(mode["at"]) != set(motion.coordinates):
            continue
        by_place.setdefault(str(mode["at"]), []).append(mode)
    for some in by_place.values():
        try:
            q = [read(some[0]["at"][name])(motion.constants) for name in motion.coordinates]
            _frequencies(judge, some, about(motion, q))
        except (Undefined, ZeroDivisionError):
            continue
    expected = judge.system.known.get("frequencies_squared")
    if expected is not None:
        _known(judge, printed, expected)


def _squares(judge, some):
    found = []
    for mode in some:
        text = mode["frequency"] or mode.get("frequency_squared")
        if text is None:
            return None
        value = read(text)(judge.motion.constants)
        found += [value**2 if mode["frequency"] else value] * mode["multiplicity"]
    return sorted(found)


def _frequencies(judge, some, linear_):
    if not linear_.regular or any(judge.motion.on_velocities.values()):
        return
    if max(abs(x) for row in symmetric(linear_.C) for x in row) > NEAR:
        return
    squares = _squares(judge, some)
    roots = sorted(mp.re(-s * s) for s in linear_.spectrum)[::2]
    roots = [each for each in roots if each < KINK]  # a force that jumps holds its coordinate
    if squares is not None and (
        len(squares) != len(roots)
        or any(abs(a - b) > CLEAR * max(1, abs(b)) for a, b in zip(squares, roots, strict=True))
    ):
        texts = [mode["frequency"] for mode in some]
        judge.say("wrong", "modes", f"{texts}: {_floats(squares)}, not {_floats(roots)}")
        return
    for mode in some:
        _shapes(judge, mode, linear_)


def _shapes(judge, mode, linear_):
    """(K - w^2 M + i w C) x = 0; with C = 0 only."""
    if mode["shape"] is None or max(abs(x) for row in linear_.C for x in row) > NEAR:
        return
    w = read(mode["frequency"] or mode["frequency_squared"])(judge.motion.constants)
    w2 = w**2 if mode["frequency"] else w
    for shape in (mode["shape"], *mode.get("more_shapes", [])):
        x = [read(shape.get(n, "0"))(judge.motion.constants) for n in judge.motion.coordinates]
        N = linear_.directions
        along, _, consistent = linear.solve(linear.transposed(N), x)
        pairs = zip(linear.times(linear_.K, along), linear.times(linear_.M, along), strict=True)
        off = max(abs(k - w2 * m) for k, m in pairs)
        if not consistent or off > CLEAR * max(1, *map(abs, x)) or max(map(abs, x)) < NEAR:
            judge.say("wrong", "modes", f"shape {shape} of {mode['frequency']}")


def _known(judge, printed, expected):
    wanted = sorted(read(text)(judge.motion.constants) for text in expected)
    place = judge.system.known["at"]
    constants = judge.motion.constants
    some = []
    for mode in printed:
        pairs = [(mode["at"].get(name, "0"), place[name]) for name in judge.motion.coordinates]
        if all(abs(read(a)(constants) - read(b)(constants)) < CLEAR for a, b in pairs):
            some.append(mode)
    squares = _squares(judge, some)
    if squares is None or len(squares) != len(wanted):
        judge.say("missing", "modes", f"{_floats(squares)}, not {_floats(wanted)}")
    elif any(abs(a - b) > CLEAR * max(1, b) for a, b in zip(squares, wanted, strict=True)):
        judge.say("wrong", "modes", f"{_floats(squares)}, not {_floats(wanted)}")


def _floats(values):
    return None if values is None else [float(f"{float(x):.6g}") for x in values]
