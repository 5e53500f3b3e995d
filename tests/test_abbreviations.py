"""Names for what recurs in long answers: they change no value, and read back."""

from __future__ import annotations

import pytest

from lagcli import load
from lagcli.abbreviations import abbreviated, written_out
from lagcli.expression import Name, walk
from lagcli.pipeline import Request, derive, state

SECTIONS = ("accelerations", "multipliers", "hamiltonian")


def answers(file, **request):
    return state(derive(load(file)), Request(sections=SECTIONS, **request))


@pytest.mark.parametrize(
    "file", ["problems/chains/triple-pendulum.yaml", "problems/chains/slider-crank.yaml"]
)
def test_what_is_written_out_again_is_what_was_abbreviated(file):
    plain = answers(file)
    short = abbreviated(plain, ())
    assert short.where
    assert "Delta" in short.where
    assert written_out(short).sections == plain.sections


def test_each_name_uses_only_earlier_ones_and_is_used():
    short = answers("problems/chains/slider-crank.yaml", abbreviate=True)
    known: set[str] = set()
    for name, node in short.where.items():
        used = {p.name for p in walk(node) if isinstance(p, Name)} & short.where.keys()
        assert used <= known
        known.add(name)
    accelerations = short.sections["accelerations"].accelerations.values()
    assert all("Delta" in {p.name for p in walk(a) if isinstance(p, Name)} for a in accelerations)


def test_names_of_the_file_are_not_taken():
    plain = answers("problems/chains/slider-crank.yaml")
    short = abbreviated(plain, ("Delta", "k1"))
    assert not short.where.keys() & {"Delta", "k1"}
    assert written_out(short).sections == plain.sections


def test_a_short_answer_has_no_abbreviations():
    assert not answers("problems/pendulums/double-pendulum.yaml", abbreviate=True).where
