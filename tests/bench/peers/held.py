"""Constrained systems: python held.py scipy|casadi|heyoka SYSTEM FILE.json TOLERANCE.

From the T, V, constraints and forces of the problem file, here as JSON: M q'' = f + G^T lambda, G q'' = -c, the
whole system solved at once, with Baumgarte's stabilization.
"""

import ast
import json
import math
import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.bench.motions import HELD

peer, name, tolerance = sys.argv[1], sys.argv[2], float(sys.argv[4])
system = HELD[name]
data = json.loads(Path(sys.argv[3]).read_text("utf-8"))
names = list(data["coordinates"])
rates = [f"{x}_t" for x in names]
n = len(names)

if peer == "scipy":
    import numpy as np
    import sympy as sp
    from scipy.integrate import solve_ivp

    q, v = list(sp.symbols(names)), list(sp.symbols(rates))
    functions, diff = {"sqrt": sp.sqrt, "sin": sp.sin, "cos": sp.cos}, sp.diff
elif peer == "casadi":
    import casadi as ca

    q, v = [ca.SX.sym(x) for x in names], [ca.SX.sym(x) for x in rates]
    functions, diff = {"sqrt": ca.sqrt, "sin": ca.sin, "cos": ca.cos}, ca.jacobian
else:
    import heyoka as hy
    import numpy as np

    q, v = [hy.expression(x) for x in names], [hy.expression(x) for x in rates]
    functions, diff = {"sqrt": hy.sqrt, "sin": hy.sin, "cos": hy.cos}, hy.diff

space = {**functions, **dict(zip(names, q, strict=True)), **dict(zip(rates, v, strict=True))}
numbers = {"sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "pi": math.pi}


def read(text, known):
    """A text as an expression."""
    text = re.sub(r"(\w+)'", r"\1_t", str(text)).replace("^", "**")
    code = compile(ast.parse(text.strip(), mode="eval"), name, "eval")
    return eval(code, {"__builtins__": {}}, known)


def along(x):
    """The rate of an expression of the coordinates."""
    return sum((diff(x, y) * u for y, u in zip(q, v, strict=True)), start=0 * q[0])


given = dict(data.get("parameters") or {}) | system.values
for key, value in given.items():
    numbers[key] = read(value["value"] if isinstance(value, dict) else value, numbers)
    space[key] = numbers[key]
definitions = dict(data.get("definitions") or {})
while definitions:  # in the order in which they use each other
    for key, text in list(definitions.items()):
        if not any(re.search(rf"\b{other}\b", str(text)) for other in definitions if other != key):
            space[key] = read(text, space) + 0 * q[0]
            space[f"{key}_t"] = along(space[key])
            del definitions[key]

kinetic, potential = (read(data.get(x, text), space) for x, text in system.energies.items())
lagrangian = kinetic - potential
lost = read(data.get("dissipation", 0), space) + 0 * q[0]
applied = {key: read(text, space) for key, text in (data.get("forces") or {}).items()}
momenta = [diff(kinetic, u) for u in v]
mass = [[diff(p, u) for u in v] for p in momenta]
force = [
    diff(lagrangian, x) - along(p) - diff(lost, u) + applied.get(key, 0)
    for key, x, u, p in zip(names, q, v, momenta, strict=True)
]
sides = [
    text.split("=") for x, text in (data.get("constraints") or {}).items() if x != system.implied
]
surfaces = [read(f"({left}) - ({right})", space) for left, right in sides]
rows = [[diff(g, x) for x in q] for g in surfaces]
a = system.stabilized
bias = [
    -along(along(g)) - 2 * a * along(g) - a * a * g for g in surfaces
]  # of the accelerations: at q'' = 0, and what pulls back
start = {
    key: read(x, numbers)
    for key, x in ((re.sub("'", "_t", k), x) for k, x in data["initial"].items())
}
state = [float(start.get(key, 0)) for key in (*names, *rates)]
m = len(surfaces)
grid = [system.until * k / 100 for k in range(101)]

if peer == "scipy":
    whole = sp.Matrix(
        [[*row, *(g[i] for g in rows)] for i, row in enumerate(mass)]
        + [[*g, *[0] * m] for g in rows]
    )
    function = sp.lambdify([*q, *v], (whole, sp.Matrix([*force, *bias])), cse=True)

    def slope(_, state):
        """q', q''."""
        left, right = function(*state)
        try:
            found = np.linalg.solve(left, right)[:n, 0]
        except np.linalg.LinAlgError:
            found = np.linalg.lstsq(left, right, rcond=1e-10)[0][:n, 0]
        return np.concatenate([state[n:], found])

    begin = time.process_time()
    found = solve_ivp(
        slope, (0, system.until), state, "DOP853", t_eval=grid, rtol=tolerance, atol=tolerance
    )
    end = list(found.y[:, -1])
elif peer == "casadi":
    left = ca.vertcat(
        *(ca.horzcat(*row, *(g[i] for g in rows)) for i, row in enumerate(mass)),
        *(ca.horzcat(*g, *[0] * m) for g in rows),
    )
    slope = ca.vertcat(*v, ca.solve(left, ca.vertcat(*force, *bias))[:n])
    options = {"abstol": tolerance, "reltol": tolerance, "max_num_steps": 10**8}
    ode = {"x": ca.vertcat(*q, *v), "ode": slope}
    solver = ca.integrator("F", "cvodes", ode, 0.0, grid[1:], options)
    begin = time.process_time()
    end = [float(x) for x in solver(x0=state)["xf"][:, -1].full()[:, 0]]
else:
    zero = 0 * q[0]
    left = [[*row, *(g[i] for g in rows)] for i, row in enumerate(mass)]
    left += [[*g, *[zero] * m] for g in rows]
    right = [*force, *bias]
    for k in range(n + m):  # M is definite, and so is what is left of it: no pivots are sought
        for i in range(k + 1, n + m):
            factor = left[i][k] / left[k][k]
            left[i] = [x - factor * y for x, y in zip(left[i], left[k], strict=True)]
            right[i] = right[i] - factor * right[k]
    for k in reversed(range(n + m)):
        for j in range(k + 1, n + m):
            right[k] = right[k] - left[k][j] * right[j]
        right[k] = right[k] / left[k][k]
    ode = [*zip(q, v, strict=True), *zip(v, right[:n], strict=True)]
    integrator = hy.taylor_adaptive(ode, state, tol=tolerance, compact_mode=True)
    begin = time.process_time()
    end = list(map(float, integrator.propagate_grid(np.array(grid))[-1][-1]))
print(json.dumps({"end": end, "run": time.process_time() - begin}))
