"""CasADi's derivatives under CVODES: python with_casadi.py SYSTEM TOLERANCE."""

import json
import re
import sys
import time
from pathlib import Path

import casadi as ca

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.bench.motions import SYSTEMS

system, tolerance = SYSTEMS[sys.argv[1]], float(sys.argv[2])
n = len(system.coordinates)
q, v = ca.SX.sym("q", n), ca.SX.sym("v", n)
space = {"sqrt": ca.sqrt, "sin": ca.sin, "cos": ca.cos}
space |= {x: q[i] for i, x in enumerate(system.coordinates)}
space |= {f"{x}_t": v[i] for i, x in enumerate(system.coordinates)}


def read(text):
    """A text as an expression."""
    return eval(re.sub(r"(\w+)'", r"\1_t", text).replace("^", "**"), space)


lagrangian = read(system.kinetic) - read(system.potential)
momenta = ca.gradient(lagrangian, v)
mass = ca.jacobian(momenta, v)
force = ca.gradient(lagrangian, q) - ca.jtimes(momenta, q, v)
rates = ca.vertcat(v, ca.solve(mass, force))
grid = [system.until * k / 100 for k in range(101)]
options = {"abstol": tolerance, "reltol": tolerance, "max_num_steps": 10**8}
options["linear_multistep_method"] = "adams" if len(sys.argv) > 3 else "bdf"
solver = ca.integrator("F", "cvodes", {"x": ca.vertcat(q, v), "ode": rates}, 0.0, grid[1:], options)
begin = time.process_time()
end = solver(x0=[*system.q, *system.v])["xf"]
state = [float(x) for x in end[:, -1].full()[:, 0]]
print(json.dumps({"end": state, "run": time.process_time() - begin}))
