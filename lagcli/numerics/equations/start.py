"""The state at t = 0: what the file gives, what the constraints add, else 0.

The positions come first, from f(q, 0) = 0, then the velocities, from A q' + b = 0, as in
`lagcli.mechanics.initial`, here in numbers.  A state off the constraints is refused, with
the nearest one that is on them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import partial as partial_call
from itertools import starmap
from math import factorial
from typing import Any

from lagcli.diagnostics import NOWHERE, Diagnostic, Span
from lagcli.expression import Expression, Name
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Constant, Node, Symbol, mask_of
from lagcli.numerics.equations.arithmetic import Doubles, UndefinedFunction
from lagcli.numerics.equations.assembly import assemblies
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.determined import determined
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.polynomial import real_roots
from lagcli.numerics.equations.refusal import Refusal, reason_of
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.numerics.equations.surface import Surface
from lagcli.problem_data import Coordinate, Problem

#: What a file gives of the state at t = 0.
Initial = Mapping[Name, Expression]

#: A given state may miss the constraints by so much, relative to their terms.
_ON_SURFACE = 1e-12
_HIGHEST_DEGREE = 6
_ROUNDS = 30
#: Zero satisfies an equation whose residual is rounding of terms of the size of 1.
_ZERO = 1e-14
#: Of several states this many are listed.
_LISTED = 8


def given_values(motion: Motion, initial: Initial) -> dict[Symbol, Any]:
    """What the file gives."""
    graph, read = motion.equations.graph, motion.equations.form.read
    nodes = [read(value) for value in initial.values()]
    try:
        values = straight_line((), nodes, motion.constants, motion.arithmetic)()
        finite = all(abs(value) < float("inf") for value in values)
    except (ArithmeticError, ValueError):
        finite = False
    if not finite:
        raise Refusal("the initial state is not a real number")
    names = [graph.symbol(name.name, name.primes) for name in initial]
    return dict(zip(names, values, strict=True))


def initial_state(
    motion: Motion, initial: Initial, *, project: bool = False
) -> tuple[list[float], list[float]]:
    """q and q' at t = 0 in doubles.

    Parameters
    ----------
    motion
        In doubles.
    initial
        What the file gives.
    project
        Take the nearest state on the constraints for one that is off.

    Raises
    ------
    Refusal
        When the state is off the constraints, or they leave several.
    """
    return _Completion(motion, initial).state(project=project)


def completed_state(problem: Problem) -> dict[str, float]:
    """The state at t = 0 in doubles by name, with the parts that the file leaves out.

    Raises
    ------
    Refusal
        As `initial_state`, or when a parameter that is needed has no value.
    """
    e = EquationsOfMotion(with_contacts(problem))
    if problem.contacts:
        e = e.holding(frozenset(range(len(problem.constraints))))
    entries = [entry for row in (*e.mass, *e.rows) for entry in row]
    given = map(e.form.read, problem.initial.values())
    needed = [*entries, *e.bias, *e.positions, *e.rates, *given]
    motion = Motion(e, constants_of(e, needed, Doubles()), Doubles())
    q, v = initial_state(motion, problem.initial)
    names = [each.name for each in problem.coordinates]
    return dict(zip([*names, *(f"{name}'" for name in names)], [*q, *v], strict=True))


def refined_state(
    motion: Motion,
    surface: Surface | None,
    q: Sequence[float],
    v: Sequence[float],
    anew: Initial,
) -> tuple[list[Any], list[Any]]:
    """The same state in the numbers of another motion, what is given worked out `anew`.

    Raises
    ------
    Refusal
        Where balls cannot solve the constraints.
    """
    equations, number = motion.equations, motion.arithmetic.number
    given = given_values(motion, anew) if anew else {}
    exact = [
        given.get(symbol, number(Fraction(value)))
        for symbol, value in zip((*equations.q, *equations.qdot), (*q, *v), strict=True)
    ]
    q, v = exact[: motion.n], exact[motion.n :]
    if surface is None:
        return q, v
    surface.measure(0.0, q, v)
    for _ in range(3):
        q, v = surface.project(0.0, q, v)
    if not all(x.is_finite() for x in (*q, *v)):
        message = "the constraints are dependent at the initial state: only doubles decide which"
        raise Refusal(message, mistake=False)
    return q, v


def rounded_components(
    motion: Motion, initial: Initial, q: Sequence[float], v: Sequence[float]
) -> list[bool]:
    """Which components of the initial state are not exactly the doubles that stand for them."""
    equations = motion.equations
    graph, read = equations.graph, equations.form.read
    exact: dict[Symbol, bool] = {}
    for name, formula in initial.items():
        node = read(formula)
        known = isinstance(node, Constant) and Fraction(float(node.value)) == node.value
        exact[graph.symbol(name.name, name.primes)] = known
    symbols = zip((*equations.q, *equations.qdot), (*q, *v), strict=True)
    return [bool(value) and not exact.get(symbol, False) for symbol, value in symbols]


class OffConstraints(Refusal):
    """What the file gives at t = 0 is not on the constraints.

    Attributes
    ----------
    nearest : mapping of str to float
        The state on them next to it; empty where there is none.
    """

    def __init__(self, diagnostics: tuple[Diagnostic, ...], nearest: Mapping[str, float]) -> None:
        super().__init__(diagnostics)
        self.nearest = nearest


class _Completion:
    """Fills in what the file leaves out, equation by equation, and then by several together."""

    def __init__(self, motion: Motion, initial: Initial) -> None:
        self.motion, self.initial = motion, initial
        self.equations = motion.equations
        self.values: dict[Symbol, float] = given_values(motion, initial)

    def state(self, *, project: bool) -> tuple[list[float], list[float]]:
        e = self.equations
        self._check_signs()
        self._complete(e.q, list(zip(e.holonomic, e.positions, strict=True)))
        self._complete(e.qdot, list(enumerate(e.rates)))
        q, v = [self.values[s] for s in e.q], [self.values[s] for s in e.qdot]
        if not e.rows:
            return q, v
        surface = Surface(self.motion)
        try:
            surface.measure(0.0, q, v)
            surface.note(0.0, q, v)
            off = [k for k, r in enumerate(surface.residuals) if not r <= _ON_SURFACE]
        except (ArithmeticError, ValueError) as error:
            raise Refusal(
                f"the constraints are not defined at the initial state: {reason_of(error)}"
            ) from None
        if max(surface.residuals) <= surface.rounding:
            return q, v
        nearest = Surface(self.motion).nearest(0.0, q, v, _ROUNDS, _ON_SURFACE)
        if off and not project:
            raise self._off(off[0], nearest)
        if nearest is None:
            raise self._off(off[0] if off else 0, None)
        return nearest

    def _complete(self, unknowns: Sequence[Symbol], equations: list[tuple[int, Node]]) -> None:
        """Solve for what is left out; the first undetermined one becomes 0."""
        left_out = [s for s in unknowns if s not in self.values]
        while True:
            self._propagate(left_out, equations)
            still = [s for s in left_out if s not in self.values]
            if not still:
                return
            together = self._together(still, equations)
            self.values.update(together or self._assembled(still, equations) or {still[0]: 0.0})

    def _together(
        self, unknowns: Sequence[Symbol], equations: list[tuple[int, Node]]
    ) -> dict[Symbol, float]:
        """What the equations that are linear in the unknowns determine jointly."""
        mask = mask_of(unknowns)
        rows, right = [], []
        for which, node in equations:
            slopes = [partial(self.equations.graph, s)(node) for s in unknowns]
            if node.mask & mask and not any(x.mask & mask for x in slopes):
                rest, *row = self._values_at([node, *slopes], unknowns, which)
                rows.append(row)
                right.append(-rest)
        return {unknowns[k]: value for k, value in determined(rows, right).items()}

    def _assembled(
        self, unknowns: Sequence[Symbol], equations: list[tuple[int, Node]]
    ) -> dict[Symbol, float]:
        """The positions that equations determine together, by Newton's method; none is empty."""
        if unknowns[0].primes:  # the rates are linear in the velocities
            return {}
        mask = mask_of(unknowns)
        for first in unknowns:
            part, rows = _connected(first, unknowns, [x for x in equations if x[1].mask & mask])
            if len(part) > len(rows):
                continue
            at_zero = self._values_at([node for _, node in rows], part, rows[0][0])
            if max(map(abs, at_zero)) <= _ZERO:
                return dict.fromkeys(part, 0.0)
            if roots := self._roots(part, rows):
                return self._only(part, roots, rows)
        return {}

    def _only(
        self,
        unknowns: Sequence[Symbol],
        roots: Sequence[Sequence[float]],
        equations: Sequence[tuple[int, Node]],
    ) -> dict[Symbol, float]:
        """The only root of some equations.

        Raises
        ------
        Refusal
            When several roots are found, or none.
        """
        if len(roots) == 1:
            return dict(zip(unknowns, roots[0], strict=True))
        raise self._several(unknowns, roots, equations[0][0])

    def _roots(
        self, unknowns: Sequence[Symbol], equations: Sequence[tuple[int, Node]]
    ) -> list[tuple[float, ...]]:
        """The roots that are found and that the assumptions allow."""
        nodes = [node for _, node in equations]
        slopes = [partial(self.equations.graph, s)(node) for node in nodes for s in unknowns]
        known = {self.equations.t: 0.0, **self.values}
        at = straight_line(
            [*known, *unknowns], [*nodes, *slopes], self.motion.constants, self.motion.arithmetic
        )
        sizes = [*self.motion.constants.values(), *self.values.values()]
        length = max((abs(float(x)) for x in sizes), default=0.0) or 1.0
        roots = assemblies(partial_call(at, *known.values()), len(unknowns), length)
        return [
            root for root in roots if all(starmap(self._allows, zip(unknowns, root, strict=True)))
        ]

    def _several(
        self, unknowns: Sequence[Symbol], roots: Sequence[Sequence[float]], which: int
    ) -> Refusal:
        """The refusal where constraints can be satisfied in several ways, or in none found."""
        names = ", ".join(map(str, unknowns))
        if not roots:
            return self._open(unknowns[0], which, "is not found: no state with the given values is")
        reason_of = [
            "{" + ", ".join(f"{s}: {x!r}" for s, x in zip(unknowns, root, strict=True)) + "}"
            for root in roots[:_LISTED]
        ]
        more = " and others" if len(roots) > _LISTED else ""
        ways = "the constraints can be satisfied in several ways"
        constraint = self.equations.declared[which]
        diagnostic = Diagnostic(
            f"{ways}: {', '.join(reason_of)}{more}",
            constraint.equation.span,
            f"give {names} in `initial`",
        )
        return Refusal((diagnostic,))

    def _propagate(self, left_out: Sequence[Symbol], equations: list[tuple[int, Node]]) -> None:
        """Use each equation that has one unknown left, until nothing new follows."""
        progress = True
        while progress:
            progress = False
            for which, node in equations:
                unknown = [s for s in left_out if s not in self.values and s.mask & node.mask]
                if len(unknown) == 1:
                    value = self._solve(node, unknown[0], which, equations)
                    if value is not None:
                        self.values[unknown[0]] = value
                        progress = True

    def _solve(
        self, node: Node, unknown: Symbol, which: int, equations: list[tuple[int, Node]]
    ) -> float | None:
        """The value that the equation determines; None where it leaves the value open."""
        derivative = partial(self.equations.graph, unknown)
        orders = [node]
        while orders[-1].mask & unknown.mask and len(orders) <= _HIGHEST_DEGREE:
            orders.append(derivative(orders[-1]))
        polynomial = not orders[-1].mask & unknown.mask
        at_zero = self._values_at(orders if polynomial else [node], [unknown], which)
        if not polynomial:
            if abs(at_zero[0]) <= _ZERO:
                return 0.0
            _, alone = _connected(unknown, [unknown], equations)
            rows = [(k, x) for k, x in alone if not self._has_other_unknowns(x, unknown)]
            return self._only([unknown], self._roots([unknown], rows), rows)[unknown]
        coefficients = [value / factorial(k) for k, value in enumerate(at_zero)]
        if not any(coefficients[1:]):
            return None
        roots = [x for x in real_roots(coefficients) if self._allows(unknown, x)]
        if len(roots) > 1:
            raise self._open(unknown, which, f"could be any of {', '.join(map(repr, roots))}")
        return roots[0] if roots else None

    def _has_other_unknowns(self, node: Node, unknown: Symbol) -> bool:
        others = (s for s in self.equations.state if s not in self.values and s is not unknown)
        return any(s.mask & node.mask for s in others)

    def _values_at(
        self, nodes: Sequence[Node], unknowns: Sequence[Symbol], which: int
    ) -> tuple[float, ...]:
        """The nodes where the unknowns are 0."""
        known = {self.equations.t: 0.0, **self.values, **dict.fromkeys(unknowns, 0.0)}
        arguments = list(known)
        constants, arithmetic = self.motion.constants, self.motion.arithmetic
        try:
            return straight_line(arguments, nodes, constants, arithmetic)(*known.values())
        except UndefinedFunction as error:
            message = f"the function '{error}' is left unspecified: it has no numbers"
            raise Refusal(message) from None
        except (ArithmeticError, ValueError):
            raise self._open(unknowns[0], which, "does not follow in closed form") from None

    # -- mistakes ------------------------------------------------------------------------------

    def _coordinate(self, symbol: Symbol) -> Coordinate | None:
        if symbol.primes:
            return None
        return next(c for c in self.equations.problem.coordinates if c.name == symbol.name)

    def _allows(self, symbol: Symbol, value: float) -> bool:
        coordinate = self._coordinate(symbol)
        return coordinate is None or coordinate.allows(value)

    def _check_signs(self) -> None:
        wrong = [
            (symbol, coordinate)
            for symbol, value in self.values.items()
            if (coordinate := self._coordinate(symbol)) is not None and not coordinate.allows(value)
        ]
        if wrong:
            raise Refusal(
                tuple(
                    Diagnostic(
                        f"'{s.name}' is {c.assume}, and its initial value is not", self._span(s)
                    )
                    for s, c in wrong
                )
            )

    def _span(self, symbol: Symbol) -> Span:
        value = self.initial.get(Name(symbol.name, symbol.primes))
        return NOWHERE if value is None else value.span

    def _open(self, unknown: Symbol, which: int, why: str) -> Refusal:
        name = str(unknown)
        constraint = self.equations.declared[which]
        return Refusal(
            (
                Diagnostic(
                    f"the initial value of '{name}' {why}",
                    constraint.equation.span,
                    f"give {name} in `initial`",
                ),
            )
        )

    def _off(self, residual: int, nearest: tuple[list[float], list[float]] | None) -> Refusal:
        e = self.equations
        count = len(e.holonomic)
        which = e.holonomic[residual] if residual < count else residual - count
        constraint = e.declared[which]
        what = "satisfy" if residual < count else "move along"
        state: dict[str, float] = {}
        if nearest is None:
            hint = "no state near it does: do the constraints contradict each other?"
        else:
            names = [str(s) for s in (*e.q, *e.qdot)]
            state = dict(zip(names, (*nearest[0], *nearest[1]), strict=True))
            reason_of = ", ".join(f"{name}: {value!r}" for name, value in state.items())
            hint = f"the nearest state that does, which simulate --project takes: {{{reason_of}}}"
        message = f"the initial state does not {what} the constraint '{constraint.name}'"
        return OffConstraints((Diagnostic(message, constraint.equation.span, hint),), state)


def _connected(
    first: Symbol, unknowns: Sequence[Symbol], equations: Sequence[tuple[int, Node]]
) -> tuple[list[Symbol], list[tuple[int, Node]]]:
    """The unknowns that equations tie to one of them, and these equations."""
    mask, before = first.mask, 0
    while mask != before:
        before = mask
        for _, node in equations:
            if node.mask & mask:
                mask |= mask_of(s for s in unknowns if s.mask & node.mask)
    part = [s for s in unknowns if s.mask & mask]
    return part, [(k, node) for k, node in equations if node.mask & mask]
