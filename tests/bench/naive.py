"""One problem as anyone would do it with SymPy: LagrangesMethod, LUsolve, simplify.

    python tests/bench/naive.py FILE [--cap SECONDS] [--only-time]

The file is read and its L, forces and constraints are built with lagcli's own reader and
builder; that time is taken off, in SymPy's favour.  From there on it is `sympy.physics.mechanics`
alone: Lagrange's equations with multipliers, generalized forces put beside `forcing` (it has no
place for them), LUsolve of the system of accelerations and multipliers, and `sympy.simplify` of
each of them.  Afterwards, off the clock, the answers are compared with lagcli's.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from pathlib import Path

import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

sys.path.insert(0, str(Path(__file__).parents[2]))


class Late(BaseException):
    """The CPU seconds allowed are used up."""


class Limit:
    """Ends what takes more CPU seconds."""

    def __init__(self, seconds):
        self.seconds = max(seconds, 0.01)

    def __enter__(self):
        signal.signal(signal.SIGPROF, self._raise)
        signal.setitimer(signal.ITIMER_PROF, self.seconds)

    def __exit__(self, *_):
        signal.setitimer(signal.ITIMER_PROF, 0)

    def _raise(self, *_):
        raise Late


class Script:
    """What a person would have typed: L, the forces and the constraints in q(t)."""

    def __init__(self, system):
        t = dynamicsymbols._t
        self.names = system.names
        self.q = [dynamicsymbols(name, real=True) for name in system.names]
        in_time = {
            **dict(zip(system.q, self.q, strict=True)),
            **dict(zip(system.qdot, [x.diff(t) for x in self.q], strict=True)),
            system.t: t,
        }
        self.plain = {new: old for old, new in in_time.items()}
        self.L = system.L.xreplace(in_time)
        self.forces = [force.xreplace(in_time) for force in system.applied_forces]
        held = [
            (c.name, system.build(c.equation.left) - system.build(c.equation.right))
            for c in system.problem.constraints
        ]
        moving = set(system.qdot)
        positions = [(name, f) for name, f in held if not f.free_symbols & moving]
        rates = [(name, f) for name, f in held if f.free_symbols & moving]
        self.constraints = [name for name, _ in (*positions, *rates)]
        self.hol_coneqs = [f.xreplace(in_time) for _, f in positions]
        self.nonhol_coneqs = [f.xreplace(in_time) for _, f in rates]

    def solved(self):
        """Accelerations and multipliers as LUsolve leaves them."""
        method = LagrangesMethod(
            self.L, self.q, hol_coneqs=self.hol_coneqs, nonhol_coneqs=self.nonhol_coneqs
        )
        method.form_lagranges_equations()
        n = len(self.q)
        right = method.forcing_full[n:, 0]
        forces = sympy.Matrix([*self.forces, *([0] * (len(right) - n))])
        return list(method.mass_matrix_full[n:, n:].LUsolve(right + forces))


def fails(solution):
    """Whether a division by 0 went through unseen."""
    return any(x.has(sympy.nan, sympy.zoo, sympy.oo) for x in solution)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("path", type=Path)
    parser.add_argument("--cap", type=float, default=60)
    parser.add_argument("--only-time", action="store_true")
    arguments = parser.parse_args()
    started = time.process_time()
    from lagcli import load
    from lagcli.diagnostics import ProblemError
    from lagcli.mechanics.system import System
    from lagcli.pipeline import with_lagrangian

    problem = load(arguments.path)
    try:
        script = Script(System(with_lagrangian(problem)))
    except ProblemError as mistake:  # an H without L: there is nothing to compare
        told = {"late": False, "fails": str(mistake)[:200], "simplify": [], "cpu": 0.0}
        print(json.dumps(told))
        return
    reading = time.process_time() - started
    end = arguments.cap + reading
    found = {"late": False, "fails": None, "simplify": []}
    solution, simplified = None, []
    try:
        with Limit(end - time.process_time()):
            solution = script.solved()
        if fails(solution):
            found["fails"] = "a division by zero"
    except Late:
        found["late"] = True
    except Exception as mistake:  # noqa: BLE001 - whatever SymPy raises, it fails
        found["fails"] = f"{type(mistake).__name__}: {mistake}"[:200]
    if solution is not None and not found["fails"]:
        for i, value in enumerate(solution):
            begun = time.process_time()
            try:
                with Limit((end - begun) / (len(solution) - i)):
                    simplified.append(sympy.simplify(value))
                    print(simplified[-1], file=sys.stderr)
            except Late:
                found["late"] = True
                simplified.append(None)
            except Exception as mistake:  # noqa: BLE001
                found["fails"] = f"simplify, {type(mistake).__name__}: {mistake}"[:200]
                break
            found["simplify"].append(time.process_time() - begun)
        if fails([x for x in simplified if x is not None]):
            found["fails"] = "a division by zero"
    found["cpu"] = time.process_time() - reading
    print(json.dumps(found), flush=True)
    if not arguments.only_time:
        from tests.bench.formulas import compared

        if found["fails"]:
            solution, simplified = None, []
        print(json.dumps(found | compared(problem, script, solution, simplified)))


if __name__ == "__main__":
    main()
