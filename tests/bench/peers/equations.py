"""M q'' = F of a system by SymPy, as a script would have it."""

import re
import sys
from pathlib import Path

import sympy as sp

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.bench.motions import SYSTEMS


def derived(name):
    """(system, q, v, M, F) with symbols for q and v."""
    system = SYSTEMS[name]
    q = [sp.Symbol(x) for x in system.coordinates]
    v = [sp.Symbol(f"{x}_t") for x in system.coordinates]
    names = {str(s): s for s in (*q, *v)}

    def read(text):
        return sp.sympify(re.sub(r"(\w+)'", r"\1_t", text).replace("^", "**"), locals=names)

    kinetic, potential = read(system.kinetic), read(system.potential)
    lagrangian = kinetic - potential
    momenta = [sp.diff(kinetic, u) for u in v]
    mass = sp.Matrix([[sp.diff(p, u) for u in v] for p in momenta])
    force = sp.Matrix(
        [
            sp.diff(lagrangian, x) - sum(sp.diff(p, y) * u for y, u in zip(q, v, strict=True))
            for x, p in zip(q, momenta, strict=True)
        ]
    )
    return system, q, v, mass, force
