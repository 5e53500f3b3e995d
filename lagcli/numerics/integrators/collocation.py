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
from functools import cache
from math import comb
from typing import Any

from lagcli.numerics.equations.null_space import dot

#: Everything is worked out so exactly that the coefficients are right to the last bit.
_BITS = 200


class Collocation:
    """The coefficients for some nodes.

    Parameters
    ----------
    polynomial : flint.fmpz_poly
        Whose roots in (0, 1] are the nodes.

    Attributes
    ----------
    nodes : list of float
    a, a_squared : list of list of float
        A and its square.
    weights, weights_a : list of float
        b and b A, for v and q at the end of the step.
    eigenvalues : list of complex
        mu of A; of each pair of conjugates the first only.
    to_modes, from_modes : list of list of complex
        Rows of T^-1 and columns of T, twice the column of a pair: its half is the real part.
    """

    def __init__(self, polynomial: Any) -> None:
        from flint import acb_mat, arb_mat, ctx, fmpq

        with ctx.workprec(_BITS):
            nodes = sorted((root.real for root, _ in polynomial.complex_roots()), key=float)
            self.size = s = len(nodes)
            # the coefficients of the Lagrange polynomials of the nodes are its columns
            basis = arb_mat([[c**k for k in range(s)] for c in nodes]).inv()
            a = arb_mat([[c ** (k + 1) / (k + 1) for k in range(s)] for c in nodes]) * basis
            weights = arb_mat([[fmpq(1, k + 1) for k in range(s)]]) * basis
            self.nodes = [float(c) for c in nodes]
            self.a, self.a_squared = _floats(a), _floats(a * a)
            self.weights, self.weights_a = _floats(weights)[0], _floats(weights * a)[0]
            self._basis = _floats(basis.transpose())
            every, vectors = acb_mat(a).eig(right=True)
            inverse = vectors.inv()
            order = sorted(range(s), key=lambda k: (not _is_real(every[k]), float(every[k].real)))
            kept = [k for k in order if _is_real(every[k]) or float(every[k].imag) > 0]
            self.eigenvalues = [_complex(every[k]) for k in kept]
            self.to_modes, self.from_modes = [], []
            for k in kept:
                scale = vectors[s - 1, k]
                twice = 1 if _is_real(every[k]) else 2
                self.to_modes.append([_complex(inverse[k, j] * scale) for j in range(s)])
                self.from_modes.append([_complex(twice * vectors[i, k] / scale) for i in range(s)])

    def interpolated(self, x: float, values: Sequence[Sequence[float]]) -> list[float]:
        """The polynomial through values at the nodes, at x."""
        powers = [x**k for k in range(self.size)]
        weights = [dot(b, powers) for b in self._basis]
        return [dot(weights, along) for along in zip(*values, strict=True)]


@cache
def radau(size: int) -> Collocation:
    """Radau IIA of order 2 s - 1: the last node is the end; L-stable."""
    return Collocation(_legendre(size) - _legendre(size - 1))


@cache
def gauss(size: int) -> Collocation:
    """Gauss-Legendre of order 2 s: symplectic, symmetric, A-stable."""
    return Collocation(_legendre(size))


def _legendre(degree: int) -> Any:
    """P(2 x - 1)."""
    from flint import fmpz_poly

    places = range(degree + 1)
    return fmpz_poly([(-1) ** (degree + k) * comb(degree, k) * comb(degree + k, k) for k in places])


def _floats(matrix: Any) -> list[list[float]]:
    return [[float(x) for x in row] for row in matrix.tolist()]


def _is_real(x: Any) -> bool:
    return bool(x.imag.contains(0))


def _complex(x: Any) -> complex:
    return complex(float(x.real), 0.0 if _is_real(x) else float(x.imag))
