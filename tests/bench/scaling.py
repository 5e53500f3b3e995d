"""Large systems, whole process: the time of `--show matrix_form`, against bars.

    python tests/bench/scaling.py [--quick]

CPU seconds of the process and its peak memory; the chain of ten against SymPy's
LagrangesMethod forming the same matrices (`chain_by_sympy.py`).
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.mechanics.chains import cartesian, chain, closed  # noqa: E402

LAGCLI = str(Path(sys.executable).with_name("lagcli"))
NAIVE = str(Path(__file__).with_name("chain_by_sympy.py"))

#: what, text, bar in seconds
ROWS = (
    ("chain 10, points", lambda: chain(10, "points"), 2),
    ("chain 50, points", lambda: chain(50, "points"), 15),
    ("chain 50, definitions", lambda: chain(50, "definitions"), 15),
    ("chain 50, T of definitions", lambda: chain(50, "kinetic"), 15),
    ("closed chain 50, points", lambda: closed(50, "points"), 15),
    ("closed chain 50, definitions", lambda: closed(50, "definitions"), 15),
    ("Cartesian pendulum 50", lambda: cartesian(50), 15),
    ("chain 100, points", lambda: chain(100, "points"), 90),
    ("chain 100, definitions", lambda: chain(100, "definitions"), 90),
)


def measured(command):
    """CPU seconds, seconds and peak MiB of a process and what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"cpu": round(cpu, 3), "seconds": round(seconds, 3), "peak_mib": after.ru_maxrss // 1024}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="without n = 100 and LagrangesMethod")
    quick = parser.parse_args().quick
    rows, holds = {}, True
    with tempfile.TemporaryDirectory() as folder:
        for what, text, bar in ROWS:
            if quick and " 100" in what:
                continue
            path = Path(folder, "system.yaml")
            path.write_text(text())
            command = [LAGCLI, "solve", "--no-cache", str(path), "--show", "matrix_form"]
            rows[what] = measured([*command, "-f", "json"]) | {"bar": bar}
            holds = holds and rows[what]["seconds"] <= bar and rows[what]["peak_mib"] < 2048
    if not quick:
        naive = measured([sys.executable, NAIVE, "10"])
        ratio = naive["cpu"] / rows["chain 10, points"]["cpu"]
        rows["LagrangesMethod, chain 10"] = naive | {"ratio": round(ratio, 1), "bar": 30}
        holds = holds and ratio >= 30
    print(json.dumps(rows, indent=2))
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
