"""Large systems, whole process: `--show matrix_form` of chains, and rigid bodies in full."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.bench.measure import HERE, LAGCLI, ROOT, Cost, Row, cost
from tests.bench.motion_rows import peers
from tests.mechanics.chains import cartesian, chain, closed

MIB = 2048
HEAVY_TOP = ROOT / "problems/rigid/heavy-symmetric-top.yaml"

#: what, text, bar in seconds
CHAINS: tuple[tuple[str, Callable[[], str], float | None], ...] = (
    ("chain 10, points", lambda: chain(10, "points"), None),
    ("chain 50, points", lambda: chain(50, "points"), 15),
    ("chain 50, definitions", lambda: chain(50, "definitions"), 15),
    ("chain 50, T of definitions", lambda: chain(50, "kinetic"), 15),
    ("closed chain 50, points", lambda: closed(50, "points"), 15),
    ("closed chain 50, definitions", lambda: closed(50, "definitions"), 15),
    ("Cartesian pendulum 50", lambda: cartesian(50), 15),
    ("chain 100, points", lambda: chain(100, "points"), 90),
    ("chain 100, definitions", lambda: chain(100, "definitions"), 90),
)

#: A top on a pivot with a second one on a ball joint at its end, both in Euler angles.
TWO_BODIES = """\
coordinates: [phi1, theta1, psi1, phi2, theta2, psi2]
parameters: [A1, C1, A2, C2, m1, m2, a1, a2, l, g]
definitions:
  x1: sin(theta1)*sin(phi1)
  y1: -sin(theta1)*cos(phi1)
  z1: cos(theta1)
  x2: l*x1 + a2*sin(theta2)*sin(phi2)
  y2: l*y1 - a2*sin(theta2)*cos(phi2)
  z2: l*z1 + a2*cos(theta2)
T: >-
  A1*(theta1'^2 + phi1'^2*sin(theta1)^2)/2 + C1*(psi1' + phi1'*cos(theta1))^2/2
  + A2*(theta2'^2 + phi2'^2*sin(theta2)^2)/2 + C2*(psi2' + phi2'*cos(theta2))^2/2
  + m2*(x2'^2 + y2'^2 + z2'^2)/2
V: m1*g*a1*z1 + m2*g*z2
"""


def rows(quick: bool) -> Iterator[Row]:
    """CPU seconds of the whole process; quick: without n = 100 and LagrangesMethod."""
    costs = {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "system.yaml")
        for what, text, bar in CHAINS:
            if not (quick and " 100" in what):
                path.write_text(text())
                costs[what] = cost([*_solve(path), "--show", "matrix_form"], limit=300)
                yield _row(what, costs[what], bar)
        peak = max(used.peak_mib for used in costs.values())
        yield Row("chains, peak memory", peak, "MiB", MIB)
        if not quick:
            other = cost([sys.executable, str(HERE / "chain_by_sympy.py"), "10"]).cpu
            gain = other / costs[CHAINS[0][0]].cpu
            note = f"{other:.1f} s CPU there"
            yield Row("chain 10, gain over LagrangesMethod", gain, "x", 30, True, note)
            path.write_text(chain(30, "points"))
            yield _engine_row(cost([*_solve(path), "--show", "matrix_form"]))
        yield _row("heavy top, usual sections", cost(_solve(HEAVY_TOP), limit=120), 5)
        path.write_text(TWO_BODIES)
        for what, *options in (("matrix form", "--show", "matrix_form"), ("usual sections",)):
            used = cost([*_solve(path), *options], limit=120)
            yield _row(f"two joined bodies, {what}", used, 5)


def _engine_row(own: Cost) -> Row:
    """Whether another engine for the derivatives would pay: symengine, which writes them plainly."""
    what, python = "chain 30, total against symengine", peers("symengine")
    if python is None:
        return Row(what, None, "x", note="symengine is not installed")
    other = cost([python, str(HERE / "chain_by_symengine.py"), "30"]).cpu
    return Row(what, own.cpu / other, "x", note=f"{own.cpu:.2f} s and {other:.2f} s CPU")


def _row(what: str, used: Cost, bar: float | None) -> Row:
    """CPU seconds, unless there was no answer."""
    if used.answered:
        return Row(what, used.cpu, "s", bar, note=f"{used.peak_mib} MiB")
    return Row(what, None, "s", bar, note=used.mistakes.strip().rpartition("error: ")[2] or "late")


def _solve(path: Path) -> list[str]:
    return [*LAGCLI, "solve", "--no-cache", str(path), "-f", "json"]
