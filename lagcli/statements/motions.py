"""Statements on one degree of freedom, steady motions, and the separated action."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.record import field, record


@record
class Above:
    """`left > right`, the condition for what it stands beside; with it the `besides` hold."""

    left: Expression
    right: Expression
    besides: tuple[Above, ...] = ()


@record(kw_only=True)
class Verdict:
    """Whether an equilibrium or a steady motion is stable: one form for both.

    `stable` None: it depends on conditions, or was not decided; `reason` says why, "{V}" in it
    stands for the `potential`.  `minimum` says where that has a minimum, `hurwitz` where all roots
    have negative real parts, `spectrum` where all frequencies are real and distinct, which is
    stability to first order, or more where the equations are linear (`exact`).  Empty: always,
    None: never, or not decided.  `unstable` is it where one of these inequalities holds.
    `asymptotic`: where it is stable by the first two, what is disturbed returns, to the family
    where it is stable `across` one, `along` which only these coordinates may be displaced ever
    further (empty: all may); `neutral`: every possible position near it is one; `released`: up to
    displacements to equilibria at which what is closed is open.  `gyroscopic`: the spectrum is
    that of terms that damping would outdo.  `rapid` is the frequency of a drive over whose period
    the motion is averaged.
    `theorem` is the name of the one that decides.  `critical` is the order of the minimum at
    equality in the one condition of `minimum`, or minus that of the first derivative that is not
    0 where there is none, and it is unstable; 0, the potential is constant; None, not known.
    It `grows_at_equality` in the one condition of `spectrum` in proportion to a power of t.
    """

    stable: bool | None
    reason: str = ""
    theorem: str = ""
    potential: str = "V"
    asymptotic: bool = False
    across: bool = False
    along: tuple[str, ...] = ()
    neutral: bool = False
    released: bool = False
    minimum: tuple[Above, ...] | None = None
    hurwitz: tuple[Above, ...] | None = None
    spectrum: tuple[Above, ...] | None = None
    unstable: tuple[Above, ...] = ()
    exact: bool = False
    gyroscopic: bool = False
    rapid: Expression | None = None
    critical: int | None = None
    grows_at_equality: bool = False


@record(kw_only=True)
class PeriodSeries:
    """T about one minimum of U_eff.

    `amplitude` is the name in `period` of half the distance of the turning points, empty
    where the period is that of small oscillations alone; `order` is its highest power.
    Where the motion is `isochronous`, it is the same at every amplitude: the arc, or its square
    where that is `squared`, is that of a harmonic oscillator; it is `straight` where the arc is
    a multiple of the coordinate.
    A minimum that is not solved for is where `root_of` vanishes, `at` is empty then.
    `by_energy` is T as a function of the constant energy, where each of `energies` holds.
    """

    at: Mapping[str, Expression]
    amplitude: str
    period: Expression
    order: int = 0
    isochronous: bool = False
    squared: bool = False
    straight: bool = False
    root_of: Expression | None = None
    where: tuple[Above, ...] = ()
    by_energy: Expression | None = None
    energies: tuple[Above, ...] = ()


@record
class Irreducible:
    """A coordinate that does not occur in L and that no reduction eliminates, and why.

    `conserved` is whether its momentum is constant all the same, None where undecided.
    """

    conserved: bool | None
    why: str


@record(kw_only=True)
class OneFreedom:
    """The one remaining coordinate: E = `energy`, dt = `rate` dq, T = 2 int `rate` dq.

    `turning_points` are the roots of U_eff = E, None where that has no closed solution; those
    that are real count, where the coordinate is `positive` those that are positive; it `leaves_out`
    those where one-sided contacts would have to pull.  A length has one of those that repeat with
    `turning_period`.  They are given where each of `turning_finite` holds: a root moves to infinity
    elsewhere.  All of them are real for E between the bounds of each of `turning_energies`.  Where
    the kinetic energy is `regular`, positive at every position, nothing else turns it back.
    One-sided contacts hold at each of them under the conditions of `turning_where`, as do the
    signs that are assumed of the `signed` coordinates that are eliminated; these alone where
    nothing is `one_sided`. Where nothing `oscillates`, the motion comes back from one of them
    only. `when` says when E is constant, where an impact changes it.
    """

    coordinate: str
    constant: str
    energy: Expression
    turning_points: tuple[Expression, ...] | None
    rate: Expression
    periods: tuple[PeriodSeries, ...]
    positive: bool = False
    leaves_out: bool = False
    turning_period: Expression | None = None
    turning_finite: tuple[Above, ...] = ()
    turning_energies: tuple[tuple[Expression, Expression], ...] = ()
    turning_where: tuple[tuple[Above, ...], ...] = ()
    one_sided: int = 1
    signed: tuple[str, ...] = ()
    regular: bool = True
    oscillates: bool = True
    when: str = ""
    reason: str = ""


@record(kw_only=True)
class SteadyMotion:
    """The cyclic coordinates turn at constant `rates`, the others rest `at` their values.

    `free` may have any value.  It is there where each of `where` holds, and with all rates
    and momenta reversed where it is `mirrored`; it `rests` where both sides of the one in `where`
    are equal.  `rates` None: the axes of two rotations coincide, so only the momenta are known.
    The equation `on` ties coordinates of a family.  Where a squared frequency `may_be_complex`, a
    displacement then oscillates and grows.  The matrices are those of the coordinates `displaced`,
    with the others in terms of them where each of `linear_where` holds.
    """

    at: Mapping[str, Expression]
    free: tuple[str, ...]
    rates: Mapping[str, Expression] | None
    momenta: Mapping[str, Expression]
    where: tuple[Above, ...]
    mirrored: bool
    verdict: Verdict
    frequencies_squared: tuple[Expression, ...]
    mass: tuple[tuple[Expression, ...], ...] = ()
    velocity: tuple[tuple[Expression, ...], ...] = ()
    stiffness: tuple[tuple[Expression, ...], ...] = ()
    displaced: tuple[str, ...] = ()
    linear_where: tuple[Above, ...] = ()
    on: tuple[Expression, Expression] | None = None
    rolling: bool = False
    may_be_complex: bool = False
    rests: bool = False


@record(kw_only=True)
class SteadySection:
    """The conditions that vanish, by coordinate or number, and the motions; None with a `reason`.

    They are dU_eff/dq minus what is `acting`: "forces", "constraints", along which they are taken.
    `momenta` are the cyclic coordinates whose momenta are constant.  Where there are no motions,
    there may be some for parameters for which each of `unless` vanishes; None: for special values.
    Where some are listed, every position is one of them for parameters for which one of `void`
    vanishes, and there may be more where one of `degenerate` does.
    What is not `complete` was not sought where each of `singular_where` vanishes.
    `where` restricts what was sought, in words; of what is `resting` the conditions are of rest.
    All hold in each of the `frames`, too: velocities that are common to all in terms of one.
    Nothing changes when the two coordinates of a `plane` turn about the origin.
    They are not listed where they are `everywhere`.

    Under velocity constraints, and where a force acts along what L does not contain, the
    conditions are what is left of the equations of motion (`acting`: "inertia"), along the
    constraints, from which the `eliminated` velocities follow; each motion is then `rolling`.
    """

    conditions: Mapping[str, Expression]
    motions: tuple[SteadyMotion, ...] | None
    complete: bool = True
    eliminated: tuple[str, ...] = ()
    acting: tuple[str, ...] = ()
    reason: str = ""
    momenta: tuple[str, ...] = ()
    unless: tuple[Expression, ...] | None = ()
    void: tuple[Expression, ...] = ()
    degenerate: tuple[Expression, ...] = ()
    singular_where: tuple[Expression, ...] = ()
    where: str = ""
    resting: bool = False
    frames: tuple[Mapping[str, Expression], ...] = ()
    plane: tuple[str, ...] = ()
    everywhere: bool = False

    @property
    def sought(self) -> str:
        """What was sought: without momenta, motions along coordinates of the file only."""
        return ("" if self.momenta or self.eliminated else " in these coordinates") + self.where


@record
class ActionPart:
    """One W, where each of `where` holds."""

    function: Expression
    where: tuple[Above, ...]


@record(kw_only=True)
class HamiltonJacobiSection:
    """H(q, dS/dq) = E with S = -E t + sum W_i(q_i), where it separates in the coordinates given.

    `hamiltonian` has p for dS/dq.  `separable` is the verdict of Levi-Civita's test, `obstacle`
    the first pair of coordinates at which it fails, `in_general` where special values of the
    parameters may make it hold.  `equations` are the separated ones (= 0),
    `derivatives` the W_i' with their positive roots, `functions` the W_i that are elementary
    and `cases` those that are so case by case; `constants` are E, the
    momenta of the cyclic coordinates, and those of separation.

    With forces F(t) dS/dt + H = 0 has S = sum p_i q_i + f(t): `derivatives` are the p_i(t),
    `time_rate` is f', `of_time` f where it is elementary, `integrals` those over the time
    that have no closed form and stand in the others by name.
    """

    hamiltonian: Expression | None
    energy: str
    separable: bool | None
    obstacle: tuple[str, ...] = ()
    in_general: bool = False
    constants: tuple[str, ...] = ()
    equations: Mapping[str, Expression] = field(default_factory=dict)
    derivatives: Mapping[str, Expression] | None = None
    functions: Mapping[str, Expression] = field(default_factory=dict)
    cases: Mapping[str, tuple[ActionPart, ...]] = field(default_factory=dict)
    time_rate: Expression | None = None
    of_time: Expression | None = None
    integrals: Mapping[str, Expression] = field(default_factory=dict)
    reason: str = ""
