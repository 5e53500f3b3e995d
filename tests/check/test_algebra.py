"""Expectations of `algebra` can fail: each slip in one is caught, where it stands."""

from __future__ import annotations

import pytest

from lagcli.studies.check import CheckOutcome
from lagcli.studies.check.one import check_problem

#: A free particle has five Noether symmetries; a force 3 F w x^2 leaves the energy alone.
PUSHED = """\
coordinates: [x]
parameters: {m: {assume: positive}, F: {}, w: {assume: positive}}
L: m*x'^2/2 + F*w*x^3
expect:
  algebra:
    independent: 1
    special:
      - where: F = 0
        charges: 5
        discovered: {dilation: x*x' - t*x'^2, doubled: 2*m*x' + F*x}
"""
FREE = """\
coordinates: [x]
parameters: {m: {assume: positive}}
L: m*x'^2/2
expect:
  algebra:
    dimension: 5
    name: "Schrödinger sch(1): sl(2,R) with Heisenberg h(1)"
    in_involution: 1
    integrable: yes
    special: []
"""
SLIPS = [
    (PUSHED, "independent: 1", "independent: 2", "independent"),
    (PUSHED, "where: F = 0", "where: F = 1", "special.0 special"),
    (PUSHED, "where: F = 0", "where: m = w", "special.0 special"),
    (PUSHED, "charges: 5", "charges: 4", "special.0.charges"),
    (PUSHED, "2*m*x' + F*x", "2*m*x' + x", "special.0.discovered.doubled"),
    (FREE, "dimension: 5", "dimension: 6", "dimension"),
    (FREE, "sl(2,R)", "sl(2,C)", "name"),
    (FREE, "in_involution: 1", "in_involution: 2", "in_involution"),
    (FREE, "integrable: yes", "integrable: no", "integrable"),
    (FREE, "special: []", "special: [{where: m = 2}]", "special.0"),
]


def check(text):
    return check_problem("test.yaml", text.encode())


@pytest.mark.long
@pytest.mark.parametrize("text", [PUSHED, FREE], ids=["pushed", "free"])
def test_the_unchanged_file_passes(text):
    report = check(text)
    assert report.findings == ()
    assert report.outcome is CheckOutcome.PASSED


@pytest.mark.long
@pytest.mark.parametrize(("text", "old", "new", "subjects"), SLIPS, ids=[s[2] for s in SLIPS])
def test_a_slip_is_found_where_it_stands(text, old, new, subjects):
    assert text.count(old) == 1
    report = check(text.replace(old, new))
    assert {f.outcome for f in report.findings} == {CheckOutcome.WRONG}
    assert [f.subject for f in report.findings] == [f"algebra.{s}" for s in subjects.split()]
    place = report.findings[0].span
    assert place.line - 1 <= text[: text.index(old)].count("\n") <= place.line + 1


def test_a_special_value_that_the_file_does_not_name_is_told():
    [finding] = check(PUSHED[: PUSHED.index("      - where")].replace("special:", "special: []"))\
        .findings  # fmt: skip
    assert "F = 0" in finding.message
