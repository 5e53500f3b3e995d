"""The section `constraints`."""

from __future__ import annotations

import re
from itertools import pairwise

from lagcli.expression import ZERO, Expression, Name, name_nodes
from lagcli.problem_data import Constraint, ForceKind, Inequality, OnLoss, pushing_sign
from lagcli.reader.assignments import pieces
from lagcli.reader.contacts import RESTITUTION, Declared, contacts_for, declared, read_restitution
from lagcli.reader.expressions import signed_terms
from lagcli.reader.file_reader import FileReader
from lagcli.reader.friction_meant import FRICTION_WORD
from lagcli.reader.habits import comparisons_in
from lagcli.reader.misplaced import in_section
from lagcli.reader.misshapen import as_equation, as_flow, inner_of, is_sentence, source_of, texts_of
from lagcli.reader.names import derivative_order
from lagcli.reader.nodes import DocumentNode, Scalar, lines_of
from lagcli.reader.regex import regex
from lagcli.reader.scope import QUESTION, STATE
from lagcli.reader.text import numbered
from lagcli.reader.velocity_quotients import multiplied_out, without_squares

_CONSTRAINT_ATTRIBUTES = ("equation", "multiplier", "holds_while", "on_loss", RESTITUTION,
                          "acts_as")  # fmt: skip
_MULTIPLIER = r"(?:lambda|lam|Lambda|mu|λ|Λ|μ)_?\d?"
_LAW = r"\((?P<{}>(?:[^()]|\([^()]*\))*)\)"
#: A term with a multiplier, `+ lambda*(x - l)`.
_WITH_MULTIPLIER = regex(
    rf"(?:^\s*|\s*[-+]\s*)(?:[\d./]+\s*\*\s*)?(?:(?P<name>{_MULTIPLIER})\s*\*?\s*{_LAW.format('law')}"
    rf"|{_LAW.format('before')}\s*\*\s*(?P<behind>{_MULTIPLIER}))(?:\s*/\s*\d+)?(?=\s*(?:[-+]|$))"
)
_ON_LOSS = ("stop", "release")
_OF_CONTACT = ("multiplier", RESTITUTION)
_INEQUALITY = regex(r"(?<!-)[<>]|[≤≥]")
_A_CONTACT = "an inequality is a contact, not a constraint"
_FORMULA = regex("[-+*/^=(]")
_ROLLING = "equation, as in rolling: x' = R*theta'"
_FORCES: dict[str, ForceKind] = {"normal": "normal", "friction": "friction", "tension": "tension"}


def declare_constraints(file: FileReader, node: DocumentNode) -> list[Declared]:
    """Enter the multipliers into the scope."""
    texts = [re.sub("={2,}", "=", as_equation(each)) for each in texts_of(node)]
    given = [part.strip() for each in texts for part in equations_in(each)]
    given = [each for each in given if _FORMULA.search(each)] or [_ROLLING]
    constants = set()
    if given != [_ROLLING]:  # the file is refused
        from lagcli.reader.repair import DECLARE, with_constant

        named_ = [with_constant(each, file.scope, is_equation=True) for each in given]
        given = [whole for whole, _ in named_]
        constants = {DECLARE.format(name) for _, name in named_ if name}
    names = [f"c{place}" for place in range(1, len(given) + 1)] if given[1:] else ["name"]
    written = ", ".join(map("{}: {}".format, names, given))
    hint = f"write {{{written}}}" if given[1:] or constants else f"write {written}"
    hint = ", ".join([hint, *constants])
    if any(map(_INEQUALITY.search, texts)):
        gaps = [gap for each in given for gap in comparisons_in(each) if _INEQUALITY.search(gap)]
        laws = [each for each in given if not _INEQUALITY.search(each)]
        hint = _elsewhere(file, "contacts", [contacts_for("floor", gaps, {})], 1 + len(laws))
        listed = ", ".join(map("{}: {}".format, names, laws))
        file.error(_A_CONTACT, node.span, hint.replace("leave it out", f"write {{{listed}}}"))
        return []
    named = file.named(node, "constraints", _CONSTRAINT_ATTRIBUTES, hint)
    entries = file.of_section(named, "constraints", _CONSTRAINT_ATTRIBUTES)
    for (name, equation), (key, value) in pairwise(entries):
        if key.in_flow and value.is_empty and isinstance(equation, Scalar):  # {rod: x = l, N}
            inner = f"{{equation: {equation.value}, multiplier: {key.label}}}"
            file.error("a comma ends the equation", key.span, f"write {name.label}: {inner}")
            entries = [entry for entry in entries if entry[0] is not key]
    contacts: list[tuple[Scalar, str]] = []
    entries = [entry for entry in entries if not _is_condition(file, *entry, entries)]
    kept = [entry for entry in entries if not _is_refused(file, *entry, contacts)]
    if contacts:
        hint = _elsewhere(file, "contacts", [text for _, text in contacts], len(entries))
        file.error(_A_CONTACT, contacts[0][0].span, hint)
    found = (declared(file, *entry, "multiplier", _CONSTRAINT_ATTRIBUTES) for entry in kept)
    return [one for one in found if one is not None]


def _elsewhere(file: FileReader, key: str, moved: list[str], entries: int) -> str:
    """Where some of the entries belong, as contacts or forces."""
    return in_section(key, moved, "constraints", entries, is_given=key in file.sections)


def check_multipliers(file: FileReader, energies: list[Scalar]) -> None:
    """An energy has no `lambda*(x^2 + y^2 - l^2)`: its equation is a constraint."""
    coordinates = {*file.scope.coordinates}
    for node in energies:
        laws = []
        for found in _WITH_MULTIPLIER.finditer(node.value):
            name, law = found["name"] or found["behind"], found["law"] or found["before"]
            is_law = coordinates & {*re.findall(r"\w+", law)} and name not in file.scope.kinds
            laws += [(found, name, equation)] if is_law and (equation := _equated(law)) else []
        if not laws:
            continue
        rest = node.value
        for found, name, _ in reversed(laws):
            rest = rest[: found.start()] + rest[found.end() :]
            file.scope.kinds[name] = "parameter"  # which is no other mistake
        named = ", ".join(f"c{place}: {law}" for place, (*_, law) in enumerate(laws, start=1))
        whole = f"on a line of its own constraints: {{{named}}}"
        whole = f"in constraints {named}" if "constraints" in file.sections else whole
        message = f"the multiplier '{laws[0][1]}' of a constraint stands in an energy"
        rest = re.sub(r"^\s*\+\s*", "", rest).strip()
        term = laws[0][0]
        place = node.excerpt().span(term.end() - len(term[0].lstrip(" +-")), term.end())
        file.error(message, place, f"write {rest or 'the energy'}, and {whole}")


def _equated(law: str) -> str:
    """`x^2 + y^2 = l^2` for `x^2 + y^2 - l^2`; nothing for what is no sum."""
    terms = signed_terms(law)
    left, right = (" + ".join(x for minus, x in terms if minus == on_right) or "0"
                   for on_right in (False, True))  # fmt: skip
    return f"{left} = {right}" if terms[1:] else ""


def _is_condition(
    file: FileReader, key: Scalar, value: DocumentNode, entries: list[tuple[Scalar, DocumentNode]]
) -> bool:
    """Whether an entry is an inequality of the multiplier of another one, as in N >= 0."""
    for other, node in entries:
        given = inner_of(node, "equation")
        force = re.escape(given.get("multiplier", f"lambda_{other.label}"))
        if other is not key and re.match(rf"-?\s*{force}\s*[<>≤≥]", getattr(value, "value", "")):
            whole = f"{other.label}: {as_flow(given | {'holds_while': source_of(value)})}"
            hint = f"leave it out, and in {lines_of(other, node)} write {whole}"
            file.error(f"'{key.label}' is the condition of '{other.label}'", key.span, hint)
            return True
    return False


def _is_refused(
    file: FileReader, key: Scalar, value: DocumentNode, contacts: list[tuple[Scalar, str]]
) -> bool:
    """Whether an entry is no constraint: a contact, which is added, or several constraints."""
    parts = {k.label: v for k, v in value.pairs}
    node = parts.get("equation", value)
    written = node.value if isinstance(node, Scalar) else ""
    if re.search("[<>≤≥]", key.label):  # {x <= 1}
        written = key.label
    statements = [x for each in equations_in(written) for x in comparisons_in(each)]
    gaps = [each for each in statements if _INEQUALITY.search(each)]
    equations = [re.sub("={2,}", "=", each) for each in statements if each not in gaps]
    if gaps and not is_sentence(written, file.scope.kinds):
        attributes = {name: source_of(parts[name]) for name in _OF_CONTACT if name in parts}
        name = key.label if key.label.isidentifier() else "floor"
        if not equations:
            text = contacts_for(name, gaps, attributes)
            if contacts:  # which may be lower and upper as well
                text = text.replace("lower: ", f"{name}_1: ").replace("upper: ", f"{name}_2: ")
            contacts.append((key, text))
        else:
            law, multiplier = equations[0], attributes.pop("multiplier", "")
            law = f"{{equation: {law}, multiplier: {multiplier}}}" if multiplier else law
            hint = _elsewhere(file, "contacts", [contacts_for(f"{name}_2", gaps, attributes)], 2)
            hint = hint.replace("leave it out", f"write {name}: {law}")
            file.error(_A_CONTACT, key.span, "" if equations[1:] else hint)
        file.scope.refused.append(attributes.get("multiplier", f"lambda_{key.label}"))
        return True
    if equations[1:]:
        hint = f"each equation has its own name: {numbered(key.label, equations)}"
        file.error(f"'{key.label}' has several equations", key.span, hint, refused="")
    return bool(equations[1:])


def equations_in(text: str) -> list[str]:
    """The equations that a comma, a semicolon, `and` or a line separates; else the whole text."""
    lines = re.sub(r"\s+(?:and|und|et)\s+|\n", ", ", text.strip())
    parts = pieces(lines, ",;")
    whole = [each.strip(" ,;") for each in parts]
    return whole if all(re.search("[=<>≤≥]", each) for each in whole) else [text]


def read_constraints(file: FileReader, given: list[Declared]) -> tuple[Constraint, ...]:
    """The constraints f = left - right = 0."""
    constraints = []
    squared: list[tuple[Scalar, Scalar]] = []
    for one in given:
        node = one.attributes.get("equation")
        if node is None:
            continue
        name = one.key.label
        law, remark = _law_of_force(file, node, name)
        if law:
            hint = _elsewhere(file, "forces", [law], len(given)) + remark
            file.error(f"'{name}' is the law of a force, not a constraint", node.span, hint)
            continue
        mistakes = len(file.diagnostics)
        equation = file.equation(node, f"the constraint '{name}'", STATE)
        is_read = len(file.diagnostics) == mistakes and not getattr(node, "broken", False)
        if is_read and not file.scope.refused:
            sides = (equation.left, equation.right)
            moving = {n for n in name_nodes(*sides) if derivative_order(n, file.scope) >= 0}
            if len(moving) == 1:  # r = R
                file.scope.held |= {n.name for n in moving if not n.primes}
            if max(derivative_order(side, file.scope) for side in sides) < 0:
                message = f"the constraint '{name}' contains no coordinate"
                alone = isinstance(equation.left, Name) and equation.right == ZERO
                file.error(message, node.span, _of_length(file, str(equation.left) * alone))
            elif isinstance(node, Scalar) and (whole := multiplied_out(node.value, file.scope)):
                file.error(f"'{name}' divides by velocities", node.span, f"write {whole}")
        holds_while = None
        if "holds_while" in one.attributes:
            holds_while = file.comparison(one.attributes["holds_while"], "'holds_while'", QUESTION)
        on_loss, force = _on_loss(file, one), one.attributes.get("acts_as")
        acts_as = _FORCES.get(file.word(force, "'acts_as'", _FORCES) or "") if force else None
        constraints.append(
            Constraint(
                name=name,
                equation=equation,
                multiplier=one.multiplier,
                holds_while=holds_while,
                on_loss=on_loss,
                restitution=_restitution(file, one, holds_while, on_loss),
                acts_as=acts_as,
                span=one.key.span,
            )
        )
        if (
            is_read
            and isinstance(node, Scalar)
            and derivative_order(equation.left, file.scope) == 1
        ):
            squared.append((one.key, node))
    for key, node in squared:
        others = [each.equation for each in constraints if each.name != key.label]
        if whole := without_squares(key.label, node.value, others, file.scope):
            span = node.span if whole.startswith("write") else key.span
            file.error(f"'{key.label}' is not linear in the velocities", span, whole)
    return tuple(constraints)


def _of_length(file: FileReader, name: str) -> str:
    """`write x^2 + y^2 = l^2` for a parameter l beside Cartesian coordinates."""
    axes = [x for x in "xyz" if file.scope.kinds.get(x) == "coordinate"]
    if file.scope.kinds.get(name) != "parameter" or len(axes) < 2:
        return "a value stands under 'parameters', as in l: 1"
    squares = " + ".join(f"{x}^2" for x in axes)
    return f"a constraint is an equation of coordinates, as in {squares} = {name}^2"


def _law_of_force(file: FileReader, node: DocumentNode, name: str) -> tuple[str, str]:
    """`s: -mu*m*g*sign(s')` for `friction: F_R = mu*m*g`, and a remark; nothing for constraints."""
    written = node.value if isinstance(node, Scalar) else ""
    found = re.fullmatch(r"\s*([^\W\d]\w*)\s*=+\s*[-−]?\s*([^=<>]+?)\s*", written)
    if found is None or found[1] in file.scope.kinds or file.scope.refused:
        return "", ""
    if not (FRICTION_WORD.search(name) or re.fullmatch(r"F_?(?:R|f|fr|r)", found[1])):
        return "", ""
    along, size = next(iter(file.scope.coordinates), "x"), found[2]
    backwards = "" if re.search(rf"(?<!\w){along}'", size) else f"*sign({along}')"
    is_open = "N" not in file.scope.kinds and re.search(r"(?<!\w)N(?!\w)", size)
    normal = ", with the normal force N written out, m*g on a level floor" if is_open else ""
    return f"{along}: -{size}{backwards}", normal


def _on_loss(file: FileReader, one: Declared) -> OnLoss:
    """What a run does where the contact is lost; with `release` all other keys go."""
    if (node := one.attributes.get("on_loss")) is None:
        return "stop"
    if "holds_while" not in one.attributes and not node.is_empty:
        file.error("'on_loss' needs 'holds_while'", node.span, "write holds_while: N >= 0")
    return "stop" if file.word(node, "'on_loss'", _ON_LOSS) == "stop" else "release"


def _restitution(
    file: FileReader, one: Declared, holds_while: Inequality | None, on_loss: OnLoss
) -> Expression | None:
    """Of the impact that closes a contact again which has been released."""
    node = one.attributes.get(RESTITUTION)
    if node is None:
        return None
    if on_loss != "release":
        message = "'restitution' is of a contact that is released and closes again"
        file.error(message, node.span, "write on_loss: release")
    elif holds_while is not None and pushing_sign(one.multiplier, holds_while) is None:
        message = f"which side of '{one.key.label}' is open does not follow from 'holds_while'"
        hint = f"write holds_while: {one.multiplier} >= 0, or <="
        file.error(message, node.span, hint)
    return read_restitution(file, node, f"the constraint '{one.key.label}'")
