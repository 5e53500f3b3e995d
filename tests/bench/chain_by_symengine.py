"""The matrices of a planar chain by differentiating L in symengine: `chain_by_symengine.py N`."""

import sys

import symengine


def main(n):
    def symbols(name):
        return [symengine.Symbol(f"{name}{k + 1}") for k in range(n)]

    q, v, m, length, g = *map(symbols, "qvml"), symengine.Symbol("g")
    L = symengine.Integer(0)
    for k in range(n):
        x = sum(length[i] * symengine.cos(q[i]) * v[i] for i in range(k + 1))
        y = sum(length[i] * symengine.sin(q[i]) * v[i] for i in range(k + 1))
        height = -sum(length[i] * symengine.cos(q[i]) for i in range(k + 1))
        L += m[k] * (x**2 + y**2) / 2 - m[k] * g * height
    p = [L.diff(a) for a in v]
    mass = [[a.diff(b) for b in v] for a in p]
    forcing = [L.diff(q[i]) - sum(p[i].diff(q[j]) * v[j] for j in range(n)) for i in range(n)]
    print(mass, forcing)


main(int(sys.argv[1]))
