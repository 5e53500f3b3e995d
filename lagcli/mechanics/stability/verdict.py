"""A verdict on stability: with its reason, or with the conditions that decide."""

from __future__ import annotations

from sympy import Expr, Symbol

from lagcli.mechanics.theorems import Theorem
from lagcli.record import record


@record(kw_only=True)
class Stability:
    """The verdict with its reason; "{V}" in the reason stands for the potential.

    Attributes
    ----------
    by
        The theorem that decides, or that does so where the conditions hold.
    asymptotic
        Whether it is asymptotically stable, where it is stable.
    minimum, spectrum, hurwitz
        What must be positive for a minimum of V, for frequencies that are real and distinct,
        for roots that all have negative real parts; empty: it is always so.  None: not examined
        for, never so, or not decided.
    reverses
        Whether it is unstable where one of `minimum` is negative.  (Of the others it is.)
    exact
        The equations of motion are linear: the spectrum decides beyond first order.
    across
        Stable up to displacements along a family of equilibria.
    along
        The coordinates that alone may be displaced ever further; None: all of the family.
    neutral
        Every possible position near it is an equilibrium, and the kinetic energy never grows.
    released
        Stable up to displacements to equilibria at which a contact that is closed is open.
    growing
        It is unstable where this is positive, and it is nowhere negative.
    opposed
        It is unstable where one of these is negative, and they are nowhere all positive.
    rapid
        The frequency of a drive: the verdict is on the averaged motion where that is large.
    grows_at_equality
        Linear equations have solutions that grow where the one condition of `spectrum` is an
        equality.
    critical
        Where the one condition of `minimum` is an equality, the order of the first derivative
        that is not 0: of the minimum, or negative where there is none, so that it is unstable;
        0 where the potential is constant.  None: not known.
    """

    stable: bool | None = None
    reason: str = ""
    by: Theorem | None = None
    asymptotic: bool = False
    minimum: tuple[Expr, ...] | None = None
    spectrum: tuple[Expr, ...] | None = None
    hurwitz: tuple[Expr, ...] | None = None
    reverses: bool = False
    exact: bool = False
    across: bool = False
    along: tuple[Symbol, ...] | None = None
    neutral: bool = False
    released: bool = False
    growing: Expr | None = None
    opposed: tuple[Expr, ...] = ()
    rapid: Expr | None = None
    grows_at_equality: bool = False
    critical: int | None = None

    @property
    def is_open(self) -> bool:
        """Whether nothing was decided, not even under conditions."""
        decided = (self.stable, self.minimum, self.spectrum, self.hurwitz, self.growing, self.rapid)
        return all(each is None for each in decided) and not self.opposed


def undecided(reason: str) -> Stability:
    """No verdict, and why."""
    return Stability(reason=reason)


def unstable(reason: str) -> Stability:
    """What leaves."""
    return Stability(stable=False, reason=reason)
