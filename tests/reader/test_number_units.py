"""Numbers of a run: with a power of ten, and with a word behind them that is refused."""

from __future__ import annotations

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
     ("2*k", ""), ("2.5*(1 + k)", "")],
)  # fmt: skip
def test_a_value_with_its_unit_or_its_uncertainty(written, meant):
    text = f"coordinates: [x]\nparameters: {{k: 1, a: {written}}}\nT: x'^2\n"
    assert [each.hint for each in read_problem("p.yaml", text.encode()).diagnostics] == (
        [meant] if meant else []
    )
