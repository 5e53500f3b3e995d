"""A proof as a table of proved digits, as JSON with midpoints and radii, or as CSV."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

from lagcli.numerics.rigorous.result import Proof
from lagcli.numerics.tables.writing import aligned, as_csv

#: Digits of a midpoint and of a radius in JSON and CSV.
_DIGITS = 30
#: What a decimal is compared with.
_BITS = 256


def to_json(proof: Proof) -> bytes:
    """The keys of a run, with an enclosure for each number."""
    content = {
        "schema": 1,
        "columns": list(proof.columns),
        "rows": [[None if x is None else float(x.mid()) for x in row] for row in proof.rows],
        "enclosures": [[_ball(x) for x in row] for row in proof.rows],
        "certificate": {
            "kind": "proof" if proof.within is None else "shadow",
            **({} if proof.within is None else {"initial_within": proof.within}),
            "accuracy": proof.accuracy,
            "reached": proof.reached,
            "holds_until": proof.holds_until,
            "assumed": list(proof.assumed),
        },
        "method": {
            "name": "interval Taylor series with Lohner's sets",
            "bits": proof.bits,
            "kept": proof.kept,
            "order": proof.order,
            "steps": proof.steps,
        },
        "events": [
            {
                "t": float(event.t.mid()),
                "enclosure": _ball(event.t),
                "name": event.name,
                "what": event.what,
                "before": {name: _ball(x) for name, x in event.before.items()},
            }
            for event in proof.events
        ],
        "refused": _refused(proof),
    }
    return (json.dumps(content, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _refused(proof: Proof) -> dict[str, object] | None:
    return {"reason": proof.refusal, "at": proof.holds_until} if proof.refusal else None


def _ball(x: Any) -> dict[str, str] | None:
    """A decimal midpoint, and a radius that contains its rounding as well."""
    if x is None:
        return None
    from flint import ctx

    with ctx.workprec(_BITS):
        middle = x.mid().str(_DIGITS, radius=False)
        return {"midpoint": middle, "radius": _above(abs(x - type(x)(middle)).upper())}


def _above(bound: Any) -> str:
    """A decimal that is not below a bound."""
    if bound == 0:
        return "0"
    exponent = math.floor(math.log10(float(bound))) if float(bound) > 0 else -300
    first = max(100, min(999, int(float(bound) / 10.0**exponent * 100)))
    for leading in range(first, 10_000):
        candidate = f"{leading / 100:.2f}e{exponent}"
        if type(bound)(candidate).lower() >= bound:
            return candidate
    return f"1e{exponent + 2}"


def to_csv(proof: Proof) -> bytes:
    """Midpoints, and a column with the radius behind each."""
    header = [name for column in proof.columns for name in (column, f"{column} (radius)")]
    rows = ([text for ball in map(_ball, row) for text in _cells(ball)] for row in proof.rows)
    return as_csv(header, rows).encode()


def _cells(ball: dict[str, str] | None) -> tuple[str, str]:
    return ("", "") if ball is None else (ball["midpoint"], ball["radius"])


def to_table(proof: Proof) -> bytes:
    """Every number with the digits that are proved, and what the proof stands on."""
    cells = [list(proof.columns)]
    cells += [[_written(row[0]), *map(proved_digits, row[1:])] for row in proof.rows]
    lines = aligned(cells)
    lines += [""] if proof.events else []
    lines += [f"{e.what} at t = {proved_digits(e.t)} ({e.name})" for e in proof.events]
    whole = "proved" if proof.reached else f"proved until t = {proof.holds_until:g}"
    if proof.events:
        whole += ", order and number of the events, too"
    made = f"{proof.steps} steps of order {proof.order} in {proof.bits} bits, {proof.kept} kept"
    lines += [
        "",
        *_claim(whole, proof.within),
        f"  one unit of its last place; accuracy {proof.accuracy:g}, {made}",
        f"assumed: {'; '.join(proof.assumed)}",
    ]
    return "".join(f"{line}\n" for line in lines).encode()


def _claim(whole: str, within: float | None) -> list[str]:
    if within is None:
        return [f"{whole}: every digit shown holds for the exact motion, within"]
    return [
        f"{whole} by shadowing: every digit shown holds for an exact motion whose",
        f"  initial values lie within {within:.1e} of those of the file, within",
    ]


def _written(t: Any) -> str:
    """A time, which the file or the options give."""
    shown = proved_digits(t)
    return shown.rstrip("0").rstrip(".") if "." in shown else shown


def proved_digits(x: Any) -> str:
    """Those of a ball that hold within one unit of the last of them."""
    if x is None:
        return ""
    if x.rad() == 0 and x == type(x)(f"{float(x):.15g}"):
        return f"{float(x):.15g}"
    radius, size = float(x.rad()), float(abs(x).upper())
    digits = 15 if radius == 0 else max(1, min(40, math.floor(math.log10(size / radius)) + 1))
    shown: str = x.str(digits, radius=False)
    return f"0 ± {_above(abs(x).upper())}" if x.contains(0) else shown


WRITERS: dict[str, Callable[[Proof], bytes]] = {"table": to_table, "json": to_json, "csv": to_csv}
