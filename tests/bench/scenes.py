"""Two problems of the library in one file: a scene of which one part is asked for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import yaml

from tests.bench.measure import ROOT

#: What a part of a scene may have, and what of that is left out.
_KNOWN = {"coordinates", "parameters", "T", "V", "constraints", "initial", "definitions"}
_IGNORED = {"title", "source", "description", "expect", "symmetries", "find", "simulation", "unit"}


def scenes() -> Iterator[tuple[str, str, int]]:
    """Each problem of the library with the one after it: names, text, coordinates of the first."""
    parts = [
        (str(path.relative_to(ROOT / "problems")), found)
        for path in sorted((ROOT / "problems").rglob("*.yaml"))
        if (found := _part(path)) is not None
    ]
    for (name, first), (other, second) in pairwise(parts):
        both = [_renamed(part, mark) for part, mark in ((first, "a"), (second, "b"))]
        scene = {
            "title": f"{first['title']}, and {second['title']}",
            "coordinates": {**both[0]["coordinates"], **both[1]["coordinates"]},
        }
        for key in ("parameters", "definitions", "constraints", "initial"):
            joined = {**both[0].get(key, {}), **both[1].get(key, {})}
            if joined:
                scene[key] = joined
        for key in ("T", "V"):
            terms = [f"({part[key]})" for part in both if key in part]
            if terms:
                scene[key] = " + ".join(terms)
        count = len(both[0]["coordinates"])
        yield f"{name} beside {other}", yaml.safe_dump(scene, sort_keys=False), count


def _part(path: Path) -> dict[str, Any] | None:
    data = yaml.safe_load(path.read_text("utf-8"))
    usable = set(data) <= _KNOWN | _IGNORED and {"T", "initial"} <= set(data)
    # a contact that may open keeps the model whole
    opens = any("holds_while" in str(each) for each in data.get("constraints", {}).values())
    return data if usable and not opens else None


def _renamed(part: Mapping[str, Any], mark: str) -> dict[str, Any]:
    """A part whose names end in a mark."""
    coordinates = part["coordinates"]
    if isinstance(coordinates, list):
        coordinates = {name: {} for name in coordinates}
    own = [coordinates, part.get("parameters", {}), part.get("definitions", {})]
    names = {name for names in (*own, part.get("constraints", {})) for name in names}
    pattern = re.compile(rf"\b({'|'.join(map(re.escape, sorted(names)))})\b")

    def renamed(value: Any) -> Any:
        match value:
            case str():
                return pattern.sub(rf"\1_{mark}", value)
            case dict():
                return {
                    renamed(k): f"{v}_{mark}" if k == "multiplier" else renamed(v)
                    for k, v in value.items()
                    if k not in _IGNORED
                }
            case list():
                return [renamed(each) for each in value]
            case _:
                return value

    found = {key: renamed(part[key]) for key in _KNOWN & set(part) if key != "coordinates"}
    return {**found, "coordinates": renamed(coordinates)}
