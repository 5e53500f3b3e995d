"""Answers to develop and test against: a hoop with every section, and a hostile file."""

from __future__ import annotations

from fractions import Fraction

from lagcli.expression import (
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
)
from lagcli.statements.answers import (
    AccelerationsSection,
    AlgebraSection,
    Answers,
    CanonicalPair,
    CanonicalSection,
    Charge,
    ChargesSection,
    ConstraintForcesSection,
    DimensionsSection,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    Equilibrium,
    HamiltonianSection,
    LagrangeEquation,
    LagrangianSection,
    MatrixFormSection,
    ModelSection,
    ModesOfFrequency,
    ModesSection,
    MomentaSection,
    Multiplier,
    MultipliersSection,
    QuantityUnit,
    ReductionSection,
    SpecialValue,
    UnitSource,
)
from lagcli.statements.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.statements.motions import (
    Above,
    ActionPart,
    HamiltonJacobiSection,
    OneFreedom,
    PeriodSeries,
    SteadyMotion,
    SteadySection,
    Verdict,
)
from lagcli.statements.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    FailingBracket,
    GeneratingFunction,
    PoissonBracket,
    TransformationsSection,
)
from lagcli.statements.questions import FindSection, Range, Ranges, Rewritten, Solutions
from lagcli.units import Unit, read_unit


def unit_of(text: str | None, source: UnitSource | None = None) -> QuantityUnit:
    if text is None:
        return QuantityUnit(unit=None, source="undetermined")
    return QuantityUnit(unit=read_unit(text), source=source or "inferred")


ZERO, ONE, TWO = (Number(Fraction(n)) for n in (0, 1, 2))


def number(numerator: int, denominator: int = 1) -> Number:
    return Number(Fraction(numerator, denominator))


def times(*factors: Expression) -> Product:
    return Product(factors)


def plus(*terms: Expression) -> Sum:
    return Sum(terms)


def sin(x: Expression) -> Call:
    return Call("sin", (x,))


def square(x: Expression) -> Power:
    return Power(x, TWO)


M, R, g, ell, t, x = (Name(name) for name in "MRgltx")
theta, alpha = Name("theta"), Name("alpha")
p_x, p_theta, lam = Name("p_x"), Name("p_theta"), Name("lambda_rolling")
sine = sin(alpha)
dx, dtheta = Name("x", 1), Name("theta", 1)
kinetic_x = Quotient(times(M, square(dx)), TWO)
kinetic_theta = Quotient(times(M, square(R), square(dtheta)), TWO)
potential = times(M, g, plus(ell, Negative(x)), sine)
energy = plus(kinetic_x, kinetic_theta, potential)
hamiltonian = plus(
    Quotient(square(p_x), times(TWO, M)),
    Quotient(square(p_theta), times(TWO, M, square(R))),
    potential,
)
minus_half = Negative(Quotient(times(M, g, sine), TWO))
half_r = Quotient(times(M, R, g, sine), TWO)

HOOP = Answers(
    title="Hoop rolling without slipping down an incline",
    coordinates=("x", "theta"),
    parameters=("M", "R", "l", "alpha", "g"),
    degrees_of_freedom=1,
    multipliers={"lambda_rolling": "rolling"},
    sections={
        "lagrangian": LagrangianSection(
            lagrangian=plus(kinetic_x, kinetic_theta, Negative(potential))
        ),
        "equations": EquationsSection(
            equations=(
                LagrangeEquation(
                    coordinate="x",
                    left=plus(times(M, Name("x", 2)), Negative(times(M, g, sine))),
                    right=lam,
                ),
                LagrangeEquation(
                    coordinate="theta",
                    left=times(M, square(R), Name("theta", 2)),
                    right=Negative(times(R, lam)),
                ),
            ),
            constraints={"rolling": (plus(x, Negative(times(R, theta))), ZERO)},
        ),
        "matrix_form": MatrixFormSection(
            mass_matrix=((M, ZERO), (ZERO, times(M, square(R)))),
            constraint_jacobian=((ONE, Negative(R)),),
            forcing=(times(Name("s1"), sine), ZERO),
            constraint_bias=(ZERO,),
            shared={"s1": times(M, g)},
        ),
        "accelerations": AccelerationsSection(
            accelerations={
                "x": Quotient(times(g, sine), TWO),
                "theta": Quotient(times(g, sine), times(TWO, R)),
            },
            verified="exact",
        ),
        "multipliers": MultipliersSection(
            multipliers={
                "rolling": Multiplier(
                    symbol="lambda_rolling", value=minus_half, kind="holonomic", verified="exact"
                )
            }
        ),
        "constraint_forces": ConstraintForcesSection(
            forces={"rolling": {"x": minus_half, "theta": half_r}},
            total={"x": minus_half, "theta": half_r},
            on_points={"rolling": {"rim": (minus_half, ZERO)}},
        ),
        "forces": ForcesSection(
            forces=(
                PointForce(
                    constraint="rolling",
                    point="rim",
                    kind="friction",
                    force=minus_half,
                    direction=(Negative(ONE), ZERO),
                    towards="",
                    allowed=1,
                ),
                PointForce(
                    constraint="rod_1", point="rim", kind=None, force=None, direction=(ONE,)
                ),
            ),
            torques={"rolling": {"theta": half_r}, "gear": {"theta": ZERO}},
            friction_needed=(
                FrictionNeeded(
                    frictions=("rolling",), normal="incline", coefficient=Quotient(sine, TWO)
                ),
                FrictionNeeded(
                    frictions=("grip",), normal=None, coefficient=None, reason="there is none"
                ),
            ),
        ),
        "momenta": MomentaSection(
            momenta={"x": times(M, dx), "theta": times(M, square(R), dtheta)}, cyclic=("theta",)
        ),
        "energy": EnergySection(
            function=energy,
            conserved=True,
            is_total_energy=True,
            reason="Neither L nor the constraints depend on the time.",
        ),
        "hamiltonian": HamiltonianSection(hamiltonian=hamiltonian),
        "canonical_equations": CanonicalSection(
            equations={
                "x": CanonicalPair(q=Quotient(p_x, M), p=plus(times(M, g, sine), lam)),
                "theta": CanonicalPair(
                    q=Quotient(p_theta, times(M, square(R))), p=Negative(times(R, lam))
                ),
            }
        ),
        "brackets": BracketsSection(
            observables={"A": times(M, p_x)},
            brackets=(
                PoissonBracket(name="one", left=Name("x"), right=Name("A"), value=M),
                PoissonBracket(name="two", left=p_x, right=p_theta, value=M, named=Name("A")),
            ),
            rates={"A": times(M, g)},
        ),
        "canonical": TransformationsSection(
            transformations=(
                ExaminedTransformation(
                    name="scale",
                    variables={"X": times(M, Name("x")), "p_X": p_x},
                    kind="extended canonical",
                    valence=M,
                    verified="exact",
                    generator=GeneratingFunction(kind="F2", function=p_x, generates=True),
                    hamiltonian=times(M, g),
                    hamiltonian_verified="50 digits",
                ),
            )
        ),
        "charges": ChargesSection(
            charges=(
                Charge(
                    name="slide",
                    source="candidate",
                    transformation={"x": R, "theta": ONE},
                    gauge=times(M, R, g, t, sine),
                    conserved=True,
                    charge=plus(
                        times(M, R, dx),
                        times(M, square(R), dtheta),
                        Negative(times(M, R, g, t, sine)),
                    ),
                    rate=ZERO,
                    verified="exact",
                ),
                Charge(
                    name="spin",
                    source="candidate",
                    transformation={"theta": ONE},
                    gauge=ZERO,
                    conserved=False,
                    charge=times(M, square(R), dtheta),
                    rate=half_r,
                    verified="50 digits",
                    broken_by="the constraint force of 'rolling' along theta",
                ),
            )
        ),
        "discovered": ChargesSection(charges=()),
        "algebra": AlgebraSection(
            ansatz="coefficients of degree 1 in x, theta and t",
            dimension=5,
            name="h_1 + R",
            independent=2,
            in_involution=1,
            integrable=True,
            special=(
                SpecialValue(
                    parameter="M", value=half_r, number=7, degree=2, charges={"L_z": square(R)}
                ),
            ),
        ),
        "find": FindSection(
            answers={
                "lift_off": Solutions(unknown="theta", solutions=(Call("acos", (number(4, 7),)),)),
                "never": Solutions(unknown="x'", solutions=()),
                "tension": Rewritten(value=minus_half, subject=lam),
                "lost": Rewritten(value=None, note="The time allowed ran out."),
                "kept": Ranges(
                    unknown="l",
                    ranges=(
                        Range(upper=Negative(g), upper_included=False),
                        Range(lower=ZERO, upper=g, lower_included=False),
                        Range(lower=R, upper=R),
                    ),
                ),
                "any": Ranges(unknown="l", ranges=(Range(),)),
                "none": Ranges(unknown="l", ranges=()),
                "undecided": Ranges(unknown="l", ranges=None, note="it depends on R"),
            }
        ),
        "equilibria": EquilibriaSection(
            equilibria=(
                Equilibrium(
                    at={"theta": ZERO},
                    verdict=Verdict(stable=True, reason="{V} has a minimum", potential="V_eff"),
                    where=(Above(g, ZERO),),
                    free=("x",),
                ),
                Equilibrium(at={"theta": Name("pi")}, verdict=Verdict(stable=None)),
                Equilibrium(
                    at={"theta": Name("pi")},
                    verdict=Verdict(
                        stable=None,
                        minimum=(Above(g, R),),
                        spectrum=(Above(R, g), Above(R, ZERO)),
                        unstable=(Above(g, R), Above(ZERO, R)),
                        gyroscopic=True,
                    ),
                ),
                Equilibrium(
                    at={"theta": ZERO},
                    verdict=Verdict(
                        stable=None,
                        asymptotic=True,
                        hurwitz=(Above(g, R),),
                        theorem="Hurwitz",
                        reason="{V} may be fed",
                        potential="",
                    ),
                ),
            ),
            complete=False,
        ),
        "modes": ModesSection(
            modes=(
                ModesOfFrequency(
                    at={"theta": ZERO},
                    frequency=Call("sqrt", (Quotient(g, ell),)),
                    frequency_squared=Quotient(g, ell),
                    shape={"theta": ONE},
                    more_shapes=({"theta": M},),
                ),
                ModesOfFrequency(
                    at={"theta": Name("pi")},
                    frequency=None,
                    frequency_squared=Negative(Quotient(g, ell)),
                    shape=None,
                    multiplicity=2,
                ),
            )
        ),
        "reduction": ReductionSection(
            momenta={"x": times(M, Name("x", 1))},
            routhian=minus_half,
            equations=(LagrangeEquation(coordinate="theta", left=dtheta, right=ZERO),),
            reconstruction={"x": Quotient(Name("p_x"), M)},
            effective_potential=minus_half,
            gyroscopic={"theta": x},
            gyroscopic_forces=True,
            one_freedom=OneFreedom(
                coordinate="theta",
                constant="E",
                energy=minus_half,
                turning_points=(theta, Negative(theta)),
                rate=Call("sqrt", (Quotient(ell, g),)),
                periods=(
                    PeriodSeries(
                        at={"theta": ZERO},
                        amplitude="a",
                        period=times(TWO, Name("pi"), plus(ONE, square(Name("a")))),
                        order=2,
                        where=(Above(g, ZERO),),
                    ),
                    PeriodSeries(at={}, amplitude="", period=ONE, root_of=minus_half),
                ),
            ),
        ),
        "dimensions": DimensionsSection(
            units_given=True,
            coordinates={"x": unit_of("m", "given"), "theta": unit_of("rad", "given")},
            parameters={"M": unit_of("kg", "given"), "g": unit_of(None)},
            functions={"U": unit_of("J")},
            definitions={"s": unit_of("kg^(1/2) m")},
            energy=unit_of("J"),
            momenta={"x": unit_of("kg m/s"), "theta": unit_of("kg m^2/s")},
            forces={"x": unit_of("N"), "theta": unit_of("N m")},
            multipliers={"lambda_rolling": unit_of("V/(A m^2)")},
            charges={"slide": QuantityUnit(unit=Unit((), 1e-05), source="inferred")},
        ),
        "hamilton_jacobi": HamiltonJacobiSection(
            hamiltonian=minus_half,
            energy="E",
            separable=True,
            constants=("E", "p_x", "alpha_1"),
            equations={"theta": minus_half},
            derivatives={"x": p_x, "theta": Call("sqrt", (plus(ell, Negative(g)),))},
            cases={
                "theta": (
                    ActionPart(minus_half, (Above(ZERO, g),)),
                    ActionPart(ell, (Above(g, ZERO), Above(ell, R))),
                )
            },
        ),
        "steady_motions": SteadySection(
            conditions={"theta": minus_half},
            motions=(
                SteadyMotion(
                    at={"theta": ZERO},
                    free=("x'",),
                    rates={"x": dx, "z": Quotient(g, R)},
                    momenta={"x": times(M, dx)},
                    where=(Above(g, ZERO),),
                    mirrored=True,
                    verdict=Verdict(
                        stable=None,
                        potential="U_eff",
                        minimum=(Above(g, R),),
                        spectrum=(Above(x, ZERO), Above(square(x), g)),
                        unstable=(Above(ZERO, x),),
                    ),
                    frequencies_squared=(minus_half,),
                    mass=((ONE, ZERO), (ZERO, ONE)),
                    velocity=((ZERO, Negative(x)), (x, ZERO)),
                    stiffness=((g, ZERO), (ZERO, g)),
                ),
                SteadyMotion(
                    at={"theta": Name("pi")},
                    free=(),
                    rates=None,
                    momenta={"x": Name("p_x")},
                    where=(),
                    mirrored=False,
                    verdict=Verdict(stable=False, reason="neutral"),
                    frequencies_squared=(),
                ),
            ),
            complete=False,
        ),
        "model": ModelSection(
            kept=("x",),
            eliminated={"theta": Quotient(x, R)},
            ignorable=("x",),
            dropped=("l",),
            reason={"theta": "the constraint rolling gives it", "l": "nothing depends on it"},
        ),
    },
)

ugly = Name("длина_волны")
tower = square(plus(Negative(x), square(plus(ugly, Negative(Negative(theta))))))
long_sum = plus(
    *(
        times(Name(f"mass_{i}"), sin(plus(Name(f"theta_{i}"), Negative(Name(f"φ_{i}")))), square(x))
        for i in range(14)
    )
)
HOSTILE = Answers(
    title="\x1b[31mred\x1b[0m \\input{/etc/passwd} $x_1^2$ <b>&amp;</b> 100% #1 ~ {}`|* "
    "\u202eевил 中文 θ é",
    coordinates=("theta_1", "phase", "длина_волны"),
    parameters=("omega_max", "m12", "varphi", "φ", "ϕ", "t_"),
    degrees_of_freedom=12,
    multipliers={"lambda_rod_1": "rod_1"},
    warnings=("`m12` was not found: time ran out <script>", "second"),
    complete=False,
    sections={
        "lagrangian": LagrangianSection(lagrangian=Quotient(long_sum, times(TWO, tower))),
        "equations": EquationsSection(
            equations=(
                LagrangeEquation(coordinate="phase", left=long_sum, right=Negative(long_sum)),
                LagrangeEquation(
                    coordinate="theta_1",
                    left=Quotient(x, plus(long_sum, ONE)),
                    right=Power(plus(x, Negative(ONE)), Quotient(long_sum, Name("phase", 2))),
                ),
                LagrangeEquation(
                    coordinate="x",
                    left=PartialCall("Phi", (1, 2), (x, Power(theta, number(1, 2)))),
                    right=Diff(plus(Call("U", (x,), 2), Negative(Negative(x))), theta),
                ),
            ),
        ),
        "matrix_form": MatrixFormSection(
            mass_matrix=((long_sum, ZERO), (ZERO, times(tower, number(1, 2)))),
            constraint_jacobian=(),
            forcing=(long_sum, Call("abs", (Call("log", (x,)),))),
            constraint_bias=(),
        ),
        "accelerations": AccelerationsSection(
            accelerations=None, regular=False, degenerate=("phase",)
        ),
        "multipliers": MultipliersSection(
            multipliers={
                "rod_1": Multiplier(symbol="lambda_rod_1", value=None, kind="nonholonomic")
            },
            redundant=("rod_1",),
        ),
        "constraint_forces": ConstraintForcesSection(forces={"rod_1": None}, total=None),
        "forces": ForcesSection(forces=None, reason="x_1 <&> $100%$"),
        "energy": EnergySection(
            function=Call("sqrt", (long_sum,)),
            conserved=None,
            is_total_energy=None,
            reason="x_1 & 100% undecided",
        ),
        "hamiltonian": HamiltonianSection(hamiltonian=None, reason="p_x' = {x} is cubic"),
        "canonical_equations": CanonicalSection(equations=None, reason="no Hamiltonian"),
        "brackets": BracketsSection(
            observables={},
            brackets=(
                PoissonBracket(name="x_1 <&>", left=long_sum, right=long_sum, value=None),
                PoissonBracket(name="%", left=long_sum, right=long_sum, value=long_sum),
            ),
            rates=None,
            reason="x_1 <&> 100%",
        ),
        "canonical": TransformationsSection(
            transformations=(
                ExaminedTransformation(
                    name="x_1 <&> 100%",
                    variables={"длина_волны": long_sum},
                    kind="not canonical",
                    valence=None,
                    verified=None,
                    failing=(
                        FailingBracket(
                            left="theta_1", right="phase", value=long_sum, expected=long_sum
                        ),
                    ),
                    generator=GeneratingFunction(
                        kind="F1",
                        function=long_sum,
                        generates=False,
                        failing=((long_sum, long_sum),),
                    ),
                    reason="x_1 <&> 100%",
                ),
            )
        ),
        "equilibria": EquilibriaSection(equilibria=None, reason="x_1 <&> 100%"),
        "modes": ModesSection(modes=None, reason="x_1 <&> 100%"),
        "hamilton_jacobi": HamiltonJacobiSection(
            hamiltonian=long_sum,
            energy="E",
            separable=False,
            obstacle=("theta_1", "длина_волны"),
            reason="x_1 <&> 100%",
        ),
        "steady_motions": SteadySection(conditions={}, motions=None, reason="x_1 <&> 100%"),
        "reduction": ReductionSection(
            momenta={"phase": long_sum}, routhian=None, reason="x_1 & 100% <undecided>"
        ),
    },
)
