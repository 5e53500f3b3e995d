"""SymPy's equations, lambdified, under SciPy's DOP853: python with_scipy.py SYSTEM TOLERANCE."""

import json
import sys
import time

import numpy as np
import sympy as sp
from equations import derived
from scipy.integrate import solve_ivp

system, q, v, mass, force = derived(sys.argv[1])
tolerance, n = float(sys.argv[2]), len(q)
function = sp.lambdify([*q, *v], (mass, force), cse=True)


def rates(_, state):
    """q', q''."""
    m, f = function(*state)
    return np.concatenate([state[n:], np.linalg.solve(m, f)[:, 0]])


begin = time.process_time()
found = solve_ivp(
    rates, (0, system.until), [*system.q, *system.v], "DOP853",
    t_eval=np.linspace(0, system.until, 101), rtol=tolerance, atol=tolerance,
)  # fmt: skip
print(json.dumps({"end": list(found.y[:, -1]), "run": time.process_time() - begin}))
