"""When two numbers are the same, and how one is shown."""

from __future__ import annotations

from mpmath import mpf

TOLERANCE = mpf(10) ** -10


def close(a, b):
    """Equal up to rounding."""
    return abs(a - b) <= TOLERANCE * max(1, abs(a), abs(b))


def short(value):
    return f"{float(value):.8g}"
