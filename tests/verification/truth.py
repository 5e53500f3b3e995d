"""Whether what is printed beside the known answer is true of the motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mpmath import mpf, sqrt

from tests.oracle.examine import agree
from tests.oracle.jets import coefficient, family, infinitesimal, real_part
from tests.oracle.reference import Reference


def rests(reference: Reference, moment: Any, place: Mapping[str, mpf]) -> bool:
    """Whether a place, given in all coordinates, is an equilibrium without constraints."""
    residual = _residual(reference, moment, place, [mpf(0)] * reference.size, mpf(0))
    return residual is not None and all(agree(value, mpf(0)) for value, _ in residual)


def oscillates(reference: Reference, moment: Any, mode: Any, of: Callable[[str], Any]) -> bool:
    """Whether q0 + epsilon a cos(omega t) solves the equations of motion to first order."""
    square = mode.get("frequency_squared") or f"({mode['frequency']})^2"
    place = {name: of(text) for name, text in mode["at"].items()}
    shapes = [mode["shape"], *mode.get("more_shapes", ())]
    return rests(reference, moment, place) and all(
        _swings(reference, moment, place, [of(shape[n]) for n in reference.names], of(square))
        for shape in shapes
    )


def _swings(
    reference: Reference, moment: Any, place: Mapping[str, mpf], shape: Sequence[mpf], W: mpf
) -> bool:
    residual = _residual(reference, moment, place, shape, W)
    size = sqrt(sum(a * a for a in shape)) * (1 + abs(W))
    return residual is not None and size > 0 and all(
        agree(slope / size, mpf(0)) for _, slope in residual
    )  # fmt: skip


def _residual(
    reference: Reference, moment: Any, place: Mapping[str, mpf], shape: Sequence[mpf], W: mpf
) -> list[tuple[mpf, mpf]] | None:
    """What is left of the equations at q0 + epsilon a, q'' = -W epsilon a, to first order.

    None where not all coordinates are given, or there are constraints.
    """
    if reference.problem.constraints or set(place) != set(reference.names):
        return None
    with family() as nearby:
        step = infinitesimal(nearby)
        q = tuple(place[n] + step * a for n, a in zip(reference.names, shape, strict=True))
        still = tuple(mpf(0) for _ in q)
        there = replace(moment, chain=(q, still, tuple(-W * a * step for a in shape)))
        pairs = zip(reference.inertia(there), reference.applied(there), strict=True)
        left = [a - b for a, b in pairs]
        return [(real_part(x), real_part(coefficient(x, nearby))) for x in left]
