"""A loop over SciPy's DOP853 with a right-hand side compiled by Numba.

python ensemble_scipy.py TOLERANCE < members, one `[a, b]` a line: the ends and the time of the loop.
"""

import json
import sys
import time

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp


@njit
def rates(_, y):
    """Two equal masses on two equal rods, l = 1, g = 9.81."""
    a, b, u, v = y
    c, s = np.cos(a - b), np.sin(a - b)
    d = 2 - c * c
    up = (-s * (c * u * u + v * v) - 9.81 * (2 * np.sin(a) - np.sin(b) * c)) / d
    vp = (s * (2 * u * u + c * v * v) + 2 * 9.81 * (np.sin(a) * c - np.sin(b))) / d
    return np.array([u, v, up, vp])


tolerance, members = float(sys.argv[1]), json.load(sys.stdin)
rates(0.0, np.zeros(4))  # compiled before the clock starts
begin, cpu = time.perf_counter(), time.process_time()
ends = [
    solve_ivp(rates, (0, 10), [*x, 0.0, 0.0], "DOP853", rtol=tolerance, atol=tolerance).y[:2, -1]
    for x in members
]
wall, cpu = time.perf_counter() - begin, time.process_time() - cpu
print(json.dumps({"ends": [list(x) for x in ends], "wall": wall, "cpu": cpu}))
