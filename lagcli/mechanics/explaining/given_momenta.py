"""For which momenta a steady motion exists: the discriminant of the equation for its rate.

p(u) = A u + B + C/u at a given configuration is A u^2 + (B - p) u + C = 0, which has real roots
just for (p - B)^2 >= 4 A C: of the heavy symmetric top p_psi^2 >= 4 I1 m g l cos(theta).

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 5.7.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy
from sympy import Dummy

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.vanishing_factors import may_vanish
from lagcli.document import Block
from lagcli.expression import Name
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import says
from lagcli.statements.motions import SteadyMotion
from lagcli.statements.wording import conditions as inequalities


def two_rates(explainer: Explainer, motion: SteadyMotion) -> Iterator[Block]:
    """The condition for each momentum that is quadratic in the one free velocity over itself."""
    rates = [name.rstrip("'") for name in motion.free if name.endswith("'")]
    if len(rates) != 1:
        return
    system, write = explainer.system, explainer.readable.as_written
    u = system.symbol_of(rates[0] + "'")
    for name, tree in motion.momenta.items():
        p = system.symbol_of(f"p_{name}")
        above = sympy.numer(sympy.together(p - system.build(tree)))
        try:
            powers = sympy.Poly(above, u).all_coeffs()
        except sympy.PolynomialError:
            continue
        if len(powers) != 3 or not all(free_of(c, [u]) for c in powers):
            continue
        c, b, a = powers[::-1]
        if free_of(b, [p]) or is_zero(a * c) is not False:
            continue
        scale = b.diff(p)
        square, bound = simplify((b / scale) ** 2), simplify(4 * a * c / scale**2)
        sines = {s: Dummy(positive=True) for s in bound.atoms(sympy.sin)}  # of polar angles
        if weak_sign(bound.xreplace(sines), ()) == -1:
            continue  # it holds for every momentum
        rate, order = Name(rates[0], 1), system.order
        squares = [f**2 for f in may_vanish(a)]
        where = [" and " if squares else "", *inequalities(conditions(squares, order))]
        yield says("For a given ", Name(p.name), *where, " this is a quadratic equation for ", rate,
                   ", with real roots for ", write(square), " ≥ ", write(bound), ".")  # fmt: skip
