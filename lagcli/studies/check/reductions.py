"""What is expected of the reduction against what was derived."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.algebra.positivity import deciding
from lagcli.expression import Equation, Expression, Name
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.verify import conjunction, disjunction
from lagcli.problem_data import (
    ExpectEquilibrium,
    ExpectHamiltonJacobi,
    ExpectReduction,
    ExpectSteady,
    Inequality,
)
from lagcli.statements.answers import EquilibriaSection, Equilibrium, ReductionSection
from lagcli.statements.motions import (
    Above,
    HamiltonJacobiSection,
    SteadyMotion,
    SteadySection,
    Verdict,
)
from lagcli.studies.check.findings import Judged
from lagcli.studies.check.regions import same_region

if TYPE_CHECKING:
    from lagcli.studies.check.expectations import Expectations


def reduction(
    check: Expectations, section: ReductionSection, expect: ExpectReduction
) -> Iterator[Judged]:
    """Every expectation of the section with its verdict."""
    motion = section.one_freedom
    pairs: list[tuple[str, Expression | None, Expression | None]] = [
        ("routhian", section.routhian, expect.routhian),
        ("effective_potential", section.effective_potential, expect.effective_potential),
    ]
    for name, formula in expect.reconstruction.items():
        pairs.append(("reconstruction", section.reconstruction.get(name), formula))
    for name, found, expected in pairs:
        if expected is not None:
            verdict = None if found is None else check.reduced.equal(found, expected)
            yield ["reduction", name], verdict, to_grammar(expected), _shown(found)
    if expect.turning_points is not None:
        roots = None if motion is None else motion.turning_points
        verdict = None if roots is None else check.reduced.same_set(roots, expect.turning_points)
        path = ["reduction", "turning_points"]
        yield path, verdict, _listed(expect.turning_points), _listed(roots)
    if expect.period is not None:
        periods = [] if motion is None else [each.period for each in motion.periods]
        verdicts = [check.reduced.equal(each, expect.period) for each in periods]
        verdict = disjunction(verdicts)
        yield ["reduction", "period"], verdict, to_grammar(expect.period), _listed(periods)


def equilibria(
    check: Expectations, section: EquilibriaSection, expected: Sequence[ExpectEquilibrium]
) -> Iterator[Judged]:
    """Every expectation of the section with its verdict."""
    for place, each in enumerate(expected):
        verdicts = [_same_equilibrium(check, state, each) for state in section.equilibria or ()]
        open_ = None in verdicts or section.equilibria is None or not section.complete
        verdict = True if True in verdicts else None if open_ else False
        path = ["equilibria", str(place)]
        yield path, verdict, f"equilibrium {place + 1}", "none that is the same"


def _same_equilibrium(
    check: Expectations, found: Equilibrium, expected: ExpectEquilibrium
) -> bool | None:
    verdicts: list[bool | None] = [
        name in found.at and check.reduced.equal(found.at[name], formula)
        for name, formula in expected.at.items()
    ]
    if expected.on is not None:
        verdicts.append(_same_family(check, found, expected.on))
    if isinstance(expected.stable, tuple):
        if False not in verdicts:
            given = _conditions(found.verdict)
            verdicts.append(_same_conditions(check, given, expected.stable))
    elif expected.stable is not None:
        verdicts.append(_same_stability(found.verdict.stable, expected.stable))
    return conjunction(verdicts)


def _same_family(check: Expectations, found: Equilibrium, expected: Equation) -> bool | None:
    """Whether f = 0 and g = 0 differ by a constant factor: f dg = g df along every q."""
    if found.on is None:
        return False
    build = check.reduced.build
    f, g = (build(a) - build(b) for a, b in (found.on, (expected.left, expected.right)))
    return conjunction(
        [check.reduced.vanishes(f * g.diff(q) - g * f.diff(q)) for q in check.derivation.system.q]
    )


def steady_motions(
    check: Expectations, section: SteadySection, expected: Sequence[ExpectSteady]
) -> Iterator[Judged]:
    """Every expectation of the section with its verdict."""
    motions = section.motions
    for place, each in enumerate(expected):
        verdicts = [_same_motion(check, motion, each) for motion in motions or ()]
        verdict = None if motions is None else disjunction(verdicts)
        path = ["steady_motions", str(place)]
        yield path, verdict, f"steady motion {place + 1}", "none that is the same"


def _same_motion(check: Expectations, found: SteadyMotion, expected: ExpectSteady) -> bool | None:
    verdicts: list[bool | None] = []
    for answers, wanted in (
        (found.at, expected.at),
        (found.rates or {}, expected.rates),
        (found.momenta, expected.momenta),
    ):
        for name, formula in wanted.items():
            answer = answers.get(name)
            verdicts.append(answer is not None and check.reduced.equal(answer, formula))
    if False in verdicts:
        return False
    if expected.frequencies_squared is not None:
        squares = found.frequencies_squared
        verdicts.append(check.reduced.same_set(squares, expected.frequencies_squared))
    if isinstance(expected.stable, tuple):
        verdicts.append(_same_conditions(check, _conditions(found.verdict), expected.stable))
    elif expected.stable is not None:
        verdicts.append(_same_stability(found.verdict.stable, expected.stable))
    return conjunction(verdicts)


def hamilton_jacobi(
    check: Expectations, section: HamiltonJacobiSection, expect: ExpectHamiltonJacobi
) -> Iterator[Judged]:
    """Every expectation of the section with its verdict."""
    if expect.separable is not None:
        found = section.separable
        verdict = None if found is None else found is expect.separable
        words = {True: "yes", False: "no", None: "not decided"}
        yield ["hamilton_jacobi", "separable"], verdict, words[expect.separable], words[found]
    for name, expected in expect.derivatives.items():
        derivative = (section.derivatives or {}).get(name)
        verdict = None
        if derivative is not None:
            build = check.reduced.build
            verdict = check.reduced.vanishes(build(derivative) ** 2 - build(expected) ** 2)
        path = ["hamilton_jacobi", "derivatives", name]
        yield path, verdict, to_grammar(expected), _shown(derivative)
    for name, expected in expect.functions.items():
        forms = [each.function for each in section.cases.get(name, ())]
        forms += [section.functions[name]] if name in section.functions else []
        verdicts = [_same_derivative(check, each, expected, name) for each in forms]
        verdict = disjunction(verdicts) if forms else None
        path = ["hamilton_jacobi", "functions", name]
        yield path, verdict, to_grammar(expected), _listed(forms)


def _same_derivative(check: Expectations, a: Expression, b: Expression, name: str) -> bool | None:
    """Whether a and b are the same but for a constant and the sign."""
    x = check.reduced.build(Name(name))
    # log|z| and log z have the same derivative
    one, other = (
        check.reduced.build(each).replace(sympy.Abs, lambda z: z).diff(x) for each in (a, b)
    )
    return check.reduced.vanishes(one**2 - other**2)


def _same_conditions(
    check: Expectations, given: Sequence[tuple[Above, ...] | None], expected: tuple[Inequality, ...]
) -> bool:
    """Whether one of the lists asks for the same, factors that are positive aside."""
    build = check.reduced.build
    wanted = [build(a) - build(b) for a, b in map(_positive, expected)]
    for conditions in given:
        derived = [build(each.left) - build(each.right) for each in conditions or ()]
        if len(derived) == len(wanted) and all(
            any(_same_sign(a, b) for b in derived) for a in wanted
        ):
            return True
        if derived and same_region(derived, wanted):
            return True
    return False


def _conditions(verdict: Verdict) -> tuple[tuple[Above, ...] | None, ...]:
    return verdict.minimum, verdict.hurwitz, verdict.spectrum


def _same_sign(a: Expr, b: Expr) -> bool:
    """Whether a is b times a positive number, after factors of known sign are left out."""
    ratio = simplify(deciding(a) / deciding(b))
    return bool(ratio.is_number and ratio.is_positive)


def _positive(inequality: Inequality) -> tuple[Expression, Expression]:
    """(greater, less)."""
    pair = inequality.left, inequality.right
    return pair if inequality.comparison == ">" else (pair[1], pair[0])


def _same_stability(found: bool | None, expected: bool) -> bool | None:
    """Undecided where the stability is; a stability under conditions is neither."""
    return None if found is None else found is expected


def _shown(found: Expression | None) -> str:
    return "nothing" if found is None else to_grammar(found)


def _listed(found: Sequence[Expression] | None) -> str:
    return ", ".join(map(to_grammar, found or ())) or "nothing"
