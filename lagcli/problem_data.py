"""A problem as the file states it: frozen, plain, checked, and free of algebra."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal

from lagcli.diagnostics import NOWHERE, Source, Span
from lagcli.expression import Equation, Expression, Name, Negative, Number, Product, sum_of
from lagcli.platform.rooms import modules_in
from lagcli.record import field, record, replace

Assumption = Literal["real", "positive", "nonnegative", "nonzero", "negative"]
Comparison = Literal[">=", "<=", ">", "<"]
OnLoss = Literal["stop", "release"]
ForceKind = Literal["normal", "friction", "tension"]


@record(kw_only=True)
class Quantity:
    """A named real quantity and what the file says of it."""

    name: str
    assume: Assumption = "real"
    unit: str | None = None  # already checked to be one
    symbol: str | None = None  # LaTeX, already checked to be harmless
    description: str | None = None
    span: Span = field(default=NOWHERE, compare=False)
    unit_span: Span = field(default=NOWHERE, compare=False)

    def allows(self, value: Any) -> bool:
        """Whether a number is what the quantity is said to be."""
        return not _BREAKS[self.assume](value)


@record(kw_only=True)
class Coordinate(Quantity):
    """A generalized coordinate q; its velocity is written q', its acceleration q''."""


#: The values that break what is said of a quantity.
_BREAKS: dict[str, Callable[[Any], bool]] = {
    "positive": lambda value: value <= 0,
    "nonnegative": lambda value: value < 0,
    "nonzero": lambda value: value == 0,
    "negative": lambda value: value >= 0,
    "real": lambda _: False,
}


@record(kw_only=True)
class Parameter(Quantity):
    """A constant; `value` may use other parameters (earlier or later, no cycle)."""

    integer: bool = False
    value: Expression | None = None

    def mistake_of(self, value: Fraction | float) -> str | None:
        """The mistake where the value is not what the parameter is said to be, else None."""
        if not self.allows(value):
            return f"'{self.name}' is {self.assume}, and its value is not"
        if self.integer and value != int(value):
            return f"'{self.name}' is an integer, and its value is not"
        return None


@record(kw_only=True)
class Point:
    """A particle: 1 to 3 Cartesian components, its mass, the applied force on it."""

    name: str
    position: tuple[Expression, ...]
    mass: Expression | None = None
    force: tuple[Expression, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Scenery:
    """What a picture shows beside the points; it has no influence on the motion.

    `places` are more points, without mass; `rods` and `springs` join two names; `trails` are
    the points that leave one, None for all.
    """

    places: Mapping[str, tuple[Expression, ...]] = field(default_factory=dict)
    rods: tuple[tuple[str, str], ...] = ()
    springs: tuple[tuple[str, str], ...] = ()
    trails: tuple[str, ...] | None = None


@record(kw_only=True)
class Inequality:
    """`left comparison right`, such as `N >= 0`."""

    left: Expression
    comparison: Comparison
    right: Expression
    span: Span = field(default=NOWHERE, compare=False)

    @property
    def larger_first(self) -> tuple[Expression, Expression]:
        """The side that is to be the larger one, and the other."""
        rises = self.comparison[0] == ">"
        return (self.left, self.right) if rises else (self.right, self.left)


@record(kw_only=True)
class Constraint:
    """f = left - right = 0, holonomic f(q, t) or linear in the velocities."""

    name: str
    equation: Equation
    multiplier: str  # the multiplier's name, `lambda_<name>` by default
    holds_while: Inequality | None = None
    on_loss: OnLoss = "stop"  # what a numerical run does where holds_while fails
    restitution: Expression | None = None  # of the impact that closes it again; None: stop
    acts_as: ForceKind | None = None  # what its force is called
    span: Span = field(default=NOWHERE, compare=False)


def pushing_sign(multiplier: str, condition: Inequality) -> int | None:
    """1 for `N >= 0`, -1 for `N <= 0`, None for any other condition than on its multiplier.

    A force N df/dq with N >= 0 pushes towards f > 0: there the contact is open.
    """
    left, right = condition.left, condition.right
    sign = 1 if condition.comparison[0] == ">" else -1
    if isinstance(left, Number):
        left, right, sign = right, left, -sign
    if isinstance(left, Negative):
        left, sign = left.operand, -sign
    simple = isinstance(left, Name) and left.name == multiplier and not left.primes
    return sign if simple and isinstance(right, Number) and right.value == 0 else None


@record(kw_only=True)
class Contact:
    """What a body may touch and leave: no constraint, it acts while it is closed.

    The gap is left - right of the equation, a function of q and t: positive where it is open.
    """

    name: str
    equation: Equation
    multiplier: str  # >= 0 while it is closed
    restitution: Expression | None = None  # Newton's; None: the run stops where it closes
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Symmetry:
    """A candidate: Delta q of the coordinates named (0 for the others) and Delta t."""

    name: str
    changes: Mapping[str, Expression]  # coordinate -> Delta q
    time: Expression | None = None  # Delta t; None is 0
    gauge: Expression | None = None  # None: to be found
    span: Span = field(default=NOWHERE, compare=False)


GeneratingKind = Literal["F1", "F2", "F3", "F4"]


@record(kw_only=True)
class CanonicalTransformation:
    """New coordinates Q and, by the same names, their momenta `p_Q`, in q, p and t."""

    name: str
    coordinates: Mapping[str, Expression]
    momenta: Mapping[str, Expression]
    kind: GeneratingKind = "F1"  # of the function below
    generating: Expression | None = None
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class BracketQuestion:
    """`{left, right}` of functions of q, p, t, of observables and of charges by name."""

    name: str
    left: Expression
    right: Expression
    span: Span = field(default=NOWHERE, compare=False)


#: sum q' dL/dq' - L, whatever the file calls `energy`: no name of a file has blanks.
JACOBI_FUNCTION = Name("the energy function")


def charge_of(symmetry: Symmetry) -> Expression:
    """p Delta q - h Delta t - gauge, in momenta `p_x` and the energy function h.

    A gauge that the file leaves out is not in it.
    """
    terms: list[Expression] = [
        Product((Name(f"p_{name}"), change)) for name, change in symmetry.changes.items()
    ]
    if symmetry.time is not None:
        terms.append(Negative(Product((JACOBI_FUNCTION, symmetry.time))))
    if symmetry.gauge is not None:
        terms.append(Negative(symmetry.gauge))
    return sum_of(terms)


@record(kw_only=True)
class Where:
    """`{where: left = right, for: unknown}`."""

    name: str
    equation: Equation
    unknown: Name  # a coordinate, a velocity (one prime) or a parameter
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Rewrite:
    """`{value: expression, in_terms_of: [names]}`."""

    name: str
    value: Expression
    in_terms_of: tuple[Name, ...]
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Lasting:
    """`{always: left >= right, for: unknown}`: the values with which it holds all the time."""

    name: str
    condition: Inequality
    unknown: Name  # a parameter
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Reaching:
    """`{reaches: coordinate = value, for: unknown}`: the values with which it comes there."""

    name: str
    coordinate: Name
    value: Expression
    unknown: Name  # a parameter
    span: Span = field(default=NOWHERE, compare=False)


Question = Where | Rewrite | Lasting | Reaching


#: How a motion may be integrated: `auto`, or by a method, each of which is a module.
METHODS = ("auto", *modules_in(Path(__file__).parent / "numerics" / "certified" / "methods"))


@record(kw_only=True)
class SimulationDefaults:
    """Defaults of the numerical run; numbers are expressions without names."""

    until: Expression | None = None
    accuracy: Expression | None = None
    method: str | None = None


NOT_CONSERVED = "not conserved"


@record
class Known:
    """The value of an expression along the motion, and how the file calls it."""

    name: str
    column: Expression
    value: Expression


@record(kw_only=True)
class KnownRow:
    """What is known at one time, or just before one event."""

    t: Expression | None
    event: str | None = None  # the name of a contact or constraint
    what: str | None = None  # what happens to it
    values: tuple[Known, ...] = ()
    span: Span = field(default=NOWHERE, compare=False)


@record(kw_only=True)
class Trajectory:
    """What is known of the motion from `initial`."""

    formulas: tuple[Known, ...] = ()  # of t and the parameters, at all times
    rows: tuple[KnownRow, ...] = ()  # values at times
    events: tuple[KnownRow, ...] = ()  # the first ones, in their order
    until: Expression | None = None  # the end; that of `simulation` otherwise
    tolerance: Expression | None = None  # of every number; 1e-9 otherwise
    rigorous: bool = False  # whether the run is to be proved


@record(kw_only=True)
class ExpectReduction:
    """What is known of the Routhian, and of the one degree of freedom that is left."""

    routhian: Expression | None = None
    effective_potential: Expression | None = None
    reconstruction: Mapping[str, Expression] = field(default_factory=dict)
    turning_points: tuple[Expression, ...] | None = None
    period: Expression | None = None  # about one of the minima


@record(kw_only=True)
class ExpectSteady:
    """What is known of one steady motion; `stable` where: all of these inequalities."""

    at: Mapping[str, Expression] = field(default_factory=dict)
    rates: Mapping[str, Expression] = field(default_factory=dict)
    momenta: Mapping[str, Expression] = field(default_factory=dict)
    frequencies_squared: tuple[Expression, ...] | None = None
    stable: bool | tuple[Inequality, ...] | None = None


@record(kw_only=True)
class ExpectEquilibrium:
    """What is known of one state of rest, or of all `on` a line; `stable` where: all of these."""

    at: Mapping[str, Expression] = field(default_factory=dict)
    on: Equation | None = None
    stable: bool | tuple[Inequality, ...] | None = None


@record(kw_only=True)
class ExpectHamiltonJacobi:
    """Whether the variables separate, and W' and W by coordinate, up to sign and a constant."""

    separable: bool | None = None
    derivatives: Mapping[str, Expression] = field(default_factory=dict)
    functions: Mapping[str, Expression] = field(default_factory=dict)


@record(kw_only=True)
class ExpectSpecial:
    """A relation of the parameters, how many charges there are with it, and some new ones."""

    where: Equation | None = None
    charges: int | None = None
    discovered: Mapping[str, Expression] = field(default_factory=dict)


@record(kw_only=True)
class ExpectAlgebra:
    """What is known of the discovered symmetries; `special`: all special values."""

    dimension: int | None = None
    name: str | None = None
    independent: int | None = None
    in_involution: int | None = None
    integrable: bool | None = None
    special: tuple[ExpectSpecial, ...] | None = None


CanonicalKind = Literal["canonical", "extended canonical", "not canonical"]


@record(kw_only=True)
class ExpectCanonical:
    """What is known of one transformation; `generates`: whether its function does."""

    kind: CanonicalKind | None = None
    valence: Expression | None = None
    generates: bool | None = None
    hamiltonian: Expression | None = None


@record(kw_only=True)
class Expect:
    """The known answers, as the file gives them; None or empty: nothing expected."""

    degrees_of_freedom: int | None = None
    equations: tuple[Equation, ...] = ()
    accelerations: Mapping[str, Expression] = field(default_factory=dict)
    multipliers: Mapping[str, Expression] = field(default_factory=dict)  # by constraint name
    constraint_forces: Mapping[str, Mapping[str, Expression]] = field(default_factory=dict)
    #: constraint -> point -> the signed force, or its Cartesian components
    forces: Mapping[str, Mapping[str, Expression | tuple[Expression, ...]]] = field(
        default_factory=dict
    )
    friction_needed: Mapping[str, Expression] = field(default_factory=dict)  # by normal force
    momenta: Mapping[str, Expression] = field(default_factory=dict)
    hamiltonian: Expression | None = None
    energy: Expression | None = None
    charges: Mapping[str, Expression | Literal["not conserved"]] = field(default_factory=dict)
    discovered: Mapping[str, Expression | Literal["not conserved"]] = field(default_factory=dict)
    algebra: ExpectAlgebra | None = None
    equilibria: tuple[ExpectEquilibrium, ...] = ()
    modes: tuple[Expression, ...] | None = None  # angular frequencies
    find: Mapping[str, tuple[Expression, ...]] = field(default_factory=dict)
    #: answers that are ranges: each by its bounds
    ranges: Mapping[str, tuple[tuple[Inequality, ...], ...]] = field(default_factory=dict)
    reduction: ExpectReduction | None = None
    steady_motions: tuple[ExpectSteady, ...] = ()
    hamilton_jacobi: ExpectHamiltonJacobi | None = None
    brackets: Mapping[str, Expression] = field(default_factory=dict)
    canonical: Mapping[str, ExpectCanonical] = field(default_factory=dict)
    trajectory: Trajectory | None = None
    others: Mapping[str, Any] = field(default_factory=dict)  # by the keys of any other section
    spans: Mapping[tuple[str, ...], Span] = field(default_factory=dict, compare=False)
    #: place of each expectation: ("accelerations", "x"), ("equations", "0"), …

    def of(self, key: str) -> Any:
        """What is expected under a key."""
        return self.others[key] if key in self.others else getattr(self, key, None)

    def span(self, path: Sequence[str]) -> Span:
        """The place of an expectation, or of the nearest thing around it."""
        around = (self.spans.get(tuple(path[:length])) for length in range(len(path), 0, -1))
        return next((span for span in around if span is not None), NOWHERE)


@record(kw_only=True)
class Problem:
    """A checked problem: every name is known, every expression well formed.

    Either `lagrangian` is given, or `hamiltonian`, or `kinetic` (None: the sum over `points`)
    and `potential` (None: 0).  A derivation adds the `lagrangian` that follows from a
    `hamiltonian`.  Maps keep the order of the file.
    """

    source: Source
    title: str
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...] = ()
    reference: str | None = None  # the key `source` of the file
    description: str | None = None
    functions: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    definitions: Mapping[str, Expression] = field(default_factory=dict)
    named: Mapping[str, Expression] = field(default_factory=dict)  # parameters that are definitions
    points: tuple[Point, ...] = ()
    kinetic: Expression | None = None
    potential: Expression | None = None
    lagrangian: Expression | None = None
    hamiltonian: Expression | None = None  # of q, t and momenta `p_x`
    forces: Mapping[str, Expression] = field(default_factory=dict)
    dissipation: Expression | None = None
    constraints: tuple[Constraint, ...] = ()
    contacts: tuple[Contact, ...] = ()
    symmetries: tuple[Symmetry, ...] = ()
    observables: Mapping[str, Expression] = field(default_factory=dict)
    brackets: tuple[BracketQuestion, ...] = ()
    canonical_transformations: tuple[CanonicalTransformation, ...] = ()
    initial: Mapping[Name, Expression] = field(default_factory=dict)  # Name("x", primes=0 or 1)
    find: tuple[Question, ...] = ()
    simulation: SimulationDefaults = field(default_factory=SimulationDefaults)
    picture: Scenery = field(default_factory=Scenery)
    expect: Expect = field(default_factory=Expect)

    def __repr__(self) -> str:
        names = ", ".join(each.name for each in self.coordinates)
        return f"<Problem {self.title!r} with the coordinates {names}>"

    def with_values(self, values: Mapping[str, Expression]) -> Problem:
        """The problem with other values of some parameters."""
        changed = (replace(p, value=values.get(p.name, p.value)) for p in self.parameters)
        return replace(self, parameters=tuple(changed))

    @property
    def formulas(self) -> tuple[Expression, ...]:
        """The energies, the definitions and the positions of the points."""
        energies = (self.kinetic, self.potential, self.lagrangian, self.hamiltonian)
        places = (axis for point in self.points for axis in point.position)
        given = (formula for formula in energies if formula is not None)
        return (*given, *self.definitions.values(), *places)

    @property
    def bare(self) -> Problem:
        """The problem without candidates, questions, initial state and expectations."""
        return replace(self, find=(), symmetries=(), initial={}, expect=Expect())
