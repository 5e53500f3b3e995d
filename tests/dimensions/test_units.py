"""Units as they are written, against pint, which reads and multiplies them on its own."""

from fractions import Fraction

import pint
import pytest

from lagcli.diagnostics import NOWHERE
from lagcli.dimensions.system import UnitSystem, dimension_of
from lagcli.units import Unit, UnitMistake, read_unit
from lagcli.units.make import CHOSEN
from lagcli.units.table import known_names, meaning

PINT = pint.UnitRegistry()
BASES = {
    "[mass]": "kg", "[length]": "m", "[time]": "s", "[current]": "A",
    "[temperature]": "K", "[substance]": "mol", "[luminosity]": "cd",
}  # fmt: skip


def by_pint(text):
    """The dimension by pint, whose grammar has `**` and `*`."""
    found = PINT.get_dimensionality(PINT.parse_units(text))
    return {BASES[name]: Fraction(power).limit_denominator(100) for name, power in found.items()}


@pytest.mark.parametrize("name", CHOSEN)
def test_every_unit_has_the_factor_and_dimension_of_pint(name):
    factor, powers = meaning(name)
    assert dict(powers) == by_pint(name)
    assert factor == pytest.approx(PINT.Quantity(1, name).to_base_units().magnitude, rel=1e-9)


@pytest.mark.parametrize("name", ["km", "mm", "mN", "kN", "MeV", "ms", "µm", "kilometer", "hPa"])
def test_prefixes_are_those_of_pint(name):
    factor, powers = meaning(name)
    assert dict(powers) == by_pint(name)
    assert factor == pytest.approx(PINT.Quantity(1, name).to_base_units().magnitude, rel=1e-9)


@pytest.mark.parametrize("mass", ["kg", "g"])
@pytest.mark.parametrize("length", ["m", "cm", "mm"])
@pytest.mark.parametrize("given", ["N/m", "N/cm", "mN/m", "J/m^2", "N/mm", "dyn/cm", "kg/s^2"])
def test_a_unit_fits_a_file_where_its_whole_is_a_product_of_the_base_units(mass, length, given):
    """N/m is kg/s^2, which has no length: it stands beside cm."""
    units = [("s", NOWHERE), (length, NOWHERE), (mass, NOWHERE), (given, NOWHERE)]
    factor = PINT.Quantity(1, given.replace("^", "**")).to(f"{mass}/s**2").magnitude
    assert len(UnitSystem(units).incoherent) == (factor != pytest.approx(1, rel=1e-9))


def test_no_name_is_a_prefix_and_another_name():
    """`min` is a minute, `ft` a foot: a name of its own goes before a prefix."""
    assert meaning("min").factor == 60
    assert meaning("ft").factor == 0.3048
    assert meaning("Pa").powers == meaning("pascal").powers
    assert all(meaning(name) is not None for name in known_names())


@pytest.mark.parametrize(
    ("text", "pints"),
    [
        ("kg m^2", "kg*m**2"),
        ("kg*m**2/s^2", "kg*m**2/s**2"),
        ("kg·m²·s⁻²", "kg*m**2/s**2"),
        ("m/s/s", "m/s/s"),
        ("1/s", "1/s"),
        ("J/(kg K)", "J/(kg*K)"),
        ("J/kg*m", "J/kg*m"),
        ("(N m)^(1/2)", "(N*m)**0.5"),
        ("1/(m s)^2", "1/(m*s)**2"),
        ("N m rad^-1", "N*m/rad"),
        ("kg^0.5", "kg**0.5"),
    ],
)
def test_a_unit_means_what_it_means_to_pint(text, pints):
    assert dimension_of(read_unit(text)) == by_pint(pints)
    assert dimension_of(read_unit(str(read_unit(text)))) == by_pint(pints)


@pytest.mark.parametrize(
    ("text", "start", "piece"),
    [
        ("", 0, "ends too early"),
        ("m^", 1, "number is missing"),
        ("m//s", 2, "no place"),
        ("(m", 0, "never closed"),
        ("m)", 1, "no place"),
        ("kg + m", 3, "no place"),
        ("m^(1/0)", 5, "division by 0"),
        ("m^101", 2, "above 100"),
        ("m^1.2.3", 2, "no exponent"),
        ("2 m", 0, "no number but 1"),
        ("J/kg m", 1, "two ways"),
        ("Nm", 0, "unknown unit"),
        ("c", 0, "unknown unit"),
        ("m" * 201, 0, "more than 200"),
        ("(" * 100 + "m", 99, "never closed"),
        ("º", 0, "unknown unit"),
    ],
)
def test_a_wrong_unit_is_told_with_its_place(text, start, piece):
    with pytest.raises(UnitMistake) as found:
        read_unit(text)
    assert piece in found.value.message
    assert found.value.start == start


@pytest.mark.parametrize(
    ("text", "meant"),
    [("Nm", "N m"), ("m2", "m^2"), ("rads", "rad"), ("KG", "kg"), ("metr", "metre"), ("lbs", "lb")],
)
def test_what_was_meant_is_suggested(text, meant):
    with pytest.raises(UnitMistake) as found:
        read_unit(text)
    assert found.value.hint == f"did you mean '{meant}'?"


def test_a_unit_is_written_as_it_is_read():
    assert str(Unit()) == "1"
    assert str(read_unit("1/(kg m)")) == "1/(kg m)"
    assert str(read_unit("m^(1/2)/s^2")) == "m^(1/2)/s^2"
    assert str(Unit((("m", Fraction(1)),), 0.5)) == "0.5 m"
