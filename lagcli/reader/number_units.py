"""Units behind numbers, which stand where names are declared."""

from __future__ import annotations

import re
from collections.abc import Container
from fractions import Fraction
from math import pi

from lagcli.diagnostics import Diagnostic
from lagcli.reader.habits import (
    habits,
    is_angle,
    is_unit,
    meanings,
    number_and_unit,
    spoken_unit,
    unit_at_end,
    unit_behind,
    with_mixed_numbers,
)
from lagcli.reader.nodes import DocumentNode, Scalar
from lagcli.reader.regex import regex

_COUNT = regex(r"([\d.]+(?:[eE][-+]?\d+)?)\s*(?![eE]\d+$)([^\W\d]\w*)")
_ANGLE = regex(r"(?:deg|rpm|turn)(?:[/*].*)?")
#: Of an angle, turns in a time.
_TURNS = regex(r"min\^-1|1/min|Hz")
#: A quantity within a formula: the 9.81 m/s² of `m*9.81 m/s²*x`.
_UNIT_WITHIN = regex(
    r"([\d.]+)\s+((?:[A-Za-z]+\s)?[A-Za-z]+(?:/[A-Za-z]+(?:\^?-?\d|[²³])?)+"
    r"|kg|[cmk]m|k?Hz|k?N|k?J|k?W|k?Pa)(?![\w(])"
)
#: The letter of a quantity by its unit.
_LETTERS = {
    "kg": "m", "N": "F", "kN": "F", "N/m": "k", "N/cm": "k", "kg/s": "c", "m/s": "v",
    "rad/s": "omega", "Hz": "f", "J": "E", "W": "P",
}  # fmt: skip
#: A number that is converted: not one of a thousand digits.
_NUMBER = regex(r"[-+]?(?:\d{1,20}\.?\d{0,20}|\.\d{1,20})(?:[eE][-+]?\d{1,2}|/[1-9]\d{0,20})?")
_IN_WORDS = regex(r"(?:an?\s+)?[^\W\d_]{3,}(?:[\s-]+[^\W\d_][\w/^*]*)*")
_TIME = (("s", Fraction(1)),)
#: Before a number that is not exact.
_ABOUT = regex(
    r"(?i:[≈≃≅~∼=]+|(?:ca|circa|approx|env|aprox|etwa|rund|ungefähr|approximately|about|roughly"
    r"|around|environ|cirka)\b\.?(?!\s*$))\s*(?=[-+.\d]*\d|[a-z]{3})"
)
#: The 0.5 of `0.5 ± 0.01` and `0.50(1)`, with whatever stands behind both.
_ERROR = regex(
    r"^\(?([-+]?\d+\.?\d*(?:[eE][-+]?\d+)?)\s*(?:±|\+/?[-−])\s*[\d.]+(?:[eE]-?\d+)?\s?%?\)?(?=\s|$)"
    r"|^([-+]?\d+\.\d+)\(\d{1,3}\)(?=\s|$)"
)
#: The comma of `2,5 m`, not that of `1,500 m`.
_COMMA = regex(r"^([-+]?\d+),(\d{1,2}|\d{4,})(?=\s*[^\W\d])")
#: `10k` and `4.7M`.
_WITH_PREFIX = regex(r"([-+]?\d+\.?\d*)\s?([kMG])")


def in_digits(text: str, names: Container[str] = ()) -> str:
    """`12` for `twelve`, `3/2` for `one and a half`, `0.25 m` for `a quarter of a m`.

    Also `9.81` for `≈ 9,81`, `12.5` for `12½`, and `10000` for `10k` where k is none of the names,
    `0.5` for `0.5 ± 0.01` and `0.50(1)`, and `2.5 m` for `2,5 m`.
    """
    if (exact := _ABOUT.sub("", text, count=1) if _ABOUT.match(text) else text) != text:
        text = re.sub(r"^([-+]?\d+),(?=\d)(?!\d{3}$)", r"\1.", exact)
    text = point if unit_behind(point := _COMMA.sub(r"\1.\2", text)) else text
    text = _ERROR.sub(r"\1\2", with_mixed_numbers(text))
    if (short := _WITH_PREFIX.fullmatch(text)) and short[2] not in names:
        return f"{Fraction(short[1]) * 1000 ** (1 + 'kMG'.index(short[2]))}"
    if not _IN_WORDS.fullmatch(text):
        return text
    numbers = meanings("numbers")
    words = "|".join(sorted((*numbers, "and", "an?", "of", "point"), key=len, reverse=True))
    found = re.fullmatch(
        rf"\s*((?:minus|negative)\s+)?((?:(?:{words})(?:[\s-]+|$))+)(.*)", text, re.IGNORECASE
    )
    given = re.split(r"[\s-]+", found[2].casefold().strip()) if found else []
    if not found or not {*given} & {*numbers}:
        return text
    total = part = scale = Fraction(0)
    for each in given:
        if each in {"and", "point"}:
            total, part, scale = total + part, Fraction(0), Fraction(each == "point")
        elif each in numbers and scale:
            scale /= 10
            part += scale * Fraction(numbers[each])
        elif each in numbers and (value := Fraction(numbers[each])) < 1:
            part = (part or 1) * value
        elif each in numbers:
            low = part % value if value >= 100 else Fraction(0)
            part += (low or 1) * value - low
    number, unit = (total + part) * (-1 if found[1] else 1), found[3]
    if not unit:
        return f"{number}" if not scale else f"{float(number):g}"
    written = f"{float(number):g} {unit}"
    return written if unit_behind(written) else text


def unit_mistake(
    text: str, names: Container[str] = (), *, declared: bool = False, what: str = ""
) -> tuple[str, str] | None:
    """What is wrong with `10 kg`, and what to write; None where no unit stands behind a number.

    Numbers are in the units of the file, whose names may be letters that are units as well;
    a parameter is declared with its own.  The rate of an angle is not a number of turns.
    """
    number, unit = number_and_unit(text.replace("°", " deg"))
    if not unit:
        return None
    hint = f"write {number}: numbers are in the units of the file"
    factor, base = _in_base_units(unit)
    if abs(factor - 1) > 1e-9 and _NUMBER.fullmatch(number):
        value = f"{float(Fraction(number)) * factor:.6g}"
        hint = (
            f"numbers are in the units of the file: write {number} with {unit}, {value} with {base}"
        )
    if declared:
        hint = f"write {{value: {number}, unit: {unit}}}"
    elif unit in {"min", "h"}:
        hint = f"write {number}*{60 if unit == 'min' else 3600} for seconds"
    rate = re.fullmatch("the initial '(.+)''", what)
    turns = "turn*" * bool(rate and is_angle(rate[1]) and _TURNS.fullmatch(unit))
    if value := _with_pi(number, turns + unit):
        per = base.partition("/")[2]
        value = f"{{value: {value}, unit: rad/{per}}}" if declared and per else value
        hint = f"angles are in radians: write {value}"
    if unit in names:
        hint += f"; the product is {number}*{unit}"
    return f"the unit '{unit}' cannot stand behind a number", hint


def unit_in_formula(
    text: str, what: str, names: Container[str], is_number: bool, gives_units: bool
) -> tuple[str, str] | None:
    """What is wrong with a formula that has a unit, and what to write; None without one."""

    def is_unit(text: str) -> bool:
        """Whether a text is a unit, and none of its names is one of the file."""
        words = re.findall(r"[^\W\d]\w*", text)
        known = [re.sub("[²³]$", "", each) in names for each in words]
        known = [is_known or (any(known) and each[0] == "u")  # of m u²
                 for is_known, each in zip(known, words, strict=True)]  # fmt: skip
        return not (words and all(known)) and unit_behind(f"1 {text}") == text != ""

    text = re.sub(r"^[\[(]\s*([^\W\d][^\])]*?)\s*[\])]\s*([-\d.]+)$", r"\2 \1", text)  # [kg] 1
    declared = what.startswith("the value of")
    product = re.sub(r"^([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*\*\s*(?=[^\W\d])", r"\1 ", text)
    if declared and product != text and is_unit(unit_behind(product)):  # 500*N
        text = product
    unit = unit_behind(text)
    is_product = " " in unit and all(w in names for w in re.findall(r"[^\W\d]\w*", unit))
    is_force = what.startswith("the force ") and gives_units and unit and is_unit(unit)
    if is_force and abs(_in_base_units(unit)[0] - 1) < 1e-9:
        name, number = _LETTERS.get(unit, "F"), number_and_unit(text)[0]
        name = next(x for x in (name, f"{name}_0", f"{name}_1", "") if x not in names)
        minus, size = "-" * number.startswith("-"), number.lstrip("+-")
        hint = f"declare {name}: {{unit: {unit}, value: {size}}} under parameters"
        hint = f"{hint}, and write {minus}{name}" if name else ""
        return f"the unit '{unit}' cannot stand behind a number", hint
    if unit and ((is_number and not is_product) or is_unit(unit)):
        return unit_mistake(text, names, declared=declared, what=what)
    if (unit := unit_at_end(text)) and is_unit(unit):
        number = text.removesuffix(f"({unit})").removesuffix(unit).strip()
        hint = f"write {number}: numbers are in the units of the file"
        hint = f"write {{value: {number}, unit: {unit}}}" if declared else hint
        return f"the unit '{unit}' cannot stand in {what}", hint
    within = _UNIT_WITHIN.search(text)
    if within and is_unit(within[2]):
        unit, name = within[2], _LETTERS.get(within[2], "g" if "/s" in within[2] else "a")
        hint = f"write parameters: {{{name}: {{value: {within[1]}, unit: {unit}}}}}"
        if abs(_in_base_units(unit)[0] - 1) < 1e-9:
            left = _UNIT_WITHIN.sub(lambda m: m[1] if is_unit(m[2]) else m[0], text)
            left = re.sub(r"(?<!\w)\(([\d.]+)\)", r"\1", left)
            hint = f"write {left}: numbers are in the units of the file"
        return f"the unit '{unit}' cannot stand in {what}", hint
    if declared and is_unit(text):
        return f"the unit '{text}' is not a value", f"write {{unit: {text}}}"
    return None


def _in_base_units(text: str) -> tuple[float, str]:
    """The factor of a unit and the product of base units of the SI that it is a multiple of."""
    from lagcli.units import Unit, UnitMistake, read_unit
    from lagcli.units.table import meaning

    try:
        unit = read_unit(text)
    except UnitMistake:
        return 1.0, text
    factor, powers = unit.number, dict[str, Fraction]()
    for name, exponent in unit.factors:
        meant = meaning(name)
        if meant is None:
            return 1.0, text
        factor *= meant.factor ** float(exponent)
        for base, power in meant.powers:
            powers[base] = powers.get(base, Fraction(0)) + power * exponent
    return factor, str(
        Unit(tuple((base, power) for base, power in sorted(powers.items()) if power))
    )


def _with_pi(number: str, unit: str) -> str:
    """`120*pi/30` for 120 rpm, `4*pi` for 2 turn/s; nothing for what is no angle."""
    factor, base = _in_base_units(unit)
    part = Fraction(factor / pi).limit_denominator(1_000_000)
    if not _ANGLE.fullmatch(unit) or base[0] != "1" or not _NUMBER.fullmatch(number):
        return ""
    times = number if part.numerator == 1 else f"{float(Fraction(number) * part.numerator):.10g}"
    return f"{times}*pi" + f"/{part.denominator}" * (part.denominator > 1)


def in_unit(text: str, unit: str) -> tuple[str, str] | None:
    """What is wrong with `500 g` beside its unit kg, and what to write; None without a unit."""
    number, own = number_and_unit(in_digits(text).replace("°", " deg"))
    if not own or not unit_behind(f"1 {unit}") or not _NUMBER.fullmatch(number):
        return None
    message = f"the unit '{own}' cannot stand behind a number"
    if own == unit:
        return message, f"write {number}"
    (factor, base), (other, same) = _in_base_units(own), _in_base_units(unit)
    if base != same:
        return message, f"write a number of {unit}, which {own} is not, or unit: {own}"
    if unit.startswith("rad") and other == 1 and (value := _with_pi(number, own)):
        return message, f"angles are in radians: write {value}"
    return message, f"write {float(Fraction(number)) * factor / other:.10g}"


def with_radians(angle: str, most: float) -> str:
    """`45*pi/180` for `45°`, and for a number alone of more than `most` radians."""
    if _NUMBER.fullmatch(angle) and abs(Fraction(angle)) > most:
        return f"{angle}*pi/180"
    return re.sub(r"([\d.]+)\s*(?:°|deg\w*)", r"\1*pi/180", angle)


def in_radians(number: str, unit: str) -> str:
    """What to write for a parameter in degrees or gon; nothing for other units."""
    found = re.fullmatch(r"(deg|gon)(/.*|)", unit)
    if found is None:
        return ""
    named, half = ("degrees", 180) if found[1] == "deg" else ("gon", 200)
    value = f", value: {number}*pi/{half}" if number else ""
    return f"{half} {named} are pi: write unit: rad{found[2]}{value}"


def wrong_unit(text: Scalar, value: DocumentNode | None) -> Diagnostic | None:
    """What is wrong with a unit, in radians with its value for an angle in degrees; or None."""
    from lagcli.units import UnitMistake, read_unit

    try:
        read_unit(text.value)
    except UnitMistake as wrong:
        spoken = spoken_unit(text.value)
        is_spoken = is_unit(spoken)
        hint = f"write {spoken}" if is_spoken else wrong.hint
        hint = "write 1" if text.value.casefold() in habits()["nothing"] else hint
        number = value.value.strip() if isinstance(value, Scalar) else ""
        if value is None or _NUMBER.fullmatch(number):
            hint = in_radians(number, spoken) or hint
        part = text.excerpt().span(wrong.start, wrong.end)
        return Diagnostic(wrong.message, text.span if is_spoken else part, hint)
    return None


def run_mistake(text: str, option: str) -> tuple[str, str] | None:
    """What is wrong with `3 T`, an end of a run, or with `8 digits`, an accuracy."""
    from lagcli.units.table import meaning

    found = _COUNT.fullmatch(text.strip())
    if found is None or found[2] in {"pi", "π"} or found[2] in {"min", "h", "deg"}:
        return unit_mistake(text)
    number, word = found.groups()
    unit = meaning(word)
    if unit is not None and unit.powers == _TIME:
        return unit_mistake(text)
    hint = f"write the number that {number} {word} is"
    if "accuracy" in option and number.isdigit():
        hint = f"write 1e-{number}"
    return f"'{word}' cannot stand behind a number", hint
