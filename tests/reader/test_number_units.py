"""Numbers of a run: with a power of ten, and with a word behind them that is refused."""

from __future__ import annotations

import math
import re
from fractions import Fraction

import pytest

from lagcli.reader import read_problem
from lagcli.reader.number_units import in_digits, run_mistake


@pytest.mark.parametrize(
    "number", ["1e7", "1E7", "2.5e3", "1e-9", "1e+2", "7", "0.5", "2*pi", "3 pi"]
)
def test_a_power_of_ten_is_no_word(number):
    assert run_mistake(number, "--until") is None


@pytest.mark.parametrize(
    ("text", "option", "hint"),
    [
        ("3 T", "--until", "write the number that 3 T is"),
        ("8 digits", "--accuracy", "write 1e-8"),
        ("1e3 s", "--until", "write 1e3: numbers are in the units of the file"),
        ("2 e7x", "--until", "write the number that 2 e7x is"),
    ],
)
def test_a_word_behind_a_number_is_refused(text, option, hint):
    found = run_mistake(text, option)
    assert found is not None
    assert found[1] == hint


@pytest.mark.parametrize(
    ("written", "meant"),
    [("12½", "25/2"), ("3 1/3", "10/3"), ("-2¼", "-9/4"), ("≈ 9,81", "981/100"), ("ca. 2.5", "5/2"),
     ("10k", "10000"), ("4.7M", "4700000"), ("about ten", "10"), ("= 3", "3")],
)  # fmt: skip
def test_a_number_in_other_marks_has_its_value(written, meant):
    assert Fraction(in_digits(written)) == Fraction(meant)


@pytest.mark.parametrize("written", ["x^12½", "2 3/2", "1/2", "10m", "k", "2k", "ca", "~x"])
def test_other_texts_are_no_such_number(written):
    assert in_digits(written, {"k"}) == written


@pytest.mark.parametrize(
    ("written", "unit"),
    [("ms-2", "m/s^2"), ("kg m2 s-2", "kg*m^2/s^2"), ("Nsm-1", "N*s/m"), ("s-1", "1/s"),
     ("J·K-1", "J/K"), ("kgm-3", "kg/m^3")],
)  # fmt: skip
def test_symbols_strung_together_are_a_product(written, unit):
    def read(given):
        text = f"coordinates: [x]\nparameters: {{a: {given}}}\nT: x'^2\n"
        return read_problem("p.yaml", text.encode()).diagnostics

    [alone] = read(f"{{unit: {written}}}")
    [behind] = read(f"3.5 {written}")
    assert alone.hint == f"write {unit}"
    assert behind.hint == f"write {{value: 3.5, unit: {unit}}}"
    assert not read(f"{{unit: {unit}}}")


@pytest.mark.parametrize(
    ("written", "meant"),
    [("500*N", "write {value: 500, unit: N}"), ("9.81*m/s^2", "write {value: 9.81, unit: m/s^2}"),
     ("0.50(1)", "write 0.50"), ("2.31(12) J", "write {value: 2.31, unit: J}"),
     ('"2,5 kg"', "write {value: 2.5, unit: kg}"),
     ('"9,81 m/s^2"', "write {value: 9.81, unit: m/s^2}"), ('"2,5 k"', "write 2.5*k"),
     ("2*k", ""), ("2.5*(1 + k)", "")],
)  # fmt: skip
def test_a_value_with_its_unit_or_its_uncertainty(written, meant):
    text = f"coordinates: [x]\nparameters: {{k: 1, a: {written}}}\nT: x'^2\n"
    assert [each.hint for each in read_problem("p.yaml", text.encode()).diagnostics] == (
        [meant] if meant else []
    )


#: Units of the rate of an angle, and the radians per second of each.
TURNS = {
    "rpm": math.pi / 30, "RPM": math.pi / 30, "min^-1": math.pi / 30, "1/min": math.pi / 30,
    "U/min": math.pi / 30, "r/min": math.pi / 30, "rev/min": math.pi / 30, "Hz": 2 * math.pi,
    "rev/s": 2 * math.pi, "turns/s": 2 * math.pi, "rps": 2 * math.pi, "U/s": 2 * math.pi,
    "deg/s": math.pi / 180, "°/s": math.pi / 180, "deg/min": math.pi / 10800,
    "rev/h": math.pi / 1800, "1/s": 1, "s^-1": 1, "rad/s": 1,
}  # fmt: skip


@pytest.mark.parametrize("number", ["120", "1.5", "2", "0.3", "2e2"])
@pytest.mark.parametrize("unit", TURNS)
@pytest.mark.parametrize("x", ["phi", "theta_1"])
def test_the_rate_of_an_angle_is_in_radians(number, unit, x):
    text = f"coordinates: [{x}]\nparameters: {{J: 2}}\nT: J*{x}'^2/2\ninitial: {{{x}': {{}}}}\n"
    [only] = read_problem("p.yaml", text.replace("{}", f"{number} {unit}").encode()).diagnostics
    meant = re.search(r"write ([^:,;]*)", only.hint)[1]
    right = read_problem("p.yaml", text.replace("{}", meant).encode())
    assert right.diagnostics == ()
    value = eval(meant, {"pi": math.pi})
    assert value == pytest.approx(float(number) * TURNS[unit], rel=1e-12)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("3 rpm", "{value: 3*pi/30, unit: rad/s}"), ("3 deg/m", "{value: 3*pi/180, unit: rad/m}"),
        ("2 rev/min", "{value: 2*pi/30, unit: rad/s}"), ("3 deg", "3*pi/180"),
        ("3 N*m/deg", "{value: 3, unit: N*m/deg}"), ("2 min^-1", "{value: 2, unit: min^-1}"),
    ],
)  # fmt: skip
def test_a_parameter_with_an_angle_in_its_unit(written, meant):
    text = f"coordinates: [x]\nparameters: {{m: 2, c: {written}}}\nT: m*x'^2/2\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint.removeprefix("angles are in radians: ") == f"write {meant}"
    assert read_problem("p.yaml", text.replace(written, meant).encode()).diagnostics == ()


@pytest.mark.parametrize("unit", ["min^-1", "1/min", "Hz"])
def test_the_rate_of_a_length_has_no_turns(unit):
    text = f"coordinates: [x]\nparameters: {{m: 2}}\nT: m*x'^2/2\ninitial: {{x': 3 {unit}}}\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert "pi" not in only.hint
