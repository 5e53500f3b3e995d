"""Real roots of a small polynomial, for initial values that are left out."""

from __future__ import annotations

from collections.abc import Sequence

#: Rounding of the coefficients splits a double root by its square root.
_SAME = 1e-7


def real_roots(coefficients: Sequence[float]) -> list[float]:
    """The distinct real roots of c0 + c1 x + c2 x^2 + …, in order.

    Two that lie closer than rounding of the coefficients would set them apart are one, also where
    it makes them complex.
    """
    from flint import fmpq, fmpq_poly

    size = max(map(abs, coefficients), default=0.0)
    c = list(coefficients)
    while c and abs(c[-1]) <= 1e-14 * size:
        c.pop()
    if len(c) < 2:
        return []
    exact = fmpq_poly([fmpq(*float(x).as_integer_ratio()) for x in c])
    roots = [complex(root) for root, _ in exact.complex_roots()]
    scale = max(map(abs, roots))
    kept: list[float] = []
    for root in sorted(x.real for x in roots if abs(x.imag) <= _SAME * scale):
        if not kept or root - kept[-1] > _SAME * scale:
            kept.append(root)
    return kept
