"""A formula that the reader refuses, as it accepts it: what a hint may propose."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

from lagcli.diagnostics import Diagnostic, Source
from lagcli.expression import ZERO, Equation, Expression, Sum, terms_of
from lagcli.problem_data import Inequality
from lagcli.reader.clauses import of_clause
from lagcli.reader.expressions import (
    formula_or_none,
    read_equation,
    read_expression,
    sides_of,
    signed_terms,
)
from lagcli.reader.foreign.cases import without_cases
from lagcli.reader.foreign.translation import translated
from lagcli.reader.foreign.words import UnclearText, Vocabulary, square_of_speed
from lagcli.reader.habits import COMMENT, comparisons_in, is_angle, name_meant
from lagcli.reader.misshapen import FRICTION, as_equation, as_rayleigh, behind_words, is_sentence
from lagcli.reader.momenta_meant import has_velocity, with_momenta, with_velocities
from lagcli.reader.names import name_mistakes, turning
from lagcli.reader.nodes import Scalar
from lagcli.reader.positions import Excerpt
from lagcli.reader.regex import regex
from lagcli.reader.scope import Role, Scope
from lagcli.reader.text import Mistake, SourceText
from lagcli.reader.undeclared import BY_OTHERS, COORDINATE, UNDECLARED
from lagcli.reader.velocity_quotients import multiplied_out
from lagcli.record import replace

#: The letters of ẋ², and its dots.
_LETTERS, _DOTS = regex(r"(?<!\w)[^\W\d][^\W²³]*"), regex("[\u0307\u0308]")
#: Characters of a formula that is repeated in a hint, and of one that is read for it, as LaTeX.
_LONGEST, _LONGEST_GIVEN = 600, 1800
#: Characters of a formula in which neighbours are exchanged.
_LONGEST_EXCHANGED = 160
#: `q'^T*M*q'`, transpose(q)*M*q.
_MATRIX = regex(
    r"(?<!\w)(?P<one>[^\W\d]\w*)'*\s*(?:\^\s*\{?(?:T|\\top|\\intercal)\}?(?!\w)|\.T(?!\w))"
    r"|(?:\.transpose\(|\b[tT]ranspose[(\[])"
    r"|(?<![\w.])(?P<column>[^\W\d]\w*)'\s*\*\s*[A-Z]\w*\s*\*\s*(?P=column)(?![\w'])"
)
#: The multiplier that is named behind a constraint.
_MULTIPLIER = regex(
    r"\s*[,;]?\s*\(?(?:with|where|and|mit|avec|con)\s+(?:the\s+)?(?:Lagrange\s+)?(?:multiplier\s+)?"
    r"(?:lambda|lam|λ)\w*\)?\s*$"
)
#: `! a comment` and `// a comment` behind a formula.
_COMMENT = regex(r"(?<=[\w)'’])\s+(?:!|//(?!\s*[A-Z]\w+\s*$)|/\*)\s*[^\W\d].*$")
#: The marks of a line of Fortran that goes on.
_GOES_ON = regex(r"(?<=[-+*/^(,])\s*&\s*&?\s*|\s*&\s*&?\s*(?=[-+*/^),])")
DECLARE = "and declare {} under 'parameters'"
#: A word for a constant.
_CONSTANT = regex(
    r"(?i:(?<![\w.])(?:(?:is\s+|a\s+)*(?:[ck]onst(?:ant[ae]?|ans)?|cst|cte|costante)(?!\w))"
    r"(?:\.(?!\d)|\s*\(\s*t?\s*\))?)"
)
#: A term of Lagrange's equation.
_LAGRANGE = regex(r"(?:d|∂|\\partial)\s*[LTV]\s*/\s*(?:d|∂|\\partial)")
#: `d(x - R*phi)/dt` and `d/dt (x - R*phi)`.
_TOTAL_RATE = regex(
    r"(?<![\w.])d\s*\((?P<inner>(?:[^()]|\([^()]*\))+)\)\s*/\s*(?:dt(?!\w)|\(dt\))"
    r"|(?<![\w.])d\s*/\s*dt\s*\(?\((?P<behind>(?:[^()]|\([^()]*\))+)\)"
    r"|(?<![\w.])\((?P<primed>(?:[^()]|\([^()]*\))+)\)['’′]"
)
#: Names of definitions that a hint proposes.
_FRESH = ("u", "v", "w", *(f"u_{place}" for place in range(1, 10)))
#: The name of a velocity or a height: omega1, w_x, v2, h.
_MOVING = r"(?:omega|Omega|ω|Ω|w|v|u)_?(?:[1-9]|[xyz])|h|height"
#: A product of two vectors within a formula.
_CROSS = regex(r"(?<!\w)([^\W\d]\w*)\s*(?:[×⨯]|\\times)\s*([^\W\d]\w*)")
_CROSS_IN_WORDS = regex(r"(?<!\w)([^\W\d]\w*)\s+x\s+([rvBEpL])(?!\w)")
#: A force in the place of an energy.
_FORCE = regex(r"\s*[FQ](?:_?\w+)?\s*:?=([^=]+)")
#: `y = ±sqrt(A)`: both branches are `y^2 = A`.
_BOTH_ROOTS = regex(
    r"(?P<left>[^=±]+)=\s*(?:±|\+/?[-−]|\\pm\b)\s*(?:sqrt|√|\\sqrt)\s*[({](?P<inner>(?:[^()]|\([^()]*\))+)[)}]\s*"
)
#: What stands before a formula that is given as an equation: `T =`, `V(x) =`, `kinetic energy =`.
_LEFT_SIDE = regex(r"^\s*(?:T\s*[-−]\s*V|[^\W\d][\w ]*(?:\([\w', ]+\))?)\s*:?=(?!=)")


def with_whole(
    found: list[Diagnostic],
    node: Scalar,
    what: str,
    scope: Scope,
    role: Role,
    read: Callable[[Excerpt], Expression | Equation | Inequality],
) -> list[Diagnostic]:
    """The mistakes of a formula as one, with the whole of it as the reader accepts it."""
    if what in {"T", "L"} and (energy := _energy_meant(found, node, what, scope, role)):
        return [energy]
    of_key = what not in {"T", "V"} and any("is a key and not a name" in x.hint for x in found)
    given = _with_energies(node.value, scope) if of_key else node.value
    by_momenta = _hamiltonian_meant(given) if what == "H" or (of_key and role.momenta) else ""
    if by_momenta and _is_read(by_momenta, scope, role, what):
        why = found[0].hint.removesuffix(": write its formula")
        return [replace(found[0], span=node.span, hint=f"write {by_momenta}: {why}")]
    if what == "V" and (force := _FORCE.fullmatch(node.value)):
        along, *others = [*scope.coordinates, "x"]
        law = "…" if others[1:] else force[1].strip()
        hint = f"V is an energy; a force stands by its coordinate: write forces: {{{along}: {law}}}"
        return [replace(found[0], hint=hint)]
    if what.startswith("the force along ") and (mass := _added_mass(found, node, what, scope)):
        return [mass]
    if what == "T" and (still := unmoved(found, node, what, scope)) != found:
        return still
    if read is not read_equation and (clause := of_clause(node, scope)):
        return [clause]
    if matrices := _of_matrices(node, what, scope):
        return [matrices]
    is_equation = read is read_equation
    of_one = what == "'holds_while'" or (is_equation and what.startswith("the question"))
    if of_one and (parts := comparisons_in(re.sub(r"\bor\b|\|\|", " and ", node.value)))[1:]:
        marks = {"="} if is_equation else {*scope.of_kind("multiplier")}
        marked = [each for each in parts if marks & {*re.findall(r"\w+|(?<![<>])=", each)}]
        rule = "a question has one equation" if is_equation else "a condition is one comparison"
        return [replace(found[0], hint=f"{rule}: write {(marked or parts)[0]}")]
    of_words = role.order < 0 or is_sentence(node.value, scope.kinds)
    constant = None if of_words else _CONSTANT.search(node.value)
    if constant and not {*re.findall(r"\w+", constant[0])} & scope.kinds.keys():
        whole, name = with_constant(node.value, scope, is_equation=read is read_equation)
        hint = f"a constant has a name and a value: write {whole}, {DECLARE.format(name)}"
        hint = hint if name else f"write {whole}"
        added = re.search(rf"\s*[-+]\s*{_CONSTANT.pattern}\s*$", node.value)
        if added and what in {"T", "V", "L", "H"}:
            hint = f"write {node.value[: added.start()]}: a constant has no effect on the motion"
        return [replace(found[0], hint=hint)]
    in_lines = any(each.message.startswith("two lines without") for each in found)
    by_name = read is read_expression and "is not a derivative" in found[0].message
    are_slips = all(each.hint.startswith("did you mean '") for each in found)
    if "the limit is" in found[0].hint or in_lines or by_name or are_slips:
        return found
    if is_sentence(node.value, scope.kinds):
        hint = "write a formula" if role.order > 0 else "write a number or a parameter"
        hint = (
            f"write left = right, {_example(node.value, scope)}" if read is read_equation else hint
        )
        return [Diagnostic("a sentence is no formula", node.span, hint)]
    for written in _written(given, scope, equation=read is not read_expression):
        try:
            names = _vocabulary(scope, role)._replace(turning=turning(scope, what))
            whole = translated(written, names._replace(related=read is read_equation))
            if read is read_equation:
                whole = multiplied_out(whole, scope) or whole
            sides = sides_of(read(Excerpt.whole(Source("", whole))))
        except (UnclearText, Mistake):
            continue
        wrong = [each for side in sides for each in name_mistakes(side, scope, role, what)
                 if not _named_in(each) <= {*scope.components.values()}]  # fmt: skip
        words = set(re.findall(r"\w+", re.sub(r"_?[\[{](\w+)[\]}]", r"_\1", node.value)))
        words |= {each.removesuffix("t") for each in words}  # ωt
        words |= {*_LETTERS.findall(_DOTS.sub("", unicodedata.normalize("NFD", node.value)))}
        if len(whole) > _LONGEST or not all(_is_undeclared(each, role, words) for each in wrong):
            named = [each for each in wrong if each.hint]
            if named and not found[0].hint:
                return [replace(named[0], span=node.span)]
            break
        once = re.sub(r"(?<=\w)''", "'", whole)
        if role.order == 1 and _is_of_accelerations(whole, names):
            return [replace(found[0], hint=f"write {once}: a constraint has no accelerations")]
        if what == "dissipation" and (lost := as_rayleigh(whole)):
            return [replace(found[0], hint=f"write {lost}: {FRICTION}")]
        if what == "T" and (moving := _with_primes(whole, names)):
            whole = moving
        proposed = re.search(rf"(?:write|mean) {re.escape(whole)}(?:[?;,]|$)", found[0].hint)
        same = "".join(whole.split()) == "".join(node.value.replace("**", "^").split())
        if same or (proposed and not found[1:]):
            return found
        if refused := [each for each in wrong if each.message.startswith("the acceleration ")]:
            return [replace(each, span=node.span) for each in refused]
        undeclared = {each.message for each in wrong}
        if all(each.message in undeclared for each in found):
            return found
        has_words = behind_words(node.value, scope.kinds) != node.value
        guess = found[0].hint.endswith("?") and not has_words
        hint = f"did you mean {whole}?" if guess else f"write {whole}"
        hint = f"{COMMENT}: write {whole}" if _COMMENT.search(node.value) else hint
        spans = {each.message: each.span for each in reversed(found)}
        first = next((each for each in found if each.message not in undeclared), found[0])
        rest = [replace(each, span=spans.get(each.message, node.span)) for each in wrong]
        message = "words are no part of a formula" if has_words else first.message
        return [replace(first, message=message, hint=hint), *rest]
    cross = _CROSS.search(node.value) or _CROSS_IN_WORDS.search(node.value)
    if cross and not {cross[1], cross[2]} <= scope.kinds.keys():
        hint = "a product of vectors is written by its components, as in x*p_y - y*p_x"
        return [Diagnostic("a formula has no vectors", node.span, hint)]
    if rate := _of_rates(node, scope):
        return [rate]
    exchanged = _exchanged(node.value, scope, role, what, read)
    return [replace(found[0], hint=f"did you mean {exchanged}?")] if exchanged else found


def unmoved(
    found: list[Diagnostic], node: Scalar, what: str, scope: Scope, only: str = _MOVING
) -> list[Diagnostic]:
    """The mistakes of an energy in which nothing moves: `m*g*h`, `I1*omega1^2/2`.

    A name that is the `only` unknown one has this form.
    """
    coordinates = (*scope.coordinates,)
    moving = {*scope.moving, *(coordinates if what == "V" else ())}
    has_rate = re.search(r"['’′\u0307]|dot|\bd\w+/dt", node.value)
    unclear = (UNDECLARED, f"{UNDECLARED}, or its formula under 'definitions'")
    names = {name for each in found for name in _named_in(each) if each.hint in unclear}
    if what not in {"T", "V", "L"} or has_rate or moving & {*re.findall(r"\w+", node.value)}:
        return found
    form = only if len(names) == 1 else _MOVING
    names = {x for x in names if re.fullmatch(form, x)}
    thing = "coordinates" if what == "V" else "velocities"
    square = square_of_speed(coordinates) if coordinates else ""
    square = square if len(coordinates) == 1 else f"({square})"
    height = next((x for x in "zy" if x in coordinates), "")
    examples = {"h": height, "gamma": f"1/sqrt(1 - {square}/c^2)" if "c" in scope.kinds else ""}
    angles = [x for x in coordinates if is_angle(x)]

    def advice(name: str) -> str:
        if is_angle(name) and len(angles) == 1 and what == "V":
            return f"did you mean '{angles[0]}'?"
        example = examples.get(name, "")
        example = f", as in {name}: {example}" if example and square != "()" else ""
        return f"{what} has {thing}: write {name} {BY_OTHERS}{example}"

    return [replace(each, hint=advice(*(_named_in(each) & names)))
            if _named_in(each) & names else each for each in found]  # fmt: skip


def with_constant(whole: str, scope: Scope, *, is_equation: bool) -> tuple[str, str]:
    """`x + y = C` and C for `x + y = const.`; without it beside another right side."""
    word = _CONSTANT.search(whole)
    if word is None:
        return whole, ""
    name = next((each for each in ("C", "C_0") if each not in scope.kinds), "C_1")
    sides = [each.strip() for each in re.split("==?", whole)]
    if len(sides) == 3 and len(named := [x for x in sides if not _CONSTANT.fullmatch(x)]) == 2:
        return " = ".join(named), ""
    sign = "" if not is_equation or "=" in whole else "= "
    sign = "*" if not sign and re.search(r"[\w)]\s*$", whole[: word.start()]) else sign
    before = whole[: word.start()]
    before = before.rstrip() if sign == "*" else before
    return f"{before}{sign}{name}{whole[word.end() :]}", name


def _example(text: str, scope: Scope) -> str:
    """`as in s' = R*phi'` with the coordinates of the file, or one of lengths for a sentence."""
    coordinates = [*scope.coordinates, "x"]
    turning = [x for x in coordinates if is_angle(x)] or ["theta"]
    moving = [x for x in coordinates if x not in turning]
    if not re.search(r"length|distance|long|rigid|inextens|string|rope|\brod\b", text):
        return f"as in {moving[0]}' = R*{turning[0]}'"
    whole = " + ".join(moving[:-1] or turning)
    squares = " + ".join(f"{x}^2" for x in moving[:-1] or turning)
    return f"as in {whole} = l" + f", or {squares} = l^2" * (
        {*moving} <= {*"xyz"} and moving[2:] != []
    )


def _is_of_accelerations(text: str, names: Vocabulary) -> bool:
    """Whether an equation has accelerations and otherwise parameters alone: `x'' = R*phi''`."""
    rest = {*re.findall(r"[^\W\d]\w*'*", re.sub(r"\w+''(?![\w'^])", "", text))}
    moving = {each.rstrip("'") for each in rest} & {*names.dependent, "t"}
    return " = " in text and "''" in text and not moving and "(" not in text


def _with_primes(text: str, names: Vocabulary) -> str:
    """`m*x'^2/2` for the kinetic energy `m*x^2/2`; nothing for one that has velocities."""
    if "'" in text or {*re.findall(r"[^\W\d]\w*", text)} & {*names.moving}:
        return ""
    squares = "|".join(map(re.escape, names.coordinates))
    whole = re.sub(rf"(?<!\w)({squares})(?=\^2(?!\d))", r"\1'", text)
    return whole if squares and whole != text else ""


def _of_matrices(node: Scalar, what: str, scope: Scope) -> Diagnostic | None:
    """What is written for `q'^T*M*q'`; None where no matrix is meant."""
    matrix = _MATRIX.search(node.value)
    if matrix is None or {matrix["one"], matrix["column"], "T"} & scope.kinds.keys():
        return None
    x, y = [*scope.coordinates, "x", "y"][:2]
    if re.match(r"omega|Omega|[ωΩw](?!\w)", matrix["one"] or ""):
        hint = "write the sum, as in (I_1*omega_1^2 + I_2*omega_2^2)/2, and omega_1 by velocities"
        return Diagnostic("a formula has no matrices", node.span, f"{hint} under 'definitions'")
    hint = f"write the sum, as in (m_11*{x}'^2 + 2*m_12*{x}'*{y}' + m_22*{y}'^2)/2"
    if what == "V":
        hint = f"write the sum, as in (k_11*{x}^2 + 2*k_12*{x}*{y} + k_22*{y}^2)/2"
    return Diagnostic("a formula has no matrices", node.span, hint)


def _added_mass(
    found: list[Diagnostic], node: Scalar, what: str, scope: Scope
) -> Diagnostic | None:
    """What is written for the force `-ma*x''`, whose ma is added to a mass; None for others."""
    x, terms = what.split("'")[1], signed_terms(node.value)
    masses = [each[: -len(x) - 3] for minus, each in terms if minus and each.endswith(f"*{x}''")]
    words, known = {*re.findall(r"[^\W\d]\w*", "".join(masses))}, {*scope.of_kind("parameter")}
    if not (node.value.count("''") == len(masses) == len(found) == 1 and words <= known):
        return None
    energy = next((each for each in "TL" if each in scope.energies), "T")
    lost = f"-{masses[0]}*{x}''" if terms[1:] else "it"
    hint = f"leave {lost} out here and add {masses[0]}*{x}'^2/2 to {energy}"
    return replace(found[0], span=node.span, hint=hint)


def _of_rates(node: Scalar, scope: Scope) -> Diagnostic | None:
    """What is written for `d(x - R*phi)/dt`; None where no rate of a formula is meant."""
    text = re.sub(r"(?<!\w)\((\w+)\)(?=['’′])", r"\1", node.value)
    total = _TOTAL_RATE.search(text)
    if total is None or {"d", "dt"} & scope.kinds.keys():
        return None
    if _LAGRANGE.search(text):
        hint = "leave it out, or give the force alone"
        return Diagnostic("the equations of motion are derived", node.span, hint)
    inner = [next(filter(None, each.groups())) for each in _TOTAL_RATE.finditer(text)]
    taken = {*scope.kinds, *re.findall(r"[^\W\d]\w*", node.text.source.text)}
    names = dict(zip(dict.fromkeys(inner), (x for x in _FRESH if x not in taken), strict=False))
    hint = "a total time derivative is the prime of a definition"
    if {*inner} <= names.keys():
        whole = _TOTAL_RATE.sub(lambda rate: f"{names[next(filter(None, rate.groups()))]}'", text)
        given = ", ".join(f"{name}: {formula}" for formula, name in names.items())
        given = f"under definitions {given}" if scope.definitions else f"definitions: {{{given}}}"
        hint = f"{hint}: {given} and here {whole.strip()}"
    rate = "the prime" if total["primed"] else "'d/dt'"
    return Diagnostic(f"{rate} of a formula has no meaning", node.span, hint)


def _energy_meant(
    found: list[Diagnostic], node: Scalar, what: str, scope: Scope, role: Role
) -> Diagnostic | None:
    """An energy by momenta, or with accelerations, as one by velocities; None for others."""
    names = _vocabulary(scope, role)
    accelerated = [each for each in found if each.message.startswith("the acceleration ")]
    try:
        whole = translated(node.value, names._replace(momenta=not accelerated))
    except UnclearText:
        return None
    if accelerated:
        alone = {*re.findall(r"(\w+)''(?!\^)", whole)}
        if any(re.search(rf"(?<!\w){x}(?![\w'])", whole) for x in alone):
            return None  # x''*x
        better = re.sub(r"(\w+)''(?:\^2)?(?!\^)", r"\1'^2", whole)
        hint = f"write {better}: {what} has velocities"
        return replace(accelerated[0], hint=hint) if _is_read(better, scope, role, what) else None
    momenta = [f"p_{x}" for x in names.coordinates if re.search(rf"(?<!\w)p_{x}(?!\w)", whole)]
    if not momenta or "'" in whole or momenta[0] in scope.kinds:
        return None
    better = with_velocities(whole)
    by_momenta = f"H: {whole} + V in place of T and V, with V written out"
    hint = f"give H in place of L: momenta such as {momenta[0]} stand there"
    if better and _is_read(better, scope, role, what):
        hint = f"write {better}" + f", or give {by_momenta}" * (what == "T")
    elif what == "T":
        hint = f"give {by_momenta}"
    return Diagnostic(f"the momentum '{momenta[0]}' cannot stand in {what}", node.span, hint)


def _hamiltonian_meant(text: str) -> str:
    """`m*(p_x/m)^2/2 + k*x^2/2` for `m*x'^2/2 + k*x^2/2`; nothing without squares of velocities."""
    source = SourceText.of(Source("", text))
    moving = [each for each in terms_of(formula_or_none(text) or ZERO) if has_velocity(each)]
    kinetic = Sum(tuple(moving)) if moving[1:] else next(iter(moving), None)
    return "" if kinetic is None else with_momenta(text, kinetic, source)


def _with_energies(text: str, scope: Scope) -> str:
    """The text with the formulas of the file for T and V, which are no names."""

    def formula(found: re.Match[str]) -> str:
        written = "" if found[0] in scope.kinds else scope.energies.get(found[0], "").strip()
        is_sum = re.search(r"\S\s*[-+]|^-", written) is not None
        return f"({written})" if is_sum else written or found[0]

    return re.sub(r"(?<!\w)[TV](?![\w'’(])", formula, text)


def _is_read(text: str, scope: Scope, role: Role, what: str) -> bool:
    """Whether a text is a formula whose names are all known."""
    formula = formula_or_none(text)
    return formula is not None and not any(True for _ in name_mistakes(formula, scope, role, what))


def _exchanged(
    text: str,
    scope: Scope,
    role: Role,
    what: str,
    read: Callable[[Excerpt], Expression | Equation | Inequality],
) -> str:
    """The only formula without a mistake that two exchanged neighbours lead to: `co(sphi)`."""
    found: dict[str, str] = {}
    for place in range(len(text) - 1 if len(text) <= _LONGEST_EXCHANGED else 0):
        before, one, other, after = text[:place], text[place], text[place + 1], text[place + 2 :]
        is_number = re.match(r"\d[^^')]|[^(^']\d", one + other)
        changed = f"{before}{other}{one}{after}"
        if one == other or " " in {one, other} or is_number or "**" in changed:
            continue
        try:
            sides = sides_of(read(Excerpt.whole(Source("", changed))))
        except Mistake:
            continue
        if not any(True for side in sides for _ in name_mistakes(side, scope, role, what)):
            found[str(sides)] = changed
    return found.popitem()[1] if len(found) == 1 else ""


def _written(value: str, scope: Scope, *, equation: bool) -> list[str]:
    """The text with names that can be declared, and without `T =` before it."""
    if len(value) > _LONGEST_GIVEN:
        return []
    for each in scope.refused:
        if re.search(r"\w[ .-]\w", each):
            value = re.sub(rf"(?<!\w){re.escape(each)}(?!\w)", name_meant(each, one=True), value)
    value = _MULTIPLIER.sub("", value) if equation else value
    value = re.sub(
        r"\\(?:math(?:cal|scr|rm)|cal)\s*(?:\{\s*([^\W\d])\s*\}|\s([^\W\d])\b)", r"\1\2", value
    )
    if "u" not in scope.kinds and scope.energies.get("T") == value:
        value = re.sub(r"(?<![^\W_])u(?![\w(])", "v", value)  # of m*u^2/2
    value = re.sub(r"&\s*=|=\s*&", "=", re.sub(r"\\\\\s*$", "", value))  # of an alignment
    value = _COMMENT.sub("", value)
    value = value if re.search("[<>]", value) else _GOES_ON.sub(" ", value)
    sides = re.split("==?", value)
    if equation and len(sides) == 3 and re.fullmatch(r"\s*\w+\([\w, ]*\)\s*", sides[0]):
        return ["=".join(sides[1:])]  # f(x, y) = … = 0
    value = re.sub(r"^[\"“”„«](.*)[\"“”»]$|(?<=[^\W\d])\.$", r"\1", value.strip())
    if equation and (both := _BOTH_ROOTS.fullmatch(value)):
        left = both["left"].strip()
        left = left if re.fullmatch(r"\w+'*", left) else f"({left})"
        value = f"{left}^2 = {both['inner']}"
    value = as_equation(behind_words(without_cases(value), scope.kinds))
    return [value] if equation else [value, _LEFT_SIDE.sub("", value)]


def _is_undeclared(mistake: Diagnostic, role: Role, words: set[str]) -> bool:
    """Whether a name is not declared that the author has written: another mistake."""
    is_open = UNDECLARED in mistake.hint or mistake.hint == COORDINATE
    undeclared = role.order >= 0 and is_open and _named_in(mistake) <= words
    return undeclared or mistake.message.startswith("the acceleration ")


def _named_in(mistake: Diagnostic) -> set[str]:
    """The name that a message is about; those behind it are of its place."""
    return set(re.findall(r"'([^ ]+)'", mistake.message)[:1])


def _vocabulary(scope: Scope, role: Role) -> Vocabulary:
    coordinates = (*scope.coordinates,)
    functions = frozenset(scope.of_kind("function"))
    refused = [name for each in scope.refused if (name := name_meant(each, one=True))]
    usable = {*scope.usable(role), *refused} - {*coordinates} - functions
    return Vocabulary(
        coordinates, frozenset(usable), functions, role.momenta, scope.components, scope.moving
    )
