"""Numbers of a run: with a power of ten, and with a word behind them that is refused."""

from __future__ import annotations

import pytest

from lagcli.reader.number_units import run_mistake


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
