"""A point has no negative mass, be it given by a number, a value or assumptions."""

from __future__ import annotations

import itertools
from math import prod

import pytest

from lagcli.pipeline import read

SIGNS = {"positive": 1, "negative": -1}


def mistakes(mass: str, parameters: str) -> list[str]:
    text = f"coordinates: [x]\nparameters: {{{parameters}}}\npoints: {{a: {{position: [x], mass: '{mass}'}}}}\n"
    return [each.message for each in read("p.yaml", text.encode()).diagnostics]


@pytest.mark.parametrize("signs", list(itertools.product(SIGNS, repeat=3)))
@pytest.mark.parametrize(("mass", "powers"), [
    ("a*b*c", (1, 1, 1)), ("-a*b^2/c", (1, 2, 1)), ("2*a^3*b/(-3*c)", (3, 1, 1)), ("c/(a*b)", (1, 1, 1)),
])  # fmt: skip
def test_products_of_what_has_a_sign(
    mass: str, powers: tuple[int, ...], signs: tuple[str, ...]
) -> None:
    parameters = ", ".join(f"{n}: {{assume: {s}}}" for n, s in zip("abc", signs, strict=True))
    sign = prod(SIGNS[s] ** k for s, k in zip(signs, powers, strict=True))
    sign *= -1 if "-" in mass else 1
    expected = ["the mass of 'a' is negative"] if sign < 0 else []
    assert mistakes(mass, parameters) == expected


@pytest.mark.parametrize(("mass", "parameters", "wrong"), [
    ("-2", "k: {}", True), ("m - M", "m: {assume: positive}, M: {assume: positive}", False),
    ("m - 3", "m: {value: 2}", True), ("m", "m: {value: -1}", True), ("m", "m: {}", False),
    ("-(m + M)", "m: {assume: positive}, M: {assume: positive}", True), ("-m^2", "m: {}", True),
    ("-(m + M)", "m: {}, M: {assume: positive}", False), ("-m*exp(M)", "m: {value: 2}, M: {}", True),
])  # fmt: skip
def test_values_and_what_has_none(mass: str, parameters: str, *, wrong: bool) -> None:
    assert bool(mistakes(mass, parameters)) is wrong


@pytest.mark.parametrize("mass", ["m", "2*m/3", "M", "d"])
@pytest.mark.parametrize(("energy", "has"), [
    ("T: I*x'^2/2", ""), ("T: I*x'^2/2 + d*x'^2", "mMd"), ("L: I*x'^2/2 + m*x'^2/2", "mMd"),
    ("V: I*x^2", "mMd"), ("T: M*x'^2/2", "mMd"), ("L: I*x'^2/2 - x^2", ""),
])  # fmt: skip
def test_a_mass_beside_t_that_is_not_in_it_is_warned_of(mass: str, energy: str, has: str) -> None:
    """Without a word phi'' of a rolling disc was m g R sin(a)/I."""
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, I: {assume: positive},"
        " M: {value: 3*m}}\ndefinitions: {d: M/2}\n"
        f"points: {{a: {{position: [x], mass: '{mass}'}}}}\n{energy}\n"
    )
    found = [each.message for each in read("p.yaml", text.encode()).diagnostics]
    meant = any(letter in has for letter in mass if letter in "mMd")
    expected = f"the mass of 'a' is not in {energy[0]}"
    assert [message[: len(expected)] for message in found] == ([] if meant else [expected])
