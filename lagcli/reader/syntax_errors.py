"""What is wrong with an expression that does not parse, and what was probably meant."""

from __future__ import annotations

import re
from itertools import pairwise

from lagcli.diagnostics import Diagnostic, Span
from lagcli.expression import FUNCTIONS
from lagcli.reader.automaton import Token, Unexpected
from lagcli.reader.habits import (
    CASE,
    CASES,
    COMMENT,
    DERIVED,
    REMARK,
    habits,
    instead,
    meanings,
    superscript,
    unit_behind,
    with_mixed_numbers,
)
from lagcli.reader.positions import Excerpt
from lagcli.reader.regex import regex

_END_VALUE = frozenset({"NUMBER", "NAME", "RPAR"})
_BEGIN_VALUE = frozenset({"NUMBER", "NAME", "LPAR"})
#: A number in powers of ten that is not written as one: 2.0e, 2e - 3, 1.5d-3; 6.67 x 10^-11.
_EXPONENT = regex(r"([\d.]+)(?:\s*([eE])\s*|([dD])(?=[-+\d]))([-+]?)\s*(\d*)(?![\w(.'])")
_TIMES_TEN = regex(r"([\d.]+)\s*[xX]\s*10\s*(?:\^|\*\*|[eE])?\s*[({]?\s*(-?)[\s+]*(\d+)")
#: Before a factor of a denominator, as in p^2/2m, where 1/2m may be a half of m.
_DENOMINATOR = regex(r"(?:[\w.]*[^\W\d][\w.']*|[)'²]|\^\s*\d)\s*/\s*$")

_ONE_SIGN = "write one sign: each is a problem of its own"


def explain(error: Unexpected, tokens: list[Token], excerpt: Excerpt, start: str) -> Diagnostic:
    """The sentence for a syntax error of an `expression`, an `equation` or a `comparison`.

    The tokens are those up to the first character that begins none.
    """
    if not excerpt.value.strip():
        return Diagnostic(f"an empty {start}", excerpt.everything)
    token = error.token
    if token is None:
        if error.place == len(excerpt.value):
            return _unexpected_end(tokens, excerpt)
        return _unexpected_character(error.place, tokens, excerpt)
    place = next(i for i, other in enumerate(tokens) if other.start_pos == token.start_pos)
    previous = tokens[place - 1] if place else None
    if previous is not None and previous.type in _END_VALUE and token.type in _BEGIN_VALUE:
        following = tokens[place + 1] if place + 1 < len(tokens) else None
        if place >= 3 and tokens[place - 2].type == "_POWER" and tokens[place - 3] in FUNCTIONS:
            function = tokens[place - 3]
            return Diagnostic(f"'{function}' needs arguments", _span(function, excerpt))
        if [str(other) for other in tokens[place - 3 : place]] == ["^", "-", "1"]:
            function = tokens[place - 4]
            return Diagnostic(f"'{function}' needs arguments", _span(function, excerpt))
        if CASES & {str(previous), str(token)} and (hint := instead(_called(tokens[:place]))):
            return Diagnostic("a formula has no loops", _span(token, excerpt), hint)
        return _missing_product(previous, token, following, excerpt)
    if token.type == "COMPARISON" and CASES & {str(other) for other in tokens}:
        return Diagnostic("a formula has no cases", _span(token, excerpt), CASE)
    if [str(other) for other in tokens[place - 1 : place + 1]] == ["-", ">"]:
        return Diagnostic("'->' has no meaning", _span(token, excerpt), "write '='")
    if token.type == "COMPARISON":
        message = f"'{token}' stands only in 'holds_while' and in the gap of a contact, and once"
        hint = "each stands by itself, under its own name" if start == "comparison" else CASE
        if re.fullmatch(r"\s*\w*\s*(?:<=|≤)\s*0\s*", excerpt.value) and start == "expression":
            hint = "write {assume: real}: no assumption says <= 0"
        if start == "expression" and re.search(r"<[^<>]+>", excerpt.value):
            hint = "group with parentheses ( ), without '<' and '>'"
        return Diagnostic(message, _span(token, excerpt), hint)
    following = tokens[place + 1] if place + 1 < len(tokens) else None
    whole = " ".join(excerpt.value.split())
    message, hint = _unexpected(token, tokens[:place], start, following, whole)
    return Diagnostic(message, _span(token, excerpt), hint)


def _unexpected_character(at: int, tokens: list[Token], excerpt: Excerpt) -> Diagnostic:
    character = excerpt.value[at]
    span = excerpt.span(at, at + 1)
    shown = f"'{character}'" if character.isprintable() else f"U+{ord(character):04X}"
    if character == "'":
        if re.match(r"'\d{3}", excerpt.value[at:]) and tokens and tokens[-1].type == "NUMBER":
            return Diagnostic("digits are not grouped by a prime", span)
        hint = "a prime stands right behind a name; an expression has one under 'definitions'"
        return Diagnostic("a prime without a name", span, hint)
    if not character.isprintable():
        return Diagnostic(f"{shown} has no meaning in an expression", span, "leave it out")
    if character in '"“”„' and not (tokens and tokens[-1].type == "NAME"):
        return Diagnostic("quotes are not part of a formula", span, "leave them out")
    if character == "#":
        remark = excerpt.value[at:]
        hint = f"leave out '{remark}'" if excerpt.in_flow else ""
        hint = hint or f"a comment has a blank before it: write {excerpt.value[:at]} {remark}"
        return Diagnostic(f"{shown} has no meaning in an expression", span, hint)
    if REMARK.search(excerpt.value):
        return Diagnostic("a remark is no part of a formula", span, COMMENT)
    if character in "≈≃≅" and not tokens:
        return Diagnostic(f"{shown} has no meaning in an expression", span, "leave it out")
    if character in "°˚":
        return Diagnostic("angles are in radians", span)
    hint = _character_meant(excerpt.value[at:], tokens) or meanings("characters").get(character, "")
    return Diagnostic(f"{shown} has no meaning in an expression", span, hint)


def _character_meant(rest: str, tokens: list[Token]) -> str:
    """What is done instead, where no formula is meant that could be written here."""
    before = tokens[-1].type if tokens else ""
    if before in _END_VALUE:
        if re.match(r"[%!]\s*[A-Za-z]", rest):
            return COMMENT
        unit = re.match(r"\[([^\[\]]+)\]\s*$", rest)
        if unit and unit_behind(f"1 {unit[1]}"):
            return f"leave out '{unit[0].strip()}': units stand where names are declared"
    elif rest[0] in "±∓":
        return _ONE_SIGN
    return next((hint for form, hint in habits()["signs_of_others"] if re.match(form, rest)), "")


def _unexpected_end(tokens: list[Token], excerpt: Excerpt) -> Diagnostic:
    """The text ends too early: an open parenthesis, or an operator without its right side."""
    last = tokens[-1]
    if last.type not in _END_VALUE:
        hint = f"write what follows, or leave out '{last}'"
        return Diagnostic(f"nothing follows '{last}'", _span(last, excerpt), hint)
    open_ = _open_parenthesis(tokens)
    if open_ is not None:
        missing = ")" * (excerpt.value.count("(") - excerpt.value.count(")"))
        whole = " ".join(excerpt.value.split()) + missing
        inner = excerpt.value[open_.end_pos :]
        if missing == ")" and re.fullmatch(r"[^/]*[\w')]\s*\+[^/]*/\s*2\s*", inner):
            whole = re.sub(r"\s*/\s*2\)$", ")/2", whole)  # m*(x'^2 + y'^2/2
        hint = f"did you mean {whole}?"
        if excerpt.in_flow and re.match(r"\s*,", excerpt.text.source.text[excerpt.offsets[-1] :]):
            hint = "inside { } and [ ] a comma ends the value: put it in quotes"
        return Diagnostic("this parenthesis is never closed", _span(open_, excerpt), hint)
    hint = "such as N >= 0"
    return Diagnostic("a comparison is missing", excerpt.everything, hint)


def _missing_product(
    left: Token, right: Token, following: Token | None, excerpt: Excerpt
) -> Diagnostic:
    span = excerpt.span(left.start_pos, right.end_pos)
    apart = left.end_pos < right.start_pos
    # th may as well be an angle
    known = str(left) if len(left) == 2 and left != "ln" else meanings("functions").get(left, left)
    if left.type == "NAME" and known in FUNCTIONS:
        message = f"the argument of {left} stands in parentheses"
        return Diagnostic(message, span, f"did you mean {known}({right})?")
    for pair, text, message, hint in habits()["side_by_side"]:
        beside = re.fullmatch(pair, f"{left} {right}")
        if beside and (within := re.search(text, excerpt.value)):
            return Diagnostic(message, span, (within if text else beside).expand(hint))
    if str(left) == "lambda" and ":" in excerpt.value:
        written = excerpt.value.partition(":")[2].strip()
        return Diagnostic("a formula is no program", span, f"write {written}")
    between = slice(excerpt.offsets[left.end_pos - 1], excerpt.offsets[right.start_pos])
    if "\n" in excerpt.text.source.text[between]:
        hint = "begin the second line with its sign, as in + x"
        return Diagnostic("two lines without a sign between them", span, hint)
    if apart and REMARK.search(excerpt.value):
        return Diagnostic("a remark is no part of a formula", span, COMMENT)
    rest = excerpt.value[left.start_pos :]
    if left.type == "NUMBER" and (one := with_mixed_numbers(rest)) != rest:
        whole = excerpt.value[: left.start_pos] + one
        return Diagnostic("a number is one number of digits", span, f"write {whole}")
    if right.type == "NAME" and (number := _EXPONENT.match(rest)):
        value, e, d, sign, digits = number.groups()
        hint = f"write {value}e{sign}{digits}" if digits else f"as in {value}e-3"
        message = "an exponent is written e and a whole number, without blanks"
        return Diagnostic(message, span, f"{hint}; a product is {value}*{e or d}")
    if right.type == "NAME" and (number := _TIMES_TEN.match(rest)):
        hint = f"write {number[1]}e{number[2]}{number[3]}"
        return Diagnostic("a power of ten is written with e", span, hint)
    before = left.replace("′", "'") if left.type != "RPAR" else "(…)"
    if str(right) in {"rad", "radian", "radians", "deg", "degree", "degrees", "º"}:
        return Diagnostic("angles are in radians", span)
    if left.type == "NUMBER" and right.type == "NUMBER":
        grouped = f"write {left}{right}" if len(right) == 3 else f"did you mean {left}*{right}?"
        hint = grouped if apart else "a number has one decimal point"
        return Diagnostic("two numbers side by side", span, hint)
    if left.type == "NUMBER" and right.startswith("_") and not apart:
        return Diagnostic("digits are not grouped by '_'", span)
    if str(left).endswith("'") and right.type == "NUMBER" and not apart:
        return Diagnostic("a power is written with '^'", span, f"did you mean {left}^{right}?")
    if superscript(right):
        return Diagnostic("a power is written with '^'", span)
    after = str(right) if right.type != "LPAR" else "(…)"
    is_before = following is not None and right.end_pos == following.start_pos
    if right.type == "NAME" and is_before and following and following.type == "LPAR":
        after += "(…)"
    message = f"a '*' is missing between '{left}' and '{right}'"
    unit = left.type == "NUMBER" and len(right) > 1 and unit_behind(f"1 {right}")
    stands = f"; the unit {right} stands where a name is declared" if unit else ""
    product = f"{before}*{after}"
    if not apart and _DENOMINATOR.search(excerpt.value[: left.start_pos]):
        product = f"({product})"  # p^2/2m
    return Diagnostic(message, span, f"did you mean {product}?{stands}")


def _unexpected(
    token: Token, before: list[Token], start: str, following: Token | None, written: str
) -> tuple[str, str]:
    """Sentence and advice for a token that cannot stand where it stands."""
    previous = before[-1] if before else None
    inside = _open_parenthesis(before)
    if token.type == "RPAR":
        if inside is None:
            return "this parenthesis was never opened", f"did you mean ({written}?"
        if previous is not None and previous.type == "LPAR":
            return "nothing stands between the parentheses", "leave them out"
        return f"nothing stands between '{previous}' and ')'", f"leave out '{previous}'"
    if token.type == "EQUAL":
        if previous is not None and previous.type == "EQUAL":
            return "'==' has no meaning", "an equation is written with one '='"
        if start == "equation" and inside is None and previous is not None:
            sides = [each.strip() for each in written.split("=")]
            each_ = " and ".join(map(" = ".join, pairwise(sides)))
            hint = "an equation of its own for each"
            return "an equation has one '='", f"{hint}: {each_}" if all(sides) else f"write {hint}"
        if name := _called(before):
            return "an argument of a function has no name", instead(name) or "write the value alone"
        if start == "equation" and inside is not None:
            return "'=' stands inside parentheses", "is a ')' missing before it?"
        alone = len(before) == 1 and previous is not None and previous.type == "NAME"
        if alone and str(previous).endswith("''"):
            return "an equation of motion is no formula", DERIVED
        hint = f"leave out '{previous} ='" if alone else "leave out '=' and what follows it"
        if following is not None and str(following) in {">", "<"}:
            hint = f"a relation is written {following}="
        return "'=' stands only in constraints and equations", hint
    several = token.type == "COMMA" and "EQUAL" in {each.type for each in before}
    if several and (named := re.fullmatch(r"([^,]*=[^,]*?)\s*,\s*(\w+)", written)):
        hint = f"write {{equation: {named[1]}, multiplier: {named[2]}}}"
        return "a comma ends the equation", hint
    if several and start == "equation" and inside is None:
        return "two equations in one", "each stands by itself, under its own name"
    if token.type == "COMMA" and previous is not None and previous.type in _END_VALUE:
        if CASES & {str(other) for other in before}:
            return "a formula has no cases", CASE
        if inside is not None and not _called(before):
            return "a list is no value", "write one value, without parentheses"
        hint = "leave out ','"
        if previous.type == "NUMBER" and following is not None and following.type == "NUMBER":
            hint = f"a decimal point is written '.': write {previous}.{following}"
            grouped = f", or {previous}{following} for thousands"
            hint += grouped if re.fullmatch(r"\d{3}", following) else ""
        return "a comma stands only between the arguments of a function", hint
    if previous is None:
        return f"nothing stands before '{token}'", f"leave out '{token}'"
    hint = COMMENT if f"{previous}{token}" in {"//", "/*"} else f"leave out '{token}'"
    return f"'{token}' cannot follow '{previous}'", hint


def _open_parenthesis(tokens: list[Token]) -> Token | None:
    """The innermost parenthesis that is not closed."""
    opened: list[Token] = []
    for token in tokens:
        if token.type == "LPAR":
            opened.append(token)
        elif token.type == "RPAR" and opened:
            opened.pop()
    return opened[-1] if opened else None


def _called(tokens: list[Token]) -> str:
    """The function inside of whose innermost parenthesis the tokens end; nothing outside."""
    inside = _open_parenthesis(tokens)
    before = [each for each in tokens if inside is not None and each.end_pos == inside.start_pos]
    return str(before[0]) if before and before[0].type == "NAME" else ""


def _span(token: Token, excerpt: Excerpt) -> Span:
    return excerpt.span(token.start_pos, token.end_pos)
