"""The matrices of a planar chain by SymPy's LagrangesMethod: `chain_by_sympy.py N`."""

import sys

import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols


def main(n):
    q = dynamicsymbols(f"q1:{n + 1}")
    m, length = sympy.symbols(f"m1:{n + 1}"), sympy.symbols(f"l1:{n + 1}")
    g, t = sympy.Symbol("g"), dynamicsymbols._t
    L = 0
    for k in range(n):
        x = sum(length[i] * sympy.sin(q[i]) for i in range(k + 1))
        y = -sum(length[i] * sympy.cos(q[i]) for i in range(k + 1))
        L += m[k] * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2 - m[k] * g * y
    method = LagrangesMethod(L, q)
    method.form_lagranges_equations()
    print(method.mass_matrix, method.forcing)


main(int(sys.argv[1]))
