"""To how many digits the printed charges stay constant along an independent motion.

    python -m tests.oracle.constancy problems/central/kepler.yaml problems/rolling

prints, for each problem, the seconds of the search, the number of charges that were
discovered, special values of the parameters among them, and the digits to which the worst
of them stays.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mpmath import mp, mpf

from lagcli import load
from lagcli.formatters.built_in.json import to_object
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import Request, state
from lagcli.problem_data import Problem
from lagcli.reader import parse_text
from lagcli.record import replace
from tests.solved import solve

from .jets import real_part
from .motion import NoMotion, motion
from .reference import Reference

DIGITS = 40


def digits_kept(problem: Problem, charges: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    """-log10 of the relative change of each conserved charge, none where nothing moves."""
    conserved = [c for c in charges if c["conserved"]]
    if not conserved:
        return {}
    with mp.workdps(DIGITS):
        reference = Reference(problem)
        values = {c["name"]: reference.of(parse_text(c["charge"])) for c in conserved}
        try:
            moments = motion(reference, list(values.values()))
        except NoMotion:
            return {}
        kept = {}
        for name, value in values.items():
            start, *rest = (real_part(value(m)) for m in moments)
            change = max(abs(x - start) for x in rest) / (1 + abs(start))
            kept[name] = float(-mp.log10(change + mpf(10) ** -DIGITS))
        return kept


def digits_of(derivation: Derivation) -> dict[str, float]:
    """The same for the charges that `--show discovered` prints of a derivation."""
    answers = state(derivation, Request(sections=("discovered",)))
    found = json.loads(json.dumps(to_object(answers)))
    return digits_kept(derivation.system.problem, found.get("discovered") or [])


def searched(problem: Problem, *sections: str) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """The charges that `--show discovered` prints, and the special values of `--show algebra`.

    Empty are those of a section that is not asked for.
    """
    found = json.loads(json.dumps(to_object(solve(problem, sections))))
    return found.get("discovered") or [], (found.get("algebra") or {}).get("special", [])


def kept_at(problem: Problem, special: Mapping[str, Any]) -> dict[str, float]:
    """The same for the new charges at special values, which the parameters then stand for."""
    values = {special["parameter"]: special["value"], **special.get("given", {})}
    there = replace(
        problem,
        parameters=tuple(p for p in problem.parameters if p.name not in values),
        definitions={**{p: parse_text(x) for p, x in values.items()}, **problem.definitions},
    )
    charges = [
        {"name": name, "charge": charge, "conserved": True}
        for name, charge in special["charges"].items()
    ]
    at = ", ".join(f"{p} = {x}" for p, x in values.items())
    return {f"{n} at {at}": d
            for n, d in digits_kept(there, charges).items()}  # fmt: skip


def main(arguments: Sequence[str]) -> None:
    """One line for each problem, then the worst figures."""
    paths = [Path(a) for a in arguments]
    files = [f for p in paths for f in (sorted(p.rglob("*.yaml")) if p.is_dir() else [p])]
    number, untested, least, longest = 0, 0, mp.inf, 0.0
    for path in files:
        problem = load(path)
        begun = time.process_time()
        charges, special = searched(problem, "discovered", "algebra")
        seconds = time.process_time() - begun
        kept = digits_kept(problem, charges)
        for case in special:
            kept |= kept_at(problem, case)
        number += len(kept)
        wanted = sum(bool(c["conserved"]) for c in charges) + sum(
            len(c["charges"]) for c in special
        )
        untested += wanted - len(kept)
        worst = min(kept.values(), default=mp.inf)
        least, longest = min(least, worst), max(longest, seconds)
        line = f"{seconds:6.1f} s {len(kept):3} charges {float(worst):6.1f} digits  {path}"
        print(line, flush=True)
    print(f"{len(files)} problems, {number} charges, {untested} without a motion")
    print(f"least {float(least):.1f} digits, longest {longest:.1f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
