"""Whether the answer of a file with two like bodies exchanged is the exchanged answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cache

from lagcli.algebra import is_zero
from lagcli.algebra.build import Builder
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    walk,
)
from lagcli.problem_data import Constraint, Problem
from lagcli.rewriting import rebuilt

#: Of these sections rows are compared; those of multipliers up to their sign.
_COMPARED = ("equations", "accelerations", "multipliers", "momenta", "energy", "hamiltonian")


def rational(node: Expression) -> Fraction | None:
    """The value of a number, None of anything else."""
    match node:
        case Number(value=value):
            return value
        case Negative(operand=Number(value=value)):
            return -value
        case Quotient(numerator=Number(value=a), denominator=Number(value=b)):
            return a / b
        case _:
            return None


@cache
def canonical(node: Expression) -> tuple:
    """A key that does not depend on the order of terms and factors, nor on where a minus stands."""
    match node:
        case Negative(operand=operand):
            sign, key = canonical(operand)
            return -sign, key
        case Sum(terms=terms):
            keys = sorted((canonical(t) for t in terms), key=lambda pair: repr(pair[::-1]))
            lead = keys[0][0]
            return lead, ("+", tuple((s * lead, k) for s, k in keys))
        case Product(factors=factors):
            keys = sorted((canonical(f) for f in factors), key=lambda pair: repr(pair[::-1]))
            sign = 1
            for s, _ in keys:
                sign *= s
            return sign, ("*", tuple(k for _, k in keys))
        case Quotient(numerator=above, denominator=below):
            (a, one), (b, other) = canonical(above), canonical(below)
            return a * b, ("/", one, other)
        case Power(base=base, exponent=exponent):
            sign, key = canonical(base)
            even = rational(exponent)
            odd = even is None or even.denominator != 1 or even.numerator % 2
            return sign if odd else 1, ("^", key, canonical(exponent))
        case Call(function=function, arguments=arguments, primes=primes):
            keys = tuple(map(canonical, arguments))
            if function in ("cos", "abs", "cosh"):
                return 1, (function, primes, tuple(k for _, k in keys))
            if function in ("sin", "tan", "sinh", "tanh"):
                return keys[0][0], (function, primes, tuple(k for _, k in keys))
            return 1, (function, primes, keys)
        case PartialCall(function=function, indices=indices, arguments=arguments):
            return 1, (function, indices, tuple(map(canonical, arguments)))
        case _:
            return 1, (str(node),)


def built(node: Expression):
    import sympy

    names = {str(p): sympy.Symbol(str(p), positive=True) for p in walk(node) if isinstance(p, Name)}
    rename = {text: Name(f"v{k}") for k, text in enumerate(names)}
    plain = {rename[text].name: symbol for text, symbol in names.items()}
    plain |= {"pi": sympy.pi}

    def renamed(part: Expression) -> Expression:
        from lagcli.rewriting import rebuilt

        if isinstance(part, Name):
            return rename[str(part)]
        return rebuilt(part, renamed)

    calls = {p.function: len(p.arguments) for p in walk(node) if isinstance(p, (Call, PartialCall))}
    return Builder(plain, calls, lambda e: e, lambda n: ValueError(str(n)))(renamed(node))


def exchanges(problem: Problem) -> Iterator[dict[str, str]]:
    """Exchanges of two indices, or of x and y, under which L, the constraints and the forces may stay."""
    names = [q.name for q in (*problem.coordinates, *problem.parameters)]
    for a, b in (("1", "2"), ("2", "3"), ("1", "3"), ("x", "y"), ("A", "B"), ("a", "b")):
        pairs = {n: n[:-1] + (b if n.endswith(a) else a) for n in names if n[-1:] in (a, b)}
        pairs = {n: m for n, m in pairs.items() if m in names}
        if any(n in pairs for n in (q.name for q in problem.coordinates)):
            yield pairs


def exchanged(node: Expression, pairs: Mapping[str, str]) -> Expression:
    """The formula with the names exchanged; one to which a minus belongs is taken with it."""
    if isinstance(node, Name):
        if node.name.startswith("p_") and node.name[2:] in pairs:
            return Name("p_" + pairs[node.name[2:]], node.primes)
        other = pairs.get(node.name, node.name)
        renamed = Name(other.removeprefix("-"), node.primes)
        return Negative(renamed) if other.startswith("-") else renamed
    return rebuilt(node, lambda part: exchanged(part, pairs))


def _zero(constraint: Constraint) -> Expression:
    return Sum((constraint.equation.left, Negative(constraint.equation.right)))


def with_constraints(problem: Problem, pairs: Mapping[str, str]) -> dict[str, str] | None:
    """The pairs with those of the constraints and their multipliers; None where one has none.

    A constraint that goes over into minus another one has a multiplier with a minus.
    """
    found = dict(pairs)
    keys = {canonical(_zero(c))[1]: c for c in problem.constraints}
    for each in problem.constraints:
        sign, key = canonical(exchanged(_zero(each), pairs))
        other = keys.get(key)
        if other is None:
            return None
        minus = "-" if canonical(_zero(other))[0] != sign else ""
        found[each.name] = other.name
        found[each.multiplier] = minus + other.multiplier
    return found


def symmetric_under(problem: Problem, lagrangian: Expression, pairs: Mapping[str, str]) -> bool:
    """Whether L and the forces are the same after the exchange."""
    if any(point.force is not None for point in problem.points):
        return False
    forces = problem.forces.items()
    acting = {name: canonical(e) for name, e in forces}
    acted = {pairs.get(name, name): canonical(exchanged(e, pairs)) for name, e in forces}
    lost = problem.dissipation or Number(Fraction(0))
    if acting != acted or canonical(lost) != canonical(exchanged(lost, pairs)):
        return False
    try:
        return is_zero(built(Sum((lagrangian, Negative(exchanged(lagrangian, pairs)))))) is True
    except (ZeroDivisionError, TypeError, KeyError, AttributeError):
        return False


def not_exchanged(problem: Problem, found: Mapping[str, Expression]) -> Iterator[str]:
    """The paths whose formula is not the exchanged one of the other body."""
    lagrangian = found.get("/lagrangian/lagrangian")
    if lagrangian is None:
        return
    for exchange in exchanges(problem):
        pairs = with_constraints(problem, exchange)
        if pairs is None or not symmetric_under(problem, lagrangian, pairs):
            continue
        order = [q.name for q in problem.coordinates]
        rows = {str(k): str(order.index(pairs.get(q, q))) for k, q in enumerate(order)}
        for path, node in found.items():
            section = path.split("/")[1]
            if section not in _COMPARED or path.startswith("/equations/constraints"):
                continue
            names = rows if section == "equations" else pairs
            other = "/".join(names.get(part, part) for part in path.split("/"))
            if other not in found:
                continue
            one, two = canonical(exchanged(node, pairs)), canonical(found[other])
            if one[1] != two[1] or (one[0] != two[0] and section != "multipliers"):
                yield path
