"""Closed chains of links with symbolic lengths, in angles from the ground or from link to link."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import MAIN, System

from .draw import parameters

NAMES = ("a", "b", "c", "e")


def closed_chains(rng: Random) -> System:
    """Four bars, slider and crank, parallelograms: some links without mass, some driven."""
    count = rng.choice([2, 3, 3])
    equal = rng.random() < 0.2
    lengths = [f"l{0 if equal else i}" for i in range(count)]
    relative = rng.random() < 0.6
    names = NAMES[:count]
    angles = [" + ".join(names[: i + 1]) if relative else names[i] for i in range(count)]
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters(*sorted(set(lengths)), "d", "m", "M", "g", "w"),
    )
    ends = _ends(lengths, angles)
    masses = {i: rng.choice(["m", "M", "2*m"]) for i in range(count) if rng.random() < 0.6}
    masses = masses or {0: "m"}
    made.points = {f"P{i}": (list(ends[i]), mass) for i, mass in masses.items()}
    weight = [f"{mass}*g*({ends[i][1]})" for i, mass in masses.items()]
    made.V = rng.choice(["0", " + ".join(weight)])
    x, y = ends[-1]
    if count == 2:  # the end slides along a line
        made.coordinates |= {"s": None}
        made.T = "M*s'^2/2" if rng.random() < 0.6 else None
        made.constraints = {"cx": f"{x} = s", "cy": f"{y} = {rng.choice(['0', 'd'])}"}
    else:
        made.constraints = {"cx": f"{x} = d", "cy": f"{y} = 0"}
    if rng.random() < 0.3:
        made.constraints["motor"] = rng.choice(["a = w*t", "a' = w"])
    made.sections = MAIN
    return made


def _ends(lengths, angles):
    """Where each link ends."""
    x, y, found = [], [], []
    for length, angle in zip(lengths, angles, strict=True):
        x.append(f"{length}*cos({angle})")
        y.append(f"{length}*sin({angle})")
        found.append((" + ".join(x), " + ".join(y)))
    return found


KINDS = {"closed_chains": closed_chains}
