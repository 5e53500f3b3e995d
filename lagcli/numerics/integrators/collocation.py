"""Collocation methods: nodes, weights, and what the solution of their stages needs.

With nodes c_i the stages of q'' = a(t, q, q') are K_i = a(t + c_i h, Q_i, V_i),

    V_i = v + h sum A_ij K_j,    Q_i = q + c_i h v + h^2 sum (A^2)_ij K_j,

and A = T diag(mu) T^-1 separates their linear systems, of n s unknowns, into s of n.

References
----------
Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., sections IV.5
(collocation, Radau IIA) and IV.8 (the transformation, the error estimate).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import comb
from typing import Any

from lagcli.numerics.integrators.linear import Factors

Polynomial = list[Fraction]

#: Nodes are found so exactly that the coefficients are right to the last bit.
_BITS = 120
_GRID = 512
_SWEEPS = 200


class Collocation:
    """The coefficients for some nodes.

    Parameters
    ----------
    polynomial
        Whose roots in (0, 1] are the nodes; its coefficients from the constant on.

    Attributes
    ----------
    nodes : list of float
    a, a_squared : list of list of float
        A and its square.
    weights, weights_a : list of float
        b and b A, for v and q at the end of the step.
    eigenvalues : list of complex
        mu of A; of each pair of conjugates the first only.
    """

    def __init__(self, polynomial: Polynomial) -> None:
        nodes = _roots(polynomial)
        self.size = s = len(nodes)
        basis = [_lagrange(nodes, j) for j in range(s)]
        a = [[_integral(basis[j], nodes[i]) for j in range(s)] for i in range(s)]
        b = [_integral(basis[j], Fraction(1)) for j in range(s)]
        squared = [[sum(a[i][k] * a[k][j] for k in range(s)) for j in range(s)] for i in range(s)]
        self.nodes = [float(c) for c in nodes]
        self.a = [[float(x) for x in row] for row in a]
        self.a_squared = [[float(x) for x in row] for row in squared]
        self.weights = [float(x) for x in b]
        self.weights_a = [float(sum(b[k] * a[k][j] for k in range(s))) for j in range(s)]
        self._basis = [[float(x) for x in each] for each in basis]
        self._diagonalize(a)

    def _diagonalize(self, a: list[list[Fraction]]) -> None:
        every = sorted(_eigenvalues(a), key=lambda mu: (abs(mu.imag) > 1e-12, mu.real, -mu.imag))
        self.eigenvalues = [
            complex(mu.real, 0.0) if abs(mu.imag) <= 1e-12 else mu
            for mu in every
            if mu.imag > -1e-12
        ]
        columns = [_eigenvector(self.a, mu) for mu in self.eigenvalues]
        #: a pair's second column is the conjugate of its first
        pairs = [mu.imag > 0 for mu in self.eigenvalues]
        whole = [
            column
            for vector, pair in zip(columns, pairs, strict=True)
            for column in ([vector, [x.conjugate() for x in vector]] if pair else [vector])
        ]
        matrix = [[column[i] for column in whole] for i in range(self.size)]
        factors = Factors(matrix)
        units = [[float(i == j) for i in range(self.size)] for j in range(self.size)]
        inverse = [factors.solve(unit) for unit in units]  # its columns
        place = 0
        #: rows of T^-1 and columns of T, twice the column of a pair: its half is the real part
        self.to_modes: list[list[complex]] = []
        self.from_modes: list[list[complex]] = []
        for vector, pair in zip(columns, pairs, strict=True):
            self.to_modes.append([column[place] for column in inverse])
            self.from_modes.append([2 * x for x in vector] if pair else vector)
            place += 1 + pair

    def interpolated(self, x: float, values: Sequence[Sequence[float]]) -> list[float]:
        """The polynomial through values at the nodes, at x."""
        powers = [x**k for k in range(self.size)]
        weights = [sum(c * p for c, p in zip(b, powers, strict=True)) for b in self._basis]
        return [
            sum(w * row[j] for w, row in zip(weights, values, strict=True))
            for j in range(len(values[0]))
        ]


@cache
def radau(size: int) -> Collocation:
    """Radau IIA of order 2 s - 1: the last node is the end; L-stable."""
    one, other = _legendre(size), _legendre(size - 1)
    return Collocation([a - b for a, b in zip(one, [*other, Fraction(0)], strict=True)])


@cache
def gauss(size: int) -> Collocation:
    """Gauss-Legendre of order 2 s: symplectic, symmetric, A-stable."""
    return Collocation(_legendre(size))


def _legendre(degree: int) -> Polynomial:
    """P(2 x - 1)."""
    sign = (-1) ** degree
    return [
        Fraction(sign * (-1) ** k * comb(degree, k) * comb(degree + k, k))
        for k in range(degree + 1)
    ]


def _roots(polynomial: Polynomial) -> list[Fraction]:
    """The roots in (0, 1], in order."""
    places = [Fraction(k, _GRID) for k in range(_GRID + 1)]
    found: list[Fraction] = []
    for low, high in pairwise(places):
        at_low, at_high = _value(polynomial, low), _value(polynomial, high)
        if at_high == 0:
            found.append(high)
        elif at_low * at_high < 0:
            for _ in range(_BITS):
                middle = (low + high) / 2
                at_middle = _value(polynomial, middle)
                low, high = (middle, high) if at_low * at_middle > 0 else (low, middle)
            found.append(low)
    return found


def _value(polynomial: Polynomial, x: Fraction) -> Fraction:
    value = Fraction(0)
    for coefficient in reversed(polynomial):
        value = value * x + coefficient
    return value


def _lagrange(nodes: Sequence[Fraction], which: int) -> Polynomial:
    """1 at one node, 0 at the others."""
    product = [Fraction(1)]
    for k, node in enumerate(nodes):
        if k != which:
            scale = 1 / (nodes[which] - node)
            shifted = [Fraction(0), *product]
            product = [
                (a - node * b) * scale
                for a, b in zip(shifted, [*product, Fraction(0)], strict=True)
            ]
    return [_rounded(x) for x in product]


def _integral(polynomial: Polynomial, end: Fraction) -> Fraction:
    """From 0 to the end."""
    return _rounded(
        sum((c * end ** (k + 1) / (k + 1) for k, c in enumerate(polynomial)), Fraction(0))
    )


def _rounded(x: Fraction) -> Fraction:
    return Fraction(round(x * 2**_BITS), 2**_BITS)


def _eigenvalues(matrix: list[list[Fraction]]) -> list[complex]:
    """The roots of the characteristic polynomial (Faddeev-LeVerrier, then Durand-Kerner)."""
    s = len(matrix)
    coefficients = [Fraction(1)]
    power = [[Fraction(0)] * s for _ in range(s)]
    for k in range(1, s + 1):
        for i in range(s):
            power[i][i] += coefficients[-1]
        power = [
            [sum((matrix[i][m] * power[m][j] for m in range(s)), Fraction(0)) for j in range(s)]
            for i in range(s)
        ]
        coefficients.append(-sum((power[i][i] for i in range(s)), Fraction(0)) / k)
    leading = [float(c) for c in coefficients]
    roots = [0.3 * (0.4 + 0.9j) ** k for k in range(s)]
    for _ in range(_SWEEPS):
        for i, x in enumerate(roots):
            value: complex = 0
            for c in leading:
                value = value * x + c
            for j, other in enumerate(roots):
                if j != i:
                    value /= x - other
            roots[i] = x - value
    return roots


def _eigenvector(matrix: list[list[float]], eigenvalue: complex) -> list[complex]:
    """By inverse iteration, of length about 1."""
    s = len(matrix)
    shift = eigenvalue * (1 + 1e-10)
    factors = Factors(
        [[matrix[i][j] - (shift if i == j else 0) for j in range(s)] for i in range(s)]
    )
    vector: list[Any] = [1.0] * s
    for _ in range(4):
        vector = factors.solve(vector)
        size = max(map(abs, vector))
        vector = [x / size for x in vector]
    return [x.real + 0j if not eigenvalue.imag else complex(x) for x in map(complex, vector)]
