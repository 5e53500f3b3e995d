"""heyoka's Taylor series, M q'' = F by its own derivatives: python with_heyoka.py SYSTEM TOLERANCE [UNTIL]."""

import json
import re
import sys
import time
from pathlib import Path

import heyoka as hy
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.bench.motions import SYSTEMS

system, tolerance = SYSTEMS[sys.argv[1]], float(sys.argv[2])
n = len(system.coordinates)
q = hy.make_vars(*system.coordinates) if n > 1 else [hy.make_vars(system.coordinates[0])]
rates = [f"{x}_t" for x in system.coordinates]
v = hy.make_vars(*rates) if n > 1 else [hy.make_vars(rates[0])]
space = {"sqrt": hy.sqrt, "sin": hy.sin, "cos": hy.cos}
space |= dict(zip(system.coordinates, q, strict=True)) | dict(zip(rates, v, strict=True))


def read(text):
    """A text as an expression."""
    return eval(re.sub(r"(\w+)'", r"\1_t", text).replace("^", "**"), space)


equations = hy.model.__dict__.get("lagrangian") or hy.lagrangian
lagrangian = read(system.kinetic) - read(system.potential)
ode = equations(lagrangian, list(q), list(v))
integrator = hy.taylor_adaptive(ode, [*system.q, *system.v], tol=tolerance, compact_mode=n > 3)
until = float(sys.argv[3]) if len(sys.argv) > 3 else system.until
begin = time.process_time()
end = integrator.propagate_grid(np.linspace(0, until, 101))[-1][-1]
print(json.dumps({"end": list(map(float, end)), "run": time.process_time() - begin}))
