"""An explanation speaks of confirmed answers only."""

from __future__ import annotations

import pytest

from lagcli import load
from lagcli.pipeline import derive, explain
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.answers import Answers
from lagcli.statements.explanation import Explanation

from .sheets import LIBRARY, spoiled


def explained(name: str) -> Explanation:
    return explain(derive(load(LIBRARY / f"{name}.yaml")), ("equilibria",))


@pytest.mark.parametrize(
    ("section", "title"),
    [("accelerations", "The accelerations"), ("energy", "The energy"), ("equations", "Lagrange's equations")],
)  # fmt: skip
def test_a_step_whose_result_is_not_confirmed_is_left_out(
    section: str, title: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    from lagcli import verification

    confirmed = verification.verified
    name = "pendulums/plane-pendulum"
    before = explained(name)

    def with_a_mistake(problem: Problem, answers: Answers) -> Answers:
        wrong = spoiled(answers, section, 0)
        found = confirmed(problem, wrong)
        kept = {n: s for n, s in answers.sections.items() if found.sections[n] == wrong.sections[n]}
        return replace(found, sections={**found.sections, **kept})

    monkeypatch.setattr(verification, "verified", with_a_mistake)
    found = explained(name)
    assert before.complete
    assert not found.complete
    changed = [b.title for a, b in zip(before.steps, found.steps, strict=True) if a != b]
    assert title in changed
    assert len(found.warnings) > len(before.warnings)
