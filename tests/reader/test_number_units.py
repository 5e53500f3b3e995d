"""Numbers of a run: with a power of ten, and with a word behind them that is refused."""

from __future__ import annotations

from fractions import Fraction

import pytest

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
