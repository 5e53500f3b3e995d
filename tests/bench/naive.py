"""The same problem as anyone would do it with SymPy: LagrangesMethod, LUsolve, simplify.

Reads the file with lagcli's reader and builds its formulas with lagcli's builder (a few
milliseconds, in SymPy's favour), then derives with `sympy.physics.mechanics` alone.
"""

from __future__ import annotations

import sys
from pathlib import Path

import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from lagcli.mechanics.system import System
from lagcli.pipeline import load


def main() -> None:
    system = System(load(Path(sys.argv[1])))
    t = dynamicsymbols._t
    q = [dynamicsymbols(name) for name in system.names]
    in_time = {
        **dict(zip(system.q, q, strict=True)),
        **dict(zip(system.qdot, [x.diff(t) for x in q], strict=True)),
        system.t: t,
    }
    constraints = [
        (system.build(c.equation.left) - system.build(c.equation.right))
        for c in system.problem.constraints
    ]
    with_velocities = [f for f in constraints if f.free_symbols & set(system.qdot)]
    holonomic = [f for f in constraints if f not in with_velocities]
    method = LagrangesMethod(
        system.L.xreplace(in_time),
        q,
        hol_coneqs=[f.xreplace(in_time) for f in holonomic],
        nonhol_coneqs=[f.xreplace(in_time) for f in with_velocities],
    )
    for equation in method.form_lagranges_equations():
        print(sympy.simplify(equation))
    solution = method.mass_matrix_full.LUsolve(method.forcing_full)
    for entry in solution:
        print(sympy.simplify(entry))


if __name__ == "__main__":
    main()
