"""No relation to 0 has a minus before all of its other side."""

import random

import pytest

from lagcli.document import Equations, Paragraph
from lagcli.expression import ZERO, Name, Negative, opposite
from lagcli.notation.relations import without_minuses
from lagcli.pipeline import explain
from lagcli.reader import parse_text
from tests.mechanics.derived import derive


@pytest.mark.parametrize("seed", range(5))
def test_an_inequality_and_its_opposite_say_the_same(seed):
    source = random.Random(seed)
    side = parse_text(source.choice(["a*b", "(a - b)*cos(c)", "a - b", "a/(b - c)"]))
    sign = source.choice([" > ", " < "])
    other = " < " if sign == " > " else " > "
    blocks = tuple(
        Paragraph(("Stable where ", x, s, ZERO, " and ", Name("a"), " > ", ZERO, "."))
        for x, s in ((side, sign), (Negative(side), other))
    )
    one, turned = without_minuses(blocks)
    assert one == turned == blocks[0]


@pytest.mark.parametrize("seed", range(4))
def test_a_page_has_no_condition_with_a_minus_before_all_of_it(seed):
    """Of a file that writes R − a, the algebra's (a − R) sin(x) is −(R − a) sin(x)."""
    source = random.Random(seed)
    one, two = source.sample(["R", "a", "k", "w^2"], 2)
    sign = source.choice(["-", ""])
    text = (
        "coordinates: [x, y]\nparameters: [m, R, a, k, w]\nT: m*(x'^2 + y'^2)/2\n"
        f"V: {sign}m*({one} - {two})*(cos(x) + y^2*{source.randint(1, 4)})\n"
    )
    also = ("equilibria", "steady_motions")
    blocks = [b for s in explain(derive(text), also).steps for b in s.blocks]
    rows = [r for b in blocks if isinstance(b, Equations) for r in b.rows if r.left == ZERO]
    assert rows
    assert not any(isinstance(row.right, Negative) for row in rows)
    for parts in (b.parts for b in blocks if isinstance(b, Paragraph)):
        sides = zip(parts, parts[1:], parts[2:], strict=False)
        compared = [x for x, sign, y in sides if sign in (" > ", " < ") and y == ZERO]
        assert not any(opposite(x) != Negative(x) for x in compared)
