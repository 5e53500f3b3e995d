"""The automaton builds what lark builds, and finds a mistake where lark finds it."""

import random

import pytest
from lark.exceptions import UnexpectedCharacters, UnexpectedInput

from lagcli.diagnostics import Source
from lagcli.reader.automaton import Unexpected
from lagcli.reader.builder import excerpt_being_read
from lagcli.reader.parser import automaton, make_parser
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


LARK = make_parser()


def place_of(error, text):
    """Where a parser stops, and whether at a token."""
    if isinstance(error, Unexpected):
        return error.place, error.token
    if isinstance(error, UnexpectedCharacters):
        return error.pos_in_stream, None
    at_end = error.token.type == "$END"
    return (len(text), None) if at_end else (error.token.start_pos, error.token)


def outcome(parse, text, start):
    reset = excerpt_being_read.set(Excerpt.whole(Source("text", text)))
    try:
        return parse(text, start)
    except Mistake as mistake:
        return str(mistake.diagnostics)
    except (Unexpected, UnexpectedInput) as error:
        return place_of(error, text)
    finally:
        excerpt_being_read.reset(reset)


@pytest.mark.parametrize("start", ["expression", "equation", "comparison"])
def test_both_read_random_texts_alike(start):
    chance = random.Random(start)
    right = wrong = 0
    for _ in range(1500):
        text = random_text(chance)
        ours = outcome(automaton().parse, text, start)
        assert ours == outcome(LARK.parse, text, start), text
        wrong += isinstance(ours, tuple)
        right += not isinstance(ours, (str, tuple))
    assert right > 20
    assert wrong > 20


def test_no_text_needs_lark():
    import subprocess
    import sys

    code = (
        "import sys; from lagcli.reader.expressions import ProblemError, parse_text\n"
        "parse_text('2*x^2')\n"
        "try: parse_text('2*')\n"
        "except ProblemError: print('lark' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
