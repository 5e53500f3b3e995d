"""Two kept runs side by side."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any


def compare(first: Path, second: Path) -> None:
    """Print what both measured, and what changed in the library."""
    old, new = (json.loads(path.read_text(encoding="utf-8")) for path in (first, second))
    print(f"{old['version']} → {new['version']}")
    before = {row["what"]: row for row in old["rows"]}
    for row in new["rows"]:
        if row["what"] in before:
            _row(before[row["what"]], row)
    problems = old.get("library", {}), new.get("library", {})
    for file in sorted(problems[0].keys() & problems[1].keys()):
        _problem(file, problems[0][file], problems[1][file])


def _row(old: dict[str, Any], new: dict[str, Any]) -> None:
    values = [f"{row['value']:.2f}" if row["value"] is not None else "-" for row in (old, new)]
    told = {(True, False): "now MISSED", (False, True): "now holds", (False, False): "MISSED"}
    change = told.get((old["holds"], new["holds"]), "")
    print(f"{new['what']:44} {values[0]:>8} → {values[1]:>8} {new['unit']:16} {change}".rstrip())


def _problem(file: str, old: dict[str, Any], new: dict[str, Any]) -> None:
    """Where lagcli became faster or slower by a third, and formulas longer or shorter."""
    ratio = (new["lagcli_cpu"] / new["cpu"]) / (old["lagcli_cpu"] / old["cpu"])
    if not (new["fails"] or old["late"] or new["late"]) and not 3 / 4 < ratio < 4 / 3:
        print(f"  {file}: {ratio:.2f} times the time")
    for name, formula in new.get("formulas", {}).items():
        earlier = old.get("formulas", {}).get(name, {}).get("lagcli_operations")
        now = formula.get("lagcli_operations")
        if earlier != now:
            print(f"  {file} {name}: {earlier} → {now} operations")
