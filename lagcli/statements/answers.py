"""A derivation as statements: what the formatters print, section by section.

Every expression is a plain tree of `lagcli.expression`, already verified and already in
the shape and order in which it is to be read.  A section that was not requested is not
in `Answers.sections`; an answer that does not exist or was not found is None.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from lagcli.expression import Expression
from lagcli.record import field, record
from lagcli.statements.motions import Above, Irreducible, OneFreedom, Verdict
from lagcli.units import Unit

#: How an answer was checked before it was printed: "exact", or at 50 digits.
Verification = Literal["exact", "50 digits"]

ConstraintKind = Literal["holonomic", "integrable", "nonholonomic"]
ChargeSource = Literal["candidate", "cyclic", "time", "discovered", "momentum equation"]


@record(kw_only=True)
class LagrangianSection:
    """L = T - V, or L as given."""

    lagrangian: Expression | None


@record(kw_only=True)
class LagrangeEquation:
    """d/dt(dL/dq') - dL/dq (left) = Q - dD/dq' + sum lambda df/dq (right)."""

    coordinate: str
    left: Expression
    right: Expression


@record(kw_only=True)
class EquationsSection:
    """One equation for each coordinate, then the constraints, each `f = 0`."""

    equations: tuple[LagrangeEquation, ...] | None
    constraints: Mapping[str, tuple[Expression, Expression]] = field(default_factory=dict)


@record(kw_only=True)
class MatrixFormSection:
    """M q'' = forcing + A^T lambda with A q'' + bias = 0; `shared` in order of use.

    `mass_matrix` is empty where the form is not given.
    """

    mass_matrix: tuple[tuple[Expression, ...], ...]
    constraint_jacobian: tuple[tuple[Expression, ...], ...]
    forcing: tuple[Expression, ...]
    constraint_bias: tuple[Expression, ...]
    shared: Mapping[str, Expression] = field(default_factory=dict)


@record(kw_only=True)
class AccelerationsSection:
    """q'' by coordinate, solved; None where the Lagrangian is singular or time ran out."""

    accelerations: Mapping[str, Expression] | None
    verified: Verification | None = None
    regular: bool = True
    degenerate: tuple[str, ...] = ()


@record(kw_only=True)
class Multiplier:
    """The multiplier of one constraint; `value` None: not determined, or not found."""

    symbol: str
    value: Expression | None
    kind: ConstraintKind | None
    verified: Verification | None = None


@record(kw_only=True)
class MultipliersSection:
    """By constraint; the redundant ones are named."""

    multipliers: Mapping[str, Multiplier]
    redundant: tuple[str, ...] = ()


@record(kw_only=True)
class ConstraintForcesSection:
    """lambda df/dq by constraint and coordinate, their total, and the force on each point.

    `on_points` is empty where the points do not determine the forces on them, None where these
    have no formulas.
    """

    forces: Mapping[str, Mapping[str, Expression | None] | None]
    total: Mapping[str, Expression] | None
    on_points: Mapping[str, Mapping[str, tuple[Expression | None, ...]]] | None = None


@record(kw_only=True)
class MomentaSection:
    """p_q = dL/dq'."""

    momenta: Mapping[str, Expression] | None
    cyclic: tuple[str, ...] = ()


@record(kw_only=True)
class EnergySection:
    """The Jacobi function h = sum q' dL/dq' - L; `reason` is a sentence."""

    function: Expression | None
    conserved: bool | None
    is_total_energy: bool | None
    reason: str


@record(kw_only=True)
class HamiltonianSection:
    """H(q, p, t); None with a reason where the Legendre transform was not inverted.

    `fold` vanishes where two branches of it meet.
    """

    hamiltonian: Expression | None
    reason: str = ""
    fold: Expression | None = None


@record(kw_only=True)
class CanonicalPair:
    """q' = dH/dp (`q`) and p' = -dH/dq + ... (`p`)."""

    q: Expression
    p: Expression


@record(kw_only=True)
class CanonicalSection:
    """The canonical equations by coordinate; `fold` as in `HamiltonianSection`."""

    equations: Mapping[str, CanonicalPair] | None
    reason: str = ""
    fold: Expression | None = None


@record(kw_only=True)
class Charge:
    """A symmetry with its charge; `rate` is dQ/dt on the motion, None if undecided.

    `transformation` holds Delta q by coordinate and Delta t under "t", zeros left out.
    `broken_by` says in words which terms make the rate, empty when conserved.  The charge is
    real where each of `where` holds (square roots of parameters).  That of a candidate is None
    where it is `trivial`: 0, or constant by the constraints alone, which conserves nothing.
    """

    name: str
    source: ChargeSource
    transformation: Mapping[str, Expression]
    gauge: Expression | None
    conserved: bool | None
    charge: Expression | None
    rate: Expression | None
    verified: Verification | None = None
    broken_by: str = ""
    when: str = ""  # of a conserved one, where the file has contacts
    where: tuple[Above, ...] = ()
    trivial: bool = False


@record(kw_only=True)
class ChargesSection:
    """The candidates of the file, then the evident symmetries; or the `discovered` ones.

    `sought` is False where the search did not come to an end and found none.
    """

    charges: tuple[Charge, ...]
    sought: bool = True
    discovered: bool = False


@record(kw_only=True)
class SpecialValue:
    """A parameter's value at which there are more charges: their number, and the new ones.

    Where they come only with values of other parameters, too, these are `given`.  All of the new
    ones are real where each of `where` holds.  There they were sought up to a `degree` in the
    velocities.
    """

    parameter: str
    value: Expression
    number: int
    degree: int
    charges: Mapping[str, Expression]
    given: Mapping[str, Expression] = field(default_factory=dict)
    where: tuple[Above, ...] = ()

    @property
    def values(self) -> dict[str, Expression]:
        """All of them, by parameter."""
        return {self.parameter: self.value, **self.given}


@record(kw_only=True)
class AlgebraSection:
    """The Lie algebra of the discovered symmetries; None: no brackets to find it by.

    `dimension` counts generators: all `number` of them, or those of the point symmetries.
    `independent` is None where no state was found, or not in the work allowed.
    `closed`: every bracket is a combination of all of them and of constants.  `with_constants`:
    constants belong to the algebra that `dimension` counts without them.  `integrable` is
    True or None; `separates` where the Hamilton-Jacobi equation shows it, not the charges, and
    where their number alone does, it `determines` the state, or the orbit without the time.
    `named_where`: the name is another one where the charges are not real.  `autonomous`: how many
    charges do not depend on t, and the name of the algebra that they make.  `by_functions`:
    `in_involution` counts functions of the charges, as fewer charges are.  Where the motion
    `is_prescribed`, no symmetry was sought.
    """

    ansatz: str
    dimension: int
    name: str | None
    independent: int | None
    in_involution: int | None
    integrable: bool | None
    number: int = 0
    closed: bool = False
    with_constants: bool = False
    separates: bool = False
    determines: Literal["", "state", "orbit"] = ""
    special: tuple[SpecialValue, ...] = ()
    named_where: tuple[Above, ...] = ()
    is_prescribed: bool = False
    autonomous: tuple[int, str] | None = None
    by_functions: bool = False

    @property
    def dimension_counts(self) -> str:
        """Which generators `dimension` counts: "charges", all of them, or "point symmetries"."""
        return "charges" if self.dimension == self.number else "point symmetries"


@record(kw_only=True)
class Equilibrium:
    """A state of rest, which exists where each of `where` holds.

    With `free` coordinates, or an equation `on`, a family, stable up to displacements along it.
    The contacts `touching` are closed, strings among them `taut`, those in `open` are not; with
    `sticking` dry friction holds it; where it is `kinked`, the potential has a minimum across its
    kinks there.
    The `indeterminate` coordinates have no value there, as the azimuth at a pole.
    """

    at: Mapping[str, Expression]
    on: tuple[Expression, Expression] | None = None
    verdict: Verdict
    where: tuple[Above, ...] = ()
    free: tuple[str, ...] = ()
    touching: tuple[str, ...] = ()
    taut: tuple[str, ...] = ()
    open: tuple[str, ...] = ()
    sticking: bool = False
    kinked: bool = False
    indeterminate: tuple[str, ...] = ()


@record(kw_only=True)
class EquilibriaSection:
    """The equilibria found; None where none could be, with a `reason`.

    Of equations that depend on t they are those `at_all_times`.  `complete`: there can be no other,
    else all solve that each of `open` is 0 (where these are not long).  Where there are none, there
    may be some for values of the parameters for which each of `unless` vanishes; None: for special
    values that are not known; and at the `edge` 0 of coordinates that are assumed positive.  Where
    some are listed, every position is one for parameters for which one of `void` vanishes, and
    there may be more where one of `degenerate` does.
    `where` restricts what was sought, in words.  They are not listed where they are `everywhere`.
    They repeat in coordinates with `periods`, of which one is listed.
    """

    equilibria: tuple[Equilibrium, ...] | None
    periods: Mapping[str, Expression] = field(default_factory=dict)
    reason: str = ""
    complete: bool = True
    at_all_times: bool = False
    open: tuple[Expression, ...] = ()
    unless: tuple[Expression, ...] | None = ()
    void: tuple[Expression, ...] = ()
    degenerate: tuple[Expression, ...] = ()
    edge: tuple[str, ...] = ()
    where: str = ""
    everywhere: bool = False


@record
class Pole:
    """r = 0 of x = r cos(phi), y = r sin(phi): the coordinate of r, all rates where phi' = 1."""

    radius: str
    turning: Mapping[str, Expression]


@record(kw_only=True)
class ModesOfFrequency:
    """The normal modes of one frequency about an equilibrium, or all `on` a line.

    `frequency` is None where it is not real, and the square is `negative` or may be positive for
    some values; both are None where they have no closed form, or are `damped`.  The displacements
    of one frequency are the combinations of `shape` and of `more_shapes`.  One-sided contacts in
    `open` do not act; `kinked`: a kink of V holds the others.  `open_sign`: `frequency` is real for
    some values of the parameters only; `shaped_where`: the shapes have a value there.  Where they
    are `damped`, the exponents of exp(s t) are -`decay` ± i `frequency`, or the real `exponents`.
    `pole`: the motion is one in Cartesian displacements at a pole.
    """

    at: Mapping[str, Expression]
    on: tuple[Expression, Expression] | None = None
    frequency: Expression | None
    frequency_squared: Expression | None
    shape: Mapping[str, Expression] | None
    more_shapes: tuple[Mapping[str, Expression], ...] = ()
    multiplicity: int = 1
    negative: bool = False
    damped: bool = False
    open: tuple[str, ...] = ()
    kinked: bool = False
    open_sign: bool = False
    shaped_where: tuple[Above, ...] = ()
    decay: Expression | None = None
    exponents: tuple[Expression, ...] = ()
    pole: Pole | None = None

    @property
    def is_open(self) -> bool:
        """Whether roots of it have no closed form."""
        if self.damped:
            return self.decay is None and len(self.exponents) < 2 * self.multiplicity
        return self.frequency is None and self.frequency_squared is None and not self.negative


@record(kw_only=True)
class ModesSection:
    """The normal modes; None where none was found, `reason` why there is none in either case.

    `complete`: they are those about all equilibria that are not unstable; `unshaped`: the real
    shapes of some were not found.
    """

    modes: tuple[ModesOfFrequency, ...] | None
    reason: str = ""
    complete: bool = True
    unshaped: bool = False


@record(kw_only=True)
class ReductionSection:
    """R = L - sum p q' without the cyclic coordinates; R is None with a `reason`.

    `momenta` are those of the cyclic coordinates, `reconstruction` their velocities, `when` says
    when those are constant that an impact changes.  `eliminated` were solved for by the
    constraints, `irreducible` do not occur in L and are kept.
    R = T_2 + sum `gyroscopic` q' - `effective_potential` where it is quadratic in q'; that is
    called by its `potential`: U_eff, or V_eff = V - T_0, or V, where no coordinate is cyclic.
    """

    momenta: Mapping[str, Expression]
    routhian: Expression | None
    equations: tuple[LagrangeEquation, ...] = ()
    constraints: Mapping[str, tuple[Expression, Expression]] = field(default_factory=dict)
    reconstruction: Mapping[str, Expression] = field(default_factory=dict)
    effective_potential: Expression | None = None
    potential: str = "U_eff"
    gyroscopic: Mapping[str, Expression] = field(default_factory=dict)
    gyroscopic_forces: bool = False
    gyroscopic_change: bool = False
    one_freedom: OneFreedom | None = None
    eliminated: tuple[str, ...] = ()
    irreducible: Mapping[str, Irreducible] = field(default_factory=dict)
    when: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""


@record(kw_only=True)
class ModelSection:
    """What a run that shows every coordinate keeps and drops, and why.

    `ignorable` ones are kept, though their momenta are conserved; `dropped` are the
    parameters without influence.  A reason is that of a coordinate, constraint or parameter.
    `kept` is None where there is no such model.
    """

    kept: tuple[str, ...] | None
    eliminated: Mapping[str, Expression] = field(default_factory=dict)
    ignorable: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
    reason: Mapping[str, str] = field(default_factory=dict)


UnitSource = Literal["given", "inferred", "undetermined"]


@record(kw_only=True)
class QuantityUnit:
    """The unit of one quantity; None where the file does not determine it."""

    unit: Unit | None
    source: UnitSource


@record(kw_only=True)
class DimensionsSection:
    """The unit of everything that has a name, and of the generalized force along each coordinate.

    Momenta and forces are by coordinate, multipliers by their own names, charges by the
    names of the file's symmetries.
    """

    units_given: bool
    coordinates: Mapping[str, QuantityUnit]
    parameters: Mapping[str, QuantityUnit]
    functions: Mapping[str, QuantityUnit]
    definitions: Mapping[str, QuantityUnit]
    energy: QuantityUnit
    momenta: Mapping[str, QuantityUnit]
    forces: Mapping[str, QuantityUnit]
    multipliers: Mapping[str, QuantityUnit]
    charges: Mapping[str, QuantityUnit]


#: The statement of a section: its own record of values and expressions.
Section = Any


@record(kw_only=True)
class Answers:
    """Everything one `lagcli solve` has to say of one file.

    `symbols` gives LaTeX for names whose file sets `symbol`; `multipliers` names those
    names that are multipliers (name -> constraint).  `complete` is False when an answer
    was requested and not found: exit status 1.  `absent` names sections that were requested
    and could not be made at all; `degrees_of_freedom` is None where the number could not be
    confirmed.  `where` holds the abbreviations that formulas use, in an
    order in which each uses only earlier ones; `named` the definitions of the file that are
    kept by their names.
    """

    title: str
    coordinates: tuple[str, ...]
    parameters: tuple[str, ...]
    degrees_of_freedom: int | None
    sections: Mapping[str, Section]
    symbols: Mapping[str, str] = field(default_factory=dict)
    multipliers: Mapping[str, str] = field(default_factory=dict)
    where: Mapping[str, Expression] = field(default_factory=dict)
    named: Mapping[str, Expression] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    complete: bool = True
    absent: tuple[str, ...] = ()
