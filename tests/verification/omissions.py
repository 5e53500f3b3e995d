"""What of a sheet can be left out in silence: each list and mapping shortened, then verified.

python -m tests.verification.omissions [problem ...]
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from lagcli import load, pipeline
from lagcli.expression import Expression
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.answers import Answers
from lagcli.verification import REFUTED, verified

from .mutants import ASKED, ROOT

#: Sections that are verified against others.
WITH = {"algebra": ("discovered",), "find": ("charges",)}


def shortened(whole: Any) -> Iterator[tuple[str, Any]]:
    """The same with one list or mapping without one entry, or empty, and where that is."""
    if isinstance(whole, Expression):
        return
    if is_dataclass(whole):
        parts = {each.name: getattr(whole, each.name) for each in fields(whole)}
        for name, part in parts.items():
            for path, other in shortened(part):
                yield f"/{name}{path}", replace(whole, **{name: other})
    elif isinstance(whole, Mapping | tuple) and not _is_equation(whole):
        entries = dict(whole) if isinstance(whole, Mapping) else dict(enumerate(whole))
        for key, part in entries.items():
            yield f" without {key}", _like(whole, {k: v for k, v in entries.items() if k != key})
            for path, other in shortened(part):
                yield f"/{key}{path}", _like(whole, {**entries, key: other})


def _is_equation(whole: Any) -> bool:
    """Whether it is the two sides of one, of which none can be left out."""
    return len(whole) == 2 and all(isinstance(side, Expression) for side in whole)


def _like(whole: Any, entries: dict[Any, Any]) -> Any:
    return entries if isinstance(whole, Mapping) else tuple(entries.values())


def derived(name: str, sections: Sequence[str]) -> tuple[Problem, Answers]:
    """A problem of the library with its sheet as derived, before any verification."""
    derivation = pipeline.derive(load(ROOT / f"problems/{name}.yaml"))
    before, pipeline.VERIFYING = pipeline.VERIFYING, False
    try:
        request = pipeline.Request(sections=tuple(sections))
        return derivation.problem, pipeline.state(derivation, request)
    finally:
        pipeline.VERIFYING = before


def refuted(problem: Problem, answers: Answers, section: str, whole: Any) -> set[str]:
    """What is said of a section that it is not confirmed."""
    names = (*WITH.get(section, ()), section)
    known = {n: answers.sections[n] for n in names if n in answers.sections}
    warnings = verified(problem, replace(answers, sections={**known, section: whole})).warnings
    return {each for each in warnings if REFUTED in each}


def silent(problem: Problem, answers: Answers, section: str) -> Iterator[str]:
    """What can be left out of a section with no new sentence."""
    whole = answers.sections[section]
    usual = refuted(problem, answers, section, whole)
    for path, other in shortened(whole):
        if refuted(problem, answers, section, other) <= usual:
            yield f"{section}{path}"


def main() -> None:
    """Print what can be left out in silence."""
    for name in sys.argv[1:] or ASKED:
        problem, answers = derived(name, ASKED[name])
        for section in answers.sections:
            for path in silent(problem, answers, section):
                print(f"{name}: {path}", flush=True)


if __name__ == "__main__":
    main()
