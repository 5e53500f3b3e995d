"""N = q D + R with a single term q, where that leaves a shorter R.

Division with remainder depends on the order of the variables; this does not.
"""

from __future__ import annotations

from collections import Counter

from lagcli.algebra.ring import Monomial, Poly, Ring


def commonest_ratio(ring: Ring, above: Poly, below: Poly) -> Poly | None:
    """The q by which most terms of the divisor are found in the other polynomial."""
    divisors = [(dict(monomial), value) for monomial, value in ring.terms(below)]
    count: Counter[tuple[Monomial, int]] = Counter()
    for monomial, value in ring.terms(above):
        exponents = dict(monomial)
        for divisor, number in divisors:
            if value % number or any(exponents.get(g, 0) < e for g, e in divisor.items()):
                continue
            ratio = tuple((g, e - divisor.get(g, 0)) for g, e in monomial if e > divisor.get(g, 0))
            count[ratio, value // number] += 1
    if not count:
        return None
    # the first of equally common ones: the order of the terms is fixed
    found, times = count.most_common(1)[0]
    return ring.build([found]) if 2 * times >= len(divisors) else None
