"""Whether each name of an expression is known and may stand where it stands."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagcli.diagnostics import Diagnostic
from lagcli.expression import (
    FUNCTIONS,
    Call,
    Diff,
    Expression,
    Name,
    PartialCall,
    Quotient,
    name_nodes,
    walk,
)
from lagcli.notation.greek import BY_NAME as GREEK
from lagcli.reader.foreign.words import VELOCITIES, Vocabulary, rate_meant, square_of_speed
from lagcli.reader.habits import foreign_function, habits, instead, is_angle, meanings
from lagcli.reader.number_units import in_digits
from lagcli.reader.scope import CONSTANT, Role, Scope
from lagcli.reader.suggest import alike, closest, did_you_mean
from lagcli.reader.undeclared import COORDINATE, UNDECLARED

_MOMENTA = "momenta stand in H: give H, or write velocities x'"
_ORDERS = ("coordinate", "velocity", "acceleration", "third derivative")
#: Kinds of names whose values follow from the state: tension(theta) is the tension.
_OF_STATE = frozenset({"definition", "multiplier", "contact force", "observable"})


def name_mistakes(
    expression: Expression, scope: Scope, role: Role, what: str, before: int | None = None
) -> Iterator[Diagnostic]:
    """Every wrong name in an expression that stands at a place, as in "unknown name 'tetha' in V".

    In a definition only those of a lower rank than `before` can be used.
    """
    times = (isinstance(node, Name) and node.name == "t" for node in walk(expression))
    role = role._replace(driven=any(times))
    coordinates = scope.coordinates
    covered: set[int] = set()  # by the message on what is around them
    for node in walk(expression):
        match node:
            case Quotient(numerator=Name() as above, denominator=Name() as below) if (
                above.name[:1] == "d" == below.name[:1] and above.name[1:]
                and alike((above if below.name == "dt" else below).name[1:], coordinates)
                and not {above.name, below.name} & scope.kinds.keys()
            ):  # fmt: skip
                covered |= {id(above), id(below)}
                rate, hint = "derivative", f"write diff({above.name[1:]}, {below.name[1:]})"
                if below.name == "dt":
                    rate, hint = "velocity", ""
                elif above.name[1:] in {"V", "U", "T", "L", "H", "W"}:
                    hint = "leave it out: what an energy contributes is derived"
                message = f"'{above.name}/{below.name}' is not a {rate} in {what}"
                yield Diagnostic(message, above.span.to(below.span), hint)
            case Name() if id(node) in covered:
                pass
            case Name():
                yield from _name(node, scope, role, what, before)
            case Call():
                yield from _call(node, scope, role, what)
                known = node.function in FUNCTIONS or node.function in scope.kinds
                if not known and instead(node.function):
                    covered |= {id(each) for each in walk(node)}
            case PartialCall():
                yield from _partial_call(node, scope)
            case Diff(operand=operand, variable=variable):
                yield from _variable(variable, scope)
                if variable.name == "t":
                    yield from _partial_by_time(node, operand, scope)


def derivative_order(expression: Expression, scope: Scope) -> int:
    """The highest time derivative of a coordinate in an expression; -1 without any."""
    return max((_order(node, scope) for node in walk(expression)), default=CONSTANT)


def depends_on_time(expression: Expression, scope: Scope) -> bool:
    """Whether t stands in an expression, or in a definition that it uses."""
    moving = {"t", *(name for name, one in scope.definitions.items() if one.time)}
    return any(node.name in moving for node in name_nodes(expression))


def _order(node: Expression, scope: Scope) -> int:
    if not isinstance(node, Name):
        return CONSTANT
    kind = scope.kinds.get(node.name)
    if kind == "coordinate":
        return node.primes
    if kind == "definition":
        order = scope.definitions[node.name].order
        return CONSTANT if order == CONSTANT else order + node.primes
    return CONSTANT


#: Kind -> the role's permission, what it is called, and a hint where it is not allowed.
_WITHOUT_PRIMES = {
    "multiplier": (
        "multipliers", "a multiplier",
        "write this force out, as in m*g on a level floor, m*g*cos(alpha) on a slope",
    ),
    "contact force": (
        "contact_forces", "a multiplier",
        "the forces of contacts are known along a numerical run only",
    ),
    "observable": (
        "observables", "an observable", "an observable stands in other observables and in brackets"
    ),
}  # fmt: skip


def _name(
    node: Name, scope: Scope, role: Role, what: str, before: int | None
) -> Iterator[Diagnostic]:
    name = node.name
    match scope.kinds.get(name):
        case "coordinate":
            yield from _derivative(node, node.primes, role, what, of_definition=False)
        case "definition":
            definition = scope.definitions[name]
            if not role.definitions:
                yield Diagnostic(f"'{name}' cannot stand in {what}", node.span, role.why)
            elif before is not None and definition.place >= before:
                yield _uses_later(node, itself=definition.place == before)
            else:
                order = definition.order
                order = CONSTANT if order == CONSTANT else order + node.primes
                yield from _derivative(node, order, role, what, of_definition=True)
                if definition.time and not role.time:
                    message = f"{node} contains the time, which cannot stand in {what}"
                    yield Diagnostic(message, node.span, role.why)
        case "parameter":
            if not role.parameters:
                yield Diagnostic(f"'{name}' cannot stand in {what}", node.span, role.why)
            elif node.primes:
                yield Diagnostic(f"{node} is 0: a parameter is constant", node.span)
        case "multiplier" | "contact force" | "observable" as kind:
            allowed, thing, hint = _WITHOUT_PRIMES[kind]
            if not getattr(role, allowed):
                article = "the multiplier " if kind == "multiplier" else ""
                if article and what in {"T", "V", "L", "H"}:
                    hint = "the forces of constraints are found without it"
                yield Diagnostic(f"{article}'{name}' cannot stand in {what}", node.span, hint)
            elif node.primes:
                yield Diagnostic(f"{thing} has no primes", node.span)
        case "function":
            given, known = scope.arguments.get(name, []), scope.coordinates
            given = given if {*given} <= {*known, "t"} else known * (len(given) == len(known))
            hint = f"write {node}({', '.join(given) or '…'})"
            yield Diagnostic(f"'{name}' is a function and needs arguments", node.span, hint)
        case None:
            yield from _other_name(node, scope, role, what)


def _derivative(
    node: Name, order: int, role: Role, what: str, *, of_definition: bool
) -> Iterator[Diagnostic]:
    """A coordinate or a definition, of which `order` time derivatives are needed."""
    if order <= role.order:
        return
    kind = _ORDERS[order] if order < len(_ORDERS) else f"derivative of order {order}"
    if of_definition:
        article = "an" if kind.startswith("a") else "a"
        message = f"{node} contains {article} {kind}, which cannot stand in {what}"
    else:
        message = f"the {kind} {node} cannot stand in {what}"
    yield Diagnostic(message, node.span, role.why.replace("p_x", f"p_{node.name}"))


def _uses_later(node: Name, *, itself: bool) -> Diagnostic:
    if itself:
        return Diagnostic(f"the definition of '{node.name}' uses itself", node.span)
    hint = "a definition may use earlier ones: change their order"
    return Diagnostic(f"'{node.name}' is defined later", node.span, hint)


def _other_name(node: Name, scope: Scope, role: Role, what: str) -> Iterator[Diagnostic]:
    """The time, the number pi, a momentum, a function of the grammar, or nothing known."""
    name, span = node.name, node.span
    if name == "t":
        if node.primes:
            yield Diagnostic("the time has no primes", span)
        elif not role.time:
            yield Diagnostic(f"the time cannot stand in {what}", span, role.why)
    elif name == "pi":
        if node.primes:
            yield Diagnostic(f"{node} is 0: pi is a number", span)
    elif (name in FUNCTIONS or name == "diff") and name not in scope.refused:
        yield Diagnostic(f"'{name}' is a function and needs arguments", span, f"write {name}(…)")
    elif scope.coordinate_of_momentum(name) is not None:
        if not role.momenta:
            yield Diagnostic(f"the momentum '{name}' cannot stand in {what}", span, _MOMENTA)
        elif node.primes:
            yield Diagnostic("a momentum has no primes", span)
    elif (
        not scope.may_be(name) and name not in FUNCTIONS
    ):  # else it may be one of those that could not be declared
        yield Diagnostic(
            f"unknown name '{name}' in {what}", span, _advice(name, scope, role, node.primes, what)
        )


def _meant(name: str, what: str, order: str) -> str:
    """What is written instead of a name in a place; nothing where the tables do not say it.

    The order is `first`, or `unlike` for a name that no known one is spelled like.
    """
    said = (
        each.expand(advice)
        for place, form, advice in habits()["names_in"][order]
        if re.match(place, what) and (each := re.fullmatch(form, name))
    )
    return next(said, meanings("names").get(name, "") if order == "unlike" else "")


def _advice(name: str, scope: Scope, role: Role, primes: int, what: str) -> str:
    coordinates = scope.coordinates
    if role.momenta and name in {"p", "P"} and coordinates:
        return "momenta are named p_" + ", p_".join(coordinates)
    if name in {"p", "P"} and role.order > 0:
        return _MOMENTA
    if role.momenta and name.startswith("p_") and not closest(name, scope.usable(role), 0.8):
        return f"declare {name[2:]} under 'coordinates'"
    if said := _meant(name, what, "first"):
        return said
    if not role.parameters and not role.definitions and role.order < 0:
        return role.why
    words = Vocabulary(tuple(coordinates), frozenset(), moving=scope.moving)
    words = words._replace(turning=turning(scope, what))
    of_drive = role.driven and name in VELOCITIES
    rate = role.order > 0 and not of_drive and rate_meant(name, words)
    if role.order > 0 and (speed := _speed_along(name, coordinates)):
        return speed
    known = [*coordinates, *scope.definitions] if primes else scope.usable(role)
    known = [each for each in known if each != "pi" or name not in GREEK]  # phi is not pi
    hint = "" if rate else did_you_mean(name, known)
    if len(name) == 1 and name.swapcase() in known:  # M is another mass than m
        hint = ""
    if not hint and role.time and name[-1] == "t" and (len(name) == 2 or name[:-1] in GREEK):
        return f"did you mean {name[:-1]}*t?"
    if parts := [x for point, x in scope.components.items() if point.startswith(f"{name}.")]:
        return f"a vector, whose components are {', '.join(parts)}"
    if re.fullmatch(r"_?\d+", name.removeprefix(closest(name, scope.usable(role)))):
        return UNDECLARED  # x0 beside x is another quantity
    hint = hint or (
        "" if rate or role.order < 0 else _renamed(name, known, " ".join(scope.energies.values()))
    )
    if hint:
        return hint
    if name in {"v", "velocity", "speed", "d"} and role.order > 0 and coordinates and not of_drive:
        square = square_of_speed((*coordinates,)) if name != "d" else ""
        speed = f", the speed is sqrt({square})" if square else ""
        return "the velocities are " + "' and ".join(coordinates) + f"'{speed}"
    if primes and role.order > 0:
        return COORDINATE
    if said := _meant(name, what, "unlike"):
        return said
    if (number := in_digits(name)) != name:
        return f"write {number}"
    multipliers = list(scope.of_kind("multiplier")) if role.multipliers else []
    if len(multipliers) == 1 and re.fullmatch(r"[A-Z]\w?|F_?\w|lam\w*|λ|tension|normal\w*", name):
        return f"the multiplier of the constraint: write {multipliers[0]}"
    if rate:
        return f"the velocity of {rate[0]} is {rate[0]}'"
    base = name.removesuffix("2")
    if base in scope.usable(role) and base != name and f"{base}1" not in scope.kinds:
        return f"{UNDECLARED}, or write {base}^2"
    if what.startswith("the value of") and (moving := rate_meant(name, words)):
        velocity = moving[0] + "'" * moving[1]
        moved = f"{what.split(chr(39))[1]} under 'definitions'"
        return f"{UNDECLARED}, or, if it is {velocity}, write {moved} with {velocity} for {name}"
    return UNDECLARED + (", or its formula under 'definitions'" if role.definitions else "")


def _renamed(letter: str, known: list[str], energies: str) -> str:
    """`did you mean 'length'?` for l where no other word begins so; the others are Greek letters.

    A length that stands in an energy is not L.
    """
    words = [each for each in known if len(each) >= 4 and each.isalpha() and each not in GREEK]
    found = [each for each in words if each[0].casefold() == letter.casefold()]
    is_other = found[:1] and found[0][0] != letter and re.search(rf"\b{found[0]}\b", energies)
    return f"did you mean '{found[0]}'?" if len(found) == 1 and not is_other else ""


def turning(scope: Scope, what: str) -> str:
    """The only angle whose velocity stands in no term of an energy; else nothing."""
    law = scope.energies.get(what, "'") if what in {"T", "L"} else "'"
    law = "'" if re.search(r"\b(?:omega|Omega|w|ω|Ω)\b", scope.energies.get("V", "")) else law
    still = [x for x in scope.coordinates if is_angle(x) and f"{x}'" not in law]
    in_others = any(each.order > 0 for each in scope.definitions.values())
    return still[0] if len(still) == 1 and law != "'" and not in_others else ""


def _speed_along(name: str, coordinates: list[str]) -> str:
    """`r*sin(theta)*phi'` for `v_phi` beside a radius; nothing for other names."""
    along = re.fullmatch(r"v_?(\w+)", name)
    radius = next((x for x in coordinates if x in {"r", "rho", "ρ", "s"}), "")
    if not (along and radius and along[1] in coordinates and is_angle(along[1])):
        return ""
    polar = next((x for x in coordinates if x in {"theta", "θ"} and x != along[1]), "")
    sine = f"*sin({polar})" if polar and along[1] in {"phi", "φ", "ϕ"} else ""
    return f"the speed along {along[1]} is {radius}{sine}*{along[1]}'"


def _call(node: Call, scope: Scope, role: Role, what: str) -> Iterator[Diagnostic]:
    name, count = node.function, len(node.arguments)
    if name == "integral" and name not in scope.kinds:
        yield from _integral(node, role, what)
        return
    if name in FUNCTIONS:
        if node.primes:
            hint = f"write diff({name}(x), x)"
            yield Diagnostic(f"'{name}' with primes has no meaning", node.span, hint)
        elif count != FUNCTIONS[name]:
            yield _wrong_count(node, FUNCTIONS[name])
    elif scope.kinds.get(name) == "function":
        arity = len(scope.arguments.get(name, node.arguments))
        if node.primes and arity != 1:
            hint = f"write diff({name}, 1)(…) for the derivative by the first"
            message = f"a prime needs a function of one argument, '{name}' has {arity}"
            yield Diagnostic(message, node.span, hint)
        elif count != arity:
            yield _wrong_count(node, arity, scope)
    elif name in scope.kinds or name in {"t", "pi"} or scope.coordinate_of_momentum(name):
        written = name + "'" * node.primes
        message = f"{written} is a {scope.kinds.get(name, 'quantity')}, not a function"
        hint = f"did you mean {written}*(…)?"
        of_time = any(part.name == "t" for part in name_nodes(*node.arguments))
        if scope.kinds.get(name) == "coordinate" and of_time:
            hint = f"{written} is taken at the time t; there are no delays"
        elif scope.kinds.get(name) in _OF_STATE and all(
            isinstance(x, Name) for x in node.arguments
        ):
            hint = f"it has no arguments: write {written}"
        elif scope.kinds.get(name) == "parameter" and node.arguments == (Name("t"),):
            hint = f"a function of time is declared as such: functions: {{{name}: [t]}}"
        yield Diagnostic(message, node.span, hint)
    elif not scope.may_be(name) or instead(name) or foreign_function(name):
        functions = [*FUNCTIONS, "diff", *scope.of_kind("function")]
        spelled = name.lower() if len(name) > 1 and name.isupper() else name  # LN
        best = "" if foreign_function(name) else closest(spelled, functions)
        given = _names_of(node)
        hint = f"declare it: functions: {{{name}: [{', '.join(given)}]}}, or write its formula"
        hint = f"did you mean {best}(…)?" if best else hint
        if power := re.fullmatch(r"(sin|cos|tan|sinh|cosh|tanh)2", name):
            inner = str(given[0]) if given and isinstance(node.arguments[0], Name) else "…"
            hint = f"write {power[1]}({inner})^2, or {power[1]}(2*{inner}) for the double angle"
        hint = instead(name) or hint
        yield Diagnostic(f"unknown function '{name}' in {what}", node.span, hint)


def _names_of(node: Call | PartialCall) -> list[str]:
    """The arguments, with a letter for each that is not a name."""
    return [str(x) if isinstance(x, Name) else "xyzuvw"[i % 6]
            for i, x in enumerate(node.arguments)]  # fmt: skip


def _wrong_count(node: Call | PartialCall, arity: int, scope: Scope | None = None) -> Diagnostic:
    """The hint has the declared arguments where they are names of the file, and the others."""
    name, given, plural = node.function, _names_of(node), "argument" if arity == 1 else "arguments"
    hint = {"atan": "write atan2(y, x)", "atan2": "write atan2(y, x) for y/x",
            "log": "write log(x)/log(b) for the base b"}.get(name)  # fmt: skip
    more = (x for x in "xyzuvw…" if x not in given)
    whole = [given[i] if i < len(given) else next(more, "…") for i in range(min(arity, 9))]
    hint = hint or f"write {name}({', '.join(whole)})"
    if scope is not None:
        declared = scope.arguments.get(name, ())
        entry = f"functions: {{{name}: [{', '.join(given)}]}}"
        are_known = {*declared} <= {*scope.kinds, "t"}
        hint = f"write {name}({', '.join(declared)}), or {entry}" if are_known else f"write {entry}"
    return Diagnostic(f"'{name}' takes {arity} {plural}, not {len(given)}", node.span, hint)


def _integral(node: Call, role: Role, what: str) -> Iterator[Diagnostic]:
    """`integral(f, x, a, b)` of f by x from a to b."""
    count = len(node.arguments)
    if not role.integrals:
        yield Diagnostic(f"an integral cannot stand in {what}", node.span, instead("integral"))
    elif count != 4 or node.primes:
        yield _wrong_count(node, 4)
    elif not isinstance(node.arguments[1], Name):
        yield Diagnostic("an integral is taken by a name, such as x", node.arguments[1].span)


def _partial_call(node: PartialCall, scope: Scope) -> Iterator[Diagnostic]:
    name = node.function
    if scope.kinds.get(name) != "function":
        functions = list(scope.of_kind("function"))
        hint = did_you_mean(name, functions) or "declare it under 'functions'"
        yield Diagnostic(f"'{name}' is not a function of this problem", node.span, hint)
        return
    arity = len(scope.arguments.get(name, node.arguments))
    if len(node.arguments) != arity:
        yield _wrong_count(node, arity, scope)
    for index in node.indices:
        if not 1 <= index <= arity:
            message = f"'{name}' has no argument number {index}"
            yield Diagnostic(message, node.span, f"they count from 1 to {arity}")


def _partial_by_time(node: Expression, operand: Expression, scope: Scope) -> Iterator[Diagnostic]:
    """diff(x, t) is taken for x' by those who come from SymPy, and is 0."""
    if derivative_order(operand, scope) == CONSTANT or depends_on_time(operand, scope):
        return
    hint = "a total time derivative is a prime: x', or the prime of a definition"
    yield Diagnostic("this is a partial derivative, and 0: t is not in it", node.span, hint)


def _variable(variable: Name, scope: Scope) -> Iterator[Diagnostic]:
    """What stands behind the comma of `diff(expression, name)`."""
    if scope.kinds.get(variable.name) == "definition" or variable.name == "pi":
        message = f"diff differentiates by a coordinate, velocity, parameter or t, not '{variable}'"
        yield Diagnostic(message, variable.span)
