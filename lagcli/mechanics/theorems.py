"""The theorems that answers are justified by: hypotheses, source, and where they are checked.

An answer names a theorem only where `checked_by` has found its hypotheses fulfilled.
"""

from __future__ import annotations

from lagcli.record import record


@record
class Theorem:
    """A theorem of mechanics.

    Attributes
    ----------
    name
        As it is printed.
    hypotheses, conclusion
        In one sentence each.
    source
        Author, title, edition, section.
    checked_by
        Module and function (or property) that check the hypotheses.
    """

    name: str
    hypotheses: str
    conclusion: str
    source: str
    checked_by: str


_ENERGY = "lagcli.mechanics.stability.energy:never_grows"
_PACKAGE = "lagcli.mechanics.stability"

LAGRANGE_DIRICHLET = Theorem(
    "Lagrange and Dirichlet",
    "The energy function is never fed, the kinetic energy is positive definite, and the potential "
    "(that of all forces, with the part of L without velocities) has a strict minimum.",
    "The equilibrium is stable, with gyroscopic terms and dissipation, too.",
    "Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., section 22; "
    "Chetaev, The Stability of Motion, chapter IV",
    f"{_PACKAGE}.lagrange_dirichlet",
)
ROUTH = Theorem(
    "Routh",
    "The effective potential has a strict minimum at the given momenta of the cyclic coordinates, "
    "and the energy function is never fed.",
    "The steady motion is stable in the other coordinates and in all velocities, also where the "
    "momenta are disturbed.",
    "Routh, Stability of a Given State of Motion, chapter IV; Merkin, Introduction to the Theory "
    "of Stability, section 3.5",
    f"{_PACKAGE}.lagrange_dirichlet",
)
KELVIN_TAIT_CHETAEV = Theorem(
    "Kelvin, Tait and Chetaev",
    "The linearised forces have a potential, and the dissipation is complete: the symmetric part "
    "of the velocity terms is positive definite.",
    "The equilibrium is asymptotically stable at a minimum of the potential, and unstable where "
    "the stiffness has a negative eigenvalue, whatever the gyroscopic terms.",
    "Chetaev, The Stability of Motion, chapter V; Merkin, Introduction to the Theory of "
    "Stability, section 6.5",
    f"{_PACKAGE}.near:Near.complete",
)
HURWITZ = Theorem(
    "Hurwitz",
    "All coefficients of the characteristic polynomial and Hurwitz's determinants are positive.",
    "All roots have negative real parts, so the equilibrium is asymptotically stable (Lyapunov's "
    "first method).",
    "Gantmacher, The Theory of Matrices, vol. 2, chapter XV, sections 6 and 13",
    f"{_PACKAGE}.hurwitz:hurwitz_conditions",
)
LYAPUNOV = Theorem(
    "Lyapunov",
    "The equations of motion are smooth there, and a root of the characteristic polynomial has a "
    "positive real part.",
    "The equilibrium is unstable.",
    "Lyapunov, The General Problem of the Stability of Motion (1892), chapter I, section 24",
    f"{_PACKAGE}.lyapunov:by_a_growing_root",
)
LYAPUNOV_MALKIN = Theorem(
    "Lyapunov and Malkin",
    "The equilibria near it form a manifold with as many dimensions as there are roots 0, and all "
    "other roots have negative real parts.",
    "It is stable, and what is disturbed comes to rest at an equilibrium near it.",
    "Malkin, Theory of Stability of Motion, section 34; Neimark, Fufaev, Dynamics of Nonholonomic "
    "Systems, chapter VI",
    f"{_PACKAGE}.near:Near.as_many_equilibria",
)
NOETHER = Theorem(
    "Noether",
    "To first order the change of the action and the work of all forces along the transformation "
    "add up to a total derivative, on the motion.",
    "The charge p Δq − h Δt − gauge is conserved.",
    "Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., section 13.7; with forces and "
    "constraints: Vujanovic, Int. J. Non-Linear Mech. 13 (1978) 185",
    "lagcli.mechanics.noether:Noether.applies",
)
FROBENIUS = Theorem(
    "Frobenius",
    "The exterior derivative of each form of a Pfaffian system vanishes modulo the system; of one "
    "that does not, the last derived system is the largest part that does.",
    "The constraints on the velocities are derivatives of constraints on the positions.",
    "Frankel, The Geometry of Physics, 3rd ed., section 6.1",
    "lagcli.mechanics.constraints:Constraints.integrable_forms",
)
LEVI_CIVITA = Theorem(
    "Levi-Civita",
    "The Hamiltonian does not depend on t, and Levi-Civita's expression vanishes for each pair of "
    "coordinates.",
    "The equation of Hamilton and Jacobi separates in these coordinates, and only then.",
    "Levi-Civita, Math. Ann. 59 (1904) 383",
    "lagcli.mechanics.reduction.separation:levi_civita",
)
LIOUVILLE_ARNOLD = Theorem(
    "Liouville and Arnold",
    "There are as many conserved quantities as degrees of freedom, functionally independent and "
    "with brackets that vanish.",
    "The motion is integrable by quadratures.",
    "Arnold, Mathematical Methods of Classical Mechanics, 2nd ed., section 49",
    "lagcli.mechanics.discovery.brackets:Brackets.in_involution",
)

THEOREMS = (
    LAGRANGE_DIRICHLET,
    ROUTH,
    KELVIN_TAIT_CHETAEV,
    HURWITZ,
    LYAPUNOV,
    LYAPUNOV_MALKIN,
    NOETHER,
    FROBENIUS,
    LEVI_CIVITA,
    LIOUVILLE_ARNOLD,
)
