"""The verification alone notices changes of the program that make an answer wrong."""

from __future__ import annotations

from collections import Counter

import pytest

from . import mutants
from .mutants import ASKED, Site, in_a_process, outcome

#: Changes that make answers wrong: (file, what the line holds, change).
KNOWN = (
    ("mechanics/euler_lagrange.py", "total_derivative(momentum) - force", "a - b -> a + b"),
    ("mechanics/energy.py", "return system.T + system.V", "a + b -> a - b"),
    ("mechanics/noether.py", "force * change + momentum", "a + b -> b"),
)
QUICK = ("hoop", "nonholonomic/chaplygin-sleigh")


def site(file: str, text: str, change: str) -> Site:
    """The first place of a change in a line that holds a text."""
    lines = (mutants.ROOT / file).read_text().splitlines()
    numbers = {n for n, line in enumerate(lines, 1) if text in line}
    return next(each for each in mutants.sites({file: numbers}) if each.change == change)


@pytest.mark.parametrize(("file", "text", "change"), KNOWN)
def test_a_known_change_is_noticed(file: str, text: str, change: str) -> None:
    asked = {name: ASKED[name] for name in QUICK}
    before = in_a_process(None, asked)
    assert before is not None
    assert outcome(site(f"lagcli/{file}", text, change), before, asked).kind in {
        "noticed",
        "unchanged",
        "no end",
    }


@pytest.mark.long
def test_of_200_changes_that_make_an_answer_wrong_95_in_100_are_noticed() -> None:
    found = mutants.run(200, seed=1)
    kinds = Counter(each.kind for each in found)
    escaped = [(str(each.site), each.escaped) for each in found if each.kind == "escaped"]
    assert kinds["noticed"] >= 0.95 * (kinds["noticed"] + kinds["escaped"]), escaped
