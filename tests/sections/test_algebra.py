"""The algebra of the symmetries as it is read."""

from types import SimpleNamespace

from lagcli.document import Paragraph
from lagcli.expression import ZERO, Name
from lagcli.sections.algebra import blocks
from lagcli.statements.answers import AlgebraSection, SpecialValue


def test_values_with_the_same_symmetries_are_read_at_once():
    """A pendulum without a turn of the Earth, or on the equator; w = 1 has another charge."""
    values = [("w", ZERO, "x"), ("b", ZERO, "x"), ("w", Name("pi"), "y")]
    special = tuple(
        SpecialValue(
            parameter=name, value=value, number=10, degree=2, charges={"energy_x": Name(charge)}
        )
        for name, value, charge in values
    )
    section = AlgebraSection(
        ansatz="affine",
        dimension=2,
        name=None,
        independent=2,
        in_involution=2,
        integrable=True,
        special=special,
    )
    read = [
        each.parts
        for each in blocks(section, SimpleNamespace(coordinates=()))
        if isinstance(each, Paragraph) and each.parts[0] == "Where "
    ]
    assert [[part for part in parts if part != ""] for parts in read] == [
        ["Where ", Name("w"), " = ", ZERO, " or ", Name("b"), " = ", ZERO,
         ": 10 symmetries, of which new"],
        ["Where ", Name("w"), " = ", Name("pi"), ": 10 symmetries, of which new"],
    ]  # fmt: skip
