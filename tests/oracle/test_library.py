"""Every problem of the library: what lagcli prints, examined independently of it.

The reference (jets, virtual work, a numeric KKT system, Noether's formula in numbers)
shares no code with lagcli's algebra or mechanics; only the reader is common to both.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from lagcli.formatters.json import to_object
from lagcli.pipeline import load, solve

from .examine import examine

LIBRARY = Path(__file__).parents[2] / "problems"
PROBLEMS = sorted(LIBRARY.rglob("*.yaml"))
SECTIONS = (
    "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
    "constraint_forces", "momenta", "energy", "hamiltonian", "canonical_equations",
    "charges", "find",
)  # fmt: skip


@pytest.mark.parametrize("path", PROBLEMS, ids=lambda p: str(p.relative_to(LIBRARY)))
def test_every_printed_claim_holds(path: Path) -> None:
    problem = load(path)
    asked = [name for name in SECTIONS if name != "find" or problem.find]
    sheet = json.loads(json.dumps(to_object(solve(problem, asked))))
    assert [str(finding) for finding in examine(problem, sheet, count=2)] == []
