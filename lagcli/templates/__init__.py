"""First problems to change into one's own, by name; `lagcli new` writes one."""

from __future__ import annotations

from pathlib import Path

#: Template -> what it shows.
TEMPLATES = {
    "pendulum": "one coordinate, T and V",
    "constrained": "constraints with multipliers, and the forces that they stand for",
    "rolling": "rolling without slipping: a constraint on the velocities",
    "symmetry": "candidate symmetries and their conserved quantities",
    "driven": "a driven, damped system",
    "contact": "one-sided contacts, impacts and loss of contact",
}


def template(name: str) -> str:
    """The text of a template, with a place for the title: `{title}`."""
    return (Path(__file__).parent / f"{name}.yaml").read_text("utf-8")
