"""The automaton builds what lark builds, and gives up wherever lark finds a mistake."""

import random

import pytest
from lark.exceptions import UnexpectedInput

from lagcli.diagnostics import Source
from lagcli.reader.automaton import GaveUp
from lagcli.reader.builder import excerpt_being_read
from lagcli.reader.parser import automaton, parser
from lagcli.reader.positions import Excerpt
from lagcli.reader.text import Mistake

VALUES = "x y' 2 1.5e3 ( sin( diff(x,y) f(x,y) -x (x+y)".split(" ")
SIGNS = "+ - * / ^ ** − = >= ) , ; .".split(" ")


def random_text(chance):
    """Values and signs in turn, now and then not."""
    pieces = []
    for _ in range(chance.randrange(1, 5)):
        pieces += [chance.choice(VALUES), chance.choice(SIGNS)]
    if chance.random() < 0.8:
        pieces.append(chance.choice(VALUES))
    return " ".join(pieces)


def outcome(parse, wrong, text, start):
    reset = excerpt_being_read.set(Excerpt.whole(Source("text", text)))
    try:
        return parse(text, start)
    except Mistake as mistake:
        return str(mistake.diagnostics)
    except wrong:
        return None
    finally:
        excerpt_being_read.reset(reset)


@pytest.mark.parametrize("start", ["expression", "equation", "comparison"])
def test_both_read_random_texts_alike(start):
    chance = random.Random(start)
    right = 0
    for _ in range(1500):
        text = random_text(chance)
        quick = outcome(automaton().parse, GaveUp, text, start)
        by_lark = outcome(parser().parse, UnexpectedInput, text, start)
        assert quick == by_lark, text
        right += quick is not None and not isinstance(quick, str)
    assert right > 20


def test_a_right_text_needs_no_lark():
    import subprocess
    import sys

    code = (
        "import sys; from lagcli.reader.expressions import parse_text; parse_text('2*x^2'); "
        "print('lark' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
